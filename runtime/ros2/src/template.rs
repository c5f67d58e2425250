//! Messages with values of a command in them.

use motet_graph::Value as Argument;
use serde_json::{Value, json};

/// Fills in a message. A text that is `{name}` as a whole becomes the value that `named` finds, with its
/// type; within a longer text it becomes words.
///
/// # Errors
///
/// The name that nobody knows.
pub(crate) fn fill(message: &Value, named: &dyn Fn(&str) -> Result<Value, String>) -> Result<Value, String> {
    match message {
        Value::String(text) => fill_text(text, named),
        Value::Array(values) => values.iter().map(|value| fill(value, named)).collect(),
        Value::Object(fields) => {
            fields.iter().map(|(name, value)| Ok((name.clone(), fill(value, named)?))).collect()
        }
        other => Ok(other.clone()),
    }
}

fn fill_text(text: &str, named: &dyn Fn(&str) -> Result<Value, String>) -> Result<Value, String> {
    let (mut filled, mut rest) = (String::new(), text);
    while let Some((before, after)) = rest.split_once('{') {
        let Some((name, behind)) = after.split_once('}') else { break };
        let value = named(name.trim())?;
        if before.is_empty() && behind.is_empty() && filled.is_empty() {
            return Ok(value);
        }
        filled.push_str(before);
        match value {
            Value::String(words) => filled.push_str(&words),
            other => filled.push_str(&other.to_string()),
        }
        rest = behind;
    }
    filled.push_str(rest);
    Ok(Value::String(filled))
}

/// Value of an argument in a message: an entity is its id, a pose a `geometry_msgs/Pose`.
#[must_use]
pub(crate) fn of_argument(value: &Argument) -> Value {
    match value {
        Argument::Bool(value) => json!(value),
        Argument::Int(value) => json!(value),
        Argument::Number(value) => json!(value),
        Argument::Text(text) | Argument::Entity(text) | Argument::Case(text) => json!(text.as_str()),
        Argument::Pose(pose) => of_pose(pose.xyz, pose.quaternion),
        Argument::List(values) => values.iter().map(of_argument).collect(),
    }
}

/// `geometry_msgs/Pose` of a position and a quaternion x, y, z, w.
#[must_use]
pub(crate) fn of_pose([x, y, z]: [f64; 3], [qx, qy, qz, qw]: [f64; 4]) -> Value {
    json!({"position": {"x": x, "y": y, "z": z}, "orientation": {"x": qx, "y": qy, "z": qz, "w": qw}})
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_keep_their_types() {
        let named = |name: &str| match name {
            "text" => Ok(json!("hello")),
            "width" => Ok(json!(0.05)),
            other => Err(format!("no `{other}`")),
        };
        let message =
            json!({"data": "{text}", "list": [{"position": "{width}"}], "said": "I say {text} {width}!"});
        let expected = json!({"data": "hello", "list": [{"position": 0.05}], "said": "I say hello 0.05!"});
        assert_eq!(fill(&message, &named), Ok(expected));
        assert_eq!(fill(&json!("{nobody}"), &named), Err("no `nobody`".to_owned()));
        assert_eq!(fill(&json!("open {"), &named), Ok(json!("open {")));
    }
}
