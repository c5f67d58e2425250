//! The body of a chat request, in a server's dialect.

use motet_decode::Grammar;
use motet_decode::export::{Dialect, lark_constraint, request_constraint};
use motet_planner::model::{Message, ModelError, Role};
use motet_runtime::CameraImage as Picture;
use serde_json::{Map, Value, json};

use crate::image::EncodedImage;
use crate::settings::{ClientSettings, Notation};

/// The body of a chat that is answered piece by piece, held to a grammar where the server takes one.
pub(crate) fn chat(
    settings: &ClientSettings,
    chat: &[Message],
    constraint: Option<&Map<String, Value>>,
) -> Result<Value, ModelError> {
    let mut body = Map::new();
    body.insert("model".to_owned(), settings.model.clone().into());
    body.insert("messages".to_owned(), messages(settings, chat)?);
    body.extend(constraint.into_iter().flatten().map(|(name, value)| (name.clone(), value.clone())));
    body.insert("stream".to_owned(), true.into());
    Ok(Value::Object(body))
}

/// Parameters that constrain a reply to a grammar, in the server's dialect; none for a server without a
/// dialect.
pub(crate) fn constraint(
    settings: &ClientSettings,
    grammar: &Grammar,
) -> Result<Option<Map<String, Value>>, ModelError> {
    let Some(dialect) = settings.dialect else { return Ok(None) };
    let constraint = match settings.notation {
        Notation::Usual => request_constraint(dialect, grammar),
        Notation::Lark => lark_constraint(dialect, grammar),
    };
    match constraint {
        Some(Value::Object(fields)) => Ok(Some(fields)),
        _ => Err(ModelError::Refused { why: "it takes no grammar of this form".to_owned() }),
    }
}

fn messages(settings: &ClientSettings, chat: &[Message]) -> Result<Value, ModelError> {
    let with_images = chat.iter().position(|message| message.role == Role::User);
    let messages = chat.iter().enumerate().map(|(index, message)| {
        let role = match message.role {
            Role::System => "system",
            Role::User => "user",
            Role::Assistant => "assistant",
        };
        let fixed = if Some(index) == with_images { settings.images.as_slice() } else { &[] };
        let fresh = message.images.iter().map(|image| encoded(image)).collect::<Result<Vec<_>, _>>()?;
        let images: Vec<&EncodedImage> = fixed.iter().chain(&fresh).collect();
        Ok(said(settings, role, &message.text, &images))
    });
    messages.collect()
}

/// A message of one role with its images.
fn said(settings: &ClientSettings, role: &str, text: &str, images: &[&EncodedImage]) -> Value {
    if images.is_empty() {
        return json!({"role": role, "content": text});
    }
    if settings.dialect == Some(Dialect::Ollama) {
        let images: Vec<&str> = images.iter().map(|image| image.base64()).collect();
        return json!({"role": role, "content": text, "images": images});
    }
    let mut parts = vec![json!({"type": "text", "text": text})];
    for image in images {
        parts.push(json!({"type": "image_url", "image_url": {"url": image.data_url()}}));
    }
    json!({"role": role, "content": parts})
}

fn encoded(image: &Picture) -> Result<EncodedImage, ModelError> {
    EncodedImage::new(&image.bytes).map_err(|why| ModelError::Refused {
        why: format!("the picture of the camera `{}` cannot be sent: {why}", image.camera),
    })
}

/// The body of a question about a picture, which is answered all at once.
pub(crate) fn question(
    settings: &ClientSettings,
    image: &Picture,
    question: &str,
) -> Result<Value, ModelError> {
    let messages = json!([said(settings, "user", question, &[&encoded(image)?])]);
    Ok(json!({"model": settings.model, "messages": messages, "stream": false}))
}
