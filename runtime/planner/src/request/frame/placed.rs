//! Requests that begin with the place, or have no verb: `into the bin with it`, `off to the sink with you`, `next stop is the door`.

use super::state::{is_place, words};
use crate::request::noun::{Noun, noun};
use crate::request::spot::{Relation, located, spot, way};
use crate::request::token::{Token, longest, stands};

/// `into the bin with it`, `in the drawer it goes`: what shall be put there.
pub(super) fn with_it(tokens: &[Token], begin: usize) -> Option<(Vec<Token>, usize)> {
    let (place, after) = spot(tokens, begin).or_else(|| way(tokens, begin))?;
    if matches!(place.noun, Noun::Before(_)) || place.relation == Relation::Beside {
        return None;
    }
    let (thing, end) = if tokens.get(after)?.word() == "with" {
        let (thing, end) = noun(tokens, after + 1)?;
        if matches!(thing, Noun::Speaker) {
            return None;
        }
        (after + 1..end, end)
    } else {
        let (_, end) = noun(tokens, after)?;
        let goes = longest(tokens, end, &["goes", "go", "belongs"])?;
        (after..end, end + goes)
    };
    let thing = tokens.get(thing)?;
    if thing.first().is_some_and(|token| token.word() == "you") {
        return None;
    }
    let mut said = words("put");
    said.extend_from_slice(thing);
    said.extend_from_slice(tokens.get(begin..after)?);
    Some((said, end))
}

/// `off to the sink with you`, `off you go to the sink`, `next stop for you is the sink`, `be at the door`
pub(super) fn sent(tokens: &[Token], begin: usize) -> Option<(Vec<Token>, usize)> {
    let off =
        ["off you go", "off with you", "off you pop", "away you go", "away with you", "on you go", "off"];
    if let Some(count) = longest(tokens, begin, &off) {
        let at = begin + count;
        let (place, after) = way(tokens, at)?;
        if matches!(place.noun, Noun::Speaker) {
            return None;
        }
        let with_you = longest(tokens, after, &["with you", "you go", "you pop", "you trot"]);
        // `off the table` tells where something is.
        if place.relation != Relation::To || (with_you.is_none() && count == 1) {
            return None;
        }
        let mut said = words("go");
        said.extend_from_slice(tokens.get(at..after)?);
        return Some((said, after + with_you.unwrap_or(0)));
    }
    let stop = [
        "your next stop is",
        "next stop for you is",
        "next stop is",
        "next stop",
        "stop for you is",
        "stop is",
        "your place is",
        "your spot is",
    ];
    if let Some(count) = longest(tokens, begin, &stop) {
        let at = begin + count;
        let (place, _) = noun(tokens, at)?;
        return matches!(place, Noun::Phrase(_)).then(|| (words("go to"), at));
    }
    // `I would like you to be at the door`
    let be = begin
        + ["be over", "be standing", "be waiting", "be back", "be"]
            .iter()
            .find_map(|be| stands(tokens, begin, be))?;
    let is_there = is_place(tokens, be) || located(tokens, be).is_some();
    is_there.then(|| (words("go"), be))
}

/// `on the table, that is where I want it`: up to where `put it on the table` takes the place of it.
pub(super) fn wanted_there(tokens: &[Token], begin: usize) -> Option<(usize, Vec<Token>)> {
    let (place, after) = spot(tokens, begin).or_else(|| way(tokens, begin))?;
    if !matches!(place.noun, Noun::Phrase(_)) || place.relation == Relation::Beside {
        return None;
    }
    let at = after + usize::from(tokens.get(after) == Some(&Token::Comma));
    let at = at + stands(tokens, at, "that is where").or_else(|| stands(tokens, at, "this is where"))?;
    let wants = ["i want", "i would like", "i need", "we want", "we would like", "we need"];
    if let Some(count) = wants.iter().find_map(|want| stands(tokens, at, want)) {
        let (thing, end) = noun(tokens, at + count)?;
        if matches!(thing, Noun::Speaker) || !is_over(tokens, end) {
            return None;
        }
        let mut said = words("put");
        said.extend_from_slice(tokens.get(at + count..end)?);
        said.extend_from_slice(tokens.get(begin..after)?);
        return Some((end, said));
    }
    None
}

fn is_over(tokens: &[Token], at: usize) -> bool {
    matches!(tokens.get(at), None | Some(Token::Comma | Token::Stop))
}
