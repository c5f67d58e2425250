//! Reasons of the checker against words that names and types alone would allow.

use motet_compiler::Signatures;
use motet_compiler::signature::{ParamSignature, Type};
use motet_decode::Acceptor;
use motet_syntax::Diagnostic;

use super::next::Next;
use super::place::PrefixEnd;

/// Maximum number of argument lists that are tried for a reason.
const ATTEMPTS: usize = 8;

/// Describes the refused words, each with a reason.
pub(super) fn refused(acceptor: &Acceptor, signatures: &Signatures, next: &Next) -> String {
    let place = PrefixEnd::of(acceptor.bytes());
    let offered = |word: &str| {
        let rest = word.strip_prefix(place.started.as_str()).unwrap_or(word);
        next.words.iter().any(|offered| offered.trim_start_matches(['{', '[', '"']) == rest)
    };
    let words: Vec<&str> = place.words(signatures).into_iter().filter(|word| !offered(word)).collect();
    if words.is_empty() {
        return String::new();
    }
    let width = words.iter().map(|word| word.chars().count()).max().unwrap_or_default().min(24);
    let mut text = "may not:\n".to_owned();
    for word in words {
        text.push_str(&format!("  {word:width$}  {}\n", reason(acceptor, signatures, &place, word)));
    }
    text
}

fn reason(acceptor: &Acceptor, signatures: &Signatures, place: &PrefixEnd, word: &str) -> String {
    if place.is_call() || place.is_argument() {
        let callable = if place.is_call() { word } else { place.name.as_str() };
        let rest = word.strip_prefix(place.started.as_str()).unwrap_or(word);
        for attempt in attempts(signatures, place, callable) {
            let why = acceptor.why_not(format!("{rest}\"{attempt}").as_bytes());
            if let Some(found) = about(&why, callable) {
                return format!("{}: {}", found.code, found.message);
            }
        }
        return "no argument makes it valid".to_owned();
    }
    let fluent = signatures.fluent(word).filter(|fluent| !fluent.is_observable);
    let measure = signatures.measure(word).filter(|measure| !measure.is_observable);
    if place.key == "is" && fluent.is_some() || place.key == "get" && measure.is_some() {
        return "the robot does not observe it".to_owned();
    }
    "no argument makes it valid".to_owned()
}

/// Diagnostic about a call, or else the first one.
fn about<'w>(why: &'w [Diagnostic], callable: &str) -> Option<&'w Diagnostic> {
    let is_about = |found: &&Diagnostic| {
        found.about.as_ref().and_then(|about| about.primitive.as_deref()) == Some(callable)
            || found.message.contains(&format!("`{callable}`"))
    };
    why.iter().find(is_about).or_else(|| why.first())
}

/// Possible rests of the call after the word.
fn attempts(signatures: &Signatures, place: &PrefixEnd, callable: &str) -> Vec<String> {
    let Some(callable) = signatures.callable(callable) else { return Vec::new() };
    let given = callable.params.iter().position(|param| param.name == place.key).map_or(0, |given| given + 1);
    let params = callable.params.get(given..).unwrap_or_default();
    let mut written = vec![String::new()];
    for param in params {
        let values = values(signatures, param);
        let with = |before: &String| {
            let values: Vec<String> =
                values.iter().map(|value| format!("{before},\"{}\":{value}", param.name)).collect();
            values
        };
        written = written.iter().flat_map(with).take(ATTEMPTS).collect();
    }
    let bound = if callable.result.is_some() { ",\"as\":\"it\"" } else { "" };
    written.iter().map(|arguments| format!("{arguments}{bound}}}")).collect()
}

/// Sample values of a parameter, as JSON.
fn values(signatures: &Signatures, param: &ParamSignature) -> Vec<String> {
    let quoted = |name: &smol_str::SmolStr| format!("\"{name}\"");
    match &param.ty {
        Type::Entity(kind) => signatures.entities_of(*kind).take(ATTEMPTS).map(quoted).collect(),
        Type::Enum(id) => {
            let cases = signatures.enums.get(*id).map(|id| id.cases.iter().take(1).map(quoted));
            cases.into_iter().flatten().collect()
        }
        Type::Text => vec!["\"something\"".to_owned()],
        Type::Bool => vec!["true".to_owned()],
        Type::Int | Type::Number | Type::Quantity(_) => {
            vec![param.range.map_or(1.0, |(least, _)| least).to_string()]
        }
        Type::Pose | Type::List(_) => Vec::new(),
    }
}
