//! Infeasibility certificate: proves that no collision-free grasp configuration exists, by branch and bound
//! over grasps (patches of the grasp manifold) and solutions of the arm (cells).
//!
//! A cell is closed where a joint is beyond its limits throughout, or two solids are in contact throughout.
//! The latter holds where they are in contact in its middle, each deflated by its drift: let one solid's
//! points move at most `d` and the other's at most `e`; if a point is so deep within both that the depths
//! add up to `d + e`, the balls of these depths around it still meet after the motion. The padding is the
//! one of all checks: the clearance, or [`MIN_CLEARANCE`] between parts and where the hand may come near.
//!
//! An undecided cell is split along the parameter that contributes most to keeping the nearly closing
//! constraint open (`split`), or that moves the robot most; where that is the patch, the patch is split, and
//! its remaining cells are searched for each half (`search`). A free configuration is handed to the caller.
//! The search ends where nothing is open, or where the budget of cells is spent. Bodies that are far from a
//! part in a cell are not checked in its halves, and the pairs that closed recent cells come first.
//!
//! Beside an obstacle the bound is directional (`bound_obstacle`); between two parts of the robot it counts
//! only the joints between them (`bound_pair`, `relative`). Related: Basch 2001; Li and Dantam 2023.

mod bound_obstacle;
mod bound_pair;
mod cover;
mod relative;
mod search;
mod split;

use std::collections::VecDeque;
use std::ops::ControlFlow;
use std::rc::Rc;

use crate::planning::checking::CollisionChecker;
use crate::planning::grasp::{GraspCandidate, GraspManifold};
use crate::planning::scene::{AllowedCollisions, Configuration, HandModel};
use cover::CellModel;
use search::{BranchAndBound, CellNode, OpenPatch, PatchOutcome};

/// Verdict of a certificate.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Certificate {
    /// No configuration is free, for certain.
    Nowhere,
    /// Free configurations exist; they were handed over.
    Somewhere,
    Open,
}

impl CollisionChecker<'_, '_> {
    /// Covers all grasps of a manifold with up to `cells` cells. Each free configuration is handed to
    /// `is_enough` with its grasp, which ends the search or lets it go on where least is known.
    pub(crate) fn covered(
        &self,
        hand: &HandModel,
        manifold: &GraspManifold<'_>,
        allowed: AllowedCollisions,
        cells: usize,
        mut is_enough: impl FnMut(&GraspCandidate, Configuration) -> ControlFlow<()>,
    ) -> Certificate {
        let Some(cover) = CellModel::new(self, hand, allowed) else { return Certificate::Open };
        let ([of_hand, others], pair_groups) = (cover.groups(), cover.pair_groups());
        let root = |cell| {
            let (groups, pair_groups) = (Rc::clone(&others), Rc::clone(&pair_groups));
            CellNode { cell, groups, pair_groups, split_gain: None }
        };
        let roots: Rc<[CellNode]> = cover.family.cells().into_iter().map(root).collect();
        let patches = manifold.patches().into_iter();
        let open =
            patches.map(|patch| OpenPatch { patch, hand: Rc::clone(&of_hand), nodes: Rc::clone(&roots) });
        let mut open: VecDeque<OpenPatch> = open.collect();
        if roots.is_empty() || open.is_empty() {
            return Certificate::Open;
        }
        let mut look = BranchAndBound::new(cover, manifold, cells);
        let mut covered = Certificate::Nowhere;
        if look.is_hand_stuck(&of_hand) {
            return covered;
        }
        while let Some(next) = open.pop_back() {
            match look.halves(next) {
                PatchOutcome::Done => {}
                PatchOutcome::Halves(halves) => open.extend(halves),
                PatchOutcome::Unclear => return covered.or_open(),
                PatchOutcome::Free(hold, configuration) => {
                    covered = Certificate::Somewhere;
                    if is_enough(&hold, configuration).is_break() {
                        return covered;
                    }
                    // Its neighbours would be much the same.
                    open.rotate_left(1.min(open.len()));
                }
            }
        }
        covered
    }
}

impl Certificate {
    fn or_open(self) -> Self {
        if self == Self::Nowhere { Self::Open } else { self }
    }
}

#[cfg(test)]
#[allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::disallowed_methods,
    reason = "a test fails by panicking"
)]
mod tests;
