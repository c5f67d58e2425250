//! Candidates of an arm on a lift, eight at a time in `f32`: most touch something for certain, and only the others are worth a
//! solution in `f64`.

use std::f64::consts::TAU;

use nalgebra::Isometry3;

use crate::inverse::LiftArm;
use crate::inverse::batch::{BatchSolver, CandidateBatch, LANES, TipBatch};
use crate::planning::checking::collision_checker::CollisionChecker;
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::{AllowedCollisions, Contact};
use crate::planning::scene::robot_model::HandModel;
use crate::planning::search::arm_candidates::{PLANE, part};
use crate::simd::BatchModel;

/// How far a value of a solution in `f64` may be from the draft's, in rad or m.
const SAME: f64 = 1e-3;

/// What looks at candidates.
pub(crate) struct ArmPrefilter<'a, 'r, 'w> {
    checker: &'a CollisionChecker<'r, 'w>,
    batch_model: &'a BatchModel,
    hand: &'a HandModel,
    arm: &'a LiftArm,
    manifold: BatchSolver<'a>,
    allowed: AllowedCollisions,
    /// The robot with the hand as it reaches.
    still: Configuration,
    /// Between which values the shoulder moves.
    shoulders: [f64; 2],
}

/// Eight poses of the tip or fewer, each with its index.
pub(crate) struct PoseBatch {
    tips: Vec<(usize, Isometry3<f64>)>,
    poses: TipBatch,
}

/// A candidate for a pose, in `f32`.
#[derive(Clone, Copy)]
pub(crate) struct ArmDraft {
    /// Index of the pose.
    pub(crate) at: usize,
    pub(crate) tip: Isometry3<f64>,
    yaw: f64,
    shoulder: f64,
    /// From the origin of the neighbourhood.
    base: [f64; 2],
    values: [f64; 5],
}

/// What is known of a draft.
pub(crate) enum DraftCheck {
    /// It touches nothing.
    Free,
    /// It comes near something.
    Open,
    Touches(Contact),
}

impl<'a, 'r, 'w> ArmPrefilter<'a, 'r, 'w> {
    /// `None` where the robot is not simple enough.
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

    /// Poses of the tip, at most eight.
    pub(crate) fn group(&self, tips: Vec<(usize, Isometry3<f64>)>) -> PoseBatch {
        let facing: Vec<_> =
            tips.iter().map(|(_, tip)| (*tip, self.checker.context.heading(self.hand, tip))).collect();
        PoseBatch { poses: self.manifold.poses(&facing, self.checker.place()), tips }
    }

    /// Adds the candidates of a round for some poses, as [`QueryContext::candidates`](super::room::Room) has them.
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

    /// What is known of drafts, at most eight.
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
            Some(near) => DraftCheck::Touches(self.checker.told(near)),
            None if near.iter().any(|near| near.still >> lane & 1 == 1) => DraftCheck::Open,
            None => DraftCheck::Free,
        };
        (0..drafts.len()).map(seen).collect()
    }

    /// The state of a draft, to what `f64` can tell.
    pub(crate) fn configuration(&self, draft: &ArmDraft) -> Option<Configuration> {
        let placed = self.arm.solve(&draft.tip, draft.yaw, draft.shoulder);
        let is_same = |values: &[f64; 5]| {
            values.iter().zip(&draft.values).all(|(one, other)| (one - other).abs() < SAME)
        };
        let placed = placed.into_iter().find(|placed| is_same(&placed.values))?;
        Some(self.checker.context.with(self.hand, placed.base, &placed.values))
    }
}
