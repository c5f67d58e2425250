//! JSON as people lay it out: indented by two, with what is short on one line.

use serde_json::Value;

/// Values that end before this column stay on their line.
const WIDTH: usize = 100;

/// A value and a line break. Keys keep their order.
pub(super) fn pretty(value: &Value) -> String {
    let mut text = String::new();
    broken(&mut text, value, 0, 0);
    text.push('\n');
    text
}

/// A value on one line, without a line break.
pub(super) fn one_line(value: &Value) -> String {
    let mut text = String::new();
    flat(&mut text, value, usize::MAX);
    text
}

/// Appends a value; `used` columns of the line are taken, and `after` are needed behind it. The outermost is
/// always broken.
fn fitting(text: &mut String, value: &Value, indent: usize, used: usize, after: usize) {
    let before = text.len();
    let room = WIDTH.saturating_sub(used + after);
    if !flat(text, value, before + 4 * room)
        || text.get(before..).is_some_and(|line| line.chars().count() > room)
    {
        text.truncate(before);
        broken(text, value, indent, after);
    }
}

/// Appends a value on one line; `false`, and a useless text, where it is longer than `limit` bytes of text.
fn flat(text: &mut String, value: &Value, limit: usize) -> bool {
    match value {
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {
            text.push_str(&value.to_string())
        }
        Value::Array(members) => {
            text.push('[');
            for (index, member) in members.iter().enumerate() {
                text.push_str(if index > 0 { ", " } else { "" });
                if !flat(text, member, limit) {
                    return false;
                }
            }
            text.push(']');
        }
        Value::Object(members) => {
            text.push('{');
            for (index, (key, member)) in members.iter().enumerate() {
                text.push_str(if index > 0 { ", " } else { "" });
                push_key(text, key);
                if !flat(text, member, limit) {
                    return false;
                }
            }
            text.push('}');
        }
    }
    text.len() <= limit
}

/// Appends a container with a member a line; a scalar, or an empty container, as it is.
fn broken(text: &mut String, value: &Value, indent: usize, after: usize) {
    let inner = indent + 2;
    match value {
        Value::Array(members) if !members.is_empty() => {
            text.push('[');
            for (index, member) in members.iter().enumerate() {
                new_line(text, index > 0, inner);
                let is_last = index + 1 == members.len();
                fitting(text, member, inner, inner, usize::from(!is_last));
            }
            text.push('\n');
            spaces(text, indent);
            text.push(']');
        }
        Value::Object(members) if !members.is_empty() => {
            text.push('{');
            for (index, (key, member)) in members.iter().enumerate() {
                new_line(text, index > 0, inner);
                push_key(text, key);
                let is_last = index + 1 == members.len();
                fitting(text, member, inner, inner + key.chars().count() + 4, usize::from(!is_last));
            }
            text.push('\n');
            spaces(text, indent);
            text.push('}');
        }
        Value::Array(_)
        | Value::Object(_)
        | Value::Null
        | Value::Bool(_)
        | Value::Number(_)
        | Value::String(_) => {
            let limit = text.len() + after;
            flat(text, value, limit);
        }
    }
}

fn push_key(text: &mut String, key: &str) {
    text.push_str(&Value::from(key).to_string());
    text.push_str(": ");
}

fn new_line(text: &mut String, has_comma: bool, indent: usize) {
    text.push_str(if has_comma { ",\n" } else { "\n" });
    spaces(text, indent);
}

fn spaces(text: &mut String, count: usize) {
    for _ in 0..count {
        text.push(' ');
    }
}
