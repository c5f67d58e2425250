//! Sessions, checks and random choices for the tests of the acceptor.

#![allow(dead_code, unreachable_pub, reason = "the benchmark uses a part of it")]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

pub mod peer;
pub mod tokens;
pub mod walks;

use std::sync::Mutex;

use motet_decode::{Environment, Session};
use motet_syntax::{FileId, Severity, Source};

/// The robots and scenes of the tests.
pub const SETTINGS: [(&str, &str); 3] = [("hsr", "kitchen"), ("hsr", "living_room"), ("anymal_z1", "lab")];

/// A zone beside the entities of the scenes, which have none.
const ZONE: &str = "entity stairs: Zone";

/// The session of a built-in robot in a built-in scene, made once for the whole process.
pub fn session(robot: &str, scene: &str) -> Session {
    static MADE: Mutex<Vec<((String, String), Session)>> = Mutex::new(Vec::new());
    let mut made = MADE.lock().unwrap();
    let key = (robot.to_owned(), scene.to_owned());
    if let Some((_, session)) = made.iter().find(|(known, _)| *known == key) {
        return session.clone();
    }
    let (robot, scene, domain) = (Some(robot), Some(scene), Some(ZONE));
    let texts = Environment { robot, scene, domain, ..Environment::default() };
    let session = texts.session().unwrap();
    made.push((key, session.clone()));
    session
}

/// The errors of a document.
pub fn errors(session: &Session, text: &str) -> Vec<String> {
    let parsed = motet_syntax::read(&Source::new("policy.json", text), FileId(7));
    let said = session.check(&parsed).into_iter();
    said.filter(|said| said.severity == Severity::Error)
        .map(|said| format!("{} {} at {}", said.code, said.message, said.path))
        .collect()
}
