//! Sessions, checks and random choices for the tests of the acceptor.

#![allow(dead_code, unreachable_pub, reason = "the benchmark uses a part of it")]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

pub mod dice;
pub mod peer;
pub mod tokens;
pub mod walks;

use motet_compiler::Session;
use motet_robots::builtin;
use motet_syntax::{FileId, Severity, Source, Sources};

/// The session of an embedded robot in an embedded scene.
pub fn session(robot: &str, scene: &str) -> Session {
    let mut sources = Sources::default();
    let texts = builtin::robot_texts(robot).unwrap_or_else(|| panic!("no robot `{robot}`"));
    let source = Source::new(format!("{robot}/robot.toml"), texts.card);
    let id = sources.add(source.clone());
    let robot = motet_robots::card::read(&source, id, texts.declarations).0.unwrap();
    let texts = builtin::scene_text(scene).unwrap_or_else(|| panic!("no scene `{scene}`"));
    let source = Source::new(scene, texts.json);
    let id = sources.add(source.clone());
    let scene = motet_robots::scene::read(&source, id).0.unwrap();
    Session::builder().robot(&robot).scene(&scene).build(&mut sources)
}

/// What is wrong with a document.
pub fn errors(session: &Session, text: &str) -> Vec<String> {
    let parsed = motet_syntax::read(&Source::new("policy.json", text), FileId(7));
    let said = session.check(&parsed).into_iter();
    said.filter(|said| said.severity == Severity::Error)
        .map(|said| format!("{} {} at {}", said.code, said.message, said.path))
        .collect()
}
