//! That no state of the robot in which its hand holds a thing is free, proven: all ways to grip the thing are covered by patches, and
//! for each the family of all solutions of the arm by cells, and in each a joint is beyond its limits throughout, or two solids
//! touch throughout.
//!
//! Two solids touch in all of a cell where they do in its middle, each smaller by as much as it can be off. Let a point
//! of the one go no farther than `d` and one of the other no farther than `e`. If a point is so deep within both that the depths add
//! up to `d + e`, then the balls of these depths around it, which go along with their solids, still meet. What counts as a
//! touch is what does for a state of a way, [`GAP`] between everything.
//!
//! A cell of which that is not known is cut across the parameter for which most moves, until it is about as small as the patch; then the patch
//! is cut, and what is left of its cells is looked at for each half. A free state that is met is handed over. It ends where nothing is left,
//! or where as many cells as were allowed have been looked at. What is not near a part of the robot in a cell is not in its halves, and
//! not looked at there; and what touched lately is looked at first.
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
use crate::inverse::family::{Cell, Drift, Over, Stretch, Tips};
use crate::inverse::{LiftArm, ParallelArm, SevenArm};

use cover::{Cover, Group, Pair, Placing};
use tie::Tied;

mod board;
mod cover;
mod joined;
mod tie;

/// Poses of the tip are looked at together where none is farther than this from the middle, in m, about.
const COARSE: f64 = 0.1;
/// Cells are cut no smaller than so many times a patch before that is cut.
const WIDER: f64 = 2.0;
/// Below this a cell is looked at for a free state, in m that something goes in it.
const SMALL: f64 = 0.05;
/// So many pairs that touched lately are looked at before all others.
const KNOWN: usize = 8;
/// Below this a cell is given up.
const LEAST: f64 = 5e-4;

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
    fn cells(self) -> Vec<Cell> {
        match self {
            Self::Lift(arm) => arm.cells(),
            Self::Parallel(arm, _) => arm.cells(),
            Self::Seven(arm, ..) => arm.cells(),
            Self::Any => vec![Cell { way: 0, middle: [0.0; 3], half: [0.0; 3] }],
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

    fn over(self, tips: &Tips, cell: &Cell) -> Over {
        match self {
            Self::Lift(arm) => arm.over(tips, cell),
            Self::Parallel(arm, height) => arm.over(tips, height, cell),
            Self::Seven(arm, map_from_base, base) => arm.over(tips, &map_from_base, base, cell),
            Self::Any => Over::Unclear,
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
    cell: Cell,
    groups: Rc<[Group]>,
    ties: Rc<[Tied]>,
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
        let mut look = Look { cover, grips, cells, known: Known::default(), placing: Placing::default() };
        let mut covered = Covered::Nowhere;
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

/// What is known of a patch.
enum Looked {
    /// No state is free.
    Done,
    /// Not as much of its halves.
    Halves([Open; 2]),
    /// One is.
    Free(Box<Hold>, State),
    /// It cannot be told, or the budget is spent.
    Unclear,
}

/// A look at patches and cells.
struct Look<'c, 'a, 'r, 'w> {
    cover: Cover<'a, 'r, 'w>,
    grips: &'c Grips<'c>,
    /// So many may be looked at.
    cells: usize,
    known: Known,
    placing: Placing,
}

impl Look<'_, '_, '_, '_> {
    fn halves(&mut self, Open { patch, hand, nodes }: Open) -> Looked {
        if self.is_spent() {
            return Looked::Unclear;
        }
        let Some((map_from_tip, drift)) = self.grips.over(&patch) else { return Looked::Done };
        let tips = Tips { map_from_tip, drift };
        let (size, across) = widest(&self.grips.sizes(&patch));
        self.cover.place_hand(&tips, &mut self.placing);
        let Some(hand) = self.left_of(&hand) else { return Looked::Done };
        let nodes = if size > COARSE {
            nodes
        } else {
            let hold = self.grips.hold(&patch).filter(|hold| self.is_hand_free(hold, &hand));
            match (self.cover.family, &hold) {
                (Family::Any, Some(_)) => return Looked::Unclear,
                // In a smaller patch it may touch throughout.
                (Family::Any, None) => nodes,
                (Family::Lift(_) | Family::Parallel(..) | Family::Seven(..), _) => {
                    match self.left(&tips, hold.as_ref(), WIDER * size, &nodes) {
                        Left::Nodes(left) if left.is_empty() => return Looked::Done,
                        Left::Nodes(left) => left.into(),
                        Left::Free(state) => match hold {
                            Some(hold) => return Looked::Free(Box::new(hold), state),
                            None => return Looked::Unclear,
                        },
                        Left::Unclear => return Looked::Unclear,
                    }
                }
            }
        };
        if size < LEAST {
            return Looked::Unclear;
        }
        Looked::Halves(patch.halves(across).map(|patch| Open {
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

    /// What of some groups may touch; `None` where something does throughout.
    fn left_of(&mut self, groups: &Rc<[Group]>) -> Option<Rc<[Group]>> {
        let Self { cover, known, placing, .. } = self;
        if known.any(|pair| cover.touches(placing, pair)) {
            return None;
        }
        fewer(groups, known, |group| cover.left_of(placing, group))
    }

    /// The same of the robot's parts.
    fn tied(&mut self, ties: &Rc<[Tied]>) -> Option<Rc<[Tied]>> {
        let Self { cover, known, placing, .. } = self;
        fewer(ties, known, |tied| cover.tied(placing, tied))
    }

    /// Whether the hand alone is free, of what it may touch.
    fn is_hand_free(&mut self, hold: &Hold, groups: &[Group]) -> bool {
        let tips = Tips { map_from_tip: hold.map_from_tip, drift: Drift::none() };
        self.cover.place_hand(&tips, &mut self.placing);
        !self.cover.is_stuck_in_middle(&mut self.placing, groups)
    }

    /// What is left of some cells: the parts, no larger than the tips are far from each other, of which it is not known that no state is
    /// free.
    fn left(&mut self, tips: &Tips, hold: Option<&Hold>, enough: f64, all: &[Node]) -> Left {
        let weights = self.cover.family.weights();
        let mut open: Vec<Node> = all.to_vec();
        let mut left = Vec::new();
        while let Some(Node { cell, groups, ties }) = open.pop() {
            if self.is_spent() {
                return Left::Unclear;
            }
            let stretch = match self.cover.family.over(tips, &cell) {
                Over::Nothing => continue,
                Over::Unclear => return Left::Unclear,
                Over::Near(stretch) => stretch,
            };
            self.cover.place(&stretch, &mut self.placing);
            let Some(groups) = self.left_of(&groups) else { continue };
            let Some(ties) = self.tied(&ties) else { continue };
            let sizes: [f64; 3] = std::array::from_fn(|at: usize| {
                weights.get(at).zip(cell.half.get(at)).map_or(0.0, |(weight, half)| weight * half)
            });
            let (size, across) = widest(&sizes);
            if size.max(enough) < SMALL
                && let Some(hold) = hold
                && !self.cover.is_stuck_in_middle(&mut self.placing, &groups)
                && !self.cover.is_folded_in_middle(&mut self.placing, &ties)
                && let Some(state) = self.free_in(&hold.map_from_tip, &stretch, &cell)
            {
                return Left::Free(state);
            }
            if size < enough.max(LEAST) {
                left.push(Node { cell, groups, ties });
            } else {
                let halves = cell.halves(across);
                let (groups, ties) = (&groups, &ties);
                open.extend(halves.map(|cell| Node {
                    cell,
                    groups: Rc::clone(groups),
                    ties: Rc::clone(ties),
                }));
            }
        }
        Left::Nodes(left)
    }

    /// A free state in the middle of a cell, or with the base there.
    fn free_in(&self, tip: &Isometry3<f64>, stretch: &Stretch, cell: &Cell) -> Option<State> {
        let Cover { around, hand, family, allowed, .. } = &self.cover;
        let room = around.room;
        let states: Vec<_> = match family {
            Family::Lift(arm) => {
                let [yaw, shoulder, _] = cell.middle;
                let placed = arm.solve(tip, yaw, shoulder).into_iter();
                placed.map(|placed| room.with(hand, placed.base, &placed.values)).collect()
            }
            Family::Parallel(arm, _) => {
                let found = arm.solve(&(room.map_from_base(stretch.base).inverse() * tip)).into_iter();
                found.map(|values| room.with(hand, stretch.base, &values)).collect()
            }
            Family::Seven(arm, map_from_base, base) => {
                let [last, ..] = cell.middle;
                let found = arm.solve(&(map_from_base.inverse() * tip), last).into_iter();
                found.map(|values| room.with(hand, *base, &values)).collect()
            }
            Family::Any => vec![],
        };
        states.into_iter().find(|state| around.touch(state, *allowed).is_none())
    }
}

/// What is left of cells.
enum Left {
    Nodes(Vec<Node>),
    Free(State),
    Unclear,
}

/// What is left of each of some; `None`, with what it is noted, where something touches throughout.
fn fewer<T: Clone>(
    all: &Rc<[T]>,
    known: &mut Known,
    mut left_of: impl FnMut(&T) -> Result<Option<T>, Pair>,
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

/// The largest of some sizes, and which it is.
fn widest(sizes: &[f64]) -> (f64, usize) {
    let all = sizes.iter().copied().zip(0..);
    all.fold((0.0, 0), |most, next| if next.0 > most.0 { next } else { most })
}

/// Pairs that touched lately; those that did often stand at the end.
#[derive(Default)]
struct Known(Vec<Pair>);

impl Known {
    fn add(&mut self, pair: Pair) {
        if self.0.len() == KNOWN {
            self.0.remove(0);
        }
        self.0.push(pair);
    }

    /// Whether one of them is so.
    fn any(&mut self, mut is: impl FnMut(Pair) -> bool) -> bool {
        let Some(at) = self.0.iter().rposition(|pair| is(*pair)) else { return false };
        let next = (at + 1).min(self.0.len() - 1);
        self.0.swap(at, next);
        true
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
