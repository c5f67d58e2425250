//! The body of a chat request, in a server's dialect.

use motet_decode::export::{Dialect, Offer, request_constraint};
use motet_planner::model::{Message, ModelError, Role};
use serde_json::{Map, Value, json};

use crate::settings::Settings;

/// The body of a chat that is answered piece by piece, held to a grammar where the server takes one.
pub(crate) fn chat(settings: &Settings, chat: &[Message], constraint: &Offer) -> Result<Value, ModelError> {
    let mut body = Map::new();
    body.insert("model".to_owned(), settings.model.clone().into());
    body.insert("messages".to_owned(), messages(settings, chat));
    if let Some(dialect) = settings.dialect {
        let Some(Value::Object(fields)) = request_constraint(dialect, constraint) else {
            return Err(ModelError::Refused { why: "it takes no grammar of this form".to_owned() });
        };
        body.extend(fields);
    }
    body.insert("stream".to_owned(), true.into());
    Ok(Value::Object(body))
}

fn messages(settings: &Settings, chat: &[Message]) -> Value {
    let with_images = chat.iter().position(|message| message.role == Role::User);
    let messages = chat.iter().enumerate().map(|(index, message)| {
        let role = match message.role {
            Role::System => "system",
            Role::User => "user",
            Role::Assistant => "assistant",
        };
        if Some(index) != with_images || settings.images.is_empty() {
            return json!({"role": role, "content": message.text});
        }
        if settings.dialect == Some(Dialect::Ollama) {
            let images: Vec<&str> = settings.images.iter().map(|image| image.base64()).collect();
            return json!({"role": role, "content": message.text, "images": images});
        }
        let mut parts = vec![json!({"type": "text", "text": message.text})];
        for image in &settings.images {
            parts.push(json!({"type": "image_url", "image_url": {"url": image.data_url()}}));
        }
        json!({"role": role, "content": parts})
    });
    messages.collect()
}
