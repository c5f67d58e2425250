//! Whether states, and straight ways along which nothing turns, are free among the things in a neighbourhood. Made once for
//! a query. Ways along which something turns are in `way`.

use nalgebra::Vector3;

use super::quick::{Legs, Quick, other};
use super::room::{GAP, Room};
use super::state::State;
use super::touch::{Allowed, Other, Touch};
use super::travel::Tally;
use crate::collision::Solid;
use crate::simd::NearPair;

/// A neighbourhood, and the robot in it.
pub(super) struct Around<'r, 'w> {
    pub(super) room: &'r Room<'w>,
    pub(super) limbs: Vec<Limb>,
    pub(super) things: Vec<Near>,
    /// The middle of the places where the base can be, and how far from it, in m.
    place: [f64; 2],
    far: f64,
    pub(super) quick: Quick,
}

/// What counts of a part of the robot.
#[derive(Clone, Copy)]
pub(super) struct Limb {
    pub(super) link: usize,
    pub(super) reach: f64,
    /// What does not move on a base that does not drive touches what it is bolted to.
    pub(super) counts: bool,
    pub(super) is_carried: bool,
    in_hand: bool,
    is_held: bool,
}

/// A thing of the room.
pub(super) struct Near {
    pub(super) index: usize,
    pub(super) entity: usize,
    pub(super) solid: Solid,
    pub(super) reach: f64,
}

impl<'w> Room<'w> {
    /// What the robot can touch with its base no farther than `far` from a place, in m.
    pub(super) fn around(&self, place: [f64; 2], far: f64) -> Around<'_, 'w> {
        let wide = far + self.machine.extent() + self.held_reach() + GAP;
        let [x, y] = place;
        let things = self.things.near(place, wide).filter(|(_, thing)| {
            let (dx, dy, wide) = (thing.solid.centre.x - x, thing.solid.centre.y - y, wide + thing.reach);
            dx * dx + dy * dy <= wide * wide
        });
        let things = things.map(|(index, thing)| Near {
            index,
            entity: thing.entity,
            solid: thing.solid,
            reach: thing.reach,
        });
        Around {
            room: self,
            limbs: self.limbs(),
            things: things.collect(),
            place,
            far,
            quick: Quick::default(),
        }
    }

    /// What the robot can touch on its way between two places of its base.
    pub(super) fn along(&self, from: &State, to: &State) -> Around<'_, 'w> {
        let ([x, y, _], [to_x, to_y, _]) = (from.base, to.base);
        let middle = [(x + to_x) / 2.0, (y + to_y) / 2.0];
        // With some to spare for rounding.
        self.around(middle, libm::hypot(to_x - x, to_y - y) / 2.0 + 1e-6)
    }

    /// How far what is held adds to the robot.
    fn held_reach(&self) -> f64 {
        let part = self.held.and_then(|at| self.body.parts().get(at));
        part.map_or(0.0, |part| part.solid.centre.norm() + part.solid.reach())
    }

    fn limbs(&self) -> Vec<Limb> {
        let hand = self.machine.hand();
        let is = |list: fn(&super::machine::Hand) -> &Vec<bool>, link: usize| {
            hand.is_some_and(|hand| list(hand).get(link) == Some(&true))
        };
        let drives = self.machine.drives();
        let limbs = self.body.parts().iter().zip(0..).map(|(part, at)| {
            let is_held = self.held == Some(at);
            let is_carried = is_held || is(|hand| &hand.carried, part.link);
            Limb {
                link: part.link,
                reach: part.solid.reach(),
                counts: drives || is_carried,
                is_carried,
                in_hand: is_held || is(|hand| &hand.members, part.link),
                is_held,
            }
        });
        limbs.collect()
    }
}

impl Around<'_, '_> {
    /// The first touch in a state, with [`GAP`] between everything.
    pub(super) fn touch(&self, state: &State, allowed: Allowed) -> Option<Touch> {
        if self.holds(state) {
            self.first_touch(&[state], allowed)
        } else {
            self.room.along(state, state).first_touch(&[state], allowed)
        }
    }

    /// The same, pair by pair.
    pub(super) fn touch_exactly(&self, state: &State, allowed: Allowed) -> Option<Touch> {
        if self.holds(state) {
            self.touch_here(state, allowed)
        } else {
            self.room.along(state, state).touch_here(state, allowed)
        }
    }

    /// The origin of the neighbourhood.
    pub(super) fn place(&self) -> [f64; 2] {
        self.place
    }

    fn touch_here(&self, state: &State, allowed: Allowed) -> Option<Touch> {
        let poses = self.room.machine.map_from_links(state);
        let placed = self.room.body.placed(&poses);
        let found = self.first(&placed, allowed);
        found.map(|(part, other)| self.room.told(part, other))
    }

    /// Whether the base is where this neighbourhood is enough.
    pub(super) fn holds(&self, state: &State) -> bool {
        let [x, y, _] = state.base;
        let [a, b] = self.place;
        self.holds_off([x - a, y - b])
    }

    /// The same for a base so far from the origin of the neighbourhood.
    pub(super) fn holds_off(&self, [x, y]: [f64; 2]) -> bool {
        x * x + y * y <= self.far * self.far
    }

    fn first(&self, placed: &[Solid], allowed: Allowed) -> Option<(usize, Other)> {
        for ((limb, solid), part) in self.limbs.iter().zip(placed).zip(0..) {
            if !limb.counts {
                continue;
            }
            for near in &self.things {
                if !limb.may_touch(near.entity, allowed)
                    && touches(solid, limb.reach, &near.solid, near.reach)
                {
                    return Some((part, Other::Thing(near.index)));
                }
            }
            if limb.is_carried && above_floor(solid) <= GAP {
                return Some((part, Other::Floor));
            }
        }
        self.room.body.pairs().iter().find_map(|[one, other]| {
            let (a, b) = (self.limbs.get(*one)?, self.limbs.get(*other)?);
            touches(placed.get(*one)?, a.reach, placed.get(*other)?, b.reach)
                .then_some((*one, Other::Part(*other)))
        })
    }

    /// The least distance between the robot and what stands around, the floor included, where it is less than `least`; with the
    /// base anywhere.
    pub(super) fn clearance_at(&self, state: &State, allowed: Allowed, least: f64) -> f64 {
        let [x, y, _] = state.base;
        // A neighbourhood is as large as the robot and says nothing of what is beyond.
        let (dx, dy) = (x - self.place[0], y - self.place[1]);
        if (dx * dx + dy * dy).sqrt() + least <= self.far {
            self.clearance(state, allowed, least)
        } else {
            self.room.around([x, y], least).clearance(state, allowed, least)
        }
    }

    /// The least distance between the robot and what stands around, the floor included, where it is less than `least`.
    pub(super) fn clearance(&self, state: &State, allowed: Allowed, mut least: f64) -> f64 {
        let placed = self.room.body.placed(&self.room.machine.map_from_links(state));
        for (limb, solid) in self.limbs.iter().zip(&placed).filter(|(limb, _)| limb.counts) {
            for near in &self.things {
                if !limb.may_touch(near.entity, allowed) {
                    least = solid.distance_to(limb.reach, &near.solid, near.reach, least).min(least);
                }
            }
            if limb.is_carried {
                least = above_floor(solid).min(least);
            }
        }
        least
    }

    /// The least distance of some pairs of parts and what stands around in a state, where it is less than `least`.
    pub(super) fn clearance_among<'n>(
        &self,
        state: &State,
        near: impl Iterator<Item = &'n NearPair>,
        mut least: f64,
    ) -> f64 {
        let mut placed: Option<(usize, Solid)> = None;
        for NearPair { pair, .. } in near {
            let solid = match placed {
                Some((part, solid)) if part == pair.part => solid,
                Some(_) | None => {
                    let Some(solid) = self.part_at(pair.part, state) else { continue };
                    placed = Some((pair.part, solid));
                    solid
                }
            };
            let metres = match other(pair) {
                Other::Thing(at) => {
                    let Some((near, limb)) = self.things.get(at).zip(self.limbs.get(pair.part)) else {
                        continue;
                    };
                    solid.distance_to(limb.reach, &near.solid, near.reach, least)
                }
                Other::Floor => above_floor(&solid),
                Other::Part(_) => continue,
            };
            least = metres.min(least);
        }
        least
    }

    /// A part of the robot in a state.
    pub(super) fn part_at(&self, part: usize, state: &State) -> Option<Solid> {
        let (machine, own) = (self.room.machine, self.room.body.parts().get(part)?);
        let pose = machine.map_from_root(state.base) * machine.tree().root_from_link(&state.joints, own.link);
        Some(own.solid.moved(&pose))
    }

    /// Whether the straight way between two states is free throughout.
    ///
    /// # Errors
    ///
    /// What touches on the way, or comes so near that nothing certain can be said.
    pub(super) fn edge(&self, from: &State, to: &State, allowed: Allowed) -> Result<(), Touch> {
        match self.touch(from, allowed).or_else(|| self.touch(to, allowed)) {
            Some(touch) => Err(touch),
            None => self.between(from, to, allowed),
        }
    }

    /// Whether a way is free. What touches is noted.
    pub(super) fn is_free(&self, way: &[State], allowed: Allowed, met: &mut Tally) -> bool {
        let states: Vec<&State> = way.iter().collect();
        let touch = self.first_touch(&states, allowed).or_else(|| {
            way.windows(2).rev().find_map(|pair| match pair {
                [one, other] => self.between(one, other, allowed).err(),
                _ => None,
            })
        });
        touch.map(|touch| met.add(&touch)).is_none()
    }
}

impl Around<'_, '_> {
    /// Whether a straight way is free where nothing turns on it, so that what each part sweeps over is convex and one distance tells all.
    pub(super) fn swept(&self, from: &State, to: &State, allowed: Allowed) -> Result<(), Touch> {
        let near = self.near_on([from, to], &Legs::WHOLE, allowed, None);
        if near.as_ref().is_some_and(Vec::is_empty) {
            return Ok(());
        }
        if let Some(near) = near.iter().flatten().find(|near| near.sure != 0) {
            return Err(self.told(near));
        }
        let room = self.room;
        let placed = |state| room.body.placed(&room.machine.map_from_links(state));
        let (placed, last) = (placed(from), placed(to));
        let solids: Vec<(Solid, Vector3<f64>)> =
            placed.iter().zip(&last).map(|(one, other)| (*one, other.centre - one.centre)).collect();
        let look = |part: usize, other: Other| match self.touches_swept(&solids, part, other) {
            Some(other) => Err(room.told(part, other)),
            None => Ok(()),
        };
        if let Some(near) = near {
            return near.into_iter().try_for_each(|near| look(near.pair.part, other(&near.pair)));
        }
        for (limb, part) in self.limbs.iter().zip(0..).filter(|(limb, _)| limb.counts) {
            for (near, at) in self.things.iter().zip(0..) {
                if !limb.may_touch(near.entity, allowed) {
                    look(part, Other::Thing(at))?;
                }
            }
            if limb.is_carried {
                look(part, Other::Floor)?;
            }
        }
        room.body.pairs().iter().try_for_each(|[one, other]| look(*one, Other::Part(*other)))
    }

    /// What a part touches while it moves straight, if it does: a thing as the room knows it.
    fn touches_swept(&self, solids: &[(Solid, Vector3<f64>)], part: usize, other: Other) -> Option<Other> {
        let ((solid, shift), limb) = solids.get(part).zip(self.limbs.get(part))?;
        match other {
            Other::Thing(at) => {
                let near = self.things.get(at)?;
                let metres = solid.swept_distance_to(shift, limb.reach, &near.solid, near.reach, GAP);
                (metres <= GAP).then_some(Other::Thing(near.index))
            }
            Other::Floor => (above_floor(solid) + shift.z.min(0.0) <= GAP).then_some(other),
            Other::Part(at) => {
                let ((beyond, moved), far) = solids.get(at).zip(self.limbs.get(at))?;
                // What goes along stays as far away as it is.
                let shift = shift - moved;
                let is_touched = shift.norm_squared() > 0.0
                    && solid.swept_distance_to(&shift, limb.reach, beyond, far.reach, GAP) <= GAP;
                is_touched.then_some(other)
            }
        }
    }
}

impl Room<'_> {
    /// Whether no part of the robot turns on the straight way between two states.
    pub(super) fn is_straight(&self, from: &State, to: &State) -> bool {
        let ([_, _, yaw], [_, _, to_yaw]) = (from.base, to.base);
        let values = from.joints.iter().zip(&to.joints).zip(self.machine.turning());
        yaw == to_yaw && values.into_iter().all(|((one, other), turns)| one == other || !turns)
    }
}

impl Limb {
    pub(super) fn may_touch(&self, entity: usize, allowed: Allowed) -> bool {
        (self.in_hand && allowed.hand == Some(entity)) || (self.is_held && allowed.held == Some(entity))
    }
}

/// Whether two solids are no farther from each other than [`GAP`].
pub(super) fn touches(one: &Solid, reach: f64, other: &Solid, other_reach: f64) -> bool {
    one.apart(reach, other, other_reach, [GAP, GAP], &mut Vector3::zeros()) <= GAP
}

pub(super) fn above_floor(solid: &Solid) -> f64 {
    solid.centre.z - solid.extent(&Vector3::z())
}
