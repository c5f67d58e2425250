//! The schemas of terms and conditions, which derive no schema because a string means something else in each
//! place.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};

use super::term::{Args, Condition, Count, Duration, Form, Term};

impl JsonSchema for Term {
    fn schema_name() -> Cow<'static, str> {
        "Term".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A literal, a binding `\"$x\"`, or an object that says how the value is found.",
            "anyOf": [
                {"type": "string"},
                {"type": "number"},
                {"type": "boolean"},
                {"type": "array", "items": generator.subschema_for::<Term>()},
                generator.subschema_for::<Form>(),
            ],
        })
    }
}

impl JsonSchema for Args {
    fn schema_name() -> Cow<'static, str> {
        "Arguments".into()
    }
    fn inline_schema() -> bool {
        true
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({"type": "object", "additionalProperties": generator.subschema_for::<Term>()})
    }
}

impl JsonSchema for Condition {
    fn schema_name() -> Cow<'static, str> {
        "Condition".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A condition: an object, `true`, `false`, or a string in the text form.",
            "anyOf": [{"type": "string"}, {"type": "boolean"}, generator.subschema_for::<Form>()],
        })
    }
}

impl JsonSchema for Duration {
    fn schema_name() -> Cow<'static, str> {
        "Duration".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A duration: seconds, a string with a unit such as `\"200 ms\"`, or a binding.",
            "anyOf": [{"type": "number"}, {"type": "string"}, generator.subschema_for::<Form>()],
        })
    }
}

impl JsonSchema for Count {
    fn schema_name() -> Cow<'static, str> {
        "Count".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A whole number, or a binding.",
            "anyOf": [{"type": "integer"}, {"type": "string"}, generator.subschema_for::<Form>()],
        })
    }
}
