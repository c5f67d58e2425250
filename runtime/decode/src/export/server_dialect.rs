//! Servers that constrain a model to a grammar: the fields of their chat requests, and their known limits.

use serde_json::{Map, Value, json};

use super::notation::{self, Header};
use super::{EbnfExpr, ebnf, json_schema};
use crate::Grammar;
use crate::grammar::MAX_EXCLUDED;

/// A server's way of taking a grammar.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Dialect {
    /// vLLM 0.12 and later: `structured_outputs`.
    Vllm,
    /// The server of llama.cpp: `response_format`, or `grammar`.
    LlamaCpp,
    /// Ollama: `format`, at `/api/chat`. It takes a JSON Schema and nothing else.
    Ollama,
    /// SGLang: `response_format`, or `ebnf`.
    Sglang,
    /// OpenAI: `response_format`, strict. It takes a JSON Schema and nothing else.
    OpenAi,
}

/// Messages of a request, beside its grammar.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Prompt<'p> {
    /// The name of the model.
    pub model: &'p str,
    pub system: &'p str,
    pub user: &'p str,
}

/// The fields that hold a model to a grammar, to be merged into the body of a chat request; `None` for a
/// server that cannot: Ollama and OpenAI take a JSON Schema only, so not the text syntax.
#[must_use]
pub fn request_constraint(dialect: Dialect, grammar: &Grammar) -> Option<Value> {
    let named = |schema: Value| {
        let schema = json!({"name": "motet_policy", "strict": true, "schema": schema});
        json!({"type": "json_schema", "json_schema": schema})
    };
    let gbnf = || notation::gbnf(&ebnf(grammar));
    Some(match (dialect, json_schema(grammar)) {
        (Dialect::Vllm, Some(schema)) => {
            json!({"structured_outputs": {"json": schema, "disable_any_whitespace": true}})
        }
        (Dialect::Vllm, None) => {
            json!({"structured_outputs": {"grammar": gbnf()}})
        }
        (Dialect::LlamaCpp | Dialect::Sglang | Dialect::OpenAi, Some(schema)) => {
            json!({"response_format": named(schema)})
        }
        (Dialect::LlamaCpp, None) => json!({"grammar": gbnf()}),
        (Dialect::Sglang, None) => json!({"ebnf": gbnf()}),
        (Dialect::Ollama, Some(schema)) => json!({"format": schema, "stream": false}),
        (Dialect::OpenAi | Dialect::Ollama, None) => return None,
    })
}

/// The same in Lark, which llguidance takes, in the field where a server takes GBNF: of vLLM with the
/// backend `guidance`, of SGLang with `llguidance`, and of a server of llama.cpp that was built with it.
/// `None` for servers that take neither.
#[must_use]
pub fn lark_constraint(dialect: Dialect, grammar: &Grammar) -> Option<Value> {
    let lark = || notation::lark(&ebnf(grammar), Header::Llguidance);
    match dialect {
        Dialect::Vllm => Some(json!({"structured_outputs": {"grammar": lark()}})),
        Dialect::LlamaCpp => Some(json!({"grammar": lark()})),
        Dialect::Sglang => Some(json!({"ebnf": lark()})),
        Dialect::OpenAi | Dialect::Ollama => None,
    }
}

/// The whole body of a chat request; `None` as of [`request_constraint`].
///
/// ```
/// use motet_decode::export::{Dialect, Prompt, request_body};
/// use motet_decode::{Environment, Grammar, Subset};
///
/// let texts = Environment { robot: Some("hsr"), scene: Some("kitchen"), ..Environment::default() };
/// let grammar = Grammar::new(&texts.session()?.signatures(), Subset::default());
/// let prompt = Prompt { model: "m", system: "Write a policy.", user: "Bring me the red mug." };
/// let body = request_body(Dialect::Vllm, &grammar, prompt).expect("vLLM takes a JSON Schema");
/// assert_eq!(body["structured_outputs"]["json"]["type"], "object");
/// # Ok::<(), motet_decode::EnvironmentError>(())
/// ```
#[must_use]
pub fn request_body(dialect: Dialect, grammar: &Grammar, prompt: Prompt<'_>) -> Option<Value> {
    Some(body(prompt, request_constraint(dialect, grammar)?))
}

fn body(prompt: Prompt<'_>, constraint: Value) -> Value {
    let mut body = Map::new();
    body.insert("model".to_owned(), prompt.model.into());
    let messages =
        json!([{"role": "system", "content": prompt.system}, {"role": "user", "content": prompt.user}]);
    body.insert("messages".to_owned(), messages);
    if let Value::Object(fields) = constraint {
        body.extend(fields);
    }
    Value::Object(body)
}

/// The body of a request that asks for a plain word under a grammar that allows only one JSON object, which
/// has no place for it. An answer that is that object shows that the server holds the model to grammars;
/// any other, that it does not. The answer that the grammar demands comes with the body.
#[must_use]
pub fn probe_body(dialect: Dialect, model: &str) -> (Value, Value) {
    let schema = json!({
        "type": "object",
        "properties": {"probe": {"type": "string", "const": "held"}},
        "required": ["probe"],
        "additionalProperties": false,
    });
    let constraint = match dialect {
        Dialect::Vllm => json!({"structured_outputs": {"json": schema}}),
        Dialect::LlamaCpp | Dialect::Sglang | Dialect::OpenAi => json!({"response_format":
            {"type": "json_schema", "json_schema": {"name": "probe", "strict": true, "schema": schema}}}),
        Dialect::Ollama => json!({"format": schema, "stream": false}),
    };
    let prompt = Prompt {
        model,
        system: "Answer with one word and nothing else. Never write JSON.",
        user: "Write the word free.",
    };
    (body(prompt, constraint), json!({"probe": "held"}))
}

/// The most properties of all objects together that OpenAI takes.
const OPENAI_PROPERTIES: usize = 5_000;
/// Nesting depth of a schema that OpenAI accepts.
const OPENAI_LEVELS: usize = 10;
/// The most values of all enumerations together that OpenAI takes.
const OPENAI_VALUES: usize = 1_000;
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
    let most = ebnf(grammar).rules.iter().map(|rule| repetitions(&rule.body)).max().unwrap_or(0);
    if most > LLAMA_REPETITIONS {
        let text = format!("the grammar repeats something {most} times; llama.cpp takes {LLAMA_REPETITIONS}");
        warn(Some(Dialect::LlamaCpp), text);
    }
    let names = grammar.signatures.entities.len();
    if grammar.subset.syntax == motet_syntax::Syntax::Text && names > MAX_EXCLUDED {
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

fn repetitions(expr: &EbnfExpr) -> u32 {
    match expr {
        EbnfExpr::Literal(_) | EbnfExpr::Class(_) | EbnfExpr::Rule(_) => 0,
        EbnfExpr::Seq(parts) | EbnfExpr::Choice(parts) => parts.iter().map(repetitions).max().unwrap_or(0),
        EbnfExpr::Repeat(inner, _, greatest) => repetitions(inner).max(*greatest),
    }
}
