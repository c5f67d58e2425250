//! Dialects of model servers: the chat of a request, the fields that carry a grammar, the limits of servers,
//! and the places of an answer. Several dialects share a protocol.

mod chat_body;
mod limits;
mod request_constraint;
mod wire;

pub use chat_body::{ChatBody, Delivery, Turn, TurnImage, TurnRole};
pub use limits::{LimitWarning, warnings};
pub use request_constraint::{GrammarCarrier, Prompt, probe_body, request_body, request_constraint};
pub(crate) use wire::{Meaning, WireProtocol, kind, protocol};

/// A server's way of taking a chat and a grammar.
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
    /// The chat completions of OpenAI: `response_format`, strict. It takes a JSON Schema and nothing else.
    OpenAi,
    /// The Responses API of OpenAI: `text.format`, or a custom tool whose input a Lark grammar describes.
    OpenAiResponses,
    /// The Messages API of Anthropic: `output_config.format`, or a strict tool.
    Anthropic,
    /// The Gemini API: `generationConfig.responseJsonSchema`. It takes a JSON Schema and nothing else.
    Gemini,
    /// mistral.rs, through its chat completions: `grammar`.
    MistralRs,
}

/// Protocol of chats that a server speaks. Several dialects share one.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Protocol {
    /// Chat completions as of OpenAI.
    Chat,
    /// The native chat of Ollama.
    Ollama,
    /// The Responses API of OpenAI.
    Responses,
    /// The Messages API of Anthropic.
    Messages,
    /// `generateContent` of Gemini.
    Gemini,
}

impl Dialect {
    /// Protocol of the server's chats.
    #[must_use]
    pub const fn protocol(self) -> Protocol {
        match self {
            Self::Vllm | Self::LlamaCpp | Self::Sglang | Self::OpenAi | Self::MistralRs => Protocol::Chat,
            Self::Ollama => Protocol::Ollama,
            Self::OpenAiResponses => Protocol::Responses,
            Self::Anthropic => Protocol::Messages,
            Self::Gemini => Protocol::Gemini,
        }
    }
}
