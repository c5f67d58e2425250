//! Answers to queries, from a world. What the world does not know of it leaves unknown.

use crate::body::UprightBody;
use crate::world::{ArmPose, Rest, Role, SimWorld};
use indexmap::IndexMap;
use motet_graph::Value;
use motet_robots::scene::NEAR_M;
use motet_runtime::{Answer, Pattern, Query};
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
            ("free", [hand]) => self.hands.get(*hand).map(|grip| grip.holds.is_none()),
            ("standing", ["robot"]) => Some(self.standing),
            ("arm_home", ["robot"]) => Some(self.arm == ArmPose::Home),
            ("arm_ready", ["robot"]) => Some(self.arm == ArmPose::Ready),
            ("arm_carry", ["robot"]) => Some(self.arm == ArmPose::Carry),
            ("at", ["robot", to]) => self.thing(to).map(|_| self.stands_at(to)),
            (_, [id]) => self.state(fluent, id),
            ("at" | "on" | "in", [id, to]) => self.relation(fluent, id, to),
            (_, _) => None,
        }
    }

    /// Fluents of one thing.
    fn state(&self, fluent: &str, id: &str) -> Option<bool> {
        let thing = self.thing(id)?;
        match fluent {
            "holding" => Some(self.holder(id).is_some()),
            "lifted" => Some(self.is_lifted(id)),
            "visible" => Some(self.is_visible(id)),
            "located" => Some(thing.seen_at == Some(thing.body.xyz)),
            "reachable" => Some(self.is_reachable(id)),
            "near" => Some(self.distance(&thing.body) <= NEAR_M),
            "open" => Some(thing.is_open()),
            "locked" => Some(thing.door.is_some_and(|door| door.locked)),
            "clear" => Some(!self.resting(id).any(|(_, other)| matches!(other.rest, Rest::On(_)))),
            "standing" => (thing.role == Role::Person).then_some(true),
            "visited" => Some(self.visited.contains(id)),
            _ => None,
        }
    }

    fn relation(&self, fluent: &str, id: &str, to: &str) -> Option<bool> {
        let thing = self.thing(id)?;
        // Nothing rests on the robot, in a hand, or on what is not in this world: each thing has its place.
        let Some(target) = self.thing(to) else {
            return matches!(fluent, "on" | "in" | "at").then_some(false);
        };
        let rests = thing.rest.support().is_some_and(|support| support == to);
        match fluent {
            "on" => Some(rests && matches!(thing.rest, Rest::On(_))),
            "in" => Some(rests && matches!(thing.rest, Rest::In(_))),
            "at" if target.role == Role::Place => {
                let near = target.body.gap(thing.body.x(), thing.body.y()) <= AT_PLACE_M;
                Some(id != to && near && !self.is_lifted(id))
            }
            "at" => Some(rests),
            _ => None,
        }
    }

    fn measure(&self, measure: &str, args: &[Value]) -> Option<f64> {
        match (measure, args) {
            ("distance", [to]) => self.thing(name_of(to)?).map(|thing| self.distance(&thing.body)),
            ("battery", []) => Some(self.battery),
            ("force", []) => {
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
        let at: Vec<_> =
            self.things.keys().filter(|id| self.relation("at", to, id) == Some(true)).cloned().collect();
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
