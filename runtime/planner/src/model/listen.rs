//! What there is to show and to record of asking a model.

use std::time::Duration;

use super::chat::{Message, ModelError};

/// Something that happens while a model is asked.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Happening<'a> {
    /// A chat is sent; round 0 is the first.
    Asked {
        /// Which round.
        round: u32,
        /// To whom.
        model: &'a str,
        /// What.
        chat: &'a [Message],
    },
    /// The server is asked again after a while.
    Retrying {
        /// Why.
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
    /// Known fixes were made to the reply.
    Mended {
        /// What they do.
        titles: &'a [String],
    },
    /// A round came to nothing, and the findings go back to the model, or to a person after the last round.
    Refused {
        /// Which round.
        round: u32,
        /// What the model wrote, as far as it was read.
        reply: &'a str,
        /// What is wrong with it, a line each.
        findings: &'a str,
    },
    /// A round brought no whole reply.
    Failed {
        /// Which round.
        round: u32,
        /// What the model wrote, as far as it came.
        reply: &'a str,
        /// Why.
        why: &'a ModelError,
    },
    /// The reply is a policy that passes the check.
    Taken {
        /// Which round.
        round: u32,
        /// What the model wrote.
        reply: &'a str,
    },
    /// Its first step begins while the rest is still being written.
    Begun {
        /// What the model wrote so far.
        reply: &'a str,
    },
}

/// Looks on while a model is asked, and may stop it.
pub trait Listener {
    /// Something happens.
    fn hear(&mut self, _happening: &Happening<'_>) {}
    /// Whether a person wants it to stop. Asked often.
    fn is_stopped(&self) -> bool {
        false
    }
}

/// Looks on without a word.
impl Listener for () {}
