//! `reach`: a grasp of a thing, and a way of the whole robot to it.

use motet_robots::scene::Entity;
use nalgebra::{Isometry3, Vector3};

use crate::collision::Solid;
use crate::planning::checking::collision_checker::CollisionChecker;
use crate::planning::grasp::candidates::{GraspCandidate, grasp_candidates};
use crate::planning::grasp::manifold::GraspManifold;
use crate::planning::motions::pull::away;
use crate::planning::query::answer::{
    Grasp, GraspSide, Infeasible, InfeasibleReason, Margins, MotionAnswer, MotionWitness, SearchBudget,
    UnknownReason,
};
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::AllowedCollisions;
use crate::planning::scene::obstacle::solid_shape;
use crate::planning::scene::robot_model::HandModel;
use crate::planning::search::context::QueryContext;
use crate::planning::search::goal_search::{GoalPose, GoalSpec, LAST};

/// How far before a thing the hand turns straight towards it, in m; the shorter where the longer does not do.
const BACK: [f64; 2] = [0.1, 0.05];
/// How finely holds are told apart by how much they point away from the robot.
const STEPS: usize = 20;

impl QueryContext<'_> {
    /// A grasp of an entity.
    pub(crate) fn reach(&self, id: &str, side: Option<GraspSide>, budget: SearchBudget) -> MotionAnswer {
        let unknown = |why: String| MotionAnswer::Unknown(UnknownReason::Because(why));
        let Some((index, entity)) = self.entity(id) else { return unknown(format!("there is no `{id}`")) };
        let Some(hand) = self.model.hand() else {
            return unknown("the card names no hand with a tip".into());
        };
        let Some((pose, shape)) = self.state.pose(entity).zip(solid_shape(entity)) else {
            return unknown(format!("the place or the shape of `{id}` is not known"));
        };
        if let Some((held, _)) = &self.state.held {
            return unknown(format!("the hand holds `{held}`"));
        }
        if let Some(mass) = entity.mass_kg.filter(|mass| *mass > hand.card.payload_kg) {
            return certain(InfeasibleReason::TooHeavy { needs: mass, limit: hand.card.payload_kg }, None);
        }
        let object = Solid::new(&pose, shape);
        let (all, least) = grasp_candidates(hand, &object, side, self.state.robot.base);
        if least > hand.card.opening_m {
            return certain(InfeasibleReason::TooWide { needs: least, limit: hand.card.opening_m }, None);
        }
        if all.is_empty() && side.is_none() {
            return unknown(format!(
                "no place between the fingers of `{}` is known for its shape",
                hand.name
            ));
        }
        let target = ReachTarget {
            id,
            entity,
            pose,
            object,
            hand,
            allowed: AllowedCollisions { hand: Some(index), held: None },
        };
        let (mut all, span) = (all, self.span(hand));
        let manifold = GraspManifold::new(hand, &target.object, side, self.state.robot.base);
        if let Some(answer) = span.beyond(&target.pose.translation.vector, id, &all)
            && manifold.are_all(|tip, drift| span.is_beyond(tip, drift))
        {
            return answer;
        }
        // What the arm reaches in no way needs no search.
        all.retain(|hold| span.holds(&hold.map_from_tip));
        self.sort(&mut all, &target);
        let tips: Vec<_> = all.iter().map(|hold| hold.map_from_tip).collect();
        let centre = target.pose.translation;
        let grasp = hand.palm.abs().max(hand.fingers.abs()) + target.object.reach();
        let checker = self.around([centre.x, centre.y], self.farthest(hand) + grasp + LAST);
        let goal = GoalSpec {
            hand,
            tips,
            manifold: Some(&manifold),
            allowed: target.allowed,
            checker: &checker,
            backs: &|tip| self.backs(tip, hand),
        };
        match self.search_goal(&goal, budget) {
            Ok((at, path)) => {
                let hold = match at {
                    GoalPose::Tip(at) => all.get(at).copied(),
                    GoalPose::GraspCandidate(hold) => Some(hold),
                };
                let Some(hold) = hold else { return MotionAnswer::Unknown(UnknownReason::Budget) };
                MotionAnswer::Feasible(Box::new(checker.grasped(&target, &hold, path)))
            }
            Err(none) => none,
        }
    }

    /// From a pose of the tip back to where the hand turns straight to it: against where its fingers point;
    /// else, where there is a base to do so, level or from above, or, where they point down, level past the thing between them.
    fn backs(&self, tip: &Isometry3<f64>, hand: &HandModel) -> Vec<Vector3<f64>> {
        let away = away(tip, hand, 1.0);
        let [long, _] = BACK;
        let mut backs: Vec<_> = BACK.map(|back| away * back).to_vec();
        if !self.model.drives() {
            return backs;
        }
        let level = Vector3::new(away.x, away.y, 0.0);
        let share = level.norm();
        if share > 0.3 && share < 0.999 {
            backs.push(level * (long / share));
        }
        if away.z < 0.9 {
            backs.push(Vector3::z() * long);
        } else {
            let past = away.cross(&(tip.rotation * Vector3::from(hand.card.closes))) * long;
            backs.extend([past, -past]);
        }
        backs
    }

    /// Holds from the robot's side come first; from above there is room, most often.
    fn sort(&self, holds: &mut Vec<GraspCandidate>, target: &ReachTarget<'_>) {
        let [x, y, _] = self.state.robot.base;
        let ahead = Vector3::new(target.pose.translation.x - x, target.pose.translation.y - y, 0.0);
        let far = (ahead.x * ahead.x + ahead.y * ahead.y).sqrt().max(1e-9);
        // In steps, so that what differs by rounding alone keeps its order; the best is the least.
        let step = |hold: &GraspCandidate| match hold.side {
            GraspSide::Top => STEPS / 2,
            GraspSide::Side | GraspSide::Front => {
                let worth = hold.approach.dot(&ahead) / far;
                STEPS.saturating_sub_signed(libm::round(worth * f64::from(STEPS as u32)) as isize)
            }
        };
        let mut steps: [Vec<usize>; 2 * STEPS + 1] = [const { vec![] }; 2 * STEPS + 1];
        for (hold, at) in holds.iter().zip(0..) {
            steps.get_mut(step(hold)).into_iter().for_each(|slot| slot.push(at));
        }
        *holds = steps.iter().flatten().filter_map(|at| holds.get(*at).copied()).collect();
    }
}

impl CollisionChecker<'_, '_> {
    fn grasped(
        &self,
        target: &ReachTarget<'_>,
        hold: &GraspCandidate,
        path: Vec<Configuration>,
    ) -> MotionWitness {
        let grasp = Grasp {
            object: target.id.into(),
            side: hold.side,
            map_from_tip: hold.map_from_tip,
            tip_from_object: hold.map_from_tip.inverse() * target.pose,
            width: hold.width,
        };
        let payload = target.entity.mass_kg.map(|mass| target.hand.card.payload_kg - mass);
        let margins = Margins { payload, ..self.margins(&path, target.allowed) };
        MotionWitness { path, grasp: Some(grasp), margins }
    }
}

/// What is to be grasped, and with what.
struct ReachTarget<'a> {
    id: &'a str,
    entity: &'a Entity,
    pose: Isometry3<f64>,
    object: Solid,
    hand: &'a HandModel,
    allowed: AllowedCollisions,
}

pub(crate) fn certain(reason: InfeasibleReason, change: Option<String>) -> MotionAnswer {
    MotionAnswer::Infeasible(Infeasible::proven(reason, change))
}
