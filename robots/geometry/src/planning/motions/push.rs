//! `push`: closes a container by its handle, or pushes any other object a little away from the robot with
//! the closed hand.

use motet_stdlib::lang::kinds;
use nalgebra::{Isometry3, Translation3, Vector3};

use super::handle::front_around;
use super::pull::pull;
use crate::collision::Solid;
use crate::planning::certify::{DeflatedPart, inner};
use crate::planning::context::QueryContext;
use crate::planning::query::{
    ContactTally, Grasp, GraspSide, Infeasible, InfeasibleReason, Margins, MotionAnswer, MotionWitness,
    SearchBudget, UnknownReason, exhausted,
};
use crate::planning::scene::{
    AllowedCollisions, Configuration, HandModel, MIN_CLEARANCE, Obstacle, solid_shape,
};
use crate::trigonometry::turn;

/// Length of a push, in m.
const FAR: f64 = 0.1;
/// Gap between hand and object at the start, in m.
const BEFORE: f64 = 0.003;
/// Directions of the push, as angles in rad from straight away from the robot.
const ASIDE: [f64; 7] = [0.0, 0.26, -0.26, 0.52, -0.52, 0.78, -0.78];
/// Places of the object at which it is checked against obstacles.
const PLACES: u32 = 16;

/// Answers `push`: closes a container, or pushes an object away.
pub(crate) fn push(context: &QueryContext<'_>, id: &str, budget: SearchBudget) -> MotionAnswer {
    let unknown = |why: String| MotionAnswer::Unknown(UnknownReason::Because(why));
    let Some((index, entity)) = context.entity(id) else { return unknown(format!("there is no `{id}`")) };
    if entity.travel.is_some() {
        return pull(context, id, [1.0, 0.0], budget);
    }
    let Some(hand) = context.model.hand() else {
        return unknown("the card names no hand with a tip".into());
    };
    if let Some((held, _)) = &context.state.held {
        return unknown(format!("the hand holds `{held}`"));
    }
    if entity.fixed || entity.kind == kinds::PERSON {
        return unknown(format!("`{id}` cannot be pushed"));
    }
    let Some((pose, shape)) = context.state.pose(entity).zip(solid_shape(entity)) else {
        return unknown(format!("the pose or the shape of `{id}` is unknown"));
    };
    let object = Solid::new(&pose, shape);
    let support = context.support(index);
    let is_other = |it: &&Obstacle| it.entity != index && Some(it.entity) != support;
    let [x, y, _] = context.state.robot.base;
    let (dx, dy) = (object.centre.x - x, object.centre.y - y);
    let far = libm::hypot(dx, dy).max(1e-9);
    let ahead = Vector3::new(dx / far, dy / far, 0.0);
    let front = front_around(context, hand, 0.0);
    let (mut met, mut ends) = (ContactTally::default(), Vec::new());
    for aside in ASIDE {
        let along = turn(&Vector3::z_axis(), aside) * ahead;
        let stops = (1..=PLACES).find_map(|at| {
            let gone = Isometry3::from(Translation3::from(along * (FAR * f64::from(at) / f64::from(PLACES))));
            let moved = object.moved(&gone);
            let near = context.obstacles.near([moved.centre.x, moved.centre.y], moved.reach());
            let mut others = near.map(|(_, it)| it).filter(is_other);
            others.find(|it| !moved.is_farther(&it.solid, 0.0)).map(|it| context.name(it.entity))
        });
        if let Some(by) = stops {
            met.add_entity(by);
            continue;
        }
        let closes = along.cross(&Vector3::z());
        for closes in [closes, -closes, Vector3::z(), -Vector3::z()] {
            let begin = object.centre - along * (object.extent(&along) + front + BEFORE);
            let rotation = hand.turned(&along, &closes);
            ends.push((along, Isometry3::from_parts(Translation3::from(begin + along * FAR), rotation)));
        }
    }
    if ends.is_empty() {
        let reason = InfeasibleReason::BlockedPath { by: met.most() };
        let others: Vec<_> = context.obstacles.iter().filter(is_other).collect();
        return MotionAnswer::Infeasible(if is_walled_in(&object, &others, &ahead) {
            Infeasible::proven(reason, None)
        } else {
            Infeasible::exhausted(reason)
        });
    }
    let tips: Vec<_> = ends.iter().map(|(_, end)| *end).collect();
    if let Some((reason, change)) =
        context.reach_envelope(hand).beyond_all(&pose.translation.vector, &format!("`{id}`"), &tips)
    {
        return MotionAnswer::Infeasible(Infeasible { change, ..Infeasible::exhausted(reason) });
    }
    let allowed = AllowedCollisions::of_grasp(context, index);
    let (mut poses, mut ways, mut tried) = (ContactTally::default(), ContactTally::default(), 0);
    for at in 0..budget.candidates {
        for (along, map_from_tip) in &ends {
            for configuration in context.candidates(hand, map_from_tip, at) {
                let configuration = Configuration {
                    base: configuration.base,
                    joints: hand.around(&configuration.joints, context.model.rest(), 0.0),
                };
                if let Some(contact) = context.contact(&configuration, allowed) {
                    poses.add(&contact);
                    continue;
                }
                tried += 1;
                if let Some(path) =
                    way_along(context, hand, &configuration, map_from_tip, along, allowed, &mut ways)
                {
                    let grasp = Some(Grasp {
                        object: id.into(),
                        side: GraspSide::Side,
                        map_from_tip: *map_from_tip,
                        tip_from_object: map_from_tip.inverse() * Translation3::from(along * FAR) * pose,
                        width: 0.0,
                    });
                    let margins = Margins { payload: None, ..context.margins(&path, allowed) };
                    return MotionAnswer::Feasible(Box::new(MotionWitness { path, grasp, margins }));
                }
                if tried >= budget.paths {
                    return MotionAnswer::Unknown(UnknownReason::Budget);
                }
            }
        }
    }
    exhausted(tried > 0, &poses, &ways)
}

/// Path to a configuration whose last edge is the push.
fn way_along(
    context: &QueryContext<'_>,
    hand: &HandModel,
    configuration: &Configuration,
    map_from_tip: &Isometry3<f64>,
    along: &Vector3<f64>,
    allowed: AllowedCollisions,
    met: &mut ContactTally,
) -> Option<Vec<Configuration>> {
    let line = context.line(hand, configuration, map_from_tip, &(along * -FAR))?;
    // A hand path has open fingers; a push needs them closed.
    let closed = |it: &Configuration| Configuration {
        base: it.base,
        joints: hand.around(&it.joints, context.model.rest(), 0.0),
    };
    let line: Vec<Configuration> = line.iter().map(closed).collect();
    context.route_along(&line, [along.x, along.y], allowed, met)
}

/// Checks whether the object meets an obstacle in every direction between the tried ones.
fn is_walled_in(object: &Solid, others: &[&Obstacle], ahead: &Vector3<f64>) -> bool {
    const DEPTH: u32 = 8;
    let most = ASIDE.iter().copied().fold(0.0, f64::max);
    let mut open = vec![(0.0, most, 0)];
    while let Some((aside, half, depth)) = open.pop() {
        let along = turn(&Vector3::z_axis(), aside) * ahead;
        let is_stopped = (1..=PLACES).any(|at| {
            let gone = FAR * f64::from(at) / f64::from(PLACES);
            let solid = object.moved(&Isometry3::from(Translation3::from(along * gone)));
            // Deflated by the padding, since the object may slide along an obstacle.
            let drift = gone * half + MIN_CLEARANCE;
            let placed = DeflatedPart { solid, inner: inner(&solid), reach: solid.reach(), drift };
            others
                .iter()
                .any(|it| placed.touches(&it.solid, [inner(&it.solid), it.reach], MIN_CLEARANCE, drift))
        });
        if is_stopped {
            continue;
        }
        if depth == DEPTH {
            return false;
        }
        open.extend([-0.5, 0.5].map(|side| (aside + side * half, half / 2.0 + 1e-9, depth + 1)));
    }
    true
}
