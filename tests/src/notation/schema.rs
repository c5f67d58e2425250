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

/// A random string of an anchored pattern of classes, groups of alternatives, each perhaps repeated with `*`,
/// and escaped characters.
fn pattern(pattern: &str, random: &mut SplitMix64) -> String {
    let inner = pattern.strip_prefix('^').and_then(|rest| rest.strip_suffix('$'));
    assert!(inner.is_some(), "not anchored: {pattern}");
    let mut out = String::new();
    one_of(inner.unwrap_or(""), random, &mut out);
    out
}

/// The length of the first item of a pattern: a class, a group, an escape or a character.
fn item(pattern: &str) -> usize {
    let (mut depth, mut in_class, mut is_escaped) = (0, false, false);
    for (at, letter) in pattern.char_indices() {
        match letter {
            _ if is_escaped => is_escaped = false,
            '\\' => {
                is_escaped = true;
                continue;
            }
            ']' if in_class => in_class = false,
            _ if in_class => {}
            '[' => in_class = true,
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        if depth == 0 && !in_class {
            return at + letter.len_utf8();
        }
    }
    pattern.len()
}

/// A string of one of several alternatives.
fn one_of(pattern: &str, random: &mut SplitMix64, out: &mut String) {
    let (mut ways, mut begin, mut at) = (Vec::new(), 0, 0);
    let part = |from: usize, to: usize| pattern.get(from..to).unwrap_or_default();
    while at < pattern.len() {
        let rest = part(at, pattern.len());
        if rest.starts_with('|') {
            ways.push(part(begin, at));
            begin = at + 1;
        }
        at += item(rest);
    }
    ways.push(part(begin, pattern.len()));
    let mut rest = ways.get(random.random_range(0..ways.len())).copied().unwrap_or_default();
    while !rest.is_empty() {
        let (first, behind) = rest.split_at_checked(item(rest)).unwrap_or((rest, ""));
        let times = if behind.starts_with('*') { random.random_range(0..12) } else { 1 };
        rest = behind.strip_prefix('*').unwrap_or(behind);
        for _ in 0..times {
            match (first.strip_prefix('('), first.strip_prefix('[')) {
                (Some(group), _) => one_of(group.strip_suffix(')').unwrap_or(group), random, out),
                (_, Some(class)) => one_in(class, random, out),
                _ => out.push_str(first.trim_start_matches('\\')),
            }
        }
    }
}

/// A character of a class, behind its bracket.
fn one_in(class: &str, random: &mut SplitMix64, out: &mut String) {
    let (mut letters, mut ranges) = (class.chars().peekable(), Vec::new());
    while let Some(letter) = letters.next().filter(|letter| *letter != ']') {
        let from = if letter == '\\' { letters.next().unwrap_or('\\') } else { letter };
        let mut to = from;
        if letters.next_if_eq(&'-').is_some() {
            let end = letters.next().unwrap_or(from);
            to = if end == '\\' { letters.next().unwrap_or('\\') } else { end };
        }
        ranges.push((from, to));
    }
    if let Some((from, to)) = ranges.get(random.random_range(0..ranges.len())) {
        let width = (u32::from(*to) - u32::from(*from) + 1) as usize;
        let step = u32::try_from(random.random_range(0..width)).unwrap_or(0);
        out.extend(char::from_u32(u32::from(*from) + step));
    }
}
