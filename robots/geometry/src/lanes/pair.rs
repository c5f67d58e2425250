//! Whether two solids may be near each other in eight states: closer and closer, from the balls around them to their boxes, and on a
//! way by how they drift.

use pulp::Simd;

use super::apart::{Axis, Cuboid, beside};
use super::drift::{Drifting, drifting_off};
use super::figure::Part;
use super::look::{Against, Looked, Pair};
use super::number::{Number, Vector};
use super::pose::Place;
use super::two::Two;
use super::{SURE, TOLD};

impl Looked<'_> {
    /// Bits for the states in which a pair may be near on the way, where it stands, and is for certain where it stands.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn chunk<S: Simd>(&self, simd: S, Pair { part, against }: Pair, chunk: usize) -> [u8; 3] {
        let Some((own, place)) = self.figure.parts.get(part).zip(self.posed.parts.get(part)) else {
            return [0; 3];
        };
        let axis = place.axis(simd, chunk);
        let goes = Number::of(simd, &place.goes, chunk);
        let gap = Number::of(simd, &self.gaps, chunk);
        match against {
            Against::Floor => {
                let Vector([_, _, height]) = axis.centre;
                let Vector([_, _, up]) = axis.half;
                let end = height - up.abs();
                let above = end - (gap + Number::splat(simd, own.radius + own.slack + TOLD));
                match (above - goes).not_positive() {
                    0 => [0; 3],
                    going => {
                        let within = end - (gap + Number::splat(simd, own.inner - own.slack - SURE));
                        let still = above.not_positive();
                        [going, still, within.negative() & still]
                    }
                }
            }
            Against::Slab(at) => {
                let Some(slab) = self.slabs.all.get(at) else { return [0; 3] };
                let [x, y, z] = slab.axes;
                let other = Cuboid {
                    centre: Vector::splat(simd, slab.centre),
                    axes: [Vector::splat(simd, x), Vector::splat(simd, y), Vector::splat(simd, z)],
                    half: Vector::splat(simd, slab.half),
                    is_round: false,
                };
                let least = gap + Number::splat(simd, own.slack + TOLD);
                let ball = Number::splat(simd, own.reach) + least + goes;
                let balls = slab.aside(simd, axis.centre, ball).not_positive();
                if balls == 0 {
                    return [0; 3];
                }
                // What one state alone would be told counts, whatever it is looked at with.
                let going = match self.eight.is_way {
                    true => {
                        let drifting = self.posed.drifting_in_map(simd, self.figure, part, chunk);
                        let still = Drifting::still(simd);
                        balls & drifting_off(simd, other, (axis, own.radius), [drifting, still], least)
                    }
                    false => balls,
                };
                let going = if going == 0 {
                    0
                } else {
                    going & self.slab(simd, (own, place), other, least + goes, chunk)
                };
                match going {
                    0 => [0; 3],
                    going => {
                        let still = match self.eight.is_way {
                            true => going & self.slab(simd, (own, place), other, least, chunk),
                            false => going,
                        };
                        let near = gap + Number::splat(simd, own.inner - own.slack - SURE);
                        let is_told = still != 0 && slab.is_exact && near.least_lane() > 0.0;
                        let sure = if is_told { axis.within(simd, other, near).negative() } else { 0 };
                        [going, still, sure & still]
                    }
                }
            }
            Against::Part(at, common) => {
                let Some((far, beyond)) = self.figure.parts.get(at).zip(self.posed.parts.get(at)) else {
                    return [0; 3];
                };
                let least = gap + Number::splat(simd, own.slack + far.slack + TOLD);
                // What moves both leaves them as far apart as they were.
                let goes = match self.eight.is_way {
                    true => {
                        let goes = |part| self.posed.goes(simd, self.figure, (part, common), chunk);
                        goes(part) + goes(at)
                    }
                    false => Number::splat(simd, 0.0),
                };
                let balls = Number::splat(simd, own.reach + far.reach) + least + goes;
                let between = axis.centre - Vector::of(simd, &beyond.centre, chunk);
                let balls = (between.dot(between) - balls * balls).not_positive();
                if balls == 0 {
                    return [0; 3];
                }
                let two = Two::new(simd, [(own, axis), (far, beyond.axis(simd, chunk))]);
                let capsules = balls & two.capsules(least + goes);
                if capsules == 0 {
                    return [0; 3];
                }
                let cuboids = [self.cuboid(simd, own, place, chunk), self.cuboid(simd, far, beyond, chunk)];
                let going = match self.eight.is_way {
                    true => {
                        let drifting = |part| self.posed.drifting(simd, self.figure, (part, common), chunk);
                        capsules & two.drifting(simd, [drifting(part), drifting(at)], cuboids, least)
                    }
                    false => capsules,
                };
                let going = if going == 0 { 0 } else { going & two.near(simd, cuboids, least + goes) };
                match going {
                    0 => [0; 3],
                    going => {
                        let still = match self.eight.is_way {
                            true => match going & two.capsules(least) {
                                0 => 0,
                                still => still & two.near(simd, cuboids, least),
                            },
                            false => going,
                        };
                        let near =
                            gap + Number::splat(simd, own.inner + far.inner - own.slack - far.slack - SURE);
                        let sure = if still != 0 && near.least_lane() > 0.0 {
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
    #[cfg_attr(optimised, inline(always))]
    fn slab<S: Simd>(
        &self,
        simd: S,
        (own, place): (&Part, &Place),
        other: Cuboid<S>,
        wanted: Number<S>,
        chunk: usize,
    ) -> u8 {
        let axis = place.axis(simd, chunk);
        let mut bits = beside(simd, axis, other, wanted + Number::splat(simd, own.radius), 6);
        if let (true, Some(cuboid)) = (bits != 0, self.cuboid(simd, own, place, chunk)) {
            bits &= cuboid.aside(simd, other, wanted).not_positive();
            bits &= other.aside(simd, cuboid, wanted).not_positive();
        }
        bits
    }

    /// The box of a part that is no capsule.
    #[cfg_attr(optimised, inline(always))]
    fn cuboid<S: Simd>(&self, simd: S, part: &Part, place: &Place, chunk: usize) -> Option<Cuboid<S>> {
        let ([x, y, z], half) = part.slab?;
        let (posed, frame) = (&self.posed, part.frame);
        Some(Cuboid {
            centre: Vector::of(simd, &place.centre, chunk),
            axes: [
                posed.direction(simd, frame, x, chunk),
                posed.direction(simd, frame, y, chunk),
                posed.direction(simd, frame, z, chunk),
            ],
            half: Vector::splat(simd, half),
            is_round: part.is_round,
        })
    }
}

impl Place {
    #[cfg_attr(optimised, inline(always))]
    fn axis<S: Simd>(&self, simd: S, chunk: usize) -> Axis<S> {
        Axis { centre: Vector::of(simd, &self.centre, chunk), half: Vector::of(simd, &self.half, chunk) }
    }
}
