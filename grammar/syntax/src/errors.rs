//! Mistakes that either surface can have, and the list of every code that this crate raises.

use crate::ast::{MAX_BYTES, MAX_NESTING, MAX_STEPS, MAX_TOKENS};
use crate::diagnostic::{Code, Mistake};
use crate::source::Span;

/// Every code of the syntax stage, in order.
pub const CODES: &[Code] = &[];

/// Brackets, blocks or expressions nest deeper than any policy needs.
#[derive(Clone, Debug)]
pub struct TooDeep {
    /// The first bracket, step or expression that is too deep.
    pub span: Span,
    /// The limit.
    pub limit: usize,
}

impl Mistake for TooDeep {
    const CODE: Code = Code("M0111");
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        format!("this is nested more than {} levels deep", self.limit)
    }
    fn help(&self) -> Option<String> {
        let depth = MAX_NESTING;
        Some(format!(
            "steps, conditions and brackets nest at most {depth} deep: move the inner part to a sub-policy"
        ))
    }
}

/// The document is larger than [`MAX_BYTES`].
#[derive(Clone, Debug)]
pub struct TooLarge {
    /// Its first byte.
    pub span: Span,
    /// Its size.
    pub bytes: usize,
}

impl Mistake for TooLarge {
    const CODE: Code = Code("M0112");
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        let mebibytes = 1024.0 * 1024.0;
        #[expect(clippy::cast_precision_loss, reason = "shown with one decimal")]
        let (size, limit) = (self.bytes as f64 / mebibytes, MAX_BYTES as f64 / mebibytes);
        format!("the document has {size:.1} MiB, at most {limit:.0} MiB are read")
    }
    fn help(&self) -> Option<String> {
        Some("split it into several files".into())
    }
}

/// The document has more than [`MAX_STEPS`] steps.
#[derive(Clone, Debug)]
pub struct TooManySteps {
    /// The first step that is too many.
    pub span: Span,
}

impl Mistake for TooManySteps {
    const CODE: Code = Code("M0113");
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        format!("the document has more than {MAX_STEPS} steps")
    }
    fn help(&self) -> Option<String> {
        Some(
            "use `repeat` or `each` for steps that are alike, or split the document into several policies"
                .into(),
        )
    }
}

/// The document has more than [`MAX_TOKENS`] words and marks.
#[derive(Clone, Debug)]
pub struct TooManyTokens {
    /// The first that is too many.
    pub span: Span,
}

impl Mistake for TooManyTokens {
    const CODE: Code = Code("M0118");
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        format!("the document has more than {MAX_TOKENS} words and values")
    }
    fn help(&self) -> Option<String> {
        Some("split it into several files".into())
    }
}

/// Nothing but white space and comments.
#[derive(Clone, Debug)]
pub struct Empty {
    /// The place where something should be.
    pub span: Span,
}

impl Mistake for Empty {
    const CODE: Code = Code("M0115");
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        "the document is empty".into()
    }
    fn help(&self) -> Option<String> {
        Some("a policy is written `policy name { … }`, or in JSON `{\"motet\": 1, \"policy\": \"name\", \"steps\": [ … ]}`".into())
    }
}
