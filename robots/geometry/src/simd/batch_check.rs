//! Batch check: finds the pairs of solids that are not certainly apart in eight configurations.

use pulp::{Arch, Simd, WithSimd};

use super::TOLD;
use super::batch_model::{Batch8, BatchModel, bit};
use super::boxes::{Aabb, ObbSet};
use super::lanes::Lane8;
use super::posed_batch::PosedBatch;

/// Capacity reserved for pairs.
const MET: usize = 16;

/// Second member of a pair: the body that a part may touch.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum PairTarget {
    /// Obstacle, by its index.
    Obb(usize),
    /// Another part, and the number of joints, from the root on, that move both.
    Part(usize, usize),
    Floor,
}

/// Pair of a part and another body.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct BatchPair {
    pub(crate) part: usize,
    pub(crate) target: PairTarget,
    /// Distance required beyond that of the batch, in m.
    pub(crate) beyond: f32,
}

/// Pair that may touch.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct NearPair {
    pub(crate) pair: BatchPair,
    /// Bit mask of the configurations around which the pair may touch while the robot moves as far as given.
    pub(crate) lanes: u8,
    /// Bit mask of the configurations in which the pair may touch without motion.
    pub(crate) still: u8,
    /// Bit mask, of these, of the configurations in which the pair certainly touches.
    pub(crate) sure: u8,
}

/// Check of eight configurations.
pub(crate) struct BatchCheck<'a, F> {
    pub(crate) batch_model: &'a BatchModel,
    pub(crate) batch: &'a Batch8,
    pub(crate) obbs: &'a ObbSet,
    /// Required clearance in each configuration, in m.
    pub(crate) gaps: [f32; 8],
    /// True to check self-collision pairs too, where all pairs are checked.
    pub(crate) is_own: bool,
    /// True to stop at the first certain contact: in all configurations, or in one on an edge.
    pub(crate) is_first: bool,
    /// Pairs to check, each with a bit mask of configurations; `None` for all pairs.
    pub(crate) pairs: Option<&'a [(BatchPair, u8)]>,
    /// Buffer for the poses of the robot.
    pub(crate) posed: &'a mut PosedBatch,
    /// Greatest distance that `beyond` gives, in m.
    pub(crate) most_beyond: f32,
    /// Distance required beyond that of the batch, in m, of a part and an obstacle by its index, or the floor
    /// (`None`), where all pairs are checked; `None` for a pair that does not count.
    pub(crate) beyond: F,
}

impl<F: Fn(usize, Option<usize>) -> Option<f32>> BatchCheck<'_, F> {
    /// Pairs that may touch, in a fixed order.
    pub(crate) fn near_pairs(self) -> Vec<NearPair> {
        self.near_pairs_on(Arch::new())
    }

    /// The same with the instructions of a given processor.
    pub(crate) fn near_pairs_on(self, arch: Arch) -> Vec<NearPair> {
        arch.dispatch(self)
    }
}

impl<F: Fn(usize, Option<usize>) -> Option<f32>> WithSimd for BatchCheck<'_, F> {
    type Output = Vec<NearPair>;

    #[cfg_attr(optimised, inline(always))]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<NearPair> {
        match self.pairs {
            None => self.posed.set(simd, self.batch_model, self.batch, |_| true, true),
            Some(pairs) => {
                let mut needed = 0;
                for (BatchPair { part, target, .. }, _) in pairs {
                    needed |= bit(*part);
                    if let PairTarget::Part(at, _) = target {
                        needed |= bit(*at);
                    }
                }
                self.posed.set(simd, self.batch_model, self.batch, |part| needed & bit(part) != 0, false);
            }
        }
        let mut looked = BatchChecker {
            batch_model: self.batch_model,
            batch: self.batch,
            obbs: self.obbs,
            gaps: self.gaps,
            is_first: self.is_first,
            posed: self.posed,
        };
        let mut near_pairs = Vec::with_capacity(MET);
        match self.pairs {
            Some(pairs) => {
                for (pair, lanes) in pairs {
                    looked.look(simd, *pair, *lanes, &mut near_pairs);
                }
            }
            None => looked.all(simd, self.beyond, self.most_beyond, self.is_own, &mut near_pairs),
        }
        near_pairs
    }
}

pub(super) struct BatchChecker<'a> {
    pub(super) batch_model: &'a BatchModel,
    pub(super) batch: &'a Batch8,
    pub(super) obbs: &'a ObbSet,
    pub(super) gaps: Lane8,
    pub(super) is_first: bool,
    pub(super) posed: &'a mut PosedBatch,
}

impl BatchChecker<'_> {
    #[cfg_attr(optimised, inline(always))]
    fn all<S: Simd>(
        &mut self,
        simd: S,
        beyond: impl Fn(usize, Option<usize>) -> Option<f32>,
        most_beyond: f32,
        is_own: bool,
        near_pairs: &mut Vec<NearPair>,
    ) {
        // More than the error of any two parts.
        let wide_own = self.gaps.iter().fold(0.0, |most: f32, gap| most.max(*gap))
            + self.batch_model.parts.iter().fold(0.0, |most: f32, part| most.max(2.0 * part.slack))
            + TOLD;
        let wide = wide_own + most_beyond;
        let PosedBatch { parts, bounds, .. } = &mut *self.posed;
        let mut all = Aabb::NOWHERE;
        for (place, at) in parts.iter().zip(0..) {
            bounds.set(at, &place.bound);
            all.add(&place.bound);
        }
        let posed = &*self.posed;
        let obbs = &self.obbs.bounds;
        let mut rows = 0;
        for row in 0..obbs.rows() {
            rows |= if obbs.near(simd, row, &all, wide) == 0 { 0 } else { bit(row) };
        }
        let mut touched = 0;
        for (place, part) in posed.parts.iter().zip(0..) {
            if self.batch.is_way && !place.moves {
                continue;
            }
            for row in 0..obbs.rows() {
                if rows & bit(row) == 0 {
                    continue;
                }
                for lane in ones(obbs.near(simd, row, &place.bound, wide)) {
                    let at = 8 * row + lane;
                    let Some(beyond) = beyond(part, Some(at)) else { continue };
                    let pair = BatchPair { part, target: PairTarget::Obb(at), beyond };
                    touched |= self.look(simd, pair, u8::MAX, near_pairs);
                    if self.is_told(touched) {
                        return;
                    }
                }
            }
            let [_, _, lowest] = place.bound.low;
            if lowest <= wide
                && let Some(beyond) = beyond(part, None)
            {
                let pair = BatchPair { part, target: PairTarget::Floor, beyond };
                touched |= self.look(simd, pair, u8::MAX, near_pairs);
                if self.is_told(touched) {
                    return;
                }
            }
        }
        if !is_own {
            return;
        }
        let moving = if self.batch.is_way { self.batch.moving() } else { u64::MAX };
        let figures = self.batch_model.parts.iter().zip(&self.batch_model.beside);
        for ((place, (own, beside)), part) in posed.parts.iter().zip(figures).zip(0..) {
            for (row, others) in beside.iter().enumerate().filter(|(_, others)| others.parts != 0) {
                for lane in ones(others.parts & posed.bounds.near(simd, row, &place.bound, wide_own)) {
                    let at = 8 * row + lane;
                    let Some(other) = self.batch_model.parts.get(at) else { continue };
                    // A joint that moves both, or none, keeps their distance.
                    if !own.is_moved_against(other, moving) {
                        continue;
                    }
                    let common = others.common.get(lane).copied().unwrap_or_default();
                    touched |= self.look(
                        simd,
                        BatchPair { part, target: PairTarget::Part(at, common), beyond: 0.0 },
                        u8::MAX,
                        near_pairs,
                    );
                    if self.is_told(touched) {
                        return;
                    }
                }
            }
        }
    }

    /// True to stop at the first certain contact: in all configurations, or in one on an edge.
    #[cfg_attr(optimised, inline(always))]
    fn is_told(&self, touched: u8) -> bool {
        self.is_first && (touched == u8::MAX || (self.batch.is_way && touched != 0))
    }

    /// Checks one pair in some configurations, with tighter bounds at each step; returns those with a certain
    /// contact.
    #[cfg_attr(optimised, inline(always))]
    fn look<S: Simd>(&self, simd: S, pair: BatchPair, wanted: u8, near_pairs: &mut Vec<NearPair>) -> u8 {
        let (mut lanes, mut still, mut sure) = (0, 0, 0);
        for chunk in 0..8 / S::F32_LANES {
            let [going, standing, touching] = self.chunk(simd, pair, chunk);
            lanes |= going << (chunk * S::F32_LANES);
            still |= standing << (chunk * S::F32_LANES);
            sure |= touching << (chunk * S::F32_LANES);
        }
        (lanes, still, sure) = (lanes & wanted, still & wanted, sure & wanted);
        if lanes != 0 {
            near_pairs.push(NearPair { pair, lanes, still, sure });
        }
        sure
    }
}

/// Indices of the set bits, lowest first.
fn ones(bits: u8) -> impl Iterator<Item = usize> {
    let rest = |bits: &u8| Some(bits & bits.wrapping_sub(1));
    let left = std::iter::successors(Some(bits), rest).take_while(|bits| *bits != 0);
    left.map(|bits| bits.trailing_zeros() as usize)
}
