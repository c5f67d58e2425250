//! A few rooms: every witness holds, no reachable target is certified not to be, and most are found.

#![allow(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    clippy::disallowed_methods,
    missing_docs,
    reason = "a test fails by panicking"
)]

use std::path::PathBuf;

use motet_reach::{Settings, Truth, furnished, robot, run, targets, truth};
use motet_robots::scene;
use motet_syntax::{FileId, Source};

#[test]
#[ignore = "searches for a minute or more: run it with --ignored"]
fn reach_witnesses_hold() {
    let robots = vec!["hsr".into()];
    let settings = Settings { robots, rooms: 1, seed: 3, is_quick: true, ..Settings::default() };
    let (lines, tables) = run(&settings).unwrap();
    for table in tables {
        assert_eq!(table.uncertified_positives, 0, "{lines:?}");
        assert_eq!(table.contradicted, 0, "{lines:?}");
        assert!(table.recall > 60.0, "{table}\n{lines:?}");
    }
}

/// One can, in the open.
fn can(xyz: [f64; 3]) -> String {
    format!(
        r#"{{"motet_scene": 1, "entities": [{{"id": "can", "kind": "Object", "pose": {{"xyz": {xyz:?}}},
            "mass": 0.2,
            "shape": {{"cylinder": {{"radius": 0.03, "height": 0.12}}}}}}]}}"#
    )
}

/// Where the arm is folded there is no room for the open hand of the HSR: it opens on the way.
#[test]
fn exhaustive_search_finds_open_targets() {
    for (name, xyz) in [("hsr", [1.3, 0.2, 0.6]), ("anymal_z1", [1.5, 0.2, 0.5]), ("panda", [0.45, 0.1, 0.9])]
    {
        let model = robot(name).unwrap();
        let text = can(xyz);
        let scene = scene::read(&Source::new("can.json", text.as_str()), FileId(0)).0.unwrap();
        assert_eq!(truth(&model, &scene, "can", 1), Truth::Reachable, "{name}");
    }
}

#[test]
fn truth_cache_is_kept() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("kept");
    let _ = std::fs::remove_dir_all(&folder);
    let settings = |xyz: [f64; 3]| Settings {
        robots: vec!["panda".into()],
        scene: Some(can(xyz)),
        is_quick: true,
        cache: Some(folder.clone()),
        ..Settings::default()
    };
    let no_state = |xyz| run(&settings(xyz)).unwrap().1[0].no_state;
    let far = [3.0, 0.0, 0.9];
    assert_eq!(no_state(far), 1);
    let file = folder.join("panda-quick.json");
    let kept = std::fs::read_to_string(&file).unwrap();
    assert_eq!(kept.matches("no_state").count(), 1);
    // It is what the file says, and nothing is searched for again.
    std::fs::write(&file, kept.replace("no_state", "no_way")).unwrap();
    assert_eq!(no_state(far), 0);
    // Another scene is another question.
    assert_eq!(no_state([3.1, 0.0, 0.9]), 1);
    assert_eq!(std::fs::read_to_string(&file).unwrap().matches("panda 1 can").count(), 2);
}

/// Neither the number of threads nor the shards change an answer.
#[test]
fn rooms_are_the_same_on_several_threads_and_in_shards() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    let witnesses = |name: &str, jobs, shard: &str| {
        let file = folder.join(name);
        let settings = Settings {
            robots: vec!["panda".into()],
            rooms: 3,
            is_unjudged: true,
            witnesses: Some(file.clone()),
            jobs,
            shard: shard.parse().unwrap(),
            ..Settings::default()
        };
        run(&settings).unwrap();
        std::fs::read_to_string(file).unwrap()
    };
    let whole = witnesses("one.jsonl", 1, "0/1");
    assert!(whole.lines().count() > 2, "{whole}");
    assert_eq!(whole, witnesses("three.jsonl", 3, "0/1"));
    let mut parts = witnesses("even.jsonl", 2, "0/2") + &witnesses("odd.jsonl", 2, "1/2");
    for line in whole.lines() {
        assert!(parts.contains(line), "{line}");
        parts = parts.replacen(&format!("{line}\n"), "", 1);
    }
    assert_eq!(parts, "");
}

#[test]
fn room_generator_is_determined_by_its_seed() {
    for name in ["hsr", "anymal_z1", "panda"] {
        let model = robot(name).unwrap();
        let scene = furnished(&model.machine, 7);
        assert_eq!(scene, furnished(&model.machine, 7));
        assert_ne!(scene, furnished(&model.machine, 8));
        assert!(targets(&scene).len() > 3);
    }
}

#[test]
fn command_reports_wrong_arguments() {
    let (told, is_good) = motet_reach::command(&["--help".into()]).unwrap();
    assert!(is_good);
    for argument in [
        "--robot",
        "--rooms",
        "--seed",
        "--cells",
        "--quick",
        "--unjudged",
        "--witnesses",
        "--targets",
        "--json",
    ] {
        assert!(told.contains(argument), "{argument}");
    }
    assert!(motet_reach::command(&["--nothing".into()]).unwrap_err().contains("--help"));
}
