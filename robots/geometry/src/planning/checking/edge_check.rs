//! Straight ways between two states, certified and not sampled: where every pair of solids is farther apart at the middle than
//! both can come nearer until the ends, the whole of it is free; else it is halved, and only the pairs that were too near are
//! looked at again.

use std::collections::VecDeque;

use nalgebra::Vector3;

use crate::collision::Solid;
use crate::kinematics::AncestorJoint;
use crate::planning::checking::collision_checker::{CollisionChecker, above_floor};
use crate::planning::checking::motion_bound::MotionBound;
use crate::planning::checking::prefilter::{SegmentCentres, other};
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::MIN_CLEARANCE;
use crate::planning::scene::contact::{AllowedCollisions, Contact, ContactTarget};
use crate::simd::{self, NearPair};

/// How often a way is halved before it counts as not free.
const DEPTH: u32 = 10;
/// As often halved, legs are no longer looked at eight at a time.
const QUICK: u32 = 9;
/// How often an eighth of a way is.
const EIGHTH: u32 = 3;

impl CollisionChecker<'_, '_> {
    /// Whether the straight way between two free states is free throughout.
    ///
    /// # Errors
    ///
    /// What touches on the way, or comes so near that nothing certain can be said.
    pub(crate) fn between(
        &self,
        from: &Configuration,
        to: &Configuration,
        allowed: AllowedCollisions,
    ) -> Result<(), Contact> {
        if self.holds(from) && self.holds(to) {
            self.between_here(from, to, allowed)
        } else {
            self.context.along(from, to).between_here(from, to, allowed)
        }
    }

    fn between_here(
        &self,
        from: &Configuration,
        to: &Configuration,
        allowed: AllowedCollisions,
    ) -> Result<(), Contact> {
        if self.context.is_straight(from, to) {
            return self.swept(from, to, allowed);
        }
        let mut way = EdgeCheck::new(self, from, to);
        // What is left to look at; the widest first finds a touch soonest.
        let mut open = VecDeque::new();
        let mut pairs: Vec<SolidPair> = Vec::new();
        if !self.prefilter_edge([from, to], allowed, &mut open, &mut pairs)? {
            open.push_back(Segment { middle: 0.5, half: 0.5, depth: 0, pairs: None });
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
                open.push_back(Segment { middle: leg.middle - half, half, depth, pairs: left });
                open.push_back(Segment { middle: leg.middle + half, half, depth, pairs: left });
            }
        }
        Ok(())
    }
}

impl CollisionChecker<'_, '_> {
    /// Looks at a way eight legs at a time: those on which something is near are left open, with the pairs that are. Whether it could
    /// be looked at in this way at all.
    fn prefilter_edge(
        &self,
        way: [&Configuration; 2],
        allowed: AllowedCollisions,
        open: &mut VecDeque<Segment>,
        pairs: &mut Vec<SolidPair>,
    ) -> Result<bool, Contact> {
        let Some(near) = self.near_on(way, &SegmentCentres::WHOLE, allowed, None) else { return Ok(false) };
        let mut rows = VecDeque::new();
        self.add(way, SegmentBatch { legs: SegmentCentres::WHOLE, depth: EIGHTH, near }, &mut rows)?;
        while let Some(row) = rows.pop_front() {
            if row.depth >= QUICK {
                for lane in row.open() {
                    let first = pairs.len();
                    let near = row.near.iter().filter(|met| met.lanes >> lane & 1 == 1);
                    pairs.extend(near.map(|met| SolidPair::new(met.pair.part, other(&met.pair))));
                    let middle = row.legs.middles.get(lane).copied().unwrap_or(0.5);
                    let near = Some([first, pairs.len()]);
                    open.push_back(Segment { middle, half: row.legs.half, depth: row.depth, pairs: near });
                }
                continue;
            }
            for (legs, depth, near) in row.pieces() {
                let Some(near) = self.near_on(way, &legs, allowed, Some(&near)) else { return Ok(false) };
                self.add(way, SegmentBatch { legs, depth, near }, &mut rows)?;
            }
        }
        Ok(true)
    }

    /// Adds eight legs where something is near on any; an error where something touches in the middle of one.
    fn add(
        &self,
        way: [&Configuration; 2],
        row: SegmentBatch,
        rows: &mut VecDeque<SegmentBatch>,
    ) -> Result<(), Contact> {
        self.still(way, &row)?;
        if !row.near.is_empty() {
            rows.push_back(row);
        }
        Ok(())
    }

    /// Of the pairs that look as if they touch in the middle of a leg, whether one does.
    fn still(
        &self,
        [from, to]: [&Configuration; 2],
        SegmentBatch { legs, near, .. }: &SegmentBatch,
    ) -> Result<(), Contact> {
        let still = near.iter().fold(0, |lanes, met| lanes | met.still);
        for (lane, middle) in legs.middles.iter().enumerate().filter(|(lane, _)| still >> lane & 1 == 1) {
            let configuration = from.towards(to, *middle);
            if let Some(contact) = self.contact_among(near, lane, &configuration) {
                return Err(contact);
            }
        }
        Ok(())
    }
}

/// Eight legs with the pairs that are near on any of them.
struct SegmentBatch {
    legs: SegmentCentres,
    /// How often the way was halved for them.
    depth: u32,
    near: Vec<NearPair>,
}

impl SegmentBatch {
    /// The legs on which something is near.
    fn open(&self) -> impl Iterator<Item = usize> + use<> {
        let lanes = self.near.iter().fold(0, |lanes, met| lanes | met.lanes);
        (0..8).filter(move |lane| lanes >> lane & 1 == 1)
    }

    /// Pieces of those, eight at a time: of four or fewer legs, each cut in as many as there is room for, with how often the way was halved
    /// for them and the pairs to look at on them.
    fn pieces(&self) -> impl Iterator<Item = (SegmentCentres, u32, Vec<(simd::BatchPair, u8)>)> {
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
            let mut legs = SegmentCentres { middles: [begin(first) + half; 8], half };
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
struct PlacedPart {
    /// Of which leg.
    leg: usize,
    solid: Solid,
    /// In the map.
    whole: f64,
}

/// Two solids that are not known to stay apart: a part, and a near thing, another part or the floor.
#[derive(Clone, Copy)]
struct SolidPair {
    part: usize,
    other: ContactTarget,
    /// A direction along which they were apart on the leg of which this is a half; 0 where none is known.
    axis: Vector3<f64>,
}

impl SolidPair {
    fn new(part: usize, other: ContactTarget) -> Self {
        Self { part, other, axis: Vector3::zeros() }
    }
}

/// A leg of a way: from `middle - half` to `middle + half`.
struct Segment {
    middle: f64,
    half: f64,
    depth: u32,
    /// Which pairs it has to look at; all for the first.
    pairs: Option<[usize; 2]>,
}

/// A straight way, with the robot where it is in the middle of a leg.
struct EdgeCheck<'a, 'r, 'w> {
    checker: &'a CollisionChecker<'r, 'w>,
    motion_bound: MotionBound<'a>,
    /// The state in the middle.
    configuration: Configuration,
    along: crate::kinematics::EdgePoses,
    moved: Vec<PlacedPart>,
    leg: usize,
}

impl<'a, 'r, 'w> EdgeCheck<'a, 'r, 'w> {
    fn new(checker: &'a CollisionChecker<'r, 'w>, from: &'a Configuration, to: &'a Configuration) -> Self {
        let nowhere = PlacedPart { leg: 0, solid: Solid::floor(), whole: 0.0 };
        Self {
            checker,
            motion_bound: MotionBound { from, to, half: 0.0 },
            configuration: from.clone(),
            along: checker.context.model.tree().edge_poses(&from.joints, &to.joints),
            moved: vec![nowhere; checker.limbs.len()],
            leg: 0,
        }
    }

    fn go_to(&mut self, middle: f64, half: f64) {
        let model = self.checker.context.model;
        self.configuration.set_towards(self.motion_bound.from, self.motion_bound.to, middle);
        (self.motion_bound.half, self.leg) = (half, self.leg + 1);
        let root = model.map_from_root(self.configuration.base);
        model.tree().place_on_edge(&mut self.along, &root, &self.configuration.joints);
    }

    /// Hands over every pair that may not touch.
    fn all(
        &mut self,
        allowed: AllowedCollisions,
        mut look: impl FnMut(&mut Self, SolidPair) -> Result<(), Contact>,
    ) -> Result<(), Contact> {
        let checker = self.checker;
        for (limb, part) in checker.limbs.iter().zip(0..).filter(|(limb, _)| limb.counts) {
            for (near, at) in checker.obstacles.iter().zip(0..) {
                if !limb.may_touch(near.entity, allowed) {
                    look(self, SolidPair::new(part, ContactTarget::Obstacle(at)))?;
                }
            }
            // The base stands on the floor.
            if limb.is_carried {
                look(self, SolidPair::new(part, ContactTarget::Floor))?;
            }
        }
        for [part, other] in checker.context.body.pairs() {
            look(self, SolidPair::new(*part, ContactTarget::Part(*other)))?;
        }
        Ok(())
    }

    /// Looks at a pair: it touches, or stays apart on the whole leg, or has to be looked at again.
    fn look(&mut self, mut pair: SolidPair, depth: u32, again: &mut Vec<SolidPair>) -> Result<(), Contact> {
        let checker = self.checker;
        let Some((one, limb)) = self.moved(pair.part).zip(checker.limbs.get(pair.part)) else {
            return Ok(());
        };
        let (metres, limit) = match pair.other {
            ContactTarget::Obstacle(at) => {
                let Some(near) = checker.obstacles.get(at) else { return Ok(()) };
                let limit = MIN_CLEARANCE + one.whole;
                let told = [MIN_CLEARANCE, limit];
                (one.solid.apart(limb.reach, &near.solid, near.reach, told, &mut pair.axis), limit)
            }
            ContactTarget::Part(at) => {
                let Some((other, beyond)) = self.moved(at).zip(checker.limbs.get(at)) else { return Ok(()) };
                let limit = MIN_CLEARANCE + self.approach(pair.part, &one.solid, at, &other.solid);
                let told = [MIN_CLEARANCE, limit];
                (one.solid.apart(limb.reach, &other.solid, beyond.reach, told, &mut pair.axis), limit)
            }
            ContactTarget::Floor => (above_floor(&one.solid), MIN_CLEARANCE + one.whole),
        };
        if metres > limit {
            return Ok(());
        }
        if depth >= DEPTH || metres <= MIN_CLEARANCE {
            let other = match pair.other {
                ContactTarget::Obstacle(at) => {
                    ContactTarget::Obstacle(checker.obstacles.get(at).map_or(at, |near| near.index))
                }
                ContactTarget::Part(_) | ContactTarget::Floor => pair.other,
            };
            return Err(checker.context.told(pair.part, other));
        }
        again.push(pair);
        Ok(())
    }

    /// How much two parts of the robot come nearer at most. What moves both moves them alike and does not count.
    fn approach(&self, part: usize, solid: &Solid, other: usize, beyond: &Solid) -> f64 {
        let (context, limbs) = (self.checker.context, &self.checker.limbs);
        let Some((one, two)) = limbs.get(part).zip(limbs.get(other)) else { return 0.0 };
        let (ancestors, others) =
            (context.model.ancestor_joints(one.link), context.model.ancestor_joints(two.link));
        let common = ancestors.iter().zip(others).take_while(|(a, b)| a.frame == b.frame).count();
        let goes = |ancestors: &[AncestorJoint], solid: &Solid, reach: f64| {
            let own = ancestors.get(common..).unwrap_or_default();
            self.motion_bound.by(own, self.along.poses(), solid, reach)
        };
        goes(ancestors, solid, one.reach) + goes(others, beyond, two.reach)
    }

    /// A part where it is, and how far it goes.
    fn moved(&mut self, part: usize) -> Option<PlacedPart> {
        let known = self.moved.get(part)?;
        if known.leg == self.leg {
            return Some(*known);
        }
        let context = self.checker.context;
        let (limb, own) = (self.checker.limbs.get(part)?, context.body.parts().get(part)?);
        let solid = own.solid.moved(self.along.poses().get(limb.link)?);
        let (ancestors, poses) = (context.model.ancestor_joints(limb.link), self.along.poses());
        let whole = self.motion_bound.in_map(self.configuration.base, ancestors, poses, &solid, limb.reach);
        let moved = PlacedPart { leg: self.leg, solid, whole };
        *self.moved.get_mut(part)? = moved;
        Some(moved)
    }
}
