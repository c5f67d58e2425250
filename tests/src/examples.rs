//! The policies of `examples/`.

use std::path::{Path, PathBuf};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples");

/// The examples in text, with the robot and the scene that their first lines name, in the order of their
/// names. Panics where a file cannot be read or says neither.
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

/// Lines made wrong, each with what is wrong. The line must call `go` with an entity, and end in `]}`.
#[must_use]
pub fn near_misses(line: &str) -> Vec<(&'static str, String)> {
    let change = |what, from: &str, to: &str| {
        let changed = line.replacen(from, to, 1);
        (changed != line).then_some((what, changed))
    };
    let found = [
        change("a version that is none", r#"{"motet":1,"#, r#"{"motet":2,"#),
        change("another robot", r#""robot":""#, r#""robot":"not_"#),
        change("a primitive that is none", r#"{"do":"go""#, r#"{"do":"fly""#),
        change("a parameter that is none", r#"{"do":"go","to""#, r#"{"do":"go","of""#),
        change("an entity that is none", r#"{"do":"go","to":""#, r#"{"do":"go","to":"no_"#),
        change("a number for an entity", r#"{"do":"go","to":""#, r#"{"do":"go","to":1,"_":""#),
        change("keys in another order", r#""policy":"#, r#""steps":[],"policy":"#),
        change("a key that is missing", r#","achieves":"#, r#","goal":"#),
        change("a step without its first key", r#""steps":[{"#, r#""steps":[{},{"#),
        change("an ending that is none", r#"]}"#, r#",{"end":"stop"}]}"#),
        Some(("something behind the end", format!("{line},"))),
        Some(("no end", line.get(..line.len() - 1).unwrap_or("").to_owned())),
    ];
    found.into_iter().flatten().collect()
}
