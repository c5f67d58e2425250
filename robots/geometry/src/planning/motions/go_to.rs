//! `go_to`: a standing place from which a thing is served, and the way there; `posture`: the arm to a named posture.

use motet_robots::scene::Entity;
use nalgebra::Vector3;

use crate::collision::{Shape, Solid};
use crate::planning::motions::reach::certain;
use crate::planning::query::answer::{
    Infeasible, InfeasibleReason, MotionAnswer, MotionWitness, SearchBudget, UnknownReason,
};
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::AllowedCollisions;
use crate::planning::search::context::QueryContext;
use crate::planning::search::path::ContactTally;

/// Directions around a thing in which places are looked for.
const DIRECTIONS: usize = 32;
/// How near a place counts as being at it, in m.
const AT_PLACE: f64 = 0.5;
/// How far from its final place the base may turn to come in straight, in m.
const BACK: [f64; 3] = [0.15, 0.3, 0.5];

impl QueryContext<'_> {
    /// A standing place at an entity.
    pub(crate) fn go_to(&self, id: &str, _budget: SearchBudget) -> MotionAnswer {
        let unknown = |why: String| MotionAnswer::Unknown(UnknownReason::Because(why));
        let Some((index, entity)) = self.entity(id) else { return unknown(format!("there is no `{id}`")) };
        let Some(pose) = self.state.pose(entity) else {
            return unknown(format!("the place of `{id}` is not known"));
        };
        if !self.model.drives() {
            return unknown("the robot's base does not drive".into());
        }
        let reach = self.served_within(entity);
        let centre = pose.translation.vector;
        let far = self.far_from(index, entity, [centre.x, centre.y]);
        let start = &self.state.robot;
        let [start_x, start_y, _] = start.base;
        if far(start_x, start_y) <= reach && self.contact(start, AllowedCollisions::default()).is_none() {
            return self.gone(vec![start.clone()]);
        }
        let towards = libm::atan2(start_y - centre.y, start_x - centre.x);
        let (mut met, mut is_free_somewhere) = (ContactTally::default(), false);
        for share in [1.0, 0.9, 0.8, 0.65, 0.5, 0.35, 0.2, 0.0] {
            for step in 0..DIRECTIONS {
                // From the side of the robot outwards, both ways.
                let turn = step.div_ceil(2) as f64 * if step % 2 == 0 { 1.0 } else { -1.0 };
                let angle = towards + turn * std::f64::consts::TAU / DIRECTIONS as f64;
                let (sin, cos) = libm::sincos(angle);
                let Some(out) = along(|out| far(centre.x + cos * out, centre.y + sin * out), reach * share)
                else {
                    continue;
                };
                let yaw = crate::trigonometry::wrapped(angle + std::f64::consts::PI);
                let place = start.at([centre.x + cos * out, centre.y + sin * out, yaw]);
                if self.is_drivable(&place)
                    && let Some(path) = self.drive(&place)
                {
                    return self.gone(path);
                }
                if let Some(contact) = self.contact(&place, AllowedCollisions::default()) {
                    met.add(&contact);
                    continue;
                }
                is_free_somewhere = true;
                for back in BACK {
                    let [x, y, yaw] = place.base;
                    let before = place.at([x + cos * back, y + sin * back, yaw]);
                    if self.is_drivable(&before)
                        && self
                            .edge(&before, &place, AllowedCollisions::default())
                            .map_err(|contact| met.add(&contact))
                            .is_ok()
                        && let Some(mut path) = self.drive(&before)
                    {
                        let last = path.last().unwrap_or(start).clone();
                        path.push(place.after(&last));
                        return self.gone(path);
                    }
                }
            }
        }
        let reason =
            if is_free_somewhere { InfeasibleReason::BlockedPath { by: None } } else { met.none_free() };
        let certified = self.is_shut_off([centre.x, centre.y], reach, far);
        MotionAnswer::Infeasible(Infeasible { reason, change: None, certified, configuration: None })
    }

    /// How far a place is from an entity with its middle at another. A thing is served by its centre; what things stand on, in or with, by
    /// its outline.
    pub(crate) fn far_from(
        &self,
        index: usize,
        entity: &Entity,
        [x, y]: [f64; 2],
    ) -> impl Fn(f64, f64) -> f64 + use<> {
        let is_point = matches!(entity.kind.as_str(), "Object" | "Place");
        let outline: Vec<Solid> = if is_point { vec![] } else { self.solids_of(index).copied().collect() };
        move |at_x, at_y| {
            let solids = outline.iter().map(|solid| beside(solid, at_x, at_y));
            solids.reduce(f64::min).unwrap_or_else(|| libm::hypot(at_x - x, at_y - y))
        }
    }

    /// How near the base has to be to an entity to serve it, in m.
    pub(crate) fn served_within(&self, entity: &Entity) -> f64 {
        match (entity.kind.as_str(), self.model.hand()) {
            ("Place", _) | (_, None) => AT_PLACE,
            (_, Some(hand)) => hand.card.reach_m,
        }
    }

    /// The arm to a posture of the card, the base where it is.
    pub(crate) fn to_posture(&self, name: &str) -> MotionAnswer {
        let start = &self.state.robot;
        let Some(joints) = self.model.posture(name, &start.joints) else {
            return MotionAnswer::Unknown(UnknownReason::Because(format!(
                "the card has no posture `{name}`"
            )));
        };
        let goal = Configuration { base: start.base, joints };
        let mut met = ContactTally::default();
        if let Some(contact) = self.contact(&goal, AllowedCollisions::default()) {
            met.add(&contact);
            return certain(InfeasibleReason::NoFreePose { by: met.most(), share: None }, None);
        }
        match self.unfold(start, &goal, &mut met) {
            Some(path) => self.gone(path),
            None => MotionAnswer::Infeasible(Infeasible::exhausted(InfeasibleReason::BlockedPath {
                by: met.most(),
            })),
        }
    }

    fn gone(&self, path: Vec<Configuration>) -> MotionAnswer {
        let margins = self.margins(&path, AllowedCollisions::default());
        MotionAnswer::Feasible(Box::new(MotionWitness { path, grasp: None, margins }))
    }
}

/// The distance in the plane from a place to a solid, whatever its height.
fn beside(solid: &Solid, x: f64, y: f64) -> f64 {
    let up = solid.extent(&Vector3::z());
    let vertical = Solid {
        centre: Vector3::new(x, y, solid.centre.z),
        axes: [Vector3::x(), Vector3::y(), Vector3::z()],
        shape: Shape::Capsule { radius: 0.0, half: up },
    };
    solid.distance(&vertical).max(0.0)
}

/// How far out a distance that grows by at most 1 for 1 comes down to `wanted`, seen from afar.
fn along(distance: impl Fn(f64) -> f64, wanted: f64) -> Option<f64> {
    let mut out = 12.0;
    for _ in 0..200 {
        let left = distance(out) - wanted;
        if left <= 1e-4 {
            // No farther than what was asked for.
            return Some(out - 1e-4);
        }
        out -= left;
        if out < 0.0 {
            return None;
        }
    }
    None
}
