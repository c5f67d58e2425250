//! Bounds for pairs of the robot's own parts over a cell, in the frame of one of them.

use std::rc::Rc;

use nalgebra::{Isometry3, Vector3};

use super::bound_obstacle::{ScaledMotion, is_in};
use super::cover::{CellModel, CellPart, CellPlacement, FAR, FEWER, kept};
use super::relative::{BodyPair, PairGroup, RelativeChains};
use crate::collision::{Shape, Solid};
use crate::planning::certify::deflate::{DeflatedPart, SLACK};
use crate::planning::scene::MIN_CLEARANCE;

impl CellModel<'_, '_, '_> {
    /// Pairs of parts that may not be in contact.
    pub(super) fn pair_groups(&self) -> Rc<[PairGroup]> {
        let mut pair_groups: Vec<([usize; 2], Vec<[u16; 2]>)> = Vec::new();
        let frame = |part: usize| self.limbs.get(part).map(|limb| limb.frame);
        for [one, other] in self.checker.context.body.pairs() {
            let Some((from, to)) = frame(*one).zip(frame(*other)).filter(|(from, to)| from != to) else {
                continue;
            };
            let pair = [*one as u16, *other as u16];
            let (frames, pair) =
                if from < to { ([from, to], pair) } else { ([to, from], [pair[1], pair[0]]) };
            match pair_groups.iter_mut().find(|(known, _)| *known == frames) {
                Some((_, pairs)) => pairs.push(pair),
                None => pair_groups.push((frames, vec![pair])),
            }
        }
        let pair_groups = pair_groups.into_iter().map(|(frames, pairs)| {
            let far = |[_, other]: &[u16; 2]| {
                let limb = self.limbs.get(usize::from(*other));
                limb.map_or(0.0, |limb| limb.solid.centre.norm() + limb.reach)
            };
            let reach = pairs.iter().map(far).fold(0.0, f64::max);
            PairGroup { frames, reach, drift: FAR / FEWER, pairs: pairs.into() }
        });
        pair_groups.collect()
    }

    /// Pairs of two frames that may be in contact; `None` where nothing changed.
    ///
    /// # Errors
    ///
    /// A pair in contact throughout.
    pub(super) fn pair_group(
        &self,
        placing: &mut CellPlacement,
        pair_group: &PairGroup,
    ) -> Result<Option<PairGroup>, BodyPair> {
        if placing.steps.is_empty() {
            return Ok(None);
        }
        self.join(placing);
        let [from, to] = pair_group.frames;
        let at = placing.own.frames.get(to).map_or_else(Vector3::zeros, |pose| pose.translation.vector);
        let Some(relative) = self.pair_groups.relative(from, to, &placing.own.axes) else { return Ok(None) };
        let drift = relative.point(&at, pair_group.reach);
        let is_fewer = drift < FEWER * pair_group.drift;
        let mut left: Vec<[u16; 2]> = Vec::new();
        for pair in pair_group.pairs.iter() {
            let [part, at] = *pair;
            self.ensure_both(placing, part, at);
            let Some((own, other)) = self.both(placing, part, at) else { continue };
            if is_fewer && own.is_apart(other, drift) {
                continue;
            }
            // A pair that is apart in the middle is not in contact throughout.
            if own.is_near(other) && self.touches_by(placing, [own, other], 1.0) {
                return Err(BodyPair::RelativePlacement(part, at));
            }
            if is_fewer {
                left.push(*pair);
            }
        }
        Ok(is_fewer.then(|| PairGroup { drift, pairs: kept(left, &pair_group.pairs), ..*pair_group }))
    }

    /// Checks whether two parts are in contact in the middle.
    pub(super) fn is_folded_in_middle(&self, placing: &mut CellPlacement, pair_groups: &[PairGroup]) -> bool {
        pair_groups.iter().flat_map(PairGroup::pairs).any(|pair| self.touches_in_middle(placing, pair))
    }

    /// Two parts relative to each other in the middle of a cell, where placed.
    pub(super) fn both<'p>(
        &'p self,
        placing: &'p CellPlacement,
        part: u16,
        at: u16,
    ) -> Option<(RelativePart<'p>, RelativePart<'p>)> {
        let joined = |part: u16| {
            let solid = placing.own.parts.get(usize::from(part))?.as_ref()?;
            Some(RelativePart { limb: self.limbs.get(usize::from(part))?, solid })
        };
        Some((joined(part)?, joined(at)?))
    }

    /// Checks whether two parts are in contact throughout a share of their relative motion.
    pub(super) fn touches_by(
        &self,
        placing: &CellPlacement,
        [one, other]: [RelativePart<'_>; 2],
        share: f64,
    ) -> bool {
        let (from, to) = (one.limb.frame, other.limb.frame);
        let pair_groups =
            [(from, to), (to, from)].map(|(from, to)| self.pair_groups.relative(from, to, &placing.own.axes));
        let [Some(relative), Some(back)] = pair_groups else { return false };
        // Most near pairs are apart even in the middle.
        if !one.solid.is_nearer(other.solid, MIN_CLEARANCE) {
            return false;
        }
        if let Some(step) = relative.slide() {
            // Contact at both ends of a slide holds between them.
            let ends =
                [step, -step].map(|step| Solid { centre: other.solid.centre + step * share, ..*other.solid });
            return ends.iter().all(|end| one.solid.is_nearer(end, MIN_CLEARANCE - SLACK));
        }
        let is_round = |joined: &RelativePart<'_>| matches!(joined.solid.shape, Shape::Capsule { .. });
        if is_round(&other) && is_in(other.solid, &ScaledMotion(share, &relative), one.solid, MIN_CLEARANCE)
            || (is_round(&one) || !is_round(&other))
                && is_in(one.solid, &ScaledMotion(share, &back), other.solid, MIN_CLEARANCE)
        {
            return true;
        }
        one.touches(other, share * relative.drift(other.solid))
    }

    /// Checks contact throughout a share of the relative motion of two parts.
    pub(super) fn own_touches(&self, placing: &mut CellPlacement, part: u16, at: u16, share: f64) -> bool {
        self.ensure_both(placing, part, at);
        let both = self.both(placing, part, at);
        both.is_some_and(|(one, other)| one.is_near(other) && self.touches_by(placing, [one, other], share))
    }

    /// Drift of the second part in the frame of the first.
    pub(super) fn own_off(&self, placing: &mut CellPlacement, part: u16, at: u16) -> f64 {
        self.ensure_both(placing, part, at);
        let Some((one, other)) = self.both(placing, part, at) else { return 0.0 };
        let relative = self.pair_groups.relative(one.limb.frame, other.limb.frame, &placing.own.axes);
        relative.map_or(0.0, |relative| relative.drift(other.solid))
    }

    /// Places the frames relative to each other.
    pub(super) fn join(&self, placing: &mut CellPlacement) {
        if !placing.own.axes.is_empty() {
            return;
        }
        placing.own.frames.clear();
        if placing.is_joined {
            placing.own.frames.extend(placing.frames.iter().map(|(pose, _)| *pose));
        } else {
            placing.own.frames.push(Isometry3::identity());
            for (joint, [position, _]) in self.reduced.joints.iter().zip(&placing.steps) {
                let parent = placing.own.frames.get(joint.parent).copied().unwrap_or_default();
                placing.own.frames.push(parent * joint.before * joint.motion(*position));
            }
        }
        let offs: Vec<f64> = placing.steps.iter().map(|[_, off]| *off).collect();
        placing.own.axes = RelativeChains::axes(&self.reduced, &placing.own.frames, &offs);
    }

    /// Places two parts relative to each other.
    pub(super) fn ensure_both(&self, placing: &mut CellPlacement, part: u16, at: u16) {
        self.join(placing);
        self.ensure_own(placing, part);
        self.ensure_own(placing, at);
    }

    /// Places a part by the joints.
    fn ensure_own(&self, placing: &mut CellPlacement, part: u16) {
        let at = usize::from(part);
        let Some(slot @ None) = placing.own.parts.get_mut(at) else { return };
        let Some(limb) = self.limbs.get(at) else { return };
        *slot = placing.own.frames.get(limb.frame).map(|frame| limb.solid.moved(frame));
    }
}

/// Part placed by the joints.
#[derive(Clone, Copy)]
pub(super) struct RelativePart<'p> {
    pub(super) limb: &'p CellPart,
    pub(super) solid: &'p Solid,
}

impl RelativePart<'_> {
    /// Checks whether the bounding balls of two parts are near.
    pub(super) fn is_near(&self, other: RelativePart<'_>) -> bool {
        let near = self.limb.reach + other.limb.reach + MIN_CLEARANCE;
        (self.solid.centre - other.solid.centre).norm_squared() <= near * near
    }

    /// Checks whether two parts are in contact throughout a drift.
    pub(super) fn touches(&self, other: RelativePart<'_>, drift: f64) -> bool {
        let own = DeflatedPart { solid: *self.solid, inner: self.limb.inner, reach: self.limb.reach, drift };
        own.touches(other.solid, [other.limb.inner, other.limb.reach], MIN_CLEARANCE, drift)
    }

    /// Checks whether two parts are apart throughout a drift.
    pub(super) fn is_apart(&self, other: RelativePart<'_>, drift: f64) -> bool {
        let far = self.limb.reach + other.limb.reach + MIN_CLEARANCE + drift + SLACK;
        (self.solid.centre - other.solid.centre).norm_squared() > far * far
    }
}

#[cfg(test)]
#[allow(clippy::indexing_slicing, clippy::unwrap_used, reason = "a test fails by panicking")]
impl CellModel<'_, '_, '_> {
    /// Excess of the parts' relative motion in a configuration over the bound.
    pub(super) fn beyond_ties(
        &self,
        placing: &mut CellPlacement,
        solids: &[Solid],
        poses: &[Isometry3<f64>],
    ) -> f64 {
        use super::bound_obstacle::MotionExtent as _;
        let mut most = f64::NEG_INFINITY;
        for pair_group in self.pair_groups().iter() {
            for [part, at] in pair_group.pairs.iter() {
                self.ensure_both(placing, *part, *at);
                let Some((one, other)) = self.both(placing, *part, *at) else { return f64::INFINITY };
                let (from, to) = (one.limb.frame, other.limb.frame);
                let relative = self.pair_groups.relative(from, to, &placing.own.axes).unwrap();
                let drift = relative.drift(other.solid);
                let ball = other.limb.solid.centre;
                let off =
                    relative.point(&(placing.own.frames[to] * nalgebra::Point3::from(ball)).coords, 0.0);
                assert!(off <= drift + 1e-9 && pair_group.reach >= ball.norm());
                let link = self.checker.context.body.parts()[usize::from(*part)].link;
                let middle = placing.own.frames[from] * self.reduced.links[link].1;
                let (seen, is) = (other.solid.moved(&middle.inverse()), &solids[usize::from(*at)]);
                let is = is.moved(&poses[link].inverse());
                let along = |solid: &Solid| match solid.shape {
                    Shape::Capsule { half, .. } | Shape::Cylinder { half, .. } => solid.axes[2] * half,
                    _ => Vector3::zeros(),
                };
                for sign in [1.0, -1.0] {
                    let gone = seen.centre + along(&seen) * sign - is.centre - along(&is) * sign;
                    most = most.max(gone.norm() - drift);
                    let end = other.solid.centre + along(other.solid) * sign;
                    for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
                        let along = relative.along(&end, &(middle.rotation * axis));
                        most = most.max(gone.dot(&axis).abs() - along);
                    }
                }
            }
        }
        most
    }
}
