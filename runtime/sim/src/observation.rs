//! Answers to queries, from the world as it is, visibility of things, and matching of descriptions. What the
//! world does not know of it leaves unknown.

use crate::body::UprightBody;
use crate::hand::Failure;
use crate::world::{ArmPose, Rest, Role, SimWorld, Thing};
use indexmap::IndexMap;
use motet_graph::Value;
use motet_robots::scene::{NEAR_M, Scene};
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
            "located" => Some(self.is_visible(id) || thing.seen_at == Some(thing.body.xyz)),
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
        let (thing, target) = (self.thing(id)?, self.thing(to)?);
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

/// Freedom of the robot to turn while it looks.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum ViewDirection {
    /// It looks where it looks.
    Ahead,
    /// It turns until it has seen everything about it.
    Around,
}

impl SimWorld {
    /// True if a camera sees a thing now. What the scene says of it counts until the base has moved or the
    /// thing has.
    pub(crate) fn is_visible(&self, id: &str) -> bool {
        let Some(thing) = self.thing(id) else { return false };
        if let Some(said) = thing.visible_at_start
            && self.unmoved
            && !thing.moved
        {
            return said;
        }
        self.sees(id, ViewDirection::Ahead)
    }

    /// True if a thing is in range and view and not shut in.
    pub(crate) fn sees(&self, id: &str, look: ViewDirection) -> bool {
        let Some(thing) = self.thing(id) else { return false };
        let body = &thing.body;
        let (distance, bearing) =
            (body.gap(self.base.x, self.base.y), self.base.bearing_of(body.x(), body.y()).abs());
        let in_view = self.cameras.iter().any(|camera| {
            let beside = distance < 1e-9 || bearing <= camera.view_rad / 2.0;
            distance <= camera.range_m && (beside || look == ViewDirection::Around)
        });
        in_view && self.shut_in(id).is_none()
    }

    /// The objects in view that fit a description, in the order of the scene.
    pub(crate) fn found(&self, scene: &Scene, what: &str, look: ViewDirection) -> Vec<SmolStr> {
        let in_view = |id: &SmolStr| match look {
            ViewDirection::Ahead => self.is_visible(id),
            ViewDirection::Around => self.sees(id, ViewDirection::Around),
        };
        self.described(scene, what).into_iter().filter(in_view).collect()
    }

    /// The objects that fit a description, seen or not.
    pub(crate) fn described(&self, scene: &Scene, what: &str) -> Vec<SmolStr> {
        let is_object = |id: &SmolStr| self.thing(id).is_some_and(|thing| thing.role == Role::Object);
        let mut fitting: Vec<SmolStr> =
            scene.matches(what).into_iter().map(|entity| entity.id.clone()).filter(is_object).collect();
        // Entities that only the options name are called by their name.
        let added = self.things.keys().filter(|id| id.as_str() == what && is_object(id));
        for id in added {
            if !fitting.contains(id) {
                fitting.push(id.clone());
            }
        }
        fitting
    }

    /// The one of several, or why there is none.
    pub(crate) fn the_one(found: Vec<SmolStr>) -> Result<SmolStr, Failure> {
        let mut found = found.into_iter();
        match (found.next(), found.next()) {
            (None, _) => Err("not_found"),
            (Some(only), None) => Ok(only),
            (Some(_), Some(_)) => Err("ambiguous"),
        }
    }

    /// Looks at a thing, turning towards it.
    pub(crate) fn look_at(&mut self, id: &str) -> Result<&Thing, Failure> {
        if !self.sees(id, ViewDirection::Around) {
            return Err("not_found");
        }
        if !self.is_visible(id) {
            // The scene's word counts no longer, now that it has been looked at.
            if let Some(thing) = self.things.get_mut(id) {
                thing.visible_at_start = None;
            }
            if !self.sees(id, ViewDirection::Ahead)
                && let Some(body) = self.thing(id).map(|thing| thing.body)
            {
                self.base.heading += self.base.bearing_of(body.x(), body.y());
                self.carry();
            }
        }
        self.saw(id);
        self.thing(id).ok_or("not_found")
    }
}
