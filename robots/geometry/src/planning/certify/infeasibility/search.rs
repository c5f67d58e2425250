//! Branch-and-bound search over patches, and over the cells of each.

use std::rc::Rc;

use nalgebra::Isometry3;

use super::cover::{ArmFamily, CellModel, CellPlacement, ContactGroup};
use super::relative::{BodyPair, PairGroup};
use super::split::{SplitCause, SplitGain, TRUSTED};
use crate::inverse::interval::{CellEnclosure, DisplacementBound, IkCell, IntervalSolution, PoseSet};
use crate::planning::grasp::{GraspCandidate, GraspManifold, GraspPatch, widest};
use crate::planning::scene::Configuration;

/// Spread in m of tip poses that are covered together.
const COARSE: f64 = 0.6;
/// Least size in m of patches in which the hand alone is checked.
const FINE: f64 = 0.03;
/// Ratio of cell to patch size above which a cell is split before the patch, where no split cause is known.
const WIDER: f64 = 2.0;
/// Minimum ratio between the side chosen for splitting and the longest side.
const SLIM: f64 = 8.0;
/// Motion in m below which a cell is sampled for a free configuration.
const SMALL: f64 = 0.1;
/// Number of recent contact pairs that are checked first.
const KNOWN: usize = 8;
/// Motion in m below which a cell is given up.
const LEAST: f64 = 5e-4;

/// Cell with the bodies that may be in contact in it.
#[derive(Clone)]
pub(super) struct CellNode {
    pub(super) cell: IkCell,
    pub(super) groups: Rc<[ContactGroup]>,
    pub(super) pair_groups: Rc<[PairGroup]>,
    /// Gain of a split, where a constraint is near.
    pub(super) split_gain: Option<SplitGain>,
}

impl CellNode {
    /// Halves across a parameter.
    fn halves(self, across: usize) -> [Self; 2] {
        let split_gain = self.split_gain.map(|split_gain| split_gain.halved(across));
        self.cell.halves(across).map(|cell| Self { cell, split_gain, ..self.clone() })
    }
}

/// Patch with the bodies that the hand may touch, and its open cells.
pub(super) struct OpenPatch {
    pub(super) patch: GraspPatch,
    pub(super) hand: Rc<[ContactGroup]>,
    pub(super) nodes: Rc<[CellNode]>,
}

/// Outcome of one patch.
pub(super) enum PatchOutcome {
    /// No configuration is free.
    Done,
    Halves([OpenPatch; 2]),
    /// A free configuration.
    Free(Box<GraspCandidate>, Configuration),
    /// Undecidable, or the budget is spent.
    Unclear,
}

/// State of the branch and bound.
pub(super) struct BranchAndBound<'c, 'a, 'r, 'w> {
    cover: CellModel<'a, 'r, 'w>,
    manifold: &'c GraspManifold<'c>,
    /// Remaining budget of cells.
    cells: usize,
    known: RecentPairs,
    placing: CellPlacement,
    /// Placement for a check in between.
    aside: CellPlacement,
}

impl<'c, 'a, 'r, 'w> BranchAndBound<'c, 'a, 'r, 'w> {
    pub(super) fn new(cover: CellModel<'a, 'r, 'w>, manifold: &'c GraspManifold<'c>, cells: usize) -> Self {
        let (placing, aside) = (CellPlacement::default(), CellPlacement::default());
        Self { cover, manifold, cells, known: RecentPairs::default(), placing, aside }
    }

    /// Checks whether the hand alone is in contact for all grasps, without splitting far.
    pub(super) fn is_hand_stuck(&mut self, groups: &Rc<[ContactGroup]>) -> bool {
        let patches = self.manifold.patches().into_iter();
        let mut open: Vec<(GraspPatch, Rc<[ContactGroup]>)> =
            patches.map(|patch| (patch, Rc::clone(groups))).collect();
        while let Some((patch, groups)) = open.pop() {
            let Some((map_from_tip, drift)) = self.manifold.over(&patch) else { continue };
            self.cover.place_hand(&PoseSet::new(map_from_tip, drift), &mut self.placing);
            let Some(groups) = self.left_of(&groups) else { continue };
            let (size, across) = self.manifold.widest(&patch);
            if size < FINE || self.is_spent() {
                return false;
            }
            open.extend(patch.halves(across).map(|patch| (patch, Rc::clone(&groups))));
        }
        true
    }

    /// Outcome of a patch: closed, or split into halves.
    pub(super) fn halves(&mut self, OpenPatch { patch, hand, nodes }: OpenPatch) -> PatchOutcome {
        if self.is_spent() {
            return PatchOutcome::Unclear;
        }
        let Some((map_from_tip, drift)) = self.manifold.over(&patch) else { return PatchOutcome::Done };
        let tips = PoseSet::new(map_from_tip, drift);
        let (size, across) = self.manifold.widest(&patch);
        self.cover.place_hand(&tips, &mut self.placing);
        let Some(hand) = self.left_of(&hand) else { return PatchOutcome::Done };
        let nodes = if size > COARSE {
            nodes
        } else {
            let hold = self.manifold.hold(&patch).filter(|hold| self.is_hand_free(hold, &hand));
            match (self.cover.family, &hold) {
                (ArmFamily::Any, Some(_)) => return PatchOutcome::Unclear,
                // A smaller patch may be in contact throughout.
                (ArmFamily::Any, None) => nodes,
                (ArmFamily::Lift(_) | ArmFamily::Parallel(..) | ArmFamily::Seven(..), _) => {
                    match self.left(&tips, hold.as_ref(), WIDER * size, &nodes) {
                        Remaining::Nodes(left) if left.is_empty() => return PatchOutcome::Done,
                        Remaining::Nodes(mut left) => {
                            let gains = left.iter_mut().filter_map(|node| node.split_gain.as_mut());
                            gains.for_each(SplitGain::halve_patch);
                            left.into()
                        }
                        Remaining::Free(configuration) => match hold {
                            Some(hold) => return PatchOutcome::Free(Box::new(hold), configuration),
                            None => return PatchOutcome::Unclear,
                        },
                        Remaining::Unclear => return PatchOutcome::Unclear,
                    }
                }
            }
        };
        if size < LEAST {
            return PatchOutcome::Unclear;
        }
        PatchOutcome::Halves(patch.halves(across).map(|patch| OpenPatch {
            patch,
            hand: Rc::clone(&hand),
            nodes: Rc::clone(&nodes),
        }))
    }

    fn is_spent(&mut self) -> bool {
        let fewer = self.cells.checked_sub(1);
        self.cells = fewer.unwrap_or(0);
        fewer.is_none()
    }

    /// Reduced lists of some groups; `None` where a pair is in contact throughout.
    fn left_of(&mut self, groups: &Rc<[ContactGroup]>) -> Option<Rc<[ContactGroup]>> {
        let Self { cover, known, placing, .. } = self;
        if known.any(|pair| cover.touches(placing, pair, 1.0)) {
            return None;
        }
        fewer(groups, known, |group| cover.left_of(placing, group))
    }

    /// Reduced lists of the robot's own pairs; `None` where a pair is in contact throughout.
    fn pair_group(&mut self, pair_groups: &Rc<[PairGroup]>) -> Option<Rc<[PairGroup]>> {
        let Self { cover, known, placing, .. } = self;
        fewer(pair_groups, known, |pair_group| cover.pair_group(placing, pair_group))
    }

    /// Checks whether the hand alone is free at a grasp.
    fn is_hand_free(&mut self, hold: &GraspCandidate, groups: &[ContactGroup]) -> bool {
        let tips = PoseSet::new(hold.map_from_tip, DisplacementBound::none());
        self.cover.place_hand(&tips, &mut self.placing);
        !self.cover.is_stuck_in_middle(&mut self.placing, groups)
    }

    /// Open parts of some cells, split down to the size of the patch.
    fn left(
        &mut self,
        tips: &PoseSet,
        hold: Option<&GraspCandidate>,
        enough: f64,
        all: &[CellNode],
    ) -> Remaining {
        let (mut open, mut left) = (all.to_vec(), Vec::new());
        while let Some(node) = open.pop() {
            if self.is_spent() {
                return Remaining::Unclear;
            }
            match self.seen(tips, hold, enough, node) {
                CellOutcome::Closed => {}
                CellOutcome::Free(configuration) => return Remaining::Free(configuration),
                CellOutcome::Unclear => return Remaining::Unclear,
                CellOutcome::Open(node) => match self.across(&node, enough) {
                    Some(across) => open.extend(node.halves(across)),
                    None => left.push(node),
                },
            }
        }
        Remaining::Nodes(left)
    }

    /// Outcome of a cell, which has the split gain of its parent.
    fn seen(
        &mut self,
        tips: &PoseSet,
        hold: Option<&GraspCandidate>,
        enough: f64,
        CellNode { cell, groups, pair_groups, split_gain }: CellNode,
    ) -> CellOutcome {
        let enclosure = match self.cover.family.over(tips, &cell) {
            IntervalSolution::Empty => return CellOutcome::Closed,
            IntervalSolution::Unknown => return CellOutcome::Unclear,
            IntervalSolution::Enclosed(enclosure) => enclosure,
        };
        self.cover.place(&enclosure, &mut self.placing);
        let split_gain = split_gain.filter(SplitGain::is_fresh);
        // A part that is about to close needs no other check.
        if let Some(split_gain) = split_gain
            && self.cover.closes(&mut self.placing, &enclosure, split_gain.split_cause, TRUSTED)
        {
            return match split_gain.split_cause {
                SplitCause::Pair(pair) if self.cover.touches(&mut self.placing, pair, 1.0) => {
                    CellOutcome::Closed
                }
                // Joint limits and the arm's length are exact up to rounding.
                SplitCause::Pair(_) | SplitCause::Joint(_) | SplitCause::Short => {
                    CellOutcome::Open(CellNode { cell, groups, pair_groups, split_gain: Some(split_gain) })
                }
            };
        }
        let Some(groups) = self.left_of(&groups) else { return CellOutcome::Closed };
        let Some(pair_groups) = self.pair_group(&pair_groups) else { return CellOutcome::Closed };
        let (size, _) = widest(&self.sizes(&cell));
        if size.max(enough) < SMALL
            && let Some(hold) = hold
            && !self.cover.is_stuck_in_middle(&mut self.placing, &groups)
            && !self.cover.is_folded_in_middle(&mut self.placing, &pair_groups)
            && let Some(configuration) = self.free_in(&hold.map_from_tip, &enclosure, &cell)
        {
            return CellOutcome::Free(configuration);
        }
        let Self { cover, placing, aside, .. } = self;
        let known = split_gain
            .filter(|split_gain| cover.closes(placing, &enclosure, split_gain.split_cause, split_gain.share));
        let split_gain = known.or_else(|| {
            let (split_cause, share) = cover.split_cause(placing, &enclosure, &groups, &pair_groups)?;
            Some(cover.split_gain(aside, tips, &cell, split_cause, share))
        });
        CellOutcome::Open(CellNode { cell, groups, pair_groups, split_gain })
    }

    /// Parameter across which to split a cell; `None` to split the patch.
    fn across(&self, node: &CellNode, enough: f64) -> Option<usize> {
        let sizes = self.sizes(&node.cell);
        let (size, wide) = widest(&sizes);
        let Some(split_gain) = node.split_gain.as_ref().filter(|split_gain| split_gain.tells()) else {
            return (size >= enough.max(LEAST)).then_some(wide);
        };
        let (off, across) = widest(&split_gain.cell);
        if off < split_gain.patch {
            // A cell much larger than its patch is split in any case.
            return (size >= (SLIM * enough).max(LEAST)).then_some(wide);
        }
        match sizes.get(across) {
            Some(own) if own * SLIM >= size => (size >= LEAST).then_some(across),
            Some(_) | None => (size >= enough.max(LEAST)).then_some(wide),
        }
    }

    /// Approximate motion in m over half of each side of a cell.
    fn sizes(&self, cell: &IkCell) -> [f64; 3] {
        let weights = self.cover.family.weights();
        std::array::from_fn(|at: usize| {
            weights.get(at).zip(cell.half.get(at)).map_or(0.0, |(weight, half)| weight * half)
        })
    }

    /// Free configuration at the middle of a cell, if any.
    fn free_in(
        &self,
        tip: &Isometry3<f64>,
        enclosure: &CellEnclosure,
        cell: &IkCell,
    ) -> Option<Configuration> {
        let CellModel { checker, hand, family, allowed, .. } = &self.cover;
        let context = checker.context;
        let configurations: Vec<_> = match family {
            ArmFamily::Lift(arm) => {
                let [yaw, shoulder, _] = cell.middle;
                let placed = arm.solve(tip, yaw, shoulder).into_iter();
                placed.map(|placed| context.with(hand, placed.base, &placed.values)).collect()
            }
            ArmFamily::Parallel(arm, _) => {
                let found = arm.solve(&(context.map_from_base(enclosure.base).inverse() * tip)).into_iter();
                found.map(|values| context.with(hand, enclosure.base, &values)).collect()
            }
            ArmFamily::Seven(arm, map_from_base, base) => {
                let [last, ..] = cell.middle;
                let found = arm.solve(&(map_from_base.inverse() * tip), last).into_iter();
                found.map(|values| context.with(hand, *base, &values)).collect()
            }
            ArmFamily::Any => vec![],
        };
        configurations.into_iter().find(|configuration| checker.contact(configuration, *allowed).is_none())
    }
}

/// Outcome of one cell.
enum CellOutcome {
    /// No configuration is free.
    Closed,
    /// A free configuration.
    Free(Configuration),
    Unclear,
    /// Undecided, with the remaining bodies and the gain of a split.
    Open(CellNode),
}

/// Remaining cells of a patch.
enum Remaining {
    Nodes(Vec<CellNode>),
    Free(Configuration),
    Unclear,
}

/// Reduces each list; `None` where a pair is in contact throughout, which is recorded.
fn fewer<T: Clone>(
    all: &Rc<[T]>,
    known: &mut RecentPairs,
    mut left_of: impl FnMut(&T) -> Result<Option<T>, BodyPair>,
) -> Option<Rc<[T]>> {
    let mut left: Option<Vec<T>> = None;
    for (one, at) in all.iter().zip(0..) {
        match left_of(one) {
            Ok(None) => {}
            Ok(Some(fewer)) => {
                let left = left.get_or_insert_with(|| all.to_vec());
                left.get_mut(at).into_iter().for_each(|slot| *slot = fewer.clone());
            }
            Err(pair) => {
                known.add(pair);
                return None;
            }
        }
    }
    Some(left.map_or_else(|| Rc::clone(all), Into::into))
}

/// Recent contact pairs, the most frequent last.
#[derive(Default)]
struct RecentPairs(Vec<BodyPair>);

impl RecentPairs {
    fn add(&mut self, pair: BodyPair) {
        if self.0.len() == KNOWN {
            self.0.remove(0);
        }
        self.0.push(pair);
    }

    /// Checks whether a predicate holds for one of them, and moves it back.
    fn any(&mut self, mut is: impl FnMut(BodyPair) -> bool) -> bool {
        let Some(at) = self.0.iter().rposition(|pair| is(*pair)) else { return false };
        let next = (at + 1).min(self.0.len() - 1);
        self.0.swap(at, next);
        true
    }
}
