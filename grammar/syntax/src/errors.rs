//! Mistakes that either surface can have, and the list of every code that this crate raises.

use crate::ast::{MAX_BYTES, MAX_NESTING, MAX_STEPS, MAX_TOKENS};
use crate::diagnostic::{Code, Mistake, Severity};
use crate::json::errors::{
    BadName, BadValue, DuplicateKey, JsonSyntax, MissingKey, NoForm, NumberRange, ReservedKey, TwoForms,
    UnknownKey, WrongType,
};
use crate::source::Span;
use crate::text::errors::{TextSyntax, UnknownUnit};

/// Every code of the syntax stage, in order.
pub const CODES: &[Code] = &[
    TextSyntax::CODE,
    JsonSyntax::CODE,
    UnknownKey::CODE,
    DuplicateKey::CODE,
    MissingKey::CODE,
    WrongType::CODE,
    NumberRange::CODE,
    BadValue::CODE,
    NoForm::CODE,
    TwoForms::CODE,
    TooDeep::CODE,
    TooLarge::CODE,
    TooManySteps::CODE,
    NotUtf8::CODE,
    Empty::CODE,
    IgnoredProse::CODE,
    ReservedKey::CODE,
    TooManyTokens::CODE,
    NoDocument::CODE,
    UnknownUnit::CODE,
    BadName::CODE,
];

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
        let (what, depth) = match self.limit {
            MAX_NESTING => ("steps, conditions and brackets", MAX_NESTING),
            limit => ("brackets", limit),
        };
        Some(format!("{what} nest at most {depth} deep: move the inner part to a sub-policy"))
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
    /// What should be there.
    pub wanted: Wanted,
}

/// What a document is read as.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Wanted {
    /// A policy or declarations.
    Policy,
    /// Something that is written in JSON alone: a scene, a state, faults.
    Json,
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
        let help = match self.wanted {
            Wanted::Policy => {
                "a policy is written `policy name { … }`, or in JSON `{\"motet\": 1, \"policy\": \"name\", \"steps\": [ … ]}`; declarations such as `fluent clean(what: Object)` may stand beside it or alone"
            }
            Wanted::Json => {
                "a JSON object belongs here: a scene is written `{\"motet_scene\": 1, \"entities\": [ … ]}`, a state `{\"free(hand)\": true}`"
            }
        };
        Some(help.into())
    }
}

/// The bytes are not UTF-8.
#[derive(Clone, Debug)]
pub struct NotUtf8 {
    /// The first bad byte.
    pub span: Span,
    /// Its value.
    pub byte: u8,
}

impl Mistake for NotUtf8 {
    const CODE: Code = Code("M0114");
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        format!("byte {} (0x{:02x}) is not UTF-8", self.span.start, self.byte)
    }
    fn help(&self) -> Option<String> {
        Some("save the file as UTF-8".into())
    }
}

/// Text about a document in a model's reply.
#[derive(Clone, Debug)]
pub struct IgnoredProse {
    /// The first line of it.
    pub span: Span,
    /// What it is.
    pub what: Ignored,
}

/// What is ignored of a reply.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Ignored {
    /// Words.
    Prose,
    /// A policy beside the one that is read.
    Policy,
}

impl Mistake for IgnoredProse {
    const CODE: Code = Code("M0116");
    const SEVERITY: Severity = Severity::Warning;
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        match self.what {
            Ignored::Prose => "text that is no part of the policy is ignored".into(),
            Ignored::Policy => "a second policy is ignored: one is read".into(),
        }
    }
    fn help(&self) -> Option<String> {
        Some("reply with the policy alone".into())
    }
}

/// A reply in which there is no policy.
#[derive(Clone, Debug)]
pub struct NoDocument {
    /// The first line of it.
    pub span: Span,
}

impl Mistake for NoDocument {
    const CODE: Code = Code("M0119");
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        "there is no policy in this text".into()
    }
    fn help(&self) -> Option<String> {
        Some("a policy is written `policy name { … }`, or in JSON `{\"motet\": 1, \"policy\": \"name\", \"steps\": [ … ]}`".into())
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn every_code_is_declared_once() {
        let codes: Vec<&str> = super::CODES.iter().map(|code| code.0).collect();
        let mut sorted = codes.clone();
        sorted.sort_unstable();
        sorted.dedup();
        assert_eq!(codes, sorted);
    }
}
