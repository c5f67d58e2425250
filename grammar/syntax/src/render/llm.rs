//! Diagnostics as plain sentences for the next prompt of a language model: no source, the most useful first,
//! each short.

use std::fmt::Write as _;

use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Sources;

/// The most characters of one finding: at four characters a token, the rule of thumb for English with
/// byte-pair encodings, these are 80 tokens.
pub const MAX_CHARS: usize = 320;

/// One line a finding: errors in the order in which the steps run, the goal after them, then warnings and
/// notes. Of several errors of one step only the first is told, since the others mostly follow from it.
#[must_use]
pub fn llm(diagnostics: &[Diagnostic], _sources: &Sources) -> String {
    let mut order: Vec<&Diagnostic> = diagnostics.iter().collect();
    order.sort_by_key(|said| (std::cmp::Reverse(said.severity), rank(said), said.span));
    let mut text = String::new();
    let mut told: Vec<&str> = Vec::new();
    for said in order {
        let step = step_pointer(&said.path);
        if said.severity == Severity::Error && !step.is_empty() {
            if told.contains(&step) {
                continue;
            }
            told.push(step);
        }
        line(&mut text, said);
    }
    text
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

fn line(text: &mut String, said: &Diagnostic) {
    let place = step_label(&said.path);
    let mut sentence = match said.severity {
        Severity::Error => String::new(),
        Severity::Warning => "Warning: ".to_owned(),
        Severity::Note => "Note: ".to_owned(),
    };
    // Writing to a string cannot fail.
    let _ = match place {
        Some(place) => write!(sentence, "{place}: {}.", said.message),
        None => write!(sentence, "{}.", capital(&said.message)),
    };
    let advice = said.fix.as_ref().map(|fix| &fix.title).or(said.help.as_ref());
    let sentence = shorter(&sentence, MAX_CHARS);
    text.push_str(&sentence);
    let room = MAX_CHARS.saturating_sub(sentence.chars().count() + 2);
    if let Some(advice) = advice.filter(|advice| advice.chars().count() < room) {
        let advice = capital(advice);
        let end = if advice.ends_with(['.', '?', '!']) { "" } else { "." };
        let _ = write!(text, " {advice}{end}");
    }
    text.push('\n');
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

/// `step 2.then.1` of `/steps/1/then/0/object`: numbers from 1, `steps` left unsaid.
fn step_label(path: &str) -> Option<String> {
    let parts: Vec<String> = step_pointer(path)
        .split('/')
        .enumerate()
        .filter(|(depth, part)| !part.is_empty() && *part != "steps" && !(*depth == 1 && is_list(part)))
        .map(|(_, part)| part)
        .map(|part| part.parse::<usize>().map_or_else(|_| part.to_owned(), |index| (index + 1).to_string()))
        .collect();
    (!parts.is_empty()).then(|| format!("Step {}", parts.join(".")))
}

/// Checks if the key of a document is another one for its steps.
fn is_list(key: &str) -> bool {
    key != "achieves" && key.parse::<usize>().is_err()
}

#[cfg(test)]
mod tests {
    use super::{shorter, step_label};

    #[test]
    fn llm_numbers_steps_from_one() {
        for (path, label) in [
            ("", None),
            ("/achieves", None),
            ("/steps/2", Some("Step 3")),
            ("/2", Some("Step 3")),
            ("/plan/2/args/object", Some("Step 3")),
            ("/steps/1/then/0/object", Some("Step 2.then.1")),
            ("/steps/0/catch/1/steps/0", Some("Step 1.catch.2.1")),
            ("/steps/0/monitor/0/when/less/1", Some("Step 1.monitor.1.when.less.2")),
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
