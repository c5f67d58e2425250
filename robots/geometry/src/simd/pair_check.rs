//! Whether two solids may be near each other in eight states: closer and closer, from the balls around them to their boxes, and on a
//! way by how they drift.

use pulp::Simd;

use super::batch_check::{BatchChecker, BatchPair, PairTarget};
use super::batch_model::BatchPart;
use super::lanes::{Lanes, Lanes3};
use super::motion::{CapsuleMotion, stays_clear_of_box};
use super::posed_batch::PosedPart;
use super::self_pairs::SelfPair;
use super::separation::{CapsuleAxis, Cuboid, beside};
use super::{SURE, TOLD};

impl BatchChecker<'_> {
    /// Bits for the states in which a pair may be near on the way, where it stands, and is for certain where it stands.
    #[inline(always)]
    pub(super) fn chunk<S: Simd>(
        &self,
        simd: S,
        BatchPair { part, target }: BatchPair,
        chunk: usize,
    ) -> [u8; 3] {
        let Some((own, place)) = self.batch_model.parts.get(part).zip(self.posed.parts.get(part)) else {
            return [0; 3];
        };
        let axis = place.axis(simd, chunk);
        let goes = Lanes::of(simd, &place.goes, chunk);
        let gap = Lanes::of(simd, &self.gaps, chunk);
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
                // What one state alone would be told counts, whatever it is looked at with.
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
                // What moves both leaves them as far apart as they were.
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

    /// A bit for each state in which a part may be no farther from a thing than wanted.
    #[inline(always)]
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

    /// The box of a part that is no capsule.
    #[inline(always)]
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
    #[inline(always)]
    fn axis<S: Simd>(&self, simd: S, chunk: usize) -> CapsuleAxis<S> {
        CapsuleAxis {
            centre: Lanes3::of(simd, &self.centre, chunk),
            half: Lanes3::of(simd, &self.half, chunk),
        }
    }
}
