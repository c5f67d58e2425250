//! One part of a command behind its verb: a thing, a place, who gets it, or a word that goes with the verb.
//! The rules `parts` say which; this module does it to the command.

use crate::command::{Command, words};
use crate::engine::english::{CARRYING, HANDS, PART_GO};
use crate::engine::noun::{self, Noun, Relation, Spot, noun};
use crate::engine::rule::Rules;
use crate::engine::token::Token;
use crate::engine::verb::Act;

/// One part of a command: where the next begins.
pub(super) fn part(tokens: &[Token], begin: usize, at: usize, now: &mut Command) -> Result<usize, String> {
    let lost = || words(tokens, begin, tokens.len().min(at + 4));
    let verb = tokens.get(begin).map_or("", Token::word);
    let mut facts = now.facts();
    facts.extend(CARRYING.has(verb).then_some("carrying"));
    facts.extend(PART_GO.has(verb).then_some("sets_out"));
    let stays =
        matches!(now.act(), Act::Discard | Act::Stow | Act::Store | Act::Open | Act::Close | Act::Find);
    facts.extend(stays.then_some("stays"));
    let Some(found) = Rules("parts").given(tokens, at, now.act, &facts) else {
        return thing(tokens, at, now).ok_or_else(lost);
    };
    let (does, said) = found.words.split_first().ok_or_else(lost)?;
    let named = noun(said, 0).map(|(noun, _)| noun);
    match (does.word(), named) {
        ("skip", _) => {}
        ("with", _) => now.with.extend(said.iter().map(|token| token.word().to_owned())),
        ("act", _) => now.act = said.first().and_then(|act| Act::named(act.word())).unwrap_or(now.act),
        ("there", _) => {
            now.to.get_or_insert(there("", Relation::To, Noun::There));
        }
        ("inside", _) => {
            now.to.get_or_insert(there("inside", Relation::In, Noun::There));
        }
        ("place", _) => return place(tokens, at, now).ok_or_else(lost),
        ("from", Some(source)) => now.from = Some(source),
        ("whom", Some(whom)) => {
            now.to_whom.get_or_insert(whom);
        }
        ("fetch", Some(what)) => {
            now.act = Act::Fetch;
            now.to_whom.get_or_insert(Noun::Speaker);
            now.items.push(what);
        }
        // `come to me with the mug`
        ("carry", Some(what)) => {
            let to_me = now.to.as_ref().is_some_and(|to| to.noun == Noun::Speaker);
            now.act = if now.act == Act::Come || to_me { Act::Fetch } else { Act::Take };
            now.items.push(what);
        }
        _ => return Err(lost()),
    }
    Ok(found.end)
}

/// A place, or who gets it: where the next part begins.
fn place(tokens: &[Token], at: usize, now: &mut Command) -> Option<usize> {
    let goes = matches!(now.act, Act::Go | Act::Come) || (now.act == Act::Move && now.items.is_empty());
    let (place, after) = noun::place(tokens, at)?;
    if is_hand(&place.noun) {
        now.with.push("hand".to_owned());
    } else if matches!(place.noun, Noun::Speaker) && place.relation != Relation::Beside && !goes {
        now.to_whom = Some(place.noun);
    } else {
        let is_behind_thing = !place.moves() && !now.items.is_empty() && at == now.thing_end;
        now.put_at(Spot { is_behind_thing, ..place });
    }
    Some(after)
}

/// A noun, which is a thing, a place or a person: where the next part begins.
fn thing(tokens: &[Token], at: usize, now: &mut Command) -> Option<usize> {
    let (found, after) = noun(tokens, at)?;
    match &found {
        // `bring me the mug`
        Noun::Speaker if now.to_whom.is_none() => now.to_whom = Some(found),
        Noun::Here => now.to = Some(there("", Relation::To, Noun::Speaker)),
        Noun::There => {
            now.to.get_or_insert(there("", Relation::To, found));
        }
        Noun::Speaker | Noun::Before(_) | Noun::Phrase(_) => {
            now.items.push(found);
            now.thing_end = after;
        }
    }
    Some(after)
}

/// A place that is said in one word.
fn there(preposition: &str, relation: Relation, noun: Noun) -> Spot {
    Spot { relation, preposition: preposition.to_owned(), noun, is_behind_thing: false }
}

/// True if it is the robot's own hand.
fn is_hand(noun: &Noun) -> bool {
    matches!(noun, Noun::Phrase(phrase) if phrase.words.last().is_some_and(|last| HANDS.has(last)))
}
