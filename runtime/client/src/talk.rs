//! One request with its retries, and the reply as it arrives.

use std::sync::mpsc::Sender;
use std::time::Duration;

use motet_planner::model::{ModelError, ReplyEvent};
use reqwest::header::{CONTENT_TYPE, HeaderMap, RETRY_AFTER};
use reqwest::{Response, StatusCode};
use serde_json::Value;

use crate::dialect::Delivery;
use crate::reply_reader::{content, shown, without_key};
use crate::settings::ClientSettings;
use crate::stream::{self, reason, timed_out};

/// Sends a body and passes on what comes, the ending last. Who no longer listens is not told.
pub(crate) async fn talk(
    http: &reqwest::Client,
    settings: &ClientSettings,
    body: String,
    news: &Sender<ReplyEvent>,
) {
    let whole = async {
        let sends = |news_of| drop(news.send(news_of));
        let response = send(http, settings, (Delivery::Streamed, body), sends).await?;
        stream::pass_on(response, settings, news).await
    };
    let end = match tokio::time::timeout(settings.timeout, whole).await {
        Ok(Ok(finish)) => ReplyEvent::End(finish),
        Ok(Err(error)) => ReplyEvent::Failed(error),
        Err(_) => ReplyEvent::Failed(timed_out(settings.timeout)),
    };
    let _ = news.send(end);
}

/// Sends a body until the server takes it, or there is no use in trying again.
pub(crate) async fn send(
    http: &reqwest::Client,
    settings: &ClientSettings,
    (delivery, body): (Delivery, String),
    tell: impl Fn(ReplyEvent),
) -> Result<Response, ModelError> {
    let mut back_off = settings.back_off;
    let mut tries = 0;
    loop {
        let request = http
            .post(settings.request_url(delivery))
            .header(CONTENT_TYPE, "application/json")
            .body(body.clone());
        let sent = tokio::time::timeout(settings.idle_timeout, request.send()).await;
        let (error, asked) = match sent {
            Ok(Ok(response)) if response.status().is_success() => return Ok(response),
            Ok(Ok(response)) => {
                let status = response.status();
                let asked = retry_after(response.headers());
                let error = refusal(response, settings).await;
                if !is_passing(status) {
                    return Err(error);
                }
                (error, asked)
            }
            Ok(Err(error)) if error.is_builder() => {
                return Err(ModelError::Refused { why: reason(error) });
            }
            Ok(Err(error)) => (ModelError::Unreachable { why: reason(error) }, None),
            Err(_) => return Err(timed_out(settings.idle_timeout)),
        };
        if tries == settings.retries {
            return Err(error);
        }
        tries += 1;
        let after = asked.unwrap_or(back_off).min(settings.longest_back_off);
        tell(ReplyEvent::Retrying { why: error.to_string(), after });
        tokio::time::sleep(after).await;
        back_off = back_off.saturating_mul(2);
    }
}

/// True if a server that answers so may answer otherwise soon.
fn is_passing(status: StatusCode) -> bool {
    status == StatusCode::TOO_MANY_REQUESTS
        || status == StatusCode::REQUEST_TIMEOUT
        || status.is_server_error() && status != StatusCode::NOT_IMPLEMENTED
}

/// Delay that the server asks for in the `Retry-After` header, in seconds. A date is not read, since two
/// clocks seldom agree.
fn retry_after(headers: &HeaderMap) -> Option<Duration> {
    let seconds: u64 = headers.get(RETRY_AFTER)?.to_str().ok()?.trim().parse().ok()?;
    Some(Duration::from_secs(seconds))
}

/// Error for a response that is not a success, with the server's words.
async fn refusal(response: Response, settings: &ClientSettings) -> ModelError {
    let status = response.status();
    // The words are a courtesy: what does not come soon is not waited for.
    let words = tokio::time::timeout(
        settings.idle_timeout.min(Duration::from_secs(5)),
        stream::text(response, settings.max_bytes.min(64 << 10)),
    );
    let said = words.await.ok().and_then(Result::ok).unwrap_or_default();
    let said = shown(settings.key.as_ref(), &said);
    let colon = if said.is_empty() { "" } else { ": " };
    let why = format!("it answers {status}{colon}{said}");
    if is_passing(status) { ModelError::Busy { why } } else { ModelError::Refused { why } }
}

/// Sends a body and reads the whole answer.
pub(crate) async fn once(
    http: &reqwest::Client,
    settings: &ClientSettings,
    body: String,
) -> Result<Value, ModelError> {
    let whole = async {
        let response = send(http, settings, (Delivery::Whole, body), |_| ()).await?;
        let text = stream::text(response, settings.max_bytes).await?;
        let mut answer = serde_json::from_str(&text)
            .map_err(|error| ModelError::Malformed { why: format!("it is no JSON: {error}") })?;
        if let Some(key) = &settings.key {
            without_key(key, &mut answer);
            let text = content(settings.dialect, &answer).unwrap_or_default();
            if key.cut_from(&text) != text {
                return Err(ModelError::Malformed { why: "it has the key in it, in parts".to_owned() });
            }
        }
        Ok(answer)
    };
    tokio::time::timeout(settings.timeout, whole).await.unwrap_or_else(|_| Err(timed_out(settings.timeout)))
}
