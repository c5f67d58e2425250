//! Places with their prepositions: where something is, where it shall go, and what it is near.

use super::noun::{Noun, noun};
use super::token::Token;
use super::vocabulary::Role;
use crate::english::{PREPOSITIONS_OF_PLACE, PREPOSITIONS_OF_WAY};
use crate::phrases::Phrases;

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
    pub(super) preposition: String,
    pub(super) noun: Noun,
    /// Whether it follows the thing without a word between them: `the can on the table`.
    pub(super) is_behind_thing: bool,
}

impl Spot {
    /// Whether it can only say where to: `onto`, `into`, `to`.
    pub(super) fn moves(&self) -> bool {
        !PREPOSITIONS_OF_PLACE.has(&self.preposition)
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
    /// The relation of a name in the lists of prepositions.
    fn named(name: &str) -> Option<Self> {
        Some(match name {
            "on" => Self::On,
            "in" => Self::In,
            "at" => Self::At,
            "to" => Self::To,
            "beside" => Self::Beside,
            _ => return None,
        })
    }

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
    let is_static = PREPOSITIONS_OF_WAY.longest(tokens, at) < PREPOSITIONS_OF_PLACE.longest(tokens, at);
    is_static.then(|| placed(tokens, at, &PREPOSITIONS_OF_PLACE)).flatten()
}

/// `to the table`, `into the drawer`, `next to the sink`: where to, or near what.
pub(super) fn way(tokens: &[Token], at: usize) -> Option<(Spot, usize)> {
    placed(tokens, at, &PREPOSITIONS_OF_WAY)
}

/// Whether a preposition of where to, or of near by, stands here.
pub(super) fn is_way(tokens: &[Token], at: usize) -> bool {
    PREPOSITIONS_OF_WAY.longest(tokens, at) > PREPOSITIONS_OF_PLACE.longest(tokens, at)
}

fn placed(tokens: &[Token], at: usize, prepositions: &Phrases) -> Option<(Spot, usize)> {
    let (count, relation) = prepositions.valued(tokens, at)?;
    let relation = Relation::named(relation)?;
    let (noun, after) = noun(tokens, at + count)?;
    let preposition: Vec<_> = tokens.get(at..at + count)?.iter().map(Token::word).collect();
    Some((Spot { relation, preposition: preposition.join(" "), noun, is_behind_thing: false }, after))
}
