//! Check of one pair of solids in eight configurations with tighter bounds at each step: bounding balls,
//! boxes, and on an edge the first-order motion. A pair of the robot's own parts is separated by planes
//! perpendicular to the line between the axes.

use pulp::Simd;

use super::batch_check::{BatchChecker, BatchPair, PairTarget};
use super::batch_model::BatchPart;
use super::lanes::{Lanes, Lanes3};
use super::posed_batch::PosedPart;
use super::separation::{CapsuleAxis, CapsuleMotion, Cuboid, beside, stays_clear_of_box};
use super::{SURE, TOLD};

impl BatchChecker<'_> {
    /// Bit masks of the configurations in which a pair may touch during its motion, may touch at rest, and
    /// certainly touches at rest.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn chunk<S: Simd>(
        &self,
        simd: S,
        BatchPair { part, target, beyond }: BatchPair,
        chunk: usize,
    ) -> [u8; 3] {
        let Some((own, place)) = self.batch_model.parts.get(part).zip(self.posed.parts.get(part)) else {
            return [0; 3];
        };
        let axis = place.axis(simd, chunk);
        let goes = Lanes::of(simd, &place.goes, chunk);
        let gap = Lanes::of(simd, &self.gaps, chunk) + Lanes::splat(simd, beyond);
        match target {
            PairTarget::Floor => {
                let Lanes3([_, _, height]) = axis.centre;
                let Lanes3([_, _, up]) = axis.half;
                let end = height - up.abs();
                let above = end - (gap + Lanes::splat(simd, own.radius + own.slack + TOLD));
                match (above - goes).not_positive() {
                    0 => [0; 3],
                    going => {
                        let within = end - (gap + Lanes::splat(simd, own.inner - own.slack - SURE));
                        let still = above.not_positive();
                        [going, still, within.negative() & still]
                    }
                }
            }
            PairTarget::Obb(at) => {
                let Some(obb) = self.obbs.all.get(at) else { return [0; 3] };
                let [x, y, z] = obb.axes;
                let other = Cuboid {
                    centre: Lanes3::splat(simd, obb.centre),
                    axes: [Lanes3::splat(simd, x), Lanes3::splat(simd, y), Lanes3::splat(simd, z)],
                    half: Lanes3::splat(simd, obb.half),
                    is_round: false,
                };
                let least = gap + Lanes::splat(simd, own.slack + TOLD);
                let ball = Lanes::splat(simd, own.reach) + least + goes;
                let balls = obb.aside(simd, axis.centre, ball).not_positive();
                if balls == 0 {
                    return [0; 3];
                }
                // The result at rest must not depend on the other lanes.
                let going = match self.batch.is_way {
                    true => {
                        let motion_after = self.posed.motion_in_map(simd, self.batch_model, part, chunk);
                        let still = CapsuleMotion::still(simd);
                        balls
                            & stays_clear_of_box(
                                simd,
                                other,
                                (axis, own.radius),
                                [motion_after, still],
                                least,
                            )
                    }
                    false => balls,
                };
                let going = if going == 0 {
                    0
                } else {
                    going & self.obb(simd, (own, place), other, least + goes, chunk)
                };
                match going {
                    0 => [0; 3],
                    going => {
                        let still = match self.batch.is_way {
                            true => going & self.obb(simd, (own, place), other, least, chunk),
                            false => going,
                        };
                        let near = gap + Lanes::splat(simd, own.inner - own.slack - SURE);
                        let is_told = still != 0 && obb.is_exact && near.min_lane() > 0.0;
                        let sure = if is_told { axis.within(simd, other, near).negative() } else { 0 };
                        [going, still, sure & still]
                    }
                }
            }
            PairTarget::Part(at, common) => {
                let Some((far, beyond)) = self.batch_model.parts.get(at).zip(self.posed.parts.get(at)) else {
                    return [0; 3];
                };
                let least = gap + Lanes::splat(simd, own.slack + far.slack + TOLD);
                // A joint that moves both keeps their distance.
                let goes = match self.batch.is_way {
                    true => {
                        let goes = |part| self.posed.goes(simd, self.batch_model, (part, common), chunk);
                        goes(part) + goes(at)
                    }
                    false => Lanes::splat(simd, 0.0),
                };
                let balls = Lanes::splat(simd, own.reach + far.reach) + least + goes;
                let between = axis.centre - Lanes3::of(simd, &beyond.centre, chunk);
                let balls = (between.dot(between) - balls * balls).not_positive();
                if balls == 0 {
                    return [0; 3];
                }
                let two = SelfPair::new(simd, [(own, axis), (far, beyond.axis(simd, chunk))]);
                let capsules = balls & two.capsules(least + goes);
                if capsules == 0 {
                    return [0; 3];
                }
                let cuboids = [self.cuboid(simd, own, place, chunk), self.cuboid(simd, far, beyond, chunk)];
                let going = match self.batch.is_way {
                    true => {
                        let motion_after =
                            |part| self.posed.motion_after(simd, self.batch_model, (part, common), chunk);
                        capsules
                            & two.motion_after(simd, [motion_after(part), motion_after(at)], cuboids, least)
                    }
                    false => capsules,
                };
                let going = if going == 0 { 0 } else { going & two.near(simd, cuboids, least + goes) };
                match going {
                    0 => [0; 3],
                    going => {
                        let still = match self.batch.is_way {
                            true => match going & two.capsules(least) {
                                0 => 0,
                                still => still & two.near(simd, cuboids, least),
                            },
                            false => going,
                        };
                        let near =
                            gap + Lanes::splat(simd, own.inner + far.inner - own.slack - far.slack - SURE);
                        let sure = if still != 0 && near.min_lane() > 0.0 {
                            (two.way.dot(two.way) - near * near).negative()
                        } else {
                            0
                        };
                        [going, still, sure & still]
                    }
                }
            }
        }
    }

    /// Bit mask of the configurations in which a part may be nearer to an obstacle than `wanted`.
    #[cfg_attr(optimised, inline(always))]
    fn obb<S: Simd>(
        &self,
        simd: S,
        (own, place): (&BatchPart, &PosedPart),
        other: Cuboid<S>,
        wanted: Lanes<S>,
        chunk: usize,
    ) -> u8 {
        let axis = place.axis(simd, chunk);
        let mut bits = beside(simd, axis, other, wanted + Lanes::splat(simd, own.radius), 6);
        if let (true, Some(cuboid)) = (bits != 0, self.cuboid(simd, own, place, chunk)) {
            bits &= cuboid.aside(simd, other, wanted).not_positive();
            bits &= other.aside(simd, cuboid, wanted).not_positive();
        }
        bits
    }

    /// Box of a part that is no capsule.
    #[cfg_attr(optimised, inline(always))]
    fn cuboid<S: Simd>(
        &self,
        simd: S,
        part: &BatchPart,
        place: &PosedPart,
        chunk: usize,
    ) -> Option<Cuboid<S>> {
        let ([x, y, z], half) = part.obb?;
        let (posed, frame) = (&self.posed, part.frame);
        Some(Cuboid {
            centre: Lanes3::of(simd, &place.centre, chunk),
            axes: [
                posed.direction(simd, frame, x, chunk),
                posed.direction(simd, frame, y, chunk),
                posed.direction(simd, frame, z, chunk),
            ],
            half: Lanes3::splat(simd, half),
            is_round: part.is_round,
        })
    }
}

impl PosedPart {
    #[cfg_attr(optimised, inline(always))]
    fn axis<S: Simd>(&self, simd: S, chunk: usize) -> CapsuleAxis<S> {
        CapsuleAxis {
            centre: Lanes3::of(simd, &self.centre, chunk),
            half: Lanes3::of(simd, &self.half, chunk),
        }
    }
}

/// Two parts of a robot, placed.
#[derive(Clone, Copy)]
pub(super) struct SelfPair<'a, S: Simd> {
    parts: [&'a BatchPart; 2],
    axes: [CapsuleAxis<S>; 2],
    /// From a point on the axis of the second part to one on the axis of the first; both are nearly the
    /// nearest points.
    pub(super) way: Lanes3<S>,
    length: Lanes<S>,
    /// Separation of the axes along that line, times its length.
    room: Lanes<S>,
    radii: Lanes<S>,
}

impl<'a, S: Simd> SelfPair<'a, S> {
    #[cfg_attr(optimised, inline(always))]
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

    /// Bit mask of the configurations in which the bounding capsules may be nearer than `wanted`.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn capsules(self, wanted: Lanes<S>) -> u8 {
        (self.room - (self.radii + wanted) * self.length).not_positive()
    }

    /// The same for the boxes of the parts that have one.
    #[cfg_attr(optimised, inline(always))]
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

    /// Bit mask of the configurations in which the parts may come too near, by their motion along the line
    /// between them and along the axes of boxes.
    #[cfg_attr(optimised, inline(always))]
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
