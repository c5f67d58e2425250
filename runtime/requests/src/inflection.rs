//! The forms of verbs: `bring`, `bringing`, `brought`.

use super::lexicon::VERBS;

/// How a verb is inflected.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Form {
    /// `put`
    Base,
    /// `putting`
    Gerund,
    /// `brought`
    Participle,
}

/// Participles that no rule makes.
const PARTICIPLES: &[(&str, &str)] = &[
    ("brought", "bring"),
    ("taken", "take"),
    ("thrown", "throw"),
    ("given", "give"),
    ("held", "hold"),
    ("left", "leave"),
    ("kept", "keep"),
    ("laid", "lay"),
    ("stuck", "stick"),
    ("hidden", "hide"),
    ("found", "find"),
    ("slid", "slide"),
];

/// Pasts that are neither made by a rule nor participles.
const PASTS: &[(&str, &str)] = &[
    ("took", "take"),
    ("threw", "throw"),
    ("gave", "give"),
    ("hid", "hide"),
    ("got", "get"),
    ("went", "go"),
    ("came", "come"),
    ("drove", "drive"),
    ("ran", "run"),
    ("stood", "stand"),
    ("sent", "send"),
    ("set", "set"),
    ("put", "put"),
    ("shut", "shut"),
    ("let", "let"),
    ("made", "make"),
    ("hung", "hang"),
];

/// The verb of a request of which a word is the past: `if you took it`.
pub(super) fn of_past(word: &str) -> Option<String> {
    if let Some((_, verb)) = PASTS.iter().find(|(known, _)| *known == word) {
        return Some((*verb).to_owned());
    }
    base(word).filter(|(_, form)| *form == Form::Participle).map(|(verb, _)| verb)
}

/// A verb of a request by one of its forms.
pub(super) fn base(word: &str) -> Option<(String, Form)> {
    if let Some((_, verb)) = PARTICIPLES.iter().find(|(known, _)| *known == word) {
        return Some(((*verb).to_owned(), Form::Participle));
    }
    let mut verbs = VERBS.iter().filter_map(|(verb, _)| verb.split(' ').next());
    verbs.find_map(|verb| {
        let form = if verb == word {
            Form::Base
        } else if has_ending(word, verb, "ing") {
            Form::Gerund
        } else if has_ending(word, verb, "ed") {
            Form::Participle
        } else {
            return None;
        };
        Some((verb.to_owned(), form))
    })
}

/// Whether a word is a verb with an ending: `fetching`, `placing`, `putting`, `carried`.
fn has_ending(word: &str, verb: &str, ending: &str) -> bool {
    let Some(stem) = word.strip_suffix(ending) else { return false };
    let doubled = || {
        let last = verb.chars().last();
        stem.strip_prefix(verb).is_some_and(|rest| rest.chars().count() == 1 && rest.chars().last() == last)
    };
    let without_e = || verb.strip_suffix('e') == Some(stem);
    let with_i =
        || ending == "ed" && verb.strip_suffix('y').is_some_and(|y| stem.strip_suffix('i') == Some(y));
    stem == verb || doubled() || without_e() || with_i()
}
