//! The policies of `examples/`.

use std::path::{Path, PathBuf};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples");

/// The examples in text, with the robot and the scene that their first lines name, in the order of their
/// names. Panics
/// where a file cannot be read or says neither.
#[must_use]
#[expect(clippy::unwrap_used, reason = "a test without its examples cannot go on")]
pub fn examples() -> Vec<(PathBuf, String, String)> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(FOLDER).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "motet") {
            let text = read(&path);
            let (_, rest) = text.split_once("Robot ").unwrap();
            let (robot, rest) = rest.split_once(", scene ").unwrap();
            let (scene, _) = rest.split_once('.').unwrap();
            found.push((path, robot.to_owned(), scene.to_owned()));
        }
    }
    found.sort();
    assert!(found.len() >= 8, "there are {} examples", found.len());
    found
}

/// A file's text. Panics where it cannot be read.
#[must_use]
#[expect(clippy::unwrap_used, reason = "a test without its files cannot go on")]
pub fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap()
}
