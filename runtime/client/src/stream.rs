//! A reply as it arrives: server-sent events, a JSON object a line (Ollama), or all at once from a server
//! that does not stream. No more bytes are taken than the settings allow, and no silence longer.

use std::error::Error as _;
use std::sync::mpsc::Sender;
use std::time::Duration;

use eventsource_stream::{EventStreamError, Eventsource as _};
use futures_util::{Stream, StreamExt as _};
use motet_planner::model::{Finish, ModelError, ReplyEvent};
use reqwest::Response;
use reqwest::header::CONTENT_TYPE;
use serde_json::Value;

use crate::reply_reader::ReplyReader;
use crate::settings::ClientSettings;

type Bytes = Vec<u8>;

/// The body of a response in pieces, none of them late, and not more than so many bytes.
fn pieces(
    response: Response,
    settings: &ClientSettings,
) -> impl Stream<Item = Result<Bytes, ModelError>> + Unpin + Send {
    let (idle, most) = (settings.idle_timeout, settings.max_bytes);
    let body = Box::pin(response.bytes_stream());
    let next = futures_util::stream::unfold((body, 0_usize), move |(mut body, taken)| async move {
        let piece = match tokio::time::timeout(idle, body.next()).await {
            Err(_) => Err(timed_out(idle)),
            Ok(None) => return None,
            Ok(Some(Err(error))) => Err(ModelError::CutOff { why: reason(error) }),
            Ok(Some(Ok(piece))) if taken + piece.len() > most => Err(ModelError::TooLong { bytes: most }),
            Ok(Some(Ok(piece))) => Ok(piece.to_vec()),
        };
        let taken = taken + piece.as_ref().map_or(0, Vec::len);
        Some((piece, (body, taken)))
    });
    Box::pin(next)
}

/// A whole body as text.
pub(crate) async fn text(response: Response, most: usize) -> Result<String, ModelError> {
    let mut bytes = Vec::new();
    let mut body = response.bytes_stream();
    while let Some(piece) = body.next().await {
        let piece = piece.map_err(|error| ModelError::CutOff { why: reason(error) })?;
        if bytes.len() + piece.len() > most {
            return Err(ModelError::TooLong { bytes: most });
        }
        bytes.extend_from_slice(&piece);
    }
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// Passes the text of a reply on, piece by piece, and says how it finished.
pub(crate) async fn pass_on(
    response: Response,
    settings: &ClientSettings,
    news: &Sender<ReplyEvent>,
) -> Result<Finish, ModelError> {
    let kind = response.headers().get(CONTENT_TYPE).and_then(|kind| kind.to_str().ok()).unwrap_or_default();
    let kind = kind.to_ascii_lowercase();
    let pieces = pieces(response, settings);
    let mut reader = ReplyReader::new(settings, news);
    let end = match kind.starts_with("text/event-stream") {
        true => events(pieces, &mut reader).await,
        false => lines(pieces, &mut reader).await,
    };
    reader.close();
    end
}

async fn events(
    pieces: impl Stream<Item = Result<Bytes, ModelError>> + Unpin,
    reader: &mut ReplyReader<'_>,
) -> Result<Finish, ModelError> {
    let mut events = pieces.eventsource();
    while let Some(event) = events.next().await {
        let event = event.map_err(|error| match error {
            EventStreamError::Transport(error) => error,
            EventStreamError::Utf8(_) => malformed("its events are no UTF-8"),
            EventStreamError::Parser(_) => malformed("its events cannot be read"),
        })?;
        if event.data.trim() == "[DONE]" {
            return Ok(reader.finish().unwrap_or(Finish::Stop));
        }
        if !event.data.is_empty() && reader.take(&event.data)? {
            break;
        }
    }
    reader.finish().ok_or_else(broke_off)
}

/// A JSON object a line, or one object over many lines.
async fn lines(
    mut pieces: impl Stream<Item = Result<Bytes, ModelError>> + Unpin,
    reader: &mut ReplyReader<'_>,
) -> Result<Finish, ModelError> {
    let (mut bytes, mut begun) = (Vec::new(), 0);
    while let Some(next) = pieces.next().await {
        let next = next?;
        let from = bytes.len();
        bytes.extend_from_slice(&next);
        let breaks = next.iter().enumerate().filter(|(_, byte)| **byte == b'\n').map(|(at, _)| from + at + 1);
        for end in breaks {
            let line = String::from_utf8_lossy(bytes.get(begun..end).unwrap_or_default()).into_owned();
            // Of an object over many lines a single one says nothing.
            if serde_json::from_str::<Value>(&line).is_ok_and(|value| value.is_object()) {
                reader.take(&line)?;
                begun = end;
            }
        }
        if reader.finish().is_some() {
            break;
        }
        bytes.drain(..begun);
        begun = 0;
    }
    let rest = String::from_utf8_lossy(bytes.get(begun..).unwrap_or_default()).into_owned();
    if reader.finish().is_none() && !rest.trim().is_empty() {
        match serde_json::from_str::<Value>(&rest) {
            Ok(_) => drop(reader.take(&rest)?),
            Err(_) if rest.trim_start().starts_with('{') => return Err(broke_off()),
            Err(error) => return Err(malformed(&format!("it is no JSON: {error}"))),
        };
    }
    reader.finish().ok_or_else(broke_off)
}

fn malformed(why: &str) -> ModelError {
    ModelError::Malformed { why: why.to_owned() }
}

fn broke_off() -> ModelError {
    ModelError::CutOff { why: "it ended without saying so".to_owned() }
}

pub(crate) fn timed_out(after: Duration) -> ModelError {
    ModelError::TimedOut { secs: after.as_secs_f64() }
}

/// Description of an error down to its cause, without the address, which the caller knows.
pub(crate) fn reason(error: reqwest::Error) -> String {
    let error = error.without_url();
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(next) = cause {
        let words = next.to_string();
        if !text.contains(&words) {
            text.push_str(": ");
            text.push_str(&words);
        }
        cause = next.source();
    }
    text
}
