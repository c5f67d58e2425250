//! From lines to what a model is shown and shall answer, whichever form they are in.

use motet_planner::dialect::exchange;
use serde_json::Value;
use smol_str::SmolStr;

/// A row as it stands in a file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Read {
    /// The robot, where the row says.
    pub robot: Option<SmolStr>,
    /// The room, where the row says.
    pub scene: Option<SmolStr>,
    /// Everything that the model is shown.
    pub input: String,
    /// What it shall answer.
    pub target: Target,
}

/// What a model shall answer.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Target {
    /// A policy, in either form of the language.
    Policy(String),
    /// A list of actions in InteLiPlan's dialect.
    Actions(String),
    /// A question.
    Question(String),
}

impl Target {
    /// Its text.
    #[must_use]
    pub fn text(&self) -> &str {
        match self {
            Self::Policy(text) | Self::Actions(text) | Self::Question(text) => text,
        }
    }
}

/// Reads a line. Beside what [`super::write()`] writes it takes TRL's `prompt` and `completion`, each a text or messages.
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
    Ok(Read { robot: about("robot"), scene: about("scene"), input, target })
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

/// What comes before the last message, and that. Who asks and who answers take turns, behind a system part or none.
fn chat(messages: &Value, keys: Keys) -> Result<(String, Target), String> {
    let messages = messages.as_array().ok_or("its messages are no list")?;
    let mut input = String::new();
    let mut answer = None;
    let mut expects = keys.user;
    for (index, message) in messages.iter().enumerate() {
        let number = index + 1;
        let of = |key: &str| message.get(key).and_then(Value::as_str);
        let who = of(keys.who).ok_or_else(|| format!("message {number} has no `{}`", keys.who))?;
        let text = of(keys.text).ok_or_else(|| format!("message {number} has no `{}`", keys.text))?;
        if who == keys.system && index == 0 {
            input.push_str(text);
            input.push('\n');
            continue;
        }
        if who != expects {
            return Err(format!(
                "message {number} is of `{who}`, after the one before it is `{expects}`'s turn"
            ));
        }
        if who == keys.assistant {
            answer = Some(text.to_owned());
            expects = keys.user;
        } else {
            if let Some(before) = answer.take() {
                input.push_str(&before);
                input.push('\n');
            }
            input.push_str(text);
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
    let texts: Option<Vec<&str>> =
        messages.iter().map(|message| message.get("content").and_then(Value::as_str)).collect();
    texts.map(|texts| texts.join("\n"))
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
