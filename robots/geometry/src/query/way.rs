//! Straight ways between two states, certified and not sampled: where every pair of solids is farther apart at the middle than
//! both can come nearer until the ends, the whole of it is free; else it is halved, and only the pairs that were too near are
//! looked at again.

use std::collections::VecDeque;

use nalgebra::Vector3;

use super::around::{Around, above_floor};
use super::excursion::Excursion;
use super::quick::{Legs, other};
use super::room::GAP;
use super::state::State;
use super::touch::{Allowed, Other, Touch};
use crate::collision::Solid;
use crate::kinematics::AncestorJoint;
use crate::simd::{self, NearPair};

/// How often a way is halved before it counts as not free.
const DEPTH: u32 = 10;
/// As often halved, legs are no longer looked at eight at a time.
const QUICK: u32 = 9;
/// How often an eighth of a way is.
const EIGHTH: u32 = 3;

impl Around<'_, '_> {
    /// Whether the straight way between two free states is free throughout.
    ///
    /// # Errors
    ///
    /// What touches on the way, or comes so near that nothing certain can be said.
    pub(super) fn between(&self, from: &State, to: &State, allowed: Allowed) -> Result<(), Touch> {
        if self.holds(from) && self.holds(to) {
            self.between_here(from, to, allowed)
        } else {
            self.room.along(from, to).between_here(from, to, allowed)
        }
    }

    fn between_here(&self, from: &State, to: &State, allowed: Allowed) -> Result<(), Touch> {
        if self.room.is_straight(from, to) {
            return self.swept(from, to, allowed);
        }
        let mut way = Way::new(self, from, to);
        // What is left to look at; the widest first finds a touch soonest.
        let mut open = VecDeque::new();
        let mut pairs: Vec<Pair> = Vec::new();
        if !self.quickly([from, to], allowed, &mut open, &mut pairs)? {
            open.push_back(Leg { middle: 0.5, half: 0.5, depth: 0, pairs: None });
        }
        while let Some(leg) = open.pop_front() {
            way.go_to(leg.middle, leg.half);
            let first = pairs.len();
            match leg.pairs {
                None => way.all(allowed, |way, pair| way.look(pair, leg.depth, &mut pairs))?,
                Some([from, to]) => {
                    for at in from..to {
                        let Some(pair) = pairs.get(at).copied() else { continue };
                        way.look(pair, leg.depth, &mut pairs)?;
                    }
                }
            }
            if pairs.len() > first {
                let (half, depth, left) = (leg.half / 2.0, leg.depth + 1, Some([first, pairs.len()]));
                open.push_back(Leg { middle: leg.middle - half, half, depth, pairs: left });
                open.push_back(Leg { middle: leg.middle + half, half, depth, pairs: left });
            }
        }
        Ok(())
    }
}

impl Around<'_, '_> {
    /// Looks at a way eight legs at a time: those on which something is near are left open, with the pairs that are. Whether it could
    /// be looked at in this way at all.
    fn quickly(
        &self,
        way: [&State; 2],
        allowed: Allowed,
        open: &mut VecDeque<Leg>,
        pairs: &mut Vec<Pair>,
    ) -> Result<bool, Touch> {
        let Some(near) = self.near_on(way, &Legs::WHOLE, allowed, None) else { return Ok(false) };
        let mut rows = VecDeque::new();
        self.add(way, Row { legs: Legs::WHOLE, depth: EIGHTH, near }, &mut rows)?;
        while let Some(row) = rows.pop_front() {
            if row.depth >= QUICK {
                for lane in row.open() {
                    let first = pairs.len();
                    let near = row.near.iter().filter(|met| met.lanes >> lane & 1 == 1);
                    pairs.extend(near.map(|met| Pair::new(met.pair.part, other(&met.pair))));
                    let middle = row.legs.middles.get(lane).copied().unwrap_or(0.5);
                    let near = Some([first, pairs.len()]);
                    open.push_back(Leg { middle, half: row.legs.half, depth: row.depth, pairs: near });
                }
                continue;
            }
            for (legs, depth, near) in row.pieces() {
                let Some(near) = self.near_on(way, &legs, allowed, Some(&near)) else { return Ok(false) };
                self.add(way, Row { legs, depth, near }, &mut rows)?;
            }
        }
        Ok(true)
    }

    /// Adds eight legs where something is near on any; an error where something touches in the middle of one.
    fn add(&self, way: [&State; 2], row: Row, rows: &mut VecDeque<Row>) -> Result<(), Touch> {
        self.still(way, &row)?;
        if !row.near.is_empty() {
            rows.push_back(row);
        }
        Ok(())
    }

    /// Of the pairs that look as if they touch in the middle of a leg, whether one does.
    fn still(&self, [from, to]: [&State; 2], Row { legs, near, .. }: &Row) -> Result<(), Touch> {
        let still = near.iter().fold(0, |lanes, met| lanes | met.still);
        for (lane, middle) in legs.middles.iter().enumerate().filter(|(lane, _)| still >> lane & 1 == 1) {
            let state = from.towards(to, *middle);
            if let Some(touch) = self.touch_among(near, lane, &state) {
                return Err(touch);
            }
        }
        Ok(())
    }
}

/// Eight legs with the pairs that are near on any of them.
struct Row {
    legs: Legs,
    /// How often the way was halved for them.
    depth: u32,
    near: Vec<NearPair>,
}

impl Row {
    /// The legs on which something is near.
    fn open(&self) -> impl Iterator<Item = usize> + use<> {
        let lanes = self.near.iter().fold(0, |lanes, met| lanes | met.lanes);
        (0..8).filter(move |lane| lanes >> lane & 1 == 1)
    }

    /// Pieces of those, eight at a time: of four or fewer legs, each cut in as many as there is room for, with how often the way was halved
    /// for them and the pairs to look at on them.
    fn pieces(&self) -> impl Iterator<Item = (Legs, u32, Vec<(simd::SolidPair, u8)>)> {
        let mut open = self.open();
        std::iter::from_fn(move || {
            let first = open.next()?;
            let four = [Some(first), open.next(), open.next(), open.next()];
            let (cuts, pieces) = match four {
                [_, None, ..] => (3, 8),
                [_, _, None, _] => (2, 4),
                _ => (1, 2),
            };
            let half = self.legs.half / f64::from(pieces);
            let begin =
                |lane: usize| self.legs.middles.get(lane).map_or(0.5, |middle| middle - self.legs.half);
            let mut legs = Legs { middles: [begin(first) + half; 8], half };
            let slots = legs.middles.chunks_mut(pieces as usize).zip(four.into_iter().flatten());
            for (slots, lane) in slots {
                for (slot, piece) in slots.iter_mut().zip(0..pieces) {
                    *slot = begin(lane) + half * f64::from(2 * piece + 1);
                }
            }
            let all = u8::MAX >> (8 - pieces);
            let on = |met: &NearPair| {
                let ones = four.into_iter().flatten().zip(0..);
                let ones = ones.filter(|(lane, _)| met.lanes >> lane & 1 == 1);
                ones.fold(0, |lanes, (_, at): (usize, u32)| lanes | all << (pieces * at))
            };
            let near = self.near.iter().map(|met| (met.pair, on(met))).filter(|(_, lanes)| *lanes != 0);
            Some((legs, self.depth + cuts, near.collect()))
        })
    }
}

/// A part where it is in the middle of a leg, and how far it goes from there.
#[derive(Clone, Copy)]
struct Moved {
    /// Of which leg.
    leg: usize,
    solid: Solid,
    /// In the map.
    whole: f64,
}

/// Two solids that are not known to stay apart: a part, and a near thing, another part or the floor.
#[derive(Clone, Copy)]
struct Pair {
    part: usize,
    other: Other,
    /// A direction along which they were apart on the leg of which this is a half; 0 where none is known.
    axis: Vector3<f64>,
}

impl Pair {
    fn new(part: usize, other: Other) -> Self {
        Self { part, other, axis: Vector3::zeros() }
    }
}

/// A leg of a way: from `middle - half` to `middle + half`.
struct Leg {
    middle: f64,
    half: f64,
    depth: u32,
    /// Which pairs it has to look at; all for the first.
    pairs: Option<[usize; 2]>,
}

/// A straight way, with the robot where it is in the middle of a leg.
struct Way<'a, 'r, 'w> {
    around: &'a Around<'r, 'w>,
    excursion: Excursion<'a>,
    /// The state in the middle.
    state: State,
    along: crate::kinematics::EdgePoses,
    moved: Vec<Moved>,
    leg: usize,
}

impl<'a, 'r, 'w> Way<'a, 'r, 'w> {
    fn new(around: &'a Around<'r, 'w>, from: &'a State, to: &'a State) -> Self {
        let nowhere = Moved { leg: 0, solid: Solid::floor(), whole: 0.0 };
        Self {
            around,
            excursion: Excursion { from, to, half: 0.0 },
            state: from.clone(),
            along: around.room.machine.tree().edge_poses(&from.joints, &to.joints),
            moved: vec![nowhere; around.limbs.len()],
            leg: 0,
        }
    }

    fn go_to(&mut self, middle: f64, half: f64) {
        let machine = self.around.room.machine;
        self.state.set_towards(self.excursion.from, self.excursion.to, middle);
        (self.excursion.half, self.leg) = (half, self.leg + 1);
        let root = machine.map_from_root(self.state.base);
        machine.tree().place_on_edge(&mut self.along, &root, &self.state.joints);
    }

    /// Hands over every pair that may not touch.
    fn all(
        &mut self,
        allowed: Allowed,
        mut look: impl FnMut(&mut Self, Pair) -> Result<(), Touch>,
    ) -> Result<(), Touch> {
        let around = self.around;
        for (limb, part) in around.limbs.iter().zip(0..).filter(|(limb, _)| limb.counts) {
            for (near, at) in around.things.iter().zip(0..) {
                if !limb.may_touch(near.entity, allowed) {
                    look(self, Pair::new(part, Other::Thing(at)))?;
                }
            }
            // The base stands on the floor.
            if limb.is_carried {
                look(self, Pair::new(part, Other::Floor))?;
            }
        }
        for [part, other] in around.room.body.pairs() {
            look(self, Pair::new(*part, Other::Part(*other)))?;
        }
        Ok(())
    }

    /// Looks at a pair: it touches, or stays apart on the whole leg, or has to be looked at again.
    fn look(&mut self, mut pair: Pair, depth: u32, again: &mut Vec<Pair>) -> Result<(), Touch> {
        let around = self.around;
        let Some((one, limb)) = self.moved(pair.part).zip(around.limbs.get(pair.part)) else { return Ok(()) };
        let (metres, room) = match pair.other {
            Other::Thing(at) => {
                let Some(near) = around.things.get(at) else { return Ok(()) };
                let room = GAP + one.whole;
                let told = [GAP, room];
                (one.solid.apart(limb.reach, &near.solid, near.reach, told, &mut pair.axis), room)
            }
            Other::Part(at) => {
                let Some((other, beyond)) = self.moved(at).zip(around.limbs.get(at)) else { return Ok(()) };
                let room = GAP + self.approach(pair.part, &one.solid, at, &other.solid);
                let told = [GAP, room];
                (one.solid.apart(limb.reach, &other.solid, beyond.reach, told, &mut pair.axis), room)
            }
            Other::Floor => (above_floor(&one.solid), GAP + one.whole),
        };
        if metres > room {
            return Ok(());
        }
        if depth >= DEPTH || metres <= GAP {
            let other = match pair.other {
                Other::Thing(at) => Other::Thing(around.things.get(at).map_or(at, |near| near.index)),
                Other::Part(_) | Other::Floor => pair.other,
            };
            return Err(around.room.told(pair.part, other));
        }
        again.push(pair);
        Ok(())
    }

    /// How much two parts of the robot come nearer at most. What moves both moves them alike and does not count.
    fn approach(&self, part: usize, solid: &Solid, other: usize, beyond: &Solid) -> f64 {
        let (room, limbs) = (self.around.room, &self.around.limbs);
        let Some((one, two)) = limbs.get(part).zip(limbs.get(other)) else { return 0.0 };
        let (ancestors, others) =
            (room.machine.ancestor_joints(one.link), room.machine.ancestor_joints(two.link));
        let common = ancestors.iter().zip(others).take_while(|(a, b)| a.frame == b.frame).count();
        let goes = |ancestors: &[AncestorJoint], solid: &Solid, reach: f64| {
            let own = ancestors.get(common..).unwrap_or_default();
            self.excursion.by(own, self.along.poses(), solid, reach)
        };
        goes(ancestors, solid, one.reach) + goes(others, beyond, two.reach)
    }

    /// A part where it is, and how far it goes.
    fn moved(&mut self, part: usize) -> Option<Moved> {
        let known = self.moved.get(part)?;
        if known.leg == self.leg {
            return Some(*known);
        }
        let room = self.around.room;
        let (limb, own) = (self.around.limbs.get(part)?, room.body.parts().get(part)?);
        let solid = own.solid.moved(self.along.poses().get(limb.link)?);
        let (ancestors, poses) = (room.machine.ancestor_joints(limb.link), self.along.poses());
        let whole = self.excursion.in_map(self.state.base, ancestors, poses, &solid, limb.reach);
        let moved = Moved { leg: self.leg, solid, whole };
        *self.moved.get_mut(part)? = moved;
        Some(moved)
    }
}
