//! What every stage says about a document: one struct a mistake (in the stage's `errors.rs`), one code each, turned
//! into this flat form. Rendering is [`crate::render`]'s.

use smol_str::SmolStr;

use crate::source::Span;

/// How bad a finding is. `check` fails on errors and on nothing else.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub enum Severity {
    /// Something worth knowing.
    Note,
    /// Probably not what was meant; the policy can run.
    Warning,
    /// The policy cannot be run.
    Error,
}

impl Severity {
    /// `error`, `warning` or `note`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Note => "note",
            Self::Warning => "warning",
            Self::Error => "error",
        }
    }
}

/// A diagnostic code, `M0201`. Each is declared once, in the `errors.rs` of the stage that raises it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub struct Code(pub &'static str);

impl std::fmt::Display for Code {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.0)
    }
}

/// A user's mistake: a struct with the facts, which knows how to tell them.
pub trait Mistake {
    /// Its code; no other mistake has it.
    const CODE: Code;
    /// Its severity.
    const SEVERITY: Severity = Severity::Error;

    /// Where it is.
    fn span(&self) -> Span;
    /// One clause, lower case, no full stop, user text in back-quotes, no Rust names.
    fn message(&self) -> String;
    /// What to write instead, where that is known.
    fn help(&self) -> Option<String> {
        None
    }
    /// The other places of the story.
    fn related(&self) -> Vec<Related> {
        Vec::new()
    }
    /// The one right edit, where there is one.
    fn fix(&self) -> Option<Fix> {
        None
    }
    /// What it is about, in names, for programs that act on it.
    fn about(&self) -> Option<About> {
        None
    }
}

/// One finding.
#[derive(Clone, PartialEq, Debug)]
pub struct Diagnostic {
    /// Its code.
    pub code: Code,
    /// Its severity.
    pub severity: Severity,
    /// What is wrong.
    pub message: String,
    /// What to write instead.
    pub help: Option<String>,
    /// Where.
    pub span: Span,
    /// JSON Pointer into the JSON form, such as `/steps/2/try/0`; empty for the whole document or a declaration.
    pub path: String,
    /// Other places that belong to the story.
    pub related: Vec<Related>,
    /// A machine-applicable edit.
    pub fix: Option<Fix>,
    /// What it is about, in names, so that no program has to read the message.
    pub about: Option<About>,
}

/// The names that a finding is about; those that play no part in it are missing.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct About {
    /// The primitive or policy that is called.
    pub primitive: Option<SmolStr>,
    /// Its parameter.
    pub parameter: Option<SmolStr>,
    /// The fluent, measure or field on which a condition depends: of several the one that fails.
    pub subject: Option<SmolStr>,
    /// Whether the condition asks for the subject to hold, or not to.
    pub wanted: Option<bool>,
}

impl About {
    /// A parameter of something called.
    #[must_use]
    pub fn parameter(primitive: &str, parameter: &str) -> Self {
        Self { primitive: Some(primitive.into()), parameter: Some(parameter.into()), ..Self::default() }
    }
}

/// Another place that belongs to a finding.
#[derive(Clone, PartialEq, Debug)]
pub struct Related {
    /// What is there.
    pub message: String,
    /// Where; `None` for something outside any file, such as the state given at the start.
    pub span: Option<Span>,
    /// JSON Pointer, as in [`Diagnostic::path`].
    pub path: String,
}

impl Related {
    /// A remark on a place.
    #[must_use]
    pub fn new(message: impl Into<String>, span: Span) -> Self {
        Self { message: message.into(), span: Some(span), path: String::new() }
    }
}

/// Edits that mend a finding, all to be applied together.
#[derive(Clone, PartialEq, Debug)]
pub struct Fix {
    /// What they do: "write `pick`".
    pub title: String,
    /// Replacements that do not overlap.
    pub edits: Vec<Edit>,
}

/// The replacement of a range of bytes.
#[derive(Clone, PartialEq, Debug)]
pub struct Edit {
    /// What is replaced; empty for an insertion.
    pub span: Span,
    /// The new text.
    pub text: String,
}

impl<M: Mistake> From<M> for Diagnostic {
    fn from(mistake: M) -> Self {
        Self {
            code: M::CODE,
            severity: M::SEVERITY,
            message: mistake.message(),
            help: mistake.help(),
            span: mistake.span(),
            path: String::new(),
            related: mistake.related(),
            fix: mistake.fix(),
            about: mistake.about(),
        }
    }
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
