//! A model as the planner sees it: a chat goes out, a reply comes in piece by piece.

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
    /// Sends a chat. The reply is to keep to what `constraint` offers, where whoever answers can be held to
    /// that; nobody
    /// relies on it. Does not wait.
    ///
    /// # Errors
    ///
    /// The chat cannot be sent like that.
    fn ask(&mut self, chat: &[Message], constraint: &Grammar) -> Result<Box<dyn Reply>, ModelError>;

    /// Display name: the model's name and address.
    fn name(&self) -> String;
}

/// A reply on its way. To drop it is to hang up.
pub trait Reply {
    /// Waits at most `wait` for the next piece of the reply. After [`News::End`] and [`News::Failed`]
    /// nothing follows.
    fn next(&mut self, wait: Duration) -> News;
}

/// Progress of a reply.
#[derive(Clone, PartialEq, Debug)]
pub enum News {
    Nothing,
    /// The next piece of its text.
    Piece(String),
    /// Something went wrong before the first piece, and is tried again after a while.
    Retrying {
        why: String,
        /// After how long.
        after: Duration,
    },
    /// It is complete.
    End(Finish),
    /// It will not be complete.
    Failed(ModelError),
}

/// Ending of a reply.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Finish {
    /// The model had no more to say.
    Stop,
    /// It had written as much as it may.
    Length,
}

/// Reasons for a missing or incomplete reply.
#[derive(Error, Clone, PartialEq, Debug)]
pub enum ModelError {
    /// There is no connection.
    #[error("it cannot be reached: {why}")]
    Unreachable { why: String },
    /// The request was refused: no key, no such model, a grammar that it does not take.
    #[error("it refuses the request: {why}")]
    Refused {
        /// In its words.
        why: String,
    },
    /// It was busy, or failed, each time it was asked.
    #[error("it is busy or fails: {why}")]
    Busy {
        /// In its words.
        why: String,
    },
    /// It took too long.
    #[error("it did not answer within {secs} s")]
    TimedOut {
        /// Waiting time in s.
        secs: f64,
    },
    /// It wrote more than is read.
    #[error("its reply is longer than {bytes} bytes")]
    TooLong {
        /// Limit in bytes.
        bytes: usize,
    },
    /// The reply broke off.
    #[error("its reply broke off: {why}")]
    CutOff { why: String },
    /// The response is not a reply to a chat.
    #[error("its answer is no reply: {why}")]
    Malformed { why: String },
    /// The reply was given up here.
    #[error("the reply was cancelled")]
    Cancelled,
}

impl ModelError {
    /// Returns `true` if another attempt cannot succeed.
    #[must_use]
    pub const fn is_lasting(&self) -> bool {
        match self {
            Self::Unreachable { .. } | Self::Refused { .. } | Self::Busy { .. } | Self::Cancelled => true,
            Self::TimedOut { .. } | Self::TooLong { .. } | Self::CutOff { .. } | Self::Malformed { .. } => {
                false
            }
        }
    }
}
