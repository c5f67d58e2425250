//! How two solids drift apart or towards each other on a leg, to the first order, and how far they may be from that.
//!
//! On a leg all joints change evenly. A place on a part is at `p + v t + r(t)` then, with `t` from −1 to 1 and `v` its velocity in
//! the middle. Two joints that turn by angles `a` and `b`, the first nearer to the root, accelerate a place at a distance `d` from the
//! axis of the second by no more than `2 a b d`, one alone by `a² d`, and what slides is accelerated by what turns it only. So `r` is no
//! longer than the sum of `a b d` over all pairs of joints and of `a² d / 2` over all joints. A place that goes along something, and not
//! towards it, may so be known to stay clear of it, however far it goes.

use pulp::Simd;

use super::apart::{Axis, Cuboid};
use super::number::{Number, Vector};
use super::pose::{Row, Rows};

/// How much a place may be off as it is placed, for each rad that it turns, in m.
const OFF: f32 = 2e-4;

/// How a frame moves until the end of a leg, by some of the joints that move it.
#[derive(Clone, Copy)]
pub(super) struct Drift<S: Simd> {
    /// Of its origin.
    shift: Vector<S>,
    /// The axis about which it turns, as long as the angle.
    spin: Vector<S>,
    /// How far its origin goes at most, and how much more what is 1 m from it.
    goes: Number<S>,
    spread: f32,
    /// How far its origin may be from the first order, and how much more what is 1 m from it.
    bends: Number<S>,
    bend: f32,
    /// The sum of all angles.
    turns: f32,
}

/// The same in eight lanes.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Drifted {
    shift: Rows,
    spin: Rows,
    goes: Row,
    spread: f32,
    bends: Row,
    bend: f32,
    turns: f32,
}

impl Drifted {
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn of<S: Simd>(&self, simd: S, chunk: usize) -> Drift<S> {
        Drift {
            shift: Vector::of(simd, &self.shift, chunk),
            spin: Vector::of(simd, &self.spin, chunk),
            goes: Number::of(simd, &self.goes, chunk),
            spread: self.spread,
            bends: Number::of(simd, &self.bends, chunk),
            bend: self.bend,
            turns: self.turns,
        }
    }

    #[cfg_attr(optimised, inline(always))]
    pub(super) fn set<S: Simd>(&mut self, drift: Drift<S>, chunk: usize) {
        drift.shift.store(&mut self.shift, chunk);
        drift.spin.store(&mut self.spin, chunk);
        drift.goes.store(&mut self.goes, chunk);
        drift.bends.store(&mut self.bends, chunk);
        (self.spread, self.bend, self.turns) = (drift.spread, drift.bend, drift.turns);
    }

    /// How far any place goes that is no farther from the frame's origin than `reach`.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn goes<S: Simd>(&self, simd: S, reach: f32, chunk: usize) -> Number<S> {
        Number::of(simd, &self.goes, chunk) + Number::splat(simd, self.spread * reach)
    }
}

impl<S: Simd> Drift<S> {
    /// What does not move.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn still(simd: S) -> Self {
        let (none, zero) = (Vector::splat(simd, [0.0; 3]), Number::splat(simd, 0.0));
        Self { shift: none, spin: none, goes: zero, spread: 0.0, bends: zero, bend: 0.0, turns: 0.0 }
    }

    /// Adds a joint that turns about an axis, from a place on which the frame's origin stands off, and by how much and, at least as much,
    /// how far. Joints come from the last on.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn turn(&mut self, simd: S, off: Vector<S>, axis: Vector<S>, [change, amount]: [f32; 2]) {
        let across = axis.cross(off);
        let change = Number::splat(simd, change);
        self.shift = self.shift + across.times(change);
        self.spin = self.spin + axis.times(change);
        // A place is no farther from its axis than it is in the middle and goes by the joints after it.
        let (far, farther) = (across.dot(across).sqrt() + self.goes, 1.0 + self.spread);
        let (all, half) = (Number::splat(simd, amount), Number::splat(simd, 0.5 * amount));
        self.bends = self.bends + all * (self.goes + half * far);
        self.bend += amount * (self.spread + 0.5 * amount * farther);
        self.goes = self.goes + all * far;
        self.spread += amount * farther;
        self.turns += amount;
    }

    /// Adds a joint that slides.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn slide(&mut self, simd: S, axis: Vector<S>, [change, amount]: [f32; 2]) {
        self.shift = self.shift + axis.times(Number::splat(simd, change));
        self.goes = self.goes + Number::splat(simd, amount);
    }
}

/// A capsule on a leg, in a frame that drifts.
#[derive(Clone, Copy)]
pub(super) struct Drifting<S: Simd> {
    /// Of its centre, and the axis about which it turns.
    shift: Vector<S>,
    spin: Vector<S>,
    /// From its centre to an end of its axis.
    half: Vector<S>,
    /// How far what is beside the axis goes by turning.
    round: Number<S>,
    /// How far any of its places goes, and may be from the first order.
    goes: Number<S>,
    beyond: Number<S>,
}

impl<S: Simd> Drifting<S> {
    /// A capsule with such a half axis and radius, its centre so far off the frame's origin and no part of it farther from it than `reach`.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn new(
        simd: S,
        drift: Drift<S>,
        off: Vector<S>,
        half: Vector<S>,
        [radius, reach]: [f32; 2],
    ) -> Self {
        let goes = drift.goes + Number::splat(simd, drift.spread * reach);
        let turning = drift.spin.dot(drift.spin).sqrt();
        Self {
            shift: drift.shift + drift.spin.cross(off),
            spin: drift.spin,
            half,
            round: turning * Number::splat(simd, radius),
            goes,
            beyond: drift.bends + Number::splat(simd, drift.bend * reach + OFF * drift.turns),
        }
    }

    /// A ball that holds it.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn ball(self, simd: S, radius: f32) -> Self {
        let turning = self.spin.dot(self.spin).sqrt();
        Self { half: Vector::splat(simd, [0.0; 3]), round: turning * Number::splat(simd, radius), ..self }
    }

    /// What does not move.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn still(simd: S) -> Self {
        let (none, zero) = (Vector::splat(simd, [0.0; 3]), Number::splat(simd, 0.0));
        Self { shift: none, spin: none, half: none, round: zero, goes: zero, beyond: zero }
    }

    /// By how much it and another one may come nearer to each other along a direction until the end of the leg, of which the length is
    /// given: at most so much, times that length, and no more than both go.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn approach(self, other: Self, way: Vector<S>, length: Number<S>) -> Number<S> {
        let along = way.dot(self.shift - other.shift).abs();
        let ends = way.dot(self.spin.cross(self.half)).abs() + way.dot(other.spin.cross(other.half)).abs();
        let rest = self.round + other.round + self.beyond + other.beyond;
        (along + ends + length * rest).least(length * (self.goes + other.goes))
    }
}

/// A bit for each state in which a capsule may come no farther from a box than wanted along any of the directions of that, with how
/// both drift.
#[cfg_attr(optimised, inline(always))]
pub(super) fn drifting_off<S: Simd>(
    simd: S,
    cuboid: Cuboid<S>,
    (axis, radius): (Axis<S>, f32),
    [capsule, turning]: [Drifting<S>; 2],
    least: Number<S>,
) -> u8 {
    let between = axis.centre - cuboid.centre;
    let unit = Number::splat(simd, 1.0);
    let radius = Number::splat(simd, radius) + least;
    let (Vector([a, b, c]), [x, y, z]) = (cuboid.half, cuboid.axes);
    let mut bits = u8::MAX;
    for (direction, half) in [(x, a), (y, b), (z, c)] {
        let room = between.dot(direction).abs() - half - axis.half.dot(direction).abs() - radius;
        bits &= (room - capsule.approach(turning, direction, unit)).not_positive();
    }
    bits
}
