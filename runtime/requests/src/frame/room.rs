//! Room for a thing: `find a spot on the table for it`, `make room in the drawer and put it there`.

use super::state::words;
use crate::noun::{Noun, noun};
use crate::spot::spot;
use crate::token::{Token, longest, stands};

/// `find a spot on the table for the coke`: put there.
pub(super) fn room_for(tokens: &[Token], begin: usize) -> Option<(Vec<Token>, usize)> {
    let makes = ["clear", "clear me", "make", "make me", "free up", "free", "clear up", "create"];
    let (at, is_made) = match longest(tokens, begin, &makes) {
        Some(count) => (begin + count, true),
        None => (begin + longest(tokens, begin, &["find", "find me"])?, false),
    };
    let room = [
        "a spot",
        "a place",
        "a space",
        "space",
        "room",
        "a home",
        "some space",
        "some room",
        "a nice spot",
        "a nice place",
        "a good spot",
        "a good place",
        "a corner",
    ];
    let at = at + longest(tokens, at, &room)?;
    if is_made {
        return made_room(tokens, at);
    }
    let (thing, place, end) = match stands(tokens, at, "for") {
        Some(count) => {
            let (_, after) = noun(tokens, at + count)?;
            let (_, end) = spot(tokens, after)?;
            (at + count..after, after..end, end)
        }
        None => {
            let (_, after) = spot(tokens, at)?;
            let count = stands(tokens, after, "for")?;
            let (_, end) = noun(tokens, after + count)?;
            (after + count..end, at..after, end)
        }
    };
    let mut said = words("put");
    said.extend_from_slice(tokens.get(thing)?);
    said.extend_from_slice(tokens.get(place)?);
    Some((said, end))
}

/// `(make room) on the table for the coke and put it there`, `… and put the coke there`: room is made by putting it there, where there
/// is any. Alone it says nothing of what shall give way.
pub(super) fn made_room(tokens: &[Token], at: usize) -> Option<(Vec<Token>, usize)> {
    let (_, after) = spot(tokens, at)?;
    let named =
        stands(tokens, after, "for").and_then(|count| Some((after + count, noun(tokens, after + count)?.1)));
    let then = named.map_or(after, |(_, end)| end);
    let puts =
        ["and put", "and then put", "then put", "and set", "and place", "and stick", "and pop", "and leave"];
    let put = then + longest(tokens, then, &puts)?;
    let (it, end) = noun(tokens, put)?;
    let there = longest(
        tokens,
        end,
        &["there", "inside", "in it", "on it", "in there", "on there", "in", "on", "inside it"],
    )?;
    let thing = match (it, named) {
        (Noun::Before(_), Some((begin, end))) => begin..end,
        (Noun::Phrase(_), _) => put..end,
        _ => return None,
    };
    let mut said = words("put");
    said.extend_from_slice(tokens.get(thing)?);
    said.extend_from_slice(tokens.get(at..after)?);
    Some((said, end + there))
}
