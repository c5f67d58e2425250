//! Requests that begin with the place, or have no verb: `into the bin with it`, `off to the sink with you`, `next stop is the door`.

use super::link::WANT;
use super::state::{is_place, words};
use crate::lead::skip_leads;
use crate::noun::{Noun, noun};
use crate::spot::{Relation, located, spot, way};
use crate::token::{Token, longest, stands};

/// `into the bin with it`, `in the drawer it goes`: what shall be put there.
pub(super) fn with_it(tokens: &[Token], begin: usize) -> Option<(Vec<Token>, usize)> {
    // `out with it!`
    if let Some(count) = longest(tokens, begin, &["out with", "away with"])
        && let Some((Noun::Before(_) | Noun::Phrase(_), end)) = noun(tokens, begin + count)
        && is_over(tokens, end)
    {
        let mut said = words("discard");
        said.extend_from_slice(tokens.get(begin + count..end)?);
        return Some((said, end));
    }
    // `out it goes`
    if let Some(count) = longest(
        tokens,
        begin,
        &[
            "out it goes",
            "out it should go",
            "away it goes",
            "out they go",
            "out it must go",
            "out it has to go",
        ],
    ) {
        let rubbish = [
            "with the rubbish",
            "with the trash",
            "with the garbage",
            "with the bins",
            "into the bin",
            "in the bin",
            "into the trash",
            "in the trash",
            "in the rubbish",
            "in the garbage",
            "into the garbage",
            "to the bin",
        ];
        let end = begin + count + longest(tokens, begin + count, &rubbish).unwrap_or(0);
        return is_over(tokens, end).then(|| (words("discard it"), end));
    }
    // `off to the bin with it`
    let begin = begin + longest(tokens, begin, &["off", "straight"]).unwrap_or(0);
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
        let goes = longest(tokens, end, &["goes", "go", "belongs"])?;
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
    // `back to the sink with you`
    if let Some((place, after)) = way(tokens, begin)
        && place.relation == Relation::To
        && matches!(place.noun, Noun::Phrase(_))
        && let Some(with_you) =
            longest(tokens, after, &["with you", "you go", "you pop", "you trot", "then you"])
        && is_over(tokens, after + with_you)
    {
        let mut said = words("go");
        said.extend_from_slice(tokens.get(begin..after)?);
        return Some((said, after + with_you));
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
        "your place now is",
        "your post is",
        "your position is",
    ];
    if let Some(count) = longest(tokens, begin, &stop) {
        let at = begin
            + count
            + longest(
                tokens,
                begin + count,
                &["over at", "over by", "at", "by", "near", "next to", "beside"],
            )
            .unwrap_or(0);
        let (place, _) = noun(tokens, at)?;
        return matches!(place, Noun::Phrase(_)).then(|| (words("go to"), at));
    }
    // `you are needed at the sink`
    let needed = [
        "you are needed",
        "you are wanted",
        "you are required",
        "you are expected",
        "you are awaited",
        "your presence is required",
        "your presence is needed",
        "your presence is requested",
        "your help is needed",
        "your help is wanted",
        "i require you",
        "i require your presence",
    ];
    if let Some(count) = longest(tokens, begin, &needed) {
        let at = begin + count + longest(tokens, begin + count, &["over", "back"]).unwrap_or(0);
        return located(tokens, at).map(|_| (words("go"), at));
    }
    // `I would like you to be at the door`
    let be = begin
        + ["be over", "be standing", "be waiting", "be back", "be"]
            .iter()
            .find_map(|be| stands(tokens, begin, be))?;
    let is_there = is_place(tokens, be) || located(tokens, be).is_some();
    is_there.then(|| (words("go"), be))
}

/// `your destination is`, `next destination`: how many words it takes.
fn destination(tokens: &[Token], begin: usize) -> Option<usize> {
    let mut at = begin + longest(tokens, begin, &["your", "the"]).unwrap_or(0);
    at += longest(tokens, at, &["next", "new", "first"]).unwrap_or(0);
    at += longest(tokens, at, &["destination", "target", "goal", "waypoint", "position", "post", "station"])?;
    at += longest(tokens, at, &["for you", "for now"]).unwrap_or(0);
    match longest(tokens, at, &["is", "will be", "shall be"]) {
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
        && let next = after + longest(tokens, after, &["please", "now"]).unwrap_or(0)
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
    let over = longest(here, begin, &["over", "on over", "straight", "back", "off"]).unwrap_or(0);
    let (place, after) = way(here, begin).or_else(|| way(here, begin + over))?;
    let is_place = place.relation == Relation::To && matches!(place.noun, Noun::Phrase(_));
    let is_first = (0..begin).all(|at| crate::verb::verb(tokens, at).is_none());
    let now = longest(tokens, after, &["now", "next", "then", "this time"]).map(|count| after + count);
    let alone = (is_first && after == limit).then_some(after);
    let please = please(after).or(now).or(alone)?;
    (is_place && is_over(tokens, please)).then(|| {
        let mut said = words("go");
        said.extend_from_slice(tokens.get(begin..after).unwrap_or_default());
        (said, please)
    })
}

/// What tells where something has its place.
const LIVES: &[&str] = &[
    "goes",
    "go",
    "belongs",
    "belong",
    "lives",
    "live",
    "should go",
    "should be",
    "should live",
    "should end up",
    "has to go",
    "needs to go",
    "needs to be",
    "is supposed to go",
    "is supposed to be",
    "is meant to go",
    "is meant to be",
    "is to go",
    "ought to go",
    "ought to be",
    "is kept",
    "must go",
    "can go",
    "has its place",
    "fits",
    "is stored",
];
/// The place of something is asked for, or told, in these words behind it.
const IS_WHERE: &[&str] = &[
    "that is where",
    "this is where",
    "is where",
    "is the place where",
    "is the spot where",
    "that is the place where",
];

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
    at += longest(tokens, at, IS_WHERE)?;
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
    if let Some(count) = longest(tokens, at, WANT) {
        let you = [
            "you to put",
            "you to place",
            "you to leave",
            "you to set",
            "you to store",
            "you to keep",
            "to have",
            "to see",
        ];
        let count = count + longest(tokens, at + count, &you).unwrap_or(0);
        let (thing, end) = noun_at(at + count)?;
        let be =
            longest(tokens, end, &["to be", "to go", "to end up", "to stay", "put", "kept"]).unwrap_or(0);
        return Some((thing, end + be, "put"));
    }
    // Who keeps it there wants it there.
    let keeps = longest(
        tokens,
        at,
        &["we keep", "i keep", "we always keep", "i always keep", "you should put", "you can put", "you put"],
    );
    if let Some(count) = keeps {
        let (thing, end) = noun_at(at + count)?;
        return Some((thing, end, "keep"));
    }
    (at + 1..tokens.len()).find_map(|end| {
        let count = longest(tokens, end, LIVES)?;
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
    let (thing, end, verb) = match longest(
        tokens,
        after,
        &["is the place for", "is the right place for", "is the best place for", "is the spot for"],
    ) {
        Some(count) => {
            let (_, end) = noun(tokens, after + count)?;
            (tokens.get(after + count..end)?.to_vec(), end, "keep")
        }
        None => wanted(tokens, after + longest(tokens, after, IS_WHERE)?)?,
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
