//! Robots, scenes and sessions by name, for tests.

use motet_compiler::{Options, Session};
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_syntax::{Diagnostic, Source, Sources};

/// An embedded robot. Panics where there is none: a test named it.
#[must_use]
#[expect(clippy::panic, reason = "a test that names a robot which is not there cannot go on")]
pub fn robot(name: &str) -> Robot {
    let Some((name, toml, declarations)) = motet_robots::card::embedded().iter().find(|row| row.0 == name)
    else {
        panic!("no robot `{name}`");
    };
    let mut sources = Sources::default();
    let source = Source::new(format!("{name}/robot.toml"), *toml);
    let id = sources.add(source.clone());
    let (robot, said) = motet_robots::card::read(&source, id, *declarations);
    robot.unwrap_or_else(|| panic!("{name}: {said:?}"))
}

/// An embedded scene. Panics where there is none: a test named it.
#[must_use]
#[expect(clippy::panic, reason = "a test that names a scene which is not there cannot go on")]
pub fn scene(name: &str) -> Scene {
    let Some((name, json)) = motet_robots::scene::embedded().iter().find(|row| row.0 == name) else {
        panic!("no scene `{name}`");
    };
    scene_from(name, json)
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

/// A session of a robot in a scene, with what is wrong with them.
#[must_use]
pub fn session(
    robot: Option<&Robot>,
    scene: Option<&Scene>,
    sources: &mut Sources,
) -> (Session, Vec<Diagnostic>) {
    Session::new(robot, &[], scene, None, Options::default(), sources)
}
