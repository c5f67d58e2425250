//! The scene, the present state and the sightings, in words.

use std::time::{Duration, Instant};

use indexmap::IndexMap;
use motet_compiler::{Access, Session};
use motet_graph::Value;
use motet_requests::RequestContext;
use motet_robots::card::Robot;
use motet_robots::scene::{Entity, EntityShape, Scene};
use motet_runtime::memory::Memory;
use motet_stdlib::lang::{entities, fluents, kinds};
use smol_str::SmolStr;

use super::in_line;

/// Chosen entities of the scene, one per line.
pub(super) fn entities(situation: &RequestContext<'_>, picked: &dyn Fn(&SmolStr) -> bool) -> String {
    let mut lines = String::new();
    for entity in situation.scene.entities.values().filter(|entity| picked(&entity.id)) {
        let names: Vec<&str> = entity.names.iter().map(SmolStr::as_str).collect();
        let called = if names.is_empty() { entity.class.to_string() } else { names.join(", ") };
        let mut text = format!("- {} ({}): {called}", entity.id, entity.kind);
        if let Some(extent) = extent(entity) {
            text.push_str(&format!("; {extent}"));
        }
        let now = situation.supports.iter().find(|(id, _)| *id == entity.id);
        let seen_at = situation.seen_at.iter().find(|(id, _)| *id == entity.id);
        match now {
            Some((_, Some(support))) => {
                let holder = situation.scene.entities.get(support).map(|holder| holder.kind.as_str());
                let relation = match holder {
                    Some(kinds::CONTAINER) => fluents::IN,
                    Some(kinds::SURFACE) => fluents::ON,
                    Some(_) | None => fluents::AT,
                };
                text.push_str(&format!("; {relation} {support}"));
            }
            // Only what can be carried is ever nowhere.
            Some((_, None)) if entity.kind == kinds::OBJECT && seen_at.is_none() => {
                text.push_str("; it is not known where");
            }
            Some((_, None)) | None => {
                if let Some(support) = &entity.on {
                    text.push_str(&format!("; on {support}"));
                } else if let Some(container) = &entity.inside {
                    text.push_str(&format!("; in {container}"));
                }
            }
        }
        if let Some((_, [x, y, z])) = seen_at {
            text.push_str(&format!("; the camera saw it at {x:.2}, {y:.2}, {z:.2} m"));
        }
        if entity.kind == kinds::CONTAINER && entity.travel.is_none() {
            text.push_str("; always open");
        }
        for (is, word) in [
            (entity.open, ["open", "closed"]),
            (entity.locked, ["locked", ""]),
            (entity.visible, ["seen", "not seen"]),
        ] {
            let [yes, no] = word;
            match is {
                Some(true) => text.push_str(&format!("; {yes}")),
                Some(false) if !no.is_empty() => text.push_str(&format!("; {no}")),
                Some(false) | None => {}
            }
        }
        lines.push_str(&in_line(&text));
        lines.push('\n');
    }
    lines
}

/// Extent of a zone on the floor.
fn extent(entity: &Entity) -> Option<String> {
    match entity.shape.as_ref().filter(|_| entity.kind == kinds::ZONE)? {
        EntityShape::Box([x, y, _]) => Some(format!("{x} m x {y} m of the floor")),
        EntityShape::Cylinder { radius, .. } => Some(format!("{} m across", 2.0 * radius)),
        EntityShape::Sphere { .. } | EntityShape::Capsule { .. } | EntityShape::Mesh { .. } => None,
    }
}

/// Position of the robot, the thing in its hand, what is known of the robot, and the steps that run.
pub(super) fn now(
    situation: &RequestContext<'_>,
    (session, card): (&Session, &Robot),
    memory: &Memory,
) -> String {
    let robot = situation.supports.iter().rev().find(|(id, _)| id == ROBOT);
    // Once it has moved, its joints are not where the scene says.
    let posture = robot.is_none().then(|| posture(card, situation.scene)).flatten();
    let place = match robot {
        Some((_, place)) => place.clone(),
        None => situation.scene.robot.at.clone(),
    };
    let stands = match (place, robot) {
        (Some(place), _) => format!("stands at {place}"),
        (None, Some(_)) => "is between places".to_owned(),
        (None, None) => "stands at start".to_owned(),
    };
    let mut known: Vec<(String, bool)> = Vec::new();
    for fact in session.initial_facts().filter(|fact| fact.args.iter().all(is_robot)) {
        let args: Vec<&str> = fact.args.iter().filter_map(name).collect();
        let atom = format!("{}({})", fact.fluent, args.join(", "));
        known.retain(|(other, _)| *other != atom);
        known.push((atom, fact.holds));
    }
    let is_free = known.iter().any(|(atom, holds)| *holds && atom.starts_with(FREE));
    let holds = match (&situation.holding, &situation.scene.robot.holding) {
        (Some(held), _) => format!("holds {held}"),
        (None, Some(_)) => "holds nothing".to_owned(),
        (None, None) if is_free => "holds nothing".to_owned(),
        (None, None) => "may hold something".to_owned(),
    };
    let posture = posture.map_or_else(String::new, |posture| format!(", its arm {posture}"));
    let mut text = format!("The robot {stands} and {holds}{posture}.");
    if !known.is_empty() {
        let known =
            known.iter().map(|(atom, holds)| if *holds { atom.clone() } else { format!("not {atom}") });
        text.push_str(&format!(" Known: {}.", known.collect::<Vec<_>>().join(", ")));
    }
    let running = memory.running().map(|step| format!("It is running {}.\n", in_line(&step.call)));
    format!("# Now\n{}\n{}", in_line(&text), running.collect::<String>())
}

/// Results of the steps of the latest policy, which a new policy cannot name but the request may mean.
pub(super) fn bound(bound: &[(SmolStr, Value)]) -> String {
    let known: Vec<String> = bound
        .iter()
        .map(|(name, value)| {
            format!("{name} = {}", value.to_string().chars().take(SHOWN).collect::<String>())
        })
        .collect();
    if known.is_empty() {
        String::new()
    } else {
        format!("Results of the last policy: {}.\n", in_line(&known.join(", ")))
    }
}

/// Posture of the arm in a scene: one of the card, or that of all joints at rest.
fn posture(card: &Robot, scene: &Scene) -> Option<String> {
    let at = |joint: &SmolStr| scene.robot.joints.get(joint).copied().unwrap_or(0.0);
    let is_there = |joints: &IndexMap<SmolStr, f64>| {
        joints.iter().all(|(joint, value)| (at(joint) - value).abs() < SAME_JOINT)
    };
    let named = card.postures.iter().find(|(_, joints)| is_there(joints));
    match named {
        Some((name, _)) => Some(format!("in the posture `{name}`")),
        None if scene.robot.joints.is_empty() && !card.postures.is_empty() => Some("at rest".to_owned()),
        None => None,
    }
}

/// Characters of a result that are shown.
const SHOWN: usize = 80;
/// Greatest difference of a joint from its value in a posture, in rad or m.
const SAME_JOINT: f64 = 1e-3;
/// Beginning of the fact that a hand is free.
const FREE: &str = "free(";

/// True if an argument of a fact is the robot or a part of it.
fn is_robot(arg: &Option<Value>) -> bool {
    name(arg).is_some_and(|name| name == ROBOT || matches!(arg, Some(Value::Case(_))))
}

/// Name of an entity or a case.
fn name(arg: &Option<Value>) -> Option<&str> {
    match arg.as_ref()? {
        Value::Entity(name) | Value::Case(name) => Some(name),
        Value::Bool(_)
        | Value::Int(_)
        | Value::Number(_)
        | Value::Text(_)
        | Value::Pose(_)
        | Value::List(_) => None,
    }
}

/// Name of the robot in facts.
const ROBOT: &str = entities::ROBOT;

/// Visibility and reachability of one thing.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Sighting {
    pub id: SmolStr,
    /// Visibility to a camera, if the scene states it.
    pub seen: Option<bool>,
    /// Reachability for the robot.
    pub feasible: Reachability,
}

/// Reachability of a thing.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Reachability {
    /// Decided by mass and width; no motion was searched.
    AsFarAsNumbersTell,
    /// A motion was found.
    Yes,
    /// No motion exists, or the hand cannot hold the object; the reason.
    No(String),
    /// A search found no motion and proved nothing; the most frequent obstacle.
    Hardly(String),
    /// Unknown, with the reason.
    Unknown(String),
}

/// Visibility and reachability of the named objects. Motion searches run one after the other until `time` is
/// over; cached answers cost nothing.
#[must_use]
pub fn seen(
    session: &Session,
    robot: &Robot,
    scene: &Scene,
    named: &[SmolStr],
    time: Duration,
) -> Vec<Sighting> {
    let begun = Instant::now();
    let seen = named.iter().filter_map(|id| {
        let entity = scene.entities.get(id)?;
        let left = time.saturating_sub(begun.elapsed());
        Some(Sighting {
            id: id.clone(),
            seen: visible(session, id).or(entity.visible),
            feasible: feasible(session, robot, entity, left),
        })
    });
    seen.collect()
}

/// Latest known visibility of an entity.
fn visible(session: &Session, id: &SmolStr) -> Option<bool> {
    let is_it = |arg: &Option<Value>| matches!(arg, Some(Value::Entity(known)) if known == id);
    let facts = session.initial_facts().filter(|fact| fact.fluent == fluents::VISIBLE);
    facts.filter(|fact| fact.args.iter().all(is_it)).last().map(|fact| fact.holds)
}

fn feasible(session: &Session, robot: &Robot, entity: &Entity, left: Duration) -> Reachability {
    if let Some(hand) = robot.hands.values().next()
        && entity.kind == kinds::OBJECT
    {
        if let Some(mass) = entity.mass_kg.filter(|mass| *mass > hand.payload_kg) {
            return Reachability::No(format!("too heavy: {mass} kg, payload is {} kg", hand.payload_kg));
        }
        if let Some(width) = entity.width().filter(|width| *width > hand.opening_m) {
            return Reachability::No(format!("too wide: {width} m, opening is {} m", hand.opening_m));
        }
    }
    if left.is_zero() {
        return Reachability::AsFarAsNumbersTell;
    }
    match session.access(&entity.id) {
        None => Reachability::AsFarAsNumbersTell,
        Some(Access::Feasible) => Reachability::Yes,
        Some(Access::Infeasible { why, is_certified: true }) => Reachability::No(why.to_string()),
        Some(Access::Infeasible { why, is_certified: false }) => Reachability::Hardly(why.to_string()),
        Some(Access::Unknown(why)) => Reachability::Unknown(why.to_string()),
    }
}

/// Sightings as text, one object per line.
pub(crate) fn told(seen: &[Sighting]) -> String {
    if seen.is_empty() {
        return String::new();
    }
    let lines = seen.iter().map(|one| {
        let sight = match one.seen {
            Some(true) => "seen, ",
            Some(false) => "not seen, ",
            None => "",
        };
        let reach = match &one.feasible {
            Reachability::AsFarAsNumbersTell => "feasible as far as mass and width tell".to_owned(),
            Reachability::Yes => "feasible".to_owned(),
            Reachability::No(why) => format!("not feasible: {why}"),
            Reachability::Hardly(why) => format!("no motion was found, which proves nothing: {why}"),
            Reachability::Unknown(why) => format!("not known whether feasible: {why}"),
        };
        in_line(&format!("- {}: {sight}{reach}", one.id)) + "\n"
    });
    let meaning = "Feasible: to drive there, and to pick it, or to open or close it.";
    format!("# What the request names\n{meaning}\n{}", lines.collect::<String>())
}
