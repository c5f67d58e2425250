//! Places with their prepositions: where something is, where it shall go, and what it is near.

use super::noun::{Noun, noun};
use super::token::{Token, stands};
use super::vocabulary::Role;

/// How something shall be, or is, to a place.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Relation {
    On,
    In,
    At,
    /// `to`: whichever the place asks for.
    To,
    /// `next to`, `near`, `in front of`: near a place, and neither on nor in it.
    Beside,
}

/// A place with its preposition.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Spot {
    pub(super) relation: Relation,
    /// The preposition as it was said.
    pub(super) preposition: &'static str,
    pub(super) noun: Noun,
    /// Whether it follows the thing without a word between them: `the can on the table`.
    pub(super) is_behind_thing: bool,
}

/// Prepositions of where something is. They may tell where to as well.
const STATIC: &[(&str, Relation)] = &[
    ("on top of", Relation::On),
    ("inside of", Relation::In),
    ("on", Relation::On),
    ("in", Relation::In),
    ("inside", Relation::In),
    ("within", Relation::In),
    ("at", Relation::At),
    ("upon", Relation::On),
    ("over at", Relation::At),
    ("over on", Relation::On),
    ("over in", Relation::In),
];
/// Prepositions of where to, and of near by.
const OTHER: &[(&str, Relation)] = &[
    ("over to", Relation::To),
    ("back to", Relation::To),
    ("up to", Relation::To),
    ("across to", Relation::To),
    ("along to", Relation::To),
    ("down to", Relation::To),
    ("round to", Relation::To),
    ("around to", Relation::To),
    ("out to", Relation::To),
    ("on over to", Relation::To),
    ("all the way to", Relation::To),
    ("all the way over to", Relation::To),
    ("over onto", Relation::On),
    ("back onto", Relation::On),
    ("up onto", Relation::On),
    ("down onto", Relation::On),
    ("out onto", Relation::On),
    ("back on", Relation::On),
    ("up on", Relation::On),
    ("over into", Relation::In),
    ("back into", Relation::In),
    ("back in", Relation::In),
    ("back inside", Relation::In),
    ("down into", Relation::In),
    ("away into", Relation::In),
    ("up into", Relation::In),
    ("to", Relation::To),
    ("onto", Relation::On),
    ("into", Relation::In),
    ("towards", Relation::To),
    ("toward", Relation::To),
    ("right next to", Relation::Beside),
    ("next to", Relation::Beside),
    ("close to", Relation::Beside),
    ("adjacent to", Relation::Beside),
    ("opposite to", Relation::Beside),
    ("opposite", Relation::Beside),
    ("alongside", Relation::Beside),
    ("near to", Relation::Beside),
    ("nearer to", Relation::Beside),
    ("nearer", Relation::Beside),
    ("closer to", Relation::Beside),
    ("closer by", Relation::Beside),
    ("right beside", Relation::Beside),
    ("right near", Relation::Beside),
    ("somewhere near", Relation::Beside),
    ("somewhere by", Relation::Beside),
    ("near", Relation::Beside),
    ("beside", Relation::Beside),
    ("by", Relation::Beside),
    ("in front of", Relation::Beside),
    ("right by", Relation::Beside),
    ("over by", Relation::Beside),
    ("to the left of", Relation::Beside),
    ("to the right of", Relation::Beside),
    ("at the side of", Relation::Beside),
    ("at the foot of", Relation::Beside),
    ("on the side of", Relation::Beside),
    ("in the vicinity of", Relation::Beside),
];

impl Spot {
    /// Whether it can only say where to: `onto`, `into`, `to`.
    pub(super) fn moves(&self) -> bool {
        !STATIC.iter().any(|(known, _)| *known == self.preposition)
    }

    /// As it was said.
    pub(super) fn said(&self) -> String {
        let noun = match &self.noun {
            Noun::Speaker => "me",
            Noun::Before(word) => word,
            Noun::Here => "here",
            Noun::There => "there",
            Noun::Phrase(phrase) => &phrase.said,
        };
        format!("{} {noun}", self.preposition)
    }
}

impl Relation {
    /// Whether something can be so to a thing of this role: on a shelf, in a drawer. A sink and a shelf have things in
    /// them as well as on them; what lies in a mug is not known.
    pub(super) const fn fits(self, role: Role) -> bool {
        match self {
            Self::On => matches!(role, Role::Surface | Role::Object | Role::Place),
            Self::In => matches!(role, Role::Surface | Role::Container | Role::Place),
            Self::At | Self::To => true,
            Self::Beside => false,
        }
    }
}

/// `on the table`, `in the drawer`, `at the counter`
pub(super) fn located(tokens: &[Token], at: usize) -> Option<(Noun, usize)> {
    spot(tokens, at).map(|(spot, after)| (spot.noun, after))
}

/// The same with its preposition.
pub(super) fn spot(tokens: &[Token], at: usize) -> Option<(Spot, usize)> {
    (preposition(tokens, at, OTHER).map(|(count, _)| count)
        < preposition(tokens, at, STATIC).map(|(count, _)| count))
    .then(|| placed(tokens, at, STATIC))
    .flatten()
}

/// `to the table`, `into the drawer`, `next to the sink`: where to, or near what.
pub(super) fn way(tokens: &[Token], at: usize) -> Option<(Spot, usize)> {
    placed(tokens, at, OTHER)
}

/// Whether a preposition of where to, or of near by, stands here.
pub(super) fn is_way(tokens: &[Token], at: usize) -> bool {
    let of = |table| preposition(tokens, at, table).map(|(count, _)| count);
    of(OTHER) > of(STATIC)
}

fn placed(tokens: &[Token], at: usize, table: &'static [(&'static str, Relation)]) -> Option<(Spot, usize)> {
    let (count, (preposition, relation)) = preposition(tokens, at, table)?;
    let (noun, after) = noun(tokens, at + count)?;
    Some((Spot { relation, preposition, noun, is_behind_thing: false }, after))
}

/// The longest preposition of a table that stands here, and how many words it takes.
fn preposition(
    tokens: &[Token],
    at: usize,
    table: &'static [(&'static str, Relation)],
) -> Option<(usize, (&'static str, Relation))> {
    let here = table.iter().filter_map(|row| Some((stands(tokens, at, row.0)?, *row)));
    here.max_by_key(|(count, _)| *count)
}
