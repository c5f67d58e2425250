//! Protocols of chats as data: the address of requests, the header of the key, and the places in an answer
//! that hold its text, its end and its tokens. `reply_reader` reads answers by it.

use motet_planner::model::Finish;
use serde_json::Value;

use super::{Dialect, Protocol};

/// Requests and answers of a [`Protocol`] on the wire.
#[derive(Debug)]
pub(crate) struct WireProtocol {
    /// Path of requests, behind the address of a server.
    pub(crate) path: &'static str,
    /// Name of the header with the key, and what stands before the key.
    pub(crate) key_header: (&'static str, &'static str),
    /// Headers of every request.
    pub(crate) headers: &'static [(&'static str, &'static str)],
    /// Places of text.
    pub(crate) texts: &'static [JsonPlace],
    /// Places of the words with which a model declines.
    pub(crate) refusals: &'static [JsonPlace],
    /// Endings, of which the first that fits counts.
    pub(crate) endings: &'static [Ending],
    /// Places of messages of errors.
    pub(crate) errors: &'static [JsonPlace],
    /// Places of the numbers of tokens of the chat and of the reply.
    pub(crate) tokens: (&'static [&'static str], &'static [&'static str]),
    /// Types of events behind which none follows.
    pub(crate) last: &'static [&'static str],
}

/// Place in the JSON of an answer or an event.
#[derive(Clone, Copy, Debug)]
pub(crate) struct JsonPlace {
    /// Type of the events that have it; empty for all.
    event: &'static str,
    /// Path as of RFC 6901, in which `*` is every item of a list.
    path: &'static str,
}

/// Ending of a reply.
#[derive(Debug)]
pub(crate) struct Ending {
    path: &'static str,
    /// Word at the path; `*` for any.
    word: &'static str,
    pub(crate) means: Meaning,
}

/// Meaning of an ending.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Meaning {
    /// The reply is whole or has reached its limit.
    Ended(Finish),
    /// The model or a filter of the server declined to answer.
    Declined,
    /// The reply is no use.
    Broken,
}

const fn place(path: &'static str) -> JsonPlace {
    JsonPlace { event: "", path }
}

const fn of(event: &'static str, path: &'static str) -> JsonPlace {
    JsonPlace { event, path }
}

const fn ends(path: &'static str, word: &'static str, means: Meaning) -> Ending {
    Ending { path, word, means }
}

const STOP: Meaning = Meaning::Ended(Finish::Stop);
const LENGTH: Meaning = Meaning::Ended(Finish::Length);

/// Chat completions and the chat of Ollama. Servers of one are asked in the other, so answers of both are
/// read.
static CHAT: WireProtocol = WireProtocol {
    path: "/v1/chat/completions",
    key_header: ("authorization", "Bearer "),
    headers: &[],
    texts: &[
        place("/choices/0/delta/content"),
        place("/choices/0/message/content"),
        place("/message/content"),
    ],
    refusals: &[place("/choices/0/delta/refusal"), place("/choices/0/message/refusal")],
    endings: &[
        ends("/choices/0/finish_reason", "length", LENGTH),
        ends("/choices/0/finish_reason", "content_filter", Meaning::Declined),
        ends("/choices/0/finish_reason", "*", STOP),
        ends("/done_reason", "length", LENGTH),
        ends("/done_reason", "*", STOP),
        ends("/done", "true", STOP),
        // A server that does not stream may leave the reason out.
        ends("/choices/0/message/role", "*", STOP),
        ends("/choices/0/message/content", "*", STOP),
    ],
    errors: &[place("/error/message"), place("/error")],
    tokens: (&["/usage/prompt_tokens", "/prompt_eval_count"], &["/usage/completion_tokens", "/eval_count"]),
    last: &[],
};

static OLLAMA: WireProtocol = WireProtocol { path: "/api/chat", ..CHAT };

static RESPONSES: WireProtocol = WireProtocol {
    path: "/v1/responses",
    texts: &[
        of("response.output_text.delta", "/delta"),
        of("response.custom_tool_call_input.delta", "/delta"),
        place("/output/*/content/*/text"),
        place("/output/*/input"),
    ],
    refusals: &[of("response.refusal.delta", "/delta"), place("/output/*/content/*/refusal")],
    endings: &[
        ends("/response/incomplete_details/reason", "max_output_tokens", LENGTH),
        ends("/response/incomplete_details/reason", "*", Meaning::Declined),
        ends("/incomplete_details/reason", "max_output_tokens", LENGTH),
        ends("/incomplete_details/reason", "*", Meaning::Declined),
        ends("/response/status", "completed", STOP),
        ends("/status", "completed", STOP),
    ],
    errors: &[
        place("/response/error/message"),
        place("/error/message"),
        place("/error"),
        of("error", "/message"),
    ],
    tokens: (
        &["/response/usage/input_tokens", "/usage/input_tokens"],
        &["/response/usage/output_tokens", "/usage/output_tokens"],
    ),
    last: &["response.completed", "response.incomplete", "response.failed"],
    ..CHAT
};

static MESSAGES: WireProtocol = WireProtocol {
    path: "/v1/messages",
    key_header: ("x-api-key", ""),
    headers: &[("anthropic-version", "2023-06-01")],
    texts: &[
        of("content_block_delta", "/delta/text"),
        of("content_block_delta", "/delta/partial_json"),
        of("message", "/content/*/text"),
        of("message", "/content/*/input"),
    ],
    refusals: &[],
    endings: &[
        ends("/delta/stop_reason", "max_tokens", LENGTH),
        ends("/delta/stop_reason", "model_context_window_exceeded", LENGTH),
        ends("/delta/stop_reason", "refusal", Meaning::Declined),
        ends("/delta/stop_reason", "*", STOP),
        ends("/stop_reason", "max_tokens", LENGTH),
        ends("/stop_reason", "model_context_window_exceeded", LENGTH),
        ends("/stop_reason", "refusal", Meaning::Declined),
        ends("/stop_reason", "*", STOP),
    ],
    tokens: (&["/message/usage/input_tokens", "/usage/input_tokens"], &["/usage/output_tokens"]),
    last: &["message_stop"],
    ..CHAT
};

static GEMINI: WireProtocol = WireProtocol {
    path: "/v1beta/models",
    key_header: ("x-goog-api-key", ""),
    texts: &[place("/candidates/0/content/parts/*/text")],
    refusals: &[],
    endings: &[
        ends("/candidates/0/finishReason", "STOP", STOP),
        ends("/candidates/0/finishReason", "MAX_TOKENS", LENGTH),
        ends("/candidates/0/finishReason", "MALFORMED_FUNCTION_CALL", Meaning::Broken),
        ends("/candidates/0/finishReason", "OTHER", Meaning::Broken),
        ends("/candidates/0/finishReason", "*", Meaning::Declined),
        ends("/promptFeedback/blockReason", "*", Meaning::Declined),
    ],
    tokens: (&["/usageMetadata/promptTokenCount"], &["/usageMetadata/candidatesTokenCount"]),
    last: &[],
    ..CHAT
};

/// Wire protocol of a dialect; chat completions without one.
pub(crate) fn protocol(dialect: Option<Dialect>) -> &'static WireProtocol {
    match dialect.map_or(Protocol::Chat, Dialect::protocol) {
        Protocol::Chat => &CHAT,
        Protocol::Ollama => &OLLAMA,
        Protocol::Responses => &RESPONSES,
        Protocol::Messages => &MESSAGES,
        Protocol::Gemini => &GEMINI,
    }
}

impl JsonPlace {
    /// Text at the place: strings as they are, objects as JSON. Thoughts are none.
    pub(crate) fn texts(self, answer: &Value) -> impl Iterator<Item = String> + '_ {
        let is_meant = self.event.is_empty() || kind(answer) == self.event;
        let found = if is_meant { at(answer, self.path) } else { Vec::new() };
        found.into_iter().filter_map(|value| match value {
            Value::String(text) => Some(text.clone()),
            Value::Object(_) => Some(value.to_string()),
            Value::Null | Value::Bool(_) | Value::Number(_) | Value::Array(_) => None,
        })
    }
}

impl Ending {
    /// The word of the ending, if the answer has it.
    pub(crate) fn word(&self, answer: &Value) -> Option<String> {
        let word = match answer.pointer(self.path)? {
            Value::Null => return None,
            Value::String(word) => word.clone(),
            other => other.to_string(),
        };
        (self.word == "*" || self.word == word).then_some(word)
    }
}

/// Type of an event or an answer; empty if it has none.
pub(crate) fn kind(answer: &Value) -> &str {
    answer.get("type").and_then(Value::as_str).unwrap_or_default()
}

/// Values at a path.
fn at<'v>(answer: &'v Value, path: &str) -> Vec<&'v Value> {
    path.split('/').skip(1).fold(vec![answer], |found, segment| {
        let next = found.into_iter().flat_map(|value| match (segment, value) {
            ("*", Value::Array(items)) => items.iter().filter(|item| !is_thought(item)).collect(),
            (index, Value::Array(items)) => {
                index.parse::<usize>().ok().and_then(|index| items.get(index)).into_iter().collect()
            }
            (key, value) => value.get(key).into_iter().collect::<Vec<_>>(),
        });
        next.collect()
    })
}

/// True for a part of an answer that holds thoughts of the model.
fn is_thought(part: &Value) -> bool {
    part.get("thought").and_then(Value::as_bool) == Some(true)
        || matches!(kind(part), "thinking" | "redacted_thinking" | "reasoning" | "reasoning_text")
}
