//! Few-shot prompting as a baseline: a model is shown requests with their policies before it is asked. It
//! gets neither the state nor what the check finds, and a reply is not asked for again.
//!
//! A model may be a server, or a file with its replies, which makes the baseline run without a server.

use std::time::Duration;

use motet_decode::Grammar;
use motet_planner::model::{Finish, Message, Model, ModelError, Reply, ReplyEvent, Role};
use serde::Deserialize;
use serde_json::Value;

/// Requests with their policies, as a model is shown them.
const SHOTS: &str = include_str!("../tasks/few_shot.jsonl");
/// Heading of the request in a prompt.
const REQUEST: &str = "# Request";

/// Request with its policy.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Shot {
    pub request: String,
    /// The policy as JSON.
    pub policy: Value,
}

/// Reads requests with their policies, one on a line.
///
/// # Errors
///
/// The first line that is none, with its number.
pub fn read(text: &str) -> Result<Vec<Shot>, String> {
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    lines
        .map(|(index, line)| {
            serde_json::from_str(line).map_err(|error| format!("line {}: {error}", index + 1))
        })
        .collect()
}

/// Model that sees examples before each request, and nothing else of the prompt but the request.
pub struct FewShot<M> {
    model: M,
    shots: Vec<Shot>,
}

impl<M: Model> FewShot<M> {
    /// A model with the examples of the evaluation.
    ///
    /// # Errors
    ///
    /// The examples cannot be read.
    pub fn new(model: M) -> Result<Self, String> {
        Ok(Self { model, shots: read(SHOTS)? })
    }

    /// The chat of few-shot prompting: the system message, the examples, and the request.
    fn prompted(&self, chat: &[Message]) -> Vec<Message> {
        let system = chat.iter().filter(|message| message.role == Role::System).cloned();
        let shots = self.shots.iter().flat_map(|shot| {
            let asked = format!("{REQUEST}\n{}\n", shot.request);
            [Message::new(Role::User, asked), Message::new(Role::Assistant, shot.policy.to_string())]
        });
        let asked = Message::new(Role::User, format!("{REQUEST}\n{}\n", request(chat)));
        system.chain(shots).chain([asked]).collect()
    }
}

impl<M: Model> Model for FewShot<M> {
    fn ask(&mut self, chat: &[Message], constraint: &Grammar) -> Result<Box<dyn Reply>, ModelError> {
        let chat = self.prompted(chat);
        self.model.ask(&chat, constraint)
    }

    fn name(&self) -> String {
        format!("{} with {} examples", self.model.name(), self.shots.len())
    }
}

/// Model whose replies stand in a file, by their requests.
pub struct FileModel {
    file: String,
    replies: Vec<Shot>,
}

impl FileModel {
    /// A model with the replies of a file of lines as [`read`] reads them.
    ///
    /// # Errors
    ///
    /// The file cannot be read, or a line is no request with a policy.
    pub fn open(file: &str) -> Result<Self, String> {
        let text = std::fs::read_to_string(file).map_err(|error| format!("cannot read `{file}`: {error}"))?;
        let replies = read(&text).map_err(|why| format!("`{file}`, {why}"))?;
        Ok(Self { file: file.to_owned(), replies })
    }
}

impl Model for FileModel {
    fn ask(&mut self, chat: &[Message], _constraint: &Grammar) -> Result<Box<dyn Reply>, ModelError> {
        let asked = request(chat);
        match self.replies.iter().find(|known| known.request.eq_ignore_ascii_case(&asked)) {
            Some(known) => Ok(Box::new(WholeReply(Some(known.policy.to_string())))),
            None => Err(ModelError::Refused { why: format!("`{}` has no reply to `{asked}`", self.file) }),
        }
    }

    fn name(&self) -> String {
        self.file.clone()
    }
}

/// Reply that is there at once.
struct WholeReply(Option<String>);

impl Reply for WholeReply {
    fn next(&mut self, _wait: Duration) -> ReplyEvent {
        self.0.take().map_or(ReplyEvent::End(Finish::Stop), ReplyEvent::Piece)
    }
}

/// The request in the last message of a person: its first line below the heading.
fn request(chat: &[Message]) -> String {
    let last = chat.iter().rev().find(|message| message.role == Role::User);
    let text = last.map_or("", |message| message.text.as_str());
    let below = text.rsplit_once(REQUEST).map_or(text, |(_, below)| below);
    below.trim().lines().next().unwrap_or_default().trim().to_owned()
}

#[cfg(test)]
mod tests {
    use motet_planner::model::{Message, Role};

    use super::{FewShot, FileModel, read};

    #[test]
    fn few_shot_chat_has_the_examples_and_the_request_alone() {
        let model = FewShot::new(FileModel { file: String::new(), replies: Vec::new() }).unwrap();
        let chat = [
            Message::new(Role::System, "rules"),
            Message::new(Role::User, "# Now\nthe robot holds a mug\n# Request\nOpen the drawer.\nnote"),
        ];
        let chat = model.prompted(&chat);
        assert_eq!(chat.len(), 2 + 2 * model.shots.len());
        assert_eq!(chat.first().map(|message| message.text.as_str()), Some("rules"));
        assert_eq!(chat.last().map(|message| message.text.as_str()), Some("# Request\nOpen the drawer.\n"));
    }

    #[test]
    fn few_shot_line_that_is_wrong_is_named() {
        let right = r#"{"request": "go", "policy": {}}"#;
        assert!(read(&format!("{right}\n{{}}")).unwrap_err().starts_with("line 2: missing field"));
    }
}
