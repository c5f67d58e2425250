//! Bodies of chat requests, in the protocol of a server. Grammars are added by `request_constraint`.

use serde_json::{Map, Value, json};

use super::{Dialect, Protocol};

/// Author of a message.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum TurnRole {
    /// Instructions to the model.
    System,
    /// The person, or the program that asks.
    User,
    /// Model that replies.
    Assistant,
}

/// A message of a chat.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Turn<'t> {
    pub role: TurnRole,
    pub text: &'t str,
    /// Images shown with the text.
    pub images: &'t [TurnImage<'t>],
}

/// An image of a message.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct TurnImage<'t> {
    /// Its type, such as `image/png`.
    pub media_type: &'t str,
    /// Its bytes in base64.
    pub base64: &'t str,
}

impl TurnImage<'_> {
    fn data_url(&self) -> String {
        format!("data:{};base64,{}", self.media_type, self.base64)
    }
}

/// Delivery of a reply.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Delivery {
    /// All at once.
    Whole,
    /// Piece by piece.
    Streamed,
}

/// A chat for a server.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ChatBody<'t> {
    /// Dialect of the server; without one, it speaks the protocol of OpenAI and may know nothing else.
    pub dialect: Option<Dialect>,
    /// Name of the model.
    pub model: &'t str,
    pub turns: &'t [Turn<'t>],
}

/// Largest number of tokens of a reply of Anthropic, which every request has to name. The smallest models
/// that write policies take it.
const MAX_TOKENS: u32 = 8_192;
/// Text of a message without one, where a server refuses an empty text.
const EMPTY: &str = "(empty)";

impl ChatBody<'_> {
    /// Writes the body, without a grammar.
    #[must_use]
    pub fn write(&self, delivery: Delivery) -> Map<String, Value> {
        let protocol = self.dialect.map_or(Protocol::Chat, Dialect::protocol);
        let body = match protocol {
            Protocol::Chat => json!({"model": self.model, "messages": self.all(chat_turn)}),
            Protocol::Ollama => json!({"model": self.model, "messages": self.all(ollama_turn)}),
            Protocol::Responses => json!({
                "model": self.model,
                "instructions": self.instructions(),
                "input": self.said(responses_turn),
                "store": false,
            }),
            Protocol::Messages => json!({
                "model": self.model,
                "max_tokens": MAX_TOKENS,
                "system": self.instructions(),
                "messages": self.said(messages_turn),
            }),
            Protocol::Gemini => json!({
                "systemInstruction": {"parts": [{"text": self.instructions()}]},
                "contents": self.said(gemini_turn),
            }),
        };
        let Value::Object(mut body) = body else { return Map::new() };
        // A chat without instructions has no empty ones, which servers refuse.
        if self.instructions().is_empty() {
            ["instructions", "system", "systemInstruction"].iter().for_each(|key| drop(body.remove(*key)));
        }
        let streams = match (protocol, delivery) {
            // The address says it.
            (Protocol::Gemini, _) => None,
            // It streams unless it is told not to.
            (Protocol::Ollama, Delivery::Whole) => Some(false),
            (_, Delivery::Whole) => None,
            (_, Delivery::Streamed) => Some(true),
        };
        body.extend(streams.map(|streams| ("stream".to_owned(), streams.into())));
        if self.dialect.is_some() && protocol == Protocol::Chat && delivery == Delivery::Streamed {
            body.insert("stream_options".to_owned(), json!({"include_usage": true}));
        }
        body
    }

    /// Messages of the system, joined.
    fn instructions(&self) -> String {
        let texts = self.turns.iter().filter(|turn| turn.role == TurnRole::System).map(|turn| turn.text);
        texts.collect::<Vec<_>>().join("\n\n")
    }

    fn all(&self, write: fn(&Turn<'_>) -> Value) -> Vec<Value> {
        self.turns.iter().map(write).collect()
    }

    /// All messages but those of the system.
    fn said(&self, write: fn(&Turn<'_>) -> Value) -> Vec<Value> {
        self.turns.iter().filter(|turn| turn.role != TurnRole::System).map(write).collect()
    }
}

const fn role(turn: &Turn<'_>) -> &'static str {
    match turn.role {
        TurnRole::System => "system",
        TurnRole::User => "user",
        TurnRole::Assistant => "assistant",
    }
}

fn chat_turn(turn: &Turn<'_>) -> Value {
    if turn.images.is_empty() {
        return json!({"role": role(turn), "content": turn.text});
    }
    let images = turn.images.iter();
    let images = images.map(|image| json!({"type": "image_url", "image_url": {"url": image.data_url()}}));
    json!({"role": role(turn), "content": parts(json!({"type": "text", "text": turn.text}), images)})
}

fn ollama_turn(turn: &Turn<'_>) -> Value {
    if turn.images.is_empty() {
        return json!({"role": role(turn), "content": turn.text});
    }
    let images: Vec<&str> = turn.images.iter().map(|image| image.base64).collect();
    json!({"role": role(turn), "content": turn.text, "images": images})
}

fn responses_turn(turn: &Turn<'_>) -> Value {
    let kind = if turn.role == TurnRole::Assistant { "output_text" } else { "input_text" };
    let images = turn.images.iter();
    let images = images.map(|image| json!({"type": "input_image", "image_url": image.data_url()}));
    json!({"role": role(turn), "content": parts(json!({"type": kind, "text": turn.text}), images)})
}

fn messages_turn(turn: &Turn<'_>) -> Value {
    let images = turn.images.iter().map(|image| {
        let source = json!({"type": "base64", "media_type": image.media_type, "data": image.base64});
        json!({"type": "image", "source": source})
    });
    json!({"role": role(turn), "content": parts(json!({"type": "text", "text": text(turn)}), images)})
}

fn gemini_turn(turn: &Turn<'_>) -> Value {
    let role = if turn.role == TurnRole::Assistant { "model" } else { "user" };
    let images = turn.images.iter();
    let images =
        images.map(|image| json!({"inlineData": {"mimeType": image.media_type, "data": image.base64}}));
    json!({"role": role, "parts": parts(json!({"text": text(turn)}), images)})
}

fn text<'t>(turn: &Turn<'t>) -> &'t str {
    if turn.text.trim().is_empty() { EMPTY } else { turn.text }
}

fn parts(text: Value, images: impl Iterator<Item = Value>) -> Vec<Value> {
    std::iter::once(text).chain(images).collect()
}
