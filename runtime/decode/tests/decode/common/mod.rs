//! Sessions, checks and random choices for the tests of the acceptor.

#![allow(dead_code, unreachable_pub, reason = "the benchmark uses a part of it")]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

pub mod dice;
pub mod peer;
pub mod tokens;
pub mod walks;

use motet_compiler::Session;
use motet_syntax::{FileId, Severity, Source, Sources};

/// The session of an embedded robot in an embedded scene.
pub fn session(robot: &str, scene: &str) -> Session {
    let mut sources = Sources::default();
    let row = motet_robots::card::embedded().iter().find(|row| row.0 == robot);
    let (name, toml, declarations) = row.unwrap_or_else(|| panic!("no robot `{robot}`"));
    let source = Source::new(format!("{name}/robot.toml"), *toml);
    let id = sources.add(source.clone());
    let robot = motet_robots::card::read(&source, id, *declarations).0.unwrap();
    let row = motet_robots::scene::embedded().iter().find(|row| row.0 == scene);
    let (name, json) = row.unwrap_or_else(|| panic!("no scene `{scene}`"));
    let source = Source::new(*name, *json);
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
