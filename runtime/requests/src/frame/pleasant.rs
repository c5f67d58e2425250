//! What would be nice, with what is wanted as its subject: `the coke would hit the spot`, `the fridge closed would be lovely`,
//! `opening it would be a big help`; and what is only called for: `the coke, over here!`

use super::state::{State, state, words};
use crate::english::{
    CALLED_FOR_HERE, CALLED_FOR_HITHER, CALLED_FOR_PLEASE, DOES_GOOD, NICE, NICE_BE, NICE_BEHIND, NICE_WOULD,
    SAID_BACK, SAID_HAVING, SAID_HAVING_2, SAID_HERE,
};
use crate::inflection::{Form, base};
use crate::noun::{Noun, noun};
use crate::spot::spot;
use crate::token::{Token, stands};
use crate::verb::{begins, verb};

/// What would be nice, as an imperative, and where its clause ends.
pub(super) fn pleasant(tokens: &[Token], begin: usize) -> Option<(Vec<Token>, usize)> {
    (begin + 1..tokens.len()).find_map(|at| {
        let end = at + nice(tokens, at)?;
        if end < tokens.len() {
            return None;
        }
        let wanted = said(tokens.get(begin..at)?)?;
        Some((wanted, end))
    })
}

/// `would be lovely`, `would come in handy`: how many words it takes.
fn nice(tokens: &[Token], at: usize) -> Option<usize> {
    let would = NICE_WOULD.longest(tokens, at)?;
    if let Some(count) = DOES_GOOD.longest(tokens, at + would) {
        let end = at + would + count;
        return Some(end + NICE_BEHIND.run(tokens, end) - at);
    }
    let be = at + would + NICE_BE.longest(tokens, at + would)?;
    let count = NICE.run(tokens, be);
    (count > 0).then_some(be + count - at)
}

/// What somebody names as nice, as what they ask for.
fn said(named: &[Token]) -> Option<Vec<Token>> {
    let first = named.first()?.word();
    // `opening it`, `you opening it`
    let doing = usize::from(first == "you" || first == "your");
    if let Some((verb, Form::Gerund)) = base(named.get(doing)?.word()) {
        let mut said = words(&verb);
        said.extend_from_slice(named.get(doing + 1..)?);
        if begins(&said, 0) {
            return Some(said);
        }
    }
    // `having the coke`, `to have the coke`, `a bit of help opening it`
    let having = SAID_HAVING.longest(named, 0);
    if let Some((verb, Form::Gerund)) = having.and_then(|at| base(named.get(at)?.word())) {
        let mut said = words(&verb);
        said.extend_from_slice(named.get(having? + 1..)?);
        return begins(&said, 0).then_some(said);
    }
    let at = SAID_HAVING_2.longest(named, 0).unwrap_or(0);
    let (thing, after) = noun(named, at)?;
    let Noun::Phrase(phrase) = &thing else { return None };
    if phrase.words.is_empty() || begins(named, at) {
        return None;
    }
    let what = named.get(at..after)?;
    if after == named.len() {
        return opened(what).or_else(|| Some([words("bring me").as_slice(), what].concat()));
    }
    let led = after + SAID_BACK.longest(named, after).unwrap_or(0);
    if SAID_HERE.longest(named, led).is_some_and(|count| led + count == named.len()) {
        return Some([words("bring me").as_slice(), what].concat());
    }
    if spot(named, led).is_some_and(|(_, end)| end == named.len()) {
        return Some([words("put").as_slice(), what, named.get(led..)?].concat());
    }
    let (found, end) = state(named, after, Form::Participle)?;
    let verb = match found {
        State::Done(verb) => verb,
        State::Open | State::Closed | State::At => return None,
    };
    Some([words(&verb).as_slice(), what, named.get(end..)?].concat())
}

/// `the fridge open`: a noun takes its adjective in.
fn opened(what: &[Token]) -> Option<Vec<Token>> {
    let (last, thing) = what.split_last()?;
    let verb = match last.word() {
        "open" => "open",
        "closed" | "shut" => "close",
        _ => return None,
    };
    Some([words(verb).as_slice(), thing].concat())
}

/// `the coke, over here!`, `the coke! Here!`: who calls for it wants to have it.
pub(super) fn called_for(tokens: &[Token], begin: usize, limit: usize) -> Option<(Vec<Token>, usize)> {
    let here = tokens.get(..limit)?;
    if verb(here, begin).is_some() {
        return None;
    }
    let (thing, after) = noun(here, begin)?;
    let Noun::Phrase(phrase) = thing else { return None };
    if phrase.words.is_empty() || phrase.place.is_some() {
        return None;
    }
    let mut at = after;
    at += CALLED_FOR_PLEASE.run(tokens, at);
    if at < limit && stands(tokens, at, "over").is_none() && CALLED_FOR_HERE.longest(tokens, at).is_none() {
        return None;
    }
    while matches!(tokens.get(at), Some(Token::Comma | Token::Stop)) {
        at += 1;
    }
    let end = at + CALLED_FOR_HITHER.longest(tokens, at)?;
    let is_over = matches!(tokens.get(end), None | Some(Token::Comma | Token::Stop));
    is_over
        .then(|| ([words("bring me").as_slice(), tokens.get(begin..after).unwrap_or_default()].concat(), end))
}
