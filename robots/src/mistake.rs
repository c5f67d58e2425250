//! The one way in which cards and scenes declare their mistakes: a struct, a code, a message, and what else is known.

/// Declares structs that implement [`motet_syntax::Mistake`], and `CODES`, the list of their codes.
///
/// Each has a `span`; `help`, `related` and `fix` may be left out.
macro_rules! mistakes {
    ($(
        $(#[$doc:meta])+
        $name:ident($code:literal, $severity:ident) { $($field:ident: $ty:ty),* $(,)? }
        message($m:ident) $message:block
        $(help($h:ident) $help:block)?
        $(related($r:ident) $related:block)?
        $(fix($f:ident) $fix:block)?
    )*) => {
        /// Every code that is raised here, in order.
        pub const CODES: &[motet_syntax::Code] = &[$(motet_syntax::Code($code)),*];
        $(
            $(#[$doc])+
            #[derive(Clone, Debug)]
            pub(crate) struct $name {
                pub(crate) span: motet_syntax::Span,
                $(pub(crate) $field: $ty,)*
            }
            impl motet_syntax::Mistake for $name {
                const CODE: motet_syntax::Code = motet_syntax::Code($code);
                const SEVERITY: motet_syntax::Severity = motet_syntax::Severity::$severity;
                fn span(&self) -> motet_syntax::Span {
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
                $(fn related(&self) -> Vec<motet_syntax::Related> {
                    let $r = self;
                    $related
                })?
                $(fn fix(&self) -> Option<motet_syntax::Fix> {
                    let $f = self;
                    $fix
                })?
            }
        )*
    };
}

pub(crate) use mistakes;
