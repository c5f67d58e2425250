//! One part of a command behind its verb: a thing, a place, who gets it, or a word that goes with the verb.

use super::command::{BELONGS, Command, ONLY_IF, words};
use super::lead::{contrasts, thanks};
use super::noun::{Noun, noun};
use super::remark::{beside, is_boundary};
use super::spot::{Relation, Spot, is_way, spot, way};
use super::token::{Token, stands};
use super::verb::Act;
use crate::english::{
    IF_SO, IS_DETERMINED_THE, OUT_OF_SIGHT, PART_FOR_ME, PART_FROM_OFF, PART_GO, PART_ON_TOP, PART_RUBBISH,
    PART_TO_WHERE_IT_BELONGS, PART_UP, PART_WAS, PART_WITH_ME,
};

/// One part of a command: where the next begins.
pub(super) fn part(tokens: &[Token], begin: usize, at: usize, now: &mut Command) -> Result<usize, String> {
    // `grab the mug for me`: who takes something for somebody brings it.
    let for_me = PART_FOR_ME.longest(tokens, at);
    if let (Some(count), Act::Take) = (for_me, now.act) {
        // `take the mug to the sink for me`, `carry the mug for me` ask for a favour.
        let carries = matches!(tokens.get(begin).map_or("", Token::word), "carry" | "cart" | "haul" | "lug");
        if (!carries || now.has("over")) && now.to.as_ref().is_none_or(|to| !to.moves()) {
            now.to_whom.get_or_insert(Noun::Speaker);
        }
        return Ok(at + count);
    }
    if let Some(count) = thanks(tokens, at) {
        return Ok(at + count);
    }
    let word = tokens.get(at).map_or("", Token::word);
    let lost = || words(tokens, begin, tokens.len().min(at + 4));
    if contrasts(tokens, at) {
        return Err(lost());
    }
    // `because I am thirsty`, and how long it is held
    if let Some(end) = beside(tokens, at, now.act) {
        return Ok(end);
    }
    let goes = matches!(now.act, Act::Go | Act::Come) || (now.act == Act::Move && now.items.is_empty());
    // `carry it to the table and set it on top`
    if let Some(count) = PART_ON_TOP.longest(tokens, at)
        && is_boundary(tokens, at + count)
        && !now.items.is_empty()
    {
        // Of what is not put anywhere it tells where it is.
        if !matches!(
            now.act,
            Act::Fetch | Act::Pick | Act::Lift | Act::Open | Act::Close | Act::Discard | Act::Find
        ) {
            now.to.get_or_insert(there("", Relation::To, Noun::There));
        }
        return Ok(at + count);
    }
    // `get it out of my sight`
    if let Some(count) = OUT_OF_SIGHT.longest(tokens, at)
        && matches!(now.act, Act::Fetch | Act::Take | Act::Put | Act::Move)
    {
        now.act = Act::Stow;
        return Ok(at + count);
    }
    // `put it out with the rubbish`
    if let Some(count) = PART_RUBBISH.longest(tokens, at)
        && matches!(now.act, Act::Take | Act::Put | Act::Move | Act::Throw)
    {
        now.act = Act::Discard;
        return Ok(at + count);
    }
    if let Some(count) = PART_FROM_OFF.longest(tokens, at) {
        let Some((source, after)) = noun(tokens, at + count) else {
            now.with.push(word.to_owned());
            return Ok(at + 1);
        };
        now.from = Some(source);
        return Ok(after);
    }
    // Who gets it was said: what follows is no place but what it is for, `a drink to recover`.
    if word == "to" && now.act == Act::Fetch && now.to_whom.is_some() && !is_determined(tokens, at + 1) {
        return Ok(rest(tokens, at));
    }
    if is_way(tokens, at) {
        let Some((place, after)) = way(tokens, at) else { return Err(lost()) };
        if is_hand(&place.noun) {
            now.with.push("hand".to_owned());
            return Ok(after);
        }
        if matches!(place.noun, Noun::Speaker) && place.relation != Relation::Beside && !goes {
            now.to_whom = Some(place.noun);
        } else {
            now.put_at(place);
        }
        return Ok(after);
    }
    if let Some((place, after)) = spot(tokens, at) {
        // `take it in your hand`
        if is_hand(&place.noun) {
            now.with.push("hand".to_owned());
            return Ok(after);
        }
        // `put it in my hand`
        if matches!(place.noun, Noun::Speaker) && !goes {
            now.to_whom = Some(place.noun);
            return Ok(after);
        }
        now.put_at(Spot { is_behind_thing: !now.items.is_empty() && at == now.thing_end, ..place });
        return Ok(after);
    }
    // `put it in the drawer, and close it after`
    if matches!(word, "after" | "afterwards" | "wide") && is_boundary(tokens, at + 1) {
        return Ok(at + 1);
    }
    // `close the drawer if it is open`
    if let Some(count) = IF_SO.longest(tokens, at)
        && matches!(now.act, Act::Open | Act::Close)
    {
        now.with.push(ONLY_IF.to_owned());
        return Ok(at + count);
    }
    // `come to me with the mug`
    if let Some(count) = PART_WITH_ME.longest(tokens, at)
        && matches!(now.act, Act::Go | Act::Come)
    {
        return Ok(at + count);
    }
    // `keep it with you`
    if let Some(count) = stands(tokens, at, "with you") {
        now.with.push("hand".to_owned());
        return Ok(at + count);
    }
    if word == "with"
        && matches!(now.act, Act::Go | Act::Come)
        && let Some((carried, after)) = noun(tokens, at + 1)
    {
        let to_me = now.to.as_ref().is_some_and(|to| to.noun == Noun::Speaker);
        now.act = if now.act == Act::Come || to_me { Act::Fetch } else { Act::Take };
        now.items.push(carried);
        return Ok(after);
    }
    if word == "for" {
        let Some((whom, after)) = noun(tokens, at + 1) else { return Err(lost()) };
        // `nip over for the coke`: who goes for something brings it.
        let sets_out = PART_GO.has(tokens.get(begin).map_or("", Token::word));
        if now.act == Act::Go
            && now.to.is_none()
            && now.items.is_empty()
            && sets_out
            && matches!(whom, Noun::Phrase(_))
        {
            now.act = Act::Fetch;
            now.to_whom.get_or_insert(Noun::Speaker);
            now.items.push(whom);
            return Ok(after);
        }
        // Who has something thrown away or opened for them does not get it.
        if !matches!(now.act(), Act::Discard | Act::Stow | Act::Store | Act::Open | Act::Close | Act::Find) {
            now.to_whom.get_or_insert(whom);
        }
        return Ok(after);
    }
    // `put it back where it was`
    let to = stands(tokens, at, "to").unwrap_or(0);
    if let Some(count) = PART_WAS.longest(tokens, at + to) {
        now.with.push("back".to_owned());
        return Ok(at + to + count);
    }
    // `put it back where it belongs`
    if let Some(count) = PART_TO_WHERE_IT_BELONGS.longest(tokens, at) {
        now.with.extend(["back".to_owned(), BELONGS.to_owned()]);
        return Ok(at + count);
    }
    // `open it and put the mug inside`
    if word == "inside" {
        now.to.get_or_insert(there("inside", Relation::In, Noun::There));
        return Ok(at + 1);
    }
    if PART_UP.has(word) {
        now.with.push(word.to_owned());
        return Ok(at + 1);
    }
    let Some((found, after)) = noun(tokens, at) else { return Err(lost()) };
    match (&found, now.act) {
        // `bring me the mug`
        (Noun::Speaker, _) if now.to_whom.is_none() => now.to_whom = Some(found),
        (Noun::Here, _) => now.to = Some(there("", Relation::To, Noun::Speaker)),
        (Noun::There, _) => {
            now.to.get_or_insert(there("", Relation::To, found));
        }
        _ => {
            now.items.push(found);
            now.thing_end = after;
        }
    }
    Ok(after)
}

/// A place that is said in one word.
fn there(preposition: &str, relation: Relation, noun: Noun) -> Spot {
    Spot { relation, preposition: preposition.to_owned(), noun, is_behind_thing: false }
}

/// Whether an article or the like stands at a place.
fn is_determined(tokens: &[Token], at: usize) -> bool {
    let word = tokens.get(at).map_or("", Token::word);
    IS_DETERMINED_THE.has(word)
}

/// Whether it is the robot's own hand.
fn is_hand(noun: &Noun) -> bool {
    let Noun::Phrase(phrase) = noun else { return false };
    matches!(phrase.words.as_slice(), [.., last] if matches!(last.as_str(), "hand" | "gripper" | "arm" | "claw"))
}

/// The end of the clause.
fn rest(tokens: &[Token], mut at: usize) -> usize {
    while tokens.get(at).is_some_and(|token| !token.word().is_empty() && token.word() != "and") {
        at += 1;
    }
    at
}
