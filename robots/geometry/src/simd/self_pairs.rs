//! Whether two parts of a robot may be near each other in eight states: by the planes square to the way between their axes, and by
//! the boxes of those that are no capsules.

use pulp::Simd;

use super::batch_model::BatchPart;
use super::lanes::{Lanes, Lanes3};
use super::motion::{CapsuleMotion, stays_clear_of_box};
use super::separation::{CapsuleAxis, Cuboid, beside};

/// Two parts where they are.
#[derive(Clone, Copy)]
pub(super) struct SelfPair<'a, S: Simd> {
    parts: [&'a BatchPart; 2],
    axes: [CapsuleAxis<S>; 2],
    /// From a place on the axis of the second to one on that of the first, of which both are nearly the nearest.
    pub(super) way: Lanes3<S>,
    length: Lanes<S>,
    /// How far the axes are apart along the way, times its length.
    room: Lanes<S>,
    radii: Lanes<S>,
}

impl<'a, S: Simd> SelfPair<'a, S> {
    #[inline(always)]
    pub(super) fn new(simd: S, [(own, axis), (far, other)]: [(&'a BatchPart, CapsuleAxis<S>); 2]) -> Self {
        let way = axis.way(simd, other);
        Self {
            parts: [own, far],
            axes: [axis, other],
            way,
            length: way.dot(way).sqrt(),
            room: way.dot(axis.centre - other.centre) - way.dot(axis.half).abs() - way.dot(other.half).abs(),
            radii: Lanes::splat(simd, own.radius + far.radius),
        }
    }

    /// A bit for each state in which the capsules around them may be no farther apart than wanted.
    #[inline(always)]
    pub(super) fn capsules(self, wanted: Lanes<S>) -> u8 {
        (self.room - (self.radii + wanted) * self.length).not_positive()
    }

    /// The same of the boxes of those that have one.
    #[inline(always)]
    pub(super) fn near(self, simd: S, boxes: [Option<Cuboid<S>>; 2], wanted: Lanes<S>) -> u8 {
        let ([own, far], [axis, other]) = (self.parts, self.axes);
        let mut bits = u8::MAX;
        if let [_, Some(cuboid)] = boxes {
            bits &= beside(simd, axis, cuboid, wanted + Lanes::splat(simd, own.radius), 4);
        }
        if let (true, [Some(cuboid), _]) = (bits != 0, boxes) {
            bits &= beside(simd, other, cuboid, wanted + Lanes::splat(simd, far.radius), 4);
        }
        if let (true, [Some(one), Some(two)]) = (bits != 0, boxes) {
            bits &= one.aside(simd, two, wanted).not_positive();
            bits &= two.aside(simd, one, wanted).not_positive();
        }
        bits
    }

    /// A bit for each state in which they may come no farther apart than wanted, by how they drift along the way between them and the
    /// directions of what is a box.
    #[inline(always)]
    pub(super) fn motion_after(
        self,
        simd: S,
        [one, two]: [CapsuleMotion<S>; 2],
        boxes: [Option<Cuboid<S>>; 2],
        least: Lanes<S>,
    ) -> u8 {
        let ([own, far], [axis, other]) = (self.parts, self.axes);
        let towards = one.approach(two, self.way, self.length);
        let mut bits = (self.room - (self.radii + least) * self.length - towards).not_positive();
        if let (true, [_, Some(cuboid)]) = (bits != 0, boxes) {
            bits &=
                stays_clear_of_box(simd, cuboid, (axis, own.radius), [one, two.ball(simd, far.reach)], least);
        }
        if let (true, [Some(cuboid), _]) = (bits != 0, boxes) {
            bits &= stays_clear_of_box(
                simd,
                cuboid,
                (other, far.radius),
                [two, one.ball(simd, own.reach)],
                least,
            );
        }
        bits
    }
}
