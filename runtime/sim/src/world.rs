//! State of the simulated world: poses, supports, held things.
//!
//! It knows nothing of goals and events. Positions are those of its present time; [`SimWorld::advance`] moves
//! on.

use crate::body::{BasePose, UprightBody};
use crate::motion::{BaseMotion, PersonWalk};
use indexmap::IndexMap;
use motet_robots::card::{BaseSpec, CameraMount, CameraSpec, HandSpec};
use motet_robots::scene::{EntityShape, Travel};
use motet_runtime::Time;
use smol_str::SmolStr;
use std::collections::BTreeSet;

/// Greatest distance in m between the bottom of a thing and the top of what it stands on.
const BENEATH_M: f64 = 0.03;
/// The share of the battery that a metre of driving takes.
const DRAIN_PER_M: f64 = 0.001;

/// The whole world.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct SimWorld {
    pub(crate) now: Time,
    pub(crate) base: BasePose,
    pub(crate) motion: Option<BaseMotion>,
    pub(crate) drive: BaseSpec,
    pub(crate) hands: IndexMap<SmolStr, HandState>,
    pub(crate) cameras: Vec<CameraSpec>,
    pub(crate) eye: CameraMount,
    /// Turn of the camera to the left of the base and its elevation in rad, since a look; none where it is as
    /// the posture has it.
    pub(crate) gaze: Option<[f64; 2]>,
    pub(crate) things: IndexMap<SmolStr, Thing>,
    pub(crate) arm: ArmPose,
    pub(crate) standing: bool,
    pub(crate) battery: f64,
    /// The base has not moved since the beginning.
    pub(crate) unmoved: bool,
    /// Entity at which the robot stands in the scene, until it moves.
    pub(crate) served_at_start: Option<SmolStr>,
    pub(crate) visited: BTreeSet<SmolStr>,
}

/// A hand and what it holds.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct HandState {
    pub(crate) hand: HandSpec,
    pub(crate) holds: Option<SmolStr>,
    pub(crate) lifted: bool,
}

/// The posture of the arm.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum ArmPose {
    Home,
    /// Raised to look.
    Ready,
    /// Close to the body with what it holds.
    Carry,
    /// Stretched out from the last use of the hand.
    Out,
}

impl SimWorld {
    pub(crate) fn thing(&self, id: &str) -> Option<&Thing> {
        self.things.get(id)
    }

    /// Something moves while time passes.
    pub(crate) fn is_moving(&self) -> bool {
        self.motion.is_some() || self.things.values().any(|thing| thing.walk.is_some())
    }

    /// Lets time pass.
    pub(crate) fn advance(&mut self, now: Time) {
        self.now = now;
        if let Some(motion) = &self.motion {
            let (before, is_over) = (self.base, now >= motion.end());
            self.base = motion.at(now);
            let driven = before.distance_to(self.base.x, self.base.y);
            self.battery = (self.battery - driven * DRAIN_PER_M).max(0.0);
            if before != self.base {
                self.unmoved = false;
                self.served_at_start = None;
            }
            if is_over {
                self.motion = None;
            }
        }
        for index in 0..self.things.len() {
            self.walk_on(index);
        }
        self.carry();
    }

    fn walk_on(&mut self, index: usize) {
        let now = self.now;
        let Some((id, thing)) = self.things.get_index_mut(index) else { return };
        let Some(walk) = thing.walk else { return };
        if now >= walk.end() {
            thing.walk = None;
        }
        let ([x, y], id) = (walk.at(now), id.clone());
        let delta = [x - thing.body.x(), y - thing.body.y(), 0.0];
        self.shift(&id, delta);
    }

    /// Moves lifted things along with their hands.
    pub(crate) fn carry(&mut self) {
        let lifted = self.hands.values().filter(|grip| grip.lifted);
        let carried: Vec<_> =
            lifted.filter_map(|grip| Some((grip.holds.clone()?, grip.hand.reach_m))).collect();
        for (id, reach) in carried {
            let ahead = 0.5 * reach;
            let (x, y) = (
                self.base.x + ahead * self.base.heading.cos(),
                self.base.y + ahead * self.base.heading.sin(),
            );
            if let Some(body) = self.thing(&id).map(|thing| thing.body) {
                self.shift(&id, [x - body.x(), y - body.y(), 0.8 - body.z()]);
            }
        }
    }

    /// Moves a thing, and everything that rests on or in it or is held by it.
    pub(crate) fn shift(&mut self, id: &str, delta: [f64; 3]) {
        let mut moved = vec![SmolStr::from(id)];
        let mut next = 0;
        while let Some(support) = moved.get(next).cloned() {
            next += 1;
            if let Some(thing) = self.things.get_mut(&support) {
                thing.moved = true;
                for (coordinate, by) in thing.body.xyz.iter_mut().zip(delta) {
                    *coordinate += by;
                }
            }
            for (id, _) in self.resting(&support) {
                if !moved.contains(id) {
                    moved.push(id.clone());
                }
            }
        }
    }

    /// Things that are directly on, in or with an entity, but not those that a hand has lifted.
    pub(crate) fn resting<'w>(
        &'w self,
        support: &'w str,
    ) -> impl Iterator<Item = (&'w SmolStr, &'w Thing)> + 'w {
        self.things.iter().filter(move |(_, thing)| thing.rest.support().is_some_and(|id| id == support))
    }

    /// Root of a thing's supports: the entity to which the robot drives.
    pub(crate) fn root<'w>(&'w self, id: &'w str) -> &'w str {
        let mut root = id;
        // No chain is longer than there are things.
        for _ in 0..self.things.len() {
            match self.thing(root).and_then(|thing| thing.rest.support()) {
                Some(support) if self.things.contains_key(support.as_str()) => root = support,
                Some(_) | None => match self.beneath(root) {
                    Some(support) => root = support,
                    None => break,
                },
            }
        }
        root
    }

    /// The furniture on which a thing stands of which nobody said so.
    fn beneath(&self, id: &str) -> Option<&SmolStr> {
        let body = self.thing(id).filter(|thing| thing.role == Role::Object && !self.is_lifted(id))?.body;
        let carries = |(_, thing): &(&SmolStr, &Thing)| {
            let level = (thing.body.top() - body.bottom()).abs() <= BENEATH_M;
            thing.role == Role::Surface && level && thing.body.gap(body.x(), body.y()) <= 0.0
        };
        self.things.iter().find(carries).map(|(support, _)| support)
    }

    /// The closed container that a thing is in, directly or not.
    pub(crate) fn shut_in(&self, id: &str) -> Option<&SmolStr> {
        let mut inner = id;
        for _ in 0..self.things.len() {
            let thing = self.thing(inner)?;
            if let Rest::In(container) = &thing.rest
                && self.thing(container).is_some_and(|container| !container.is_open())
            {
                return Some(container);
            }
            inner = thing.rest.support()?;
        }
        None
    }

    /// The name of the hand that holds a thing.
    pub(crate) fn holder(&self, id: &str) -> Option<&SmolStr> {
        self.hands.iter().find(|(_, grip)| grip.holds.as_deref() == Some(id)).map(|(name, _)| name)
    }

    /// True if a hand has lifted a thing.
    pub(crate) fn is_lifted(&self, id: &str) -> bool {
        self.hands.values().any(|grip| grip.lifted && grip.holds.as_deref() == Some(id))
    }

    /// The greatest distance in the plane at which a hand serves a thing.
    pub(crate) fn reach(&self) -> f64 {
        let reach = self.hands.values().map(|grip| grip.hand.reach_m).fold(0.0, f64::max);
        if self.hands.is_empty() { self.drive.radius_m + 0.5 } else { reach }
    }

    /// Bodies that the base has to keep out of, but for one.
    pub(crate) fn obstacles(&self, but: &str) -> Vec<UprightBody> {
        self.floor_things().filter(|(id, _)| *id != but).map(|(_, thing)| thing.body).collect()
    }

    /// The name of an entity in words.
    pub(crate) fn name(&self, id: &str) -> SmolStr {
        self.thing(id).map_or_else(|| format!("`{id}`").into(), |thing| thing.name.clone())
    }

    /// A free spot for a thing on a support, the one nearest to `from` of a grid with a step in m and of
    /// those that `fits` takes: its x and y.
    pub(crate) fn free_spot(
        &self,
        id: &str,
        support: &str,
        (from, step): ([f64; 2], f64),
        fits: impl Fn(f64, f64) -> bool,
    ) -> Option<[f64; 2]> {
        let (thing, target) = (self.thing(id)?, self.thing(support)?.body);
        let radius = thing.body.radius();
        let taken: Vec<UprightBody> =
            self.resting(support).filter(|(other, _)| *other != id).map(|(_, other)| other.body).collect();
        let is_free = |[x, y]: &[f64; 2]| {
            target.holds_disc(*x, *y, radius.min(0.9 * target.radius() / std::f64::consts::SQRT_2))
                && taken.iter().all(|other| other.gap(*x, *y) >= radius)
                && fits(*x, *y)
        };
        let away = |[x, y]: &[f64; 2]| (x - from[0]).hypot(y - from[1]);
        target.grid(step).into_iter().filter(is_free).min_by(|a, b| away(a).total_cmp(&away(b)))
    }

    /// Puts a thing down on a spot: its bottom comes to a height.
    pub(crate) fn put(&mut self, id: &str, at: [f64; 2], bottom: f64, rest: Rest) {
        let Some(thing) = self.things.get_mut(id) else { return };
        let before = thing.body.xyz;
        thing.rest = rest;
        let mut after = thing.body;
        after.put(at[0], at[1], bottom);
        let [x, y, z] = after.xyz;
        self.shift(id, [x - before[0], y - before[1], z - before[2]]);
    }

    /// Notes that the robot knows where a thing is.
    pub(crate) fn saw(&mut self, id: &str) {
        if let Some(thing) = self.things.get_mut(id) {
            thing.seen_at = Some(thing.body.xyz);
            thing.lost = false;
        }
    }

    /// A person begins to walk.
    pub(crate) fn start_walk(&mut self, id: &str, from: Option<[f64; 2]>, to: [f64; 2], speed: f64) {
        let now = self.now;
        if let Some(thing) = self.things.get_mut(id) {
            let from = from.unwrap_or([thing.body.x(), thing.body.y()]);
            thing.walk = Some(PersonWalk::new(from, to, now, speed));
        }
    }
}

/// Freedom of the robot to turn while it looks.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum ViewDirection {
    /// It looks where it looks.
    Still,
    /// It turns its camera, as far as that turns while the base stands still.
    Ahead,
    /// It turns until it has seen everything about it.
    Around,
}

/// A thing, a place or a person.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Thing {
    pub(crate) role: Role,
    /// Its name in words, such as `the red mug`.
    pub(crate) name: SmolStr,
    pub(crate) body: UprightBody,
    /// Its shape, where the scene gives one.
    pub(crate) shape: Option<EntityShape>,
    pub(crate) rest: Rest,
    pub(crate) fixed: bool,
    pub(crate) door: Option<Door>,
    /// Visibility at the start, if the scene states it of a thing whose pose it does not give.
    pub(crate) visible_at_start: Option<bool>,
    /// True if the scene gives its pose.
    pub(crate) placed: bool,
    /// Last seen position.
    pub(crate) seen_at: Option<[f64; 3]>,
    /// True if it was looked for in vain where it was believed to be.
    pub(crate) lost: bool,
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
