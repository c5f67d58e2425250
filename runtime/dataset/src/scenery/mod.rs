//! Rooms that differ: the furniture of a room, with other things at other places.
//!
//! The things come from the room itself and from a catalogue, a scene whose objects stand nowhere. What
//! varies is which
//! things there are, how many of a class, on or in what they are and where on it, what stands open, which
//! furniture there
//! is, and where the robot begins.

mod spot;

use motet_robots::scene::{Entity, Scene};
use motet_syntax::{FileId, Source};
use smol_str::{SmolStr, ToSmolStr};

use crate::random::Draw;

/// The catalogue that comes with Motet, as the text of a scene.
pub const THINGS: &str = include_str!("../../data/things.json");

/// Least number of things in a room.
const LEAST: usize = 5;
const MOST: usize = 10;
/// Probability that a piece of furniture is missing.
const MISSING: f64 = 0.2;
/// Probability that a room has two things of a class.
const TWINS: f64 = 0.6;
/// Probability that a thing is in a container, if the room has any.
const INSIDE: f64 = 0.25;
/// Probability that a container is open.
const OPEN: f64 = 0.2;
/// Probability that the robot begins at one of the room's places.
const ELSEWHERE: f64 = 0.4;
/// Mass that most hands cannot lift, in kg.
const HEAVY_KG: f64 = 1.0;
/// The furniture that is always left.
const KEPT: usize = 3;

/// The catalogue that comes with Motet.
#[must_use]
pub fn things() -> Scene {
    motet_robots::scene::read(&Source::new("things.json", THINGS), FileId(0)).0.unwrap_or_default()
}

/// A variation of a room. The same draw gives the same room. O(things × furniture).
#[must_use]
pub fn vary(room: &Scene, catalogue: &Scene, draw: &mut Draw) -> Scene {
    let in_view = in_view(room);
    let mut scene = Scene { robot: room.robot.clone(), entities: furniture(room, draw), views: Vec::new() };
    scene.robot.holding = Some(None);
    scene.robot.at = None;
    let places: Vec<_> = scene.entities.values().filter(|entity| entity.kind == "Place").collect();
    let moved = draw.chance(ELSEWHERE).then(|| draw.pick(&places).and_then(|place| place.pose)).flatten();
    if let Some(pose) = moved {
        let ([x, y, _], [_, _, yaw]) = (pose.xyz, pose.rpy);
        scene.robot.base = [x, y, yaw];
    }
    let sees = |holder: &SmolStr| moved.is_none() && in_view.contains(holder);
    for entity in scene.entities.values_mut() {
        if entity.travel.is_some() && entity.locked != Some(true) {
            entity.open = Some(draw.chance(OPEN));
        }
    }
    for mut thing in chosen(room, catalogue, draw) {
        thing.id = free_id(&scene, &thing.id);
        if spot::stand(&mut scene, &mut thing, INSIDE, draw) {
            let sight = thing.on.as_ref().is_some_and(sees);
            thing.visible = Some(sight);
            scene.entities.insert(thing.id.clone(), thing);
        }
    }
    scene
}

/// Entities of a room that nobody carries about, without a random few.
fn furniture(room: &Scene, draw: &mut Draw) -> indexmap::IndexMap<SmolStr, Entity> {
    let stays = |entity: &&Entity| entity.kind != "Object";
    let mut kept: Vec<&Entity> = room.entities.values().filter(stays).collect();
    let holds = |id: &SmolStr, kept: &[&Entity]| {
        kept.iter().any(|other| other.on.as_ref() == Some(id) || other.inside.as_ref() == Some(id))
    };
    let mut pieces: Vec<&Entity> = kept
        .iter()
        .copied()
        .filter(|entity| matches!(entity.kind.as_str(), "Surface" | "Container"))
        .collect();
    draw.shuffle(&mut pieces);
    for piece in pieces.iter().skip(KEPT) {
        if draw.chance(MISSING) && !is_bin(piece) && !holds(&piece.id, &kept) {
            kept.retain(|other| other.id != piece.id);
        }
    }
    kept.into_iter().map(|entity| (entity.id.clone(), entity.clone())).collect()
}

/// Returns `true` for a bin.
pub(crate) fn is_bin(entity: &Entity) -> bool {
    entity.kind == "Container" && entity.categories.iter().any(|category| category == "bin")
}

/// Surfaces in view of the camera where the robot begins.
fn in_view(room: &Scene) -> Vec<SmolStr> {
    let seen = room.entities.values().filter(|entity| entity.visible == Some(true));
    seen.filter_map(|entity| entity.on.clone()).collect()
}

/// Draws the things of a room, some with a second one of their class.
fn chosen(room: &Scene, catalogue: &Scene, draw: &mut Draw) -> Vec<Entity> {
    let own = room.entities.values().filter(|entity| entity.kind == "Object" && !entity.fixed);
    let mut pool: Vec<&Entity> = own.chain(catalogue.entities.values()).collect();
    draw.shuffle(&mut pool);
    let count = LEAST + draw.below(MOST - LEAST + 1);
    let mut chosen: Vec<Entity> = Vec::new();
    let called_alike = |one: &Entity, other: &Entity| one.names.iter().any(|name| other.names.contains(name));
    for thing in &pool {
        if chosen.len() == count {
            break;
        }
        if !chosen.iter().any(|known| called_alike(known, thing) || known.class == thing.class) {
            chosen.push((*thing).clone());
        }
    }
    if draw.chance(TWINS) {
        let twin = pool.iter().find(|thing| {
            chosen.iter().any(|known| known.class == thing.class)
                && !chosen.iter().any(|known| called_alike(known, thing))
        });
        chosen.extend(twin.map(|twin| (*twin).clone()));
    }
    // Examples in prompts are about what comes first: it is to be something that can be carried.
    chosen.sort_by_key(|thing| thing.mass_kg.is_some_and(|mass| mass > HEAVY_KG));
    chosen
}

/// An id that the scene does not have yet.
fn free_id(scene: &Scene, id: &SmolStr) -> SmolStr {
    let stem = id.trim_end_matches(|letter: char| letter.is_ascii_digit()).trim_end_matches('_');
    let numbered = (1..).map(|number| format!("{stem}_{number}").to_smolstr());
    let mut ids = std::iter::once(id.clone()).chain(numbered);
    ids.find(|id| !scene.entities.contains_key(id)).unwrap_or_else(|| id.clone())
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use motet_robots::builtin::{self, BuiltinScene};
    use motet_robots::scene;

    use super::*;

    #[test]
    fn rooms_differ_and_each_is_a_scene_without_a_mistake() {
        let catalogue = things();
        assert!(catalogue.entities.len() > 30);
        let mut all = BTreeSet::new();
        for BuiltinScene { name, .. } in builtin::SCENES {
            let room = builtin::scene(name).unwrap();
            for seed in 0..40 {
                let varied = vary(&room, &catalogue, &mut Draw::new(seed));
                assert_eq!(varied, vary(&room, &catalogue, &mut Draw::new(seed)));
                let written = scene::write(&varied);
                let (again, said) = scene::read(&Source::new("varied", written.as_str()), FileId(0));
                assert!(said.is_empty(), "{name} {seed}: {said:?}");
                assert_eq!(again.unwrap(), varied);
                let objects = varied.entities.values().filter(|entity| entity.kind == "Object").count();
                assert!((3..=MOST + 1).contains(&objects), "{name} {seed}: {objects} things");
                assert!(varied.entities.values().any(is_bin));
                all.insert(written);
            }
        }
        assert_eq!(all.len(), 120, "no two rooms are the same");
    }
}
