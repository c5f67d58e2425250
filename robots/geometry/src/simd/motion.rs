//! How two solids drift apart or towards each other on a leg, to the first order, and how far they may be from that.
//!
//! On a leg all joints change evenly. A place on a part is at `p + v t + r(t)` then, with `t` from −1 to 1 and `v` its velocity in
//! the middle. Two joints that turn by angles `a` and `b`, the first nearer to the root, accelerate a place at a distance `d` from the
//! axis of the second by no more than `2 a b d`, one alone by `a² d`, and what slides is accelerated by what turns it only. So `r` is no
//! longer than the sum of `a b d` over all pairs of joints and of `a² d / 2` over all joints. A place that goes along something, and not
//! towards it, may so be known to stay clear of it, however far it goes.

use pulp::Simd;

use super::lanes::{Lanes, Lanes3};
use super::posed_batch::{Lane8, Lane8x3};
use super::separation::{CapsuleAxis, Cuboid};

/// How much a place may be off as it is placed, for each rad that it turns, in m.
const OFF: f32 = 2e-4;

/// How a frame moves until the end of a leg, by some of the joints that move it.
#[derive(Clone, Copy)]
pub(super) struct FrameMotion<S: Simd> {
    /// Of its origin.
    shift: Lanes3<S>,
    /// The axis about which it turns, as long as the angle.
    spin: Lanes3<S>,
    /// How far its origin goes at most, and how much more what is 1 m from it.
    goes: Lanes<S>,
    spread: f32,
    /// How far its origin may be from the first order, and how much more what is 1 m from it.
    bends: Lanes<S>,
    bend: f32,
    /// The sum of all angles.
    turns: f32,
}

/// The same in eight lanes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct FrameMotion8 {
    shift: Lane8x3,
    spin: Lane8x3,
    goes: Lane8,
    spread: f32,
    bends: Lane8,
    bend: f32,
    turns: f32,
}

impl FrameMotion8 {
    #[inline(always)]
    pub(super) fn of<S: Simd>(&self, simd: S, chunk: usize) -> FrameMotion<S> {
        FrameMotion {
            shift: Lanes3::of(simd, &self.shift, chunk),
            spin: Lanes3::of(simd, &self.spin, chunk),
            goes: Lanes::of(simd, &self.goes, chunk),
            spread: self.spread,
            bends: Lanes::of(simd, &self.bends, chunk),
            bend: self.bend,
            turns: self.turns,
        }
    }

    #[inline(always)]
    pub(super) fn set<S: Simd>(&mut self, motion: FrameMotion<S>, chunk: usize) {
        motion.shift.store(&mut self.shift, chunk);
        motion.spin.store(&mut self.spin, chunk);
        motion.goes.store(&mut self.goes, chunk);
        motion.bends.store(&mut self.bends, chunk);
        (self.spread, self.bend, self.turns) = (motion.spread, motion.bend, motion.turns);
    }

    /// How far any place goes that is no farther from the frame's origin than `reach`.
    #[inline(always)]
    pub(super) fn goes<S: Simd>(&self, simd: S, reach: f32, chunk: usize) -> Lanes<S> {
        Lanes::of(simd, &self.goes, chunk) + Lanes::splat(simd, self.spread * reach)
    }
}

impl<S: Simd> FrameMotion<S> {
    /// What does not move.
    #[inline(always)]
    pub(super) fn still(simd: S) -> Self {
        let (none, zero) = (Lanes3::splat(simd, [0.0; 3]), Lanes::splat(simd, 0.0));
        Self { shift: none, spin: none, goes: zero, spread: 0.0, bends: zero, bend: 0.0, turns: 0.0 }
    }

    /// Adds a joint that turns about an axis, from a place on which the frame's origin stands off, and by how much and, at least as much,
    /// how far. Joints come from the last on.
    #[inline(always)]
    pub(super) fn turn(&mut self, simd: S, off: Lanes3<S>, axis: Lanes3<S>, [change, amount]: [f32; 2]) {
        let across = axis.cross(off);
        let change = Lanes::splat(simd, change);
        self.shift = self.shift + across.times(change);
        self.spin = self.spin + axis.times(change);
        // A place is no farther from its axis than it is in the middle and goes by the joints after it.
        let (far, farther) = (across.dot(across).sqrt() + self.goes, 1.0 + self.spread);
        let (all, half) = (Lanes::splat(simd, amount), Lanes::splat(simd, 0.5 * amount));
        self.bends = self.bends + all * (self.goes + half * far);
        self.bend += amount * (self.spread + 0.5 * amount * farther);
        self.goes = self.goes + all * far;
        self.spread += amount * farther;
        self.turns += amount;
    }

    /// Adds a joint that slides.
    #[inline(always)]
    pub(super) fn slide(&mut self, simd: S, axis: Lanes3<S>, [change, amount]: [f32; 2]) {
        self.shift = self.shift + axis.times(Lanes::splat(simd, change));
        self.goes = self.goes + Lanes::splat(simd, amount);
    }
}

/// A capsule on a leg, in a frame that drifts.
#[derive(Clone, Copy)]
pub(super) struct CapsuleMotion<S: Simd> {
    /// Of its centre, and the axis about which it turns.
    shift: Lanes3<S>,
    spin: Lanes3<S>,
    /// From its centre to an end of its axis.
    half: Lanes3<S>,
    /// How far what is beside the axis goes by turning.
    round: Lanes<S>,
    /// How far any of its places goes, and may be from the first order.
    goes: Lanes<S>,
    beyond: Lanes<S>,
}

impl<S: Simd> CapsuleMotion<S> {
    /// A capsule with such a half axis and radius, its centre so far off the frame's origin and no part of it farther from it than `reach`.
    #[inline(always)]
    pub(super) fn new(
        simd: S,
        motion: FrameMotion<S>,
        off: Lanes3<S>,
        half: Lanes3<S>,
        [radius, reach]: [f32; 2],
    ) -> Self {
        let goes = motion.goes + Lanes::splat(simd, motion.spread * reach);
        let turning = motion.spin.dot(motion.spin).sqrt();
        Self {
            shift: motion.shift + motion.spin.cross(off),
            spin: motion.spin,
            half,
            round: turning * Lanes::splat(simd, radius),
            goes,
            beyond: motion.bends + Lanes::splat(simd, motion.bend * reach + OFF * motion.turns),
        }
    }

    /// A ball that holds it.
    #[inline(always)]
    pub(super) fn ball(self, simd: S, radius: f32) -> Self {
        let turning = self.spin.dot(self.spin).sqrt();
        Self { half: Lanes3::splat(simd, [0.0; 3]), round: turning * Lanes::splat(simd, radius), ..self }
    }

    /// What does not move.
    #[inline(always)]
    pub(super) fn still(simd: S) -> Self {
        let (none, zero) = (Lanes3::splat(simd, [0.0; 3]), Lanes::splat(simd, 0.0));
        Self { shift: none, spin: none, half: none, round: zero, goes: zero, beyond: zero }
    }

    /// By how much it and another one may come nearer to each other along a direction until the end of the leg, of which the length is
    /// given: at most so much, times that length, and no more than both go.
    #[inline(always)]
    pub(super) fn approach(self, other: Self, way: Lanes3<S>, length: Lanes<S>) -> Lanes<S> {
        let along = way.dot(self.shift - other.shift).abs();
        let ends = way.dot(self.spin.cross(self.half)).abs() + way.dot(other.spin.cross(other.half)).abs();
        let rest = self.round + other.round + self.beyond + other.beyond;
        (along + ends + length * rest).min(length * (self.goes + other.goes))
    }
}

/// A bit for each state in which a capsule may come no farther from a box than wanted along any of the directions of that, with how
/// both drift.
#[inline(always)]
pub(super) fn stays_clear_of_box<S: Simd>(
    simd: S,
    cuboid: Cuboid<S>,
    (axis, radius): (CapsuleAxis<S>, f32),
    [capsule, turning]: [CapsuleMotion<S>; 2],
    least: Lanes<S>,
) -> u8 {
    let between = axis.centre - cuboid.centre;
    let unit = Lanes::splat(simd, 1.0);
    let radius = Lanes::splat(simd, radius) + least;
    let (Lanes3([a, b, c]), [x, y, z]) = (cuboid.half, cuboid.axes);
    let mut bits = u8::MAX;
    for (direction, half) in [(x, a), (y, b), (z, c)] {
        let room = between.dot(direction).abs() - half - axis.half.dot(direction).abs() - radius;
        bits &= (room - capsule.approach(turning, direction, unit)).not_positive();
    }
    bits
}
