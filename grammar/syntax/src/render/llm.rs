//! Diagnostics as plain sentences for the next prompt of a language model: no source, the most useful first,
//! each short.

use std::fmt::Write as _;

use indexmap::{IndexMap, IndexSet};

use super::escaped;
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Sources;

/// The most characters of one finding: at four characters a token, the rule of thumb for English with
/// byte-pair encodings, these are 80 tokens.
pub const MAX_CHARS: usize = 320;

/// One line a finding, at most 50 of them: errors in the order in which the steps run, the goal after them,
/// then warnings and notes. What several steps have in common is told once, with all of them. A syntax error
/// has no step, but the number of its line in `sources`, if it is there.
#[must_use]
pub fn llm(diagnostics: &[Diagnostic], sources: &Sources) -> String {
    let mut order: Vec<&Diagnostic> = diagnostics.iter().collect();
    order.sort_by_key(|said| (std::cmp::Reverse(said.severity), rank(said), said.span));
    let mut text = String::new();
    let mut told: IndexMap<FindingKey<'_>, IndexSet<DocumentPlace>> = IndexMap::new();
    for said in order {
        let advice = said.fix.as_ref().map(|fix| &fix.title).or(said.help.as_ref());
        let place = place_of(&said.path).or_else(|| line_of(said, sources));
        let kind = place.as_ref().map(DocumentPlace::kind);
        let key = (said.severity, said.message.as_str(), advice.map(String::as_str), kind);
        let places = told.entry(key).or_default();
        places.extend(place);
    }
    let more = told.len().saturating_sub(MAX_LINES);
    for ((severity, message, advice, _), places) in told.into_iter().take(MAX_LINES) {
        line(&mut text, severity, message, advice, &places.into_iter().collect::<Vec<_>>());
    }
    if more > 0 {
        let _ = writeln!(text, "There are {more} more findings.");
    }
    escaped(&text)
}

/// Severity, message and advice of a finding, and the kind of its place.
type FindingKey<'d> = (Severity, &'d str, Option<&'d str>, Option<&'d str>);

/// Place of a finding in a document.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
enum DocumentPlace {
    /// A step, such as `2.then.1`, or `finally.1` in the cleanup of the policy.
    Step(String),
    /// A rule of the policy, such as `keep.1`.
    Rule(String),
    /// A line, from 1.
    Line(usize),
}

impl DocumentPlace {
    fn kind(&self) -> &'static str {
        match self {
            Self::Step(_) => "Step",
            Self::Rule(_) => "Rule",
            Self::Line(_) => "Line",
        }
    }
}

impl std::fmt::Display for DocumentPlace {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Step(label) | Self::Rule(label) => f.write_str(label),
            Self::Line(number) => write!(f, "{number}"),
        }
    }
}

/// Step or rule that a path leads to.
fn place_of(path: &str) -> Option<DocumentPlace> {
    let label = step_label(path)?;
    Some(if label.starts_with(KEEP) { DocumentPlace::Rule(label) } else { DocumentPlace::Step(label) })
}

/// Line of a mistake in the syntax, which belongs to no step.
fn line_of(said: &Diagnostic, sources: &Sources) -> Option<DocumentPlace> {
    let source = sources.get(said.span.file).filter(|_| said.code.0.starts_with("M01"))?;
    Some(DocumentPlace::Line(source.line_column(said.span.start).0))
}

/// Rank of a diagnostic: the document as a whole first, then its steps, then its goal.
fn rank(said: &Diagnostic) -> u8 {
    match said.path.as_str() {
        path if path.starts_with("/steps") => 1,
        path if path.starts_with("/achieves") => 2,
        _ if said.code.0 == "M0503" => 2,
        // The steps of a document in another shape have another key, or none.
        path if !step_pointer(path).is_empty() => 1,
        _ => 0,
    }
}

/// The most findings that are told.
const MAX_LINES: usize = 50;
/// The most steps that one finding names.
const MAX_PLACES: usize = 5;

fn line(
    text: &mut String,
    severity: Severity,
    message: &str,
    advice: Option<&str>,
    places: &[DocumentPlace],
) {
    let kind = match severity {
        Severity::Error => "",
        Severity::Warning => "Warning: ",
        Severity::Note => "Note: ",
    };
    let sentence = match place(places) {
        Some(place) => format!("{kind}{place}: {message}."),
        None if kind.is_empty() => format!("{}.", capital(message)),
        None => format!("{kind}{}.", capital(message)),
    };
    let sentence = shorter(&sentence, MAX_CHARS);
    text.push_str(&sentence);
    let room = MAX_CHARS.saturating_sub(sentence.chars().count() + 2);
    if let Some(advice) = advice.filter(|advice| advice.chars().count() < room) {
        let advice = capital(advice);
        let end = if advice.ends_with(['.', '?', '!']) { "" } else { "." };
        // Writing to a string cannot fail.
        let _ = write!(text, " {advice}{end}");
    }
    text.push('\n');
}

/// `Step 2`, `Steps 2, 4.then.1 and 5`; `None` without a place.
fn place(places: &[DocumentPlace]) -> Option<String> {
    let (last, rest) = places.split_last()?;
    let kind = last.kind();
    if rest.is_empty() {
        return Some(format!("{kind} {last}"));
    }
    let joined =
        |places: &[DocumentPlace]| places.iter().map(DocumentPlace::to_string).collect::<Vec<_>>().join(", ");
    Some(match (places.get(..MAX_PLACES), places.len().saturating_sub(MAX_PLACES)) {
        (Some(first), more @ 1..) => format!("{kind}s {} and {more} more", joined(first)),
        _ => format!("{kind}s {} and {last}", joined(rest)),
    })
}

/// On one line and cut at a word, where it is longer than it may be.
fn shorter(text: &str, most: usize) -> String {
    let mut short = String::new();
    let mut used = 0;
    for word in text.split_whitespace() {
        let long = word.chars().count() + usize::from(used > 0);
        if used + long + 2 > most {
            // A single word may be longer than the line.
            if used == 0 {
                short.extend(word.chars().take(most.saturating_sub(2)));
            }
            short.push_str(" …");
            break;
        }
        if used > 0 {
            short.push(' ');
        }
        short.push_str(word);
        used += long;
    }
    short
}

/// With a capital letter at the beginning.
#[must_use]
pub fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map(|first| first.to_uppercase().chain(chars).collect()).unwrap_or_default()
}

/// The pointer of the innermost step: `/steps/1/then/0` of `/steps/1/then/0/object`.
fn step_pointer(path: &str) -> &str {
    let mut end = 0;
    let mut at = 0;
    for part in path.split('/').skip(1) {
        at += 1 + part.len();
        if part.bytes().all(|byte| byte.is_ascii_digit()) && !part.is_empty() {
            end = at;
        }
    }
    path.get(..end).unwrap_or_default()
}

/// `2.then.1` of `/steps/1/then/0/object`: numbers from 1, `steps` left unsaid.
fn step_label(path: &str) -> Option<String> {
    let parts: Vec<String> = step_pointer(path)
        .split('/')
        .enumerate()
        .filter(|(depth, part)| !part.is_empty() && *part != "steps" && !(*depth == 1 && is_list(part)))
        .map(|(_, part)| part)
        .map(|part| part.parse::<usize>().map_or_else(|_| part.to_owned(), |index| (index + 1).to_string()))
        .collect();
    (!parts.is_empty()).then(|| parts.join("."))
}

/// Checks if the key of a document is another one for its steps.
fn is_list(key: &str) -> bool {
    !["achieves", FINALLY, KEEP].contains(&key) && key.parse::<usize>().is_err()
}

/// Key of the cleanup of a policy.
const FINALLY: &str = "finally";
/// Key of the rules of a policy.
const KEEP: &str = "keep";

#[cfg(test)]
mod tests {
    use super::{shorter, step_label};

    #[test]
    fn llm_numbers_steps_from_one() {
        for (path, label) in [
            ("", None),
            ("/achieves", None),
            ("/steps/2", Some("3")),
            ("/2", Some("3")),
            ("/plan/2/args/object", Some("3")),
            ("/finally/1/object", Some("finally.2")),
            ("/keep/1/out_of", Some("keep.2")),
            ("/steps/0/finally/1", Some("1.finally.2")),
            ("/steps/1/then/0/object", Some("2.then.1")),
            ("/steps/0/catch/1/steps/0", Some("1.catch.2.1")),
            ("/steps/0/monitor/0/when/less/1", Some("1.monitor.1.when.less.2")),
        ] {
            assert_eq!(step_label(path).as_deref(), label, "{path}");
        }
    }

    #[test]
    fn llm_cuts_long_sentences_at_a_word() {
        assert_eq!(shorter("one two\nthree", 80), "one two three");
        assert_eq!(shorter("one two three", 9), "one two …");
        assert_eq!(shorter("abcdefghij", 6), "abcd …");
    }
}
