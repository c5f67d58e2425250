//! Diagnostics of all stages: one struct and one code for each mistake, in the stage's `diagnostics.rs`,
//! turned into one flat [`Diagnostic`]. Rendering is in [`crate::render`].

use smol_str::SmolStr;

use crate::source::Span;

/// Severity of a diagnostic. `check` fails on errors and on nothing else.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum Severity {
    /// A remark without a problem.
    Note,
    /// A probable mistake; the policy can run.
    Warning,
    /// A mistake; the policy cannot run.
    Error,
}

impl Severity {
    /// Name of the severity: `error`, `warning` or `note`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Note => "note",
            Self::Warning => "warning",
            Self::Error => "error",
        }
    }
}

/// A diagnostic code, `M0201`. Each is declared once, in the `diagnostics.rs` of the stage that raises it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Code(pub &'static str);

impl std::fmt::Display for Code {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.0)
    }
}

/// A user's mistake: a struct with the facts, and the words for them.
pub trait Mistake {
    /// Code of the mistake; no other has it.
    const CODE: Code;
    const SEVERITY: Severity = Severity::Error;

    /// Range that the message is about.
    fn span(&self) -> Span;
    /// One clause, lower case, no full stop, user text in back-quotes, no Rust names.
    fn message(&self) -> String;
    /// Text to write instead, where that is known.
    fn help(&self) -> Option<String> {
        None
    }
    /// Other ranges that explain the mistake.
    fn related(&self) -> Vec<Related> {
        Vec::new()
    }
    /// The edit that repairs the mistake, where only one is right.
    fn fix(&self) -> Option<Fix> {
        None
    }
    /// Names that the mistake is about, for programs that act on it.
    fn about(&self) -> Option<About> {
        None
    }
}

/// One message for the author of a document.
#[derive(Clone, PartialEq, Debug)]
pub struct Diagnostic {
    pub code: Code,
    pub severity: Severity,
    pub message: String,
    pub help: Option<String>,
    pub span: Span,
    /// JSON Pointer into the JSON syntax, such as `/steps/2/try/0`; empty for the whole document or a
    /// declaration.
    pub path: String,
    /// Other ranges that explain the message.
    pub related: Vec<Related>,
    /// Edit that a program may apply.
    pub fix: Option<Fix>,
    /// Names that the message is about, so that no program has to read it.
    pub about: Option<About>,
}

/// Names that a diagnostic is about; those without a part in it are `None`.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct About {
    /// The primitive or policy that is called.
    pub primitive: Option<SmolStr>,
    pub parameter: Option<SmolStr>,
    /// The fluent, measure or field of a condition; of several the one that fails.
    pub subject: Option<SmolStr>,
    /// Truth value of the subject that the condition asks for.
    pub wanted: Option<bool>,
    /// The entity where a motion ends.
    pub entity: Option<SmolStr>,
    /// The reason in a person's words: a clause with names and numbers, without ids.
    pub plain: Option<String>,
}

impl About {
    /// Names a parameter of a primitive or policy.
    #[must_use]
    pub fn parameter(primitive: &str, parameter: &str) -> Self {
        Self { primitive: Some(primitive.into()), parameter: Some(parameter.into()), ..Self::default() }
    }
}

/// Another range that explains a diagnostic.
#[derive(Clone, PartialEq, Debug)]
pub struct Related {
    pub message: String,
    /// `None` for a fact outside any file, such as the state given at the start.
    pub span: Option<Span>,
    /// JSON Pointer, as in [`Diagnostic::path`].
    pub path: String,
}

impl Related {
    /// Remark on a range.
    #[must_use]
    pub fn new(message: impl Into<String>, span: Span) -> Self {
        Self { message: message.into(), span: Some(span), path: String::new() }
    }
}

/// Edits that repair a mistake, all to be applied together.
#[derive(Clone, PartialEq, Debug)]
pub struct Fix {
    /// Title of the fix: "write `pick`".
    pub title: String,
    /// Replacements that do not overlap.
    pub edits: Vec<Edit>,
}

/// Replacement of a range of bytes.
#[derive(Clone, PartialEq, Debug)]
pub struct Edit {
    /// Replaced range; empty for an insertion.
    pub span: Span,
    pub text: String,
}

impl<M: Mistake> From<M> for Diagnostic {
    fn from(mistake: M) -> Self {
        Self {
            code: M::CODE,
            severity: M::SEVERITY,
            message: clipped(mistake.message()),
            help: mistake.help().map(clipped),
            span: mistake.span(),
            path: String::new(),
            related: mistake.related(),
            fix: mistake.fix(),
            about: mistake.about(),
        }
    }
}

/// Longest message and help in bytes: a token of the input may be very long.
const MAX_MESSAGE_BYTES: usize = 4_000;

/// The beginning and the end of a text that is too long.
fn clipped(text: String) -> String {
    if text.len() <= MAX_MESSAGE_BYTES {
        return text;
    }
    let (begin, end) = (MAX_MESSAGE_BYTES / 2, text.len() - MAX_MESSAGE_BYTES / 2);
    let (begin, end) = (text.floor_char_boundary(begin), text.ceil_char_boundary(end));
    format!("{} … {}", text.get(..begin).unwrap_or_default(), text.get(end..).unwrap_or_default())
}

/// Declares structs that implement [`crate::Mistake`], and `CODES`, the list of their codes.
///
/// Each has a `span`; `help`, `related`, `fix` and `about` may be left out.
///
/// ```
/// motet_syntax::mistakes! {
///     pub(crate) const CODES;
///
///     /// A step that is too long.
///     TooLong("M9999", Error) { secs: f64 }
///     message(m) { format!("this takes {} s", m.secs) }
///     help(_m) { Some("take less".to_owned()) }
/// }
///
/// let said: motet_syntax::Diagnostic = TooLong { span: motet_syntax::Span::default(), secs: 3.0 }.into();
/// assert_eq!(said.message, "this takes 3 s");
/// assert_eq!(CODES.len(), 1);
/// ```
#[macro_export]
macro_rules! mistakes {
    ($vis:vis const CODES; $(
        $(#[$doc:meta])+
        $name:ident($code:literal, $severity:ident) { $($field:ident: $ty:ty),* $(,)? }
        message($m:ident) $message:block
        $(help($h:ident) $help:block)?
        $(related($r:ident) $related:block)?
        $(fix($f:ident) $fix:block)?
        $(about($a:ident) $about:block)?
    )*) => {
        /// Every code that is raised here, in order.
        $vis const CODES: &[$crate::Code] = &[$($crate::Code($code)),*];
        $(
            $(#[$doc])+
            #[derive(Clone, Debug)]
            pub(crate) struct $name {
                pub(crate) span: $crate::Span,
                $(pub(crate) $field: $ty,)*
            }
            impl $crate::Mistake for $name {
                const CODE: $crate::Code = $crate::Code($code);
                const SEVERITY: $crate::Severity = $crate::Severity::$severity;
                fn span(&self) -> $crate::Span {
                    self.span
                }
                fn message(&self) -> String {
                    let $m = self;
                    $message
                }
                $(fn help(&self) -> Option<String> {
                    let $h = self;
                    $help
                })?
                $(fn related(&self) -> Vec<$crate::Related> {
                    let $r = self;
                    $related
                })?
                $(fn fix(&self) -> Option<$crate::Fix> {
                    let $f = self;
                    $fix
                })?
                $(fn about(&self) -> Option<$crate::About> {
                    let $a = self;
                    $about
                })?
            }
        )*
    };
}

#[cfg(test)]
mod tests {
    use super::{MAX_MESSAGE_BYTES, clipped};

    #[test]
    fn clipped_keeps_the_ends_of_a_long_text() {
        let text = format!("unknown name `{}`", "é".repeat(MAX_MESSAGE_BYTES));
        let short = clipped(text);
        assert!(short.len() <= MAX_MESSAGE_BYTES + 5, "{}", short.len());
        assert!(short.starts_with("unknown name `é") && short.ends_with("é`") && short.contains(" … "));
    }
}
