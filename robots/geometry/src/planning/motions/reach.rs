//! `reach` and `reach_at`: a grasp of an object, in the latter at a point, and a path of the robot to it.

use motet_robots::scene::Entity;
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use smol_str::SmolStr;

use crate::collision::{Shape, Solid};
use crate::planning::checking::{CollisionChecker, is_nearer};
use crate::planning::context::QueryContext;
use crate::planning::grasp::{GraspCandidate, GraspManifold, grasp_candidates, in_order};
use crate::planning::placing::MapPose;
use crate::planning::query::{
    Grasp, GraspSide, InfeasibleReason, Margins, MotionAnswer, MotionWitness, SearchBudget, UnknownReason,
    certain,
};
use crate::planning::scene::{
    AllowedCollisions, Configuration, Contact, HandModel, MIN_CLEARANCE, Obstacle, Padding, PlanningScene,
    above_floor, away, solid_shape,
};
use crate::planning::search::{GoalPose, GoalSpec, LAST};

/// Approach distances before the object, in m; the shorter where the longer is blocked.
const BACK: [f64; 2] = [0.1, 0.05];
/// Least distance of the open hand from what it grasps, in m.
const APART: f64 = 1e-4;
/// Distance in m from an object within which a hand still closes around it.
const NEAR_GRASP: f64 = 0.05;

/// Answers `reach`: a grasp of an entity.
pub(crate) fn reach(
    context: &QueryContext<'_>,
    id: &str,
    side: Option<GraspSide>,
    budget: SearchBudget,
) -> MotionAnswer {
    let (target, all) = match graspable(context, id, side, None) {
        Ok(found) => found,
        Err(answer) => return answer,
    };
    let (hand, envelope) = (target.hand, context.reach_envelope(target.hand));
    let closes = |hold: &GraspCandidate| context.closing_contact(&target, hold).is_none();
    let manifold = GraspManifold::new(hand, &target.object, side, context.state.robot.base);
    let manifold = manifold.permitting(&closes);
    if let Some(answer) = envelope.beyond(&target.pose.translation.vector, id, &all)
        && manifold.are_all(|tip, drift| envelope.is_beyond(tip, drift))
    {
        return answer;
    }
    search(context, &target, all, Some(&manifold), budget)
}

/// Answers `reach_at`: a grasp of an entity at a point; the yaw of the pose does not matter. Without the
/// pose, only what it does not change.
pub(crate) fn reach_at(
    context: &QueryContext<'_>,
    id: &str,
    at: Option<&MapPose>,
    budget: SearchBudget,
) -> MotionAnswer {
    let point = at.map(|at| Vector3::from(at.xyz()));
    match graspable(context, id, None, point) {
        Ok((target, all)) if point.is_some() => search(context, &target, all, None, budget),
        Ok(_) => MotionAnswer::Unknown(UnknownReason::Because("only the run determines the point".into())),
        Err(answer) => answer,
    }
}

/// Object with the candidates of its grasps.
///
/// # Errors
///
/// The answer where there is nothing to search for.
fn graspable<'a>(
    context: &'a QueryContext<'_>,
    id: &'a str,
    side: Option<GraspSide>,
    point: Option<Vector3<f64>>,
) -> Result<(ReachTarget<'a>, Vec<GraspCandidate>), MotionAnswer> {
    let unknown = |why: String| Err(MotionAnswer::Unknown(UnknownReason::Because(why)));
    let Some((index, entity)) = context.entity(id) else { return unknown(format!("there is no `{id}`")) };
    let Some(hand) = context.model.hand() else {
        return unknown("the card names no hand with a tip".into());
    };
    let Some((pose, shape)) = context.state.pose(entity).zip(solid_shape(entity)) else {
        return unknown(format!("the pose or the shape of `{id}` is unknown"));
    };
    if let Some((held, _)) = &context.state.held {
        return unknown(format!("the hand holds `{held}`"));
    }
    let object = Solid::new(&pose, shape);
    let beside = point.map_or(0.0, |point| {
        let point = Isometry3::from_parts(Translation3::from(point), UnitQuaternion::identity());
        object.distance(&Solid::new(&point, Shape::Capsule { radius: 0.0, half: 0.0 }))
    });
    if beside > NEAR_GRASP {
        return Err(certain(InfeasibleReason::Beside { needs: beside, limit: NEAR_GRASP }, None));
    }
    if let Some(mass) = entity.mass_kg.filter(|mass| *mass > hand.card.payload_kg) {
        let limit = hand.card.payload_kg;
        return Err(certain(InfeasibleReason::TooHeavy { needs: mass, limit }, None));
    }
    let (all, least) = grasp_candidates(hand, &object, side, context.state.robot.base, point);
    if least > hand.card.opening_m {
        let limit = hand.card.opening_m;
        return Err(certain(InfeasibleReason::TooWide { needs: least, limit }, None));
    }
    if all.is_empty() && side.is_none() {
        return unknown(format!("no grasp by `{}` is known for its shape", hand.name));
    }
    let allowed = AllowedCollisions::of_grasp(context, index);
    Ok((ReachTarget { id, entity, pose, object, hand, allowed }, all))
}

/// Searches a path to one of some grasps.
fn search(
    context: &QueryContext<'_>,
    target: &ReachTarget<'_>,
    mut all: Vec<GraspCandidate>,
    manifold: Option<&GraspManifold<'_>>,
    budget: SearchBudget,
) -> MotionAnswer {
    let (hand, envelope) = (target.hand, context.reach_envelope(target.hand));
    // A pose outside of the workspace needs no search.
    all.retain(|hold| envelope.holds(&hold.map_from_tip));
    let [x, y, _] = context.state.robot.base;
    in_order(&mut all, &(target.pose.translation.vector - Vector3::new(x, y, 0.0)));
    let tips: Vec<_> = all.iter().map(|hold| hold.map_from_tip).collect();
    let centre = target.pose.translation;
    let grasp = hand.palm.abs().max(hand.farthest()) + target.object.reach();
    let checker = context.around([centre.x, centre.y], context.farthest(hand) + grasp + LAST);
    let goal = GoalSpec {
        hand,
        tips,
        manifold,
        allowed: target.allowed,
        checker: &checker,
        backs: &|tip| backs(context, tip, hand),
        closes: &|at| context.closing_contact(target, all.get(at)?),
    };
    match context.search_goal(&goal, budget) {
        Ok((at, path)) => {
            let hold = match at {
                GoalPose::Tip(at) => all.get(at).copied(),
                GoalPose::Grasp(hold) => Some(hold),
            };
            let Some(hold) = hold else { return MotionAnswer::Unknown(UnknownReason::Budget) };
            MotionAnswer::Feasible(Box::new(checker.grasped(target, &hold, path)))
        }
        Err(none) => none,
    }
}

/// Offsets back from a tip pose: against the pointing direction and, for a driving base, level or from
/// above or, where the fingers point down, level past the object between them.
fn backs(context: &QueryContext<'_>, tip: &Isometry3<f64>, hand: &HandModel) -> Vec<Vector3<f64>> {
    let away = away(tip, hand, 1.0);
    let [long, _] = BACK;
    let mut backs: Vec<_> = BACK.map(|back| away * back).to_vec();
    if !context.model.drives() {
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

impl PlanningScene<'_> {
    /// Contact of the hand with the object before it closes, or of the closing fingers with anything else.
    fn closing_contact(&self, target: &ReachTarget<'_>, hold: &GraspCandidate) -> Option<Contact> {
        let (closing, object) = (&target.hand.closing, &target.object);
        let met = |other: SmolStr| {
            let link = self.model.tree().links().get(target.hand.tip).cloned().unwrap_or_default();
            Some(Contact { link, other, is_own: false })
        };
        let touches = |own: &Solid, other: &Obstacle, pad: f64| {
            is_nearer(own, own.reach(), &other.solid, other.reach, pad)
        };
        let object = Obstacle::new(usize::MAX, *object, Padding::LEAST);
        if let Some(other) = self.pushed_against(target, &hold.push) {
            return met(other);
        }
        if closing.open().any(|own| touches(&own.moved(&hold.map_from_tip), &object, APART)) {
            return met(target.id.into());
        }
        for finger in closing.sweep(hold.width, hold.depth, hold.contact) {
            let finger = finger.moved(&hold.map_from_tip);
            if above_floor(&finger) <= MIN_CLEARANCE {
                return met("floor".into());
            }
            let around = finger.reach() + Padding::new(self.clearance).most();
            let mut near = self.obstacles.near([finger.centre.x, finger.centre.y], around);
            let touched = near.find(|(_, other)| {
                let is_near = target.allowed.is_near(other.entity);
                let pad = if is_near { MIN_CLEARANCE } else { other.padding.arm };
                !target.allowed.touches(other.entity, false) && touches(&finger, other, pad)
            });
            if let Some((_, other)) = touched {
                return met(self.name(other.entity));
            }
        }
        None
    }

    /// Entity that the object meets while the fingers move it. What it stands on, it touches anyway.
    fn pushed_against(&self, target: &ReachTarget<'_>, push: &Vector3<f64>) -> Option<SmolStr> {
        let object = &target.object;
        let is_still = push.norm() < APART;
        let around = object.reach() + push.norm() + MIN_CLEARANCE;
        let meets = |(_, other): &(usize, &Obstacle)| {
            let is_support = target.allowed.is_near(other.entity)
                && is_nearer(object, object.reach(), &other.solid, other.reach, MIN_CLEARANCE);
            !target.allowed.touches(other.entity, false)
                && !is_support
                && object.swept_distance_to(push, object.reach(), &other.solid, other.reach, MIN_CLEARANCE)
                    <= MIN_CLEARANCE
        };
        let mut near = self.obstacles.near([object.centre.x, object.centre.y], around);
        near.find(|other| !is_still && meets(other)).map(|(_, other)| self.name(other.entity))
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
            tip_from_object: hold.map_from_tip.inverse() * Translation3::from(hold.push) * target.pose,
            width: hold.width,
        };
        let payload = target.entity.mass_kg.map(|mass| target.hand.card.payload_kg - mass);
        let margins = Margins { payload, ..self.margins(&path, target.allowed) };
        MotionWitness { path, grasp: Some(grasp), margins }
    }
}

/// Object to be grasped, and the hand.
struct ReachTarget<'a> {
    id: &'a str,
    entity: &'a Entity,
    pose: Isometry3<f64>,
    object: Solid,
    hand: &'a HandModel,
    allowed: AllowedCollisions,
}
