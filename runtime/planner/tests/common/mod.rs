//! The HSR in the kitchen, with and without walls about its table.
#![allow(clippy::unwrap_used, clippy::indexing_slicing, reason = "a test fails by panicking")]

use motet_compiler::{Geometry, Options, Session};
use motet_geometry::planning::SearchBudget;
use motet_robots::card::{self, Robot};
use motet_robots::scene::{self, EntityShape, Placement, Scene};
use motet_robots::urdf;
use motet_syntax::{FileId, Source, Sources};
use std::sync::Arc;

pub(crate) fn hsr() -> Robot {
    let (_, toml, own) = card::embedded().iter().find(|(name, ..)| *name == "hsr").unwrap();
    card::read(&Source::new("hsr", *toml), FileId(0), *own).0.unwrap()
}

pub(crate) fn kitchen() -> Scene {
    let (_, text) = scene::embedded().iter().find(|(name, _)| *name == "kitchen").unwrap();
    scene::read(&Source::new("kitchen", *text), FileId(0)).0.unwrap()
}

/// The kitchen with walls around the table, higher than the robot.
pub(crate) fn walled() -> Scene {
    let mut scene = kitchen();
    let walls = [(2.2, -0.8, 2.7, 0.1), (2.2, 1.8, 2.7, 0.1), (0.9, 0.5, 0.1, 2.7), (3.5, 0.5, 0.1, 2.7)];
    for ((x, y, along, across), at) in walls.into_iter().zip(0..) {
        let mut wall = scene.entities["shelf"].clone();
        wall.id = format!("wall_{at}").into();
        wall.pose = Some(Placement { xyz: [x, y, 1.0], rpy: [0.0; 3] });
        wall.shape = Some(EntityShape::Box([along, across, 2.0]));
        scene.entities.insert(wall.id.clone(), wall);
    }
    scene
}

pub(crate) fn session(scene: &Scene) -> Session {
    let robot = hsr();
    let urdf = urdf::read(&Source::new("hsr", card::embedded_urdf("hsr").unwrap()), FileId(0)).0.unwrap();
    let (session, said) =
        Session::new(Some(&robot), &[], Some(scene), None, Options::default(), &mut Sources::default());
    assert!(said.is_empty(), "{said:?}");
    session.with_geometry(Arc::new(Geometry::new(&robot, &urdf, scene, None, SearchBudget::default())))
}
