//! Answers to queries, from a world. What the world does not know of it leaves unknown.

use crate::body::UprightBody;
use crate::world::{ArmPose, Rest, Role, SimWorld, ViewDirection};
use indexmap::IndexMap;
use motet_graph::Value;
use motet_robots::scene::NEAR_M;
use motet_runtime::{Answer, Pattern, Query};
use motet_stdlib::lang::{entities, fluents, measures};
use smol_str::SmolStr;

/// Distance within which a thing is at a `Place`, in m.
const AT_PLACE_M: f64 = 0.5;
/// Gravity, in m/s².
const GRAVITY: f64 = 9.81;

/// Facts given at the start, by fluent and arguments, with their truth values.
pub(crate) type InitialFacts = IndexMap<(SmolStr, Vec<SmolStr>), bool>;

impl SimWorld {
    /// The answer to a query.
    pub(crate) fn answer(&self, query: &Query, initial_facts: &InitialFacts) -> Answer {
        match query {
            Query::Fact { fluent, args } => {
                self.some(fluent, args, &mut Vec::new(), initial_facts).map_or(Answer::Unknown, Answer::Truth)
            }
            Query::Measure { measure, args } => {
                let reading = self.measure(measure, args);
                reading.map_or(Answer::Unknown, |value| Answer::Value(Value::Number(value)))
            }
            Query::Field { entity, field } => {
                let reading = self.field(entity, field);
                reading.map_or(Answer::Unknown, |value| Answer::Value(Value::Number(value)))
            }
        }
    }

    /// True if a fluent holds of the arguments, or with `any` of some.
    fn some<'w>(
        &'w self,
        fluent: &str,
        rest: &'w [Pattern],
        chosen: &mut Vec<&'w str>,
        initial_facts: &InitialFacts,
    ) -> Option<bool> {
        let Some((first, rest)) = rest.split_first() else { return self.fact(fluent, chosen, initial_facts) };
        let mut with = |name: &'w str| {
            chosen.push(name);
            let truth = self.some(fluent, rest, chosen, initial_facts);
            chosen.pop();
            truth
        };
        match first {
            Pattern::Is(value) => with(name_of(value)?),
            Pattern::Any => {
                let names = self.things.keys().chain(self.hands.keys()).map(SmolStr::as_str).chain(["robot"]);
                let mut all = None;
                for name in names {
                    match with(name) {
                        Some(true) => return Some(true),
                        Some(false) => all = Some(false),
                        None => {}
                    }
                }
                all
            }
        }
    }

    /// True if a fluent holds, where the world knows it.
    pub(crate) fn fact(&self, fluent: &str, args: &[&str], initial_facts: &InitialFacts) -> Option<bool> {
        self.standard(fluent, args).or_else(|| {
            let known =
                initial_facts.iter().find(|((name, of), _)| name == fluent && of.iter().eq(args.iter()));
            known.map(|(_, holds)| *holds)
        })
    }

    fn standard(&self, fluent: &str, args: &[&str]) -> Option<bool> {
        match (fluent, args) {
            (fluents::FREE, [hand]) => self.hands.get(*hand).map(|grip| grip.holds.is_none()),
            (fluents::STANDING, [entities::ROBOT]) => Some(self.standing),
            ("arm_home", [entities::ROBOT]) => Some(self.arm == ArmPose::Home),
            ("arm_ready", [entities::ROBOT]) => Some(self.arm == ArmPose::Ready),
            ("arm_carry", [entities::ROBOT]) => Some(self.arm == ArmPose::Carry),
            (fluents::AT, [entities::ROBOT, to]) => self.thing(to).map(|_| self.stands_at(to)),
            (_, [id]) => self.state(fluent, id),
            (fluents::AT | fluents::ON | fluents::IN, [id, to]) => self.relation(fluent, id, to),
            (_, _) => None,
        }
    }

    /// Fluents of one thing.
    fn state(&self, fluent: &str, id: &str) -> Option<bool> {
        let thing = self.thing(id)?;
        match fluent {
            fluents::HOLDING => Some(self.holder(id).is_some()),
            fluents::LIFTED => Some(self.is_lifted(id)),
            fluents::VISIBLE => Some(self.is_visible(id, ViewDirection::Ahead)),
            fluents::LOCATED => Some(thing.seen_at == Some(thing.body.xyz)),
            fluents::REACHABLE => Some(self.is_reachable(id)),
            fluents::NEAR => Some(self.distance(&thing.body) <= NEAR_M),
            fluents::OPEN => Some(thing.is_open()),
            fluents::LOCKED => Some(thing.door.is_some_and(|door| door.locked)),
            fluents::CLEAR => Some(!self.resting(id).any(|(_, other)| matches!(other.rest, Rest::On(_)))),
            fluents::STANDING => (thing.role == Role::Person).then_some(true),
            fluents::VISITED => Some(self.visited.contains(id)),
            _ => None,
        }
    }

    fn relation(&self, fluent: &str, id: &str, to: &str) -> Option<bool> {
        let thing = self.thing(id)?;
        // Nothing rests on the robot, in a hand, or on what is not in this world: each thing has its place.
        let Some(target) = self.thing(to) else {
            return matches!(fluent, fluents::ON | fluents::IN | fluents::AT).then_some(false);
        };
        let rests = thing.rest.support().is_some_and(|support| support == to);
        match fluent {
            fluents::ON => Some(rests && matches!(thing.rest, Rest::On(_))),
            fluents::IN => Some(rests && matches!(thing.rest, Rest::In(_))),
            fluents::AT if target.role == Role::Place => {
                let near = target.body.gap(thing.body.x(), thing.body.y()) <= AT_PLACE_M;
                Some(id != to && near && !self.is_lifted(id))
            }
            fluents::AT => Some(rests),
            _ => None,
        }
    }

    fn measure(&self, measure: &str, args: &[Value]) -> Option<f64> {
        match (measure, args) {
            (measures::DISTANCE, [to]) => self.thing(name_of(to)?).map(|thing| self.distance(&thing.body)),
            (measures::BATTERY, []) => Some(self.battery),
            (measures::FORCE, []) => {
                let held = self.hands.values().filter(|grip| grip.lifted);
                let held = held.filter_map(|grip| self.thing(grip.holds.as_deref()?));
                Some(held.map(|thing| thing.mass_kg * GRAVITY).sum())
            }
            (_, _) => None,
        }
    }

    fn field(&self, entity: &str, field: &str) -> Option<f64> {
        let thing = self.thing(entity)?;
        match (field, thing.role) {
            ("mass", _) => Some(thing.mass_kg),
            ("width", _) => Some(thing.width_m),
            (_, _) => thing.fields.get(field).copied(),
        }
    }

    /// Metres from the base's rim to a thing's outline.
    fn distance(&self, body: &UprightBody) -> f64 {
        (body.gap(self.base.x, self.base.y) - self.drive.radius_m).max(0.0)
    }

    /// Notes that the robot has come to an entity, and with it to what that is at.
    pub(crate) fn visit(&mut self, to: &str) {
        let at: Vec<_> = self
            .things
            .keys()
            .filter(|id| self.relation(fluents::AT, to, id) == Some(true))
            .cloned()
            .collect();
        self.visited.extend(at);
        self.visited.insert(to.into());
    }
}

/// The name of an entity or a hand.
fn name_of(value: &Value) -> Option<&str> {
    match value {
        Value::Entity(id) | Value::Case(id) => Some(id),
        Value::Bool(_) | Value::Int(_) | Value::Number(_) | Value::Text(_) => None,
        Value::Pose(_) | Value::List(_) => None,
    }
}
