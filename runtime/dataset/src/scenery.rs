//! Scenes that differ: the furniture of a scene, with other things at other places.
//!
//! The things come from the scene itself and from a catalogue, a scene whose objects stand nowhere. What
//! varies is which things there are, how many of a class, on or in what they are and where on it, what stands
//! open, which furniture there is, and where the robot begins.

use motet_robots::scene::{Entity, EntityShape, Placement, Scene};
use motet_stdlib::lang::kinds;
use motet_syntax::{FileId, Source};
use rand_xoshiro::SplitMix64;
use smol_str::{SmolStr, ToSmolStr};

use crate::random::Draw;

/// The catalogue that comes with Motet, as the text of a scene.
pub const THINGS: &str = include_str!("../data/things.json");

/// Least number of things in a scene.
const LEAST: usize = 5;
const MOST: usize = 10;
/// Probability that a piece of furniture is missing.
const MISSING: f64 = 0.2;
/// Probability that a scene has two things of a class.
const TWINS: f64 = 0.75;
/// Probability that a thing is in a container, if the scene has any.
const INSIDE: f64 = 0.25;
/// Probability that a container is open.
const OPEN: f64 = 0.2;
/// Probability that the robot begins at one of the scene's places.
const ELSEWHERE: f64 = 0.4;
/// Mass that most hands cannot lift, in kg.
const HEAVY_KG: f64 = 1.0;
/// Probability that a scene has a shelf above a surface that no robot reaches, with a thing on it.
const HIGH_SHELF: f64 = 0.85;
/// Height of that shelf in m, and its thickness.
const HIGH_M: [f64; 2] = [1.95, 0.02];
/// Category of such a shelf.
pub(crate) const HIGH: &str = "high_shelf";
/// The furniture that is always left.
const KEPT: usize = 3;

/// The catalogue that comes with Motet.
#[must_use]
pub fn things() -> Scene {
    motet_robots::scene::read(&Source::new("things.json", THINGS), FileId(0)).0.unwrap_or_default()
}

/// A variation of a scene. The same draw gives the same scene. O(things × furniture).
#[must_use]
pub fn vary(base: &Scene, catalogue: &Scene, draw: &mut SplitMix64) -> Scene {
    let in_view = in_view(base);
    let mut scene = Scene { entities: furniture(base, draw), views: Vec::new(), ..base.clone() };
    scene.robot.holding = Some(None);
    scene.robot.at = None;
    let places: Vec<_> = scene.entities.values().filter(|entity| entity.kind == kinds::PLACE).collect();
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
    for mut thing in chosen(base, catalogue, draw) {
        thing.id = free_id(&scene, &thing.id);
        if stand(&mut scene, &mut thing, INSIDE, draw) {
            let sight = thing.on.as_ref().is_some_and(sees);
            thing.visible = Some(sight);
            scene.entities.insert(thing.id.clone(), thing);
        }
    }
    if draw.chance(HIGH_SHELF) {
        raise(&mut scene, draw);
    }
    scene
}

/// Adds a shelf high above a surface, and puts a thing of the scene on it.
fn raise(scene: &mut Scene, draw: &mut SplitMix64) {
    let is_below = |entity: &&Entity| entity.kind == kinds::SURFACE && entity.pose.is_some();
    let surfaces: Vec<&Entity> = scene.entities.values().filter(is_below).collect();
    let is_light = |entity: &Entity| entity.mass_kg.is_none_or(|mass| mass <= HEAVY_KG);
    let stands = |entity: &&Entity| {
        entity.kind == kinds::OBJECT && !entity.fixed && entity.on.is_some() && is_light(entity)
    };
    let things: Vec<&Entity> = scene.entities.values().filter(stands).collect();
    let (Some(below), Some(thing)) = (draw.pick(&surfaces), draw.pick(&things)) else { return };
    let size = below.extents();
    let below = (*below).clone();
    let (Some(pose), Some([long, deep, _]), Some([_, _, high])) = (below.pose, size, thing.extents()) else {
        return;
    };
    let ([x, y, _], id) = (pose.xyz, thing.id.clone());
    let shelf_id = free_id(scene, &SmolStr::new_static("high_shelf"));
    let shelf = Entity {
        id: shelf_id.clone(),
        class: SmolStr::new_static("board"),
        names: vec![SmolStr::new_static("high shelf")],
        categories: vec![SmolStr::new_static(HIGH)],
        pose: Some(Placement { xyz: [x, y, HIGH_M[0]], rpy: pose.rpy }),
        shape: Some(EntityShape::Box([long, deep.min(0.3), HIGH_M[1]])),
        fixed: true,
        on: None,
        inside: None,
        ..below
    };
    scene.entities.insert(shelf_id.clone(), shelf);
    if let Some(thing) = scene.entities.get_mut(&id) {
        let z = millimetres(HIGH_M[0] + HIGH_M[1] / 2.0 + high / 2.0);
        (thing.on, thing.inside) = (Some(shelf_id), None);
        (thing.pose, thing.visible) = (Some(Placement { xyz: [x, y, z], rpy: [0.0; 3] }), None);
    }
}

/// Entities of a scene that nobody carries about, without a random few.
fn furniture(scene: &Scene, draw: &mut SplitMix64) -> indexmap::IndexMap<SmolStr, Entity> {
    let stays = |entity: &&Entity| entity.kind != kinds::OBJECT;
    let mut kept: Vec<&Entity> = scene.entities.values().filter(stays).collect();
    let holds = |id: &SmolStr, kept: &[&Entity]| {
        kept.iter().any(|other| other.on.as_ref() == Some(id) || other.inside.as_ref() == Some(id))
    };
    let mut pieces: Vec<&Entity> = kept
        .iter()
        .copied()
        .filter(|entity| matches!(entity.kind.as_str(), kinds::SURFACE | kinds::CONTAINER))
        .collect();
    draw.shuffle(&mut pieces);
    for piece in pieces.iter().skip(KEPT) {
        if draw.chance(MISSING) && !is_bin(piece) && !holds(&piece.id, &kept) {
            kept.retain(|other| other.id != piece.id);
        }
    }
    kept.into_iter().map(|entity| (entity.id.clone(), entity.clone())).collect()
}

/// True for a bin.
pub(crate) fn is_bin(entity: &Entity) -> bool {
    entity.kind == kinds::CONTAINER && entity.categories.iter().any(|category| category == "bin")
}

/// Surfaces in view of the camera where the robot begins.
fn in_view(scene: &Scene) -> Vec<SmolStr> {
    let seen = scene.entities.values().filter(|entity| entity.visible == Some(true));
    seen.filter_map(|entity| entity.on.clone()).collect()
}

/// Draws the things of a scene, some with a second one of their class.
fn chosen(scene: &Scene, catalogue: &Scene, draw: &mut SplitMix64) -> Vec<Entity> {
    let own = scene.entities.values().filter(|entity| entity.kind == kinds::OBJECT && !entity.fixed);
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

/// Number of attempts to find a spot.
pub(crate) const TRIES: usize = 24;
/// Distance in m from the middle of a thing to the edge of its surface: at least, beside half its own width,
/// and at most, where the surface is large enough.
const EDGE: [f64; 2] = [0.03, 0.1];
/// Between two things, in m: room for fingers.
const BETWEEN: f64 = 0.12;

/// Puts a thing somewhere: its pose and its relation to what it is on or in. False where no spot was free.
pub(crate) fn stand(scene: &mut Scene, thing: &mut Entity, inside: f64, draw: &mut SplitMix64) -> bool {
    let Some([wide, deep, high]) = thing.extents() else { return false };
    let is_empty_space = |entity: &&Entity| match entity.kind.as_str() {
        kinds::CONTAINER => !is_bin(entity) && entity.locked != Some(true),
        kinds::SURFACE => true,
        _ => false,
    };
    let (closets, tops): (Vec<&Entity>, Vec<&Entity>) =
        scene.entities.values().filter(is_empty_space).partition(|entity| entity.kind == kinds::CONTAINER);
    (thing.on, thing.inside, thing.pose) = (None, None, None);
    for _ in 0..TRIES {
        let goes_in = !closets.is_empty() && draw.chance(inside);
        let Some(holder) = draw.pick(if goes_in { &closets } else { &tops }) else { return false };
        let Some(pose) = spot(scene, holder, [wide, deep, high], draw) else { continue };
        let holder = Some(holder.id.clone());
        (thing.on, thing.inside) = if goes_in { (None, holder) } else { (holder, None) };
        thing.pose = Some(pose);
        return true;
    }
    false
}

/// Draws a free pose on a surface, near its edge, or in a container, for a thing of some extents in m. `None`
/// where the thing does not fit, or where the drawn one is not free.
pub(crate) fn spot(
    scene: &Scene,
    holder: &Entity,
    [wide, deep, high]: [f64; 3],
    draw: &mut SplitMix64,
) -> Option<Placement> {
    let goes_in = holder.kind == kinds::CONTAINER;
    let (pose, [along, across, height]) = (holder.pose?, holder.extents()?);
    let radius = wide.max(deep) / 2.0;
    let (free_x, free_y) = (along / 2.0 - radius - EDGE[0], across / 2.0 - radius - EDGE[0]);
    if free_x < 0.0 || free_y < 0.0 || (goes_in && high > height - 0.04) {
        return None;
    }
    let (x, y) = if goes_in {
        (draw.within(-free_x, free_x) / 2.0, draw.within(-free_y, free_y) / 2.0)
    } else {
        near_edge(free_x, free_y, draw)
    };
    let z = if goes_in { high / 2.0 - height / 2.0 + 0.01 } else { height / 2.0 + high / 2.0 };
    let [_, _, yaw] = pose.rpy;
    let (sine, cosine) = libm::sincos(yaw);
    let [at_x, at_y, at_z] = pose.xyz;
    let xyz = [at_x + cosine * x - sine * y, at_y + sine * x + cosine * y, at_z + z].map(millimetres);
    let crowded = scene.entities.values().any(|other| {
        let stands = other.on.as_ref() == Some(&holder.id) || other.inside.as_ref() == Some(&holder.id);
        stands && near(other, xyz, radius)
    });
    (!crowded).then_some(Placement { xyz, rpy: [0.0; 3] })
}

/// A spot near one of the four edges, in the frame of the top's middle.
fn near_edge(free_x: f64, free_y: f64, draw: &mut SplitMix64) -> (f64, f64) {
    let inwards = draw.within(0.0, EDGE[1] - EDGE[0]);
    let side = if draw.chance(0.5) { 1.0 } else { -1.0 };
    if draw.chance(free_x / (free_x + free_y).max(f64::EPSILON)) {
        (draw.within(-free_x, free_x), side * (free_y - inwards).max(0.0))
    } else {
        (side * (free_x - inwards).max(0.0), draw.within(-free_y, free_y))
    }
}

/// True if an entity is too close to a spot for a thing of this radius.
fn near(other: &Entity, [x, y, _]: [f64; 3], radius: f64) -> bool {
    let (Some(pose), Some([wide, deep, _])) = (other.pose, other.extents()) else {
        return false;
    };
    let [other_x, other_y, _] = pose.xyz;
    libm::hypot(other_x - x, other_y - y) < radius + wide.max(deep) / 2.0 + BETWEEN
}

fn millimetres(value: f64) -> f64 {
    (value * 1e3).round() / 1e3
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use motet_robots::builtin::{self, BuiltinScene};
    use motet_robots::scene;
    use rand_xoshiro::rand_core::SeedableRng as _;

    use super::*;

    #[test]
    fn vary_rooms_differ_and_each_is_a_scene_without_a_mistake() {
        let catalogue = things();
        assert!(catalogue.entities.len() > 30);
        let mut all = BTreeSet::new();
        for BuiltinScene { name, .. } in builtin::SCENES {
            let base = builtin::scene(name).unwrap();
            for seed in 0..40 {
                let varied = vary(&base, &catalogue, &mut SplitMix64::seed_from_u64(seed));
                assert_eq!(varied, vary(&base, &catalogue, &mut SplitMix64::seed_from_u64(seed)));
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
        assert_eq!(all.len(), 120, "no two scenes are the same");
    }
}
