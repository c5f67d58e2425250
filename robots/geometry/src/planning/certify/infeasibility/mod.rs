//! That no state of the robot in which its hand holds a thing is free, proven: all ways to grip the thing are covered by patches, and
//! for each the family of all solutions of the arm by cells, and in each a joint is beyond its limits throughout, or two solids
//! touch throughout.
//!
//! Two solids touch in all of a cell where they do in its middle, each smaller by as much as it can be off. Let a point
//! of the one go no farther than `d` and one of the other no farther than `e`. If a point is so deep within both that the depths add
//! up to `d + e`, then the balls of these depths around it, which go along with their solids, still meet. What counts as a
//! touch is what does for a state of a way, [`MIN_CLEARANCE`] between everything.
//!
//! A cell of which that is not known is cut across the parameter that keeps what is nearest to closing it from doing so (`culprit`), or for which
//! most moves; where that is the patch, this is cut, and what is left of its cells is looked at for each half (`look`). A free state that is met is
//! handed over. It ends where nothing is left, or where as many cells as were allowed have been looked at. What is not near a part of the robot
//! in a cell is not in its halves, and not looked at there; and what touched lately is looked at first.
//!
//! That is so of any two. Of a part beside a thing more is known by which way it goes (`board`), and of two parts of the robot by the joints
//! between them (`joined`, `tie`).

use std::collections::VecDeque;
use std::ops::ControlFlow;
use std::rc::Rc;

use nalgebra::Isometry3;

use crate::inverse::interval::{IkCell, IntervalSolution, PoseSet};
use crate::inverse::{LiftArm, ParallelArm, SevenArm};
use crate::planning::checking::collision_checker::CollisionChecker;
use crate::planning::grasp::candidates::GraspCandidate;
use crate::planning::grasp::manifold::{GraspManifold, GraspPatch};
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::AllowedCollisions;
use crate::planning::scene::robot_model::HandModel;

use cover::{CellModel, ContactGroup};
use relative::PairGroup;
use search::{BranchAndBound, PatchOutcome};

mod bound_obstacle;
mod bound_pair;
mod cover;
mod relative;
mod search;
mod split;

/// An arm whose solutions have cells.
#[derive(Clone, Copy)]
enum ArmFamily<'a> {
    Lift(&'a LiftArm),
    /// With the height of the base's link above the floor.
    Parallel(&'a ParallelArm, f64),
    /// With where the base's link is, and the base.
    Seven(&'a SevenArm, Isometry3<f64>, [f64; 3]),
    /// None that is known: nothing is told but of the hand alone.
    Any,
}

impl ArmFamily<'_> {
    fn cells(self) -> Vec<IkCell> {
        match self {
            Self::Lift(arm) => arm.cells(),
            Self::Parallel(arm, _) => arm.cells(),
            Self::Seven(arm, ..) => arm.cells(),
            Self::Any => vec![IkCell { branch: 0, middle: [0.0; 3], half: [0.0; 3] }],
        }
    }

    fn weights(self) -> [f64; 3] {
        match self {
            Self::Lift(arm) => arm.weights(),
            Self::Parallel(arm, _) => arm.weights(),
            Self::Seven(arm, ..) => arm.weights(),
            Self::Any => [0.0; 3],
        }
    }

    fn over(self, tips: &PoseSet, cell: &IkCell) -> IntervalSolution {
        match self {
            Self::Lift(arm) => arm.enclose(tips, cell),
            Self::Parallel(arm, height) => arm.enclose(tips, height, cell),
            Self::Seven(arm, map_from_base, base) => arm.enclose(tips, &map_from_base, base, cell),
            Self::Any => IntervalSolution::Unknown,
        }
    }
}

/// What is known of all states in which a hand holds a thing.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Certificate {
    /// None is free, for certain.
    Nowhere,
    /// Some are, which were handed over.
    Somewhere,
    /// Not as much.
    Open,
}

/// A cell, and what may touch in it.
#[derive(Clone)]
struct CellNode {
    cell: IkCell,
    groups: Rc<[ContactGroup]>,
    pair_groups: Rc<[PairGroup]>,
}

impl CellNode {
    /// Its halves, cut across a parameter.
    fn halves(&self, across: usize) -> [Self; 2] {
        self.cell.halves(across).map(|cell| Self { cell, ..self.clone() })
    }
}

/// A patch, what the hand may touch in it, and what of its cells is left to look at.
struct OpenPatch {
    patch: GraspPatch,
    hand: Rc<[ContactGroup]>,
    nodes: Rc<[CellNode]>,
}

impl CollisionChecker<'_, '_> {
    /// What cells tell of the states in which a hand grips a thing in any way there is, at most so many cells. A free state that is
    /// found is handed over, with how the thing is held in it: it ends there, or goes on where the least is known.
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
        let root = |cell| CellNode { cell, groups: Rc::clone(&others), pair_groups: Rc::clone(&pair_groups) };
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
                    // Beside it the next would be much the same.
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
