//! Lower bounds of the distance between two solids in lanes: the excess of the squared distance over the
//! required one.
//!
//! With first-order motion bounds: the approach of two solids along a segment of an edge, and a bound for the
//! rest.
//!
//! On a segment all joints change evenly. A point of a part is at `p + v t + r(t)`, with `t` from −1 to 1 and
//! `v` its velocity in the middle. Two joints that rotate by angles `a` and `b`, the first nearer to the
//! root, accelerate a point at a distance `d` from the axis of the second by at most `2 a b d`, one joint
//! alone by `a² d`; a prismatic joint adds acceleration only through rotations before it. So `r` is at most
//! the sum of `a b d` over all pairs of joints and of `a² d / 2` over all joints. So a point that moves along
//! a body, and not towards it, is known to stay clear of it however far it moves.

use pulp::Simd;

use super::lanes::{Lane8, Lane8x3, Lanes, Lanes3};

/// Axis of a capsule: its centre, and the vector to an end.
#[derive(Clone, Copy)]
pub(super) struct CapsuleAxis<S: Simd> {
    pub(super) centre: Lanes3<S>,
    pub(super) half: Lanes3<S>,
}

/// Box: its centre, axes and half extents.
#[derive(Clone, Copy)]
pub(super) struct Cuboid<S: Simd> {
    pub(super) centre: Lanes3<S>,
    pub(super) axes: [Lanes3<S>; 3],
    pub(super) half: Lanes3<S>,
    /// True for a cylinder along the last axis.
    pub(super) is_round: bool,
}

impl<S: Simd> Cuboid<S> {
    /// Positive if another box is certainly farther than `wanted`, by its bounding box along the axes of this
    /// one.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn aside(self, simd: S, other: Self, wanted: Lanes<S>) -> Lanes<S> {
        let between = other.centre - self.centre;
        let [x, y, z] = self.axes;
        let Lanes3([a, b, c]) = self.half;
        let x = (between.dot(x).abs() - a - other.extent(simd, x)).max_zero();
        let y = (between.dot(y).abs() - b - other.extent(simd, y)).max_zero();
        let z = (between.dot(z).abs() - c - other.extent(simd, z)).max_zero();
        x * x + y * y + z * z - wanted * wanted
    }

    /// Extent from its centre along a unit vector.
    #[cfg_attr(optimised, inline(always))]
    fn extent(self, simd: S, direction: Lanes3<S>) -> Lanes<S> {
        let [x, y, z] = self.axes;
        let Lanes3([a, b, c]) = self.half;
        let up = direction.dot(z).abs();
        if self.is_round {
            // Slightly more, for vectors that are not exactly of length 1.
            let aside = (Lanes::splat(simd, 1.00001) - up * up).max_zero().sqrt();
            return a * aside + c * up;
        }
        a * direction.dot(x).abs() + b * direction.dot(y).abs() + c * up
    }
}

impl<S: Simd> CapsuleAxis<S> {
    /// Positive if the axis is certainly farther than `wanted` from a box, by the bounding boxes of `pieces`
    /// pieces of the axis along the axes of the box.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn beside(self, simd: S, other: Cuboid<S>, wanted: Lanes<S>, pieces: u8) -> Lanes<S> {
        let between = self.centre - other.centre;
        let [x, y, z] = other.axes;
        let off = [between.dot(x), between.dot(y), between.dot(z)];
        let along = [self.half.dot(x), self.half.dot(y), self.half.dot(z)];
        let share = 1.0 / f32::from(pieces);
        let mut least = squared(simd, off, along, other.half, [share - 1.0, share]);
        for piece in 1..pieces {
            let place = (2.0 * f32::from(piece) + 1.0) * share - 1.0;
            least = least.min(squared(simd, off, along, other.half, [place, share]));
        }
        least - wanted * wanted
    }

    /// Negative if the middle or an end of the axis is certainly nearer to a box than `wanted`.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn within(self, simd: S, other: Cuboid<S>, wanted: Lanes<S>) -> Lanes<S> {
        let between = self.centre - other.centre;
        let [x, y, z] = other.axes;
        let off = [between.dot(x), between.dot(y), between.dot(z)];
        let along = [self.half.dot(x), self.half.dot(y), self.half.dot(z)];
        let middle = squared(simd, off, along, other.half, [0.0, 0.0]);
        let first = squared(simd, off, along, other.half, [-1.0, 0.0]);
        let last = squared(simd, off, along, other.half, [1.0, 0.0]);
        middle.min(first).min(last) - wanted * wanted
    }

    /// Vector from a point on another axis to one on this; both are nearly the nearest points (Ericson 2005,
    /// 5.1.9).
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn way(self, simd: S, other: Self) -> Lanes3<S> {
        let tiny = Lanes::splat(simd, 1e-9);
        let between = self.centre - other.centre;
        let (d1, d2) = (self.half, other.half);
        let (a, b, e) = (d1.dot(d1) + tiny, d1.dot(d2), d2.dot(d2) + tiny);
        let (c, f) = (d1.dot(between), d2.dot(between));
        // From −1 to 1 along each, the first regardless of the ends of the other.
        let s = (b * f - c * e).div((a * e - b * b).max(Lanes::splat(simd, 1e-12))).within();
        let t = (b * s + f).div(e).within();
        let s = (b * t - c).div(a).within();
        between + d1.times(s) - d2.times(t)
    }
}

/// Bit mask of the configurations in which an axis may be nearer to a box than `wanted`; in pieces only where
/// needed.
#[cfg_attr(optimised, inline(always))]
pub(super) fn beside<S: Simd>(
    simd: S,
    axis: CapsuleAxis<S>,
    other: Cuboid<S>,
    wanted: Lanes<S>,
    pieces: u8,
) -> u8 {
    match axis.beside(simd, other, wanted, 1).not_positive() {
        0 => 0,
        bits => bits & axis.beside(simd, other, wanted, pieces).not_positive(),
    }
}

/// Squared distance of a box from the bounding box of a piece of an axis, along the axes of the box; `off` is
/// the offset of the middle of the axis, `place` is from −1 to 1, and `share` is the fraction of the axis.
#[cfg_attr(optimised, inline(always))]
fn squared<S: Simd>(
    simd: S,
    [off_x, off_y, off_z]: [Lanes<S>; 3],
    [x, y, z]: [Lanes<S>; 3],
    half: Lanes3<S>,
    [place, share]: [f32; 2],
) -> Lanes<S> {
    let (place, share) = (Lanes::splat(simd, place), Lanes::splat(simd, share));
    let Lanes3([a, b, c]) = half;
    let x = ((off_x + x * place).abs() - a - x.abs() * share).max_zero();
    let y = ((off_y + y * place).abs() - b - y.abs() * share).max_zero();
    let z = ((off_z + z * place).abs() - c - z.abs() * share).max_zero();
    x * x + y * y + z * z
}

/// Error of a place for each rad of its rotation, in m.
const OFF: f32 = 2e-4;

/// Motion of a frame until the end of a segment, by some of the joints that move it.
#[derive(Clone, Copy)]
pub(super) struct FrameMotion<S: Simd> {
    /// Translation of its origin.
    shift: Lanes3<S>,
    /// Rotation vector: axis times angle.
    spin: Lanes3<S>,
    /// Greatest displacement of its origin, and more for each m of distance from it.
    goes: Lanes<S>,
    spread: f32,
    /// Bound for the part of the displacement beyond first order at its origin, and more for each m of
    /// distance from it.
    bends: Lanes<S>,
    bend: f32,
    /// Sum of all angles, in rad.
    turns: f32,
}

/// The same motion stored for eight lanes.
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
    #[cfg_attr(optimised, inline(always))]
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

    #[cfg_attr(optimised, inline(always))]
    pub(super) fn set<S: Simd>(&mut self, motion: FrameMotion<S>, chunk: usize) {
        motion.shift.store(&mut self.shift, chunk);
        motion.spin.store(&mut self.spin, chunk);
        motion.goes.store(&mut self.goes, chunk);
        motion.bends.store(&mut self.bends, chunk);
        (self.spread, self.bend, self.turns) = (motion.spread, motion.bend, motion.turns);
    }

    /// Greatest displacement of any point within `reach` of the origin of the frame.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn goes<S: Simd>(&self, simd: S, reach: f32, chunk: usize) -> Lanes<S> {
        Lanes::of(simd, &self.goes, chunk) + Lanes::splat(simd, self.spread * reach)
    }
}

impl<S: Simd> FrameMotion<S> {
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn still(simd: S) -> Self {
        let (none, zero) = (Lanes3::splat(simd, [0.0; 3]), Lanes::splat(simd, 0.0));
        Self { shift: none, spin: none, goes: zero, spread: 0.0, bends: zero, bend: 0.0, turns: 0.0 }
    }

    /// Adds a revolute joint: offset of the origin of the frame from the axis, axis, signed change, and
    /// greatest change. Joints are added from the last to the first.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn turn(&mut self, simd: S, off: Lanes3<S>, axis: Lanes3<S>, [change, amount]: [f32; 2]) {
        let across = axis.cross(off);
        let change = Lanes::splat(simd, change);
        self.shift = self.shift + across.times(change);
        self.spin = self.spin + axis.times(change);
        // A point is at most as far from the axis as in the middle, plus its motion by later joints.
        let (far, farther) = (across.dot(across).sqrt() + self.goes, 1.0 + self.spread);
        let (all, half) = (Lanes::splat(simd, amount), Lanes::splat(simd, 0.5 * amount));
        self.bends = self.bends + all * (self.goes + half * far);
        self.bend += amount * (self.spread + 0.5 * amount * farther);
        self.goes = self.goes + all * far;
        self.spread += amount * farther;
        self.turns += amount;
    }

    /// Adds a prismatic joint.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn slide(&mut self, simd: S, axis: Lanes3<S>, [change, amount]: [f32; 2]) {
        self.shift = self.shift + axis.times(Lanes::splat(simd, change));
        self.goes = self.goes + Lanes::splat(simd, amount);
    }
}

/// Motion of a capsule on a moving frame along a segment.
#[derive(Clone, Copy)]
pub(super) struct CapsuleMotion<S: Simd> {
    /// Translation of its centre, and its rotation vector.
    shift: Lanes3<S>,
    spin: Lanes3<S>,
    /// From its centre to an end of its axis.
    half: Lanes3<S>,
    /// Displacement of its rim by rotation.
    round: Lanes<S>,
    /// Greatest displacement of any of its points, and the bound beyond first order.
    goes: Lanes<S>,
    beyond: Lanes<S>,
}

impl<S: Simd> CapsuleMotion<S> {
    /// Motion of a capsule with a half axis and radius, an offset of its centre from the origin of the frame,
    /// and all its points within `reach` of that origin.
    #[cfg_attr(optimised, inline(always))]
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

    /// Motion of a bounding ball.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn ball(self, simd: S, radius: f32) -> Self {
        let turning = self.spin.dot(self.spin).sqrt();
        Self { half: Lanes3::splat(simd, [0.0; 3]), round: turning * Lanes::splat(simd, radius), ..self }
    }

    #[cfg_attr(optimised, inline(always))]
    pub(super) fn still(simd: S) -> Self {
        let (none, zero) = (Lanes3::splat(simd, [0.0; 3]), Lanes::splat(simd, 0.0));
        Self { shift: none, spin: none, half: none, round: zero, goes: zero, beyond: zero }
    }

    /// Greatest approach of two capsules along a direction of the given length until the end of the segment.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn approach(self, other: Self, way: Lanes3<S>, length: Lanes<S>) -> Lanes<S> {
        let along = way.dot(self.shift - other.shift).abs();
        let ends = way.dot(self.spin.cross(self.half)).abs() + way.dot(other.spin.cross(other.half)).abs();
        let rest = self.round + other.round + self.beyond + other.beyond;
        (along + ends + length * rest).min(length * (self.goes + other.goes))
    }
}

/// Bit mask of the configurations in which a capsule may come too near to a box along all axes of the box,
/// with the motion of both.
#[cfg_attr(optimised, inline(always))]
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
