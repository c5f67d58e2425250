//! What two parts of the robot do in a cell, seen from each other.

use std::rc::Rc;

use nalgebra::{Isometry3, Vector3};

use super::board::{Share, is_in};
use super::cover::{Cover, FAR, FEWER, Limb, Pair, Placing, kept};
use super::tie::{Axis, Tied, Ties};
use crate::collision::{Shape, Solid};
use crate::query::room::GAP;
use crate::query::shrunk::{Placed, SLACK};

/// The robot by itself in the middle of a cell, where that was asked for.
#[derive(Default)]
pub(super) struct Own {
    pub(super) axes: Vec<Axis>,
    /// From any place to the frames, where those in the map do not tell.
    pub(super) frames: Vec<Isometry3<f64>>,
    pub(super) parts: Vec<Option<Solid>>,
}

impl Cover<'_, '_, '_> {
    /// The pairs of parts that may not touch.
    pub(super) fn ties(&self) -> Rc<[Tied]> {
        let mut ties: Vec<([usize; 2], Vec<[u16; 2]>)> = Vec::new();
        let frame = |part: usize| self.limbs.get(part).map(|limb| limb.frame);
        for [one, other] in self.around.room.body.pairs() {
            let Some((from, to)) = frame(*one).zip(frame(*other)).filter(|(from, to)| from != to) else {
                continue;
            };
            let pair = [*one as u16, *other as u16];
            let (frames, pair) =
                if from < to { ([from, to], pair) } else { ([to, from], [pair[1], pair[0]]) };
            match ties.iter_mut().find(|(known, _)| *known == frames) {
                Some((_, pairs)) => pairs.push(pair),
                None => ties.push((frames, vec![pair])),
            }
        }
        let ties = ties.into_iter().map(|(frames, pairs)| {
            let far = |[_, other]: &[u16; 2]| {
                let limb = self.limbs.get(usize::from(*other));
                limb.map_or(0.0, |limb| limb.solid.centre.norm() + limb.reach)
            };
            let reach = pairs.iter().map(far).fold(0.0, f64::max);
            Tied { frames, reach, drift: FAR / FEWER, pairs: pairs.into() }
        });
        ties.collect()
    }

    /// What of the parts of two frames may touch; `None` where they are as they were.
    ///
    /// # Errors
    ///
    /// What touches throughout.
    pub(super) fn tied(&self, placing: &mut Placing, tied: &Tied) -> Result<Option<Tied>, Pair> {
        if placing.steps.is_empty() {
            return Ok(None);
        }
        self.join(placing);
        let [from, to] = tied.frames;
        let at = placing.own.frames.get(to).map_or_else(Vector3::zeros, |pose| pose.translation.vector);
        let Some(tie) = self.ties.tie(from, to, &placing.own.axes) else { return Ok(None) };
        let drift = tie.point(&at, tied.reach);
        let is_fewer = drift < FEWER * tied.drift;
        let mut left: Vec<[u16; 2]> = Vec::new();
        for pair in tied.pairs.iter() {
            let [part, at] = *pair;
            self.ensure_both(placing, part, at);
            let Some((own, other)) = self.both(placing, part, at) else { continue };
            if is_fewer && own.is_apart(other, drift) {
                continue;
            }
            // What is not near in the middle does not touch throughout.
            if own.is_near(other) && self.touches_by(placing, [own, other], 1.0) {
                return Err(Pair::Own(part, at));
            }
            if is_fewer {
                left.push(*pair);
            }
        }
        Ok(is_fewer.then(|| Tied { drift, pairs: kept(left, &tied.pairs), ..*tied }))
    }

    /// Whether two parts of any touch in the middle.
    pub(super) fn is_folded_in_middle(&self, placing: &mut Placing, ties: &[Tied]) -> bool {
        ties.iter().flat_map(Tied::pairs).any(|pair| self.touches_in_middle(placing, pair))
    }

    /// Two parts where they are to each other in the middle of a cell, where that was asked for.
    pub(super) fn both<'p>(
        &'p self,
        placing: &'p Placing,
        part: u16,
        at: u16,
    ) -> Option<(Joined<'p>, Joined<'p>)> {
        let joined = |part: u16| {
            let solid = placing.own.parts.get(usize::from(part))?.as_ref()?;
            Some(Joined { limb: self.limbs.get(usize::from(part))?, solid })
        };
        Some((joined(part)?, joined(at)?))
    }

    /// Whether two parts touch wherever the joints between them put them, by no more than a share of how far those go.
    pub(super) fn touches_by(&self, placing: &Placing, [one, other]: [Joined<'_>; 2], share: f64) -> bool {
        let (from, to) = (one.limb.frame, other.limb.frame);
        let ties = [(from, to), (to, from)].map(|(from, to)| self.ties.tie(from, to, &placing.own.axes));
        let [Some(tie), Some(back)] = ties else { return false };
        // Most that are near do not even touch in the middle.
        if !one.solid.is_nearer(other.solid, GAP) {
            return false;
        }
        if let Some(step) = tie.slide() {
            // What touches at both ends of a straight way touches on all of it.
            let ends =
                [step, -step].map(|step| Solid { centre: other.solid.centre + step * share, ..*other.solid });
            return ends.iter().all(|end| one.solid.is_nearer(end, GAP - SLACK));
        }
        let is_round = |joined: &Joined<'_>| matches!(joined.solid.shape, Shape::Capsule { .. });
        if is_round(&other) && is_in(other.solid, &Share(share, &tie), one.solid)
            || (is_round(&one) || !is_round(&other)) && is_in(one.solid, &Share(share, &back), other.solid)
        {
            return true;
        }
        one.touches(other, share * tie.drift(other.solid))
    }

    /// The same of any two.
    pub(super) fn own_touches(&self, placing: &mut Placing, part: u16, at: u16, share: f64) -> bool {
        self.ensure_both(placing, part, at);
        let both = self.both(placing, part, at);
        both.is_some_and(|(one, other)| one.is_near(other) && self.touches_by(placing, [one, other], share))
    }

    /// How far the second of two parts can be off, seen from the first.
    pub(super) fn own_off(&self, placing: &mut Placing, part: u16, at: u16) -> f64 {
        self.ensure_both(placing, part, at);
        let Some((one, other)) = self.both(placing, part, at) else { return 0.0 };
        let tie = self.ties.tie(one.limb.frame, other.limb.frame, &placing.own.axes);
        tie.map_or(0.0, |tie| tie.drift(other.solid))
    }

    /// Puts the joints where they are to each other.
    pub(super) fn join(&self, placing: &mut Placing) {
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
        placing.own.axes = Ties::axes(&self.reduced, &placing.own.frames, &offs);
    }

    /// Puts two parts where the joints do.
    pub(super) fn ensure_both(&self, placing: &mut Placing, part: u16, at: u16) {
        self.join(placing);
        self.ensure_own(placing, part);
        self.ensure_own(placing, at);
    }

    /// Puts a part where the joints do.
    fn ensure_own(&self, placing: &mut Placing, part: u16) {
        let at = usize::from(part);
        let Some(slot @ None) = placing.own.parts.get_mut(at) else { return };
        let Some(limb) = self.limbs.get(at) else { return };
        *slot = placing.own.frames.get(limb.frame).map(|frame| limb.solid.moved(frame));
    }
}

/// A part where the joints put it.
#[derive(Clone, Copy)]
pub(super) struct Joined<'p> {
    pub(super) limb: &'p Limb,
    pub(super) solid: &'p Solid,
}

impl Joined<'_> {
    /// Whether the balls around two are so near that they may touch.
    pub(super) fn is_near(&self, other: Joined<'_>) -> bool {
        let near = self.limb.reach + other.limb.reach + GAP;
        (self.solid.centre - other.solid.centre).norm_squared() <= near * near
    }

    /// Whether two touch, wherever they are by so much.
    pub(super) fn touches(&self, other: Joined<'_>, drift: f64) -> bool {
        let own = Placed { solid: *self.solid, inner: self.limb.inner, reach: self.limb.reach, drift };
        own.touches(other.solid, other.limb.inner, other.limb.reach, drift)
    }

    /// Whether two are apart, wherever they are by so much.
    pub(super) fn is_apart(&self, other: Joined<'_>, drift: f64) -> bool {
        let far = self.limb.reach + other.limb.reach + GAP + drift + SLACK;
        (self.solid.centre - other.solid.centre).norm_squared() > far * far
    }
}

#[cfg(test)]
#[allow(clippy::indexing_slicing, clippy::unwrap_used, reason = "a test fails by panicking")]
impl Cover<'_, '_, '_> {
    /// By how much parts are farther off from each other than is said of two, with all where they are in a state and the links at poses.
    pub(super) fn beyond_ties(
        &self,
        placing: &mut Placing,
        solids: &[Solid],
        poses: &[Isometry3<f64>],
    ) -> f64 {
        use super::board::Goes as _;
        let mut most = f64::NEG_INFINITY;
        for tied in self.ties().iter() {
            for [part, at] in tied.pairs.iter() {
                self.ensure_both(placing, *part, *at);
                let Some((one, other)) = self.both(placing, *part, *at) else { return f64::INFINITY };
                let (from, to) = (one.limb.frame, other.limb.frame);
                let tie = self.ties.tie(from, to, &placing.own.axes).unwrap();
                let drift = tie.drift(other.solid);
                let ball = other.limb.solid.centre;
                let off = tie.point(&(placing.own.frames[to] * nalgebra::Point3::from(ball)).coords, 0.0);
                assert!(off <= drift + 1e-9 && tied.reach >= ball.norm());
                let link = self.around.room.body.parts()[usize::from(*part)].link;
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
                        let along = tie.along(&end, &(middle.rotation * axis));
                        most = most.max(gone.dot(&axis).abs() - along);
                    }
                }
            }
        }
        most
    }
}
