//! `offer`: the held object within a person's reach, with the base still.

use nalgebra::{Isometry3, Translation3, Vector3};

use super::put::put_down;
use crate::kinematics::{planar, quasi_random};
use crate::planning::context::QueryContext;
use crate::planning::query::{
    ContactTally, Infeasible, InfeasibleReason, MotionAnswer, ReachLength, SearchBudget, UnknownReason,
    exhausted,
};
use crate::planning::scene::{AllowedCollisions, Configuration, HeldObject, IkSolver};
use crate::planning::search::{SPACE, part};

/// Distance of the object from the person's middle, in m: beyond the body, within an arm's length.
const REACH: [f64; 2] = [0.3, 0.75];
/// Heights of the object as shares of the stature: between hip and shoulder.
const HEIGHTS: [f64; 2] = [0.42, 0.8];
/// Greatest tilt of the object: the cosine of 30°.
const UPRIGHT: f64 = 0.866;
/// Stature of a person without a shape, in m.
const STATURE: f64 = 1.7;

/// Answers `offer`: a configuration in which a person can take the held object.
pub(crate) fn offer(context: &QueryContext<'_>, id: &str, to: &str, budget: SearchBudget) -> MotionAnswer {
    let unknown = |why: String| MotionAnswer::Unknown(UnknownReason::Because(why));
    let Some(held) = context.held_object(id) else {
        return unknown(format!("the hand does not hold `{id}`"));
    };
    if let Some(answer) = context.unheld(&held) {
        return answer;
    }
    let Some((index, entity)) = context.entity(to) else { return unknown(format!("there is no `{to}`")) };
    let Some(pose) = context.state.pose(entity) else {
        return unknown(format!("the pose of `{to}` is unknown"));
    };
    let stature = context.solids_of(index).map(|solid| solid.centre.z + solid.extent(&Vector3::z()));
    let stature = stature.fold(0.0, f64::max);
    let stature = if stature > 0.5 { stature } else { STATURE };
    let person = pose.translation.vector;
    let heights = HEIGHTS.map(|share| share * stature);
    let takes = |at: &Isometry3<f64>| {
        let far = libm::hypot(at.translation.x - person.x, at.translation.y - person.y);
        let up = at.rotation * Vector3::z();
        (REACH[0]..=REACH[1]).contains(&far)
            && (heights[0]..=heights[1]).contains(&at.translation.z)
            && up.z >= UPRIGHT
    };
    let start = &context.state.robot;
    let [x, y, _] = start.base;
    let far = libm::hypot(person.x - x, person.y - y);
    let tip_reach = held.hand.card.reach_m + context.model.card().base.radius_m + 0.4;
    if far > tip_reach + REACH[1] {
        let reason = InfeasibleReason::OutOfReach {
            length: ReachLength::Distance,
            needs: far - REACH[1],
            reach: tip_reach,
        };
        let change = Some(format!("go to `{to}` first"));
        return MotionAnswer::Infeasible(Infeasible { change, ..Infeasible::exhausted(reason) });
    }
    let (mut poses, mut ways, mut tried) = (ContactTally::default(), ContactTally::default(), 0);
    for at in 0..budget.candidates.saturating_mul(8) {
        for (configuration, map_from_tip) in held_out(context, &held, heights, at) {
            if !takes(&(map_from_tip * held.tip_from_object)) {
                continue;
            }
            if let Some(contact) = context.contact(&configuration, AllowedCollisions::default()) {
                poses.add(&contact);
                continue;
            }
            tried += 1;
            if let Some(path) = context.unfold(start, &configuration, &mut ways) {
                let allowed = AllowedCollisions::default();
                return MotionAnswer::Feasible(Box::new(put_down(
                    context,
                    &held,
                    path,
                    map_from_tip,
                    allowed,
                )));
            }
            if tried >= budget.paths {
                return MotionAnswer::Unknown(UnknownReason::Budget);
            }
        }
    }
    exhausted(tried > 0, &poses, &ways)
}

/// Configurations with the object about upright and the base still, with the pose of the tip.
fn held_out(
    context: &QueryContext<'_>,
    held: &HeldObject<'_>,
    heights: [f64; 2],
    at: usize,
) -> Vec<(Configuration, Isometry3<f64>)> {
    let start = &context.state.robot;
    let [x, y, yaw] = start.base;
    let chain = held.hand.solver.chain();
    let with = |values: &[f64]| {
        let mut configuration = start.clone();
        for (at, value) in chain.in_tree.iter().zip(values) {
            if let Some(slot) = configuration.joints.get_mut(*at) {
                *slot = *value;
            }
        }
        configuration
    };
    let tip = |configuration: &Configuration| {
        context.model.map_from_links(configuration).get(held.hand.tip).copied()
    };
    let IkSolver::Lift(arm) = &held.hand.solver else {
        let configuration = with(&quasi_random(&chain.dofs, at));
        return tip(&configuration).map(|tip| (configuration, tip)).into_iter().collect();
    };
    // Solved with the base free, then moved as a whole so that the base is where it is.
    let (lower, upper) = arm.shoulder_span();
    let height = heights[0] + part(at, 3, SPACE) * (heights[1] - heights[0]);
    let object = Isometry3::from_parts(Translation3::new(0.0, 0.0, height), Default::default());
    let wanted = object * held.tip_from_object.inverse();
    let turn = (part(at, 1, SPACE) - 0.5) * std::f64::consts::TAU;
    let placed = arm.solve(&wanted, turn, lower + part(at, 2, SPACE) * (upper - lower));
    let configurations = placed.into_iter().map(|placed| {
        let [from_x, from_y, from_yaw] = placed.base;
        let moved = planar(x, y, yaw) * planar(from_x, from_y, from_yaw).inverse();
        (with(&placed.values), moved * wanted)
    });
    configurations.collect()
}
