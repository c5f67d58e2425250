//! A few rooms: every witness holds, no reachable target is certified not to be, and most are found.

#![allow(clippy::unwrap_used, missing_docs, reason = "a test fails by panicking")]

use motet_geometry::query::Budget;
use motet_reach::{Settings, furnished, robot, run, targets};

#[test]
#[ignore = "searches for a minute or more: run it with --ignored"]
fn witnesses_hold() {
    let robots = vec!["hsr".into()];
    let settings = Settings {
        robots,
        rooms: 1,
        seed: 3,
        scene: None,
        is_quick: true,
        budget: Budget::default(),
        is_unjudged: false,
        cache: None,
        witnesses: None,
        targets: None,
    };
    let (lines, tables) = run(&settings).unwrap();
    for table in tables {
        assert_eq!(table.uncertified_positives, 0, "{lines:?}");
        assert_eq!(table.contradicted, 0, "{lines:?}");
        assert!(table.recall > 60.0, "{table}\n{lines:?}");
    }
}

#[test]
fn a_seed_gives_one_room() {
    for name in ["hsr", "anymal_z1", "panda"] {
        let model = robot(name).unwrap();
        let scene = furnished(&model.machine, 7);
        assert_eq!(scene, furnished(&model.machine, 7));
        assert_ne!(scene, furnished(&model.machine, 8));
        assert!(targets(&scene).len() > 3);
    }
}
