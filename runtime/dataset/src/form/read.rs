//! From lines to what a model is shown and shall answer, whichever form they are in.

use motet_planner::inteliplan::exchange;
use serde_json::Value;
use smol_str::SmolStr;

/// Mark of an image in a text.
const TAG: &str = "<image>";

/// A row as it stands in a file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Read {
    /// The robot, where the row says.
    pub robot: Option<SmolStr>,
    /// The room, where the row says.
    pub scene: Option<SmolStr>,
    /// Everything that the model is shown, of pictures where they are.
    pub input: String,
    /// The paths of its pictures, as seen from the folder of its file.
    pub images: Vec<String>,
    /// Number of image marks in the messages, if the format has them.
    pub places: Option<usize>,
    pub target: Target,
}

/// Wanted reply of a model.
#[derive(Clone, PartialEq, Eq, Debug)]
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

/// Reads a line. Beside what [`super::write()`] writes it takes TRL's `prompt` and `completion`, each a
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
    Ok(Read { robot: about("robot"), scene: about("scene"), input, images, places, target })
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
        let text = message.get(keys.text).and_then(content);
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
        messages.iter().map(|message| message.get("content").and_then(content)).collect();
    texts.map(|texts| texts.join("\n"))
}

/// Text of a message: a string, or the joined texts of its parts.
fn content(value: &Value) -> Option<String> {
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
    let input: String = exchanges.iter().map(exchange::Exchange::write).collect();
    Ok((input, if is_question { Target::Question(answer) } else { Target::Actions(answer) }))
}
