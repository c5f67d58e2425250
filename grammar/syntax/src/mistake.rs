//! The one way in which cards, scenes and the compiler's stages declare their mistakes: a struct, a code, a message, and
//! what else is known.

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
