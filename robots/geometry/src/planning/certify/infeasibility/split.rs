//! Choice of the split parameter: finds the constraint that is nearest to closing a cell, and the parameter
//! that keeps it open most. A hand turned beyond its wrist is so at any yaw of the base, so that a split of
//! the yaw is useless.
//!
//! A constraint is near where it closes the cell for a share of the motion: at a half, one split is enough.
//! Constraints that are nowhere near are no causes, since at their boundary no cell is small enough.
//!
//! A gain is an estimate: it orders splits and delays checks, and closes no cell. So halves may inherit it.

use super::cover::{CellModel, CellPlacement, ContactGroup};
use super::relative::{BodyPair, PairGroup};
use crate::inverse::interval::{CellEnclosure, DisplacementBound, IkCell, IntervalSolution, PoseSet};

/// Shares of the motion at which a constraint counts, the farthest from closing first.
const SHARES: [f64; 4] = [0.0625, 0.125, 0.25, 0.5];
/// Share from which on the cause is trusted until it has closed the cell or failed.
pub(super) const TRUSTED: f64 = 0.25;
/// Excess beyond a limit that is more than rounding, in rad or m.
const BEYOND: f64 = 1e-4;
/// Greatest number of splits after which a gain is not measured again.
const FRESH: u8 = 3;
/// Drift below which a cause is exact, in rad or m.
const STILL: f64 = 1e-3;

/// Constraint that closes the middle of a cell.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum SplitCause {
    /// Variable of the arm beyond its limits, by index.
    Joint(usize),
    /// Arm too short.
    Short,
    /// Pair in contact.
    Pair(BodyPair),
}

/// Gain of a split for a constraint.
#[derive(Clone, Copy, Debug)]
pub(super) struct SplitGain {
    pub(super) split_cause: SplitCause,
    /// Share of the motion at which it closes the cell.
    pub(super) share: f64,
    /// Drift by each parameter of the cell alone, in rad or m.
    pub(super) cell: [f64; 3],
    /// Drift by the patch alone, in rad or m.
    pub(super) patch: f64,
    /// Number of splits since it was measured.
    splits: u8,
}

impl SplitGain {
    /// Checks whether any parameter contributes.
    pub(super) fn tells(&self) -> bool {
        self.cell.iter().fold(self.patch, |most, off| most.max(*off)) > STILL
    }

    /// Checks whether its values are near those that a measurement would give.
    pub(super) fn is_fresh(&self) -> bool {
        self.splits <= FRESH
    }

    /// Gain in a half of the cell.
    pub(super) fn halved(mut self, across: usize) -> Self {
        self.cell.get_mut(across).into_iter().for_each(|off| *off *= 0.5);
        self.splits += 1;
        self
    }

    /// Makes it that of a half of the patch.
    pub(super) fn halve_patch(&mut self) {
        self.patch *= 0.5;
        self.splits += 1;
    }
}

impl CellModel<'_, '_, '_> {
    /// Checks whether a constraint closes a cell for a share of the motion. For joint limits and the arm's
    /// length the result is approximate, and no proof.
    pub(super) fn closes(
        &self,
        placing: &mut CellPlacement,
        enclosure: &CellEnclosure,
        split_cause: SplitCause,
        share: f64,
    ) -> bool {
        let is_beyond = |beyond: f64, off: f64| beyond > BEYOND && beyond >= share * off;
        match split_cause {
            SplitCause::Joint(at) => {
                let dof = self.hand.solver.chain().dofs.get(at);
                let limits = dof.and_then(|dof| dof.limits).zip(enclosure.values.get(at));
                limits.is_some_and(|((lower, upper), [value, off])| {
                    is_beyond((lower - value).max(value - upper), *off)
                })
            }
            SplitCause::Short => {
                let [short, off] = enclosure.short;
                is_beyond(short, off)
            }
            SplitCause::Pair(pair) => self.touches(placing, pair, share),
        }
    }

    /// Constraint nearest to closing a cell, with its share.
    pub(super) fn split_cause(
        &self,
        placing: &mut CellPlacement,
        enclosure: &CellEnclosure,
        groups: &[ContactGroup],
        pair_groups: &[PairGroup],
    ) -> Option<(SplitCause, f64)> {
        let limits = (0..enclosure.values.len()).map(SplitCause::Joint).chain([SplitCause::Short]);
        let pairs =
            groups.iter().flat_map(ContactGroup::pairs).chain(pair_groups.iter().flat_map(PairGroup::pairs));
        let mut best: Option<(SplitCause, f64)> = None;
        for split_cause in limits.chain(pairs.map(SplitCause::Pair)) {
            for share in SHARES {
                if best.is_some_and(|(_, most)| share <= most) {
                    continue;
                }
                if !self.closes(placing, enclosure, split_cause, share) {
                    break;
                }
                best = Some((split_cause, share));
            }
        }
        best
    }

    /// Gain of a split for a constraint and its share.
    pub(super) fn split_gain(
        &self,
        placing: &mut CellPlacement,
        tips: &PoseSet,
        cell: &IkCell,
        split_cause: SplitCause,
        share: f64,
    ) -> SplitGain {
        let none = IkCell { half: [0.0; 3], ..*cell };
        let still = PoseSet::new(tips.map_from_tip, DisplacementBound::none());
        let mut split_gain = SplitGain {
            split_cause,
            share,
            cell: [0.0; 3],
            patch: self.off(placing, tips, &none, split_cause),
            splits: 0,
        };
        for ((slot, half), at) in split_gain.cell.iter_mut().zip(cell.half).zip(0..) {
            if half > 0.0 {
                let only = std::array::from_fn(|other: usize| if other == at { half } else { 0.0 });
                *slot = self.off(placing, &still, &IkCell { half: only, ..*cell }, split_cause);
            }
        }
        split_gain
    }

    /// Drift of a constraint in a cell; 0 where it is unknown, so that nothing is split for it.
    fn off(
        &self,
        placing: &mut CellPlacement,
        tips: &PoseSet,
        cell: &IkCell,
        split_cause: SplitCause,
    ) -> f64 {
        let IntervalSolution::Enclosed(enclosure) = self.family.over(&tips.any(), cell) else { return 0.0 };
        match split_cause {
            SplitCause::Joint(at) => enclosure.values.get(at).map_or(0.0, |[_, off]| *off),
            SplitCause::Short => enclosure.short[1],
            SplitCause::Pair(pair) => {
                self.place(&enclosure, placing);
                self.off_by(placing, pair)
            }
        }
    }
}
