//! What a request speaks of: a noun with its article, count, and what narrows it down.

use super::knowledge;
use super::spot::{Spot, is_way, spot};
use super::token::{Token, singular, stands};
use crate::english::{
    KIN, NARROWED_IS, NARROWED_LIKED, NOUN_ENDS, NOUN_OLD, NOUN_PLACE, PHRASE_SOMETHING, PRONOUNS,
};

/// Which of several things are meant.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Which {
    /// `the mug`: the one.
    The,
    /// `a mug`, `some chips`, `mug`: any.
    Any,
    /// `two sodas`
    Count(usize),
    /// `all mugs`, `every mug`, `both mugs`
    All,
}

/// What is spoken of.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Noun {
    /// `me`, `us`
    Speaker,
    /// `it`, `them`, `that`
    Before(&'static str),
    /// `here`
    Here,
    /// `there`
    There,
    /// Anything else.
    Phrase(Phrase),
}

/// A noun with what narrows it down.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Phrase {
    /// As it was said.
    pub(super) said: String,
    /// Its words in the singular; none for `something`.
    pub(super) words: Vec<String>,
    /// What is in it: the words behind the `of` of `a bottle of water`.
    pub(super) content: Vec<String>,
    pub(super) which: Which,
    /// Whether the noun was in the plural.
    pub(super) is_plural: bool,
    /// What it shall be good for.
    pub(super) good_for: Option<&'static str>,
    /// What it shall not be, or what it is.
    pub(super) is: Vec<(bool, Vec<String>)>,
    /// Where it is.
    pub(super) place: Option<Box<Spot>>,
    /// `something that I would like`
    pub(super) is_liked: bool,
}

/// A noun that begins at a place, and where it ends.
pub(super) fn noun(tokens: &[Token], at: usize) -> Option<(Noun, usize)> {
    let word = tokens.get(at)?.word();
    let next = tokens.get(at + 1).map_or("", Token::word);
    match word {
        "me" | "us" | "myself" => return Some((Noun::Speaker, at + 1)),
        "my" if NOUN_PLACE.has(next) => {
            return Some((Noun::Speaker, at + 2));
        }
        _ => {}
    }
    // `bring it to your old granny`: who says so of themselves.
    if word == "your"
        && let Some(kin) =
            (at + 1..at + 4).find(|at| tokens.get(*at).is_some_and(|token| KIN.has(token.word())))
        && tokens.get(at + 1..kin).is_some_and(|how| how.iter().all(|token| NOUN_OLD.has(token.word())))
    {
        return Some((Noun::Speaker, kin + 1));
    }
    let pronoun = PRONOUNS.value(word);
    if let Some(pronoun) = pronoun.filter(|_| matches!(word, "it" | "them") || ends(tokens, at + 1)) {
        return Some((Noun::Before(pronoun), at + 1));
    }
    match word {
        "here" => return Some((Noun::Here, at + 1)),
        "there" => return Some((Noun::There, at + 1)),
        _ => {}
    }
    phrase(tokens, at)
}

fn ends(tokens: &[Token], at: usize) -> bool {
    match tokens.get(at) {
        None | Some(Token::Comma | Token::Stop) => true,
        Some(Token::Word(word)) if word == "can" => stands(tokens, at, "can you").is_some(),
        Some(Token::Word(word)) => NOUN_ENDS.has(word.as_str()) || is_way(tokens, at),
    }
}

fn phrase(tokens: &[Token], begin: usize) -> Option<(Noun, usize)> {
    let (which, mut at) = determiner(tokens, begin);
    let mut words: Vec<String> = Vec::new();
    let mut content_at = None;
    let mut is_plural = false;
    let is_open = matches!(tokens.get(at).map_or("", Token::word), "something" | "anything" | "everything");
    let which = match tokens.get(at).map_or("", Token::word) {
        "everything" => Some(Which::All),
        "something" | "anything" => Some(Which::Any),
        _ => which,
    };
    if is_open {
        at += 1;
        if tokens.get(at).is_some_and(|token| token.word() == "else") {
            at += 1;
        }
    }
    while !ends(tokens, at) {
        let word = tokens.get(at).map_or("", Token::word);
        // `hand the guest the magazine`
        if PHRASE_SOMETHING.has(word) {
            break;
        }
        at += 1;
        if (word == "of" && !words.is_empty())
            || (words.is_empty() && matches!(word, "kind" | "sort" | "other"))
        {
            // `the door of the fridge` is no other thing than the fridge.
            if matches!(words.as_slice(), [part] if matches!(part.as_str(), "door" | "lid" | "handle")) {
                words.clear();
            }
            // `a bag of the chips`
            if words.last().is_some_and(|word| knowledge::is_package(word)) {
                content_at = Some(words.len());
            }
            at = determiner(tokens, at).1;
            continue;
        }
        let one = singular(word);
        is_plural = one != word;
        words.push(one);
    }
    if words.is_empty() && !is_open && which.is_none() {
        return None;
    }
    if words.is_empty() && !is_open && !matches!(which, Some(Which::All | Which::Count(_))) {
        return None;
    }
    let mut phrase = Phrase {
        said: String::new(),
        content: content_at.and_then(|at| words.get(at..)).unwrap_or_default().to_vec(),
        words,
        which: which.unwrap_or(Which::Any),
        is_plural,
        good_for: None,
        is: Vec::new(),
        place: None,
        is_liked: false,
    };
    if which.is_none() && !is_plural && !is_open {
        // `bring me sponge`: said in a hurry, and the one is meant as well as any.
        phrase.which = Which::Any;
    }
    let at = narrowed(tokens, at, &mut phrase);
    let said: Vec<_> = tokens.get(begin..at).unwrap_or_default().iter().map(Token::word).collect();
    phrase.said = said.join(" ");
    Some((Noun::Phrase(phrase), at))
}

/// What comes behind a noun and narrows it down: `to eat`, `that is not a fruit`, `I would like`, `that is on the table`.
fn narrowed(tokens: &[Token], mut at: usize, phrase: &mut Phrase) -> usize {
    loop {
        let word = tokens.get(at).map_or("", Token::word);
        let next = tokens.get(at + 1).map_or("", Token::word);
        if word == "to"
            && let Some(good_for) = knowledge::good_for(next)
        {
            phrase.good_for = Some(good_for);
            at = rest_of_use(tokens, at + 2);
            continue;
        }
        if let Some(count) = NARROWED_LIKED.longest(tokens, at) {
            phrase.is_liked = true;
            at += count;
            continue;
        }
        if let Some(count) = NARROWED_IS.longest(tokens, at) {
            let after = at + count;
            let (is_so, after) = match tokens.get(after).map_or("", Token::word) {
                "not" => (false, after + 1),
                _ => (true, after),
            };
            if let (true, Some((place, end))) = (is_so, spot(tokens, after)) {
                phrase.place = Some(Box::new(place));
                at = end;
                continue;
            }
            let begin = determiner(tokens, after).1;
            let mut end = begin;
            while !ends(tokens, end) {
                end += 1;
            }
            if end > begin {
                let words = tokens.get(begin..end).unwrap_or_default();
                let words = words.iter().map(|token| singular(token.word())).collect();
                phrase.is.push((is_so, words));
                at = end;
                continue;
            }
        }
        return at;
    }
}

/// `to clean it up with`: what still belongs to the use.
fn rest_of_use(tokens: &[Token], mut at: usize) -> usize {
    while let Some(Token::Word(word)) = tokens.get(at) {
        if matches!(word.as_str(), "and" | "then" | "please" | "from") {
            break;
        }
        at += 1;
    }
    at
}

/// An article or a count, and where the noun begins.
fn determiner(tokens: &[Token], at: usize) -> (Option<Which>, usize) {
    let word = tokens.get(at).map_or("", Token::word);
    // `the one that is blue`
    if word == "that" && tokens.get(at + 1).is_some_and(|next| matches!(next.word(), "is" | "are" | "was")) {
        return (None, at);
    }
    let which = match word {
        "the" | "this" | "that" | "my" | "your" | "our" | "his" | "her" | "their" => Which::The,
        "these" | "those" | "all" | "every" | "each" | "both" => Which::All,
        "a" | "an" | "some" | "any" | "another" => Which::Any,
        "one" => Which::Count(1),
        "two" => Which::Count(2),
        "three" => Which::Count(3),
        "four" => Which::Count(4),
        "five" => Which::Count(5),
        number => match number.parse::<usize>() {
            Ok(count @ 1..=9) if number.len() == 1 => Which::Count(count),
            _ => return (None, at),
        },
    };
    // `all the mugs`, `both of the mugs`, `one of the mugs`, `the two mugs`
    let mut at = at + 1;
    if tokens.get(at).is_some_and(|token| token.word() == "of") {
        at += 1;
    }
    match (which, determiner(tokens, at)) {
        (Which::All | Which::Count(_), (Some(Which::The | Which::All), after)) => (Some(which), after),
        (Which::The, (Some(Which::Count(_)), after)) => (Some(Which::All), after),
        (Which::Any, (Some(Which::Count(count)), after)) => (Some(Which::Count(count)), after),
        _ => (Some(which), at),
    }
}
