//! `push`: what is open closed by its handle; any other thing a little away from the robot with the closed hand.

use nalgebra::{Isometry3, Translation3, Vector3};

use super::answer::{Answer, Budget, Grasp, Infeasible, Margins, Reason, Side, Unknown, Witness};
use super::machine::Hand;
use super::obstacle::solid_shape;
use super::room::{GAP, Room};
use super::shrunk::{Placed, inner};
use super::state::State;
use super::things::Thing;
use super::touch::Allowed;
use super::travel::{Tally, exhausted};
use crate::collision::Solid;
use crate::trigonometry::turn;

/// How far a thing is pushed, in m.
const FAR: f64 = 0.1;
/// How far before the thing the hand begins, in m.
const BEFORE: f64 = 0.003;
/// Directions in which it is pushed, as angles in rad from straight away from the robot.
const ASIDE: [f64; 7] = [0.0, 0.26, -0.26, 0.52, -0.52, 0.78, -0.78];
/// Places on its way at which it is looked whether it runs into something.
const PLACES: u32 = 16;

impl Room<'_> {
    /// What is open closed; any other thing pushed away.
    pub(super) fn push(&self, id: &str, budget: Budget) -> Answer {
        let unknown = |why: String| Answer::Unknown(Unknown::Because(why));
        let Some((index, entity)) = self.entity(id) else { return unknown(format!("there is no `{id}`")) };
        if entity.travel.is_some() {
            return self.pull(id, [1.0, 0.0], budget);
        }
        let Some(hand) = self.machine.hand() else {
            return unknown("the card names no hand with a tip".into());
        };
        if let Some((held, _)) = &self.world.held {
            return unknown(format!("the hand holds `{held}`"));
        }
        if entity.fixed || entity.kind == "Person" {
            return unknown(format!("`{id}` is nothing to be pushed away"));
        }
        let Some((pose, shape)) = self.world.pose(entity).zip(solid_shape(entity)) else {
            return unknown(format!("the place or the shape of `{id}` is not known"));
        };
        let thing = Solid::new(&pose, shape);
        let support = self.support(index);
        let is_other = |it: &&Thing| it.entity != index && Some(it.entity) != support;
        let [x, y, _] = self.world.robot.base;
        let (dx, dy) = (thing.centre.x - x, thing.centre.y - y);
        let far = libm::hypot(dx, dy).max(1e-9);
        let ahead = Vector3::new(dx / far, dy / far, 0.0);
        let front = self.front_around(hand, 0.0);
        let (mut met, mut ends) = (Tally::default(), Vec::new());
        for aside in ASIDE {
            let along = turn(&Vector3::z_axis(), aside) * ahead;
            let stops = (1..=PLACES).find_map(|at| {
                let gone =
                    Isometry3::from(Translation3::from(along * (FAR * f64::from(at) / f64::from(PLACES))));
                let moved = thing.moved(&gone);
                let near = self.things.near([moved.centre.x, moved.centre.y], moved.reach());
                let mut others = near.map(|(_, it)| it).filter(is_other);
                others.find(|it| !moved.is_farther(&it.solid, 0.0)).map(|it| self.name(it.entity))
            });
            if let Some(by) = stops {
                met.add_entity(by);
                continue;
            }
            let closes = along.cross(&Vector3::z());
            for closes in [closes, -closes, Vector3::z(), -Vector3::z()] {
                let begin = thing.centre - along * (thing.extent(&along) + front + BEFORE);
                let rotation = hand.turned(&along, &closes);
                ends.push((along, Isometry3::from_parts(Translation3::from(begin + along * FAR), rotation)));
            }
        }
        if ends.is_empty() {
            let reason = Reason::BlockedPath { by: met.most() };
            let others: Vec<_> = self.things.iter().filter(is_other).collect();
            return Answer::Infeasible(if is_walled_in(&thing, &others, &ahead) {
                Infeasible::proven(reason, None)
            } else {
                Infeasible::exhausted(reason)
            });
        }
        let tips: Vec<_> = ends.iter().map(|(_, end)| *end).collect();
        if let Some((reason, change)) =
            self.span(hand).beyond_all(&pose.translation.vector, &format!("`{id}`"), &tips)
        {
            return Answer::Infeasible(Infeasible { change, ..Infeasible::exhausted(reason) });
        }
        let allowed = Allowed { hand: Some(index), held: None };
        let (mut poses, mut ways, mut tried) = (Tally::default(), Tally::default(), 0);
        for at in 0..budget.candidates {
            for (along, map_from_tip) in &ends {
                for state in self.candidates(hand, map_from_tip, at) {
                    let state = State {
                        base: state.base,
                        joints: hand.around(&state.joints, self.machine.rest(), 0.0),
                    };
                    if let Some(touch) = self.touch(&state, allowed) {
                        poses.add(&touch);
                        continue;
                    }
                    tried += 1;
                    if let Some(path) = self.way_along(hand, &state, map_from_tip, along, allowed, &mut ways)
                    {
                        let grasp = Some(Grasp {
                            object: id.into(),
                            side: Side::Side,
                            map_from_tip: *map_from_tip,
                            tip_from_object: map_from_tip.inverse() * Translation3::from(along * FAR) * pose,
                            width: 0.0,
                        });
                        let margins = Margins { payload: None, ..self.margins(&path, allowed) };
                        return Answer::Feasible(Box::new(Witness { path, grasp, margins }));
                    }
                    if tried >= budget.paths {
                        return Answer::Unknown(Unknown::Budget);
                    }
                }
            }
        }
        exhausted(tried > 0, &poses, &ways)
    }

    /// A way to a state, the last part straight along the push.
    fn way_along(
        &self,
        hand: &Hand,
        state: &State,
        map_from_tip: &Isometry3<f64>,
        along: &Vector3<f64>,
        allowed: Allowed,
        met: &mut Tally,
    ) -> Option<Vec<State>> {
        let line = self.line(hand, state, map_from_tip, &(along * -FAR))?;
        // The fingers of a line are open; these are closed.
        let closed =
            |it: &State| State { base: it.base, joints: hand.around(&it.joints, self.machine.rest(), 0.0) };
        let line: Vec<State> = line.iter().map(closed).collect();
        self.route_along(&line, [along.x, along.y], allowed, met)
    }

    /// How far the hand reaches in front of its tip with its fingers closed around something so wide, in m.
    pub(super) fn front_around(&self, hand: &Hand, width: f64) -> f64 {
        let rest = self.machine.rest();
        let poses = self.machine.tree().root_from_links(&hand.around(rest, rest, width));
        let tip_from_root = poses.get(hand.tip).copied().unwrap_or_default().inverse();
        let points = Vector3::from(hand.card.points);
        let parts = self.machine.body().parts().iter().filter(|it| hand.members.get(it.link) == Some(&true));
        let ends = parts.filter_map(|part| {
            let solid = part.solid.moved(&(tip_from_root * poses.get(part.link)?));
            Some(solid.centre.dot(&points) + solid.extent(&points))
        });
        ends.fold(0.0, f64::max)
    }
}

/// Whether a thing runs into another in whatever direction it is pushed, of all those between which some are tried.
fn is_walled_in(thing: &Solid, others: &[&Thing], ahead: &Vector3<f64>) -> bool {
    const DEPTH: u32 = 8;
    let most = ASIDE.iter().copied().fold(0.0, f64::max);
    let mut open = vec![(0.0, most, 0)];
    while let Some((aside, half, depth)) = open.pop() {
        let along = turn(&Vector3::z_axis(), aside) * ahead;
        let is_stopped = (1..=PLACES).any(|at| {
            let gone = FAR * f64::from(at) / f64::from(PLACES);
            let solid = thing.moved(&Isometry3::from(Translation3::from(along * gone)));
            // Smaller by the gap too, since it may go along something.
            let drift = gone * half + GAP;
            let placed = Placed { solid, inner: inner(&solid), reach: solid.reach(), drift };
            others.iter().any(|it| placed.touches(&it.solid, inner(&it.solid), it.reach, drift))
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
