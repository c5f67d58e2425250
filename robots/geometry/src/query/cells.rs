//! That no state of the robot in which its hand holds a thing is free, proven: all ways to grip the thing are covered by patches, and
//! for each the family of all solutions of the arm by cells, and in each a joint is beyond its limits throughout, or two solids
//! touch throughout.
//!
//! Two solids touch in all of a cell where they do in its middle, each smaller by as much as it can be off. Let a point
//! of the one go no farther than `d` and one of the other no farther than `e`. If a point is so deep within both that the depths add
//! up to `d + e`, then the balls of these depths around it, which go along with their solids, still meet. What counts as a
//! touch is what does for a state of a way, [`GAP`] between everything.
//!
//! A cell of which that is not known is cut across the parameter for which most moves, until it is as small as the patch; then the patch
//! is cut, and what is left of its cells is looked at for each half. It ends where one is free in a state
//! in it, or where as many cells as were allowed have been looked at.

use std::rc::Rc;

use nalgebra::Isometry3;

use super::around::Around;
use super::grip::{Grips, Patch};
use super::machine::Hand;
use super::room::GAP;
use super::shrunk::{Placed, SLACK, inner};
use super::solver::Solver;
use super::state::State;
use super::touch::Allowed;
use crate::collision::Solid;
use crate::inverse::family::{Cell, Drift, Over, Stretch, Tips};
use crate::inverse::{LiftArm, ParallelArm};
use crate::kinematics::Rig;

/// Poses of the tip are looked at together where none is farther than this from the middle, in m, about.
const COARSE: f64 = 0.1;
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
    /// None that is known: nothing is told but of the hand alone.
    Any,
}

impl Family<'_> {
    fn cells(self) -> Vec<Cell> {
        match self {
            Self::Lift(arm) => arm.cells(),
            Self::Parallel(arm, _) => arm.cells(),
            Self::Any => vec![Cell { way: 0, middle: [0.0; 3], half: [0.0; 3] }],
        }
    }

    fn weights(self) -> [f64; 3] {
        match self {
            Self::Lift(arm) => arm.weights(),
            Self::Parallel(arm, _) => arm.weights(),
            Self::Any => [0.0; 3],
        }
    }

    fn over(self, tips: &Tips, cell: &Cell) -> Over {
        match self {
            Self::Lift(arm) => arm.over(tips, cell),
            Self::Parallel(arm, height) => arm.over(tips, height, cell),
            Self::Any => Over::Unclear,
        }
    }
}

/// A part of the robot.
struct Limb {
    frame: usize,
    /// In the frame.
    solid: Solid,
    inner: f64,
    reach: f64,
}

/// What touches throughout a cell, and perhaps in the next as well.
#[derive(Clone, Copy)]
enum Culprit {
    Thing(usize, usize),
    Floor(usize),
    Own(usize, usize),
}

/// What is needed to look at cells.
struct Cover<'a, 'r, 'w> {
    around: &'a Around<'r, 'w>,
    hand: &'a Hand,
    family: Family<'a>,
    allowed: Allowed,
    rig: Rig,
    /// The robot's joints with the hand as it reaches.
    joints: Vec<f64>,
    /// The frames of the arm's joints among those of the rig.
    arm: Vec<usize>,
    limbs: Vec<Limb>,
    /// Pairs of limbs in different frames that may not touch.
    pairs: Vec<[usize; 2]>,
    /// Of the things the radius of the greatest ball within, about.
    things: Vec<f64>,
}

/// What is known of all states in which a hand holds a thing.
pub(super) enum Covered {
    /// None is free, for certain.
    Nowhere,
    /// One is: this.
    Free(State),
    /// Not as much.
    Open,
}

impl Around<'_, '_> {
    /// What cells tell of the states in which a hand grips a thing in any way there is, at most so many cells.
    pub(super) fn covered(
        &self,
        hand: &Hand,
        grips: &Grips<'_>,
        allowed: Allowed,
        mut cells: usize,
    ) -> Covered {
        let Some(cover) = Cover::new(self, hand, allowed) else { return Covered::Open };
        let roots: Rc<[Cell]> = cover.family.cells().into();
        let mut known = Known::default();
        let mut open: Vec<(Patch, Rc<[Cell]>)> =
            grips.patches().into_iter().map(|patch| (patch, Rc::clone(&roots))).collect();
        if roots.is_empty() || open.is_empty() {
            return Covered::Open;
        }
        while let Some((patch, left)) = open.pop() {
            let Some(fewer) = cells.checked_sub(1) else { return Covered::Open };
            cells = fewer;
            let Some((map_from_tip, drift)) = grips.over(&patch) else { continue };
            let tips = Tips { map_from_tip, drift };
            let sizes = grips.sizes(&patch);
            let (size, across) = widest(&sizes);
            if cover.is_hand_stuck(&tips, &mut known) {
                continue;
            }
            let is_hand_free = || {
                let middle = Tips { drift: Drift::none(), ..tips };
                !cover.is_hand_stuck(&middle, &mut Known::default())
            };
            let left = if size > COARSE {
                left
            } else if matches!(cover.family, Family::Any) && !is_hand_free() {
                // In a smaller patch it may touch throughout.
                left
            } else {
                match cover.left(&tips, size, &left, &mut known, &mut cells) {
                    Ok(left) if left.is_empty() => continue,
                    Ok(left) => left.into(),
                    Err(ended) => return ended,
                }
            };
            if size < LEAST {
                return Covered::Open;
            }
            open.extend(patch.halves(across).map(|half| (half, Rc::clone(&left))));
        }
        Covered::Nowhere
    }
}

/// The largest of some sizes, and which it is.
fn widest(sizes: &[f64]) -> (f64, usize) {
    let all = sizes.iter().copied().zip(0..);
    all.fold((0.0, 0), |most, next| if next.0 > most.0 { next } else { most })
}

/// Pairs that touched lately; those that did often stand at the end.
#[derive(Default)]
struct Known(Vec<Culprit>);

impl Known {
    fn add(&mut self, culprit: Culprit) {
        if self.0.len() == KNOWN {
            self.0.remove(0);
        }
        self.0.push(culprit);
    }

    /// Whether one of them is so.
    fn any(&mut self, is: impl Fn(Culprit) -> bool) -> bool {
        let Some(at) = self.0.iter().rposition(|culprit| is(*culprit)) else { return false };
        let next = (at + 1).min(self.0.len() - 1);
        self.0.swap(at, next);
        true
    }
}

impl<'a, 'r, 'w> Cover<'a, 'r, 'w> {
    /// `None` where the robot is not simple enough.
    fn new(around: &'a Around<'r, 'w>, hand: &'a Hand, allowed: Allowed) -> Option<Self> {
        let (room, machine) = (around.room, around.room.machine);
        let family = match &hand.solver {
            Solver::Lift(arm) => Family::Lift(arm),
            Solver::Parallel(arm) if machine.drives() => {
                Family::Parallel(arm, room.map_from_base([0.0; 3]).translation.z)
            }
            Solver::Parallel(_) | Solver::Seven(_) | Solver::Steps(_) => Family::Any,
        };
        let chain = hand.solver.chain();
        let joints = room.with(hand, [0.0; 3], &[]).joints;
        let rig = machine.tree().rig(&joints, |variable| chain.in_tree.contains(&variable))?;
        // From the tip down to the base.
        let (mut frame, _) = *rig.links.get(hand.tip)?;
        let mut arm = vec![];
        while let Some(joint) = frame.checked_sub(1).and_then(|at| rig.joints.get(at)) {
            arm.push(frame);
            frame = joint.parent;
        }
        arm.reverse();
        if arm.len() != chain.joints.len() {
            return None;
        }
        let mut limbs = Vec::new();
        for part in room.body.parts() {
            let (frame, pose) = rig.links.get(part.link)?;
            let solid = part.solid.moved(pose);
            limbs.push(Limb { frame: *frame, solid, inner: inner(&solid), reach: solid.reach() });
        }
        let frame = |part: usize| limbs.get(part).map(|limb| limb.frame);
        let moves = |[one, other]: &&[usize; 2]| frame(*one) != frame(*other);
        let pairs = room.body.pairs().iter().filter(moves).copied().collect();
        let things = around.things.iter().map(|near| inner(&near.solid)).collect();
        Some(Self { around, hand, family, allowed, rig, joints, arm, limbs, pairs, things })
    }

    /// Whether the hand alone touches something with its tip at any of some poses.
    fn is_hand_stuck(&self, tips: &Tips, known: &mut Known) -> bool {
        let last = self.arm.last().copied().unwrap_or_default();
        let tip_from_frame =
            self.rig.links.get(self.hand.tip).map(|(_, pose)| pose.inverse()).unwrap_or_default();
        let pose = tips.map_from_tip * tip_from_frame;
        let limbs = self.limbs.iter().map(|limb| {
            let is_own = limb.frame == last;
            let solid = if is_own { limb.solid.moved(&pose) } else { limb.solid };
            // What is elsewhere is not known to be anywhere.
            let drift = if is_own { tips.drift.of(&solid) } else { f64::INFINITY };
            Placed { solid, inner: limb.inner, reach: limb.reach, drift }
        });
        let placed: Vec<Placed> = limbs.collect();
        let is_own = |culprit: &Culprit| match culprit {
            Culprit::Thing(part, _) | Culprit::Floor(part) => {
                self.limbs.get(*part).is_some_and(|limb| limb.frame == last)
            }
            Culprit::Own(..) => false,
        };
        if known.any(|culprit| is_own(&culprit) && self.touches(&placed, culprit)) {
            return true;
        }
        let found = self.of_scene().filter(is_own).find(|culprit| self.touches(&placed, *culprit));
        found.into_iter().for_each(|culprit| known.add(culprit));
        found.is_some()
    }

    /// Of some cells those parts, no larger than the tips are far from each other, of which it is not known that no state is free; or what
    /// ends the search.
    fn left(
        &self,
        tips: &Tips,
        enough: f64,
        all: &[Cell],
        known: &mut Known,
        cells: &mut usize,
    ) -> Result<Vec<Cell>, Covered> {
        let weights = self.family.weights();
        let mut open: Vec<Cell> = all.to_vec();
        let mut left = Vec::new();
        while let Some(cell) = open.pop() {
            *cells = cells.checked_sub(1).ok_or(Covered::Open)?;
            let stretch = match self.family.over(tips, &cell) {
                Over::Nothing => continue,
                Over::Unclear => return Err(Covered::Open),
                Over::Near(stretch) => stretch,
            };
            let placed = self.placed(&stretch);
            if known.any(|culprit| self.touches(&placed, culprit)) {
                continue;
            }
            if let Some(found) = self.culprit(&placed) {
                known.add(found);
                continue;
            }
            let sizes: [f64; 3] = std::array::from_fn(|at: usize| {
                weights.get(at).zip(cell.half.get(at)).map_or(0.0, |(weight, half)| weight * half)
            });
            let (size, across) = widest(&sizes);
            if size.max(enough) < SMALL
                && let Some(state) = self.free_in(&tips.map_from_tip, &stretch, &cell)
            {
                return Err(Covered::Free(state));
            }
            if size < enough.max(LEAST) {
                left.push(cell);
            } else {
                open.extend(cell.halves(across));
            }
        }
        Ok(left)
    }

    /// The parts in the middle of a cell, and how far each can be from there.
    fn placed(&self, stretch: &Stretch) -> Vec<Placed> {
        let mut joints = self.joints.clone();
        let chain = self.hand.solver.chain();
        for (at, [value, _]) in chain.in_tree.iter().zip(&stretch.values) {
            joints.get_mut(*at).into_iter().for_each(|slot| *slot = *value);
        }
        let root = (self.around.room.machine.map_from_root(stretch.base), stretch.base_drift);
        let mut frames: Vec<(Isometry3<f64>, Drift)> = vec![root];
        for (joint, at) in self.rig.joints.iter().zip(1..) {
            let in_arm = self.arm.iter().position(|frame| *frame == at).and_then(|at| stretch.frames.get(at));
            let frame = in_arm.copied().unwrap_or_else(|| {
                // What follows a joint of the arm elsewhere.
                let (parent, drift) = frames.get(joint.parent).copied().unwrap_or(root);
                let off = chain.in_tree.iter().zip(&stretch.values);
                let off = off.filter(|(at, _)| **at == joint.driver.variable).map(|(_, [_, off])| *off);
                let off = off.sum::<f64>() * joint.driver.multiplier.abs();
                let pose = parent * joint.before * joint.motion(joint.driver.position(&joints));
                if joint.slides {
                    return (pose, drift.shifted(off));
                }
                (pose, if off == 0.0 { drift } else { Drift { shift: f64::INFINITY, ..drift } })
            });
            frames.push(frame);
        }
        let placed = self.limbs.iter().map(|limb| {
            let (pose, drift) = frames.get(limb.frame).copied().unwrap_or(root);
            let solid = limb.solid.moved(&pose);
            Placed { solid, inner: limb.inner, reach: limb.reach, drift: drift.of(&solid) }
        });
        placed.collect()
    }

    /// All that may not touch what stands around.
    fn of_scene(&self) -> impl Iterator<Item = Culprit> + '_ {
        let limbs = self.around.limbs.iter().zip(0..).filter(|(limb, _)| limb.counts);
        limbs.flat_map(move |(limb, part)| {
            let things = self.around.things.iter().zip(0..);
            let things = things.filter(|(near, _)| !limb.may_touch(near.entity, self.allowed));
            let things = things.map(move |(_, at)| Culprit::Thing(part, at));
            things.chain(limb.is_carried.then_some(Culprit::Floor(part)))
        })
    }

    /// What touches throughout.
    fn culprit(&self, placed: &[Placed]) -> Option<Culprit> {
        let own = self.pairs.iter().map(|[one, other]| Culprit::Own(*one, *other));
        self.of_scene().chain(own).find(|culprit| self.touches(placed, *culprit))
    }

    /// Whether a pair touches throughout.
    fn touches(&self, placed: &[Placed], culprit: Culprit) -> bool {
        match culprit {
            Culprit::Thing(part, at) => {
                let pair = placed.get(part).zip(self.around.things.get(at).zip(self.things.get(at)));
                pair.is_some_and(|(own, (near, inner))| {
                    own.touches(&near.solid, *inner, near.reach, own.drift)
                })
            }
            Culprit::Own(part, at) => placed.get(part).zip(placed.get(at)).is_some_and(|(own, other)| {
                own.touches(&other.solid, other.inner, other.reach, own.drift + other.drift)
            }),
            Culprit::Floor(part) => placed
                .get(part)
                .is_some_and(|own| super::around::above_floor(&own.solid) + own.drift + SLACK <= GAP),
        }
    }

    /// A free state in the middle of a cell, or with the base there.
    fn free_in(&self, tip: &Isometry3<f64>, stretch: &Stretch, cell: &Cell) -> Option<State> {
        let room = self.around.room;
        let states: Vec<_> = match self.family {
            Family::Lift(arm) => {
                let [yaw, shoulder, _] = cell.middle;
                let placed = arm.solve(tip, yaw, shoulder).into_iter();
                placed.map(|placed| room.with(self.hand, placed.base, &placed.values)).collect()
            }
            Family::Parallel(arm, _) => {
                let found = arm.solve(&(room.map_from_base(stretch.base).inverse() * tip)).into_iter();
                found.map(|values| room.with(self.hand, stretch.base, &values)).collect()
            }
            Family::Any => vec![],
        };
        states.into_iter().find(|state| self.around.touch(state, self.allowed).is_none())
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
