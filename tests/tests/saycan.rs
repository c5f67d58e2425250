//! The SayCan plans, turned into policies and scenes, check, compile and run to their goals in simulation.

#![allow(clippy::print_stdout, reason = "a skipped test says so")]

use std::path::Path;

use motet_tests::eval::{Judged, saycan, summary};

/// Beside the checkout, where the reference data is kept.
const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data/saycan/saycan.jsonl");

#[test]
fn every_plan_reaches_its_goal() {
    if !Path::new(DATA).exists() {
        println!("skipped: {DATA} is not there");
        return;
    }
    let text = std::fs::read_to_string(DATA).unwrap();
    let rows: Vec<_> = text.lines().map(|line| saycan::judge(line).unwrap()).collect();
    let wrong: Vec<_> = rows.iter().filter_map(Judged::disagreement).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    let summary = summary(&rows);
    assert!(summary.total >= 50 && summary.agree == summary.total, "{summary:?}");
}

#[test]
fn a_plan_for_an_object_that_is_not_there_is_refused_before_it_runs() {
    let row = r#"{"id": "made-up", "instruction": "Bring me the banana.", "robot_start": {"at": "user", "holding": null},
        "scene": {"apple": "table"}, "expected_plan": [{"op": "go", "args": ["table"]}, {"op": "pick", "args": ["banana"]}],
        "goal": [["holding", "banana"]]}"#;
    let judged = saycan::judge(row).unwrap();
    assert!(judged.note.as_ref().unwrap().starts_with("M0202"), "{judged:?}");
    assert!(judged.found_error);
}
