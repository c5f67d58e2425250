//! A row of `scenarios.jsonl` and its plan. Keys that are not known are passed over; a step that is none is
//! an error.

use serde::Deserialize;
use serde_json::{Map, Value};

/// A row; what the evaluation does not read is left out.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct Row {
    pub(super) id: String,
    pub(super) robot: String,
    pub(super) profile: String,
    #[serde(default)]
    pub(super) scene: Map<String, Value>,
    plan: Vec<Value>,
    pub(super) verdict: String,
    #[serde(default)]
    pub(super) class: Option<String>,
    #[serde(default)]
    error_step: Value,
    /// What the verdict rests on: `static`, or `geometry`.
    #[serde(default)]
    pub(super) needs: Option<String>,
}

/// A step of a plan with its place in it.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// Its number in the order of the plan, from 1: what comes first.
    pub(super) order: usize,
    /// Its path as a row writes it: `2.then.1`.
    pub(super) label: String,
    pub(super) step: Step,
}

/// A step of a plan.
#[derive(Clone, Debug)]
pub(super) enum Step {
    Do(Do),
    If { condition: Value, then: Vec<Node>, otherwise: Vec<Node> },
    Retry { times: Value, body: Vec<Node>, on_fail: Vec<Node> },
    While { condition: Value, max: Value, body: Vec<Node> },
    Monitor { condition: Value, reaction: String, body: Vec<Node> },
    Parallel { branches: Vec<Vec<Node>> },
}

/// One primitive with its arguments by position.
#[derive(Clone, Debug)]
pub(super) struct Do {
    pub(super) op: String,
    pub(super) args: Vec<Value>,
    /// The reference that it binds, without its `$`.
    pub(super) binds: Option<String>,
    /// Between what a person can choose.
    pub(super) answers: Vec<Value>,
}

impl Row {
    /// The plan, each step with its place.
    pub(super) fn plan(&self) -> Result<Vec<Node>, String> {
        Reader::default().block(&self.plan, "")
    }

    /// The step that the row calls wrong.
    pub(super) fn error_step(&self) -> Option<String> {
        match &self.error_step {
            Value::String(text) => Some(text.clone()),
            Value::Number(number) => Some(number.to_string()),
            _ => None,
        }
    }
}

#[derive(Default)]
struct Reader {
    seen: usize,
}

impl Reader {
    fn block(&mut self, steps: &[Value], prefix: &str) -> Result<Vec<Node>, String> {
        let numbered = steps.iter().enumerate();
        numbered.map(|(index, step)| self.step(step, format!("{prefix}{}", index + 1))).collect()
    }

    fn part(&mut self, step: &Map<String, Value>, label: &str, key: &str) -> Result<Vec<Node>, String> {
        match step.get(key) {
            None | Some(Value::Null) => Ok(Vec::new()),
            Some(Value::Array(steps)) => self.block(steps, &format!("{label}.{key}.")),
            Some(_) => Err(format!("step {label}: `{key}` is no list of steps")),
        }
    }

    fn step(&mut self, step: &Value, label: String) -> Result<Node, String> {
        let Some(keys) = step.as_object() else { return Err(format!("step {label} is no object")) };
        self.seen += 1;
        let order = self.seen;
        let value = |key: &str| keys.get(key).cloned().unwrap_or_default();
        let step = if keys.contains_key("op") {
            Step::Do(primitive(keys, &label)?)
        } else if keys.contains_key("if") {
            let then = self.part(keys, &label, "then")?;
            Step::If { condition: value("if"), then, otherwise: self.part(keys, &label, "else")? }
        } else if keys.contains_key("retry") {
            let body = self.part(keys, &label, "body")?;
            Step::Retry { times: value("retry"), body, on_fail: self.part(keys, &label, "on_fail")? }
        } else if keys.contains_key("while") {
            let body = self.part(keys, &label, "body")?;
            Step::While { condition: value("while"), max: value("max"), body }
        } else if keys.contains_key("monitor") {
            let reaction = value("on").as_str().unwrap_or("pause").to_owned();
            Step::Monitor { condition: value("monitor"), reaction, body: self.part(keys, &label, "body")? }
        } else if let Some(branches) = keys.get("parallel").and_then(Value::as_array) {
            let mut list = Vec::with_capacity(branches.len());
            for (index, branch) in branches.iter().enumerate() {
                // A branch of one step may stand without its list.
                let steps = branch.as_array().map_or(std::slice::from_ref(branch), Vec::as_slice);
                list.push(self.block(steps, &format!("{label}.parallel.{}.", index + 1))?);
            }
            Step::Parallel { branches: list }
        } else {
            return Err(format!("step {label} is neither a primitive nor a control step"));
        };
        Ok(Node { order, label, step })
    }
}

fn primitive(keys: &Map<String, Value>, label: &str) -> Result<Do, String> {
    let Some(op) = keys.get("op").and_then(Value::as_str) else {
        return Err(format!("step {label}: `op` is no name"));
    };
    let list = |key: &str| match keys.get(key) {
        None | Some(Value::Null) => Vec::new(),
        Some(Value::Array(items)) => items.clone(),
        Some(only) => vec![only.clone()],
    };
    let binds = keys.get("as").and_then(Value::as_str).map(|name| name.trim_start_matches('$').to_owned());
    Ok(Do { op: op.to_owned(), args: list("args"), binds, answers: list("answers") })
}
