//! Expressions over messages, in the Common Expression Language.

use crate::cdr::Message;
use cel::{Context, Program, Value};
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Expression over the fields of a message, `args` and `joints`.
pub(crate) struct Expression {
    text: String,
    program: Program,
}

/// Value of an expression.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Found {
    Truth(bool),
    Number(f64),
    Text(String),
}

impl Expression {
    /// Compiles an expression.
    ///
    /// # Errors
    ///
    /// Where it is wrong.
    pub(crate) fn compile(text: &str) -> Result<Self, String> {
        // The parser is generated, and panics at some texts.
        let compiled = catch_unwind(AssertUnwindSafe(|| Program::compile(text)));
        let program = match compiled {
            Ok(Ok(program)) => program,
            Ok(Err(error)) => return Err(format!("the expression `{text}`: {error}")),
            Err(_) => return Err(format!("the expression `{text}` cannot be read")),
        };
        Ok(Self { text: text.to_owned(), program })
    }

    /// Evaluates the expression. `message` gives its fields as variables; `args` are ids and texts of the
    /// arguments, and `joints` has positions by name.
    ///
    /// # Errors
    ///
    /// The variable that is unknown, or the types that do not fit.
    pub(crate) fn evaluate(
        &self,
        message: Option<&Message>,
        args: &[String],
        joints: &BTreeMap<String, f64>,
    ) -> Result<Found, String> {
        let wrong = |error: &dyn std::fmt::Display| format!("the expression `{}`: {error}", self.text);
        let mut context = Context::default();
        let fields: &[Message] = match message {
            Some(Message::Record(_, values)) => values,
            _ => &[],
        };
        if let Some(Message::Record(layout, _)) = message {
            for (field, value) in layout.iter().zip(fields) {
                context.add_variable(field.name.to_string(), value).map_err(|error| wrong(&error))?;
            }
        }
        context.add_variable("args", args).map_err(|error| wrong(&error))?;
        context.add_variable("joints", joints).map_err(|error| wrong(&error))?;
        let value = catch_unwind(AssertUnwindSafe(|| self.program.execute(&context)));
        match value {
            Ok(Ok(Value::Bool(truth))) => Ok(Found::Truth(truth)),
            #[allow(clippy::cast_precision_loss, reason = "counts are small")]
            Ok(Ok(Value::Int(number))) => Ok(Found::Number(number as f64)),
            #[allow(clippy::cast_precision_loss, reason = "counts are small")]
            Ok(Ok(Value::UInt(number))) => Ok(Found::Number(number as f64)),
            Ok(Ok(Value::Float(number))) => Ok(Found::Number(number)),
            Ok(Ok(Value::String(text))) => Ok(Found::Text(text.to_string())),
            Ok(Ok(_)) => Err(wrong(&"its value is no truth, number or text")),
            Ok(Err(error)) => Err(wrong(&error)),
            Err(_) => Err(wrong(&"it cannot be evaluated")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cdr::{decode, encode};
    use crate::layout::{Distribution, Layouts};
    use serde_json::json;

    fn of(text: &str, value: &serde_json::Value) -> Result<Found, String> {
        let layouts = Layouts::of(Distribution::Jazzy, None).unwrap();
        let bytes = encode(&layouts, "sensor_msgs/JointState", value).unwrap();
        let message = decode(&layouts, "sensor_msgs/JointState", &bytes).unwrap();
        let joints = BTreeMap::from([("hand".to_owned(), 0.25)]);
        Expression::compile(text)?.evaluate(Some(&message), &["mug_1".to_owned()], &joints)
    }

    #[test]
    fn fields_joints_and_arguments_are_variables() {
        let value = json!({"header": {"frame_id": "map"}, "name": ["a", "b"], "position": [1.5, 2.0]});
        assert_eq!(of("position[0] * 2.0", &value), Ok(Found::Number(3.0)));
        assert_eq!(of("joints['hand'] > 0.2 && header.frame_id == 'map'", &value), Ok(Found::Truth(true)));
        assert_eq!(of("args[0] == 'mug_1' || name.size() > 5", &value), Ok(Found::Truth(true)));
        assert!(of("velocity[0] > 1.0", &value).is_err());
        assert!(of("a b", &value).is_err());
        assert!(of("", &value).is_err());
        assert!(of("(((((", &value).is_err());
    }
}
