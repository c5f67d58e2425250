//! Questions of a run and their answers. The run asks at its page, and an answer goes there over HTTP.

use serde_json::{Value, json};
use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::{SocketAddr, TcpStream};
use std::time::Duration;

/// Most characters of an answer.
const MAX_ANSWER: usize = 1_000;
/// Greatest size of the message of an answer in bytes.
const MAX_MESSAGE: usize = 16 * 1024;
/// Line of a run on standard error that has the address of its page, and a token.
const PAGE: &str = "the page is at http://";
/// Time limit for the page to take an answer.
const TAKES: Duration = Duration::from_secs(2);
/// Beginning of the ids of questions at the page of a run that has one policy.
const RUN: &str = "1:";

/// Page of a run.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Page {
    address: SocketAddr,
    token: String,
}

/// Question that nobody has answered.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct OpenQuestion {
    /// Id for nodes: that of the goal, and the number of the call.
    pub(super) id: String,
    number: String,
    text: String,
    options: Vec<String>,
}

/// Answer of a node.
#[derive(PartialEq, Debug)]
pub(super) struct Answer {
    pub(super) question: String,
    answer: String,
}

impl Page {
    /// Page that a line of standard error names.
    pub(super) fn of_line(line: &str) -> Option<Self> {
        let (address, token) = line.strip_prefix(PAGE)?.trim().split_once("/#")?;
        let is_token = !token.is_empty() && token.chars().all(|letter| letter.is_ascii_alphanumeric());
        is_token.then_some(())?;
        Some(Self { address: address.parse().ok()?, token: token.to_owned() })
    }

    /// Gives an answer to the run.
    ///
    /// # Errors
    ///
    /// The run does not wait for it any more.
    pub(super) fn answer(&self, question: &OpenQuestion, answer: &Answer) -> Result<(), String> {
        let id = format!("{RUN}{}", question.number);
        let body = json!({"question": id, "text": answer.answer}).to_string();
        let status = self.post(&body).map_err(|error| format!("the run does not take answers: {error}"))?;
        match status {
            200..=299 => Ok(()),
            409 => Err("the question is answered, or is asked no more".to_owned()),
            status => Err(format!("the run does not take the answer ({status})")),
        }
    }

    fn post(&self, body: &str) -> std::io::Result<u16> {
        let Self { address, token } = self;
        let mut stream = TcpStream::connect_timeout(address, TAKES)?;
        stream.set_read_timeout(Some(TAKES))?;
        stream.set_write_timeout(Some(TAKES))?;
        let head = format!(
            "POST /answer HTTP/1.1\r\nhost: {address}\r\nx-motet-token: {token}\r\n\
             content-type: application/json\r\ncontent-length: {}\r\nconnection: close\r\n\r\n",
            body.len()
        );
        stream.write_all(head.as_bytes())?;
        stream.write_all(body.as_bytes())?;
        let mut line = Vec::new();
        BufReader::new(stream.take(64)).read_until(b'\n', &mut line)?;
        let line = String::from_utf8_lossy(&line);
        let status = line.split(' ').nth(1).and_then(|status| status.parse().ok());
        status.ok_or_else(|| std::io::Error::other("no answer in HTTP"))
    }
}

impl OpenQuestion {
    /// Question of an event of a run, if it is one. `goal` is the id of the goal in hexadecimal digits.
    pub(super) fn of_event(event: &Value, goal: &str) -> Option<Self> {
        let is_command = event.get("event").and_then(Value::as_str) == Some("command");
        let text = event.pointer("/args/question").and_then(Value::as_str).filter(|_| is_command)?;
        let number = event.get("goal")?.as_str()?;
        let options = event.pointer("/args/among").and_then(Value::as_array);
        let options = options.into_iter().flatten().filter_map(Value::as_str).map(str::to_owned).collect();
        Some(Self {
            id: format!("{goal}:{number}"),
            number: number.to_owned(),
            text: text.to_owned(),
            options,
        })
    }

    /// True if an event says that the call of the question has ended.
    pub(super) fn is_over(&self, event: &Value) -> bool {
        let text = |name: &str| event.get(name).and_then(Value::as_str).unwrap_or_default();
        let is_own = text("goal") == self.number;
        matches!(text("event"), "finished") || (is_own && matches!(text("event"), "goal_ended" | "cancel"))
    }

    /// The question for nodes.
    pub(super) fn message(&self) -> Value {
        json!({"question": self.id, "text": self.text, "options": self.options})
    }
}

impl Answer {
    /// Reads the message of a node: `{"question": ID, "answer": TEXT}`.
    ///
    /// # Errors
    ///
    /// It is something else, or too long.
    pub(super) fn read(text: &str) -> Result<Self, String> {
        if text.len() > MAX_MESSAGE {
            return Err(format!("an answer has more than {MAX_MESSAGE} bytes"));
        }
        let value: Value =
            serde_json::from_str(text).map_err(|error| format!("an answer is no JSON: {error}"))?;
        let part = |name: &str| value.get(name).and_then(Value::as_str).map(str::to_owned);
        let (Some(question), Some(answer)) = (part("question"), part("answer")) else {
            return Err("an answer is {\"question\": ID, \"answer\": TEXT}".to_owned());
        };
        if answer.chars().count() > MAX_ANSWER {
            return Err(format!("an answer has more than {MAX_ANSWER} characters"));
        }
        Ok(Self { question, answer })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answer_is_bounded_and_names_its_question() {
        let read = Answer::read(r#"{"question": "ab:#1", "answer": "yes"}"#).unwrap();
        assert_eq!((read.question.as_str(), read.answer.as_str()), ("ab:#1", "yes"));
        let long = json!({"question": "ab:#1", "answer": "a".repeat(1_001)}).to_string();
        assert_eq!(Answer::read(&long), Err("an answer has more than 1000 characters".to_owned()));
        assert!(Answer::read(&"a".repeat(20_000)).is_err());
        assert_eq!(Answer::read("[1]"), Err("an answer is {\"question\": ID, \"answer\": TEXT}".to_owned()));
        assert!(Answer::read("yes").unwrap_err().starts_with("an answer is no JSON"));
    }

    #[test]
    fn question_is_open_from_its_command_to_its_end() {
        let args = json!({"question": "Which?", "among": ["mug_1", "mug_2"]});
        let event = json!({"event": "command", "goal": "#2", "args": args});
        let open = OpenQuestion::of_event(&event, "0af3").unwrap();
        let message = json!({"question": "0af3:#2", "text": "Which?", "options": ["mug_1", "mug_2"]});
        assert_eq!(open.message(), message);
        assert!(open.is_over(&json!({"event": "goal_ended", "goal": "#2"})));
        assert!(!open.is_over(&json!({"event": "goal_ended", "goal": "#1"})));
        assert!(open.is_over(&json!({"event": "finished"})));
        assert_eq!(
            OpenQuestion::of_event(&json!({"event": "command", "goal": "#2", "args": {}}), "0af3"),
            None
        );
    }

    #[test]
    fn page_is_read_from_the_line_of_a_run() {
        let page = Page::of_line("the page is at http://127.0.0.1:4711/#a1b2").unwrap();
        assert_eq!((page.address.port(), page.token.as_str()), (4711, "a1b2"));
        assert_eq!(Page::of_line("the page is at http://127.0.0.1:4711/#a\r\nx: y"), None);
        assert_eq!(Page::of_line("note: it is at http://127.0.0.1:1/#a"), None);
    }
}
