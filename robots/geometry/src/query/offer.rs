//! `offer`: what is in the hand held out to a person, the base where it is.

use nalgebra::{Isometry3, Translation3, Vector3};

use super::answer::{Answer, Budget, Infeasible, Reason, Unknown};
use super::arm::{SPACE, part};
use super::room::Room;
use super::solver::Solver;
use super::state::State;
use super::touch::Allowed;
use super::travel::{Tally, exhausted};
use super::world::Held;
use crate::kinematics::{planar, quasi_random};

/// How far from a person's middle a thing may be held out, in m: beyond the body, within an arm's length.
const REACH: [f64; 2] = [0.3, 0.75];
/// How high, as shares of the stature: between the hip and the shoulder.
const HEIGHTS: [f64; 2] = [0.42, 0.8];
/// How much a thing may be tilted: the cosine of 30°.
const UPRIGHT: f64 = 0.866;
/// The stature where the shape does not say, in m.
const STATURE: f64 = 1.7;

impl Room<'_> {
    /// A pose of the hand in which a person can take what it holds.
    pub(super) fn offer(&self, id: &str, to: &str, budget: Budget) -> Answer {
        let unknown = |why: String| Answer::Unknown(Unknown::Because(why));
        let Some(held) = self.held_thing(id) else {
            return unknown(format!("the hand does not hold `{id}`"));
        };
        let Some((index, entity)) = self.entity(to) else { return unknown(format!("there is no `{to}`")) };
        let Some(pose) = self.world.pose(entity) else {
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
        let start = &self.world.robot;
        let [x, y, _] = start.base;
        let far = libm::hypot(person.x - x, person.y - y);
        let tip_reach = held.hand.card.reach_m + self.machine.card().base.radius_m + 0.4;
        if far > tip_reach + REACH[1] {
            let reason = Reason::OutOfReach { what: "distance", needs: far - REACH[1], reach: tip_reach };
            let change = Some(format!("go to `{to}` before"));
            return Answer::Infeasible(Infeasible { reason, change, certified: false, state: None });
        }
        let (mut poses, mut ways, mut tried) = (Tally::default(), Tally::default(), 0);
        for at in 0..budget.candidates.saturating_mul(8) {
            for (state, map_from_tip) in self.held_out(&held, heights, at) {
                if !takes(&(map_from_tip * held.tip_from_object)) {
                    continue;
                }
                if let Some(touch) = self.touch(&state, Allowed::default()) {
                    poses.add(&touch);
                    continue;
                }
                tried += 1;
                if let Some(path) = self.unfold(start, &state, &mut ways) {
                    let allowed = Allowed::default();
                    return Answer::Feasible(Box::new(self.put_down(&held, path, map_from_tip, allowed)));
                }
                if tried >= budget.paths {
                    return Answer::Unknown(Unknown::Budget);
                }
            }
        }
        exhausted(tried > 0, &poses, &ways)
    }

    /// States with the base where it is and the thing upright, or nearly so, and where the hand's tip then is.
    fn held_out(&self, held: &Held<'_>, heights: [f64; 2], at: usize) -> Vec<(State, Isometry3<f64>)> {
        let start = &self.world.robot;
        let [x, y, yaw] = start.base;
        let chain = held.hand.solver.chain();
        let with = |values: &[f64]| {
            let mut state = start.clone();
            for (at, value) in chain.in_tree.iter().zip(values) {
                if let Some(slot) = state.joints.get_mut(*at) {
                    *slot = *value;
                }
            }
            state
        };
        let tip = |state: &State| self.machine.map_from_links(state).get(held.hand.tip).copied();
        let Solver::Lift(arm) = &held.hand.solver else {
            let state = with(&quasi_random(&chain.dofs, at));
            return tip(&state).map(|tip| (state, tip)).into_iter().collect();
        };
        // Solved anywhere with the thing upright, then moved as one so that the base is where it is.
        let (lower, upper) = arm.shoulder_span();
        let height = heights[0] + part(at, 3, SPACE) * (heights[1] - heights[0]);
        let object = Isometry3::from_parts(Translation3::new(0.0, 0.0, height), Default::default());
        let wanted = object * held.tip_from_object.inverse();
        let turn = (part(at, 1, SPACE) - 0.5) * std::f64::consts::TAU;
        let placed = arm.solve(&wanted, turn, lower + part(at, 2, SPACE) * (upper - lower));
        let states = placed.into_iter().map(|placed| {
            let [from_x, from_y, from_yaw] = placed.base;
            let moved = planar(x, y, yaw) * planar(from_x, from_y, from_yaw).inverse();
            (with(&placed.values), moved * wanted)
        });
        states.collect()
    }
}
