//! The SayCan plans, turned into policies and scenes, check, compile and run to their goals in simulation.

use motet_eval::{Judged, saycan, summary};

/// Beside the checkout, where the reference data is kept.
const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data/saycan/saycan.jsonl");

#[test]
#[ignore = "needs the reference data in ../shared/data"]
fn saycan_plans_reach_their_goals() {
    let text = std::fs::read_to_string(DATA).unwrap();
    let rows: Vec<_> = text.lines().map(|line| saycan::judge(line).unwrap()).collect();
    let wrong: Vec<_> = rows.iter().filter_map(Judged::disagreement).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    let summary = summary(&rows);
    assert!(summary.total >= 50 && summary.agree == summary.total, "{summary:?}");
}

#[test]
fn saycan_refuses_a_plan_for_an_absent_object() {
    let row = r#"{"id": "made-up", "instruction": "Bring me the banana.", "robot_start": {"at": "user",
        "holding": null},
        "scene": {"apple": "table"}, "expected_plan": [{"op": "go", "args": ["table"]}, {"op": "pick",
            "args": ["banana"]}],
        "goal": [["holding", "banana"]]}"#;
    let judged = saycan::judge(row).unwrap();
    assert!(judged.note.as_ref().unwrap().starts_with("M0202"), "{judged:?}");
    assert!(judged.found_error);
}
