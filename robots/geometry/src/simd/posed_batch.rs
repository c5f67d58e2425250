//! Batch model placed in eight configurations.

use pulp::Simd;

use super::batch_model::{Batch8, BatchJoint, BatchModel, bit};
use super::boxes::{Aabb, AabbRows};
use super::lanes::{Lane8, Lane8x3, Lanes, Lanes3};
use super::separation::{CapsuleMotion, FrameMotion, FrameMotion8};

/// Poses of a batch model in eight configurations, and the motion around each. Parts that are not needed have
/// no defined pose.
#[derive(Debug, Default)]
pub(crate) struct PosedBatch {
    frames: Vec<Frame>,
    pub(super) parts: Vec<PosedPart>,
    /// Axis-aligned boxes of all parts.
    pub(super) bounds: AabbRows,
    /// On an edge, the motions of each frame: see [`PosedBatch::motion`].
    motions: Vec<FrameMotion8>,
}

/// Frame: its axes and origin, and the axis of its joint.
#[derive(Clone, Copy, Debug, Default)]
struct Frame {
    turn: [Lane8x3; 3],
    at: Lane8x3,
    axis: Lane8x3,
}

/// Part with its pose and motion.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PosedPart {
    pub(super) centre: Lane8x3,
    /// From the centre to an end of its axis.
    pub(super) half: Lane8x3,
    /// Greatest displacement of any of its points in the map frame.
    pub(super) goes: Lane8,
    /// True if any displacement is above 0.
    pub(super) moves: bool,
    /// Axis-aligned box around all its places, without the slack, if requested.
    pub(super) bound: Aabb,
}

impl PosedBatch {
    /// Places the needed parts of a batch model, and computes their boxes if requested.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn set<S: Simd>(
        &mut self,
        simd: S,
        batch_model: &BatchModel,
        batch: &Batch8,
        needed: impl Fn(usize) -> bool,
        needs_bounds: bool,
    ) {
        self.frames.resize(batch_model.joints.len() + 1, Frame::default());
        self.parts.resize(batch_model.parts.len(), PosedPart::default());
        self.motions.resize(batch_model.ancestors.len() * batch_model.stride(), FrameMotion8::default());
        let mut frames = 0;
        for (part, at) in batch_model.parts.iter().zip(0..) {
            if needed(at) {
                frames |= part.carriers;
            }
        }
        for chunk in 0..8 / S::F32_LANES {
            self.carry(simd, batch_model, batch, frames, chunk);
            if batch.is_way {
                self.motion(simd, batch_model, batch, frames, chunk);
            }
            self.place(simd, batch_model, batch, &needed, needs_bounds, chunk);
        }
    }

    /// Places the frames whose bits are set.
    #[cfg_attr(optimised, inline(always))]
    fn carry<S: Simd>(
        &mut self,
        simd: S,
        batch_model: &BatchModel,
        batch: &Batch8,
        frames: u64,
        chunk: usize,
    ) {
        let base = Lanes3::of(simd, &batch.base, chunk);
        let root = &batch_model.base_from_root;
        let [sin, cos] = base.0[2].sin_cos();
        if let Some(frame) = self.frames.first_mut() {
            for (slot, column) in frame.turn.iter_mut().zip(root.turn) {
                about(simd, [sin, cos], column).store(slot, chunk);
            }
            let Lanes3([x, y, z]) = about(simd, [sin, cos], root.at);
            Lanes3([x + base.0[0], y + base.0[1], z]).store(&mut frame.at, chunk);
        }
        if let (Some([x, y, z, at]), Some(frame)) = (batch.root, self.frames.first_mut()) {
            (frame.turn, frame.at) = ([x, y, z], at);
        }
        for ((joint, positions), at) in batch_model.joints.iter().zip(&batch.positions).zip(1..) {
            if frames & bit(at) == 0 {
                continue;
            }
            let Some(parent) = self.frames.get(joint.parent).copied() else { continue };
            if let Some(slot) = self.frames.get_mut(at) {
                parent.carry(simd, joint, Lanes::of(simd, positions, chunk), slot, chunk);
            }
        }
    }

    #[cfg_attr(optimised, inline(always))]
    fn place<S: Simd>(
        &mut self,
        simd: S,
        batch_model: &BatchModel,
        batch: &Batch8,
        needed: &impl Fn(usize) -> bool,
        needs_bounds: bool,
        chunk: usize,
    ) {
        let stride = batch_model.stride();
        for ((place, part), at) in self.parts.iter_mut().zip(&batch_model.parts).zip(0..) {
            if !needed(at) {
                continue;
            }
            if chunk == 0 {
                place.moves = false;
                place.bound = Aabb::NOWHERE;
            }
            let Some(frame) = self.frames.get(part.frame) else { continue };
            let centre = frame.point(simd, part.centre, chunk);
            centre.store(&mut place.centre, chunk);
            let half = frame.direction(simd, part.half, chunk);
            half.store(&mut place.half, chunk);
            let whole = match self.motions.get(part.frame * stride) {
                Some(motion) if batch.is_way => motion.goes(simd, part.far, chunk),
                Some(_) | None => Lanes::splat(simd, 0.0),
            };
            whole.store(&mut place.goes, chunk);
            place.moves |= whole.max_lane() > 0.0;
            if !needs_bounds {
                continue;
            }
            let wide = whole + Lanes::splat(simd, part.radius);
            let (Lanes3([x, y, z]), Lanes3([a, b, c])) = (centre, half);
            let (a, b, c) = (a.abs() + wide, b.abs() + wide, c.abs() + wide);
            place.bound.add(&Aabb {
                low: [(x - a).min_lane(), (y - b).min_lane(), (z - c).min_lane()],
                high: [(x + a).max_lane(), (y + b).max_lane(), (z + c).max_lane()],
            });
        }
    }

    /// Image of a direction of a frame.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn direction<S: Simd>(
        &self,
        simd: S,
        frame: usize,
        vector: [f32; 3],
        chunk: usize,
    ) -> Lanes3<S> {
        let none = Frame::default();
        self.frames.get(frame).unwrap_or(&none).direction(simd, vector, chunk)
    }

    /// Motion of a part by its joints after the first `common` ones.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn motion_after<S: Simd>(
        &self,
        simd: S,
        batch_model: &BatchModel,
        (part, common): (usize, usize),
        chunk: usize,
    ) -> CapsuleMotion<S> {
        self.motion_by(simd, batch_model, part, common + 1, chunk)
    }

    /// Greatest displacement of a part by its joints after the first `common` ones.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn goes<S: Simd>(
        &self,
        simd: S,
        batch_model: &BatchModel,
        (part, common): (usize, usize),
        chunk: usize,
    ) -> Lanes<S> {
        let own = batch_model.parts.get(part);
        let known =
            own.and_then(|own| Some((own, self.motions.get(own.frame * batch_model.stride() + common + 1)?)));
        known.map_or(Lanes::splat(simd, 0.0), |(own, motion)| motion.goes(simd, own.far, chunk))
    }

    /// Motion of a part by all its joints and the base.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn motion_in_map<S: Simd>(
        &self,
        simd: S,
        batch_model: &BatchModel,
        part: usize,
        chunk: usize,
    ) -> CapsuleMotion<S> {
        self.motion_by(simd, batch_model, part, 0, chunk)
    }

    #[cfg_attr(optimised, inline(always))]
    fn motion_by<S: Simd>(
        &self,
        simd: S,
        batch_model: &BatchModel,
        part: usize,
        from: usize,
        chunk: usize,
    ) -> CapsuleMotion<S> {
        let Some((own, place)) = batch_model.parts.get(part).zip(self.parts.get(part)) else {
            return CapsuleMotion::still(simd);
        };
        let known = self.frames.get(own.frame).zip(self.motions.get(own.frame * batch_model.stride() + from));
        let Some((frame, motion)) = known else { return CapsuleMotion::still(simd) };
        let off = Lanes3::of(simd, &place.centre, chunk) - Lanes3::of(simd, &frame.at, chunk);
        let half = Lanes3::of(simd, &place.half, chunk);
        CapsuleMotion::new(simd, motion.of(simd, chunk), off, half, [own.radius, own.far])
    }

    /// Computes the motions of the frames whose bits are set: by the base and all joints, by all joints, by
    /// those after the first, and so on.
    #[cfg_attr(optimised, inline(always))]
    fn motion<S: Simd>(
        &mut self,
        simd: S,
        batch_model: &BatchModel,
        batch: &Batch8,
        frames: u64,
        chunk: usize,
    ) {
        let stride = batch_model.stride();
        let base = Lanes3::of(simd, &batch.base, chunk);
        for (ancestors, own) in batch_model.ancestors.iter().zip(0..) {
            if own > 0 && frames & bit(own) == 0 {
                continue;
            }
            let Some(origin) = self.frames.get(own).map(|frame| Lanes3::of(simd, &frame.at, chunk)) else {
                continue;
            };
            let Some(slots) = self.motions.get_mut(own * stride..(own + 1) * stride) else { continue };
            let mut motion = FrameMotion::still(simd);
            let mut set = |at: usize, motion: FrameMotion<S>| {
                slots.get_mut(at).into_iter().for_each(|slot| slot.set(motion, chunk));
            };
            set(ancestors.len() + 1, motion);
            for (place, at) in ancestors.iter().enumerate().rev() {
                let known = batch.changes.get(*at).zip(batch.amounts.get(*at));
                let known = known.zip(self.frames.get(at + 1)).zip(batch_model.joints.get(*at));
                if let Some((((change, amount), frame), joint)) = known
                    && *amount > 0.0
                {
                    let axis = Lanes3::of(simd, &frame.axis, chunk);
                    if joint.is_prismatic {
                        motion.slide(simd, axis, [*change, *amount]);
                    } else {
                        motion.turn(
                            simd,
                            origin - Lanes3::of(simd, &frame.at, chunk),
                            axis,
                            [*change, *amount],
                        );
                    }
                }
                set(place + 1, motion);
            }
            let [x, y, yaw] = batch.shift;
            if batch.turns > 0.0 {
                let Lanes3([off_x, off_y, _]) = origin - base;
                let off = Lanes3([off_x, off_y, Lanes::splat(simd, 0.0)]);
                motion.turn(simd, off, Lanes3::splat(simd, [0.0, 0.0, 1.0]), [yaw, batch.turns]);
            }
            if batch.slides > 0.0 {
                let share = 1.0 / batch.slides;
                let axis = Lanes3::splat(simd, [x * share, y * share, 0.0]);
                motion.slide(simd, axis, [batch.slides; 2]);
            }
            set(0, motion);
        }
    }
}

/// Rotates a vector about the vertical.
#[cfg_attr(optimised, inline(always))]
fn about<S: Simd>(simd: S, [sin, cos]: [Lanes<S>; 2], vector: [f32; 3]) -> Lanes3<S> {
    let Lanes3([x, y, z]) = Lanes3::splat(simd, vector);
    Lanes3([cos * x - sin * y, sin * x + cos * y, z])
}

impl Frame {
    #[cfg_attr(optimised, inline(always))]
    fn direction<S: Simd>(&self, simd: S, [x, y, z]: [f32; 3], chunk: usize) -> Lanes3<S> {
        let [a, b, c] = &self.turn;
        Lanes3::of(simd, a, chunk).times(Lanes::splat(simd, x))
            + Lanes3::of(simd, b, chunk).times(Lanes::splat(simd, y))
            + Lanes3::of(simd, c, chunk).times(Lanes::splat(simd, z))
    }

    #[cfg_attr(optimised, inline(always))]
    fn point<S: Simd>(&self, simd: S, vector: [f32; 3], chunk: usize) -> Lanes3<S> {
        Lanes3::of(simd, &self.at, chunk) + self.direction(simd, vector, chunk)
    }

    /// Places the frame of a child joint.
    #[cfg_attr(optimised, inline(always))]
    fn carry<S: Simd>(&self, simd: S, joint: &BatchJoint, position: Lanes<S>, slot: &mut Self, chunk: usize) {
        let axis = self.direction(simd, joint.axis, chunk);
        axis.store(&mut slot.axis, chunk);
        let at = self.point(simd, joint.at, chunk);
        if joint.is_prismatic {
            (at + axis.times(position)).store(&mut slot.at, chunk);
            for (slot, column) in slot.turn.iter_mut().zip(joint.still) {
                self.direction(simd, column, chunk).store(slot, chunk);
            }
            return;
        }
        at.store(&mut slot.at, chunk);
        let [sin, cos] = position.sin_cos();
        let rest = Lanes::splat(simd, 1.0) - cos;
        let [a, b, c] = &self.turn;
        let (a, b, c) = (Lanes3::of(simd, a, chunk), Lanes3::of(simd, b, chunk), Lanes3::of(simd, c, chunk));
        let columns = slot.turn.iter_mut().zip(joint.still).zip(joint.swing.iter().zip(&joint.bend));
        for ((slot, still), (swing, bend)) in columns {
            let local = Lanes3::splat(simd, still)
                + Lanes3::splat(simd, *swing).times(sin)
                + Lanes3::splat(simd, *bend).times(rest);
            let Lanes3([x, y, z]) = local;
            (a.times(x) + b.times(y) + c.times(z)).store(slot, chunk);
        }
    }
}

/// Displacements of all parts in the first of eight configurations.
#[cfg(test)]
pub(super) fn displacements_in_map(batch_model: &BatchModel, batch: &Batch8) -> Vec<f32> {
    let mut posed = PosedBatch::default();
    posed.set(pulp::Scalar, batch_model, batch, |_| true, true);
    posed.parts.iter().map(|place| place.goes[0]).collect()
}
