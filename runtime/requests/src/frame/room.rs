//! Room for a thing: `find a spot on the table for it`, `make room in the drawer and put it there`.

use super::state::words;
use crate::english::{AND_PUT, MADE_ROOM_THERE, ROOM_FOR_FIND, ROOM_FOR_MAKES, ROOM_FOR_ROOM};
use crate::noun::{Noun, noun};
use crate::spot::spot;
use crate::token::{Token, stands};

/// `find a spot on the table for the coke`: put there.
pub(super) fn room_for(tokens: &[Token], begin: usize) -> Option<(Vec<Token>, usize)> {
    let (at, is_made) = match ROOM_FOR_MAKES.longest(tokens, begin) {
        Some(count) => (begin + count, true),
        None => (begin + ROOM_FOR_FIND.longest(tokens, begin)?, false),
    };
    let at = at + ROOM_FOR_ROOM.longest(tokens, at)?;
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
    let put = then + AND_PUT.longest(tokens, then)?;
    let (it, end) = noun(tokens, put)?;
    let there = MADE_ROOM_THERE.longest(tokens, end)?;
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
