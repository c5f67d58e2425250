//! A question with one answer, all at once.

use motet_planner::model::ModelError;
use serde_json::Value;

use crate::settings::ClientSettings;
use crate::{stream, talk};

/// Sends a body and reads the whole answer.
pub(crate) async fn once(
    http: &reqwest::Client,
    settings: &ClientSettings,
    body: String,
) -> Result<Value, ModelError> {
    let whole = async {
        let response = talk::send(http, settings, body, |_| ()).await?;
        let text = stream::text(response, settings.max_bytes).await?;
        serde_json::from_str(&text)
            .map_err(|error| ModelError::Malformed { why: format!("it is no JSON: {error}") })
    };
    tokio::time::timeout(settings.timeout, whole)
        .await
        .unwrap_or_else(|_| Err(talk::timed_out(settings.timeout)))
}

/// The text of a chat answer: of an OpenAI-like server, or of Ollama.
#[must_use]
pub fn content(answer: &Value) -> Option<&str> {
    answer
        .pointer("/choices/0/message/content")
        .or_else(|| answer.pointer("/message/content"))
        .and_then(Value::as_str)
}
