//! Whether two solids may be near each other in eight states: closer and closer, from the balls around them to their boxes, and on a
//! way by how they drift.

use pulp::Simd;

use super::apart::{Axis, Cuboid};
use super::drift::Drifting;
use super::figure::Part;
use super::look::{Against, Looked, Pair};
use super::number::{Number, Vector};
use super::pose::Place;
use super::{SURE, TOLD};

impl Looked<'_> {
    /// Bits for the states in which a pair may be near on the way, where it stands, and is for certain where it stands.
    #[inline(always)]
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
                // What moves both counts twice here, which is no less than it does.
                let both = goes + Number::of(simd, &beyond.goes, chunk);
                let balls = Number::splat(simd, own.reach + far.reach) + least + both;
                let between = axis.centre - Vector::of(simd, &beyond.centre, chunk);
                let balls = (between.dot(between) - balls * balls).not_positive();
                if balls == 0 {
                    return [0; 3];
                }
                let pair = [(own, place), (far, beyond)];
                let going = match self.eight.is_way {
                    true => {
                        let drifting = |part| self.posed.drifting(simd, self.figure, (part, common), chunk);
                        let both = [drifting(part), drifting(at)];
                        match balls & self.drifting_parts(simd, pair, both, least, chunk) {
                            0 => 0,
                            going => {
                                let [one, other] = both;
                                going & self.parts(simd, pair, least + one.goes() + other.goes(), chunk)
                            }
                        }
                    }
                    false => balls & self.parts(simd, pair, least, chunk),
                };
                match going {
                    0 => [0; 3],
                    going => {
                        let still = match self.eight.is_way {
                            true => going & self.parts(simd, pair, least, chunk),
                            false => going,
                        };
                        let near =
                            gap + Number::splat(simd, own.inner + far.inner - own.slack - far.slack - SURE);
                        let sure = if still != 0 && near.least_lane() > 0.0 {
                            let way = axis.way(simd, beyond.axis(simd, chunk));
                            (way.dot(way) - near * near).negative()
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

    /// A bit for each state in which two parts may be no farther apart than wanted.
    #[inline(always)]
    fn parts<S: Simd>(&self, simd: S, pair: [(&Part, &Place); 2], wanted: Number<S>, chunk: usize) -> u8 {
        let [(own, place), (far, beyond)] = pair;
        let (axis, other) = (place.axis(simd, chunk), beyond.axis(simd, chunk));
        let radii = Number::splat(simd, own.radius + far.radius);
        let mut bits = axis.apart(simd, other, wanted + radii).not_positive();
        if bits == 0 {
            return 0;
        }
        let (one, two) = (self.cuboid(simd, own, place, chunk), self.cuboid(simd, far, beyond, chunk));
        if let Some(cuboid) = two {
            bits &= beside(simd, axis, cuboid, wanted + Number::splat(simd, own.radius), 4);
        }
        if let Some(cuboid) = one {
            bits &= beside(simd, other, cuboid, wanted + Number::splat(simd, far.radius), 4);
        }
        if let (Some(one), Some(two)) = (one, two) {
            bits &= one.aside(simd, two, wanted).not_positive();
            bits &= two.aside(simd, one, wanted).not_positive();
        }
        bits
    }

    /// A bit for each state in which two parts may come no farther apart than wanted, by how they drift along the way between them and
    /// the directions of what is a box.
    #[inline(always)]
    fn drifting_parts<S: Simd>(
        &self,
        simd: S,
        pair: [(&Part, &Place); 2],
        both: [Drifting<S>; 2],
        least: Number<S>,
        chunk: usize,
    ) -> u8 {
        let [(own, place), (far, beyond)] = pair;
        let (axis, other) = (place.axis(simd, chunk), beyond.axis(simd, chunk));
        let [one, two] = both;
        let way = axis.way(simd, other);
        let length = way.dot(way).sqrt();
        let room =
            (axis.centre - other.centre).dot(way) - way.dot(axis.half).abs() - way.dot(other.half).abs();
        let radii = Number::splat(simd, own.radius + far.radius) + least;
        let mut bits = (room - radii * length - one.approach(two, way, length)).not_positive();
        if let (true, Some(cuboid)) = (bits != 0, self.cuboid(simd, far, beyond, chunk)) {
            bits &= drifting_off(simd, cuboid, (axis, own.radius), [one, two.ball(simd, far.reach)], least);
        }
        if let (true, Some(cuboid)) = (bits != 0, self.cuboid(simd, own, place, chunk)) {
            bits &= drifting_off(simd, cuboid, (other, far.radius), [two, one.ball(simd, own.reach)], least);
        }
        bits
    }

    /// The box of a part that is no capsule.
    #[inline(always)]
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

/// A bit for each state in which an axis may be no farther from a box than wanted; in pieces where it matters.
#[inline(always)]
fn beside<S: Simd>(simd: S, axis: Axis<S>, other: Cuboid<S>, wanted: Number<S>, pieces: u8) -> u8 {
    match axis.beside(simd, other, wanted, 1).not_positive() {
        0 => 0,
        bits => bits & axis.beside(simd, other, wanted, pieces).not_positive(),
    }
}

/// A bit for each state in which a capsule may come no farther from a box than wanted along any of the directions of that, with how
/// both drift.
#[inline(always)]
fn drifting_off<S: Simd>(
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

impl Place {
    #[inline(always)]
    fn axis<S: Simd>(&self, simd: S, chunk: usize) -> Axis<S> {
        Axis { centre: Vector::of(simd, &self.centre, chunk), half: Vector::of(simd, &self.half, chunk) }
    }
}
