//! Every plan of PlanBench's blocks world gets the verdict of VAL, and its first failing step.

#![allow(clippy::print_stdout, reason = "a skipped test says so")]

use std::path::Path;

use motet_tests::eval::{Judged, planbench, summary};

/// Beside the checkout, where the reference data is kept.
const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data/planbench/blocksworld.jsonl");

#[test]
fn every_verdict_is_that_of_val() {
    if !Path::new(DATA).exists() {
        println!("skipped: {DATA} is not there");
        return;
    }
    let text = std::fs::read_to_string(DATA).unwrap();
    let rows: Vec<_> = text.lines().map(|line| planbench::judge(line).unwrap()).collect();
    let wrong: Vec<_> = rows.iter().filter_map(Judged::disagreement).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    let summary = summary(&rows);
    assert!(summary.total >= 80 && summary.step_total >= 50, "{summary:?}");
}

#[test]
fn other_names_and_a_step_that_fails() {
    let row = r#"{"id": "made-up", "objects": ["red block", "7"], "init_support": {"red block": "table", "7": "red block"},
        "goal_support": {"red block": "7"}, "verdict": "error", "first_error_step": 1,
        "plan": [{"op": "pick", "args": ["red block"], "from": "table"}, {"op": "place", "args": ["red block", "7"]}]}"#;
    assert_eq!(planbench::judge(row).unwrap().disagreement(), None);
}
