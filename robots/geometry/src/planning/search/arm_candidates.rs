//! Arm candidates: configurations that put the tip at a pose, in a low-discrepancy order.

use std::f64::consts::{PI, TAU};

use nalgebra::{Isometry3, Translation3, Vector3};

use crate::inverse::{Tolerance, numeric};
use crate::kinematics::{KinematicChain, quasi_random};
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::ik_solver::IkSolver;
use crate::planning::scene::planning_scene::PlanningScene;
use crate::planning::scene::robot_model::HandModel;

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
