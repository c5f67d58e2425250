//! Serving: the distances from which a robot serves an entity, and what the pose of its base decides about
//! `at(robot, …)` and `near(…)`. One definition for the compiler and for simulated rooms.
//!
//! Distances are in the plane, from the axis of the base to the outline of the entity from above. Where the
//! definition of the planner is narrower, as for an object by its centre, the cases between both stay open.

use motet_stdlib::lang::kinds;

use super::model::{Entity, Scene, Travel};
use super::outline::Outline;
use crate::card::Robot;

/// Distance for the fluent `near`, in m, from the rim of the base to an outline.
pub const NEAR_M: f64 = 1.5;
/// Distance that a robot keeps from a person to whom it drives, in m, from the rim of its base: people do not
/// like a robot closer.
const PERSON_MARGIN_M: f64 = 0.6;
/// Distance that a person reaches out for what they are handed, in m.
const PERSON_REACH_M: f64 = 0.5;
/// Distance from a `Place` within which the base certainly stands at it, in m.
const AT_PLACE_M: f64 = 0.3;
/// Distance from a `Place` beyond which the base certainly does not stand at it, in m.
const OFF_PLACE_M: f64 = 0.5;
/// Tolerance of a distance in m.
const TOLERANCE_M: f64 = 1e-6;
/// Greatest tilt, in rad, of a thing that counts as upright.
const UPRIGHT_RAD: f64 = 1e-3;
/// Outlines of what has no shape: a person and a place.
const PERSON_RADIUS_M: f64 = 0.3;
const PLACE_RADIUS_M: f64 = 0.01;

/// Kinds of entities that differ in how a robot serves them.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ServedKind {
    /// Spot on the floor.
    Place,
    /// Person, who reaches out for what they are handed.
    Person,
    /// Thing that is carried.
    Object,
    /// Furniture: what other things stand on or lie in.
    Furniture,
}

/// Greatest distance in m from the axis of the base to the outline of what it serves, with a reach in m.
#[must_use]
pub fn serving_gap(kind: ServedKind, reach_m: f64) -> f64 {
    match kind {
        ServedKind::Place => AT_PLACE_M,
        ServedKind::Person => reach_m + PERSON_REACH_M,
        ServedKind::Object | ServedKind::Furniture => reach_m,
    }
}

/// Distance in m from the axis of the base to the outline of a person at which a robot comes to stand.
#[must_use]
pub fn person_gap(base_radius_m: f64, reach_m: f64) -> f64 {
    (base_radius_m + PERSON_MARGIN_M).min(serving_gap(ServedKind::Person, reach_m))
}

/// Reach of a robot, from its card.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ServingReach {
    /// Least and greatest reach of its hands, in m.
    hands_m: [f64; 2],
    /// Radius of its base, in m.
    radius_m: f64,
}

/// Bounds of a distance in m; `None` where nothing bounds it.
#[derive(Clone, Copy, Debug)]
struct DistanceBounds {
    least: Option<f64>,
    greatest: Option<f64>,
    /// Distance to the outline; `None` where the outline is unknown.
    outline: Option<f64>,
}

impl ServingReach {
    /// Reach of a robot; `None` for one without hands, which serves nothing.
    #[must_use]
    pub fn of(robot: &Robot) -> Option<Self> {
        let reaches = || robot.hands.values().map(|hand| hand.reach_m);
        let least = reaches().reduce(f64::min)?;
        let greatest = reaches().reduce(f64::max)?;
        Some(Self { hands_m: [least, greatest], radius_m: robot.base.radius_m })
    }

    /// Decides whether the robot serves an entity with its base at a point of the floor; `None` where the
    /// point does not decide it. O(supports of the entity).
    #[must_use]
    pub fn serves(&self, base: [f64; 2], scene: &Scene, entity: &Entity, kind: ServedKind) -> Option<bool> {
        let [least, greatest] = self.hands_m;
        let (within, beyond) = match kind {
            ServedKind::Place => (AT_PLACE_M, OFF_PLACE_M),
            ServedKind::Person | ServedKind::Object | ServedKind::Furniture => {
                (least, serving_gap(kind, greatest))
            }
        };
        let bounds = distance(base, scene, entity, kind);
        decide(bounds.least, bounds.greatest, within, beyond)
    }

    /// Decides whether the robot is near an entity, as [`Self::serves`].
    #[must_use]
    pub fn is_near(&self, base: [f64; 2], scene: &Scene, entity: &Entity, kind: ServedKind) -> Option<bool> {
        let bounds = distance(base, scene, entity, kind);
        let within = NEAR_M + self.radius_m;
        decide(bounds.least, bounds.outline.or(bounds.greatest), within, within)
    }
}

fn decide(least: Option<f64>, greatest: Option<f64>, within: f64, beyond: f64) -> Option<bool> {
    if greatest.is_some_and(|greatest| greatest <= within - TOLERANCE_M) {
        return Some(true);
    }
    least.is_some_and(|least| least > beyond + TOLERANCE_M).then_some(false)
}

/// Bounds of the distance from the axis of the base to an entity. What stands on or lies in something without
/// a pose of its own is no nearer than that.
fn distance([x, y]: [f64; 2], scene: &Scene, entity: &Entity, kind: ServedKind) -> DistanceBounds {
    let slack = slack(scene, entity);
    let mut bounds = match entity.pose {
        Some(pose) => {
            let (dx, dy) = (x - pose.xyz[0], y - pose.xyz[1]);
            let centre = dx.hypot(dy);
            let [roll, pitch, yaw] = pose.rpy;
            let is_upright = roll.abs() <= UPRIGHT_RAD && pitch.abs() <= UPRIGHT_RAD;
            let usual = match kind {
                ServedKind::Person => Some(Outline::Disc { radius: PERSON_RADIUS_M }),
                ServedKind::Place => Some(Outline::Disc { radius: PLACE_RADIUS_M }),
                ServedKind::Object | ServedKind::Furniture => None,
            };
            let outline = entity.shape.as_ref().map_or(usual, Outline::of).filter(|_| is_upright);
            let (sin, cos) = yaw.sin_cos();
            let outline = outline.map(|outline| outline.gap([cos * dx + sin * dy, cos * dy - sin * dx]));
            let is_zone = entity.kind == kinds::ZONE && entity.shape.is_some();
            let by_centre = match kind {
                ServedKind::Place => !is_zone,
                ServedKind::Object => true,
                ServedKind::Person | ServedKind::Furniture => false,
            };
            let greatest = if by_centre { Some(centre) } else { outline };
            DistanceBounds { least: outline, greatest, outline }
        }
        None => {
            let least = support_distance([x, y], scene, entity);
            DistanceBounds { least, greatest: None, outline: None }
        }
    };
    bounds.least = bounds.least.map(|least| least - slack);
    bounds.greatest = bounds.greatest.map(|greatest| greatest + slack);
    bounds.outline = bounds.outline.map(|outline| outline + slack);
    bounds
}

/// Distance to the outline of the first support with a pose.
fn support_distance(base: [f64; 2], scene: &Scene, entity: &Entity) -> Option<f64> {
    let support = supports(scene, entity).find(|support| support.pose.is_some())?;
    // What rests on an object may jut out beyond it.
    if !support.fixed {
        return None;
    }
    distance(base, scene, support, ServedKind::Furniture).least
}

/// Greatest number of supports below one another that count: no real pile has more.
const MAX_SUPPORTS: usize = 64;

/// Entities that carry or contain an entity, the nearest first.
fn supports<'s>(scene: &'s Scene, entity: &'s Entity) -> impl Iterator<Item = &'s Entity> {
    let below = |entity: &Entity| scene.entities.get(entity.on.as_ref().or(entity.inside.as_ref())?);
    std::iter::successors(below(entity), move |support| below(support)).take(MAX_SUPPORTS)
}

/// Distance by which drawers may move an entity, in m.
fn slack(scene: &Scene, entity: &Entity) -> f64 {
    let around = std::iter::once(entity).chain(supports(scene, entity));
    around
        .map(|thing| match thing.travel {
            Some(Travel::Slide { distance, .. }) => distance.abs(),
            Some(Travel::Hinge { .. }) | None => 0.0,
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::builtin;

    fn check(scene: &Scene, id: &str, kind: ServedKind, serves: Option<bool>, near: Option<bool>) {
        let reach = ServingReach::of(&builtin::robot("hsr").unwrap().robot).unwrap();
        let entity = &scene.entities[id];
        let [x, y, _] = scene.robot.base;
        assert_eq!(reach.serves([x, y], scene, entity, kind), serves, "{id}");
        assert_eq!(reach.is_near([x, y], scene, entity, kind), near, "{id}");
    }

    #[test]
    fn serving_is_decided_by_the_pose_of_the_base() {
        let mut kitchen = builtin::scene("kitchen").unwrap();
        check(&kitchen, "kitchen_table", ServedKind::Furniture, Some(false), Some(false));
        check(&kitchen, "mug_1", ServedKind::Object, Some(false), Some(false));
        kitchen.robot.base = [1.5, 0.3, 0.0];
        check(&kitchen, "kitchen_table", ServedKind::Furniture, Some(true), Some(true));
        check(&kitchen, "mug_1", ServedKind::Object, Some(true), Some(true));
        check(&kitchen, "counter", ServedKind::Furniture, Some(false), Some(false));
    }

    #[test]
    fn serving_is_open_where_the_pose_is() {
        let mut kitchen = builtin::scene("kitchen").unwrap();
        kitchen.entities["mug_1"].pose = None;
        // It is on the table, which is far away.
        check(&kitchen, "mug_1", ServedKind::Object, Some(false), Some(false));
        kitchen.robot.base = [1.5, 0.3, 0.0];
        check(&kitchen, "mug_1", ServedKind::Object, None, None);
        kitchen.entities["kitchen_table"].shape = None;
        check(&kitchen, "kitchen_table", ServedKind::Furniture, None, None);
    }
}
