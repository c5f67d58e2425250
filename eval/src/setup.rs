//! Robots, scenes and sessions by name, for tests.

use std::sync::Arc;

use motet_compiler::{Geometry, Session};
use motet_geometry::planning::SearchBudget;
use motet_robots::builtin::RobotWithBody;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_syntax::{Diagnostic, Source, Sources};

/// An embedded robot. Panics where there is none: a test named it.
#[must_use]
#[expect(clippy::panic, reason = "a test that names a robot which is not there cannot go on")]
pub fn robot(name: &str) -> Robot {
    motet_robots::builtin::robot(name).unwrap_or_else(|| panic!("no robot `{name}`")).robot
}

/// An embedded scene. Panics where there is none: a test named it.
#[must_use]
#[expect(clippy::panic, reason = "a test that names a scene which is not there cannot go on")]
pub fn scene(name: &str) -> Scene {
    motet_robots::builtin::scene(name).unwrap_or_else(|| panic!("no scene `{name}`"))
}

/// A scene from its text. Panics where it is wrong.
#[must_use]
#[expect(clippy::panic, reason = "a test that gives a wrong scene cannot go on")]
pub fn scene_from(name: &str, json: &str) -> Scene {
    let mut sources = Sources::default();
    let source = Source::new(name, json);
    let id = sources.add(source.clone());
    let (scene, said) = motet_robots::scene::read(&source, id);
    scene.unwrap_or_else(|| panic!("{name}: {said:?}"))
}

/// Motion checks for a robot in a scene.
#[must_use]
pub fn geometry(body: &RobotWithBody, scene: &Scene) -> Arc<Geometry> {
    Arc::new(Geometry::new(&body.robot, &body.urdf, scene, None, SearchBudget::default()))
}

/// A session of a robot in a scene, with what is wrong with them.
#[must_use]
pub fn session(
    robot: Option<&Robot>,
    scene: Option<&Scene>,
    sources: &mut Sources,
) -> (Session, Vec<Diagnostic>) {
    let session = Session::builder().robot(robot).scene(scene).build(sources);
    let said = session.input_diagnostics().to_vec();
    (session, said)
}
