//! Which pairs of solids cannot be told to be apart in eight states.

use pulp::{Arch, Simd, WithSimd};

use super::apart::{Axis, Cuboid};
use super::figure::{Eight, Figure, Part, Parts};
use super::number::{Number, Vector};
use super::pose::{Place, Posed};
use super::slab::Slab;
use super::{SURE, TOLD};

/// What a part may touch.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Against {
    /// A thing, by its index.
    Slab(usize),
    /// Another part, and how many joints from the root on move both.
    Part(usize, usize),
    /// The floor.
    Floor,
}

/// A pair of solids.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Pair {
    pub(crate) part: usize,
    pub(crate) against: Against,
}

/// A pair that may touch.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Met {
    pub(crate) pair: Pair,
    /// A bit for each state: whether they are not known to stay apart while the robot goes as far as it does.
    pub(crate) lanes: u8,
    /// The same while it stays where it is.
    pub(crate) still: u8,
    /// Of these, whether they are known to be no farther apart than wanted.
    pub(crate) sure: u8,
}

/// Eight states to look at.
pub(crate) struct Look<'a, F> {
    pub(crate) figure: &'a Figure,
    pub(crate) eight: &'a Eight,
    pub(crate) slabs: &'a [Slab],
    /// How far apart all has to be, in m.
    pub(crate) gap: f32,
    /// Whether parts are looked at among each other, where all pairs are.
    pub(crate) is_own: bool,
    /// Whether no more has to be known as soon as something is touched for certain: in all states, or in one on a way.
    pub(crate) is_first: bool,
    /// Pairs to look at; all where there are none.
    pub(crate) pairs: Option<&'a [Pair]>,
    /// Whether a part counts against an entity, and against the floor, where all pairs are looked at.
    pub(crate) counts: F,
}

impl<F: Fn(usize, Option<usize>) -> bool> Look<'_, F> {
    /// The pairs, in a fixed order.
    pub(crate) fn met(self) -> Vec<Met> {
        self.met_on(Arch::new())
    }

    /// The same on a processor that can do no more than is said.
    pub(crate) fn met_on(self, arch: Arch) -> Vec<Met> {
        arch.dispatch(self)
    }
}

impl<F: Fn(usize, Option<usize>) -> bool> WithSimd for Look<'_, F> {
    type Output = Vec<Met>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<Met> {
        let needed = |part: usize| {
            let is_in =
                |pair: &Pair| pair.part == part || matches!(pair.against, Against::Part(at, _) if at == part);
            self.pairs.is_none_or(|pairs| pairs.iter().any(is_in))
        };
        let needed: Vec<bool> = (0..self.figure.parts.len()).map(needed).collect();
        let posed = Posed::new(simd, self.figure, self.eight, &needed);
        let looked = Looked {
            figure: self.figure,
            eight: self.eight,
            slabs: self.slabs,
            gap: self.gap,
            is_first: self.is_first,
            posed,
        };
        let mut met = Vec::new();
        match self.pairs {
            Some(pairs) => {
                for pair in pairs {
                    looked.look(simd, *pair, &mut met);
                }
            }
            None => looked.all(simd, self.counts, self.is_own, &mut met),
        }
        met
    }
}

struct Looked<'a> {
    figure: &'a Figure,
    eight: &'a Eight,
    slabs: &'a [Slab],
    gap: f32,
    is_first: bool,
    posed: Posed,
}

impl Looked<'_> {
    #[inline(always)]
    fn all<S: Simd>(
        &self,
        simd: S,
        counts: impl Fn(usize, Option<usize>) -> bool,
        is_own: bool,
        met: &mut Vec<Met>,
    ) {
        // More than what may be off of any two parts.
        let wide = self.gap
            + self.figure.parts.iter().fold(0.0, |most: f32, part| most.max(2.0 * part.slack))
            + TOLD;
        let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for place in &self.posed.parts {
            for ((low, high), (from, to)) in
                low.iter_mut().zip(&mut high).zip(place.low.iter().zip(&place.high))
            {
                *low = if *from < *low { *from } else { *low };
                *high = if *to > *high { *to } else { *high };
            }
        }
        let near: Vec<usize> = (0..self.slabs.len())
            .filter(|at| {
                self.slabs.get(*at).is_some_and(|slab| meets((&low, &high), (&slab.low, &slab.high), wide))
            })
            .collect();
        let mut touched = 0;
        for (place, part) in self.posed.parts.iter().zip(0..) {
            if self.eight.is_way && !place.moves {
                continue;
            }
            for at in &near {
                let Some(slab) = self.slabs.get(*at) else { continue };
                if meets((&place.low, &place.high), (&slab.low, &slab.high), wide)
                    && counts(part, Some(slab.entity))
                {
                    touched |= self.look(simd, Pair { part, against: Against::Slab(*at) }, met);
                    if self.is_told(touched) {
                        return;
                    }
                }
            }
            let [_, _, lowest] = place.low;
            if lowest <= wide && counts(part, None) {
                touched |= self.look(simd, Pair { part, against: Against::Floor }, met);
                if self.is_told(touched) {
                    return;
                }
            }
        }
        let pairs = if is_own { self.figure.pairs.as_slice() } else { &[] };
        for Parts { one, other, common } in pairs {
            let Some((a, b)) = self.posed.parts.get(*one).zip(self.posed.parts.get(*other)) else { continue };
            if self.eight.is_way && !(self.bends(*one, *common) || self.bends(*other, *common)) {
                continue;
            }
            if meets((&a.low, &a.high), (&b.low, &b.high), wide) {
                let pair = Pair { part: *one, against: Against::Part(*other, *common) };
                touched |= self.look(simd, pair, met);
                if self.is_told(touched) {
                    return;
                }
            }
        }
    }

    /// Whether no more has to be known, by the states in which something is touched: all of them, or one on a way.
    #[inline(always)]
    fn is_told(&self, touched: u8) -> bool {
        self.is_first && (touched == u8::MAX || (self.eight.is_way && touched != 0))
    }

    /// Whether a joint after the first so many moves a part on the way.
    #[inline(always)]
    fn bends(&self, part: usize, common: usize) -> bool {
        let Some(own) = self.figure.parts.get(part) else { return false };
        let levers =
            self.figure.levers.get(own.frame).and_then(|levers| levers.get(common..)).unwrap_or_default();
        levers.iter().any(|at| self.eight.amounts.get(*at).is_some_and(|amount| *amount > 0.0))
    }

    /// Looks at one pair, closer and closer: the states in which it is known to be near.
    #[inline(always)]
    fn look<S: Simd>(&self, simd: S, pair: Pair, met: &mut Vec<Met>) -> u8 {
        let (mut lanes, mut still, mut sure) = (0, 0, 0);
        for chunk in 0..8 / S::F32_LANES {
            let [going, standing, touching] = self.chunk(simd, pair, chunk);
            lanes |= going << (chunk * S::F32_LANES);
            still |= standing << (chunk * S::F32_LANES);
            sure |= touching << (chunk * S::F32_LANES);
        }
        if lanes != 0 {
            met.push(Met { pair, lanes, still, sure });
        }
        sure
    }

    /// Bits for the states in which a pair may be near on the way, where it stands, and is for certain where it stands.
    #[inline(always)]
    fn chunk<S: Simd>(&self, simd: S, Pair { part, against }: Pair, chunk: usize) -> [u8; 3] {
        let Some((own, place)) = self.figure.parts.get(part).zip(self.posed.parts.get(part)) else {
            return [0; 3];
        };
        let axis = place.axis(simd, chunk);
        let goes = Number::of(simd, &place.goes, chunk);
        match against {
            Against::Floor => {
                let Vector([_, _, height]) = axis.centre;
                let Vector([_, _, up]) = axis.half;
                let end = height - up.abs();
                let above = end - Number::splat(simd, own.radius + self.gap + own.slack + TOLD);
                match (above - goes).not_positive() {
                    0 => [0; 3],
                    going => {
                        let within = end - Number::splat(simd, own.inner + self.gap - own.slack - SURE);
                        let still = above.not_positive();
                        [going, still, within.negative() & still]
                    }
                }
            }
            Against::Slab(at) => {
                let Some(slab) = self.slabs.get(at) else { return [0; 3] };
                let [x, y, z] = slab.axes;
                let other = Cuboid {
                    centre: Vector::splat(simd, slab.centre),
                    axes: [Vector::splat(simd, x), Vector::splat(simd, y), Vector::splat(simd, z)],
                    half: Vector::splat(simd, slab.half),
                    is_round: false,
                };
                let least = Number::splat(simd, self.gap + own.slack + TOLD);
                let ball = Number::splat(simd, own.reach) + least + goes;
                let balls = slab.aside(simd, axis.centre, ball).not_positive();
                if balls == 0 {
                    return [0; 3];
                }
                // What one state alone would be told counts, whatever it is looked at with.
                match balls & self.slab(simd, (own, place), other, least + goes, chunk) {
                    0 => [0; 3],
                    going => {
                        let still = match self.eight.is_way {
                            true => going & self.slab(simd, (own, place), other, least, chunk),
                            false => going,
                        };
                        let near = own.inner + self.gap - own.slack - SURE;
                        let is_told = still != 0 && slab.is_exact && near > 0.0;
                        let sure = if is_told { axis.within(simd, other, near).negative() } else { 0 };
                        [going, still, sure & still]
                    }
                }
            }
            Against::Part(at, common) => {
                let Some((far, beyond)) = self.figure.parts.get(at).zip(self.posed.parts.get(at)) else {
                    return [0; 3];
                };
                let least = Number::splat(simd, self.gap + own.slack + far.slack + TOLD);
                // What moves both counts twice here, which is no less than it does.
                let both = goes + Number::of(simd, &beyond.goes, chunk);
                let balls = Number::splat(simd, own.reach + far.reach) + least + both;
                let between = axis.centre - Vector::of(simd, &beyond.centre, chunk);
                let balls = (between.dot(between) - balls * balls).not_positive();
                if balls == 0 {
                    return [0; 3];
                }
                let goes = self.posed.goes_after(simd, self.figure, self.eight, (part, common), chunk)
                    + self.posed.goes_after(simd, self.figure, self.eight, (at, common), chunk);
                let pair = [(own, place), (far, beyond)];
                match balls & self.parts(simd, pair, least + goes, chunk) {
                    0 => [0; 3],
                    going => {
                        let still = match self.eight.is_way {
                            true => going & self.parts(simd, pair, least, chunk),
                            false => going,
                        };
                        let near = own.inner + far.inner + self.gap - own.slack - far.slack - SURE;
                        let sure = if still != 0 && near > 0.0 {
                            let way = axis.way(simd, beyond.axis(simd, chunk));
                            (way.dot(way) - Number::splat(simd, near * near)).negative()
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

impl Place {
    #[inline(always)]
    fn axis<S: Simd>(&self, simd: S, chunk: usize) -> Axis<S> {
        Axis { centre: Vector::of(simd, &self.centre, chunk), half: Vector::of(simd, &self.half, chunk) }
    }
}

/// Whether two boxes come nearer than `wide` to each other.
#[inline(always)]
fn meets((low, high): (&[f32; 3], &[f32; 3]), (from, to): (&[f32; 3], &[f32; 3]), wide: f32) -> bool {
    let ([a, b, c], [d, e, f], [p, q, r], [u, v, w]) = (low, high, from, to);
    let x = (*a - wide <= *u) & (*p <= *d + wide);
    let y = (*b - wide <= *v) & (*q <= *e + wide);
    let z = (*c - wide <= *w) & (*r <= *f + wide);
    x & y & z
}
