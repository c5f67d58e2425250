//! Chat requests that constrain a model to a grammar: the fields of each dialect.

use serde_json::{Map, Value, json};

use super::lark::Header;
use super::{ebnf, gbnf, json_schema, lark};
use crate::Grammar;

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
    /// System message.
    pub system: &'p str,
    /// User message.
    pub user: &'p str,
}

/// The fields that hold a model to the grammar of an offer, to be merged into the body of a chat request.
/// None where a server cannot be held to the form: Ollama and OpenAI take a JSON Schema only, so not the
/// text form.
#[must_use]
pub fn request_constraint(dialect: Dialect, grammar: &Grammar) -> Option<Value> {
    let named = |schema: Value| json!({"type": "json_schema", "json_schema": {"name": "motet_policy", "strict": true, "schema": schema}});
    let gbnf = || gbnf::print(&ebnf(grammar));
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
/// None for servers that take neither.
#[must_use]
pub fn lark_constraint(dialect: Dialect, grammar: &Grammar) -> Option<Value> {
    let lark = || lark::print(&ebnf(grammar), Header::Llguidance);
    match dialect {
        Dialect::Vllm => Some(json!({"structured_outputs": {"grammar": lark()}})),
        Dialect::LlamaCpp => Some(json!({"grammar": lark()})),
        Dialect::Sglang => Some(json!({"ebnf": lark()})),
        Dialect::OpenAi | Dialect::Ollama => None,
    }
}

/// The whole body of a chat request.
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
