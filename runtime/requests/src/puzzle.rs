//! Why a request is not carried out as it stands, and the question that would help.

use smol_str::SmolStr;
use thiserror::Error;

/// Why a request gives no goal.
#[derive(Error, Clone, PartialEq, Eq, Debug)]
pub enum RequestError {
    /// The grammar has no place for this part.
    #[error("I do not understand `{part}`")]
    NotUnderstood {
        /// The part.
        part: String,
    },
    /// Nothing here is called so.
    #[error("I know of no `{what}` here")]
    NotFound {
        /// As it was said.
        what: String,
    },
    /// What is meant is clear, but cannot be done with it: `open the bottle`, `bring me three mugs` of two.
    #[error("{why}")]
    Unfit {
        /// Why.
        why: String,
    },
    /// A thing is meant by where it is, and is known to be somewhere else.
    #[error("{why}")]
    Elsewhere {
        /// Where it is taken to be.
        why: String,
        /// The thing.
        thing: SmolStr,
    },
    /// More than one thing is called so.
    #[error("`{what}` may be {}", list(options))]
    AmbiguousReference {
        /// As it was said.
        what: String,
        /// What it may be.
        options: Vec<SmolStr>,
    },
    /// What to do is clear, but not with what, or where to.
    #[error("{question}")]
    AmbiguousTask {
        /// What would have to be known.
        question: String,
        /// What could be answered.
        options: Vec<SmolStr>,
    },
}

fn list(options: &[SmolStr]) -> String {
    let quoted: Vec<_> = options.iter().map(|option| format!("`{option}`")).collect();
    match quoted.as_slice() {
        [] => String::new(),
        [only] => only.clone(),
        [rest @ .., last] => format!("{} or {last}", rest.join(", ")),
    }
}
