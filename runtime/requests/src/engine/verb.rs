//! The verbs of household requests and their forms: `bring`, `bringing`, `brought`.

use crate::engine::asking::{skip_leads, wish};
use crate::engine::english::{
    APART_VERBS, BINS, CLAUSE_JOINTS, NO_THING, PARTICIPLES, PASTS, TAKE_HOLD, VAGUE_VERBS, VERB,
    WANTED_LATER,
};
use crate::engine::noun::noun;
use crate::engine::token::{Token, words};

/// The act that a verb asks for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Act {
    Go,
    /// Come to the person.
    Come,
    /// Bring something to someone.
    Fetch,
    /// Take into the hand.
    Pick,
    /// Raise in the hand.
    Lift,
    Put,
    /// Take: to a place, or into the hand.
    Take,
    /// Put where it belongs.
    Stow,
    /// Put into something in which things are kept.
    Store,
    Discard,
    /// Throw: to a place, to someone, or away.
    Throw,
    /// Let go of.
    Release,
    Open,
    Close,
    /// Move: something to a place, or oneself.
    Move,
    /// Find out where something is.
    Find,
}

impl Act {
    /// The act of a name in the list of verbs.
    pub(crate) fn named(name: &str) -> Option<Self> {
        Some(match name {
            "go" => Self::Go,
            "come" => Self::Come,
            "fetch" => Self::Fetch,
            "pick" => Self::Pick,
            "lift" => Self::Lift,
            "put" => Self::Put,
            "take" => Self::Take,
            "stow" => Self::Stow,
            "store" => Self::Store,
            "discard" => Self::Discard,
            "throw" => Self::Throw,
            "release" => Self::Release,
            "open" => Self::Open,
            "close" => Self::Close,
            "move" => Self::Move,
            "find" => Self::Find,
            _ => return None,
        })
    }
}

/// The verb that stands at a place, and where its object begins.
pub(crate) fn verb(tokens: &[Token], at: usize) -> Option<(Act, usize)> {
    // `the table, trash can and shelf`: a noun, for want of an object.
    let is_last = tokens.get(at + 1).is_none_or(|next| next.word().is_empty());
    if BINS.valued(tokens, at).is_some_and(|(count, _)| count > 1 || is_last) {
        return None;
    }
    // `take care of it` says nothing of what to do with it.
    if VAGUE_VERBS.longest(tokens, at).is_some() {
        return None;
    }
    let wants = wanted(tokens, at).map(|after| (Act::Fetch, after));
    let verb = VERB.valued(tokens, at).and_then(|(count, act)| Some((Act::named(act)?, at + count)));
    let holds = TAKE_HOLD.longest(tokens, at).map(|count| (Act::Pick, at + count));
    verb.into_iter().chain(wants).chain(holds).max_by_key(|(_, after)| *after)
}

/// `lock it away`, `track it down`: the verb with its small word behind the thing, and where what is read
/// ends.
pub(crate) fn apart(tokens: &[Token], at: usize) -> Option<(usize, Vec<Token>)> {
    let word = tokens.get(at)?.word();
    let (_, after) = noun(tokens, at + 1).filter(|_| APART_VERBS.begins_with(word))?;
    // The verb and what follows the thing, as if they stood together.
    let together: Vec<Token> =
        tokens.get(at..=at)?.iter().chain(tokens.get(after..)?).take(3).cloned().collect();
    let (count, means) = APART_VERBS.valued(&together, 0)?;
    Some((after + count - 1, [words(means).as_slice(), tokens.get(at + 1..after)?].concat()))
}

/// Finds where what somebody wants to have begins, where they want it now.
fn wanted(tokens: &[Token], at: usize) -> Option<usize> {
    let after = at + wish(tokens, at)?;
    // `I will need it later` tells of another time.
    let is_end = |token: &&Token| {
        matches!(token, Token::Comma | Token::Stop)
            || CLAUSE_JOINTS.has(token.word())
            || token.word() == "because"
    };
    let clause = tokens.get(after..)?.iter().take_while(|token| !is_end(token));
    let is_later = clause.clone().any(|token| WANTED_LATER.has(token.word()));
    // `to open it`, `your help`: what somebody wants to do, or wants of somebody.
    (!is_later && NO_THING.longest(tokens, after).is_none()).then_some(after)
}

/// True if it is a wish that stands here, and no verb.
pub(crate) fn is_want(tokens: &[Token], at: usize) -> bool {
    wanted(tokens, at).is_some()
}

/// True if a request begins here, after what politeness puts before it.
pub(crate) fn begins(tokens: &[Token], at: usize) -> bool {
    verb(tokens, skip_leads(tokens, at)).is_some()
}

/// An inflection of a verb.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Inflection {
    Base,
    Gerund,
    Participle,
}

/// The verb of a request of which a word is the past: `if you took it`.
pub(crate) fn of_past(word: &str) -> Option<String> {
    if let Some(verb) = PASTS.value(word) {
        return Some(verb.to_owned());
    }
    base(word).filter(|(_, form)| *form == Inflection::Participle).map(|(verb, _)| verb)
}

/// A verb of a request by one of its forms: `fetching`, `placing`, `putting`, `carried`.
pub(crate) fn base(word: &str) -> Option<(String, Inflection)> {
    if let Some(verb) = PARTICIPLES.value(word) {
        return Some((verb.to_owned(), Inflection::Participle));
    }
    if VERB.begins_with(word) {
        return Some((word.to_owned(), Inflection::Base));
    }
    let stem_of = |ending: &str| word.strip_suffix(ending).and_then(stem);
    let gerund = stem_of("ing").map(|verb| (verb, Inflection::Gerund));
    let participle = || {
        let with_y = word.strip_suffix("ied").map(|stem| format!("{stem}y"));
        stem_of("ed").or_else(|| with_y.filter(|verb| VERB.begins_with(verb)))
    };
    gerund.or_else(|| participle().map(|verb| (verb, Inflection::Participle)))
}

/// The verb of which a word without its ending is the stem: itself, with an `e`, or with its last letter
/// once.
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
    use super::{Inflection, base, of_past};

    #[test]
    fn base_of_regular_and_irregular_forms() {
        for (word, verb, form) in [
            ("fetching", "fetch", Inflection::Gerund),
            ("placing", "place", Inflection::Gerund),
            ("putting", "put", Inflection::Gerund),
            ("carried", "carry", Inflection::Participle),
            ("brought", "bring", Inflection::Participle),
            ("put", "put", Inflection::Base),
        ] {
            assert_eq!(base(word), Some((verb.to_owned(), form)), "{word}");
        }
        assert_eq!(base("table"), None);
        assert_eq!(of_past("took").as_deref(), Some("take"));
    }
}
