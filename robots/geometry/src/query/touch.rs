//! Whether a state, and a straight way between two, is free: of the robot itself, of the things around, of the floor.
//!
//! A way is certified, not sampled: where every pair of solids is farther apart at its middle than both can come nearer
//! until its ends, the whole of it is free; else it is halved. How far a point can go is bounded joint by joint, from the
//! link outwards: a joint that turns by `a` moves a point at a distance `r` from its axis by at most `a r`.

use nalgebra::{Isometry3, Vector3};
use smol_str::SmolStr;

use super::room::{GAP, Room};
use super::state::State;
use crate::collision::Solid;

/// How often a way is halved before it counts as not free.
const DEPTH: u32 = 14;

/// What may touch what, beside what always may.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Allowed {
    /// The hand may touch this entity: it is about to be grasped or has just been let go.
    pub hand: Option<usize>,
    /// What is in the hand may touch this entity: it stands on it.
    pub held: Option<usize>,
}

/// Two things that touch.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Touch {
    /// The robot's link; that of the hand for what is in it.
    pub link: SmolStr,
    /// What it touches: an entity, another link, or `floor`.
    pub other: SmolStr,
    /// Whether that is a part of the robot.
    pub is_own: bool,
}

/// What a pair of solids is looked at for.
#[derive(Clone, Copy)]
enum Other {
    Thing(usize),
    Part(usize),
    Floor,
}

impl Room<'_> {
    /// The first touch in a state, with [`GAP`] between everything. O(parts × obstacles).
    #[must_use]
    pub fn touch(&self, state: &State, allowed: Allowed) -> Option<Touch> {
        let placed = self.body.placed(&self.machine.map_from_links(state));
        let found = self.pairs(&placed, allowed, |one, other, _, _| !one.is_farther(other, GAP));
        found.map(|(part, other)| self.told(part, other))
    }

    /// The least distance between the robot and what stands around, the floor included, in m; nothing above 1 m is looked for.
    #[must_use]
    pub fn clearance(&self, state: &State, allowed: Allowed) -> f64 {
        let placed = self.body.placed(&self.machine.map_from_links(state));
        let mut least = 1.0;
        self.pairs(&placed, allowed, |one, other, _, beyond| {
            if beyond.is_none() && !one.is_farther(other, least) {
                least = one.distance(other).min(least);
            }
            false
        });
        least
    }

    /// Whether the straight way between two states is free throughout.
    ///
    /// # Errors
    ///
    /// What touches on the way, or comes so near that nothing certain can be said.
    pub fn edge(&self, from: &State, to: &State, allowed: Allowed) -> Result<(), Touch> {
        // Middles and halves of what is left to look at; the widest first finds a touch soonest.
        let mut open = std::collections::VecDeque::from([(0.5, 0.5, 0)]);
        if let Some(touch) = self.touch(from, allowed).or_else(|| self.touch(to, allowed)) {
            return Err(touch);
        }
        while let Some((middle, half, depth)) = open.pop_front() {
            let state = from.towards(to, middle);
            let poses = self.machine.map_from_links(&state);
            let placed = self.body.placed(&poses);
            let goes = self.goes(&poses, &placed, &state, from, to, half);
            let mut is_certain = true;
            let met = self.pairs(&placed, allowed, |one, other, part, beyond| {
                let room = match beyond {
                    // The base moves both alike.
                    Some(beyond) => {
                        goes.get(part).map_or(0.0, |it| it.0) + goes.get(beyond).map_or(0.0, |it| it.0)
                    }
                    None => goes.get(part).map_or(0.0, |it| it.1),
                };
                if !one.is_farther(other, GAP + room) {
                    is_certain = false;
                    return depth >= DEPTH || !one.is_farther(other, GAP);
                }
                false
            });
            if let Some((part, other)) = met {
                return Err(self.told(part, other));
            }
            if !is_certain {
                open.push_back((middle - half / 2.0, half / 2.0, depth + 1));
                open.push_back((middle + half / 2.0, half / 2.0, depth + 1));
            }
        }
        Ok(())
    }

    /// For each part how far any of its points goes at most from the middle of a way to `half` of the way on either side:
    /// as seen from the base, and in the map.
    pub(super) fn goes(
        &self,
        poses: &[Isometry3<f64>],
        placed: &[Solid],
        state: &State,
        from: &State,
        to: &State,
        half: f64,
    ) -> Vec<(f64, f64)> {
        let change = |at: usize| {
            let value = |joints: &[f64]| joints.get(at).copied().unwrap_or(0.0);
            (value(&to.joints) - value(&from.joints)).abs() * half
        };
        let ([x, y, yaw], [to_x, to_y, to_yaw]) = (from.base, to.base);
        let (shift, turn) = (libm::hypot(to_x - x, to_y - y) * half, (to_yaw - yaw).abs() * half);
        let [base_x, base_y, _] = state.base;
        let parts = self.body.parts().iter().zip(placed).map(|(part, solid)| {
            let reach = solid.reach();
            let mut goes = 0.0;
            for lever in self.machine.levers(part.link).iter().rev() {
                let amount = change(lever.driver.variable) * lever.driver.multiplier.abs();
                if amount == 0.0 {
                    continue;
                }
                goes += if lever.slides {
                    amount
                } else {
                    let pose = poses.get(lever.frame).copied().unwrap_or_default();
                    let axis = pose.rotation * lever.axis.into_inner();
                    let arm = (solid.centre - pose.translation.vector).cross(&axis).norm() + reach;
                    amount * (arm + goes)
                };
            }
            let arm = libm::hypot(solid.centre.x - base_x, solid.centre.y - base_y) + reach;
            (goes, goes + turn * (arm + goes) + shift)
        });
        parts.collect()
    }

    /// Goes through every pair that may not touch until `is_met`; it gets the index of the robot's part, and of the other where
    /// both are the robot's.
    fn pairs(
        &self,
        placed: &[Solid],
        allowed: Allowed,
        mut is_met: impl FnMut(&Solid, &Solid, usize, Option<usize>) -> bool,
    ) -> Option<(usize, Other)> {
        let hand = self.machine.hand();
        let is = |list: fn(&super::machine::Hand) -> &Vec<bool>, link: usize| {
            hand.is_some_and(|hand| list(hand).get(link) == Some(&true))
        };
        let drives = self.machine.drives();
        let floor = Solid::floor();
        for ((part, solid), at) in self.body.parts().iter().zip(placed).zip(0..) {
            let is_held = self.held == Some(at);
            let is_carried = is_held || is(|hand| &hand.carried, part.link);
            // What does not move on a base that does not drive touches what it is bolted to.
            if !drives && !is_carried {
                continue;
            }
            let in_hand = is_held || is(|hand| &hand.members, part.link);
            for (thing, index) in self.things.iter().zip(0..) {
                let entity = Some(thing.entity);
                if (in_hand && allowed.hand == entity) || (is_held && allowed.held == entity) {
                    continue;
                }
                if is_met(solid, &thing.solid, at, None) {
                    return Some((at, Other::Thing(index)));
                }
            }
            // The base stands on the floor.
            if is_carried && is_met(solid, &floor, at, None) {
                return Some((at, Other::Floor));
            }
        }
        for [one, other] in self.body.pairs() {
            if let Some((a, b)) = placed.get(*one).zip(placed.get(*other))
                && is_met(a, b, *one, Some(*other))
            {
                return Some((*one, Other::Part(*other)));
            }
        }
        None
    }

    fn told(&self, part: usize, other: Other) -> Touch {
        let link = |part: usize| {
            let link = self.body.parts().get(part).map_or(0, |part| part.link);
            self.machine.tree().links().get(link).cloned().unwrap_or_default()
        };
        let (other, is_own) = match other {
            Other::Thing(at) => {
                (self.things.get(at).map_or_else(SmolStr::default, |it| self.name(it.entity)), false)
            }
            Other::Part(at) => (link(at), true),
            Other::Floor => (SmolStr::new_static("floor"), false),
        };
        Touch { link: link(part), other, is_own }
    }
}

/// The greatest distance of a solid's points from the vertical through a point, and the heights between which it is.
pub(super) fn about_vertical(solid: &Solid, x: f64, y: f64) -> (f64, [f64; 2]) {
    let up = solid.extent(&Vector3::z());
    let aside = libm::hypot(solid.centre.x - x, solid.centre.y - y);
    // Along the way from the vertical to the centre it extends so far; a box's corners may be farther than that.
    let wide = match solid.shape {
        crate::collision::Shape::Capsule { radius, half }
        | crate::collision::Shape::Cylinder { radius, half } => {
            let [_, _, z] = &solid.axes;
            let end = |sign: f64| {
                let end = solid.centre + z * (half * sign);
                libm::hypot(end.x - x, end.y - y)
            };
            end(1.0).max(end(-1.0)) + radius
        }
        crate::collision::Shape::Box(_) | crate::collision::Shape::HalfSpace => aside + solid.reach(),
    };
    (wide, [solid.centre.z - up, solid.centre.z + up])
}
