//! `reach`: a grasp of a thing, and a way of the whole robot to it.

use motet_robots::scene::Entity;
use nalgebra::{Isometry3, Vector3};

use super::answer::{Answer, Budget, Grasp, Infeasible, Margins, Reason, Side, Unknown, Witness};
use super::around::Around;
use super::grasp::{Hold, holds};
use super::grip::Grips;
use super::machine::Hand;
use super::obstacle::solid_shape;
use super::pull::away;
use super::room::Room;
use super::seek::{At, LAST, Sought};
use super::state::State;
use super::touch::Allowed;
use crate::collision::Solid;

/// How far before a thing the hand turns straight towards it, in m; the shorter where the longer does not do.
const BACK: [f64; 2] = [0.1, 0.05];
/// How finely holds are told apart by how much they point away from the robot.
const STEPS: usize = 20;

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
        let goal = Goal { id, entity, pose, thing, hand, allowed: Allowed { hand: Some(index), held: None } };
        let (mut all, span) = (all, self.span(hand));
        let grips = Grips::new(hand, &goal.thing, side, self.world.robot.base);
        if let Some(answer) = span.beyond(&goal.pose.translation.vector, id, &all)
            && grips.are_all(|tip, drift| span.is_beyond(tip, drift))
        {
            return answer;
        }
        // What the arm reaches in no way needs no search.
        all.retain(|hold| span.holds(&hold.map_from_tip));
        self.sort(&mut all, &goal);
        let tips: Vec<_> = all.iter().map(|hold| hold.map_from_tip).collect();
        let centre = goal.pose.translation;
        let grasp = hand.palm.abs().max(hand.fingers.abs()) + goal.thing.reach();
        let around = self.around([centre.x, centre.y], self.farthest(hand) + grasp + LAST);
        let sought = Sought {
            hand,
            tips,
            grips: Some(&grips),
            allowed: goal.allowed,
            around: &around,
            backs: &|tip| self.backs(tip, hand),
        };
        match self.seek(&sought, budget) {
            Ok((at, path)) => {
                let hold = match at {
                    At::Tip(at) => all.get(at).copied(),
                    At::Hold(hold) => Some(hold),
                };
                let Some(hold) = hold else { return Answer::Unknown(Unknown::Budget) };
                Answer::Feasible(Box::new(around.grasped(&goal, &hold, path)))
            }
            Err(none) => none,
        }
    }

    /// From a pose of the tip back to where the hand turns straight to it: against where its fingers point;
    /// else, where there is a base to do so, level or from above, or, where they point down, level past the thing between them.
    fn backs(&self, tip: &Isometry3<f64>, hand: &Hand) -> Vec<Vector3<f64>> {
        let away = away(tip, hand, 1.0);
        let [long, _] = BACK;
        let mut backs: Vec<_> = BACK.map(|back| away * back).to_vec();
        if !self.machine.drives() {
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
    fn sort(&self, holds: &mut Vec<Hold>, goal: &Goal<'_>) {
        let [x, y, _] = self.world.robot.base;
        let ahead = Vector3::new(goal.pose.translation.x - x, goal.pose.translation.y - y, 0.0);
        let far = (ahead.x * ahead.x + ahead.y * ahead.y).sqrt().max(1e-9);
        // In steps, so that what differs by rounding alone keeps its order; the best is the least.
        let step = |hold: &Hold| match hold.side {
            Side::Top => STEPS / 2,
            Side::Side | Side::Front => {
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

impl Around<'_, '_> {
    fn grasped(&self, goal: &Goal<'_>, hold: &Hold, path: Vec<State>) -> Witness {
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
}

/// What is to be grasped, and with what.
struct Goal<'a> {
    id: &'a str,
    entity: &'a Entity,
    pose: Isometry3<f64>,
    thing: Solid,
    hand: &'a Hand,
    allowed: Allowed,
}

pub(super) fn certain(reason: Reason, change: Option<String>) -> Answer {
    Answer::Infeasible(Infeasible::proven(reason, change))
}
