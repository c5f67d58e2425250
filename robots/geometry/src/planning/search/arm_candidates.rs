//! States of the whole robot that put the hand's tip at a pose, one after the other in an order that spreads over all.

use std::f64::consts::{PI, TAU};

use motet_robots::card::Drive;
use nalgebra::{Isometry3, Translation3, Vector3};

use crate::inverse::{Tolerance, numeric};
use crate::kinematics::{KinematicChain, planar, quasi_random};
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::ik_solver::IkSolver;
use crate::planning::scene::robot_model::HandModel;
use crate::planning::search::context::QueryContext;

/// Steps of the hand from in front of a thing to it, where the arm has to follow a line.
const STEPS: usize = 5;

/// Steps after which a solution is found from most starts from which one is found at all.
const CLOSES: usize = 14;

/// So many candidates of an arm with seven joints are found by steps, the others in closed form.
const BY_STEPS: usize = 4;
/// Solutions in closed form for one value of the last joint, the nearest to how the arm is.
const MOST: usize = 2;

/// The root of x² = x + 1.
const LINE: f64 = 1.618_033_988_749_895;
/// The root of x³ = x + 1.
pub(crate) const PLANE: f64 = 1.324_717_957_244_746;
/// The root of x⁴ = x + 1.
pub(crate) const SPACE: f64 = 1.220_744_084_605_759_5;

/// The fraction of `at` times the `n`-th power of the inverse of the root of x^(d+1) = x + 1 (Roberts 2018).
pub(crate) fn part(at: usize, n: i32, ratio: f64) -> f64 {
    let value = 0.5 + at as f64 * (0..n).fold(1.0, |power, _| power / ratio);
    value - libm::floor(value)
}

impl QueryContext<'_> {
    /// Candidate `at` for a pose of the tip: no state, or some.
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
            // By steps first, which leave it free where the elbow goes; then along a family for one value of the last joint.
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

    /// Where the arm is.
    fn now(&self, chain: &KinematicChain) -> Vec<f64> {
        let joints = &self.state.robot.joints;
        chain.in_tree.iter().map(|at| joints.get(*at).copied().unwrap_or_default()).collect()
    }

    /// Where the base of candidate `at` is for an arm that does not place it itself: most often behind the hand and facing
    /// what it reaches for, but anywhere around in the end.
    pub(crate) fn base_at(&self, hand: &HandModel, map_from_tip: &Isometry3<f64>, at: usize) -> [f64; 3] {
        if !self.model.drives() {
            return self.state.robot.base;
        }
        // Half of all within a quarter of the range on either side.
        let aside = |part: f64| (2.0 * part - 1.0) * (2.0 * part - 1.0).abs() * PI;
        let reach = hand.card.reach_m + self.model.card().base.radius_m;
        let towards = self.heading(hand, map_from_tip) + aside(part(at, 1, SPACE));
        let (sin, cos) = libm::sincos(towards);
        let far = 0.2 + (reach - 0.2).max(0.1) * part(at, 2, SPACE);
        let (x, y) = (map_from_tip.translation.x - cos * far, map_from_tip.translation.y - sin * far);
        [x, y, towards + aside(part(at, 3, SPACE))]
    }

    /// The direction in which the base is likely to face with the tip at a pose: that of the fingers, or from where the robot
    /// is where they point down.
    pub(crate) fn heading(&self, hand: &HandModel, map_from_tip: &Isometry3<f64>) -> f64 {
        let points = map_from_tip.rotation * Vector3::from(hand.card.points);
        if points.x * points.x + points.y * points.y > 0.1 {
            return libm::atan2(points.y, points.x);
        }
        let ([x, y, _], at) = (self.state.robot.base, map_from_tip.translation);
        libm::atan2(at.y - y, at.x - x)
    }

    /// States on the straight line of the hand that ends at `state`, the first `back` m before it; `None` where the arm cannot
    /// follow. `state` itself is the last.
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

    /// States on the straight line of the hand from `shift`, in m in the map, to `state`, the hand turned alike; `None` where
    /// the arm cannot follow. `state` itself is the last.
    pub(crate) fn line(
        &self,
        hand: &HandModel,
        configuration: &Configuration,
        map_from_tip: &Isometry3<f64>,
        shift: &Vector3<f64>,
    ) -> Option<Vec<Configuration>> {
        if let IkSolver::Lift(arm) = &hand.solver {
            // With all else still, the base and the lift alone move the hand along any line.
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
        // A base that drives anywhere takes the arm along, which has to lift the hand only.
        let level = Vector3::new(shift.x, shift.y, 0.0);
        along.or_else(|| {
            self.slides().then(|| self.follows(hand, configuration, map_from_tip, shift, &level))?
        })
    }

    /// Whether the base goes in every direction.
    pub(crate) fn slides(&self) -> bool {
        self.model.drives() && self.model.card().base.drive != Drive::Differential
    }

    /// The states on that line with the base coming from `by`, in m in the map and level.
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

    /// The robot as it is, with the base elsewhere, the hand open, and values of the arm's joints.
    pub(crate) fn with(&self, hand: &HandModel, base: [f64; 3], values: &[f64]) -> Configuration {
        let now = &self.state.robot.joints;
        // Around something the fingers stay as they are.
        let mut joints = if self.state.held.is_some() { now.clone() } else { hand.opened(now) };
        for (at, value) in hand.solver.chain().in_tree.iter().zip(values) {
            if let Some(slot) = joints.get_mut(*at) {
                *slot = *value;
            }
        }
        Configuration { base, joints }
    }

    /// The pose of the base's link.
    pub(crate) fn map_from_base(&self, [x, y, yaw]: [f64; 3]) -> Isometry3<f64> {
        let height = self.model.card().model.as_ref().map_or(0.0, |model| model.height_m);
        planar(x, y, yaw) * Translation3::new(0.0, 0.0, height)
    }
}
