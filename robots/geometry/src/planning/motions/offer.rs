//! `offer`: what is in the hand held out to a person, the base where it is.

use nalgebra::{Isometry3, Translation3, Vector3};

use crate::kinematics::{planar, quasi_random};
use crate::planning::query::answer::{
    Infeasible, InfeasibleReason, MotionAnswer, SearchBudget, UnknownReason,
};
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::AllowedCollisions;
use crate::planning::scene::ik_solver::IkSolver;
use crate::planning::scene::scene_state::HeldObject;
use crate::planning::search::arm_candidates::{SPACE, part};
use crate::planning::search::context::QueryContext;
use crate::planning::search::path::{ContactTally, exhausted};

/// How far from a person's middle a thing may be held out, in m: beyond the body, within an arm's length.
const REACH: [f64; 2] = [0.3, 0.75];
/// How high, as shares of the stature: between the hip and the shoulder.
const HEIGHTS: [f64; 2] = [0.42, 0.8];
/// How much a thing may be tilted: the cosine of 30°.
const UPRIGHT: f64 = 0.866;
/// The stature where the shape does not say, in m.
const STATURE: f64 = 1.7;

impl QueryContext<'_> {
    /// A pose of the hand in which a person can take what it holds.
    pub(crate) fn offer(&self, id: &str, to: &str, budget: SearchBudget) -> MotionAnswer {
        let unknown = |why: String| MotionAnswer::Unknown(UnknownReason::Because(why));
        let Some(held) = self.held_thing(id) else {
            return unknown(format!("the hand does not hold `{id}`"));
        };
        let Some((index, entity)) = self.entity(to) else { return unknown(format!("there is no `{to}`")) };
        let Some(pose) = self.state.pose(entity) else {
            return unknown(format!("the place of `{to}` is not known"));
        };
        let stature = self.solids_of(index).map(|solid| solid.centre.z + solid.extent(&Vector3::z()));
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
        let start = &self.state.robot;
        let [x, y, _] = start.base;
        let far = libm::hypot(person.x - x, person.y - y);
        let tip_reach = held.hand.card.reach_m + self.model.card().base.radius_m + 0.4;
        if far > tip_reach + REACH[1] {
            let reason =
                InfeasibleReason::OutOfReach { what: "distance", needs: far - REACH[1], reach: tip_reach };
            let change = Some(format!("go to `{to}` before"));
            return MotionAnswer::Infeasible(Infeasible {
                reason,
                change,
                certified: false,
                configuration: None,
            });
        }
        let (mut poses, mut ways, mut tried) = (ContactTally::default(), ContactTally::default(), 0);
        for at in 0..budget.candidates.saturating_mul(8) {
            for (configuration, map_from_tip) in self.held_out(&held, heights, at) {
                if !takes(&(map_from_tip * held.tip_from_object)) {
                    continue;
                }
                if let Some(contact) = self.contact(&configuration, AllowedCollisions::default()) {
                    poses.add(&contact);
                    continue;
                }
                tried += 1;
                if let Some(path) = self.unfold(start, &configuration, &mut ways) {
                    let allowed = AllowedCollisions::default();
                    return MotionAnswer::Feasible(Box::new(self.put_down(
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

    /// States with the base where it is and the thing upright, or nearly so, and where the hand's tip then is.
    fn held_out(
        &self,
        held: &HeldObject<'_>,
        heights: [f64; 2],
        at: usize,
    ) -> Vec<(Configuration, Isometry3<f64>)> {
        let start = &self.state.robot;
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
            self.model.map_from_links(configuration).get(held.hand.tip).copied()
        };
        let IkSolver::Lift(arm) = &held.hand.solver else {
            let configuration = with(&quasi_random(&chain.dofs, at));
            return tip(&configuration).map(|tip| (configuration, tip)).into_iter().collect();
        };
        // Solved anywhere with the thing upright, then moved as one so that the base is where it is.
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
}
