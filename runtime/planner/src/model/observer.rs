//! Observation of the exchange with a model, for display and recording.

use std::time::Duration;

use super::chat::{Message, ModelError};

/// Something that happens while a model is asked.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum ModelEvent<'a> {
    /// A chat is sent; round 0 is the first.
    Asked { round: u32, model: &'a str, chat: &'a [Message] },
    /// The server is asked again after a while.
    Retrying {
        why: &'a str,
        /// After how long.
        after: Duration,
    },
    /// The model wrote the next piece of its reply.
    Wrote(&'a str),
    /// The reply was wrong and was not read further.
    Stopped {
        /// At which byte of the reply.
        at: usize,
    },
    /// Knowledge fixes were made to the reply.
    Mended { titles: &'a [String] },
    /// A round came to nothing, and the findings go back to the model, or to a person after the last round.
    Refused {
        round: u32,
        /// Reply, as far as it was read.
        reply: &'a str,
        /// Errors of the reply, one a line.
        findings: &'a str,
    },
    /// A round brought no whole reply.
    Failed {
        round: u32,
        /// Reply, as far as it arrived.
        reply: &'a str,
        why: &'a ModelError,
    },
    /// The reply is a policy that passes the check.
    Taken { round: u32, reply: &'a str },
    /// Its first step begins while the rest is still being written.
    Begun {
        /// Reply so far.
        reply: &'a str,
    },
}

/// Looks on while a model is asked, and may stop it.
pub trait ModelObserver {
    /// Receives each event of the exchange.
    fn hear(&mut self, _happening: &ModelEvent<'_>) {}
    /// Returns `true` once a person wants the exchange to stop. The planner calls it often.
    fn is_stopped(&self) -> bool {
        false
    }
}

/// Looks on without a word.
impl ModelObserver for () {}
