//! `go_to`: a place of the base from which an entity is served, and a route to it; `stand_at`: a route
//! to a pose of the base; `posture`: the arm to a named posture.

use crate::planning::context::QueryContext;
use crate::planning::placing::MapPose;
use crate::planning::query::{
    ContactTally, Infeasible, InfeasibleReason, MotionAnswer, MotionWitness, SearchBudget, UnknownReason,
    certain,
};
use crate::planning::scene::{AllowedCollisions, Configuration};

/// Directions around the entity.
const DIRECTIONS: usize = 32;
/// Distances in m from the final place at which the base may turn before it comes straight in.
const BACK: [f64; 3] = [0.15, 0.3, 0.5];

/// Answers `go_to`: a place at an entity.
pub(crate) fn go_to(context: &QueryContext<'_>, id: &str, _budget: SearchBudget) -> MotionAnswer {
    let unknown = |why: String| MotionAnswer::Unknown(UnknownReason::Because(why));
    let Some((index, entity)) = context.entity(id) else { return unknown(format!("there is no `{id}`")) };
    let Some(pose) = context.state.pose(entity) else {
        return unknown(format!("the pose of `{id}` is unknown"));
    };
    if !context.model.drives() {
        return unknown("the robot's base does not drive".into());
    }
    let reach = context.served_within(entity);
    let centre = pose.translation.vector;
    let far = context.far_from(index, entity, [centre.x, centre.y]);
    let start = &context.state.robot;
    let [start_x, start_y, _] = start.base;
    if far(start_x, start_y) <= reach && context.contact(start, AllowedCollisions::default()).is_none() {
        return gone(context, vec![start.clone()]);
    }
    let towards = libm::atan2(start_y - centre.y, start_x - centre.x);
    let (mut met, mut is_free_somewhere) = (ContactTally::default(), false);
    for share in [1.0, 0.9, 0.8, 0.65, 0.5, 0.35, 0.2, 0.0] {
        for step in 0..DIRECTIONS {
            // From the robot's side outwards, alternating.
            let turn = step.div_ceil(2) as f64 * if step % 2 == 0 { 1.0 } else { -1.0 };
            let angle = towards + turn * std::f64::consts::TAU / DIRECTIONS as f64;
            let (sin, cos) = libm::sincos(angle);
            let Some(out) = along(|out| far(centre.x + cos * out, centre.y + sin * out), reach * share)
            else {
                continue;
            };
            let yaw = crate::trigonometry::wrapped(angle + std::f64::consts::PI);
            let place = start.at([centre.x + cos * out, centre.y + sin * out, yaw]);
            if context.is_drivable(&place)
                && let Some(path) = context.drive(&place)
            {
                return gone(context, path);
            }
            if let Some(contact) = context.contact(&place, AllowedCollisions::default()) {
                met.add(&contact);
                continue;
            }
            is_free_somewhere = true;
            for back in BACK {
                let [x, y, yaw] = place.base;
                let before = place.at([x + cos * back, y + sin * back, yaw]);
                if context.is_drivable(&before)
                    && context
                        .edge(&before, &place, AllowedCollisions::default())
                        .map_err(|contact| met.add(&contact))
                        .is_ok()
                    && let Some(mut path) = context.drive(&before)
                {
                    let last = path.last().unwrap_or(start).clone();
                    path.push(place.after(&last));
                    return gone(context, path);
                }
            }
        }
    }
    let reason = if is_free_somewhere { InfeasibleReason::BlockedPath { by: None } } else { met.none_free() };
    let certified = context.is_shut_off([centre.x, centre.y], reach, far);
    MotionAnswer::Infeasible(Infeasible { certified, ..Infeasible::exhausted(reason) })
}

/// Answers `stand_at`: a route to a pose of the base.
pub(crate) fn stand_at(context: &QueryContext<'_>, pose: &MapPose) -> MotionAnswer {
    if !context.model.drives() {
        return MotionAnswer::Unknown(UnknownReason::Because("the robot's base does not drive".into()));
    }
    let start = &context.state.robot;
    let ([x, y, _], none) = (pose.xyz(), AllowedCollisions::default());
    let goal = start.at([x, y, crate::trigonometry::wrapped(pose.yaw())]);
    // Only an exact route counts: the base stands in this pose and no other.
    let far = |at_x: f64, at_y: f64| libm::hypot(at_x - x, at_y - y);
    let infeasible = |reason: InfeasibleReason| {
        let certified = context.is_shut_off([x, y], 0.0, far);
        MotionAnswer::Infeasible(Infeasible { certified, ..Infeasible::exhausted(reason) })
    };
    let mut met = ContactTally::default();
    if let Some(contact) = context.contact(&goal, none) {
        met.add(&contact);
        return infeasible(InfeasibleReason::NoFreePose { by: met.most(), share: None });
    }
    if context.is_drivable(&goal)
        && let Some(path) = context.drive(&goal)
    {
        return gone(context, path);
    }
    for (step, back) in (0..DIRECTIONS).flat_map(|step| BACK.map(|back| (step, back))) {
        let angle =
            pose.yaw() + std::f64::consts::PI + std::f64::consts::TAU * step as f64 / DIRECTIONS as f64;
        let (sin, cos) = libm::sincos(angle);
        let [x, y, yaw] = goal.base;
        let before = goal.at([x + cos * back, y + sin * back, yaw]);
        let comes_in = step == 0 || context.slides();
        if comes_in
            && context.is_drivable(&before)
            && context.edge(&before, &goal, none).map_err(|contact| met.add(&contact)).is_ok()
            && let Some(mut path) = context.drive(&before)
        {
            let last = path.last().unwrap_or(start).clone();
            path.push(goal.after(&last));
            return gone(context, path);
        }
    }
    infeasible(InfeasibleReason::BlockedPath { by: met.most() })
}

/// Answers `posture`: the arm to a posture of the card, with the base still.
pub(crate) fn to_posture(context: &QueryContext<'_>, name: &str) -> MotionAnswer {
    let start = &context.state.robot;
    let Some(joints) = context.model.posture(name, &start.joints) else {
        return MotionAnswer::Unknown(UnknownReason::Because(format!("the card has no posture `{name}`")));
    };
    let goal = Configuration { base: start.base, joints };
    let mut met = ContactTally::default();
    if let Some(contact) = context.contact(&goal, AllowedCollisions::default()) {
        met.add(&contact);
        return certain(InfeasibleReason::NoFreePose { by: met.most(), share: None }, None);
    }
    match context.unfold(start, &goal, &mut met) {
        Some(path) => gone(context, path),
        None => {
            MotionAnswer::Infeasible(Infeasible::exhausted(InfeasibleReason::BlockedPath { by: met.most() }))
        }
    }
}

fn gone(context: &QueryContext<'_>, path: Vec<Configuration>) -> MotionAnswer {
    let margins = context.margins(&path, AllowedCollisions::default());
    MotionAnswer::Feasible(Box::new(MotionWitness { path, grasp: None, margins }))
}

/// Greatest distance from the centre at which a 1-Lipschitz distance falls to `wanted`, by sphere tracing
/// from afar.
fn along(distance: impl Fn(f64) -> f64, wanted: f64) -> Option<f64> {
    let mut out = 12.0;
    for _ in 0..200 {
        let left = distance(out) - wanted;
        if left <= 1e-4 {
            // Rounded inwards, to stay within the wanted distance.
            return Some(out - 1e-4);
        }
        out -= left;
        if out < 0.0 {
            return None;
        }
    }
    None
}
