//! From rows to lines.

use motet_planner::dialect::exchange::Exchange;
use serde_json::{Value, json};

use super::Form;
use crate::row::{About, Row};

/// A row as a line of JSON, without a line break.
#[must_use]
pub fn write(row: &Row, form: Form) -> String {
    let about = about(&row.about);
    let value = match form {
        Form::Trl => json!({
            "messages": [
                {"role": "system", "content": row.system},
                {"role": "user", "content": row.user},
                {"role": "assistant", "content": row.policy},
            ],
            "motet": about,
        }),
        Form::LlamaFactory => json!({
            "conversations": [{"from": "human", "value": row.user}, {"from": "gpt", "value": row.policy}],
            "system": row.system,
            "motet": about,
        }),
        Form::QwenVl => json!({
            "conversations": [
                {"from": "human", "value": format!("{}\n{}", row.system, row.user)},
                {"from": "gpt", "value": row.policy},
            ],
            "motet": about,
        }),
        Form::InteLiPlan => json!({"text": exchange(row).write(), "motet": about}),
    };
    value.to_string()
}

fn exchange(row: &Row) -> Exchange {
    Exchange {
        history: row.history.clone(),
        user: row.request.clone(),
        vision: row.vision.clone(),
        feasibility: row.feasibility.clone(),
        robot: row.actions.clone(),
    }
}

fn about(about: &About) -> Value {
    let failures: Vec<&str> = about.failures.iter().map(|kind| kind.name()).collect();
    json!({
        "robot": about.robot.as_str(),
        "scene": about.scene.as_str(),
        "task": about.task.name(),
        "failures": failures.join(","),
        "turn": about.turn.to_string(),
    })
}

/// The `dataset_info.json` by which LLaMA-Factory knows the files of a folder, which have these names without `.jsonl`.
#[must_use]
pub fn dataset_info(names: &[&str]) -> String {
    let sets = names.iter().map(|name| {
        let set = json!({
            "file_name": format!("{name}.jsonl"),
            "formatting": "sharegpt",
            "columns": {"messages": "conversations", "system": "system"},
        });
        (format!("motet_{name}"), set)
    });
    let whole = Value::Object(sets.collect());
    serde_json::to_string_pretty(&whole).unwrap_or_default()
}
