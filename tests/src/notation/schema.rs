//! Random values of a JSON Schema: the part of JSON Schema that is exported.

use rand::RngExt as _;
use rand_xoshiro::SplitMix64;
use serde_json::Value;

/// A random value of a schema with definitions, as compact JSON; above the budget arrays are as short as can
/// be and of several alternatives the first is taken, which is never one with steps within. Panics at what is
/// not exported.
#[must_use]
pub fn derive(schema: &Value, budget: usize, random: &mut SplitMix64) -> String {
    let mut out = String::new();
    Deriver { root: schema, budget }.value(schema, random, &mut out);
    out
}

struct Deriver<'s> {
    root: &'s Value,
    budget: usize,
}

impl Deriver<'_> {
    #[expect(clippy::panic, reason = "a test whose schema cannot be read cannot go on")]
    fn value(&self, schema: &Value, random: &mut SplitMix64, out: &mut String) {
        let keys = schema.as_object().map_or(0, serde_json::Map::len);
        let is_short = out.len() < self.budget;
        if let Some(pointer) = schema["$ref"].as_str() {
            assert_eq!(keys, 1, "a reference has siblings: {schema}");
            let Some(target) = self.root.pointer(pointer.trim_start_matches('#')) else {
                panic!("nothing is at {pointer}")
            };
            return self.value(target, random, out);
        }
        if let Some(alternatives) = schema["anyOf"].as_array() {
            assert_eq!(keys, 1, "alternatives have siblings: {schema}");
            let chosen = if is_short { random.random_range(0..alternatives.len()) } else { 0 };
            return self.value(alternatives.get(chosen).unwrap_or(&Value::Null), random, out);
        }
        match schema["type"].as_str() {
            Some("object") => self.object(schema, random, out),
            Some("array") => {
                let [least, greatest] =
                    ["minItems", "maxItems"].map(|key| schema[key].as_u64().unwrap_or(0) as usize);
                let more = if is_short { random.random_range(0..(greatest - least).min(5) + 1) } else { 0 };
                out.push('[');
                for index in 0..least + more {
                    out.push_str(if index > 0 { "," } else { "" });
                    self.value(&schema["items"], random, out);
                }
                out.push(']');
            }
            Some("string") => self.string(schema, random, out),
            Some("integer") => match schema["enum"].as_array() {
                Some(values) => values.iter().take(1).for_each(|value| out.push_str(&value.to_string())),
                None => {
                    let [least, greatest] =
                        ["minimum", "maximum"].map(|key| schema[key].as_i64().unwrap_or(0));
                    let width = usize::try_from(greatest - least + 1).unwrap_or(1);
                    out.push_str(&(least + random.random_range(0..width) as i64).to_string());
                }
            },
            Some("number") => {
                let [least, greatest] = ["minimum", "maximum"].map(|key| schema[key].as_f64().unwrap_or(0.0));
                let part = random.random_range(0..1_000_001) as f64 / 1e6;
                let value = (least + (greatest - least) * part).clamp(least, greatest);
                out.push_str(&serde_json::to_string(&value).unwrap_or_default());
            }
            Some("boolean") => out.push_str(if random.random_range(0..2) == 0 { "true" } else { "false" }),
            Some("null") => out.push_str("null"),
            _ => panic!("no type: {schema}"),
        }
    }

    #[expect(clippy::panic, reason = "a test whose schema cannot be read cannot go on")]
    fn object(&self, schema: &Value, random: &mut SplitMix64, out: &mut String) {
        let Some(properties) = schema["properties"].as_object() else { panic!("no properties: {schema}") };
        let required: Vec<&str> =
            schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
        assert_eq!(
            required,
            properties.keys().map(String::as_str).collect::<Vec<_>>(),
            "not all are required"
        );
        assert_eq!(schema["additionalProperties"], Value::Bool(false));
        out.push('{');
        for (index, (key, value)) in properties.iter().enumerate() {
            out.push_str(if index > 0 { "," } else { "" });
            out.push_str(&Value::from(key.as_str()).to_string());
            out.push(':');
            self.value(value, random, out);
        }
        out.push('}');
    }

    fn string(&self, schema: &Value, random: &mut SplitMix64, out: &mut String) {
        if schema["const"].is_string() {
            out.push_str(&schema["const"].to_string());
        } else if let Some(values) = schema["enum"].as_array() {
            let chosen = values.get(random.random_range(0..values.len()));
            out.push_str(&chosen.unwrap_or(&Value::Null).to_string());
        } else {
            out.push_str(&Value::from(pattern(schema["pattern"].as_str().unwrap_or(""), random)).to_string());
        }
    }
}

/// A random string of an anchored pattern of classes, each perhaps repeated with `*`, and escaped characters.
fn pattern(pattern: &str, random: &mut SplitMix64) -> String {
    let inner = pattern.strip_prefix('^').and_then(|rest| rest.strip_suffix('$'));
    assert!(inner.is_some(), "not anchored: {pattern}");
    let mut letters = inner.unwrap_or("").chars().peekable();
    let mut out = String::new();
    while let Some(letter) = letters.next() {
        let mut ranges: Vec<(char, char)> = Vec::new();
        match letter {
            '\\' => ranges.extend(letters.next().map(|letter| (letter, letter))),
            '[' => {
                while let Some(letter) = letters.next().filter(|letter| *letter != ']') {
                    let from = if letter == '\\' { letters.next().unwrap_or('\\') } else { letter };
                    let mut to = from;
                    if letters.next_if_eq(&'-').is_some() {
                        let end = letters.next().unwrap_or(from);
                        to = if end == '\\' { letters.next().unwrap_or('\\') } else { end };
                    }
                    ranges.push((from, to));
                }
            }
            other => ranges.push((other, other)),
        }
        let times = if letters.next_if_eq(&'*').is_some() { random.random_range(0..12) } else { 1 };
        for _ in 0..times {
            if let Some((from, to)) = ranges.get(random.random_range(0..ranges.len())) {
                let width = (u32::from(*to) - u32::from(*from) + 1) as usize;
                out.extend(char::from_u32(
                    u32::from(*from) + u32::try_from(random.random_range(0..width)).unwrap_or(0),
                ));
            }
        }
    }
    out
}
