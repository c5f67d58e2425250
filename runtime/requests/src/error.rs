//! Errors of a request that is not carried out as it stands, with the question that would help.

use smol_str::SmolStr;
use thiserror::Error;

/// An error of a request that gives no goal.
#[derive(Error, Clone, PartialEq, Eq, Debug)]
pub enum RequestError {
    /// The grammar has no place for this part.
    #[error("I do not understand `{part}`")]
    NotUnderstood { part: String },
    /// Nothing here is called so.
    #[error("I know of no `{what}` here")]
    NotFound {
        /// As it was said.
        what: String,
    },
    #[error("{why}")]
    Unfit { why: String },
    /// A thing is meant by where it is, and is known to be somewhere else.
    #[error("{why}")]
    Elsewhere { why: String, thing: SmolStr },
    /// More than one thing is called so.
    #[error("`{what}` may be {}", list(options))]
    AmbiguousReference {
        /// As it was said.
        what: String,
        options: Vec<SmolStr>,
    },
    #[error("{question}")]
    AmbiguousTask { question: String, options: Vec<SmolStr> },
}

fn list(options: &[SmolStr]) -> String {
    let quoted: Vec<_> = options.iter().map(|option| format!("`{option}`")).collect();
    match quoted.as_slice() {
        [] => String::new(),
        [only] => only.clone(),
        [rest @ .., last] => format!("{} or {last}", rest.join(", ")),
    }
}
