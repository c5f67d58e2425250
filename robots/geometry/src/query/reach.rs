//! `reach`: a grasp of a thing, and a way of the whole robot to it.

use motet_robots::scene::Entity;
use nalgebra::{Isometry3, Vector3};

use super::answer::{Answer, Budget, Grasp, Infeasible, Margins, Reason, Side, Unknown, Witness};
use super::grasp::{Hold, holds};
use super::machine::{Hand, Solver};
use super::obstacle::solid_shape;
use super::room::{GAP, Room};
use super::state::State;
use super::touch::{Allowed, Touch};
use super::travel::{Tally, exhausted};
use crate::collision::Solid;

/// How far before a thing the hand turns straight towards it, in m; the shorter where the longer does not do.
const BACK: [f64; 2] = [0.1, 0.05];

impl Room<'_> {
    /// A grasp of an entity.
    pub(super) fn reach(&self, id: &str, side: Option<Side>, budget: Budget) -> Answer {
        let unknown = |why: String| Answer::Unknown(Unknown::Because(why));
        let Some((index, entity)) = self.entity(id) else { return unknown(format!("there is no `{id}`")) };
        let Some(hand) = self.machine.hand() else {
            return unknown("the card names no hand with a tip".into());
        };
        let Some((pose, shape)) = self.world.pose(entity).zip(solid_shape(entity)) else {
            return unknown(format!("the place or the shape of `{id}` is not known"));
        };
        if let Some((held, _)) = &self.world.held {
            return unknown(format!("the hand holds `{held}`"));
        }
        if let Some(mass) = entity.mass_kg.filter(|mass| *mass > hand.card.payload_kg) {
            return certain(Reason::TooHeavy { needs: mass, limit: hand.card.payload_kg }, None);
        }
        let thing = Solid::new(&pose, shape);
        let (all, least) = holds(hand, &thing, side, self.world.robot.base);
        if least > hand.card.opening_m {
            return certain(Reason::TooWide { needs: least, limit: hand.card.opening_m }, None);
        }
        if all.is_empty() && side.is_none() {
            return unknown(format!(
                "no place between the fingers of `{}` is known for its shape",
                hand.name
            ));
        }
        let goal = Goal { id, entity, pose, hand, allowed: Allowed { hand: Some(index), held: None } };
        if let Some(answer) = self.beyond(&goal, &all) {
            return answer;
        }
        match self.free_holds(hand, &all, goal.allowed) {
            Ok(free) => self.search(&goal, &free, budget),
            Err(none) => none,
        }
    }

    /// The holds in which the hand alone touches nothing. It names what is in the way of every arm.
    ///
    /// # Errors
    ///
    /// The answer where there is none.
    pub(super) fn free_holds<'h>(
        &self,
        hand: &Hand,
        all: &'h [Hold],
        allowed: Allowed,
    ) -> Result<Vec<&'h Hold>, Answer> {
        let mut met = Tally::default();
        let free: Vec<&Hold> = all
            .iter()
            .filter(|hold| match self.hand_touch(hand, &hold.map_from_tip, allowed) {
                Some(touch) => {
                    met.add(&touch);
                    false
                }
                None => true,
            })
            .collect();
        if free.is_empty() {
            let reason = Reason::NoFreePose { by: met.most() };
            return Err(Answer::Infeasible(Infeasible { reason, change: None, certified: !all.is_empty() }));
        }
        Ok(free)
    }

    fn search(&self, goal: &Goal<'_>, holds: &[&Hold], budget: Budget) -> Answer {
        let (mut poses, mut ways) = (Tally::default(), Tally::default());
        let (mut tried, mut is_cut_off) = (0, false);
        for at in 0..budget.candidates {
            for hold in holds {
                for state in self.candidates(goal.hand, &hold.map_from_tip, at) {
                    if let Some(touch) = self.touch(&state, goal.allowed) {
                        poses.add(&touch);
                        continue;
                    }
                    if !self.is_near_drivable(&state) {
                        is_cut_off = true;
                        continue;
                    }
                    tried += 1;
                    if let Some(path) = self.way_to(goal, hold, &state, &mut ways) {
                        return Answer::Feasible(Box::new(self.witness(goal, hold, path)));
                    }
                    if tried >= budget.paths {
                        return Answer::Unknown(Unknown::Budget);
                    }
                }
            }
        }
        exhausted(tried > 0 || is_cut_off, &poses, &ways)
    }

    /// A way from where the robot is to a state that holds the thing.
    fn way_to(&self, goal: &Goal<'_>, hold: &Hold, state: &State, met: &mut Tally) -> Option<Vec<State>> {
        BACK.into_iter().find_map(|back| {
            let line = self.approach(goal.hand, state, &hold.map_from_tip, back)?;
            let inwards = line.first()?.inwards(&goal.pose.translation.vector);
            self.route_along(&line, inwards, goal.allowed, met)
        })
    }

    fn witness(&self, goal: &Goal<'_>, hold: &Hold, path: Vec<State>) -> Witness {
        let grasp = Grasp {
            object: goal.id.into(),
            side: hold.side,
            map_from_tip: hold.map_from_tip,
            tip_from_object: hold.map_from_tip.inverse() * goal.pose,
            width: hold.width,
        };
        let payload = goal.entity.mass_kg.map(|mass| goal.hand.card.payload_kg - mass);
        let margins = Margins { payload, ..self.margins(&path, goal.allowed) };
        Witness { path, grasp: Some(grasp), margins }
    }

    /// Room to spare along a path.
    pub(super) fn margins(&self, path: &[State], allowed: Allowed) -> Margins {
        let between = path.windows(2).filter_map(|pair| match pair {
            [one, other] => Some(one.towards(other, 0.5)),
            _ => None,
        });
        let all = path.iter().cloned().chain(between);
        let clearance = all.map(|state| self.clearance(&state, allowed)).fold(1.0, f64::min);
        let variables = self.machine.tree().variables().iter();
        // An open hand is at its limit by intent.
        let is_finger =
            |at: &usize| self.machine.hand().is_some_and(|hand| hand.open.iter().any(|(own, _)| own == at));
        let ends = path.first().zip(path.last());
        let rooms = ends.into_iter().flat_map(|(first, last)| {
            let values = first.joints.iter().zip(&last.joints).zip(variables.clone());
            let moved =
                values.zip(0..).filter(|(((before, after), _), at)| before != after && !is_finger(at));
            moved.map(|(it, _)| it).map(|((_, after), known)| known.room(*after))
        });
        Margins { clearance, limit: rooms.reduce(f64::min), payload: None }
    }

    /// What the hand alone touches at a pose of its tip.
    pub(super) fn hand_touch(
        &self,
        hand: &Hand,
        map_from_tip: &Isometry3<f64>,
        allowed: Allowed,
    ) -> Option<Touch> {
        let poses = self.machine.tree().root_from_links(&hand.opened(&self.world.robot.joints));
        let map_from_root = map_from_tip * poses.get(hand.tip)?.inverse();
        let floor = Solid::floor();
        let parts = self.body.parts().iter().filter(|part| hand.members.get(part.link) == Some(&true));
        for part in parts {
            let solid = part.solid.moved(&(map_from_root * poses.get(part.link)?));
            let link = || self.machine.tree().links().get(part.link).cloned().unwrap_or_default();
            for thing in self.things.iter().filter(|thing| allowed.hand != Some(thing.entity)) {
                if !solid.is_farther(&thing.solid, GAP) {
                    return Some(Touch { link: link(), other: self.name(thing.entity), is_own: false });
                }
            }
            if !solid.is_farther(&floor, GAP) {
                return Some(Touch { link: link(), other: "floor".into(), is_own: false });
            }
        }
        None
    }

    /// That no arm configuration brings the hand there, whatever stands around, where that is certain.
    fn beyond(&self, goal: &Goal<'_>, holds: &[Hold]) -> Option<Answer> {
        if let Solver::Lift(arm) = &goal.hand.solver {
            let [least, greatest] = arm.heights();
            let centres = holds.iter().map(|hold| arm.centre(&hold.map_from_tip).z);
            let (low, high) =
                centres.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| (low.min(z), high.max(z)));
            if holds.is_empty() || (low <= greatest && high >= least) {
                return None;
            }
            // In terms of the thing's height: the wrist is so much above or below it.
            let (height, off) =
                (goal.pose.translation.z, if low > greatest { low - greatest } else { high - least });
            let change = if off > 0.0 { "lower" } else { "higher" };
            let change = format!("{:.2} m {change}, `{}` would be within reach", off.abs(), goal.id);
            return Some(certain(
                Reason::OutOfReach { what: "height", needs: height, reach: height - off },
                Some(change),
            ));
        }
        if self.machine.drives() {
            return None;
        }
        let chain = goal.hand.solver.chain();
        let [x, y, yaw] = self.world.robot.base;
        let height = self.machine.card().model.as_ref().map_or(0.0, |model| model.height_m);
        let first = chain.joints.first()?;
        let shoulder = crate::kinematics::planar(x, y, yaw)
            * nalgebra::Point3::from(first.before.translation.vector + Vector3::new(0.0, 0.0, height));
        let shoulder = shoulder.coords;
        let links = chain.joints.iter().skip(1).map(|joint| joint.before.translation.vector.norm());
        let slides = chain.joints.iter().filter(|joint| joint.slides).map(|joint| {
            let limits = chain.variables.get(joint.driver.variable).and_then(|known| known.limits);
            limits.map_or(f64::INFINITY, |(lower, upper)| {
                lower.abs().max(upper.abs()) * joint.driver.multiplier.abs()
            })
        });
        let reach = links.chain(slides).sum::<f64>() + chain.last_from_tip.translation.vector.norm();
        let needs = holds.iter().map(|hold| (hold.map_from_tip.translation.vector - shoulder).norm());
        let needs = needs.fold(f64::INFINITY, f64::min);
        (needs.is_finite() && needs > reach)
            .then(|| certain(Reason::OutOfReach { what: "distance", needs, reach }, None))
    }
}

/// What is to be grasped, and with what.
struct Goal<'a> {
    id: &'a str,
    entity: &'a Entity,
    pose: Isometry3<f64>,
    hand: &'a Hand,
    allowed: Allowed,
}

pub(super) fn certain(reason: Reason, change: Option<String>) -> Answer {
    Answer::Infeasible(Infeasible { reason, change, certified: true })
}
