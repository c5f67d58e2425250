//! Answers of the tools: values as JSON with everything escaped that steers a terminal, bounded in size, and
//! refusals with a reason.

use std::fmt::Display;

use motet_project::ProjectError;
use motet_syntax::render::{self, escaped};
use rmcp::model::{CallToolResult, ContentBlock, ResourceContents};
use serde_json::{Map, Value, json};

use crate::error::CliError;

/// The most bytes of an answer without its picture.
const MAX_ANSWER_BYTES: usize = 256 * 1024;

/// Reason for which a call is not carried out, with advice where some is known.
#[derive(Debug)]
pub(crate) struct Refusal {
    problem: String,
    help: Option<String>,
    /// Further members of the answer, such as diagnostics.
    more: Vec<(String, Value)>,
}

impl Refusal {
    /// Refusal for a reason, which is one clause.
    pub(crate) fn new(problem: impl Into<String>) -> Self {
        Self { problem: problem.into(), help: None, more: Vec::new() }
    }

    /// The same with advice.
    pub(crate) fn with_help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }

    /// The same with the members of an object.
    pub(crate) fn with(mut self, more: Value) -> Self {
        if let Value::Object(more) = more {
            self.more.extend(more);
        }
        self
    }

    /// Refusal of a name, with the names that are known.
    pub(crate) fn unknown(what: &str, name: &str, help: impl Into<String>) -> Self {
        Self::new(format!("there is no {what} `{}`", crate::output::escape(name))).with_help(help)
    }

    /// Answer of a tool.
    pub(crate) fn into_result(self) -> CallToolResult {
        let mut all = Map::new();
        all.insert("error".to_owned(), self.problem.into());
        if let Some(help) = self.help {
            all.insert("help".to_owned(), help.into());
        }
        all.extend(self.more);
        CallToolResult::structured_error(bounded(shown(Value::Object(all))))
    }

    /// Reason in one line.
    pub(crate) fn problem(&self) -> String {
        crate::output::escape(&self.problem)
    }
}

impl From<CliError> for Refusal {
    fn from(error: CliError) -> Self {
        Self { help: error.help().map(ToOwned::to_owned), ..Self::new(error.to_string()) }
    }
}

impl From<ProjectError> for Refusal {
    fn from(error: ProjectError) -> Self {
        let refusal = Self { help: error.help().map(ToOwned::to_owned), ..Self::new(error.to_string()) };
        match &error {
            ProjectError::Invalid { diagnostics, sources, .. } => {
                refusal.with(json!({"says": render::llm(diagnostics, sources)}))
            }
            _ => refusal,
        }
    }
}

impl From<motet::Error> for Refusal {
    fn from(error: motet::Error) -> Self {
        match error {
            motet::Error::Project(error) => error.into(),
            error => Self::new(error.to_string()),
        }
    }
}

/// Answer of a tool, with a picture where there is one.
#[derive(Debug)]
pub(crate) struct ToolAnswer {
    value: Value,
    /// Drawing in SVG.
    picture: Option<String>,
}

impl From<Value> for ToolAnswer {
    fn from(value: Value) -> Self {
        Self { value, picture: None }
    }
}

impl ToolAnswer {
    /// The same with a drawing in SVG.
    pub(crate) fn with_picture(self, picture: String) -> Self {
        Self { picture: Some(picture), ..self }
    }

    /// The same with a remark, if it is about a state that a run changes at the moment.
    pub(crate) fn with_remark(mut self, remark: Option<String>) -> Self {
        if let (Value::Object(value), Some(remark)) = (&mut self.value, remark) {
            value.insert("remark".to_owned(), remark.into());
        }
        self
    }

    /// Answer of a tool.
    pub(crate) fn into_result(self) -> CallToolResult {
        let mut result = CallToolResult::structured(bounded(shown(self.value)));
        let picture = self.picture.filter(|picture| picture.len() <= MAX_ANSWER_BYTES);
        result.content.extend(picture.map(|picture| {
            let drawing = ResourceContents::text(picture, "motet://picture/feasible.svg");
            ContentBlock::resource(drawing.with_mime_type("image/svg+xml"))
        }));
        result
    }
}

/// Value in which no text steers a terminal or turns the direction of a text.
pub(crate) fn shown(value: Value) -> Value {
    match value {
        Value::String(text) => Value::String(escaped(&text)),
        Value::Array(items) => items.into_iter().map(shown).collect(),
        Value::Object(members) => {
            Value::Object(members.into_iter().map(|(name, value)| (escaped(&name), shown(value))).collect())
        }
        Value::Null | Value::Bool(_) | Value::Number(_) => value,
    }
}

fn bounded(value: Value) -> Value {
    let size = value.to_string().len();
    if size <= MAX_ANSWER_BYTES {
        return value;
    }
    json!({
        "error": format!("the answer has {size} bytes, more than {MAX_ANSWER_BYTES}"),
        "help": "ask for less at a time, or send a shorter policy",
    })
}

/// The first `most` of some texts, and a line that counts the others.
pub(crate) fn first<T: Display>(texts: &[T], most: usize) -> Vec<String> {
    let mut shown: Vec<String> = texts.iter().take(most).map(ToString::to_string).collect();
    if let Some(left) = texts.len().checked_sub(most).filter(|left| *left > 0) {
        shown.push(format!("and {left} more"));
    }
    shown
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::{MAX_ANSWER_BYTES, Refusal, ToolAnswer};

    #[test]
    fn answer_escapes_what_steers_a_terminal() {
        let value = json!({"says": "a\u{1b}[2J", "of": ["b\u{202e}c", 1, null], "text": "d\n\te"});
        let result = ToolAnswer::from(value).into_result();
        let expected = json!({"says": r"a\u{1b}[2J", "of": [r"b\u{202e}c", 1, null], "text": "d\n\te"});
        assert_eq!(result.structured_content, Some(expected));
    }

    #[test]
    fn answer_is_bounded() {
        let value = json!({"says": "x".repeat(MAX_ANSWER_BYTES)});
        let result = ToolAnswer::from(value).into_result();
        assert!(result.structured_content.unwrap()["error"].as_str().unwrap().contains("bytes"));
    }

    #[test]
    fn refusal_is_an_error_with_help() {
        let result = Refusal::unknown("robot", "r\u{7}2d2", "known: `hsr`").into_result();
        assert_eq!(result.is_error, Some(true));
        let expected = json!({"error": r"there is no robot `r\u{7}2d2`", "help": "known: `hsr`"});
        assert_eq!(result.structured_content, Some(expected));
    }
}
