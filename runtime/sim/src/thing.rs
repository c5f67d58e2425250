//! One thing of the world.

use crate::body::UprightBody;
use crate::motion::PersonWalk;
use indexmap::IndexMap;
use motet_robots::scene::Travel;
use smol_str::SmolStr;

/// A thing, a place or a person.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Thing {
    pub(crate) role: Role,
    pub(crate) body: UprightBody,
    pub(crate) rest: Rest,
    pub(crate) fixed: bool,
    pub(crate) door: Option<Door>,
    /// Visibility at the start, if the scene states it.
    pub(crate) visible_at_start: Option<bool>,
    /// Last seen position.
    pub(crate) seen_at: Option<[f64; 3]>,
    pub(crate) walk: Option<PersonWalk>,
    /// It has been moved since the beginning.
    pub(crate) moved: bool,
    pub(crate) mass_kg: f64,
    pub(crate) width_m: f64,
    /// Its other fields, in SI units.
    pub(crate) fields: IndexMap<SmolStr, f64>,
}

/// Role of a thing: the standard kind from which its kind descends.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Role {
    Place,
    Surface,
    Container,
    Object,
    Person,
}

/// Support of a thing.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Rest {
    /// The floor, or the wall, or a hand.
    Free,
    On(SmolStr),
    In(SmolStr),
    /// In the hands of a person.
    With(SmolStr),
}

/// A drawer front or a door.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Door {
    pub(crate) open: bool,
    pub(crate) locked: bool,
    pub(crate) travel: Option<Travel>,
}

impl Rest {
    pub(crate) const fn support(&self) -> Option<&SmolStr> {
        match self {
            Self::Free => None,
            Self::On(id) | Self::In(id) | Self::With(id) => Some(id),
        }
    }
}

impl Thing {
    /// True if one can reach into it. What has no door is always open.
    pub(crate) fn is_open(&self) -> bool {
        self.door.is_none_or(|door| door.open)
    }

    /// By how much its body moves when it opens.
    pub(crate) fn slide(&self) -> [f64; 3] {
        match self.door.and_then(|door| door.travel) {
            Some(Travel::Slide { axis, distance }) => self.body.turned_out(axis.map(|part| part * distance)),
            Some(Travel::Hinge { .. }) | None => [0.0; 3],
        }
    }
}
