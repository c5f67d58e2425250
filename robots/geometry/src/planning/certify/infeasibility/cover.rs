//! Model of one cell: poses and drifts of the robot's parts, and the contacts that hold throughout;
//! and the arm families whose inverse kinematics has an interval solution over cells.

use std::f64::consts::TAU;
use std::rc::Rc;

use nalgebra::{Isometry3, Vector3};

use super::bound_obstacle::{ScaledMotion, is_in};
use super::relative::{BodyPair, RelativeChains, RelativePlacement};
use crate::collision::Solid;
use crate::inverse::interval::{CellEnclosure, DisplacementBound, IkCell, IntervalSolution, PoseSet};
use crate::inverse::{LiftArm, ParallelArm, SevenArm};
use crate::kinematics::ReducedModel;
use crate::planning::certify::deflate::{DeflatedPart, SLACK, inner};
use crate::planning::checking::{CollisionChecker, NearObstacle};
use crate::planning::scene::{AllowedCollisions, HandModel, IkSolver, MIN_CLEARANCE, above_floor};

/// Robot, hand and obstacles of one certificate.
pub(super) struct CellModel<'a, 'r, 'w> {
    pub(super) checker: &'a CollisionChecker<'r, 'w>,
    pub(super) hand: &'a HandModel,
    pub(super) family: ArmFamily<'a>,
    pub(super) allowed: AllowedCollisions,
    pub(super) reduced: ReducedModel,
    pub(super) pair_groups: RelativeChains,
    /// Joint values with the hand as it approaches.
    joints: Vec<f64>,
    /// Arm joint of each frame of the reduced model but the first; `None` for other joints.
    arm: Vec<Option<usize>>,
    /// Index of the tip's frame.
    last: usize,
    frame_from_tip: Isometry3<f64>,
    pub(super) limbs: Vec<CellPart>,
    /// Approximate radius of the largest ball within each obstacle.
    obstacles: Vec<f64>,
}

/// Part of the robot in its frame.
pub(super) struct CellPart {
    pub(super) frame: usize,
    pub(super) solid: Solid,
    pub(super) inner: f64,
    pub(super) reach: f64,
}

/// Bodies that a part may touch in a cell.
#[derive(Clone)]
pub(super) struct ContactGroup {
    part: u16,
    /// Drift at the last reduction of the list.
    drift: f64,
    is_above_floor: bool,
    /// Obstacle indices, the thickest first.
    obstacles: Rc<[u16]>,
}

impl ContactGroup {
    /// Iterates over the pairs in order.
    pub(super) fn pairs(&self) -> impl Iterator<Item = BodyPair> + '_ {
        let obstacles = self.obstacles.iter().map(|at| BodyPair::Obstacle(self.part, *at));
        obstacles.chain(self.is_above_floor.then_some(BodyPair::Floor(self.part)))
    }
}

/// Ratio of the drift to the one at the last reduction, below which the list is reduced again.
pub(super) const FEWER: f64 = 0.6;
/// Drift in m below which the list is reduced at all.
pub(super) const FAR: f64 = 0.8;

/// Robot in a cell: the frames of the reduced model, and the parts placed so far.
#[derive(Default)]
pub(super) struct CellPlacement {
    pub(super) frames: Vec<(Isometry3<f64>, DisplacementBound)>,
    parts: Vec<Option<DeflatedPart>>,
    /// Position and drift of each joint; NaN where unknown.
    pub(super) steps: Vec<[f64; 2]>,
    pub(super) is_joined: bool,
    pub(super) own: RelativePlacement,
}

impl CellPlacement {
    fn part(&self, part: u16) -> Option<&DeflatedPart> {
        self.parts.get(usize::from(part))?.as_ref()
    }
}

impl<'a, 'r, 'w> CellModel<'a, 'r, 'w> {
    /// Model of a hand; `None` where the robot has no reduced model.
    pub(super) fn new(
        checker: &'a CollisionChecker<'r, 'w>,
        hand: &'a HandModel,
        allowed: AllowedCollisions,
    ) -> Option<Self> {
        let (context, model) = (checker.context, checker.context.model);
        let family = match &hand.solver {
            IkSolver::Lift(arm) => ArmFamily::Lift(arm),
            IkSolver::Parallel(arm) if model.drives() => {
                ArmFamily::Parallel(arm, context.map_from_base([0.0; 3]).translation.z)
            }
            IkSolver::Seven(arm) if !model.drives() => {
                let base = context.state.robot.base;
                ArmFamily::Seven(arm, context.map_from_base(base), base)
            }
            IkSolver::Parallel(_) | IkSolver::Seven(_) | IkSolver::Steps(_) => ArmFamily::Any,
        };
        let chain = hand.solver.chain();
        let joints = context.with(hand, [0.0; 3], &[]).joints;
        let reduced = model.tree().reduced(&joints, |dof| chain.in_tree.contains(&dof))?;
        let (last, frame_from_tip) = *reduced.links.get(hand.tip)?;
        // From the tip down to the base.
        let (mut frame, mut order) = (last, vec![]);
        while let Some(joint) = frame.checked_sub(1).and_then(|at| reduced.joints.get(at)) {
            order.push(frame);
            frame = joint.parent;
        }
        order.reverse();
        if order.len() != chain.joints.len() {
            return None;
        }
        let arm = (1..=reduced.joints.len()).map(|at| order.iter().position(|frame| *frame == at)).collect();
        let mut limbs = Vec::new();
        for part in context.body.parts() {
            let (frame, pose) = reduced.links.get(part.link)?;
            let solid = part.solid.moved(pose);
            limbs.push(CellPart { frame: *frame, solid, inner: inner(&solid), reach: solid.reach() });
        }
        let obstacles: Vec<f64> = checker.obstacles.iter().map(|near| inner(&near.solid)).collect();
        // Indices fit 16 bits: no robot or neighbourhood has more bodies.
        let is_small = limbs.len() < usize::from(u16::MAX) && obstacles.len() < usize::from(u16::MAX);
        let cover = Self {
            checker,
            hand,
            family,
            allowed,
            pair_groups: RelativeChains::new(&reduced),
            reduced,
            joints,
            arm,
            last,
            frame_from_tip,
            limbs,
            obstacles,
        };
        is_small.then_some(cover)
    }

    /// Pairs of the hand with obstacles, and all other pairs that arm or base move.
    pub(super) fn groups(&self) -> [Rc<[ContactGroup]>; 2] {
        let (mut hand, mut others) = (vec![], vec![]);
        for ((limb, own), part) in self.checker.limbs.iter().zip(&self.limbs).zip(0..) {
            let obstacles = self.checker.obstacles.iter().zip(&self.obstacles).zip(0..);
            let obstacles =
                obstacles.filter(|((near, _), _)| limb.counts && !limb.may_touch(near.entity, self.allowed));
            let mut obstacles: Vec<(f64, u16)> = obstacles.map(|((_, inner), at)| (*inner, at)).collect();
            obstacles.sort_by(|(one, _), (other, _)| other.total_cmp(one));
            let obstacles = obstacles.into_iter().map(|(_, at)| at).collect();
            let is_above_floor = limb.counts && limb.is_carried;
            let group = ContactGroup { part, drift: FAR / FEWER, is_above_floor, obstacles };
            if group.is_above_floor || !group.obstacles.is_empty() {
                if own.frame == self.last { hand.push(group) } else { others.push(group) }
            }
        }
        [hand.into(), others.into()]
    }

    /// Reduced list of a group; `None` where nothing changed.
    ///
    /// # Errors
    ///
    /// A pair in contact throughout.
    pub(super) fn left_of(
        &self,
        placing: &mut CellPlacement,
        group: &ContactGroup,
    ) -> Result<Option<ContactGroup>, BodyPair> {
        let part = group.part;
        self.ensure(placing, part);
        let Some(own) = placing.part(part) else { return Ok(None) };
        if group.is_above_floor && self.is_on_floor(placing, own, part, 1.0) {
            return Err(BodyPair::Floor(part));
        }
        let is_fewer = own.drift < FEWER * group.drift;
        let mut obstacles: Vec<u16> = Vec::new();
        for at in group.obstacles.iter().copied() {
            let Some(near) = self.checker.obstacles.get(usize::from(at)) else { continue };
            if is_fewer && own.is_apart(&near.solid, near.reach, self.padding(part, near), own.drift) {
                continue;
            }
            if self.is_in(placing, own, part, at, 1.0) {
                return Err(BodyPair::Obstacle(part, at));
            }
            if is_fewer {
                obstacles.push(at);
            }
        }
        if !is_fewer {
            return Ok(None);
        }
        let drift = own.drift;
        Ok(Some(ContactGroup { drift, obstacles: kept(obstacles, &group.obstacles), ..*group }))
    }

    /// Drift of a pair, in m.
    pub(super) fn off_by(&self, placing: &mut CellPlacement, pair: BodyPair) -> f64 {
        match pair {
            BodyPair::Obstacle(part, _) | BodyPair::Floor(part) => {
                self.part(placing, part).map_or(0.0, |own| own.drift)
            }
            BodyPair::RelativePlacement(part, at) => self.own_off(placing, part, at),
        }
    }

    /// Checks whether a pair of some groups is in contact in the middle.
    pub(super) fn is_stuck_in_middle(&self, placing: &mut CellPlacement, groups: &[ContactGroup]) -> bool {
        groups.iter().flat_map(ContactGroup::pairs).any(|pair| self.touches_in_middle(placing, pair))
    }

    /// Places the hand alone over a set of tip poses; the other parts are unknown.
    pub(super) fn place_hand(&self, tips: &PoseSet, placing: &mut CellPlacement) {
        let pose = tips.map_from_tip * self.frame_from_tip.inverse();
        placing.frames.clear();
        let unknown = DisplacementBound::unknown();
        placing.frames.resize(self.reduced.joints.len() + 1, (Isometry3::identity(), unknown));
        placing.frames.get_mut(self.last).into_iter().for_each(|slot| *slot = (pose, tips.displacement));
        placing.steps.clear();
        self.forget(placing);
    }

    /// Places the robot in a cell.
    pub(super) fn place(&self, enclosure: &CellEnclosure, placing: &mut CellPlacement) {
        let chain = self.hand.solver.chain();
        let root = (self.checker.context.model.map_from_root(enclosure.base), enclosure.base_displacement);
        placing.frames.clear();
        placing.frames.push(root);
        placing.steps.clear();
        placing.is_joined = enclosure.is_joined;
        for (joint, arm) in self.reduced.joints.iter().zip(&self.arm) {
            let mut values = chain.in_tree.iter().zip(&enclosure.values).zip(&chain.dofs);
            let known = values.find(|((at, _), _)| **at == joint.coupling.dof);
            // Full turns do not matter to the arm, but to the joints that follow it.
            let turns = known.is_some_and(|(_, dof)| {
                !dof.is_prismatic && dof.limits.is_none_or(|(lower, upper)| upper - lower > TAU)
            });
            let known = known.map(|((_, value), _)| *value);
            let still = self.joints.get(joint.coupling.dof).copied().unwrap_or_default();
            let [value, off] = known.unwrap_or([still, 0.0]);
            let position = joint.coupling.multiplier * value + joint.coupling.offset;
            placing.steps.push([position, off]);
            if let Some(frame) = arm.and_then(|at| enclosure.frames.get(at)) {
                placing.frames.push(*frame);
                continue;
            }
            // Mimic joints of the arm's joints.
            let (parent, drift) = placing.frames.get(joint.parent).copied().unwrap_or(root);
            let off = off * joint.coupling.multiplier;
            let pose = parent * joint.before * joint.motion(position);
            let drift = match (joint.is_prismatic, off == 0.0) {
                _ if turns => DisplacementBound::unknown(),
                (true, _) => drift.slid(pose.rotation * joint.axis.into_inner() * off),
                (false, true) => drift,
                (false, false) => DisplacementBound::unknown(),
            };
            placing.frames.push((pose, drift));
        }
        self.forget(placing);
    }

    fn forget(&self, placing: &mut CellPlacement) {
        placing.parts.clear();
        placing.parts.resize(self.limbs.len(), None);
        placing.own.axes.clear();
        placing.own.parts.clear();
        placing.own.parts.resize(self.limbs.len(), None);
    }

    /// Part in the middle of a cell with its drift.
    pub(super) fn part<'p>(&self, placing: &'p mut CellPlacement, part: u16) -> Option<&'p DeflatedPart> {
        self.ensure(placing, part);
        placing.part(part)
    }

    fn ensure(&self, placing: &mut CellPlacement, part: u16) {
        let at = usize::from(part);
        let Some(slot @ None) = placing.parts.get_mut(at) else { return };
        let Some(limb) = self.limbs.get(at) else { return };
        let Some((pose, drift)) = placing.frames.get(limb.frame) else { return };
        let solid = limb.solid.moved(pose);
        *slot = Some(DeflatedPart { solid, inner: limb.inner, reach: limb.reach, drift: drift.of(&solid) });
    }

    /// Checks whether a pair is in contact throughout a share of its drift.
    pub(super) fn touches(&self, placing: &mut CellPlacement, pair: BodyPair, share: f64) -> bool {
        match pair {
            BodyPair::Obstacle(part, at) => {
                self.ensure(placing, part);
                placing.part(part).is_some_and(|own| self.is_in(placing, own, part, at, share))
            }
            BodyPair::RelativePlacement(part, at) => {
                if placing.steps.is_empty() {
                    return false;
                }
                self.own_touches(placing, part, at, share)
            }
            BodyPair::Floor(part) => {
                self.ensure(placing, part);
                placing.part(part).is_some_and(|own| self.is_on_floor(placing, own, part, share))
            }
        }
    }

    /// Distance in m that a part keeps from an obstacle.
    fn padding(&self, part: u16, near: &NearObstacle) -> f64 {
        let limb = self.checker.limbs.get(usize::from(part));
        limb.map_or(MIN_CLEARANCE, |limb| limb.padding(near.entity, near.padding, self.allowed))
    }

    /// Checks whether a part is in contact with an obstacle throughout.
    fn is_in(&self, placing: &CellPlacement, own: &DeflatedPart, part: u16, at: u16, share: f64) -> bool {
        let at = usize::from(at);
        let Some((near, inner)) = self.checker.obstacles.get(at).zip(self.obstacles.get(at)) else {
            return false;
        };
        let pad = self.padding(part, near);
        let wide = own.reach + near.reach + pad;
        if (own.solid.centre - near.solid.centre).norm_squared() > wide * wide {
            return false;
        }
        let frame = self.limbs.get(usize::from(part)).and_then(|limb| placing.frames.get(limb.frame));
        frame.is_some_and(|(_, drift)| is_in(&own.solid, &ScaledMotion(share, drift), &near.solid, pad))
            || own.touches(&near.solid, [*inner, near.reach], pad, share * own.drift)
    }

    /// Checks whether a part is in contact with the floor throughout, by its lowest point in the middle.
    fn is_on_floor(&self, placing: &CellPlacement, own: &DeflatedPart, part: u16, share: f64) -> bool {
        let frame = self.limbs.get(usize::from(part)).and_then(|limb| placing.frames.get(limb.frame));
        let Some((_, drift)) = frame else { return false };
        let up = Vector3::z();
        let lowest = own.solid.support(&-up);
        lowest.z - own.solid.rim() + share * drift.along(&lowest, &up) + SLACK <= MIN_CLEARANCE
    }

    /// Checks whether a pair is in contact in the middle; an unknown part has no contact.
    pub(super) fn touches_in_middle(&self, placing: &mut CellPlacement, pair: BodyPair) -> bool {
        match pair {
            BodyPair::Obstacle(part, at) => {
                let at = usize::from(at);
                let obstacle = self.checker.obstacles.get(at).zip(self.obstacles.get(at));
                self.part(placing, part).zip(obstacle).is_some_and(|(own, (near, inner))| {
                    own.drift.is_finite()
                        && own.touches(&near.solid, [*inner, near.reach], self.padding(part, near), 0.0)
                })
            }
            BodyPair::RelativePlacement(part, at) => {
                if placing.steps.is_empty() {
                    return false;
                }
                self.ensure_both(placing, part, at);
                self.both(placing, part, at).is_some_and(|(one, other)| one.touches(other, 0.0))
            }
            BodyPair::Floor(part) => self
                .part(placing, part)
                .is_some_and(|own| own.drift.is_finite() && above_floor(&own.solid) + SLACK <= MIN_CLEARANCE),
        }
    }
}

/// Remaining items; shares the list where all remain.
pub(super) fn kept<T: Copy>(left: Vec<T>, all: &Rc<[T]>) -> Rc<[T]> {
    if left.len() == all.len() { Rc::clone(all) } else { left.into() }
}

/// Arm whose solutions are covered by cells.
#[derive(Clone, Copy)]
pub(super) enum ArmFamily<'a> {
    Lift(&'a LiftArm),
    /// Arm, and the height of the base's link above the floor in m.
    Parallel(&'a ParallelArm, f64),
    /// Arm, the pose of the base's link, and the base's pose.
    Seven(&'a SevenArm, Isometry3<f64>, [f64; 3]),
    /// Any other arm: only the hand is covered.
    Any,
}

impl ArmFamily<'_> {
    pub(super) fn cells(self) -> Vec<IkCell> {
        match self {
            Self::Lift(arm) => arm.cells(),
            Self::Parallel(arm, _) => arm.cells(),
            Self::Seven(arm, ..) => arm.cells(),
            Self::Any => vec![IkCell { branch: 0, middle: [0.0; 3], half: [0.0; 3] }],
        }
    }

    pub(super) fn weights(self) -> [f64; 3] {
        match self {
            Self::Lift(arm) => arm.weights(),
            Self::Parallel(arm, _) => arm.weights(),
            Self::Seven(arm, ..) => arm.weights(),
            Self::Any => [0.0; 3],
        }
    }

    pub(super) fn over(self, tips: &PoseSet, cell: &IkCell) -> IntervalSolution {
        match self {
            Self::Lift(arm) => arm.enclose(tips, cell),
            Self::Parallel(arm, height) => arm.enclose(tips, height, cell),
            Self::Seven(arm, map_from_base, base) => arm.enclose(tips, &map_from_base, base, cell),
            Self::Any => IntervalSolution::Unknown,
        }
    }
}
