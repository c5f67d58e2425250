//! What would be nice, asked for in a clause with `if`: `I would be ever so grateful if you brought me the coke`, `it would
//! help if the drawer were shut`.

use crate::inflection::{Form, base, of_past};
use crate::token::{Token, run, stands};
use crate::verb::begins;

/// How it begins.
const BEGINS: &[&str] = &[
    "i would",
    "we would",
    "it would",
    "that would",
    "i will",
    "it is",
    "would it be",
    "is it",
    "i am",
    "i should",
    "you would",
    "you will",
];
/// What is said of it before the `if`.
const NICE: &[&str] = &[
    "be",
    "look",
    "nicer",
    "tidier",
    "neater",
    "feel",
    "love",
    "like",
    "appreciate",
    "prefer",
    "it",
    "that",
    "ever",
    "so",
    "very",
    "really",
    "much",
    "most",
    "more",
    "quite",
    "a",
    "an",
    "the",
    "great",
    "good",
    "nice",
    "lovely",
    "big",
    "huge",
    "real",
    "grateful",
    "thankful",
    "obliged",
    "glad",
    "happy",
    "happier",
    "better",
    "best",
    "help",
    "helpful",
    "kind",
    "sweet",
    "wonderful",
    "fantastic",
    "amazing",
    "awesome",
    "brilliant",
    "super",
    "perfect",
    "handy",
    "useful",
    "lifesaver",
    "life",
    "saver",
    "relief",
    "me",
    "us",
    "of",
    "you",
    "to",
    "my",
    "day",
    "make",
    "possible",
    "okay",
    "ok",
    "alright",
    "all",
    "right",
    "too",
    "trouble",
    "ask",
    "pleased",
    "delighted",
    "easier",
    "safer",
    "calmer",
    "weight",
    "off",
    "mind",
    "enormously",
    "immensely",
    "lot",
    "ideal",
    "do",
    "doing",
    "helping",
    "favour",
    "favor",
    "out",
    "no",
    "end",
    "solid",
    "lots",
    "for",
    "cool",
];
const WHO: &[&str] = &["you", "somebody", "someone", "one of you", "anybody", "anyone"];
const WOULD: &[&str] =
    &["could", "would", "can", "might", "just", "please", "kindly", "also", "were to", "be so kind as to"];

/// Up to where the frame takes the place of what, and the words that do: a verb, or what sees to a state.
pub(super) fn favour(tokens: &[Token], begin: usize) -> Option<(usize, Vec<Token>)> {
    let mut at = begin + BEGINS.iter().find_map(|begins| stands(tokens, begin, begins))?;
    let nice = at;
    while tokens.get(at).is_some_and(|token| NICE.contains(&token.word())) {
        at += 1;
    }
    if at == nice && stands(tokens, begin, "is it").is_none() {
        return None;
    }
    at += stands(tokens, at, "if")?;
    let Some(who) = WHO.iter().find_map(|who| stands(tokens, at, who)) else {
        // `it would help if the drawer were shut`
        let is_told =
            tokens.get(at).is_some_and(|token| matches!(token.word(), "i" | "we" | "he" | "she" | "they"));
        return (!is_told).then(|| (at, vec![Token::Word("ensure".to_owned())]));
    };
    at += who;
    at += run(tokens, at, WOULD);
    let word = tokens.get(at)?.word();
    let verb = match base(word) {
        Some((verb, Form::Base)) => verb,
        _ => of_past(word)?,
    };
    Some((at + 1, vec![Token::Word(verb)]))
}

/// `… if you took it and brought it to me`: the verbs that follow the first of such a clause, in the form of requests.
pub(super) fn in_series(tokens: &mut [Token], mut at: usize) {
    while let Some(token) = tokens.get(at) {
        if *token == Token::Stop {
            break;
        }
        let is_joint = token.word() == "and";
        at += 1;
        if is_joint
            && let Some(verb) =
                tokens.get(at).and_then(|token| of_past(token.word()).or_else(|| doing(token.word())))
            && let Some(token) = tokens.get_mut(at)
        {
            *token = Token::Word(verb);
        }
    }
}

/// `… picking it up and hanging on to it`
fn doing(word: &str) -> Option<String> {
    base(word).filter(|(_, form)| *form == Form::Gerund).map(|(verb, _)| verb)
}

/// `let me know once you have put it there`: that it shall be done, and told.
pub(super) fn told_when_done(tokens: &[Token], begin: usize) -> Option<(usize, Vec<Token>)> {
    let tells = ["let me know", "tell me", "give me a shout", "give me a call", "call me", "shout"];
    let at = begin + tells.iter().find_map(|tells| stands(tokens, begin, tells))?;
    let done = ["once you have", "when you have", "as soon as you have", "after you have"];
    let at = at + done.iter().find_map(|done| stands(tokens, at, done))?;
    let (verb, form) = base(tokens.get(at)?.word())?;
    // `once you have put it there`: some participles are the verb itself.
    let is_done = form == Form::Participle || (form == Form::Base && of_past(&verb).is_some());
    is_done.then(|| (at + 1, vec![Token::Word(verb)]))
}

/// `do close it`: a request with weight.
pub(super) fn stressed(tokens: &[Token], begin: usize) -> Option<(usize, Vec<Token>)> {
    let at = begin + stands(tokens, begin, "do")?;
    let (_, form) = base(tokens.get(at)?.word())?;
    (form == Form::Base && begins(tokens, at)).then(|| (at, Vec::new()))
}
