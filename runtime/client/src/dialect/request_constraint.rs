//! Servers that constrain a model to a grammar: the fields of their requests that carry it.

use motet_decode::Grammar;
use motet_decode::export::{Format, Header, export, json_schema};
use serde_json::{Map, Value, json};

use super::Dialect;
use super::chat_body::{ChatBody, Delivery, Turn, TurnRole};

/// Part of a request that carries the grammar.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum GrammarCarrier {
    /// The field that every server of its kind takes, with a JSON Schema if the server knows it.
    #[default]
    Usual,
    /// Lark, where llguidance runs the grammars, and in the custom tools of OpenAI.
    Lark,
    /// A tool that the model has to call, with the policy as its input.
    Tool,
}

/// Messages of a request, beside its grammar.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Prompt<'p> {
    /// The name of the model.
    pub model: &'p str,
    pub system: &'p str,
    pub user: &'p str,
}

/// Name of the policy in requests that name the object or the tool.
const NAME: &str = "motet_policy";
/// Description of the tool whose input is a policy.
const DESCRIPTION: &str = "Takes the policy: the steps that do what is asked.";

/// The fields that hold a model to a grammar, to be merged into the body of a chat request. `None` if the
/// server does not take the grammar by this carrier: most take the text syntax by no JSON Schema, Lark needs
/// llguidance or a custom tool, and only Anthropic has strict tools.
#[must_use]
pub fn request_constraint(dialect: Dialect, carrier: GrammarCarrier, grammar: &Grammar) -> Option<Value> {
    match carrier {
        GrammarCarrier::Usual => match json_schema(grammar) {
            Some(schema) => Some(schema_constraint(dialect, NAME, &schema)),
            None => text_constraint(dialect, grammar),
        },
        GrammarCarrier::Lark => lark_constraint(dialect, grammar),
        GrammarCarrier::Tool => tool_constraint(dialect, &json_schema(grammar)?),
    }
}

/// Fields for a JSON Schema.
fn schema_constraint(dialect: Dialect, name: &str, schema: &Value) -> Value {
    let named = || json!({"type": "json_schema", "name": name, "strict": true, "schema": schema});
    match dialect {
        Dialect::Vllm => json!({"structured_outputs": {"json": schema, "disable_any_whitespace": true}}),
        Dialect::LlamaCpp | Dialect::Sglang | Dialect::OpenAi => {
            let schema = json!({"name": name, "strict": true, "schema": schema});
            json!({"response_format": {"type": "json_schema", "json_schema": schema}})
        }
        Dialect::Ollama => json!({"format": schema}),
        Dialect::OpenAiResponses => json!({"text": {"format": named()}}),
        Dialect::Anthropic => {
            let schema = narrowed(schema, ANTHROPIC_LEAVES_OUT);
            json!({"output_config": {"format": {"type": "json_schema", "schema": schema}}})
        }
        Dialect::Gemini => json!({"generationConfig": {
            "responseMimeType": "application/json",
            "responseJsonSchema": narrowed(schema, GEMINI_LEAVES_OUT),
        }}),
        Dialect::MistralRs => {
            let mut schema = schema.clone();
            if let Value::Object(keys) = &mut schema {
                // What the grammar leaves open, a weak model fills with blanks.
                keys.insert("x-guidance".to_owned(), json!({"whitespace_flexible": false}));
            }
            json!({"grammar": {"type": "json_schema", "value": schema}})
        }
    }
}

/// Fields for the text syntax.
fn text_constraint(dialect: Dialect, grammar: &Grammar) -> Option<Value> {
    let gbnf = || export(grammar, Format::Gbnf, Header::None);
    match dialect {
        Dialect::Vllm => Some(json!({"structured_outputs": {"grammar": gbnf()?}})),
        Dialect::LlamaCpp => Some(json!({"grammar": gbnf()?})),
        Dialect::Sglang => Some(json!({"ebnf": gbnf()?})),
        Dialect::OpenAiResponses | Dialect::MistralRs => lark_constraint(dialect, grammar),
        Dialect::OpenAi | Dialect::Ollama | Dialect::Anthropic | Dialect::Gemini => None,
    }
}

/// Fields for Lark. vLLM takes it with the backend `guidance`, SGLang with `llguidance`, llama.cpp if it was
/// built with that.
fn lark_constraint(dialect: Dialect, grammar: &Grammar) -> Option<Value> {
    let lark = |header| export(grammar, Format::Lark, header);
    match dialect {
        Dialect::Vllm => Some(json!({"structured_outputs": {"grammar": lark(Header::Llguidance)?}})),
        Dialect::LlamaCpp => Some(json!({"grammar": lark(Header::Llguidance)?})),
        Dialect::Sglang => Some(json!({"ebnf": lark(Header::Llguidance)?})),
        Dialect::MistralRs => Some(json!({"grammar": {"type": "lark", "value": lark(Header::Llguidance)?}})),
        Dialect::OpenAiResponses => Some(json!({
            "tools": [{
                "type": "custom",
                "name": NAME,
                "description": DESCRIPTION,
                "format": {"type": "grammar", "syntax": "lark", "definition": lark(Header::None)?},
            }],
            "tool_choice": {"type": "custom", "name": NAME},
            "parallel_tool_calls": false,
        })),
        Dialect::OpenAi | Dialect::Ollama | Dialect::Anthropic | Dialect::Gemini => None,
    }
}

/// Fields for a tool that the model has to call.
fn tool_constraint(dialect: Dialect, schema: &Value) -> Option<Value> {
    (dialect == Dialect::Anthropic).then(|| {
        let schema = narrowed(schema, ANTHROPIC_LEAVES_OUT);
        json!({
            "tools": [{"name": NAME, "description": DESCRIPTION, "strict": true, "input_schema": schema}],
            "tool_choice": {"type": "tool", "name": NAME, "disable_parallel_tool_use": true},
        })
    })
}

/// Keywords that Anthropic refuses. Of arrays it takes a least number of items of 0 or 1, which is all that
/// the schemas have.
const ANTHROPIC_LEAVES_OUT: &[&str] = &["minimum", "maximum", "maxItems", "minLength", "maxLength"];
/// Keywords that Gemini does not know. `const` becomes an `enum` of one value.
const GEMINI_LEAVES_OUT: &[&str] = &["pattern", "const"];

/// A schema without some keywords. The check decides what it no longer says.
fn narrowed(schema: &Value, leaves_out: &[&str]) -> Value {
    match schema {
        Value::Object(keys) => {
            let mut narrow = Map::new();
            for (key, value) in keys {
                match key.as_str() {
                    // Names of properties and definitions are no keywords.
                    "properties" | "$defs" => {
                        let named = value.as_object().into_iter().flatten();
                        let named = named.map(|(name, shape)| (name.clone(), narrowed(shape, leaves_out)));
                        narrow.insert(key.clone(), Value::Object(named.collect()));
                    }
                    "const" if leaves_out.contains(&"const") => {
                        narrow.insert("enum".to_owned(), json!([value]));
                    }
                    key if leaves_out.contains(&key) => {}
                    key => {
                        narrow.insert(key.to_owned(), narrowed(value, leaves_out));
                    }
                }
            }
            Value::Object(narrow)
        }
        Value::Array(items) => items.iter().map(|item| narrowed(item, leaves_out)).collect(),
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => schema.clone(),
    }
}

/// The whole body of a chat request; `None` as of [`request_constraint`].
///
/// ```
/// use motet_client::dialect::{Dialect, GrammarCarrier, Prompt, request_body};
/// use motet_decode::{Environment, Grammar, Subset};
///
/// let texts = Environment { robot: Some("hsr"), scene: Some("kitchen"), ..Environment::default() };
/// let grammar = Grammar::new(&texts.session()?.signatures(), Subset::default());
/// let prompt = Prompt { model: "m", system: "Write a policy.", user: "Bring me the red mug." };
/// let body = request_body(Dialect::Vllm, GrammarCarrier::Usual, &grammar, prompt).expect("a JSON Schema");
/// assert_eq!(body["structured_outputs"]["json"]["type"], "object");
/// # Ok::<(), motet_decode::EnvironmentError>(())
/// ```
#[must_use]
pub fn request_body(
    dialect: Dialect,
    carrier: GrammarCarrier,
    grammar: &Grammar,
    prompt: Prompt<'_>,
) -> Option<Value> {
    Some(body(dialect, prompt, request_constraint(dialect, carrier, grammar)?))
}

fn body(dialect: Dialect, prompt: Prompt<'_>, constraint: Value) -> Value {
    let turns = [
        Turn { role: TurnRole::System, text: prompt.system, images: &[] },
        Turn { role: TurnRole::User, text: prompt.user, images: &[] },
    ];
    let chat = ChatBody { dialect: Some(dialect), model: prompt.model, turns: &turns };
    let mut body = chat.write(Delivery::Whole);
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
    let prompt = Prompt {
        model,
        system: "Answer with one word and nothing else. Never write JSON.",
        user: "Write the word free.",
    };
    (body(dialect, prompt, schema_constraint(dialect, "probe", &schema)), json!({"probe": "held"}))
}
