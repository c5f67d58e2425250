//! Shapes as a JSON Schema, in the subset that every server takes: objects with all keys required and no others, strings with
//! `const`, `enum` or an anchored pattern, `anyOf`, `$ref` alone in its object, arrays with bounds, numbers with bounds.

use serde_json::{Map, Value, json};

use super::shape::{Shape, Shapes};

/// The JSON Schema of shapes.
pub(super) fn schema(shapes: &Shapes) -> Value {
    let names: Vec<String> = unique(shapes.defs.iter().map(|(name, _)| name.as_str()));
    let Some(((_, root), defs)) = shapes.defs.split_last() else { return Value::Null };
    let Value::Object(mut schema) = of(root, &names) else { return Value::Null };
    let defs: Map<String, Value> =
        names.iter().zip(defs).map(|(name, (_, shape))| (name.clone(), of(shape, &names))).collect();
    schema.insert("$defs".to_owned(), Value::Object(defs));
    Value::Object(schema)
}

/// Names that can stand in a pointer, no two alike.
fn unique<'n>(names: impl Iterator<Item = &'n str>) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for name in names {
        let clean: String = name
            .chars()
            .map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' })
            .collect();
        let mut unique = clean.clone();
        let mut count = 1;
        while found.contains(&unique) {
            count += 1;
            unique = format!("{clean}_{count}");
        }
        found.push(unique);
    }
    found
}

fn of(shape: &Shape, names: &[String]) -> Value {
    match shape {
        Shape::Ref(def) => {
            json!({"$ref": format!("#/$defs/{}", names.get(*def).map_or("root", String::as_str))})
        }
        Shape::Object(keys) => {
            let required: Vec<&str> = keys.iter().map(|(key, _)| key.as_str()).collect();
            let properties: Map<String, Value> =
                keys.iter().map(|(key, shape)| (key.to_string(), of(shape, names))).collect();
            json!({
                "type": "object", "properties": properties, "required": required, "additionalProperties": false,
            })
        }
        Shape::Array(item, least, greatest) => {
            json!({"type": "array", "items": of(item, names), "minItems": least, "maxItems": greatest})
        }
        Shape::Choice(shapes) => {
            let shapes: Vec<Value> = shapes.iter().map(|shape| of(shape, names)).collect();
            json!({"anyOf": shapes})
        }
        Shape::Loose(loose, _) => of(loose, names),
        Shape::WordList(words) => match words.as_slice() {
            [only] => json!({"type": "string", "const": only}),
            words => json!({"type": "string", "enum": words}),
        },
        Shape::Name => json!({"type": "string", "pattern": "^[a-zA-Z_][a-zA-Z0-9_]*$"}),
        Shape::Binding => json!({"type": "string", "pattern": "^\\$[a-zA-Z_][a-zA-Z0-9_]*$"}),
        // Without a bound: one makes engines slow. The class is that of the subset, which needs no escape.
        Shape::Text => json!({"type": "string", "pattern": "^[ !#%-\\[\\]-~][ !#-\\[\\]-~]*$"}),
        Shape::Number(range) if range.decimals == 0 => {
            json!({"type": "integer", "minimum": range.least, "maximum": range.greatest})
        }
        Shape::Number(range) => {
            let number = |units: i64| crate::subset::Decimal { units, decimals: range.decimals }.value();
            json!({"type": "number", "minimum": bound(number(range.least)), "maximum": bound(number(range.greatest))})
        }
        Shape::Bool => json!({"type": "boolean"}),
        Shape::Version => json!({"type": "integer", "enum": [1]}),
        Shape::Null => json!({"type": "null"}),
    }
}

/// A whole bound without a decimal point, which some servers read as another type.
fn bound(value: f64) -> Value {
    if value.fract() == 0.0 { json!(value as i64) } else { json!(value) }
}
