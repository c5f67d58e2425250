//! A request of a client: the messages, and what of them is the request for a policy.

use std::sync::Arc;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use motet_client::EncodedImage;
use motet_planner::model::{Message, Role};
use motet_runtime::{CameraImage, Time};
use serde::Deserialize;
use serde_json::Value;

use super::answer::{ApiError, ErrorKind};
use crate::output::escape;

/// Request for a policy.
#[derive(Debug)]
pub(super) struct ChatRequest {
    /// Text of the last message, which is the user's.
    pub(super) text: String,
    /// Pictures that the message shows.
    pub(super) images: Vec<Arc<CameraImage>>,
    /// Messages before it.
    pub(super) earlier: Vec<Message>,
    pub(super) delivery: Delivery,
}

/// Delivery of the reply.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Delivery {
    /// One JSON object.
    Whole,
    /// Pieces as server-sent events.
    Events,
    /// The same, with an event that counts the tokens.
    EventsWithUsage,
}

/// Body of a request. Other fields steer the writing of a model, which this endpoint does itself.
#[derive(Deserialize)]
struct Body {
    model: Option<String>,
    messages: Vec<BodyMessage>,
    #[serde(default)]
    stream: Option<bool>,
    #[serde(default)]
    stream_options: Option<StreamOptions>,
    #[serde(default)]
    n: Option<u64>,
    #[serde(default)]
    tools: Option<Vec<Value>>,
}

#[derive(Deserialize)]
struct StreamOptions {
    #[serde(default)]
    include_usage: Option<bool>,
}

#[derive(Deserialize)]
struct BodyMessage {
    role: String,
    #[serde(default)]
    content: Option<Content>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Content {
    Text(String),
    Parts(Vec<Part>),
}

#[derive(Deserialize)]
#[serde(tag = "type", rename_all = "snake_case")]
enum Part {
    Text { text: String },
    ImageUrl { image_url: ImageUrl },
}

#[derive(Deserialize)]
struct ImageUrl {
    url: String,
}

/// Largest number of messages.
const MAX_MESSAGES: usize = 1_000;

fn wrong(why: impl Into<String>) -> ApiError {
    ApiError::new(ErrorKind::BadRequest, why)
}

impl ChatRequest {
    /// Reads a body.
    pub(super) fn read(bytes: &[u8], model: &str) -> Result<Self, ApiError> {
        let body: Body = serde_json::from_slice(bytes)
            .map_err(|error| wrong(format!("the body is no chat request: {error}")))?;
        if let Some(asked) = body.model.as_deref().filter(|asked| *asked != model) {
            let why = format!("the model `{}` does not exist, only `{model}`", escape(asked));
            return Err(ApiError::new(ErrorKind::NoModel, why));
        }
        if body.n.is_some_and(|n| n != 1) {
            return Err(wrong("`n` is 1: there is one policy for a request"));
        }
        if body.tools.is_some_and(|tools| !tools.is_empty()) {
            return Err(wrong("there are no `tools`: the reply is a policy"));
        }
        if body.messages.len() > MAX_MESSAGES {
            return Err(wrong(format!("there are more than {MAX_MESSAGES} messages")));
        }
        let mut messages = Vec::new();
        for (index, message) in body.messages.into_iter().enumerate() {
            messages.push(read_message(index, message)?);
        }
        let last = messages.pop().filter(|last| last.role == Role::User && !last.text.trim().is_empty());
        let Some(Message { text, images, .. }) = last else {
            return Err(wrong("the last of the `messages` is the user's, with the request as its text"));
        };
        let delivery = match (body.stream, body.stream_options) {
            (Some(true), Some(StreamOptions { include_usage: Some(true) })) => Delivery::EventsWithUsage,
            (Some(true), _) => Delivery::Events,
            (_, _) => Delivery::Whole,
        };
        Ok(Self { text, images, earlier: messages, delivery })
    }
}

fn read_message(index: usize, message: BodyMessage) -> Result<Message, ApiError> {
    let role = match message.role.as_str() {
        "system" | "developer" => Role::System,
        "user" => Role::User,
        "assistant" => Role::Assistant,
        other => {
            let why = format!("messages[{index}] has the role `{}`, which is not understood", escape(other));
            return Err(wrong(why));
        }
    };
    let (mut texts, mut images) = (Vec::new(), Vec::new());
    match message.content {
        None => {}
        Some(Content::Text(text)) => texts.push(text),
        Some(Content::Parts(parts)) => {
            for part in parts {
                match part {
                    Part::Text { text } => texts.push(text),
                    Part::ImageUrl { image_url } => images.push(Arc::new(image(index, &image_url.url)?)),
                }
            }
        }
    }
    Ok(Message { images, ..Message::new(role, texts.join("\n")) })
}

/// Image of a data URL. Other addresses are not fetched.
fn image(index: usize, url: &str) -> Result<CameraImage, ApiError> {
    let bad = |why: String| wrong(format!("the image of messages[{index}] cannot be used: {why}"));
    let data = url.strip_prefix("data:").and_then(|rest| rest.split_once(";base64,"));
    let (media_type, data) = data
        .ok_or_else(|| bad("its address is no data URL in base64, and others are not fetched".to_owned()))?;
    let bytes = STANDARD.decode(data.trim()).map_err(|error| bad(error.to_string()))?;
    EncodedImage::new(&bytes).map_err(|error| bad(error.to_string()))?;
    Ok(CameraImage { camera: "client".into(), media_type: media_type.into(), bytes, at: Time::ZERO })
}

#[cfg(test)]
mod tests {
    use super::{ChatRequest, Delivery};

    /// The text, the number of earlier messages and of images, and the delivery; or the message of the error.
    fn read(body: &str) -> Result<(String, usize, usize, Delivery), String> {
        let read = ChatRequest::read(body.as_bytes(), "m").map_err(|error| error.message)?;
        Ok((read.text, read.earlier.len(), read.images.len(), read.delivery))
    }

    #[test]
    fn chat_request_reads_messages_and_refuses_what_it_cannot_serve() {
        let of = |text: &str, earlier, images, delivery| Ok((text.to_owned(), earlier, images, delivery));
        assert_eq!(
            read(r#"{"model": "m", "messages": [{"role": "user", "content": "go"}], "temperature": 0}"#),
            of("go", 0, 0, Delivery::Whole)
        );
        let parts = r#"{"messages": [{"role": "developer", "content": "be brief"}, {"role": "assistant"},
            {"role": "user", "content": [{"type": "text", "text": "go"}, {"type": "image_url",
            "image_url": {"url": "data:image/png;base64,iVBORwECAw=="}}]}], "stream": true,
            "stream_options": {"include_usage": true}}"#;
        assert_eq!(read(parts), of("go", 2, 1, Delivery::EventsWithUsage));
        for (body, words) in [
            ("", "no chat request"),
            ("[]", "no chat request"),
            (r#"{"messages": []}"#, "the last of the `messages`"),
            (r#"{"messages": [{"role": "user", "content": " "}]}"#, "the last of the `messages`"),
            (r#"{"messages": [{"role": "assistant", "content": "a"}]}"#, "the last of the `messages`"),
            (r#"{"model": "gpt", "messages": []}"#, "`gpt` does not exist"),
            (r#"{"messages": [{"role": "tool", "content": "a"}]}"#, "messages[0] has the role `tool`"),
            (r#"{"n": 2, "messages": []}"#, "`n` is 1"),
            (r#"{"tools": [{}], "messages": []}"#, "no `tools`"),
            (
                r#"{"messages": [{"role": "user", "content": [{"type": "image_url",
                "image_url": {"url": "http://127.0.0.1/secret"}}]}]}"#,
                "others are not fetched",
            ),
            (
                r#"{"messages": [{"role": "user", "content": [{"type": "image_url",
                "image_url": {"url": "data:image/png;base64,aGVsbG8="}}]}]}"#,
                "no PNG",
            ),
        ] {
            let why = read(body).unwrap_err();
            assert!(why.contains(words), "{body}: {why}");
        }
    }
}
