//! Known limits of servers, and the excess of a grammar over them.

use motet_decode::Grammar;
use motet_decode::export::{EbnfExpr, ebnf, json_schema};
use serde_json::Value;

use super::Dialect;

/// The most properties of all objects together that OpenAI takes.
const OPENAI_PROPERTIES: usize = 5_000;
/// Nesting depth of a schema that OpenAI accepts.
const OPENAI_LEVELS: usize = 10;
/// The most values of all enumerations together that OpenAI takes.
const OPENAI_VALUES: usize = 1_000;
/// The most unions of all objects together that Anthropic takes.
const ANTHROPIC_UNIONS: usize = 16;
/// The most repetitions of one thing that llama.cpp takes.
const LLAMA_REPETITIONS: u32 = 2_000;
/// A schema of this many bytes makes Ollama, which turns it into a grammar for each request, slow to answer.
const OLLAMA_BYTES: usize = 64 * 1024;

/// A limit that a grammar exceeds.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct LimitWarning {
    /// Server with the limit; `None` for a limit of all servers.
    pub server: Option<Dialect>,
    /// Description of the excess, with its amount.
    pub text: String,
}

/// The limits of servers that a grammar exceeds: the server refuses it, or becomes slow.
#[must_use]
pub fn warnings(grammar: &Grammar) -> Vec<LimitWarning> {
    let mut found = Vec::new();
    let mut warn = |server, text| found.push(LimitWarning { server, text });
    if let Some(schema) = json_schema(grammar) {
        let mut count = Count::default();
        count.value(&schema, 0);
        let openai = [
            ("properties", count.properties, OPENAI_PROPERTIES),
            ("levels", count.levels, OPENAI_LEVELS),
            ("values of enumerations", count.values, OPENAI_VALUES),
        ];
        for (what, actual, most) in openai.into_iter().filter(|(_, actual, most)| actual > most) {
            let text = || format!("the JSON Schema has {actual} {what}; OpenAI takes {most}");
            warn(Some(Dialect::OpenAi), text());
            warn(Some(Dialect::OpenAiResponses), text());
        }
        if count.unions > ANTHROPIC_UNIONS {
            let (actual, most) = (count.unions, ANTHROPIC_UNIONS);
            let text = format!("the JSON Schema has {actual} unions; Anthropic takes {most}");
            warn(Some(Dialect::Anthropic), text);
        }
        let bytes = schema.to_string().len();
        if bytes > OLLAMA_BYTES {
            let (kib, most) = (bytes / 1024, OLLAMA_BYTES / 1024);
            let text = format!("the JSON Schema has {kib} KiB; above {most} KiB Ollama is slow to begin");
            warn(Some(Dialect::Ollama), text);
        }
    }
    let most = ebnf(grammar).rules.iter().map(|rule| repetitions(&rule.body)).max().unwrap_or(0);
    if most > LLAMA_REPETITIONS {
        let text = format!("the grammar repeats something {most} times; llama.cpp takes {LLAMA_REPETITIONS}");
        warn(Some(Dialect::LlamaCpp), text);
    }
    if let Some(names) = grammar.unexcluded_entities() {
        warn(None, format!("there are {names} entities: a name that the policy gives may be one of theirs"));
    }
    found
}

#[derive(Default)]
struct Count {
    properties: usize,
    levels: usize,
    values: usize,
    unions: usize,
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
                self.unions += usize::from(keys.contains_key("anyOf"));
                keys.values().for_each(|inner| self.value(inner, level + own));
            }
            Value::Array(items) => items.iter().for_each(|inner| self.value(inner, level)),
            Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {}
        }
    }
}

fn repetitions(expr: &EbnfExpr) -> u32 {
    match expr {
        EbnfExpr::Literal(_) | EbnfExpr::Class(_) | EbnfExpr::Rule(_) => 0,
        EbnfExpr::Seq(parts) | EbnfExpr::Choice(parts) => parts.iter().map(repetitions).max().unwrap_or(0),
        EbnfExpr::Repeat(inner, _, greatest) => repetitions(inner).max(*greatest),
    }
}
