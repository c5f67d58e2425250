//! Every plan of PlanBench's blocks world gets the verdict of VAL, and its first failing step.

use motet_eval::{Judged, planbench, summary};

/// Beside the checkout, where the reference data is kept.
const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data/planbench/blocksworld.jsonl");

#[test]
#[ignore = "needs the reference data in ../shared/data"]
fn planbench_verdicts_equal_val() {
    let text = std::fs::read_to_string(DATA).unwrap();
    let rows: Vec<_> = text.lines().map(|line| planbench::judge(line).unwrap()).collect();
    let wrong: Vec<_> = rows.iter().filter_map(Judged::disagreement).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    let summary = summary(&rows);
    assert!(summary.total >= 80 && summary.step_total >= 50, "{summary:?}");
}

#[test]
fn planbench_reads_other_names_and_a_failing_step() {
    let row = r#"{"id": "made-up", "objects": ["red block", "7"], "init_support": {"red block": "table",
        "7": "red block"},
        "goal_support": {"red block": "7"}, "verdict": "error", "first_error_step": 1,
        "plan": [{"op": "pick", "args": ["red block"], "from": "table"}, {"op": "place",
            "args": ["red block", "7"]}]}"#;
    assert_eq!(planbench::judge(row).unwrap().disagreement(), None);
}
