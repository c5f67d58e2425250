//! `push`: what is open closed by its handle; any other thing a little away from the robot with the closed hand.

use nalgebra::{Isometry3, Translation3, Vector3};

use crate::collision::Solid;
use crate::planning::certify::deflate::{DeflatedPart, inner};
use crate::planning::query::answer::{
    Grasp, GraspSide, Infeasible, InfeasibleReason, Margins, MotionAnswer, MotionWitness, SearchBudget,
    UnknownReason,
};
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::AllowedCollisions;
use crate::planning::scene::contact::MIN_CLEARANCE;
use crate::planning::scene::grid_index::Obstacle;
use crate::planning::scene::obstacle::solid_shape;
use crate::planning::scene::robot_model::HandModel;
use crate::planning::search::context::QueryContext;
use crate::planning::search::path::{ContactTally, exhausted};
use crate::trigonometry::turn;

/// How far a thing is pushed, in m.
const FAR: f64 = 0.1;
/// How far before the thing the hand begins, in m.
const BEFORE: f64 = 0.003;
/// Directions in which it is pushed, as angles in rad from straight away from the robot.
const ASIDE: [f64; 7] = [0.0, 0.26, -0.26, 0.52, -0.52, 0.78, -0.78];
/// Places on its way at which it is looked whether it runs into something.
const PLACES: u32 = 16;

impl QueryContext<'_> {
    /// What is open closed; any other thing pushed away.
    pub(crate) fn push(&self, id: &str, budget: SearchBudget) -> MotionAnswer {
        let unknown = |why: String| MotionAnswer::Unknown(UnknownReason::Because(why));
        let Some((index, entity)) = self.entity(id) else { return unknown(format!("there is no `{id}`")) };
        if entity.travel.is_some() {
            return self.pull(id, [1.0, 0.0], budget);
        }
        let Some(hand) = self.model.hand() else {
            return unknown("the card names no hand with a tip".into());
        };
        if let Some((held, _)) = &self.state.held {
            return unknown(format!("the hand holds `{held}`"));
        }
        if entity.fixed || entity.kind == "Person" {
            return unknown(format!("`{id}` is nothing to be pushed away"));
        }
        let Some((pose, shape)) = self.state.pose(entity).zip(solid_shape(entity)) else {
            return unknown(format!("the place or the shape of `{id}` is not known"));
        };
        let object = Solid::new(&pose, shape);
        let support = self.support(index);
        let is_other = |it: &&Obstacle| it.entity != index && Some(it.entity) != support;
        let [x, y, _] = self.state.robot.base;
        let (dx, dy) = (object.centre.x - x, object.centre.y - y);
        let far = libm::hypot(dx, dy).max(1e-9);
        let ahead = Vector3::new(dx / far, dy / far, 0.0);
        let front = self.front_around(hand, 0.0);
        let (mut met, mut ends) = (ContactTally::default(), Vec::new());
        for aside in ASIDE {
            let along = turn(&Vector3::z_axis(), aside) * ahead;
            let stops = (1..=PLACES).find_map(|at| {
                let gone =
                    Isometry3::from(Translation3::from(along * (FAR * f64::from(at) / f64::from(PLACES))));
                let moved = object.moved(&gone);
                let near = self.obstacles.near([moved.centre.x, moved.centre.y], moved.reach());
                let mut others = near.map(|(_, it)| it).filter(is_other);
                others.find(|it| !moved.is_farther(&it.solid, 0.0)).map(|it| self.name(it.entity))
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
            let others: Vec<_> = self.obstacles.iter().filter(is_other).collect();
            return MotionAnswer::Infeasible(if is_walled_in(&object, &others, &ahead) {
                Infeasible::proven(reason, None)
            } else {
                Infeasible::exhausted(reason)
            });
        }
        let tips: Vec<_> = ends.iter().map(|(_, end)| *end).collect();
        if let Some((reason, change)) =
            self.span(hand).beyond_all(&pose.translation.vector, &format!("`{id}`"), &tips)
        {
            return MotionAnswer::Infeasible(Infeasible { change, ..Infeasible::exhausted(reason) });
        }
        let allowed = AllowedCollisions { hand: Some(index), held: None };
        let (mut poses, mut ways, mut tried) = (ContactTally::default(), ContactTally::default(), 0);
        for at in 0..budget.candidates {
            for (along, map_from_tip) in &ends {
                for configuration in self.candidates(hand, map_from_tip, at) {
                    let configuration = Configuration {
                        base: configuration.base,
                        joints: hand.around(&configuration.joints, self.model.rest(), 0.0),
                    };
                    if let Some(contact) = self.contact(&configuration, allowed) {
                        poses.add(&contact);
                        continue;
                    }
                    tried += 1;
                    if let Some(path) =
                        self.way_along(hand, &configuration, map_from_tip, along, allowed, &mut ways)
                    {
                        let grasp = Some(Grasp {
                            object: id.into(),
                            side: GraspSide::Side,
                            map_from_tip: *map_from_tip,
                            tip_from_object: map_from_tip.inverse() * Translation3::from(along * FAR) * pose,
                            width: 0.0,
                        });
                        let margins = Margins { payload: None, ..self.margins(&path, allowed) };
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

    /// A way to a state, the last part straight along the push.
    fn way_along(
        &self,
        hand: &HandModel,
        configuration: &Configuration,
        map_from_tip: &Isometry3<f64>,
        along: &Vector3<f64>,
        allowed: AllowedCollisions,
        met: &mut ContactTally,
    ) -> Option<Vec<Configuration>> {
        let line = self.line(hand, configuration, map_from_tip, &(along * -FAR))?;
        // The fingers of a line are open; these are closed.
        let closed = |it: &Configuration| Configuration {
            base: it.base,
            joints: hand.around(&it.joints, self.model.rest(), 0.0),
        };
        let line: Vec<Configuration> = line.iter().map(closed).collect();
        self.route_along(&line, [along.x, along.y], allowed, met)
    }

    /// How far the hand reaches in front of its tip with its fingers closed around something so wide, in m.
    pub(crate) fn front_around(&self, hand: &HandModel, width: f64) -> f64 {
        let rest = self.model.rest();
        let poses = self.model.tree().root_from_links(&hand.around(rest, rest, width));
        let tip_from_root = poses.get(hand.tip).copied().unwrap_or_default().inverse();
        let points = Vector3::from(hand.card.points);
        let parts = self.model.body().parts().iter().filter(|it| hand.members.get(it.link) == Some(&true));
        let ends = parts.filter_map(|part| {
            let solid = part.solid.moved(&(tip_from_root * poses.get(part.link)?));
            Some(solid.centre.dot(&points) + solid.extent(&points))
        });
        ends.fold(0.0, f64::max)
    }
}

/// Whether a thing runs into another in whatever direction it is pushed, of all those between which some are tried.
fn is_walled_in(object: &Solid, others: &[&Obstacle], ahead: &Vector3<f64>) -> bool {
    const DEPTH: u32 = 8;
    let most = ASIDE.iter().copied().fold(0.0, f64::max);
    let mut open = vec![(0.0, most, 0)];
    while let Some((aside, half, depth)) = open.pop() {
        let along = turn(&Vector3::z_axis(), aside) * ahead;
        let is_stopped = (1..=PLACES).any(|at| {
            let gone = FAR * f64::from(at) / f64::from(PLACES);
            let solid = object.moved(&Isometry3::from(Translation3::from(along * gone)));
            // Smaller by the gap too, since it may go along something.
            let drift = gone * half + MIN_CLEARANCE;
            let placed = DeflatedPart { solid, inner: inner(&solid), reach: solid.reach(), drift };
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
