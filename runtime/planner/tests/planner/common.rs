//! The HSR in the kitchen, with and without walls around the table.

use motet_compiler::{Geometry, Session};
use motet_geometry::planning::SearchBudget;
use motet_robots::builtin::{self, RobotWithBody};
use motet_robots::card::Robot;
use motet_robots::scene::{EntityShape, Placement, Scene};
use motet_syntax::Sources;
use std::sync::Arc;

pub(super) fn hsr() -> Robot {
    builtin::robot("hsr").unwrap().robot
}

pub(super) fn kitchen() -> Scene {
    builtin::scene("kitchen").unwrap()
}

/// The kitchen with walls around the table, higher than the robot.
pub(super) fn walled() -> Scene {
    let mut scene = kitchen();
    let walls = [(2.2, -0.8, 2.7, 0.1), (2.2, 1.8, 2.7, 0.1), (0.9, 0.5, 0.1, 2.7), (3.5, 0.5, 0.1, 2.7)];
    for ((x, y, along, across), at) in walls.into_iter().zip(0..) {
        let mut wall = scene.entities["shelf"].clone();
        wall.id = format!("wall_{at}").into();
        // The camera sees over them.
        wall.pose = Some(Placement { xyz: [x, y, 0.35], rpy: [0.0; 3] });
        wall.shape = Some(EntityShape::Box([along, across, 0.7]));
        scene.entities.insert(wall.id.clone(), wall);
    }
    scene
}

pub(super) fn session(scene: &Scene) -> Session {
    let RobotWithBody { robot, urdf } = builtin::robot("hsr").unwrap();
    let session = Session::builder().robot(&robot).scene(scene).build(&mut Sources::default());
    let said = session.input_diagnostics().to_vec();
    assert!(said.is_empty(), "{said:?}");
    session.with_geometry(Arc::new(Geometry::new(&robot, &urdf, scene, None, SearchBudget::default())))
}
