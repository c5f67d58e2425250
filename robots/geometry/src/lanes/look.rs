//! Which pairs of solids cannot be told to be apart in eight states.

use pulp::{Arch, Simd, WithSimd};

use super::TOLD;
use super::bounds::Bound;
use super::figure::{Eight, Figure, bit};
use super::pose::{Posed, Row};
use super::slab::Slabs;

/// There is room for so many pairs from the beginning.
const MET: usize = 16;

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
    pub(crate) slabs: &'a Slabs,
    /// How far apart all has to be in each state, in m.
    pub(crate) gaps: [f32; 8],
    /// Whether parts are looked at among each other, where all pairs are.
    pub(crate) is_own: bool,
    /// Whether no more has to be known as soon as something is touched for certain: in all states, or in one on a way.
    pub(crate) is_first: bool,
    /// Pairs to look at, each with a bit for the states that count; all where there are none.
    pub(crate) pairs: Option<&'a [(Pair, u8)]>,
    /// Where the robot is placed.
    pub(crate) posed: &'a mut Posed,
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

    #[cfg_attr(optimised, inline(always))]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<Met> {
        match self.pairs {
            None => self.posed.set(simd, self.figure, self.eight, |_| true, true),
            Some(pairs) => {
                let mut needed = 0;
                for (Pair { part, against }, _) in pairs {
                    needed |= bit(*part);
                    if let Against::Part(at, _) = against {
                        needed |= bit(*at);
                    }
                }
                self.posed.set(simd, self.figure, self.eight, |part| needed & bit(part) != 0, false);
            }
        }
        let mut looked = Looked {
            figure: self.figure,
            eight: self.eight,
            slabs: self.slabs,
            gaps: self.gaps,
            is_first: self.is_first,
            posed: self.posed,
        };
        let mut met = Vec::with_capacity(MET);
        match self.pairs {
            Some(pairs) => {
                for (pair, lanes) in pairs {
                    looked.look(simd, *pair, *lanes, &mut met);
                }
            }
            None => looked.all(simd, self.counts, self.is_own, &mut met),
        }
        met
    }
}

pub(super) struct Looked<'a> {
    pub(super) figure: &'a Figure,
    pub(super) eight: &'a Eight,
    pub(super) slabs: &'a Slabs,
    pub(super) gaps: Row,
    pub(super) is_first: bool,
    pub(super) posed: &'a mut Posed,
}

impl Looked<'_> {
    #[cfg_attr(optimised, inline(always))]
    fn all<S: Simd>(
        &mut self,
        simd: S,
        counts: impl Fn(usize, Option<usize>) -> bool,
        is_own: bool,
        met: &mut Vec<Met>,
    ) {
        // More than what may be off of any two parts.
        let wide = self.gaps.iter().fold(0.0, |most: f32, gap| most.max(*gap))
            + self.figure.parts.iter().fold(0.0, |most: f32, part| most.max(2.0 * part.slack))
            + TOLD;
        let Posed { parts, bounds, .. } = &mut *self.posed;
        let mut all = Bound::NOWHERE;
        for (place, at) in parts.iter().zip(0..) {
            bounds.set(at, &place.bound);
            all.add(&place.bound);
        }
        let posed = &*self.posed;
        let slabs = &self.slabs.bounds;
        let mut rows = 0;
        for row in 0..slabs.rows() {
            rows |= if slabs.near(simd, row, &all, wide) == 0 { 0 } else { bit(row) };
        }
        let mut touched = 0;
        for (place, part) in posed.parts.iter().zip(0..) {
            if self.eight.is_way && !place.moves {
                continue;
            }
            for row in 0..slabs.rows() {
                if rows & bit(row) == 0 {
                    continue;
                }
                for lane in ones(slabs.near(simd, row, &place.bound, wide)) {
                    let at = 8 * row + lane;
                    if self.slabs.all.get(at).is_some_and(|slab| counts(part, Some(slab.entity))) {
                        touched |= self.look(simd, Pair { part, against: Against::Slab(at) }, u8::MAX, met);
                        if self.is_told(touched) {
                            return;
                        }
                    }
                }
            }
            let [_, _, lowest] = place.bound.low;
            if lowest <= wide && counts(part, None) {
                touched |= self.look(simd, Pair { part, against: Against::Floor }, u8::MAX, met);
                if self.is_told(touched) {
                    return;
                }
            }
        }
        if !is_own {
            return;
        }
        let moving = if self.eight.is_way { self.eight.moving() } else { u64::MAX };
        let figures = self.figure.parts.iter().zip(&self.figure.beside);
        for ((place, (own, beside)), part) in posed.parts.iter().zip(figures).zip(0..) {
            for (row, others) in beside.iter().enumerate().filter(|(_, others)| others.parts != 0) {
                for lane in ones(others.parts & posed.bounds.near(simd, row, &place.bound, wide)) {
                    let at = 8 * row + lane;
                    let Some(other) = self.figure.parts.get(at) else { continue };
                    // What moves both, or none, leaves them as far apart as they were.
                    if !own.is_moved_against(other, moving) {
                        continue;
                    }
                    let common = others.common.get(lane).copied().unwrap_or_default();
                    touched |=
                        self.look(simd, Pair { part, against: Against::Part(at, common) }, u8::MAX, met);
                    if self.is_told(touched) {
                        return;
                    }
                }
            }
        }
    }

    /// Whether no more has to be known, by the states in which something is touched: all of them, or one on a way.
    #[cfg_attr(optimised, inline(always))]
    fn is_told(&self, touched: u8) -> bool {
        self.is_first && (touched == u8::MAX || (self.eight.is_way && touched != 0))
    }

    /// Looks at one pair in some states, closer and closer: those of them in which it is known to be near.
    #[cfg_attr(optimised, inline(always))]
    fn look<S: Simd>(&self, simd: S, pair: Pair, wanted: u8, met: &mut Vec<Met>) -> u8 {
        let (mut lanes, mut still, mut sure) = (0, 0, 0);
        for chunk in 0..8 / S::F32_LANES {
            let [going, standing, touching] = self.chunk(simd, pair, chunk);
            lanes |= going << (chunk * S::F32_LANES);
            still |= standing << (chunk * S::F32_LANES);
            sure |= touching << (chunk * S::F32_LANES);
        }
        (lanes, still, sure) = (lanes & wanted, still & wanted, sure & wanted);
        if lanes != 0 {
            met.push(Met { pair, lanes, still, sure });
        }
        sure
    }
}

/// The bits that are set, the lowest first.
fn ones(bits: u8) -> impl Iterator<Item = usize> {
    let rest = |bits: &u8| Some(bits & bits.wrapping_sub(1));
    let left = std::iter::successors(Some(bits), rest).take_while(|bits| *bits != 0);
    left.map(|bits| bits.trailing_zeros() as usize)
}
