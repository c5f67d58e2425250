//! Requests that begin with the place, or have no verb: `into the bin with it`, `off to the sink with you`, `next stop is the door`.

use super::state::{is_place, words};
use crate::english::{
    DESTINATION_DESTINATION, DESTINATION_FOR_YOU, DESTINATION_IS, DESTINATION_NEXT, DESTINATION_YOUR,
    FRONTED_IS_THE_PLACE_FOR, HAS_ITS_PLACE, HEADED_NOW, HEADED_OVER, HEADED_PLEASE, IS_WHERE, OFF_YOU_GO,
    SENT_BE_OVER, SENT_NEEDED, SENT_OVER, SENT_OVER_AT, SENT_STOP, SENT_WITH_YOU, SENT_WITH_YOU_2,
    WANTED_TO_BE, WANTED_WE_KEEP, WANTED_YOU, WANTS_STATE, WITH_IT_GOES, WITH_IT_OFF, WITH_IT_OUT_IT_GOES,
    WITH_IT_OUT_WITH, WITH_IT_RUBBISH,
};
use crate::lead::skip_leads;
use crate::noun::{Noun, noun};
use crate::spot::{Relation, located, spot, way};
use crate::token::{Token, stands};

/// `into the bin with it`, `in the drawer it goes`: what shall be put there.
pub(super) fn with_it(tokens: &[Token], begin: usize) -> Option<(Vec<Token>, usize)> {
    // `out with it!`
    if let Some(count) = WITH_IT_OUT_WITH.longest(tokens, begin)
        && let Some((Noun::Before(_) | Noun::Phrase(_), end)) = noun(tokens, begin + count)
        && is_over(tokens, end)
    {
        let mut said = words("discard");
        said.extend_from_slice(tokens.get(begin + count..end)?);
        return Some((said, end));
    }
    // `out it goes`
    if let Some(count) = WITH_IT_OUT_IT_GOES.longest(tokens, begin) {
        let end = begin + count + WITH_IT_RUBBISH.longest(tokens, begin + count).unwrap_or(0);
        return is_over(tokens, end).then(|| (words("discard it"), end));
    }
    // `off to the bin with it`
    let begin = begin + WITH_IT_OFF.longest(tokens, begin).unwrap_or(0);
    let (place, after) = spot(tokens, begin).or_else(|| way(tokens, begin))?;
    if matches!(place.noun, Noun::Before(_)) || place.relation == Relation::Beside {
        return None;
    }
    // `in the drawer, please, with the sponge`
    let mut with = after;
    while tokens.get(with) == Some(&Token::Comma) || stands(tokens, with, "please").is_some() {
        with += 1;
    }
    let after_place = after;
    let after = if stands(tokens, with, "with").is_some() { with } else { after };
    let (thing, end) = if tokens.get(after)?.word() == "with" {
        let (thing, end) = noun(tokens, after + 1)?;
        if matches!(thing, Noun::Speaker) {
            return None;
        }
        (after + 1..end, end)
    } else {
        let (_, end) = noun(tokens, after)?;
        let goes = WITH_IT_GOES.longest(tokens, end)?;
        (after..end, end + goes)
    };
    let thing = tokens.get(thing)?;
    if thing.first().is_some_and(|token| token.word() == "you") {
        return None;
    }
    let mut said = words("put");
    said.extend_from_slice(thing);
    said.extend_from_slice(tokens.get(begin..after_place)?);
    Some((said, end))
}

/// `off to the sink with you`, `off you go to the sink`, `next stop for you is the sink`, `be at the door`
pub(super) fn sent(tokens: &[Token], begin: usize) -> Option<(Vec<Token>, usize)> {
    if let Some(count) = OFF_YOU_GO.longest(tokens, begin) {
        let at = begin + count;
        let (place, after) = way(tokens, at)?;
        if matches!(place.noun, Noun::Speaker) {
            return None;
        }
        let with_you = SENT_WITH_YOU.longest(tokens, after);
        // `off the table` tells where something is.
        if place.relation != Relation::To || (with_you.is_none() && count == 1) {
            return None;
        }
        let mut said = words("go");
        said.extend_from_slice(tokens.get(at..after)?);
        return Some((said, after + with_you.unwrap_or(0)));
    }
    // `back to the sink with you`
    if let Some((place, after)) = way(tokens, begin)
        && place.relation == Relation::To
        && matches!(place.noun, Noun::Phrase(_))
        && let Some(with_you) = SENT_WITH_YOU_2.longest(tokens, after)
        && is_over(tokens, after + with_you)
    {
        let mut said = words("go");
        said.extend_from_slice(tokens.get(begin..after)?);
        return Some((said, after + with_you));
    }
    if let Some(count) = SENT_STOP.longest(tokens, begin) {
        let at = begin + count + SENT_OVER_AT.longest(tokens, begin + count).unwrap_or(0);
        let (place, _) = noun(tokens, at)?;
        return matches!(place, Noun::Phrase(_)).then(|| (words("go to"), at));
    }
    // `you are needed at the sink`
    if let Some(count) = SENT_NEEDED.longest(tokens, begin) {
        let at = begin + count + SENT_OVER.longest(tokens, begin + count).unwrap_or(0);
        return located(tokens, at).map(|_| (words("go"), at));
    }
    // `I would like you to be at the door`
    let be = begin + SENT_BE_OVER.longest(tokens, begin)?;
    let is_there = is_place(tokens, be) || located(tokens, be).is_some();
    is_there.then(|| (words("go"), be))
}

/// `your destination is`, `next destination`: how many words it takes.
fn destination(tokens: &[Token], begin: usize) -> Option<usize> {
    let mut at = begin + DESTINATION_YOUR.longest(tokens, begin).unwrap_or(0);
    at += DESTINATION_NEXT.longest(tokens, at).unwrap_or(0);
    at += DESTINATION_DESTINATION.longest(tokens, at)?;
    at += DESTINATION_FOR_YOU.longest(tokens, at).unwrap_or(0);
    match DESTINATION_IS.longest(tokens, at) {
        Some(count) => Some(at + count - begin),
        None => (tokens.get(at) == Some(&Token::Comma)).then(|| at + 1 - begin),
    }
}

/// `to the sink, please`, `over to the sink, please`: who is spoken to goes there. `next destination: the sink`.
pub(super) fn headed(tokens: &[Token], begin: usize, limit: usize) -> Option<(Vec<Token>, usize)> {
    if let Some(count) = destination(tokens, begin) {
        let (place, _) = noun(tokens, begin + count)?;
        return matches!(place, Noun::Phrase(_)).then(|| (words("go to"), begin + count));
    }
    let here = tokens.get(..limit)?;
    let please = |after: usize| {
        stands(tokens, after, "please").map(|count| after + count).or_else(|| {
            (after == limit).then(|| Some(limit + 1 + stands(tokens, limit + 1, "please")?)).flatten()
        })
    };
    // `on the table please, the coke`
    if let Some((place, after)) = spot(here, begin).or_else(|| way(here, begin))
        && matches!(place.noun, Noun::Phrase(_))
        && place.relation != Relation::Beside
        && let next = after + HEADED_PLEASE.longest(tokens, after).unwrap_or(0)
        && tokens.get(next) == Some(&Token::Comma)
        && let Some((Noun::Phrase(_), end)) = noun(tokens, next + 1)
        && is_over(tokens, end)
        && crate::verb::verb(tokens, skip_leads(tokens, next + 1)).is_none()
    {
        let mut said = words("put");
        said.extend_from_slice(tokens.get(next + 1..end)?);
        said.extend_from_slice(tokens.get(begin..after)?);
        return Some((said, end));
    }
    // `it is finished. In the bin, please`
    let put = spot(here, begin).or_else(|| {
        way(here, begin).filter(|(place, _)| matches!(place.relation, Relation::In | Relation::On))
    });
    if let Some((place, after)) = put
        && matches!(place.noun, Noun::Phrase(_))
        && place.relation != Relation::At
        && let Some(end) = please(after).filter(|end| is_over(tokens, *end))
    {
        let mut said = words("put it");
        said.extend_from_slice(tokens.get(begin..after)?);
        return Some((said, end));
    }
    let over = HEADED_OVER.longest(here, begin).unwrap_or(0);
    let (place, after) = way(here, begin).or_else(|| way(here, begin + over))?;
    let is_place = place.relation == Relation::To && matches!(place.noun, Noun::Phrase(_));
    let is_first = (0..begin).all(|at| crate::verb::verb(tokens, at).is_none());
    let now = HEADED_NOW.longest(tokens, after).map(|count| after + count);
    let alone = (is_first && after == limit).then_some(after);
    let please = please(after).or(now).or(alone)?;
    (is_place && is_over(tokens, please)).then(|| {
        let mut said = words("go");
        said.extend_from_slice(tokens.get(begin..after).unwrap_or_default());
        (said, please)
    })
}

/// `on the table, that is where I want it`: up to where `put it on the table` takes the place of it.
pub(super) fn wanted_there(tokens: &[Token], begin: usize) -> Option<(usize, Vec<Token>)> {
    let (place, after) = spot(tokens, begin).or_else(|| way(tokens, begin))?;
    if !matches!(place.noun, Noun::Phrase(_)) || place.relation == Relation::Beside {
        return None;
    }
    let mut at = after;
    while tokens.get(at) == Some(&Token::Comma)
        || tokens.get(at).is_some_and(|token| token.word() == "please")
    {
        at += 1;
    }
    if at == after {
        return None;
    }
    at += IS_WHERE.longest(tokens, at)?;
    let (thing, end, verb) = wanted(tokens, at)?;
    is_over(tokens, end).then(|| {
        let mut said = words(verb);
        said.extend_from_slice(&thing);
        said.extend_from_slice(tokens.get(begin..after).unwrap_or_default());
        (end, said)
    })
}

/// `I want the coke`, `I want you to put the coke`, `the coke belongs`: what shall have the place that is spoken of, with its verb.
fn wanted(tokens: &[Token], at: usize) -> Option<(Vec<Token>, usize, &'static str)> {
    let noun_at = |at: usize| {
        let (thing, end) = noun(tokens, at)?;
        (!matches!(thing, Noun::Speaker)).then_some((tokens.get(at..end)?.to_vec(), end))
    };
    if let Some(count) = WANTS_STATE.longest(tokens, at) {
        let count = count + WANTED_YOU.longest(tokens, at + count).unwrap_or(0);
        let (thing, end) = noun_at(at + count)?;
        let be = WANTED_TO_BE.longest(tokens, end).unwrap_or(0);
        return Some((thing, end + be, "put"));
    }
    // Who keeps it there wants it there.
    let keeps = WANTED_WE_KEEP.longest(tokens, at);
    if let Some(count) = keeps {
        let (thing, end) = noun_at(at + count)?;
        return Some((thing, end, "keep"));
    }
    (at + 1..tokens.len()).find_map(|end| {
        let count = HAS_ITS_PLACE.longest(tokens, end)?;
        let (thing, after) = noun(tokens.get(..end)?, at)?;
        let is_thing = after == end && !matches!(thing, Noun::Speaker);
        is_thing.then(|| Some((tokens.get(at..end)?.to_vec(), end + count, "keep")))?
    })
}

/// `on the table is where I want the coke`, `the drawer is where the coke lives`, `the drawer is the place for the coke`
pub(super) fn fronted(tokens: &[Token], begin: usize) -> Option<(Vec<Token>, usize)> {
    let spot = spot(tokens, begin);
    let (is_bare, after) = match spot {
        Some((_, after)) => (false, after),
        None => (true, noun(tokens, begin).filter(|(noun, _)| matches!(noun, Noun::Phrase(_)))?.1),
    };
    let (thing, end, verb) = match FRONTED_IS_THE_PLACE_FOR.longest(tokens, after) {
        Some(count) => {
            let (_, end) = noun(tokens, after + count)?;
            (tokens.get(after + count..end)?.to_vec(), end, "keep")
        }
        None => wanted(tokens, after + IS_WHERE.longest(tokens, after)?)?,
    };
    let mut said = words(verb);
    said.extend_from_slice(&thing);
    if is_bare {
        // Whether on or in is the place's to say.
        said.extend(words("to"));
    }
    said.extend_from_slice(tokens.get(begin..after)?);
    Some((said, end))
}

pub(super) fn is_over(tokens: &[Token], at: usize) -> bool {
    matches!(tokens.get(at), None | Some(Token::Comma | Token::Stop))
}
