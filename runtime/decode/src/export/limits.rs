//! What is known of the limits of servers: where a grammar exceeds one, the server refuses it, or is slow.

use serde_json::Value;

use super::offer::Offer;
use super::request::{Dialect, schema_of};

/// The most properties of all objects together that OpenAI takes.
const OPENAI_PROPERTIES: usize = 5_000;
/// How deep a schema may nest for OpenAI.
const OPENAI_LEVELS: usize = 10;
/// The most values of all enumerations together that OpenAI takes.
const OPENAI_VALUES: usize = 1_000;
/// The most repetitions of one thing that llama.cpp takes.
const LLAMA_REPETITIONS: u32 = 2_000;
/// A schema of this many bytes makes Ollama, which turns it into a grammar for each request, slow to answer.
const OLLAMA_BYTES: usize = 64 * 1024;

/// A limit that a grammar exceeds.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Warning {
    /// Whose limit it is; none where it is everyone's.
    pub server: Option<Dialect>,
    /// What is too much, and how much of it.
    pub text: String,
}

/// The limits that the grammars of an offer exceed.
#[must_use]
pub fn warnings(offer: &Offer) -> Vec<Warning> {
    let mut found = Vec::new();
    let mut warn = |server, text| found.push(Warning { server, text });
    if let Some(schema) = schema_of(offer) {
        let mut count = Count::default();
        count.value(&schema, 0);
        let openai = [
            ("properties", count.properties, OPENAI_PROPERTIES),
            ("levels", count.levels, OPENAI_LEVELS),
            ("values of enumerations", count.values, OPENAI_VALUES),
        ];
        for (what, actual, most) in openai {
            if actual > most {
                let text = format!("the JSON Schema has {actual} {what}; OpenAI takes {most}");
                warn(Some(Dialect::OpenAi), text);
            }
        }
        let bytes = schema.to_string().len();
        if bytes > OLLAMA_BYTES {
            let (kib, most) = (bytes / 1024, OLLAMA_BYTES / 1024);
            let text = format!("the JSON Schema has {kib} KiB; above {most} KiB Ollama is slow to begin");
            warn(Some(Dialect::Ollama), text);
        }
    }
    let grammar = super::grammar(offer);
    let most = grammar.rules.iter().map(|rule| repetitions(&rule.body)).max().unwrap_or(0);
    if most > LLAMA_REPETITIONS {
        let text = format!("the grammar repeats something {most} times; llama.cpp takes {LLAMA_REPETITIONS}");
        warn(Some(Dialect::LlamaCpp), text);
    }
    let names: usize = offer.lists.iter().map(Vec::len).sum();
    if offer.subset.syntax == motet_syntax::Syntax::Text && names > super::offer::MAX_EXCLUDED {
        warn(None, format!("there are {names} entities: a name that the policy gives may be one of theirs"));
    }
    found
}

#[derive(Default)]
struct Count {
    properties: usize,
    levels: usize,
    values: usize,
}

impl Count {
    fn value(&mut self, value: &Value, level: usize) {
        self.levels = self.levels.max(level);
        match value {
            Value::Object(keys) => {
                let own = usize::from(keys.get("type").is_some_and(|ty| ty == "object" || ty == "array"));
                self.properties +=
                    keys.get("properties").and_then(Value::as_object).map_or(0, serde_json::Map::len);
                self.values += keys.get("enum").and_then(Value::as_array).map_or(0, Vec::len);
                self.values += usize::from(keys.contains_key("const"));
                keys.values().for_each(|inner| self.value(inner, level + own));
            }
            Value::Array(items) => items.iter().for_each(|inner| self.value(inner, level)),
            Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {}
        }
    }
}

fn repetitions(expr: &super::Expr) -> u32 {
    use super::Expr;
    match expr {
        Expr::Literal(_) | Expr::Class(_) | Expr::Rule(_) => 0,
        Expr::Seq(parts) | Expr::Choice(parts) => parts.iter().map(repetitions).max().unwrap_or(0),
        Expr::Repeat(inner, _, greatest) => repetitions(inner).max(*greatest),
    }
}
