//! The forms of verbs: `bring`, `bringing`, `brought`.

use crate::english::{PARTICIPLES, PASTS, VERB};

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

/// The verb of a request of which a word is the past: `if you took it`.
pub(super) fn of_past(word: &str) -> Option<String> {
    if let Some(verb) = PASTS.value(word) {
        return Some(verb.to_owned());
    }
    base(word).filter(|(_, form)| *form == Form::Participle).map(|(verb, _)| verb)
}

/// A verb of a request by one of its forms: `fetching`, `placing`, `putting`, `carried`.
pub(super) fn base(word: &str) -> Option<(String, Form)> {
    if let Some(verb) = PARTICIPLES.value(word) {
        return Some((verb.to_owned(), Form::Participle));
    }
    if VERB.begins_with(word) {
        return Some((word.to_owned(), Form::Base));
    }
    let stem_of = |ending: &str| word.strip_suffix(ending).and_then(stem);
    let gerund = stem_of("ing").map(|verb| (verb, Form::Gerund));
    let participle = || {
        let with_y = word.strip_suffix("ied").map(|stem| format!("{stem}y"));
        stem_of("ed").or_else(|| with_y.filter(|verb| VERB.begins_with(verb)))
    };
    gerund.or_else(|| participle().map(|verb| (verb, Form::Participle)))
}

/// The verb of which a word without its ending is the stem: itself, with an `e`, or with its last letter once.
fn stem(stem: &str) -> Option<String> {
    let doubled = || {
        let mut letters = stem.chars();
        let last = letters.next_back();
        let once = letters.as_str();
        (last.is_some() && last == once.chars().last()).then(|| once.to_owned())
    };
    let is_verb = |verb: &String| VERB.begins_with(verb);
    Some(stem.to_owned())
        .filter(is_verb)
        .or_else(|| doubled().filter(is_verb))
        .or_else(|| Some(format!("{stem}e")).filter(is_verb))
}

#[cfg(test)]
mod tests {
    use super::{Form, base, of_past};

    #[test]
    fn base_of_regular_and_irregular_forms() {
        for (word, verb, form) in [
            ("fetching", "fetch", Form::Gerund),
            ("placing", "place", Form::Gerund),
            ("putting", "put", Form::Gerund),
            ("carried", "carry", Form::Participle),
            ("brought", "bring", Form::Participle),
            ("put", "put", Form::Base),
        ] {
            assert_eq!(base(word), Some((verb.to_owned(), form)), "{word}");
        }
        assert_eq!(base("table"), None);
        assert_eq!(of_past("took").as_deref(), Some("take"));
    }
}
