//! Framing of messages on byte streams. A message that cannot be read is an [`Incoming::Broken`] with the
//! answer that the protocol asks for, and the stream goes on; only its end ends the reading.

use std::io::{self, BufRead, Read, Write};

use lsp_server::{ErrorCode, Message};
use serde_json::{Value, json};

/// Maximum size of a message: a document of the greatest size with every byte escaped.
const MAX_MESSAGE_BYTES: usize = 128 * 1024 * 1024;
/// Maximum size of the head of a message.
const MAX_HEAD_BYTES: u64 = 16 * 1024;

/// Message of the client.
#[derive(Debug)]
pub(crate) enum Incoming {
    Message(Message),
    /// Something that is no message, with the answer to it.
    Broken(Value),
}

/// Reads the next message; `None` at the end of the stream.
///
/// # Errors
///
/// The stream fails, or its framing is lost: a head without a length that can be followed.
pub(crate) fn read(stream: &mut impl BufRead) -> io::Result<Option<Incoming>> {
    let Some(length) = read_head(stream)? else { return Ok(None) };
    if length > MAX_MESSAGE_BYTES {
        let skipped = io::copy(&mut stream.take(length as u64), &mut io::sink())?;
        let limit = MAX_MESSAGE_BYTES >> 20;
        let problem = format!("a message of {skipped} bytes is larger than {limit} MiB");
        return Ok(Some(broken(ErrorCode::InvalidRequest, &Value::Null, &problem)));
    }
    let mut body = Vec::new();
    stream.take(length as u64).read_to_end(&mut body)?;
    if body.len() < length {
        return Ok(None);
    }
    Ok(Some(parse(&body)))
}

/// Length of the next message from its head; `None` at the end of the stream.
fn read_head(stream: &mut impl BufRead) -> io::Result<Option<usize>> {
    let mut length = None;
    let mut is_begun = false;
    loop {
        let mut line = Vec::new();
        if stream.take(MAX_HEAD_BYTES).read_until(b'\n', &mut line)? == 0 {
            return Ok(None);
        }
        let line = String::from_utf8_lossy(&line);
        match line.trim_end_matches(['\r', '\n']) {
            "" if length.is_some() => return Ok(length),
            // Blank lines between messages do no harm.
            "" if !is_begun => {}
            "" => return Err(lost("a message has no `Content-Length`")),
            head => {
                is_begun = true;
                let (name, value) = head.split_once(':').ok_or_else(|| lost("a head is no `NAME: VALUE`"))?;
                if name.trim().eq_ignore_ascii_case("content-length") {
                    let value = value.trim().parse().map_err(|_| lost("`Content-Length` is no number"))?;
                    length = Some(value);
                }
            }
        }
    }
}

fn lost(problem: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, format!("{problem}: the messages cannot be told apart"))
}

/// Reads the body of a message.
fn parse(body: &[u8]) -> Incoming {
    let value: Value = match serde_json::from_slice(body) {
        Ok(value) => value,
        Err(error) => {
            return broken(ErrorCode::ParseError, &Value::Null, &format!("the message is no JSON: {error}"));
        }
    };
    let id = value.get("id").filter(|id| id.is_string() || id.is_number()).cloned().unwrap_or_default();
    match serde_json::from_value(value) {
        Ok(message) => Incoming::Message(message),
        Err(_) => {
            broken(ErrorCode::InvalidRequest, &id, "the message is no request, response or notification")
        }
    }
}

fn broken(code: ErrorCode, id: &Value, problem: &str) -> Incoming {
    Incoming::Broken(json!({
        "jsonrpc": "2.0",
        "id": id,
        "error": {"code": code as i32, "message": problem},
    }))
}

/// Writes a message.
///
/// # Errors
///
/// Those of the stream.
pub(crate) fn write(stream: &mut impl Write, message: &Value) -> io::Result<()> {
    let body = message.to_string();
    write!(stream, "Content-Length: {}\r\n\r\n{body}", body.len())?;
    stream.flush()
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::{Incoming, read, write};

    fn check(bytes: &[u8], expected: &[&str]) {
        let mut stream = Cursor::new(bytes);
        for expected in expected {
            let found = match read(&mut stream) {
                Ok(Some(Incoming::Message(message))) => serde_json::to_string(&message).unwrap(),
                Ok(Some(Incoming::Broken(answer))) => answer["error"]["message"].to_string(),
                Ok(None) => "end".to_owned(),
                Err(error) => error.to_string(),
            };
            assert!(found.contains(expected), "{found} has no {expected}");
        }
    }

    #[test]
    fn read_goes_on_behind_broken_messages() {
        let good = r#"{"jsonrpc":"2.0","id":7,"method":"shutdown"}"#;
        let framed = |body: &str| format!("Content-Length: {}\r\n\r\n{body}", body.len());
        let all = [framed("{"), framed("[1]"), framed(r#"{"id":3}"#), framed(good)].concat();
        check(all.as_bytes(), &["no JSON", "no request", "no request", "shutdown", "end"]);
        check(b"\r\n\r\nContent-Type: x\r\ncontent-length: 2\r\n\r\n{}", &["no request", "end"]);
        check(b"Content-Length: 20\r\n\r\n{}", &["end"]);
    }

    #[test]
    fn read_says_where_the_framing_is_lost() {
        check(b"Content-Length: many\r\n\r\n", &["no number"]);
        check(b"hello\r\n\r\n", &["no `NAME: VALUE`"]);
        check(b"Content-Type: x\r\n\r\n", &["no `Content-Length`"]);
    }

    #[test]
    fn write_frames_bytes_and_not_letters() {
        let mut written = Vec::new();
        write(&mut written, &serde_json::json!("😀")).unwrap();
        assert_eq!(written, "Content-Length: 6\r\n\r\n\"😀\"".as_bytes());
    }
}
