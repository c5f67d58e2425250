//! Visibility and reachability of the things that a request names, in words.

use std::time::{Duration, Instant};

use motet_compiler::{Access, Session};
use motet_robots::card::Robot;
use motet_robots::scene::{Entity, Scene};
use smol_str::SmolStr;

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
            seen: entity.visible,
            feasible: feasible(session, robot, entity, left),
        })
    });
    seen.collect()
}

fn feasible(session: &Session, robot: &Robot, entity: &Entity, left: Duration) -> Reachability {
    if let Some(hand) = robot.hands.values().next()
        && entity.kind == "Object"
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

/// A line a thing.
pub(super) fn told(seen: &[Sighting]) -> String {
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
            Reachability::AsFarAsNumbersTell => "feasible".to_owned(),
            Reachability::Yes => "feasible: there is a way to it and a motion there".to_owned(),
            Reachability::No(why) => format!("not feasible: {why}"),
            Reachability::Hardly(why) => format!("no motion was found, which proves nothing: {why}"),
            Reachability::Unknown(why) => format!("not known whether feasible: {why}"),
        };
        format!("- {}: {sight}, {reach}\n", one.id)
    });
    format!("# What the request names\n{}", lines.collect::<String>())
}
