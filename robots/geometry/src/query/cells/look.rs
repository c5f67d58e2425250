//! The look at one patch after the other, and at the cells of each.

use std::rc::Rc;

use nalgebra::Isometry3;

use super::cover::{Cover, Group, Pair, Placing};
use super::culprit::{Blame, Culprit, TRUSTED};
use super::tie::Tied;
use super::{Family, Node, Open};
use crate::inverse::interval::{CellEnclosure, DisplacementBound, IkCell, IntervalSolution, PoseSet};
use crate::query::grasp::Hold;
use crate::query::grip::{Grips, Patch, widest};
use crate::query::state::State;

/// Poses of the tip are looked at together where none is farther than this from the middle, in m, about.
const COARSE: f64 = 0.6;
/// Patches in which the hand alone is looked at are cut no smaller, in m, about.
const FINE: f64 = 0.03;
/// Cells are cut no smaller than so many times a patch before that is cut, where nothing is known to be to blame.
const WIDER: f64 = 2.0;
/// So much smaller than the largest side of a cell another one may be cut because it is to blame.
const SLIM: f64 = 8.0;
/// Below this a cell is looked at for a free state, in m that something goes in it.
const SMALL: f64 = 0.05;
/// So many pairs that touched lately are looked at before all others.
const KNOWN: usize = 8;
/// Below this a cell is given up.
const LEAST: f64 = 5e-4;

/// What is known of a patch.
pub(super) enum Looked {
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
pub(super) struct Look<'c, 'a, 'r, 'w> {
    cover: Cover<'a, 'r, 'w>,
    grips: &'c Grips<'c>,
    /// So many may be looked at.
    cells: usize,
    known: Known,
    placing: Placing,
    /// To look at something else in between.
    aside: Placing,
}

impl<'c, 'a, 'r, 'w> Look<'c, 'a, 'r, 'w> {
    pub(super) fn new(cover: Cover<'a, 'r, 'w>, grips: &'c Grips<'c>, cells: usize) -> Self {
        let (placing, aside) = (Placing::default(), Placing::default());
        Self { cover, grips, cells, known: Known::default(), placing, aside }
    }

    /// Whether the hand alone touches something wherever it may be, told without a look at small patches.
    pub(super) fn is_hand_stuck(&mut self, groups: &Rc<[Group]>) -> bool {
        let patches = self.grips.patches().into_iter();
        let mut open: Vec<(Patch, Rc<[Group]>)> = patches.map(|patch| (patch, Rc::clone(groups))).collect();
        while let Some((patch, groups)) = open.pop() {
            let Some((map_from_tip, drift)) = self.grips.over(&patch) else { continue };
            self.cover.place_hand(&PoseSet::new(map_from_tip, drift), &mut self.placing);
            let Some(groups) = self.left_of(&groups) else { continue };
            let (size, across) = self.grips.widest(&patch);
            if size < FINE || self.is_spent() {
                return false;
            }
            open.extend(patch.halves(across).map(|patch| (patch, Rc::clone(&groups))));
        }
        true
    }

    /// What is known of a patch.
    pub(super) fn halves(&mut self, Open { patch, hand, nodes }: Open) -> Looked {
        if self.is_spent() {
            return Looked::Unclear;
        }
        let Some((map_from_tip, drift)) = self.grips.over(&patch) else { return Looked::Done };
        let tips = PoseSet::new(map_from_tip, drift);
        let (size, across) = self.grips.widest(&patch);
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
        if known.any(|pair| cover.touches(placing, pair, 1.0)) {
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
        let tips = PoseSet::new(hold.map_from_tip, DisplacementBound::none());
        self.cover.place_hand(&tips, &mut self.placing);
        !self.cover.is_stuck_in_middle(&mut self.placing, groups)
    }

    /// What is left of some cells: the parts, no larger than the tips are far from each other, of which it is not known that no state is
    /// free.
    fn left(&mut self, tips: &PoseSet, hold: Option<&Hold>, enough: f64, all: &[Node]) -> Left {
        let mut open: Vec<(Node, Option<Blame>)> = all.iter().map(|node| (node.clone(), None)).collect();
        let mut left = Vec::new();
        while let Some((node, blame)) = open.pop() {
            if self.is_spent() {
                return Left::Unclear;
            }
            match self.seen(tips, hold, enough, node, blame) {
                Seen::Closed => {}
                Seen::Free(state) => return Left::Free(state),
                Seen::Unclear => return Left::Unclear,
                Seen::Open(node, blame) => match self.across(&node.cell, blame.as_ref(), enough) {
                    Some(across) => {
                        let blame = blame.map(|blame| blame.halved(across));
                        open.extend(node.halves(across).map(|half| (half, blame)));
                    }
                    None => left.push(node),
                },
            }
        }
        Left::Nodes(left)
    }

    /// What is known of a cell, with what was to blame for it before.
    fn seen(
        &mut self,
        tips: &PoseSet,
        hold: Option<&Hold>,
        enough: f64,
        Node { cell, groups, ties }: Node,
        blame: Option<Blame>,
    ) -> Seen {
        let enclosure = match self.cover.family.over(tips, &cell) {
            IntervalSolution::Empty => return Seen::Closed,
            IntervalSolution::Unknown => return Seen::Unclear,
            IntervalSolution::Enclosed(enclosure) => enclosure,
        };
        self.cover.place(&enclosure, &mut self.placing);
        // What will close its parts soon needs no look at anything else.
        if let Some(blame) = blame
            && self.cover.closes(&mut self.placing, &enclosure, blame.culprit, TRUSTED)
        {
            return match blame.culprit {
                Culprit::Pair(pair) if self.cover.touches(&mut self.placing, pair, 1.0) => Seen::Closed,
                // Of joints and the arm's length all is told already, with what rounding may take.
                Culprit::Pair(_) | Culprit::Joint(_) | Culprit::Short => {
                    Seen::Open(Node { cell, groups, ties }, Some(blame))
                }
            };
        }
        let Some(groups) = self.left_of(&groups) else { return Seen::Closed };
        let Some(ties) = self.tied(&ties) else { return Seen::Closed };
        let (size, _) = widest(&self.sizes(&cell));
        if size.max(enough) < SMALL
            && let Some(hold) = hold
            && !self.cover.is_stuck_in_middle(&mut self.placing, &groups)
            && !self.cover.is_folded_in_middle(&mut self.placing, &ties)
            && let Some(state) = self.free_in(&hold.map_from_tip, &enclosure, &cell)
        {
            return Seen::Free(state);
        }
        let Self { cover, placing, aside, .. } = self;
        let known = blame.filter(|blame| cover.closes(placing, &enclosure, blame.culprit, blame.share));
        let blame = known.or_else(|| {
            let (culprit, share) = cover.culprit(placing, &enclosure, &groups, &ties)?;
            Some(cover.blame(aside, tips, &cell, culprit, share))
        });
        Seen::Open(Node { cell, groups, ties }, blame)
    }

    /// Across which parameter a cell is to be cut; nothing where the patch is.
    fn across(&self, cell: &IkCell, blame: Option<&Blame>, enough: f64) -> Option<usize> {
        let sizes = self.sizes(cell);
        let (size, wide) = widest(&sizes);
        let Some(blame) = blame.filter(|blame| blame.tells()) else {
            return (size >= enough.max(LEAST)).then_some(wide);
        };
        let (off, across) = widest(&blame.cell);
        if off < blame.patch {
            // Nor is a cell so much larger than its patch that others could be to blame.
            return (size >= (SLIM * enough).max(LEAST)).then_some(wide);
        }
        match sizes.get(across) {
            Some(own) if own * SLIM >= size => (size >= LEAST).then_some(across),
            Some(_) | None => (size >= enough.max(LEAST)).then_some(wide),
        }
    }

    /// How far something goes for the half of each side of a cell, about, in m.
    fn sizes(&self, cell: &IkCell) -> [f64; 3] {
        let weights = self.cover.family.weights();
        std::array::from_fn(|at: usize| {
            weights.get(at).zip(cell.half.get(at)).map_or(0.0, |(weight, half)| weight * half)
        })
    }

    /// A free state in the middle of a cell, or with the base there.
    fn free_in(&self, tip: &Isometry3<f64>, enclosure: &CellEnclosure, cell: &IkCell) -> Option<State> {
        let Cover { around, hand, family, allowed, .. } = &self.cover;
        let room = around.room;
        let states: Vec<_> = match family {
            Family::Lift(arm) => {
                let [yaw, shoulder, _] = cell.middle;
                let placed = arm.solve(tip, yaw, shoulder).into_iter();
                placed.map(|placed| room.with(hand, placed.base, &placed.values)).collect()
            }
            Family::Parallel(arm, _) => {
                let found = arm.solve(&(room.map_from_base(enclosure.base).inverse() * tip)).into_iter();
                found.map(|values| room.with(hand, enclosure.base, &values)).collect()
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

/// What is known of a cell.
enum Seen {
    /// No state is free.
    Closed,
    /// One is.
    Free(State),
    /// It cannot be told.
    Unclear,
    /// Not as much, with what may touch, and what is to blame for that, if something is.
    Open(Node, Option<Blame>),
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
