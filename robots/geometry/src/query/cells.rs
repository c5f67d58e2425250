//! That no state of the robot in which its hand holds a thing is free, proven: all ways to grip the thing are covered by patches, and
//! for each the family of all solutions of the arm by cells, and in each a joint is beyond its limits throughout, or two solids
//! touch throughout.
//!
//! Two solids touch in all of a cell where they do in its middle, each smaller by as much as it can be off. Let a point
//! of the one go no farther than `d` and one of the other no farther than `e`. If a point is so deep within both that the depths add
//! up to `d + e`, then the balls of these depths around it, which go along with their solids, still meet. What counts as a
//! touch is what does for a state of a way, [`GAP`] between everything.
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

use super::around::Around;
use super::grasp::Hold;
use super::grip::{Grips, Patch};
use super::machine::Hand;
use super::state::State;
use super::touch::Allowed;
use crate::inverse::interval::{IkCell, IntervalSolution, PoseSet};
use crate::inverse::{LiftArm, ParallelArm, SevenArm};

use cover::{Cover, Group};
use look::{Look, Looked};
use tie::Tied;

mod board;
mod cover;
mod culprit;
mod joined;
mod look;
mod tie;

/// An arm whose solutions have cells.
#[derive(Clone, Copy)]
enum Family<'a> {
    Lift(&'a LiftArm),
    /// With the height of the base's link above the floor.
    Parallel(&'a ParallelArm, f64),
    /// With where the base's link is, and the base.
    Seven(&'a SevenArm, Isometry3<f64>, [f64; 3]),
    /// None that is known: nothing is told but of the hand alone.
    Any,
}

impl Family<'_> {
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
pub(super) enum Covered {
    /// None is free, for certain.
    Nowhere,
    /// Some are, which were handed over.
    Somewhere,
    /// Not as much.
    Open,
}

/// A cell, and what may touch in it.
#[derive(Clone)]
struct Node {
    cell: IkCell,
    groups: Rc<[Group]>,
    ties: Rc<[Tied]>,
}

impl Node {
    /// Its halves, cut across a parameter.
    fn halves(&self, across: usize) -> [Self; 2] {
        self.cell.halves(across).map(|cell| Self { cell, ..self.clone() })
    }
}

/// A patch, what the hand may touch in it, and what of its cells is left to look at.
struct Open {
    patch: Patch,
    hand: Rc<[Group]>,
    nodes: Rc<[Node]>,
}

impl Around<'_, '_> {
    /// What cells tell of the states in which a hand grips a thing in any way there is, at most so many cells. A free state that is
    /// found is handed over, with how the thing is held in it: it ends there, or goes on where the least is known.
    pub(super) fn covered(
        &self,
        hand: &Hand,
        grips: &Grips<'_>,
        allowed: Allowed,
        cells: usize,
        mut is_enough: impl FnMut(&Hold, State) -> ControlFlow<()>,
    ) -> Covered {
        let Some(cover) = Cover::new(self, hand, allowed) else { return Covered::Open };
        let ([of_hand, others], ties) = (cover.groups(), cover.ties());
        let root = |cell| Node { cell, groups: Rc::clone(&others), ties: Rc::clone(&ties) };
        let roots: Rc<[Node]> = cover.family.cells().into_iter().map(root).collect();
        let patches = grips.patches().into_iter();
        let open = patches.map(|patch| Open { patch, hand: Rc::clone(&of_hand), nodes: Rc::clone(&roots) });
        let mut open: VecDeque<Open> = open.collect();
        if roots.is_empty() || open.is_empty() {
            return Covered::Open;
        }
        let mut look = Look::new(cover, grips, cells);
        let mut covered = Covered::Nowhere;
        if look.is_hand_stuck(&of_hand) {
            return covered;
        }
        while let Some(next) = open.pop_back() {
            match look.halves(next) {
                Looked::Done => {}
                Looked::Halves(halves) => open.extend(halves),
                Looked::Unclear => return covered.or_open(),
                Looked::Free(hold, state) => {
                    covered = Covered::Somewhere;
                    if is_enough(&hold, state).is_break() {
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

impl Covered {
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
