//! Arm candidates: configurations that put the tip at a pose, in a low-discrepancy order.
//!
//! For an arm on a lift a broad phase draws eight at a time in `f32`. Most are in contact for certain; only
//! the others are solved in `f64`.

use std::f64::consts::{PI, TAU};

use nalgebra::{Isometry3, Translation3, Vector3};

use crate::inverse::batch::{BatchSolver, CandidateBatch, LANES, TipBatch};
use crate::inverse::{LiftArm, Tolerance, numeric};
use crate::kinematics::{KinematicChain, quasi_random};
use crate::planning::checking::CollisionChecker;
use crate::planning::scene::{AllowedCollisions, Configuration, Contact, HandModel, IkSolver, PlanningScene};
use crate::simd::BatchModel;

/// Steps of a straight hand path that the arm follows.
const STEPS: usize = 5;

/// Iterations within which most solvable starts converge.
const CLOSES: usize = 14;

/// Number of candidates of a seven-joint arm that come from the numeric solver; the others are closed-form.
const BY_STEPS: usize = 4;
/// Closed-form solutions per value of the last joint, the nearest to the current one first.
const MOST: usize = 2;

/// Root of x² = x + 1: ratio of the one-dimensional sequence.
const LINE: f64 = 1.618_033_988_749_895;
/// Root of x³ = x + 1: ratio of the two-dimensional sequence.
pub(crate) const PLANE: f64 = 1.324_717_957_244_746;
/// Root of x⁴ = x + 1: ratio of the three-dimensional sequence.
pub(crate) const SPACE: f64 = 1.220_744_084_605_759_5;

/// Element `at` of coordinate `n` of the R_d sequence, in 0..1: the fraction of 0.5 + `at`·`ratio`⁻ⁿ
/// (Roberts 2018).
pub(crate) fn part(at: usize, n: i32, ratio: f64) -> f64 {
    let value = 0.5 + at as f64 * (0..n).fold(1.0, |power, _| power / ratio);
    value - libm::floor(value)
}

impl PlanningScene<'_> {
    /// Candidates of number `at` for a tip pose; may be none.
    pub(crate) fn candidates(
        &self,
        hand: &HandModel,
        map_from_tip: &Isometry3<f64>,
        at: usize,
    ) -> Vec<Configuration> {
        if let IkSolver::Lift(arm) = &hand.solver {
            let yaw = self.heading(hand, map_from_tip) + (part(at, 1, PLANE) - 0.5) * TAU;
            let (lower, upper) = arm.shoulder_span();
            let shoulder = lower + part(at, 2, PLANE) * (upper - lower);
            let placed = arm.solve(map_from_tip, yaw, shoulder).into_iter();
            return placed.map(|placed| self.with(hand, placed.base, &placed.values)).collect();
        }
        let base = self.base_at(hand, map_from_tip, at);
        let base_from_tip = self.map_from_base(base).inverse() * map_from_tip;
        let values: Vec<Vec<f64>> = match &hand.solver {
            IkSolver::Parallel(arm) => arm.solve(&base_from_tip).into_iter().map(Into::into).collect(),
            IkSolver::Lift(_) => vec![],
            // The numeric solver leaves the elbow free; the closed form samples the last joint.
            IkSolver::Seven(arm) if at >= BY_STEPS => {
                let (lower, upper) = arm.last_span();
                let last = lower + part(at, 1, LINE) * (upper - lower);
                let found = arm.nearest(&base_from_tip, &[last], &self.now(arm.chain()), MOST);
                found.into_iter().map(Into::into).collect()
            }
            IkSolver::Seven(_) | IkSolver::Steps(_) => {
                let chain = hand.solver.chain();
                let start = match at {
                    0 => self.now(chain),
                    _ => quasi_random(&chain.dofs, at - 1),
                };
                numeric::refined(chain, &base_from_tip, &start, CLOSES, Tolerance::EXACT)
                    .into_iter()
                    .collect()
            }
        };
        values.into_iter().map(|values| self.with(hand, base, &values)).collect()
    }

    /// Current values of the arm's joints.
    fn now(&self, chain: &KinematicChain) -> Vec<f64> {
        let joints = &self.state.robot.joints;
        chain.in_tree.iter().map(|at| joints.get(*at).copied().unwrap_or_default()).collect()
    }

    /// Base pose of candidate `at` for an arm that does not place the base itself: mostly behind the hand
    /// and facing the target, and anywhere around it in the limit.
    pub(crate) fn base_at(&self, hand: &HandModel, map_from_tip: &Isometry3<f64>, at: usize) -> [f64; 3] {
        if !self.model.drives() {
            return self.state.robot.base;
        }
        // Half of all samples are within a quarter of the range on either side.
        let aside = |part: f64| (2.0 * part - 1.0) * (2.0 * part - 1.0).abs() * PI;
        let reach = hand.card.reach_m + self.model.card().base.radius_m;
        let towards = self.heading(hand, map_from_tip) + aside(part(at, 1, SPACE));
        let (sin, cos) = libm::sincos(towards);
        let far = 0.2 + (reach - 0.2).max(0.1) * part(at, 2, SPACE);
        let (x, y) = (map_from_tip.translation.x - cos * far, map_from_tip.translation.y - sin * far);
        [x, y, towards + aside(part(at, 3, SPACE))]
    }

    /// Configurations of a straight hand path along the pointing direction, from `back` m before the goal;
    /// the goal itself is the last. `None` where the arm cannot follow.
    pub(crate) fn approach(
        &self,
        hand: &HandModel,
        configuration: &Configuration,
        map_from_tip: &Isometry3<f64>,
        back: f64,
    ) -> Option<Vec<Configuration>> {
        let away = map_from_tip.rotation * -Vector3::from(hand.card.points) * back;
        self.line(hand, configuration, map_from_tip, &away)
    }

    /// Configurations of a straight hand path from `shift`, in m in the map, to the goal, with a constant
    /// rotation; the goal itself is the last. `None` where the arm cannot follow.
    pub(crate) fn line(
        &self,
        hand: &HandModel,
        configuration: &Configuration,
        map_from_tip: &Isometry3<f64>,
        shift: &Vector3<f64>,
    ) -> Option<Vec<Configuration>> {
        if let IkSolver::Lift(arm) = &hand.solver {
            // Base and lift alone move the hand along any line.
            let chain = hand.solver.chain();
            let (joint, dof) = (chain.joints.first()?, chain.dofs.first()?);
            let mut first = configuration.clone();
            let lift = first.joints.get_mut(*chain.in_tree.first()?)?;
            *lift += shift.z * arm.up / joint.coupling.multiplier;
            if !dof.allows(*lift) {
                return None;
            }
            let [x, y, yaw] = first.base;
            first.base = [x + shift.x, y + shift.y, yaw];
            return Some(vec![first, configuration.clone()]);
        }
        let along = self.follows(hand, configuration, map_from_tip, shift, &Vector3::zeros());
        // A base that drives in every direction carries the arm, which only has to lift the hand.
        let level = Vector3::new(shift.x, shift.y, 0.0);
        along.or_else(|| {
            self.slides().then(|| self.follows(hand, configuration, map_from_tip, shift, &level))?
        })
    }

    /// Configurations of that path with the base moving along `by`, in m in the map.
    fn follows(
        &self,
        hand: &HandModel,
        configuration: &Configuration,
        map_from_tip: &Isometry3<f64>,
        shift: &Vector3<f64>,
        by: &Vector3<f64>,
    ) -> Option<Vec<Configuration>> {
        let chain = hand.solver.chain();
        let mut values: Vec<f64> =
            chain.in_tree.iter().map(|at| configuration.joints.get(*at).copied().unwrap_or(0.0)).collect();
        let [x, y, yaw] = configuration.base;
        let mut configurations = vec![configuration.clone()];
        for step in 1..=STEPS {
            let share = step as f64 / STEPS as f64;
            let base = [x + by.x * share, y + by.y * share, yaw];
            let wanted =
                self.map_from_base(base).inverse() * (Translation3::from(shift * share) * map_from_tip);
            if shift != by {
                values = hand.solver.followed(&wanted, &values)?;
            }
            configurations.push(self.with(hand, base, &values));
        }
        configurations.reverse();
        Some(configurations)
    }
}

/// Greatest difference between the solutions in `f64` and in `f32`, in rad or m.
const SAME: f64 = 1e-3;

/// Prefilter for the candidates of one goal search.
pub(crate) struct ArmPrefilter<'a, 'r, 'w> {
    checker: &'a CollisionChecker<'r, 'w>,
    batch_model: &'a BatchModel,
    hand: &'a HandModel,
    arm: &'a LiftArm,
    manifold: BatchSolver<'a>,
    allowed: AllowedCollisions,
    /// Configuration with the hand as it approaches.
    still: Configuration,
    /// Range of the shoulder joint, in rad.
    shoulders: [f64; 2],
}

/// Up to eight tip poses with their indices.
pub(crate) struct PoseBatch {
    tips: Vec<(usize, Isometry3<f64>)>,
    poses: TipBatch,
}

/// Candidate in `f32`.
#[derive(Clone, Copy)]
pub(crate) struct ArmDraft {
    /// Index of its tip pose.
    pub(crate) at: usize,
    pub(crate) tip: Isometry3<f64>,
    yaw: f64,
    shoulder: f64,
    /// Offset of the base from the checker's origin, in m.
    base: [f64; 2],
    values: [f64; 5],
}

/// Result of the broad phase for one draft.
pub(crate) enum DraftCheck {
    Free,
    /// Undecided: near to another body.
    Open,
    Touches(Contact),
}

impl<'a, 'r, 'w> ArmPrefilter<'a, 'r, 'w> {
    /// Prefilter of an arm; `None` where the robot has no batch model.
    pub(crate) fn new(
        checker: &'a CollisionChecker<'r, 'w>,
        hand: &'a HandModel,
        arm: &'a LiftArm,
        allowed: AllowedCollisions,
    ) -> Option<Self> {
        let (lower, upper) = arm.shoulder_span();
        Some(Self {
            checker,
            batch_model: checker.context.batch_model()?,
            hand,
            arm,
            manifold: BatchSolver::new(arm),
            allowed,
            still: checker.context.with(hand, [0.0; 3], &[]),
            shoulders: [lower, upper],
        })
    }

    /// Batch of up to eight tip poses.
    pub(crate) fn group(&self, tips: Vec<(usize, Isometry3<f64>)>) -> PoseBatch {
        let facing: Vec<_> =
            tips.iter().map(|(_, tip)| (*tip, self.checker.context.heading(self.hand, tip))).collect();
        PoseBatch { poses: self.manifold.poses(&facing, self.checker.place()), tips }
    }

    /// Appends the candidates of one round for a batch of poses, the same as [`PlanningScene::candidates`].
    pub(crate) fn drafts(&self, group: &PoseBatch, round: usize, drafts: &mut Vec<ArmDraft>) {
        let [lower, upper] = self.shoulders;
        let shoulder = lower + part(round, 2, PLANE) * (upper - lower);
        let block = self.manifold.block(&group.poses, (part(round, 1, PLANE) - 0.5) * TAU, shoulder);
        let CandidateBatch { lift, base: [x, y], .. } = block;
        let (lift, x, y) = (lift.to_array(), x.to_array(), y.to_array());
        for branch in &block.branches {
            if branch.allowed == 0 {
                continue;
            }
            let wrist = branch.values.map(|values| values.to_array());
            for (lane, (at, tip)) in (0..LANES).zip(&group.tips) {
                if branch.allowed >> lane & 1 == 0 {
                    continue;
                }
                let of = |row: &[f32; LANES]| row.get(lane).copied().map_or(f64::NAN, f64::from);
                let [a, b, c] = &wrist;
                drafts.push(ArmDraft {
                    at: *at,
                    tip: *tip,
                    yaw: block.yaws.get(lane).copied().unwrap_or_default(),
                    shoulder,
                    base: [of(&x), of(&y)],
                    values: [of(&lift), shoulder, of(a), of(b), of(c)],
                });
            }
        }
    }

    /// Checks up to eight drafts.
    pub(crate) fn seen(&self, drafts: &[ArmDraft]) -> Vec<DraftCheck> {
        let look = || {
            let mut batch = self.batch_model.batch();
            let mut joints = self.still.joints.clone();
            let first = drafts.first()?;
            for lane in 0..LANES {
                let draft = drafts.get(lane).unwrap_or(first);
                for (at, value) in self.arm.chain().in_tree.iter().zip(draft.values) {
                    *joints.get_mut(*at)? = value;
                }
                let [x, y] = draft.base;
                let is_within = self.batch_model.set(&mut batch, lane, [x, y, draft.yaw], &joints);
                if !is_within || !self.checker.holds_off(draft.base) {
                    return None;
                }
            }
            self.checker.near_to(self.batch_model, &batch, self.allowed)
        };
        let Some(near) = look() else { return drafts.iter().map(|_| DraftCheck::Open).collect() };
        let seen = |lane: usize| match near.iter().find(|near| near.sure >> lane & 1 == 1) {
            Some(near) => DraftCheck::Touches(self.checker.named_contact(near)),
            None if near.iter().any(|near| near.still >> lane & 1 == 1) => DraftCheck::Open,
            None => DraftCheck::Free,
        };
        (0..drafts.len()).map(seen).collect()
    }

    /// Solution of a draft in `f64`.
    pub(crate) fn configuration(&self, draft: &ArmDraft) -> Option<Configuration> {
        let placed = self.arm.solve(&draft.tip, draft.yaw, draft.shoulder);
        let is_same = |values: &[f64; 5]| {
            values.iter().zip(&draft.values).all(|(one, other)| (one - other).abs() < SAME)
        };
        let placed = placed.into_iter().find(|placed| is_same(&placed.values))?;
        Some(self.checker.context.with(self.hand, placed.base, &placed.values))
    }
}
