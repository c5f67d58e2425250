//! Mistakes in PDDL documents, and parts of PDDL that are not supported (M013x).

use smol_str::SmolStr;

motet_syntax::mistakes! {
    pub const CODES;

    /// A file that is not PDDL as its grammar has it.
    Malformed("M0131", Error) { wanted: String, found: String }
    message(m) { format!("{} is asked for, and this is {}", m.wanted, m.found) }
    help(_m) {
        let help = "a domain is `(define (domain …) …)`, a problem `(define (problem …) …)`, \
                    a plan an `(action …)` a line";
        Some(help.to_owned())
    }

    /// A part of PDDL that is not imported.
    Unsupported("M0132", Error) { what: String }
    message(m) { format!("{} cannot be imported", m.what) }
    help(_m) {
        let help = "the import supports `:strips`, `:typing`, `:negative-preconditions`, `:equality` and \
                    `:conditional-effects`";
        Some(help.to_owned())
    }

    /// A name that is not declared, or has another kind than its place asks for.
    WrongName("M0133", Error) { what: String, help: Option<String> }
    message(m) { m.what.clone() }
    help(m) { m.help.clone() }
}

/// Reports an unknown name, "there is no predicate `x`", with the closest known one.
pub(crate) fn unknown<'k>(
    span: motet_syntax::Span,
    kind: &str,
    name: &SmolStr,
    known: impl IntoIterator<Item = &'k str>,
) -> WrongName {
    let near = motet_syntax::suggest::closest(name, known);
    let help = near.map(|near| format!("did you mean `{near}`?"));
    WrongName { span, what: format!("there is no {kind} `{name}`"), help }
}
