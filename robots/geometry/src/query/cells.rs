//! That no state of the robot is free with the hand's tip at a pose, proven: the family of all solutions of the arm is covered by cells,
//! and in each a joint is beyond its limits throughout, or two solids touch throughout.
//!
//! Two solids touch in all of a cell where they do in its middle, each smaller by as much as it can be off. Let a point
//! of the one go no farther than `d` and one of the other no farther than `e`. If a point is so deep within both that the depths add
//! up to `d + e`, then the balls of these depths around it, which go along with their solids, still meet. What counts as a
//! touch is what does for a state of a way, [`GAP`] between everything.
//!
//! A cell of which that is not known is cut across the parameter for which most moves. It ends where one is free in a state
//! in it, or where as many cells as were allowed have been looked at.

use nalgebra::Isometry3;

use super::around::Around;
use super::machine::Hand;
use super::room::GAP;
use super::solver::Solver;
use super::state::State;
use super::touch::Allowed;
use crate::collision::{Shape, Solid};
use crate::inverse::family::{Cell, Drift, Over, Stretch};
use crate::inverse::{LiftArm, ParallelArm};
use crate::kinematics::Rig;

/// What may be off of places and lengths, in m: far more than rounding, and than what the axes of a URDF are off.
const SLACK: f64 = 1e-5;
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
}

impl Family<'_> {
    fn cells(self) -> Vec<Cell> {
        match self {
            Self::Lift(arm) => arm.cells(),
            Self::Parallel(arm, _) => arm.cells(),
        }
    }

    fn weights(self) -> [f64; 3] {
        match self {
            Self::Lift(arm) => arm.weights(),
            Self::Parallel(arm, _) => arm.weights(),
        }
    }

    fn over(self, map_from_tip: &Isometry3<f64>, cell: &Cell) -> Over {
        match self {
            Self::Lift(arm) => arm.over(map_from_tip, cell),
            Self::Parallel(arm, height) => arm.over(map_from_tip, height, cell),
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

/// A part where it is in the middle of a cell, and how far it can be from there.
#[derive(Clone, Copy)]
struct Placed {
    solid: Solid,
    inner: f64,
    reach: f64,
    drift: f64,
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

/// What is known of all states with the hand's tip at any of some poses.
pub(super) enum Covered {
    /// None is free, for certain.
    Nowhere,
    /// One is: with the tip at the pose of this index.
    Free(usize, State),
    /// Not as much.
    Open,
}

impl Around<'_, '_> {
    /// What cells tell of the states with the hand's tip at some poses, at most so many cells.
    pub(super) fn covered(
        &self,
        hand: &Hand,
        tips: &[Isometry3<f64>],
        allowed: Allowed,
        mut cells: usize,
    ) -> Covered {
        let Some(cover) = Cover::new(self, hand, allowed) else { return Covered::Open };
        let roots = cover.family.cells();
        if roots.is_empty() {
            return Covered::Open;
        }
        let mut culprits = Vec::new();
        let mut of_tips =
            tips.iter().zip(0..).map(|(tip, at)| cover.covered((at, tip), &roots, &mut culprits, &mut cells));
        of_tips.find(|covered| !matches!(covered, Covered::Nowhere)).unwrap_or(Covered::Nowhere)
    }
}

impl<'a, 'r, 'w> Cover<'a, 'r, 'w> {
    /// `None` where the solutions of the arm have no cells.
    fn new(around: &'a Around<'r, 'w>, hand: &'a Hand, allowed: Allowed) -> Option<Self> {
        let (room, machine) = (around.room, around.room.machine);
        let family = match &hand.solver {
            Solver::Lift(arm) => Family::Lift(arm),
            Solver::Parallel(arm) if machine.drives() => {
                Family::Parallel(arm, room.map_from_base([0.0; 3]).translation.z)
            }
            Solver::Parallel(_) | Solver::Seven(_) | Solver::Steps(_) => return None,
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

    /// What cells tell of the states with the tip at a pose; what touched lately comes first.
    fn covered(
        &self,
        (at, tip): (usize, &Isometry3<f64>),
        roots: &[Cell],
        culprits: &mut Vec<Culprit>,
        cells: &mut usize,
    ) -> Covered {
        let weights = self.family.weights();
        let mut open: Vec<Cell> = roots.to_vec();
        while let Some(cell) = open.pop() {
            let Some(left) = cells.checked_sub(1) else { return Covered::Open };
            *cells = left;
            let stretch = match self.family.over(tip, &cell) {
                Over::Nothing => continue,
                Over::Unclear => return Covered::Open,
                Over::Near(stretch) => stretch,
            };
            let placed = self.placed(&stretch);
            if let Some(known) = culprits.iter().rposition(|culprit| self.touches(&placed, *culprit)) {
                // What touches often stands at the end.
                let next = (known + 1).min(culprits.len() - 1);
                culprits.swap(known, next);
                continue;
            }
            if let Some(found) = self.culprit(&placed) {
                if culprits.len() == KNOWN {
                    culprits.remove(0);
                }
                culprits.push(found);
                continue;
            }
            let sizes = weights.iter().zip(cell.half).map(|(weight, half)| weight * half).zip(0..);
            let (size, across) = sizes.fold((0.0, 0), |most, next| if next.0 > most.0 { next } else { most });
            if size < SMALL
                && let Some(state) = self.free_in(tip, &stretch, &cell)
            {
                return Covered::Free(at, state);
            }
            if size < LEAST {
                return Covered::Open;
            }
            open.extend(cell.halves(across));
        }
        Covered::Nowhere
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

    /// What touches throughout.
    fn culprit(&self, placed: &[Placed]) -> Option<Culprit> {
        let limbs = self.around.limbs.iter().zip(0..).filter(|(limb, _)| limb.counts);
        let all = limbs.flat_map(|(limb, part)| {
            let things = self.around.things.iter().zip(0..);
            let things = things.filter(|(near, _)| !limb.may_touch(near.entity, self.allowed));
            let things = things.map(move |(_, at)| Culprit::Thing(part, at));
            things.chain(limb.is_carried.then_some(Culprit::Floor(part)))
        });
        let own = self.pairs.iter().map(|[one, other]| Culprit::Own(*one, *other));
        all.chain(own).find(|culprit| self.touches(placed, *culprit))
    }

    /// Whether a pair touches throughout.
    fn touches(&self, placed: &[Placed], culprit: Culprit) -> bool {
        let (part, other) = match culprit {
            Culprit::Thing(part, at) => {
                let Some((near, inner)) = self.around.things.get(at).zip(self.things.get(at)) else {
                    return false;
                };
                (part, Placed { solid: near.solid, inner: *inner, reach: near.reach, drift: 0.0 })
            }
            Culprit::Own(part, at) => {
                let Some(other) = placed.get(at) else { return false };
                (part, *other)
            }
            Culprit::Floor(part) => {
                return placed
                    .get(part)
                    .is_some_and(|own| super::around::above_floor(&own.solid) + own.drift + SLACK <= GAP);
            }
        };
        placed.get(part).is_some_and(|own| own.touches(&other))
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
        };
        states.into_iter().find(|state| self.around.touch(state, self.allowed).is_none())
    }
}

impl Placed {
    /// Whether two solids touch wherever they are within their drifts.
    fn touches(&self, other: &Self) -> bool {
        let off = self.drift + other.drift + SLACK;
        let from_other = (off - self.inner).max(0.0);
        if from_other >= other.inner {
            return false;
        }
        let wide = self.reach + other.reach + GAP - off;
        if wide < 0.0 || (self.solid.centre - other.solid.centre).norm_squared() > wide * wide {
            return false;
        }
        let (one, far) = (within(&self.solid, off.min(self.inner)), within(&other.solid, from_other));
        one.is_nearer(&far, GAP)
    }
}

/// The radius of the greatest ball within a solid.
fn inner(solid: &Solid) -> f64 {
    match solid.shape {
        Shape::Box(half) => half.min(),
        Shape::Cylinder { radius, half } => radius.min(half),
        Shape::Capsule { radius, .. } => radius,
        Shape::HalfSpace => 0.0,
    }
}

/// The points of a solid that are so deep within it, at most as deep as the greatest ball.
fn within(solid: &Solid, depth: f64) -> Solid {
    let less = |length: f64| (length - depth).max(0.0);
    let shape = match solid.shape {
        Shape::Box(half) => Shape::Box(half.map(less)),
        Shape::Cylinder { radius, half } => Shape::Cylinder { radius: less(radius), half: less(half) },
        Shape::Capsule { radius, half } => Shape::Capsule { radius: less(radius), half },
        Shape::HalfSpace => Shape::HalfSpace,
    };
    Solid { shape, ..*solid }
}
