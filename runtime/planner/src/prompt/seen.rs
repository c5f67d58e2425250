//! Visibility and reachability of the things that a request names, in words.

use std::time::{Duration, Instant};

use motet_compiler::{Access, Session};
use motet_robots::card::Robot;
use motet_robots::scene::{Entity, Scene};
use smol_str::SmolStr;

/// Visibility and reachability of one thing.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Seen {
    pub id: SmolStr,
    /// Visibility to a camera, if the scene states it.
    pub seen: Option<bool>,
    /// Reachability for the robot.
    pub feasible: Feasible,
}

/// Reachability of a thing.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Feasible {
    /// As far as masses and widths tell; no motion was looked for.
    AsFarAsNumbersTell,
    /// A motion was found.
    Yes,
    /// There is none, or it cannot be held; why.
    No(String),
    /// A search found none, which proves nothing; what is in the way most often.
    Hardly(String),
    /// It is not known; why.
    Unknown(String),
}

/// Visibility and reachability of the named things. Motion searches run one after the other until `time` is
/// over; cached answers cost nothing.
#[must_use]
pub fn seen(session: &Session, robot: &Robot, scene: &Scene, named: &[SmolStr], time: Duration) -> Vec<Seen> {
    let begun = Instant::now();
    let seen = named.iter().filter_map(|id| {
        let entity = scene.entities.get(id)?;
        let left = time.saturating_sub(begun.elapsed());
        Some(Seen { id: id.clone(), seen: entity.visible, feasible: feasible(session, robot, entity, left) })
    });
    seen.collect()
}

fn feasible(session: &Session, robot: &Robot, entity: &Entity, left: Duration) -> Feasible {
    if let Some(hand) = robot.hands.values().next()
        && entity.kind == "Object"
    {
        if let Some(mass) = entity.mass_kg.filter(|mass| *mass > hand.payload_kg) {
            return Feasible::No(format!("too heavy: {mass} kg, payload is {} kg", hand.payload_kg));
        }
        if let Some(width) = entity.width().filter(|width| *width > hand.opening_m) {
            return Feasible::No(format!("too wide: {width} m, opening is {} m", hand.opening_m));
        }
    }
    if left.is_zero() {
        return Feasible::AsFarAsNumbersTell;
    }
    match session.access(&entity.id) {
        None => Feasible::AsFarAsNumbersTell,
        Some(Access::Feasible) => Feasible::Yes,
        Some(Access::Infeasible { why, is_certified: true }) => Feasible::No(why.to_string()),
        Some(Access::Infeasible { why, is_certified: false }) => Feasible::Hardly(why.to_string()),
        Some(Access::Unknown(why)) => Feasible::Unknown(why.to_string()),
    }
}

/// A line a thing.
pub(super) fn told(seen: &[Seen]) -> String {
    if seen.is_empty() {
        return String::new();
    }
    let lines = seen.iter().map(|one| {
        let sight = match one.seen {
            Some(true) => "seen",
            Some(false) => "not seen",
            None => "not known whether seen",
        };
        let reach = match &one.feasible {
            Feasible::AsFarAsNumbersTell => "feasible".to_owned(),
            Feasible::Yes => "feasible: there is a way to it and a motion there".to_owned(),
            Feasible::No(why) => format!("not feasible: {why}"),
            Feasible::Hardly(why) => format!("no motion was found, which proves nothing: {why}"),
            Feasible::Unknown(why) => format!("not known whether feasible: {why}"),
        };
        format!("- {}: {sight}, {reach}\n", one.id)
    });
    format!("# What the request names\n{}", lines.collect::<String>())
}
