//! Messages with values of a command in them.

use motet_graph::Value as Argument;
use motet_syntax::unit::Unit;
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

/// Name of a value in a message: `object`, `object.pose`, `at in base_link`, `by in deg`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct ValueName<'a> {
    /// Argument, or `goal`.
    pub(crate) name: &'a str,
    pub(crate) field: Option<&'a str>,
    /// Frame of a pose, or unit of a number.
    pub(crate) within: Option<&'a str>,
}

impl<'a> ValueName<'a> {
    /// Parts of the text between braces.
    #[must_use]
    pub(crate) fn of(text: &'a str) -> Self {
        let (name, within) =
            text.split_once(" in ").map_or((text, None), |(name, rest)| (name, Some(rest.trim())));
        let (name, field) = name.split_once('.').map_or((name, None), |(name, field)| (name, Some(field)));
        Self { name: name.trim(), field: field.map(str::trim), within }
    }
}

/// Names between braces in a message, in order.
pub(crate) fn names(message: &Value) -> Vec<String> {
    let found = std::cell::RefCell::new(Vec::new());
    let note = |name: &str| {
        found.borrow_mut().push(name.to_owned());
        Ok(Value::Null)
    };
    // Nothing is refused.
    let _ = fill(message, &note);
    found.into_inner()
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

/// A number in SI units as one of a unit: `0.5` rad in `deg`.
///
/// # Errors
///
/// The unit that the language does not have.
pub(crate) fn in_unit(value: f64, unit: &str) -> Result<Value, String> {
    let unit = Unit::parse(unit).ok_or_else(|| format!("there is no unit `{unit}`"))?;
    Ok(json!(unit.from_si(value)))
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

    #[test]
    fn numbers_come_in_the_units_of_the_language() {
        assert_eq!(in_unit(0.05, "mm"), Ok(json!(50.0)));
        assert_eq!(in_unit(std::f64::consts::PI, "deg"), Ok(json!(180.0)));
        assert_eq!(in_unit(0.3, "%"), Ok(json!(30.0)));
        assert_eq!(in_unit(0.05, "inch"), Err("there is no unit `inch`".to_owned()));
    }
}
