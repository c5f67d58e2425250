//! PlanBench: plans for the blocks world by language models, with the verdict of VAL.
//!
//! A row becomes the domain `blocks.motet` with the row's blocks and start, and a policy of the plan's steps
//! with the row's goal. Every verdict is the compiler's.

use std::fmt::Write as _;

use indexmap::IndexMap;
use serde::Deserialize;
use serde_json::{Value, json};

use super::{Judged, check_in_domain, first_error};

const DOMAIN: &str = include_str!("blocks.motet");
const TABLE: &str = "table";

/// A row of `blocksworld.jsonl`.
#[derive(Clone, Debug, Deserialize)]
pub struct Row {
    id: String,
    objects: Vec<String>,
    init_support: IndexMap<String, String>,
    goal_support: IndexMap<String, String>,
    plan: Vec<Op>,
    verdict: String,
    first_error_step: Option<usize>,
}

#[derive(Clone, Debug, Deserialize)]
struct Op {
    op: String,
    args: Vec<String>,
    from: Option<String>,
}

/// Judges a line.
///
/// # Errors
///
/// Where the line is no such row.
pub fn judge(line: &str) -> Result<Judged, String> {
    let row: Row = serde_json::from_str(line).map_err(|error| error.to_string())?;
    let (said, took) = check_in_domain(&row.domain(), &row.policy());
    let error = first_error(&said);
    let step = row.first_error_step.map(|expected| {
        let found = error.map(|error| step_of(&error.path)).unwrap_or_default();
        (expected.to_string(), found)
    });
    Ok(Judged {
        id: row.id,
        expected_error: row.verdict != "ok",
        found_error: error.is_some(),
        class: None,
        step,
        took,
        group: None,
        note: None,
    })
}

/// The number of a step, from 1: `/steps/2` is step 3.
fn step_of(path: &str) -> String {
    let index = path.strip_prefix("/steps/").and_then(|rest| rest.split('/').next()?.parse::<usize>().ok());
    index.map_or_else(|| "end".to_owned(), |index| (index + 1).to_string())
}

impl Row {
    fn domain(&self) -> String {
        let mut text = DOMAIN.to_owned();
        let name = |block: &String| format!("`{block}`");
        let blocks: Vec<_> = self.objects.iter().map(name).collect();
        let mut facts = vec!["hand_empty()".to_owned()];
        for block in &self.objects {
            match self.init_support.get(block) {
                Some(below) if below != TABLE => {
                    facts.push(format!("stands_on({}, {})", name(block), name(below)))
                }
                Some(_) => facts.push(format!("on_table({})", name(block))),
                None => {}
            }
            if !self.init_support.values().any(|below| below == block) {
                facts.push(format!("is_clear({})", name(block)));
            }
        }
        // Writing to a string cannot fail.
        let _ = write!(text, "\nentity {}: Block\n\ninitially {}\n", blocks.join(", "), facts.join(", "));
        text
    }

    fn policy(&self) -> String {
        let steps: Vec<_> = self.plan.iter().map(step).collect();
        let goal = self.goal_support.iter().map(|(block, below)| {
            if below == TABLE {
                json!({"is": "on_table", "block": block})
            } else {
                json!({"is": "stands_on", "block": block, "below": below})
            }
        });
        let goal: Vec<_> = goal.collect();
        json!({"motet": 1, "policy": "plan", "achieves": {"all": goal}, "steps": steps}).to_string()
    }
}

fn step(op: &Op) -> Value {
    let block = op.args.first().cloned().unwrap_or_default();
    let target = op.args.get(1).or(op.from.as_ref()).map_or(TABLE, String::as_str);
    match (op.op.as_str(), target) {
        ("pick", TABLE) => json!({"do": "pick_up", "block": block}),
        ("pick", below) => json!({"do": "unstack", "block": block, "below": below}),
        ("place", TABLE) => json!({"do": "put_down", "block": block}),
        ("place", below) => json!({"do": "stack", "block": block, "below": below}),
        (other, _) => json!({"do": other, "block": block}),
    }
}
