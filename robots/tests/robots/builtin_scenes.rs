//! The rooms that are built in: nothing stands in anything else, and what stands on something does so.

use motet_robots::builtin::{BuiltinScene, SCENES};
use motet_robots::scene::{self, Entity, Scene};
use motet_syntax::{FileId, Source};

/// Gaps and overlaps that do not count, in m.
const SLACK: f64 = 0.002;

/// Least and greatest corner.
type Bounds = [[f64; 3]; 2];

fn rooms() -> impl Iterator<Item = (&'static str, Scene)> {
    SCENES.into_iter().map(|BuiltinScene { name, json }| {
        let (scene, diagnostics) = scene::read(&Source::new(name, json), FileId(0));
        assert_eq!(diagnostics, [], "{name}");
        (name, scene.unwrap())
    })
}

/// The box around an entity, whose turns are quarters.
fn bounds(entity: &Entity) -> Option<Bounds> {
    let (pose, mut extents) = (entity.pose?, entity.extents()?);
    let quarters = pose.rpy[2] / std::f64::consts::FRAC_PI_2;
    if quarters.round() as i64 % 2 != 0 {
        extents.swap(0, 1);
    }
    let lift = if entity.kind == "Person" { extents[2] / 2.0 } else { 0.0 };
    let centre = [pose.xyz[0], pose.xyz[1], pose.xyz[2] + lift];
    Some([0, 1].map(|end| {
        let sign = if end == 0 { -0.5 } else { 0.5 };
        [0, 1, 2].map(|axis| centre[axis] + sign * extents[axis])
    }))
}

fn bounds_of(scene: &Scene, id: &str) -> Bounds {
    bounds(&scene.entities[id]).unwrap()
}

#[test]
fn builtin_scene_entities_do_not_overlap() {
    for (room, scene) in rooms() {
        let solid: Vec<_> = scene.entities.values().filter_map(|it| Some((it, bounds(it)?))).collect();
        for (index, (a, [a_least, a_most])) in solid.iter().enumerate() {
            for (b, [b_least, b_most]) in &solid[index + 1..] {
                let held = |inner: &Entity, outer: &Entity| inner.inside.as_ref() == Some(&outer.id);
                let meet = (0..3)
                    .all(|axis| a_least[axis] + SLACK < b_most[axis] && b_least[axis] + SLACK < a_most[axis]);
                assert!(!meet || held(a, b) || held(b, a), "{room}: {} and {} overlap", a.id, b.id);
            }
        }
    }
}

#[test]
fn builtin_scene_entities_touch_their_support() {
    for (room, scene) in rooms() {
        for entity in scene.entities.values() {
            let Some(support) = &entity.on else { continue };
            let ([least, most], [under, top]) = (bounds(entity).unwrap(), bounds_of(&scene, support));
            assert!((least[2] - top[2]).abs() < SLACK, "{room}: {} is not on {support}", entity.id);
            let centre = [0, 1].map(|axis| f64::midpoint(least[axis], most[axis]));
            let inside = (0..2).all(|axis| under[axis] <= centre[axis] && centre[axis] <= top[axis]);
            assert!(inside, "{room}: {} falls off {support}", entity.id);
        }
    }
}

#[test]
fn builtin_scene_contents_are_inside_their_container() {
    for (room, scene) in rooms() {
        for entity in scene.entities.values() {
            let Some(container) = &entity.inside else { continue };
            let around = &scene.entities[container];
            let ([least, most], [from, to]) = (bounds(entity).unwrap(), bounds(around).unwrap());
            let way = match (around.open, around.travel) {
                (Some(true), Some(scene::Travel::Slide { axis, distance })) => {
                    axis.map(|part| part * distance)
                }
                _ => [0.0; 3],
            };
            let inside = (0..3)
                .all(|axis| from[axis] + way[axis] <= least[axis] && most[axis] <= to[axis] + way[axis]);
            assert!(inside, "{room}: {} is not in {container}", entity.id);
        }
    }
}

#[test]
fn builtin_scene_start_pose_is_free() {
    for (room, scene) in rooms() {
        let [x, y, _] = scene.robot.base;
        for entity in scene.entities.values() {
            let Some([least, most]) = bounds(entity) else { continue };
            let nearest = [x.clamp(least[0], most[0]) - x, y.clamp(least[1], most[1]) - y];
            assert!(nearest[0].hypot(nearest[1]) > 0.7, "{room}: the robot stands at {}", entity.id);
        }
    }
}

#[test]
fn builtin_scene_places_are_free() {
    for (room, scene) in rooms() {
        for place in scene.entities.values().filter(|entity| entity.kind == "Place") {
            let [x, y, _] = place.pose.unwrap().xyz;
            for entity in scene.entities.values() {
                let Some([least, most]) = bounds(entity) else { continue };
                let nearest = [x.clamp(least[0], most[0]) - x, y.clamp(least[1], most[1]) - y];
                let gap = nearest[0].hypot(nearest[1]);
                assert!(gap > 0.6, "{room}: {} is {gap:.2} m from {}", place.id, entity.id);
            }
        }
    }
}
