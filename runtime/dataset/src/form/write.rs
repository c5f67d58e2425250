//! From rows to lines.

use motet_planner::inteliplan::exchange::Exchange;
use serde_json::{Value, json};

use super::Form;
use crate::picture::Pictures;
use crate::row::{About, Row};

/// A row as a line of JSON, without a line break.
#[must_use]
pub fn write(row: &Row, form: Form) -> String {
    let tag = if row.image.is_some() { "<image>" } else { "" };
    let mut value = match form {
        Form::Trl => json!({
            "messages": [
                {"role": "system", "content": content(row, &row.system, Shown::Text)},
                {"role": "user", "content": content(row, &row.user, Shown::Picture)},
                {"role": "assistant", "content": content(row, &row.policy, Shown::Text)},
            ],
        }),
        Form::LlamaFactory => json!({
            "conversations": [
                {"from": "human", "value": format!("{tag}{}", row.user)},
                {"from": "gpt", "value": row.policy},
            ],
            "system": row.system,
        }),
        Form::QwenVl => json!({
            "conversations": [
                {"from": "human", "value": format!("{tag}{}\n{}", row.system, row.user)},
                {"from": "gpt", "value": row.policy},
            ],
        }),
        Form::InteLiPlan => json!({"text": exchange(row).write()}),
    };
    if let Some(fields) = value.as_object_mut() {
        if let (Some(image), Some(column)) = (&row.image, column(form)) {
            fields.insert(column.to_owned(), json!([image.as_str()]));
        }
        fields.insert("motet".to_owned(), about(&row.about));
    }
    value.to_string()
}

/// The column of the pictures of a row; none of a form that has none.
const fn column(form: Form) -> Option<&'static str> {
    match form {
        Form::Trl | Form::LlamaFactory => Some("images"),
        Form::QwenVl => Some("image"),
        Form::InteLiPlan => None,
    }
}

/// Place of a row's image in a message.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Shown {
    Text,
    Picture,
}

/// Content of a TRL message: a string, or parts in all messages of a row with an image, so that a column has
/// one type.
fn content(row: &Row, text: &str, shown: Shown) -> Value {
    let said = json!({"type": "text", "text": text});
    match (&row.image, shown) {
        (None, _) => text.into(),
        (Some(_), Shown::Text) => json!([said]),
        (Some(_), Shown::Picture) => json!([{"type": "image"}, said]),
    }
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

/// The `dataset_info.json` by which LLaMA-Factory knows the files of a folder, which have these names
/// without `.jsonl`, and
/// whether rows have pictures.
#[must_use]
pub fn dataset_info(names: &[&str], pictures: Pictures) -> String {
    let sets = names.iter().map(|name| {
        let mut columns = json!({"messages": "conversations", "system": "system"});
        if let (Pictures::EachRow, Some(columns)) = (pictures, columns.as_object_mut()) {
            columns.insert("images".to_owned(), "images".into());
        }
        let set = json!({
            "file_name": format!("{name}.jsonl"),
            "formatting": "sharegpt",
            "columns": columns,
        });
        (format!("motet_{name}"), set)
    });
    let whole = Value::Object(sets.collect());
    serde_json::to_string_pretty(&whole).unwrap_or_default()
}
