//! Interface to a model: a chat goes out, a reply comes in piece by piece; and the events of that exchange.

use std::sync::Arc;
use std::time::Duration;

use motet_decode::Grammar;
use motet_runtime::CameraImage;
use thiserror::Error;

/// Author of a message.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Role {
    /// Instructions to the model.
    System,
    /// Requests and findings.
    User,
    /// Replies of the model.
    Assistant,
}

/// A message of a chat.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Message {
    pub role: Role,
    pub text: String,
    /// Images shown with the text.
    pub images: Vec<Arc<CameraImage>>,
}

impl Message {
    /// A message without images.
    #[must_use]
    pub fn new(role: Role, text: impl Into<String>) -> Self {
        Self { role, text: text.into(), images: Vec::new() }
    }
}

/// A language or vision-language model that answers chats.
pub trait Model {
    /// Sends a chat without waiting for the reply. A server that can constrain its model should enforce
    /// `constraint`; the planner does not rely on it.
    ///
    /// # Errors
    ///
    /// The chat cannot be sent.
    fn ask(&mut self, chat: &[Message], constraint: &Grammar) -> Result<Box<dyn Reply>, ModelError>;

    /// Display name: the model's name and address.
    fn name(&self) -> String;
}

/// A reply in transit. Dropping it closes the connection.
pub trait Reply {
    /// Waits at most `wait` for the next piece of the reply. Nothing follows [`ReplyEvent::End`] and
    /// [`ReplyEvent::Failed`].
    fn next(&mut self, wait: Duration) -> ReplyEvent;
}

/// Progress of a reply.
#[derive(Clone, PartialEq, Debug)]
pub enum ReplyEvent {
    Nothing,
    /// The next piece of its text.
    Piece(String),
    /// A failure before the first piece; the request is repeated after a while.
    Retrying {
        why: String,
        /// Waiting time before the repetition.
        after: Duration,
    },
    /// Number of tokens of the exchange, shortly before its end.
    Used(TokenUsage),
    /// The reply is complete.
    End(Finish),
    /// The reply failed.
    Failed(ModelError),
}

/// Number of tokens, as the server counts them.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct TokenUsage {
    /// Tokens of the chat.
    pub input: Option<u64>,
    /// Tokens of the reply.
    pub output: Option<u64>,
}

impl TokenUsage {
    /// Sum with another exchange.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        let sum = |a: Option<u64>, b: Option<u64>| match (a, b) {
            (Some(a), Some(b)) => Some(a.saturating_add(b)),
            (one, None) | (None, one) => one,
        };
        Self { input: sum(self.input, other.input), output: sum(self.output, other.output) }
    }
}

/// Ending of a reply.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Finish {
    /// The model ended its reply.
    Stop,
    /// The reply reached the server's length limit.
    Length,
}

/// Reasons for a missing or incomplete reply.
#[derive(Error, Clone, PartialEq, Debug)]
pub enum ModelError {
    /// The server cannot be reached.
    #[error("it cannot be reached: {why}")]
    Unreachable { why: String },
    /// The server refused the request: no key, no such model, an unsupported grammar.
    #[error("it refuses the request: {why}")]
    Refused {
        /// The server's message.
        why: String,
    },
    /// The model or a filter of the server declined to answer.
    #[error("the model declines: {why}")]
    Declined {
        /// The words of the model, or the server's name of the reason.
        why: String,
    },
    /// The server was busy or failed at every attempt.
    #[error("it is busy or fails: {why}")]
    Busy {
        /// The server's message.
        why: String,
    },
    /// The reply took too long.
    #[error("it did not answer within {secs} s")]
    TimedOut {
        /// Waiting time in s.
        secs: f64,
    },
    /// The reply is too long.
    #[error("its reply is longer than {bytes} bytes")]
    TooLong {
        /// Limit in bytes.
        bytes: usize,
    },
    /// The check of the reply took too long.
    #[error("the check of its reply does not end within {secs} s")]
    TooInvolved {
        /// Time limit in s.
        secs: u64,
    },
    /// The reply broke off.
    #[error("its reply broke off: {why}")]
    CutOff { why: String },
    /// The response is not a reply to a chat.
    #[error("its answer is no reply: {why}")]
    Malformed { why: String },
    /// The planner gave the reply up.
    #[error("the reply was cancelled")]
    Cancelled,
}

impl ModelError {
    /// True if another attempt cannot succeed, or took all the time that it may.
    #[must_use]
    pub const fn is_lasting(&self) -> bool {
        !matches!(self, Self::TooLong { .. } | Self::CutOff { .. } | Self::Malformed { .. })
    }
}

/// Event of the exchange with a model.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum ModelEvent<'a> {
    /// A chat is sent; round 0 is the first.
    Asked { round: u32, model: &'a str, chat: &'a [Message] },
    /// The server is asked again after a while.
    Retrying {
        why: &'a str,
        /// Waiting time before the next attempt.
        after: Duration,
    },
    /// The model wrote the next piece of its reply.
    Wrote(&'a str),
    /// The server counted the tokens of a round.
    Used(TokenUsage),
    /// The reply has no policy, and asks or refuses.
    Said {
        round: u32,
        /// Words for the person.
        words: &'a str,
    },
    /// The policy is accepted although it does not reach this goal, which is only a guess at the request.
    Unmet { goal: &'a str },
    /// Known fixes were applied to the reply.
    Mended { titles: &'a [String] },
    /// A round failed. The diagnostics go back to the model, or to a person after the last round.
    Refused {
        round: u32,
        /// Reply, as far as it was read.
        reply: &'a str,
        /// Errors of the reply, one per line.
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
    /// The first step starts while the rest is still being written.
    Begun {
        /// Reply so far.
        reply: &'a str,
    },
}

/// Observer of the exchange with a model, which may stop it.
pub trait ModelObserver {
    /// Receives each event of the exchange.
    fn hear(&mut self, _happening: &ModelEvent<'_>) {}
    /// True once a person wants the exchange to stop. The planner calls it often.
    fn is_stopped(&self) -> bool {
        false
    }
}

/// Observer that does nothing.
impl ModelObserver for () {}
