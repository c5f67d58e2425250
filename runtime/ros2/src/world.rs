//! What the driver believes of the room: the scene, what its own goals changed, and what was detected.

mod sighting;

use crate::tf::Transform;
use motet_graph::Value;
use motet_host::remote::protocol::DetectedThing;
use motet_robots::scene::{Placement, Scene, distance};
use motet_runtime::{Pattern, Query};
use motet_stdlib::lang::{entities, fluents, kinds, measures, primitives};
use std::collections::{BTreeMap, BTreeSet};
use std::time::{Duration, Instant};

/// Distance in m up to which something is near, from the middle of the base.
const NEAR: f64 = 1.7;
/// Time for which a thing that was detected counts as in view.
const IN_VIEW: Duration = Duration::from_secs(2);

/// Where a thing is.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Place {
    On(String),
    In(String),
    /// With a person, or at a place.
    At(String),
    Hand,
    Unknown,
}

/// Things and containers of the room.
pub(crate) struct World {
    pub(crate) scene: Scene,
    places: BTreeMap<String, Place>,
    open: BTreeMap<String, bool>,
    at: BTreeSet<String>,
    visited: BTreeSet<String>,
    seen: BTreeMap<String, Instant>,
    /// Things that the scene lacks.
    found: BTreeSet<String>,
    /// Positions in m where the host was told that things are.
    reported: BTreeMap<String, [f64; 3]>,
    /// Detections that the host does not know of.
    news: Vec<DetectedThing>,
}

impl World {
    /// The room as its scene says.
    #[must_use]
    pub(crate) fn new(scene: Scene) -> Self {
        let mut places = BTreeMap::new();
        for entity in scene.entities.values().filter(|entity| !entity.fixed) {
            let on = entity.on.as_ref().map(|on| Place::On(on.to_string()));
            let inside = entity.inside.as_ref().map(|inside| Place::In(inside.to_string()));
            places.insert(entity.id.to_string(), inside.or(on).unwrap_or(Place::Unknown));
        }
        if let Some(Some(held)) = &scene.robot.holding {
            places.insert(held.to_string(), Place::Hand);
        }
        let open = scene
            .entities
            .values()
            .filter_map(|entity| Some((entity.id.to_string(), entity.open?)))
            .collect();
        let at = scene.robot.at.iter().map(ToString::to_string).collect();
        Self {
            scene,
            places,
            open,
            at,
            visited: BTreeSet::new(),
            seen: BTreeMap::new(),
            found: BTreeSet::new(),
            reported: BTreeMap::new(),
            news: Vec::new(),
        }
    }

    /// The thing in the hand.
    #[must_use]
    pub(crate) fn held(&self) -> Option<&str> {
        self.places.iter().find(|(_, place)| **place == Place::Hand).map(|(thing, _)| thing.as_str())
    }

    /// Takes in the success of a primitive.
    pub(crate) fn done(&mut self, primitive: &str, args: &[(String, Value)]) {
        let entity = |name: &str| {
            let found = args.iter().find(|(own, _)| own == name);
            if let Some((_, Value::Entity(id))) = found { Some(id.to_string()) } else { None }
        };
        let (object, on, to, what) = (entity("object"), entity("on"), entity("to"), entity("what"));
        match primitive {
            primitives::GO => {
                self.visited.extend(to.clone());
                self.at = to.into_iter().collect();
            }
            primitives::GO_TO_POSE | primitives::TURN => self.at.clear(),
            primitives::PICK | primitives::GRASP => self.put(object, Place::Hand),
            primitives::PLACE | primitives::PLACE_AT => {
                let place = on.map_or(Place::Unknown, |on| {
                    let kind = self.scene.entities.get(on.as_str()).map(|entity| entity.kind.as_str());
                    if kind == Some(kinds::CONTAINER) { Place::In(on) } else { Place::On(on) }
                });
                self.put(object, place);
            }
            primitives::HANDOVER => self.put(object, to.map_or(Place::Unknown, Place::At)),
            primitives::OPEN | primitives::CLOSE => {
                what.iter().for_each(|what| self.moved(what, primitive == primitives::OPEN))
            }
            _ => {}
        }
    }

    /// Takes in that a container was opened or closed.
    pub(crate) fn moved(&mut self, container: &str, is_open: bool) {
        self.open.insert(container.to_owned(), is_open);
        // Paths are looked for in the scene.
        if let Some(entity) = self.scene.entities.get_mut(container) {
            entity.open = Some(is_open);
        }
    }

    /// Takes in that the robot stands where it serves a place, and that a thing was found there.
    pub(crate) fn found(&mut self, place: &str, thing: &str) {
        self.visited.insert(place.to_owned());
        self.at = [place, thing].map(str::to_owned).into();
    }

    /// Takes in a failure or an interruption: what the goal handled may be anywhere.
    pub(crate) fn failed(&mut self, primitive: &str, args: &[(String, Value)]) {
        if matches!(
            primitive,
            primitives::GO | primitives::GO_TO_POSE | primitives::TURN | primitives::SEARCH
        ) {
            self.at.clear();
        }
        if matches!(primitive, primitives::OPEN | primitives::CLOSE) {
            for (_, value) in args {
                if let Value::Entity(id) = value {
                    self.open.remove(id.as_str());
                }
            }
        }
        for (_, value) in args {
            if let Value::Entity(id) = value
                && self.places.get(id.as_str()) == Some(&Place::Hand)
                && primitive != primitives::GO
            {
                self.places.insert(id.to_string(), Place::Unknown);
            }
        }
    }

    fn put(&mut self, thing: Option<String>, place: Place) {
        self.places.extend(thing.map(|thing| (thing, place)));
    }

    /// Takes in a detection of a known thing. A thing that is not where it was believed has no place until
    /// somebody says.
    pub(crate) fn saw(&mut self, thing: &str, pose: Option<Transform>) {
        self.seen.insert(thing.to_owned(), Instant::now());
        let (Some(pose), Some(entity)) = (pose, self.scene.entities.get_mut(thing)) else { return };
        let moved = entity.pose.as_ref().is_none_or(|before| distance(before.xyz, pose.xyz) > 0.3);
        let is_held = self.places.get(thing) == Some(&Place::Hand);
        if moved && !is_held && entity.pose.is_some() {
            self.places.insert(thing.to_owned(), Place::Unknown);
        }
        if !is_held {
            entity.pose = Some(Placement { xyz: pose.xyz, rpy: pose.rpy() });
        }
    }

    /// Things that a description fits, as the host reads it.
    #[must_use]
    pub(crate) fn matches(&self, what: &str) -> Vec<String> {
        self.scene.matches(what).into_iter().map(|entity| entity.id.to_string()).collect()
    }

    /// Pose of an entity.
    #[must_use]
    pub(crate) fn pose(&self, id: &str) -> Option<Transform> {
        let pose = self.scene.entities.get(id)?.pose.as_ref()?;
        Some(Transform::from_rpy(pose.xyz, pose.rpy))
    }

    /// Answer to a fact or a measure; `None` if it is unknown. `base` is the position of the robot in m.
    #[must_use]
    pub(crate) fn answer(&self, query: &Query, base: Option<[f64; 2]>) -> Option<Value> {
        match query {
            Query::Fact { fluent, args } => {
                let patterns: Option<Vec<Option<&str>>> = args.iter().map(pattern).collect();
                self.some(fluent, &patterns?, &mut Vec::new(), base).map(Value::Bool)
            }
            Query::Measure { measure, args } if measure == measures::DISTANCE => {
                let Some(Value::Entity(id)) = args.first() else { return None };
                self.distance(id, base?).map(Value::Number)
            }
            _ => None,
        }
    }

    /// True if the fact holds for the arguments, or for some where a pattern has none.
    fn some<'a>(
        &'a self,
        fluent: &str,
        patterns: &[Option<&'a str>],
        chosen: &mut Vec<&'a str>,
        base: Option<[f64; 2]>,
    ) -> Option<bool> {
        let Some((first, rest)) = patterns.split_first() else { return self.fact(fluent, chosen, base) };
        if let Some(one) = first {
            chosen.push(one);
            let truth = self.some(fluent, rest, chosen, base);
            chosen.pop();
            return truth;
        }
        let mut all = Some(false);
        for id in self.scene.entities.keys().map(smol_str::SmolStr::as_str).chain(["robot", "hand"]) {
            chosen.push(id);
            match self.some(fluent, rest, chosen, base) {
                Some(true) => {
                    chosen.pop();
                    return Some(true);
                }
                // What makes no sense for an entity is not what was asked for.
                None if self.is_sensible(fluent, chosen) => all = None,
                _ => {}
            }
            chosen.pop();
        }
        all
    }

    fn is_sensible(&self, fluent: &str, args: &[&str]) -> bool {
        match (fluent, args) {
            (fluents::HOLDING | fluents::LIFTED | fluents::AT | fluents::ON | fluents::IN, [thing, ..]) => {
                self.places.contains_key(*thing)
            }
            _ => true,
        }
    }

    fn fact(&self, fluent: &str, args: &[&str], base: Option<[f64; 2]>) -> Option<bool> {
        let place = |thing: &str| self.places.get(thing);
        match (fluent, args) {
            (fluents::HOLDING | fluents::LIFTED, [thing]) => place(thing).map(|place| *place == Place::Hand),
            (fluents::FREE, ["hand"]) => Some(self.held().is_none()),
            (fluents::AT, [entities::ROBOT, to]) => Some(self.at.contains(*to) || self.stands(to)),
            (fluents::AT, [thing, to]) => match place(thing)? {
                Place::Unknown => None,
                Place::Hand => Some(false),
                Place::On(at) | Place::In(at) | Place::At(at) => Some(at == to),
            },
            (fluents::ON, [thing, to]) => match place(thing)? {
                Place::Unknown => None,
                place => Some(*place == Place::On((*to).to_owned())),
            },
            (fluents::IN, [thing, to]) => match place(thing)? {
                Place::Unknown => None,
                place => Some(*place == Place::In((*to).to_owned())),
            },
            (fluents::OPEN, [what]) => self.open.get(*what).copied(),
            (fluents::LOCKED, [what]) => self.scene.entities.get(*what)?.locked,
            (fluents::CLEAR, [what]) => {
                Some(!self.places.values().any(|place| *place == Place::On((*what).to_owned())))
            }
            (fluents::NEAR, [what]) => Some(self.distance(what, base?)? < NEAR),
            (fluents::VISITED, [what]) => Some(self.visited.contains(*what)),
            (fluents::VISIBLE | fluents::LOCATED, [what]) => {
                self.seen.get(*what).is_some_and(|at| at.elapsed() < IN_VIEW).then_some(true)
            }
            _ => None,
        }
    }

    /// True if the robot stands where it serves what bears a thing.
    fn stands(&self, thing: &str) -> bool {
        match self.places.get(thing) {
            Some(Place::On(at) | Place::In(at) | Place::At(at)) => self.at.contains(at),
            _ => false,
        }
    }

    fn distance(&self, id: &str, base: [f64; 2]) -> Option<f64> {
        let [x, y, _] = self.scene.entities.get(id)?.pose.as_ref()?.xyz;
        Some((x - base[0]).hypot(y - base[1]))
    }
}

/// Argument of a fact: an id, or `None` for some entity. No pattern where the argument is no entity.
fn pattern(arg: &Pattern) -> Option<Option<&str>> {
    match arg {
        Pattern::Any => Some(None),
        Pattern::Is(Value::Entity(id) | Value::Case(id)) => Some(Some(id)),
        Pattern::Is(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::read_scene;

    fn fact(world: &World, fluent: &str, args: &[&str]) -> Option<Value> {
        let args = args.iter().map(|id| Pattern::Is(Value::Entity((*id).into()))).collect();
        world.answer(&Query::Fact { fluent: fluent.into(), args }, None)
    }

    #[test]
    fn world_knows_nothing_of_legs_and_postures() {
        let world = World::new(read_scene("kitchen").unwrap());
        for fluent in ["standing", "arm_home", "arm_ready", "arm_carry"] {
            assert_eq!(fact(&world, fluent, &["robot"]), None, "{fluent}");
        }
    }

    #[test]
    fn world_plans_with_what_was_opened() {
        let mut world = World::new(read_scene("kitchen").unwrap());
        let what = [("what".to_owned(), Value::Entity("drawer_1".into()))];
        world.done("open", &what);
        assert_eq!(fact(&world, "open", &["drawer_1"]), Some(Value::Bool(true)));
        assert_eq!(world.scene.entities["drawer_1"].open, Some(true));
        world.failed("close", &what);
        assert_eq!(fact(&world, "open", &["drawer_1"]), None);
    }

    #[test]
    fn world_finds_things_by_their_ids_and_names() {
        let world = World::new(read_scene("kitchen").unwrap());
        assert_eq!(world.matches("mug_1"), ["mug_1"]);
        assert_eq!(world.matches("Kitchen Table"), ["kitchen_table"]);
        assert!(world.matches("elephant").is_empty());
    }
}
