//! Answers in the shapes of OpenAI: chat completions, their events, and errors.

use motet::run::{run_id, unix_ns};
use motet_client::ClientSettings;
use motet_planner::model::{ModelError, TokenUsage};
use serde_json::{Value, json};

/// Reply to a client.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Reply {
    pub(super) said: ReplyContent,
    pub(super) usage: TokenUsage,
}

/// Content of a reply.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum ReplyContent {
    /// A policy that checks.
    Policy(String),
    /// A question or a refusal of the model, in words.
    Words(String),
}

/// Error for a client.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct ApiError {
    pub(super) kind: ErrorKind,
    pub(super) message: String,
    /// Code of the first finding.
    pub(super) code: Option<String>,
    /// Diagnostics of a policy that does not check.
    pub(super) findings: Vec<Value>,
}

/// Kind of an error.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum ErrorKind {
    BadRequest,
    Unauthorized,
    Forbidden,
    NotFound,
    NoModel,
    BadMethod,
    TooSlow,
    TooLarge,
    NoJson,
    /// The model wrote no policy that checks.
    NoPolicy,
    /// As many requests as may be are being worked on.
    TooMany,
    /// The model server refuses, or its answer is no reply.
    Upstream,
    UpstreamBusy,
    UpstreamTooSlow,
    /// The endpoint is ending.
    Ending,
}

impl ErrorKind {
    /// Status code, and name in the answer.
    pub(super) const fn status(self) -> (u16, &'static str) {
        match self {
            Self::BadRequest => (400, "invalid_request_error"),
            Self::Unauthorized => (401, "authentication_error"),
            Self::Forbidden => (403, "permission_error"),
            Self::NotFound | Self::NoModel => (404, "not_found_error"),
            Self::BadMethod => (405, "invalid_request_error"),
            Self::TooSlow => (408, "timeout_error"),
            Self::TooLarge => (413, "invalid_request_error"),
            Self::NoJson => (415, "invalid_request_error"),
            Self::NoPolicy => (422, "invalid_policy_error"),
            Self::TooMany => (429, "rate_limit_error"),
            Self::Upstream => (502, "upstream_error"),
            Self::UpstreamBusy => (503, "upstream_error"),
            Self::UpstreamTooSlow => (504, "upstream_error"),
            Self::Ending => (503, "server_error"),
        }
    }
}

impl ApiError {
    pub(super) fn new(kind: ErrorKind, message: impl Into<String>) -> Self {
        let code = (kind == ErrorKind::NoModel).then(|| "model_not_found".to_owned());
        Self { kind, message: message.into(), code, findings: Vec::new() }
    }

    /// Error of the model server.
    pub(super) fn of_model(error: &ModelError, settings: &ClientSettings) -> Self {
        let kind = match error {
            ModelError::Busy { .. } => ErrorKind::UpstreamBusy,
            ModelError::TimedOut { .. } => ErrorKind::UpstreamTooSlow,
            ModelError::Cancelled => ErrorKind::Ending,
            ModelError::Declined { .. } | ModelError::TooInvolved { .. } => ErrorKind::NoPolicy,
            ModelError::Unreachable { .. }
            | ModelError::Refused { .. }
            | ModelError::TooLong { .. }
            | ModelError::CutOff { .. }
            | ModelError::Malformed { .. } => ErrorKind::Upstream,
        };
        Self::new(kind, format!("{} at {}: {error}", settings.model, settings.address))
    }

    pub(super) fn json(&self) -> Value {
        let (_, name) = self.kind.status();
        let mut error = json!({"message": self.message, "type": name, "param": null, "code": self.code});
        if let (Value::Object(error), false) = (&mut error, self.findings.is_empty()) {
            error.insert("findings".to_owned(), self.findings.clone().into());
        }
        json!({"error": error})
    }
}

/// Head of an answer: the id, the time and the model.
#[derive(Clone, Debug)]
pub(super) struct Head {
    id: String,
    created: u64,
    model: String,
}

impl Head {
    pub(super) fn new(model: &str) -> Self {
        let created = unix_ns() / 1_000_000_000;
        Self { id: format!("chatcmpl-{}", run_id()), created, model: model.to_owned() }
    }

    fn object(&self, kind: &str, choices: Value) -> Value {
        let (id, created, model) = (&self.id, self.created, &self.model);
        json!({"id": id, "object": kind, "created": created, "model": model, "choices": choices})
    }

    /// A whole answer.
    pub(super) fn completion(&self, reply: &Reply) -> Value {
        let message = match &reply.said {
            ReplyContent::Policy(policy) => json!({"role": "assistant", "content": policy, "refusal": null}),
            ReplyContent::Words(words) => json!({"role": "assistant", "content": null, "refusal": words}),
        };
        let choice = json!({"index": 0, "message": message, "logprobs": null, "finish_reason": "stop"});
        let mut all = self.object("chat.completion", json!([choice]));
        if let Value::Object(all) = &mut all {
            all.insert("usage".to_owned(), usage(reply.usage));
        }
        all
    }

    /// First event, before anything is known.
    pub(super) fn first(&self) -> Value {
        self.chunk(&json!({"role": "assistant", "content": ""}), None)
    }

    /// Events of a reply, without the first one.
    pub(super) fn chunks(&self, reply: &Reply) -> [Value; 2] {
        let delta = match &reply.said {
            ReplyContent::Policy(policy) => json!({"content": policy}),
            ReplyContent::Words(words) => json!({"refusal": words}),
        };
        [self.chunk(&delta, None), self.chunk(&json!({}), Some("stop"))]
    }

    /// Event that counts the tokens.
    pub(super) fn counted(&self, reply: &Reply) -> Value {
        let mut all = self.object("chat.completion.chunk", json!([]));
        if let Value::Object(all) = &mut all {
            all.insert("usage".to_owned(), usage(reply.usage));
        }
        all
    }

    fn chunk(&self, delta: &Value, finish: Option<&str>) -> Value {
        let choice = json!({"index": 0, "delta": delta, "logprobs": null, "finish_reason": finish});
        self.object("chat.completion.chunk", json!([choice]))
    }
}

/// Tokens of all rounds together; `null` if the model server does not count them.
fn usage(usage: TokenUsage) -> Value {
    let (Some(input), Some(output)) = (usage.input, usage.output) else { return Value::Null };
    json!({"prompt_tokens": input, "completion_tokens": output, "total_tokens": input.saturating_add(output)})
}

/// List of the only model.
pub(super) fn models(model: &str) -> Value {
    json!({"object": "list", "data": [self::model(model)]})
}

/// The only model.
pub(super) fn model(model: &str) -> Value {
    json!({"id": model, "object": "model", "created": 0, "owned_by": "motet"})
}
