//! Formats of rows: a JSON object per line, as trainers read it.
//!
//! | format | a row | reader |
//! |---|---|---|
//! | [`RowFormat::Trl`] | `messages` with `role` and `content` | TRL's `SFTTrainer`, as a conversation |
//! | [`RowFormat::LlamaFactory`] | `conversations`: `from`, `value`; `system` | `sharegpt` of LLaMA-Factory |
//! | [`RowFormat::QwenVl`] | `conversations` alone: no system part | the trainer of Qwen2.5-VL |
//! | [`RowFormat::InteLiPlan`] | `text` with tags and a list of actions | TRL's `SFTTrainer`, as plain text |
//!
//! Beside that each row has `motet`, an object of texts, which trainers pass over and [`crate::lint`] needs:
//! the robot, the scene, the task, what goes wrong, and the turn.

use motet_planner::dialogue::Kind;
use motet_planner::inteliplan::exchange::{self, Exchange};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use smol_str::SmolStr;

use crate::picture::Pictures;

/// Format of rows.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum RowFormat {
    /// As TRL reads them.
    Trl,
    /// As LLaMA-Factory reads them.
    LlamaFactory,
    /// As the trainer of Qwen2.5-VL reads them.
    QwenVl,
    /// In InteLiPlan's dialect.
    InteLiPlan,
}

/// A row as a line of JSON, without a line break.
#[must_use]
pub fn write(row: &Row, form: RowFormat) -> String {
    let tag = TAG.repeat(row.images.len());
    let mut value = match form {
        RowFormat::Trl => json!({
            "messages": [
                {"role": "system", "content": content(row, &row.system, ImagePart::Text)},
                {"role": "user", "content": content(row, &row.user, ImagePart::Picture)},
                {"role": "assistant", "content": content(row, &row.policy, ImagePart::Text)},
            ],
        }),
        RowFormat::LlamaFactory => json!({
            "conversations": [
                {"from": "human", "value": format!("{tag}{}", row.user)},
                {"from": "gpt", "value": row.policy},
            ],
            "system": row.system,
        }),
        RowFormat::QwenVl => json!({
            "conversations": [
                {"from": "human", "value": format!("{tag}{}\n{}", row.system, row.user)},
                {"from": "gpt", "value": row.policy},
            ],
        }),
        RowFormat::InteLiPlan => json!({"text": in_dialect(row).write()}),
    };
    if let Some(fields) = value.as_object_mut() {
        if let Some(column) = column(form).filter(|_| !row.images.is_empty()) {
            let images: Vec<&str> = row.images.iter().map(SmolStr::as_str).collect();
            fields.insert(column.to_owned(), json!(images));
        }
        fields.insert("motet".to_owned(), about(&row.about));
    }
    value.to_string()
}

/// The column of the pictures of a row; none of a form that has none.
const fn column(form: RowFormat) -> Option<&'static str> {
    match form {
        RowFormat::Trl | RowFormat::LlamaFactory => Some("images"),
        RowFormat::QwenVl => Some("image"),
        RowFormat::InteLiPlan => None,
    }
}

/// Place of a row's image in a message.
#[derive(Clone, Copy, PartialEq, Eq)]
enum ImagePart {
    Text,
    Picture,
}

/// Content of a TRL message: a string, or parts in all messages of a row with an image, so that a column has
/// one type.
fn content(row: &Row, text: &str, shown: ImagePart) -> Value {
    let said = json!({"type": "text", "text": text});
    match shown {
        _ if row.images.is_empty() => text.into(),
        ImagePart::Text => json!([said]),
        ImagePart::Picture => {
            let images = row.images.iter().map(|_| json!({"type": "image"}));
            images.chain([said]).collect()
        }
    }
}

fn in_dialect(row: &Row) -> Exchange {
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
        "task": about.task.as_str(),
        "failures": failures.join(","),
        "turn": about.turn.to_string(),
    })
}

/// The `dataset_info.json` by which LLaMA-Factory knows the files of a folder, which have these names without
/// `.jsonl`, and whether rows have pictures.
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

/// Properties of a row, beside its texts.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct About {
    /// The robot's name.
    pub robot: SmolStr,
    /// The name of the scene as it is in this row: that of the varied scene, with a number behind a point
    /// where something has happened in it.
    pub scene: SmolStr,
    /// Name of the task or of the lesson; [`UPDATE`] of a turn in which a person changed the request.
    pub task: SmolStr,
    /// Failures in the conversation, in their order.
    pub failures: Vec<Kind>,
    /// Turn of the conversation, from 0.
    pub turn: usize,
}

/// One turn of a conversation in which a planner is asked.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Row {
    pub about: About,
    /// System message, as `motet do` sends it.
    pub system: String,
    pub user: String,
    /// The pictures that it is shown: paths as seen from the folder of the row's file.
    pub images: Vec<SmolStr>,
    /// The policy on the model surface.
    pub policy: String,
    /// The request in its words.
    pub request: String,
    pub history: String,
    /// Visibility of the named things.
    pub vision: String,
    /// Reachability of the named things.
    pub feasibility: String,
    /// The plan as a list of actions, or the question.
    pub actions: String,
}

/// Task of the turns in which a person changed the request while it was carried out.
pub const UPDATE: &str = "update";

/// Mark of an image in a text.
const TAG: &str = "<image>";

/// A row as it stands in a file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Read {
    /// The robot, where the row says.
    pub robot: Option<SmolStr>,
    /// The scene, where the row says.
    pub scene: Option<SmolStr>,
    /// Its task, where the row says.
    pub task: Option<SmolStr>,
    /// Failures in its conversation by name, in their order, where the row says.
    pub failures: Vec<SmolStr>,
    /// Turn of its conversation, from 0; 0 where the row does not say.
    pub turn: usize,
    /// Everything that the model is shown, of pictures where they are.
    pub input: String,
    /// The paths of its pictures, as seen from the folder of its file.
    pub images: Vec<String>,
    /// Number of image marks in the messages, if the format has them.
    pub places: Option<usize>,
    pub target: Target,
}

/// Wanted reply of a model.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Target {
    /// A policy, in either form of the language.
    Policy(String),
    /// A list of actions in InteLiPlan's dialect.
    Actions(String),
    Question(String),
}

impl Target {
    /// Text of the reply.
    #[must_use]
    pub fn text(&self) -> &str {
        match self {
            Self::Policy(text) | Self::Actions(text) | Self::Question(text) => text,
        }
    }
}

/// Reads a line. Beside what [`write()`] writes it takes TRL's `prompt` and `completion`, each a
/// text or messages.
///
/// # Errors
///
/// Why it is no row, in a clause.
pub fn read(line: &str) -> Result<Read, String> {
    let row: Value = serde_json::from_str(line).map_err(|error| format!("it is not JSON: {error}"))?;
    if !row.is_object() {
        return Err("it is no JSON object".to_owned());
    }
    let about = |key: &str| row.pointer(&format!("/motet/{key}")).and_then(Value::as_str).map(SmolStr::from);
    let (input, target) = if let Some(messages) = row.get("messages") {
        chat(messages, Keys::OPENAI)?
    } else if let Some(turns) = row.get("conversations") {
        let (input, target) = chat(turns, Keys::SHAREGPT)?;
        let system = row.get("system").and_then(Value::as_str).unwrap_or_default();
        (format!("{system}\n{input}"), target)
    } else if let (Some(prompt), Some(completion)) = (row.get("prompt"), row.get("completion")) {
        let input = said(prompt).ok_or("its `prompt` is neither a text nor messages")?;
        let target = said(completion).ok_or("its `completion` is neither a text nor messages")?;
        (input, Target::Policy(target))
    } else if let Some(text) = row.get("text").and_then(Value::as_str) {
        tagged(text)?
    } else {
        return Err(
            "it has none of `messages`, `conversations`, `prompt` with `completion`, and `text`".to_owned()
        );
    };
    if target.text().trim().is_empty() {
        return Err("its answer is empty".to_owned());
    }
    let images = images(&row)?;
    let places = places(&row, &input);
    let input = images.iter().fold(input, |input, image| format!("{input}\n{image}"));
    let failures = about("failures").unwrap_or_default();
    let failures = failures.split(',').filter(|name| !name.is_empty()).map(SmolStr::from).collect();
    let turn = about("turn").and_then(|turn| turn.parse().ok()).unwrap_or_default();
    let (robot, scene, task) = (about("robot"), about("scene"), about("task"));
    Ok(Read { robot, scene, task, failures, turn, input, images, places, target })
}

/// The pictures that a row names: a path, or a list of them.
fn images(row: &Value) -> Result<Vec<String>, String> {
    match row.get("images").or_else(|| row.get("image")) {
        None | Some(Value::Null) => Ok(Vec::new()),
        Some(Value::String(path)) => Ok(vec![path.clone()]),
        Some(Value::Array(paths)) => {
            let paths = paths.iter().map(|path| path.as_str().map(ToOwned::to_owned));
            paths.collect::<Option<_>>().ok_or_else(|| "its images are no paths".to_owned())
        }
        Some(_) => Err("its images are no paths".to_owned()),
    }
}

/// The places for pictures: parts in messages of TRL's form, which puts them there by itself where there
/// are none; else tags.
fn places(row: &Value, input: &str) -> Option<usize> {
    let Some(messages) = row.get("messages").and_then(Value::as_array) else {
        return Some(input.matches(TAG).count());
    };
    let parts = messages.iter().filter_map(|message| message.get("content").and_then(Value::as_array));
    let mut count = None;
    for part in parts.flatten() {
        *count.get_or_insert(0) += usize::from(part.get("type").and_then(Value::as_str) == Some("image"));
    }
    count
}

/// The names of things in a chat.
struct Keys {
    who: &'static str,
    text: &'static str,
    system: &'static str,
    user: &'static str,
    assistant: &'static str,
}

impl Keys {
    const OPENAI: Self =
        Self { who: "role", text: "content", system: "system", user: "user", assistant: "assistant" };
    const SHAREGPT: Self =
        Self { who: "from", text: "value", system: "system", user: "human", assistant: "gpt" };
}

/// Splits a chat into the messages before the last one, and the last one. User and assistant alternate,
/// after at most one system message.
fn chat(messages: &Value, keys: Keys) -> Result<(String, Target), String> {
    let messages = messages.as_array().ok_or("its messages are no list")?;
    let mut input = String::new();
    let mut answer = None;
    let mut expects = keys.user;
    for (index, message) in messages.iter().enumerate() {
        let number = index + 1;
        let of = |key: &str| message.get(key).and_then(Value::as_str);
        let who = of(keys.who).ok_or_else(|| format!("message {number} has no `{}`", keys.who))?;
        let text = message.get(keys.text).and_then(plain_text);
        let text = text.ok_or_else(|| format!("message {number} has no `{}`", keys.text))?;
        if who == keys.system && index == 0 {
            input.push_str(&text);
            input.push('\n');
            continue;
        }
        if who != expects {
            return Err(format!(
                "message {number} is of `{who}`, after the one before it is `{expects}`'s turn"
            ));
        }
        if who == keys.assistant {
            answer = Some(text);
            expects = keys.user;
        } else {
            if let Some(before) = answer.take() {
                input.push_str(&before);
                input.push('\n');
            }
            input.push_str(&text);
            input.push('\n');
            expects = keys.assistant;
        }
    }
    match answer {
        Some(answer) => Ok((input, Target::Policy(answer))),
        None => Err(format!("its last message is not of `{}`", keys.assistant)),
    }
}

/// A text, or the texts of messages.
fn said(value: &Value) -> Option<String> {
    if let Some(text) = value.as_str() {
        return Some(text.to_owned());
    }
    let messages = value.as_array()?;
    let texts: Option<Vec<String>> =
        messages.iter().map(|message| message.get("content").and_then(plain_text)).collect();
    texts.map(|texts| texts.join("\n"))
}

/// Text of a message: a string, or the joined texts of its parts.
fn plain_text(value: &Value) -> Option<String> {
    if let Some(text) = value.as_str() {
        return Some(text.to_owned());
    }
    let texts = value.as_array()?.iter().filter_map(|part| part.get("text").and_then(Value::as_str));
    Some(texts.collect::<Vec<_>>().join("\n"))
}

/// The last exchange of a text in InteLiPlan's dialect, and what is before it.
fn tagged(text: &str) -> Result<(String, Target), String> {
    let mut exchanges = exchange::read(text).map_err(|why| why.to_string())?;
    let mut last = exchanges.pop().unwrap_or_default();
    let is_question = last.asks();
    let answer = std::mem::take(&mut last.robot);
    exchanges.push(last);
    let input: String = exchanges.iter().map(Exchange::write).collect();
    Ok((input, if is_question { Target::Question(answer) } else { Target::Actions(answer) }))
}
