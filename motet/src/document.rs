//! Documents as commands and other hosts take them: bytes to a syntax tree, a check with the notes on what is
//! left to the run, and the document in either syntax.

use motet_compiler::{DocumentCheck, Library, make_explicit};
use motet_project::files::{Bytes, decode};
use motet_project::{DOCUMENT, ProjectSession};
use motet_syntax::ast::{self, Item, Policy};
use motet_syntax::diagnostics::too_large;
use motet_syntax::{Diagnostic, Parsed, Severity, Source, Span, Syntax, print};

/// Maximum number of fixes that are applied to one document.
pub const MAX_FIXES: usize = 100;

/// Parses a document. Bytes that are not text, or are too many, are diagnostics. `line_of` is the file and
/// the number of the line that holds the document, from 1, where it has no file of its own.
///
/// ```
/// use motet::project::files::Bytes;
///
/// let bytes = Bytes::All(b"policy greet { say(\"Hello!\") }".to_vec());
/// let (source, parsed) = motet::document::parse("greet.motet", &bytes, None);
/// assert_eq!(&*source.name, "greet.motet");
/// assert!(parsed.diagnostics.is_empty());
/// ```
#[must_use]
pub fn parse(name: &str, bytes: &Bytes, line_of: Option<(&str, usize)>) -> (Source, Parsed) {
    parse_as(name, bytes, line_of, |source| motet_syntax::read(source, DOCUMENT))
}

/// Parses a document of another language, as [`parse`] does.
#[must_use]
pub fn parse_as(
    name: &str,
    bytes: &Bytes,
    line_of: Option<(&str, usize)>,
    read: impl FnOnce(&Source) -> Parsed,
) -> (Source, Parsed) {
    let with_line = |source: Source| match line_of {
        Some((file, line)) => source.as_line(file, line),
        None => source,
    };
    match bytes {
        Bytes::All(bytes) => {
            let (source, diagnostics) = decode(name, bytes, DOCUMENT);
            let source = with_line(source);
            let parsed = match diagnostics.is_empty() {
                true => read(&source),
                false => unparsed(diagnostics),
            };
            (source, parsed)
        }
        Bytes::TooMany(bytes) => {
            let mistake = too_large(Span::new(DOCUMENT, 0, 0), *bytes);
            (with_line(Source::new(name, "")), unparsed(vec![mistake]))
        }
    }
}

/// Result of parsing a document that is not text.
fn unparsed(diagnostics: Vec<Diagnostic>) -> Parsed {
    let file = ast::File::default();
    Parsed { file, syntax: Syntax::Text, text: Default::default(), diagnostics, written: None }
}

/// Is `true` for a document that has errors of syntax.
#[must_use]
pub fn is_broken(parsed: &Parsed) -> bool {
    parsed.diagnostics.iter().any(|found| found.severity == Severity::Error)
}

/// Is `true` for a reply with prose around its policy, which a rewritten document would lose.
#[must_use]
pub fn is_reply(parsed: &Parsed) -> bool {
    parsed.diagnostics.iter().any(|found| found.code.0 == "M0116")
}

/// Diagnostics of a check with the notes on what is left to the run, if there is a scene: without one nearly
/// everything is left. `denies_deferred` lists the notes in any case.
#[must_use]
pub fn listed(checked: DocumentCheck, opened: &ProjectSession, denies_deferred: bool) -> Vec<Diagnostic> {
    let lists_left = denies_deferred || opened.scene.is_some();
    let left = checked.deferred_notes.into_iter().filter(|_| lists_left);
    checked.diagnostics.into_iter().chain(left).collect()
}

/// Writes a document, or one policy of it, in a syntax.
///
/// # Errors
///
/// A clause that says why: there is no such policy, or JSON cannot hold the declarations.
pub fn write(
    parsed: &Parsed,
    policy: Option<&str>,
    library: &Library,
    syntax: Syntax,
) -> Result<String, String> {
    let mut file = parsed.file.clone();
    if let Some(name) = policy {
        file.items.retain(|item| matches!(item, Item::Policy(policy) if policy.name.text == name));
        if file.items.is_empty() {
            return Err(format!("there is no policy `{name}`"));
        }
    }
    for item in &mut file.items {
        if let Item::Policy(policy) = item {
            make_explicit(policy, library, syntax);
        }
    }
    match syntax {
        Syntax::Text => Ok(print::text(&file)),
        Syntax::Json => Ok(print::policy_json(only(&file.items)?)),
    }
}

/// Only policy of a document, which has no parameters.
fn only(items: &[Item]) -> Result<&Policy, String> {
    let rule = "a JSON document holds exactly one policy without parameters";
    match items {
        [Item::Policy(policy)] if policy.params.is_empty() => Ok(policy),
        [Item::Policy(policy)] => Err(format!("`{}` has parameters, and {rule}", policy.name.text)),
        [] => Err(format!("there is no policy, and {rule}")),
        [_] => Err(format!("there is no policy but another declaration, and {rule}")),
        more => Err(format!("there are {} declarations, and {rule}", more.len())),
    }
}
