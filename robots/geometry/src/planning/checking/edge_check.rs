//! Continuous edge check, certified and not sampled.
//!
//! Where every pair of solids is farther apart at the middle of a segment than their motion bounds allow
//! them to approach, the whole segment is free. Else it is halved, and only the undecided pairs are checked
//! again (Schwarzer, Saha and Latombe 2005).
//!
//! A motion bound adds up joint by joint from the link outwards: a joint that turns by `a` moves a point at a
//! distance `r` from its axis by at most `a r`.

use std::collections::VecDeque;

use nalgebra::{Isometry3, Vector3};

use super::collision_checker::{CollisionChecker, SegmentCentres, other};
use crate::collision::Solid;
use crate::kinematics::AncestorJoint;
use crate::planning::scene::{
    AllowedCollisions, Configuration, Contact, ContactTarget, MIN_CLEARANCE, above_floor,
};
use crate::simd;
use crate::simd::NearPair;

/// Greatest number of halvings; an edge that needs more counts as blocked.
const DEPTH: u32 = 10;
/// Number of halvings from which on segments are checked one by one.
const QUICK: u32 = 9;
/// Halvings of an eighth of an edge.
const EIGHTH: u32 = 3;

impl CollisionChecker<'_, '_> {
    /// Checks whether the edge between two free configurations is free.
    ///
    /// # Errors
    ///
    /// The contact, or a pair that comes too near to be certified.
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
        let mut way = EdgeCheck::new(self, from, to, allowed);
        // Undecided segments, the longest first: they meet a contact soonest.
        let mut open = VecDeque::new();
        let mut pairs: Vec<SolidPair> = Vec::new();
        if !self.prefilter_edge([from, to], allowed, &mut open, &mut pairs)? {
            open.push_back(Segment { middle: 0.5, half: 0.5, depth: 0, pairs: None });
        }
        while let Some(leg) = open.pop_front() {
            way.go_to(leg.middle, leg.half);
            let first = pairs.len();
            match leg.pairs {
                None => way.all(|way, pair| way.look(pair, leg.depth, &mut pairs))?,
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
    /// Checks an edge in batches of eight segments and leaves those open that come near something. Returns
    /// `false` where the batch model does not apply.
    fn prefilter_edge(
        &self,
        way: [&Configuration; 2],
        allowed: AllowedCollisions,
        open: &mut VecDeque<Segment>,
        pairs: &mut Vec<SolidPair>,
    ) -> Result<bool, Contact> {
        let Some(near) = self.near_on(way, &SegmentCentres::WHOLE, allowed, None) else { return Ok(false) };
        let mut rows = VecDeque::new();
        let whole = SegmentBatch { legs: SegmentCentres::WHOLE, depth: EIGHTH, near };
        self.add(way, whole, allowed, &mut rows)?;
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
                self.add(way, SegmentBatch { legs, depth, near }, allowed, &mut rows)?;
            }
        }
        Ok(true)
    }

    /// Keeps a batch where a segment comes near something; an error where the middle of one is in contact.
    fn add(
        &self,
        way: [&Configuration; 2],
        row: SegmentBatch,
        allowed: AllowedCollisions,
        rows: &mut VecDeque<SegmentBatch>,
    ) -> Result<(), Contact> {
        self.still(way, &row, allowed)?;
        if !row.near.is_empty() {
            rows.push_back(row);
        }
        Ok(())
    }

    /// Confirms in `f64` the contacts that a batch suspects at the middle of its segments.
    fn still(
        &self,
        [from, to]: [&Configuration; 2],
        SegmentBatch { legs, near, .. }: &SegmentBatch,
        allowed: AllowedCollisions,
    ) -> Result<(), Contact> {
        let still = near.iter().fold(0, |lanes, met| lanes | met.still);
        for (lane, middle) in legs.middles.iter().enumerate().filter(|(lane, _)| still >> lane & 1 == 1) {
            let configuration = from.towards(to, *middle);
            if let Some(contact) = self.contact_among(near, lane, &configuration, allowed) {
                return Err(contact);
            }
        }
        Ok(())
    }
}

/// Eight segments with the pairs that are near on any of them.
struct SegmentBatch {
    legs: SegmentCentres,
    /// Number of halvings that led to them.
    depth: u32,
    near: Vec<NearPair>,
}

impl SegmentBatch {
    /// Segments with a near pair.
    fn open(&self) -> impl Iterator<Item = usize> + use<> {
        let lanes = self.near.iter().fold(0, |lanes, met| lanes | met.lanes);
        (0..8).filter(move |lane| lanes >> lane & 1 == 1)
    }

    /// Halves of the open segments in batches of eight, with the number of halvings and the pairs to check.
    /// Up to four segments a batch, each cut into as many pieces as fit.
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

/// Part at the middle of a segment, with its motion bound.
#[derive(Clone, Copy)]
struct PlacedPart {
    /// Number of the segment for which it was placed.
    leg: usize,
    solid: Solid,
    /// Motion bound in the map, in m.
    whole: f64,
}

/// Undecided pair: a part, and an obstacle, another part or the floor.
#[derive(Clone, Copy)]
struct SolidPair {
    part: usize,
    other: ContactTarget,
    /// Separating direction of the parent segment; zero where none is known.
    axis: Vector3<f64>,
}

impl SolidPair {
    fn new(part: usize, other: ContactTarget) -> Self {
        Self { part, other, axis: Vector3::zeros() }
    }
}

/// Segment of an edge from `middle - half` to `middle + half`.
struct Segment {
    middle: f64,
    half: f64,
    depth: u32,
    /// Range of its undecided pairs; `None` for all pairs.
    pairs: Option<[usize; 2]>,
}

/// Check of one edge, with the robot at the middle of a segment.
struct EdgeCheck<'a, 'r, 'w> {
    checker: &'a CollisionChecker<'r, 'w>,
    motion_bound: MotionBound<'a>,
    allowed: AllowedCollisions,
    /// Configuration at the middle.
    configuration: Configuration,
    along: crate::kinematics::EdgePoses,
    moved: Vec<PlacedPart>,
    leg: usize,
}

impl<'a, 'r, 'w> EdgeCheck<'a, 'r, 'w> {
    fn new(
        checker: &'a CollisionChecker<'r, 'w>,
        from: &'a Configuration,
        to: &'a Configuration,
        allowed: AllowedCollisions,
    ) -> Self {
        let nowhere = PlacedPart { leg: 0, solid: Solid::floor(), whole: 0.0 };
        Self {
            checker,
            motion_bound: MotionBound { from, to, half: 0.0 },
            allowed,
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

    /// Visits every pair that may not be in contact.
    fn all(
        &mut self,
        mut look: impl FnMut(&mut Self, SolidPair) -> Result<(), Contact>,
    ) -> Result<(), Contact> {
        let (checker, allowed) = (self.checker, self.allowed);
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

    /// Checks a pair on a segment: in contact, free, or to be checked again on the halves.
    fn look(&mut self, mut pair: SolidPair, depth: u32, again: &mut Vec<SolidPair>) -> Result<(), Contact> {
        let checker = self.checker;
        let Some((one, limb)) = self.moved(pair.part).zip(checker.limbs.get(pair.part)) else {
            return Ok(());
        };
        let (metres, pad, limit) = match pair.other {
            ContactTarget::Obstacle(at) => {
                let Some(near) = checker.obstacles.get(at) else { return Ok(()) };
                let pad = limb.padding(near.entity, near.padding, self.allowed);
                let limit = pad + one.whole;
                (
                    one.solid.apart(limb.reach, &near.solid, near.reach, [pad, limit], &mut pair.axis),
                    pad,
                    limit,
                )
            }
            ContactTarget::Part(at) => {
                let Some((other, beyond)) = self.moved(at).zip(checker.limbs.get(at)) else { return Ok(()) };
                let limit = MIN_CLEARANCE + self.approach(pair.part, &one.solid, at, &other.solid);
                let told = [MIN_CLEARANCE, limit];
                let metres = one.solid.apart(limb.reach, &other.solid, beyond.reach, told, &mut pair.axis);
                (metres, MIN_CLEARANCE, limit)
            }
            ContactTarget::Floor => (above_floor(&one.solid), MIN_CLEARANCE, MIN_CLEARANCE + one.whole),
        };
        if metres > limit {
            return Ok(());
        }
        if depth >= DEPTH || metres <= pad {
            let other = match pair.other {
                ContactTarget::Obstacle(at) => {
                    ContactTarget::Obstacle(checker.obstacles.get(at).map_or(at, |near| near.index))
                }
                ContactTarget::Part(_) | ContactTarget::Floor => pair.other,
            };
            return Err(checker.context.named_contact(pair.part, other));
        }
        again.push(pair);
        Ok(())
    }

    /// Approach bound of two parts. Joints that move both alike do not count.
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

    /// Part at the middle of the segment, placed once.
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

/// Motion bounds on one segment of an edge, from its middle to either end.
#[derive(Clone, Copy)]
pub(crate) struct MotionBound<'a> {
    pub(crate) from: &'a Configuration,
    pub(crate) to: &'a Configuration,
    /// Half of the segment's length as a share of the edge.
    pub(crate) half: f64,
}

impl MotionBound<'_> {
    /// Greatest distance in m that a point of a solid moves by some joints. `poses` are the link poses at
    /// the middle; a ball of radius `reach` about its centre holds the solid.
    pub(crate) fn by(
        &self,
        ancestors: &[AncestorJoint],
        poses: &[Isometry3<f64>],
        solid: &Solid,
        reach: f64,
    ) -> f64 {
        let change = |at: usize| {
            let value = |joints: &[f64]| joints.get(at).copied().unwrap_or(0.0);
            (value(&self.to.joints) - value(&self.from.joints)).abs() * self.half
        };
        let mut goes = 0.0;
        for ancestor in ancestors.iter().rev() {
            let amount = change(ancestor.coupling.dof) * ancestor.coupling.multiplier.abs();
            if amount == 0.0 {
                continue;
            }
            goes += if ancestor.is_prismatic {
                amount
            } else {
                let pose = poses.get(ancestor.frame).copied().unwrap_or_default();
                let axis = pose.rotation * ancestor.axis.into_inner();
                let arm = (solid.centre - pose.translation.vector).cross(&axis).norm() + reach;
                amount * (arm + goes)
            };
        }
        goes
    }

    /// Greatest distance in the map, which adds the motion of the base.
    pub(crate) fn in_map(
        &self,
        base: [f64; 3],
        ancestors: &[AncestorJoint],
        poses: &[Isometry3<f64>],
        solid: &Solid,
        reach: f64,
    ) -> f64 {
        let goes = self.by(ancestors, poses, solid, reach);
        let ([x, y, yaw], [to_x, to_y, to_yaw]) = (self.from.base, self.to.base);
        let (dx, dy, turn) = (to_x - x, to_y - y, (to_yaw - yaw).abs() * self.half);
        let shift = (dx * dx + dy * dy).sqrt() * self.half;
        if turn == 0.0 {
            return goes + shift;
        }
        let [base_x, base_y, _] = base;
        let (dx, dy) = (solid.centre.x - base_x, solid.centre.y - base_y);
        let arm = (dx * dx + dy * dy).sqrt() + reach;
        goes + turn * (arm + goes) + shift
    }
}
