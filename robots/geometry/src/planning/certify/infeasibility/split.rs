//! What is nearest to closing a cell, and by which of its parameters that is kept from doing so: across that one it is cut. A hand that is turned
//! beyond its wrist is so whatever the base's yaw, so that this needs no cutting.
//!
//! Near to it is what would close the cell if all went by a share only of how far it may go: half of it is one cut away. What is nowhere near
//! that is no culprit, since at the edge of where it touches no cell is small enough.

use super::cover::{BodyPair, CellModel, CellPlacement, ContactGroup};
use super::relative::PairGroup;
use crate::inverse::interval::{CellEnclosure, DisplacementBound, IkCell, IntervalSolution, PoseSet};

/// The shares by which all may go for a culprit to be one, the farthest from closing a cell first.
const SHARES: [f64; 4] = [0.0625, 0.125, 0.25, 0.5];
/// By this share nothing else is looked at until the culprit has closed the cell, or has not.
pub(super) const TRUSTED: f64 = 0.25;
/// Less than this is rounding, in rad or m, for what is beyond a limit.
const BEYOND: f64 = 1e-4;
/// Below this a culprit is not off at all, in rad or m.
const STILL: f64 = 1e-3;

/// What is so in the middle of a cell and would close it if it were so throughout.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum SplitCause {
    /// A variable of the arm is beyond its limits, by its index.
    Joint(usize),
    /// The arm is too short.
    Short,
    /// Two touch.
    BodyPair(BodyPair),
}

/// What keeps a culprit from closing a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct SplitGain {
    pub(super) split_cause: SplitCause,
    /// By which it closes the cell.
    pub(super) share: f64,
    /// How far it can be off by each parameter of the cell alone, in rad or m.
    pub(super) cell: [f64; 3],
    /// The same by the patch alone.
    pub(super) patch: f64,
}

impl SplitGain {
    /// Whether something is to blame at all.
    pub(super) fn tells(&self) -> bool {
        self.cell.iter().fold(self.patch, |most, off| most.max(*off)) > STILL
    }

    /// The same in a half of the cell.
    pub(super) fn halved(mut self, across: usize) -> Self {
        self.cell.get_mut(across).into_iter().for_each(|off| *off *= 0.5);
        self
    }
}

impl CellModel<'_, '_, '_> {
    /// Whether a culprit would close a cell in which all goes by no more than a share of how far it may go. Of joints and the arm's length that
    /// is about so, and no proof.
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
            SplitCause::BodyPair(pair) => self.touches(placing, pair, share),
        }
    }

    /// What is nearest to closing a cell, and by which share of how far all may go it does.
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
        for split_cause in limits.chain(pairs.map(SplitCause::BodyPair)) {
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

    /// What keeps a culprit from closing a cell, with the share by which it does.
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
        };
        for ((slot, half), at) in split_gain.cell.iter_mut().zip(cell.half).zip(0..) {
            if half > 0.0 {
                let only = std::array::from_fn(|other: usize| if other == at { half } else { 0.0 });
                *slot = self.off(placing, &still, &IkCell { half: only, ..*cell }, split_cause);
            }
        }
        split_gain
    }

    /// How far a culprit can be off in a cell, whatever the limits of joints; 0 where that is not known, so that nothing is cut for it.
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
            SplitCause::BodyPair(pair) => {
                self.place(&enclosure, placing);
                self.off_by(placing, pair)
            }
        }
    }
}
