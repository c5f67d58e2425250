//! Failures of primitives: a kind of the standard library, with the reason in words.

use motet_runtime::{FailureReport, Outcome};

/// Failure of a primitive.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Failure {
    pub(crate) kind: &'static str,
    /// Clause such as "the red mug is not there".
    text: Option<String>,
}

impl Failure {
    /// Failure with its reason.
    pub(crate) fn new(kind: &'static str, text: impl Into<String>) -> Self {
        Self { kind, text: Some(text.into()) }
    }

    pub(crate) fn outcome(self) -> Outcome {
        Outcome::Failure(FailureReport { kind: self.kind.into(), text: self.text.map(Into::into) })
    }
}

/// Failure of which the kind says all.
impl From<&'static str> for Failure {
    fn from(kind: &'static str) -> Self {
        Self { kind, text: None }
    }
}
