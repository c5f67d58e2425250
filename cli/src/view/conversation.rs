//! Record of a conversation for the page: its lines, and the journals of its runs in order.

use std::collections::VecDeque;
use std::path::{Path, PathBuf};

use motet_project::{DiagnosticSink, ProjectSession, SavedDriver, SavedProject};
use motet_runtime::journal::JournalEntry;
use serde::Deserialize;
use serde_json::{Value, json};

use super::journal::JournalFolder;
use super::live::LivePage;
use crate::error::CliError;
use crate::output::opened_again;
use motet::page::source::PolicyText;

/// File with the lines of a conversation.
pub(crate) const TALK: &str = "talk.jsonl";

/// Line of a conversation.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
struct TalkLine {
    what: String,
    text: String,
    question: String,
    answer: Option<String>,
    journal: String,
    file: String,
    why: String,
    outcome: String,
    project: Option<SavedProject>,
}

/// Robot and room of the conversation in a folder, if it names them.
fn project_of(folder: &Path) -> Option<SavedProject> {
    let bytes = motet_project::files::read_small(&folder.join(TALK)).ok()?;
    let first = bytes.split(|byte| *byte == b'\n').next()?;
    serde_json::from_slice::<TalkLine>(first).ok()?.project
}

/// Session of the run whose journal is in a folder, for its robot and its room; `None` where it names none or
/// they have changed since.
pub(crate) fn session(folder: &Path, sink: &mut dyn DiagnosticSink) -> Option<ProjectSession> {
    let mut head = None;
    let _ = motet_host::journal::read(folder, &mut |_, entry| {
        if let JournalEntry::Head(found) = entry {
            head.get_or_insert(found);
        }
    });
    let saved = head.and_then(|head| SavedDriver::from_json(&head.driver).ok());
    let project = saved.as_ref().and_then(SavedDriver::project).cloned();
    let session = project.or_else(|| project_of(folder))?.session(sink);
    opened_again(session, "the scene has changed since the run", "the page shows no room")
}

/// Folder of a conversation.
pub(crate) struct ConversationFolder {
    folder: PathBuf,
    /// Bytes of the lines that were read.
    read: usize,
    lines: VecDeque<TalkLine>,
    run: Option<JournalFolder>,
    questions: u32,
}

impl ConversationFolder {
    /// Conversation in a folder of which nothing is read yet.
    pub(crate) fn new(folder: &Path) -> Self {
        Self { folder: folder.to_owned(), read: 0, lines: VecDeque::new(), run: None, questions: 0 }
    }

    /// Reads what is new. False if nothing is.
    pub(crate) fn news(&mut self, page: &mut LivePage) -> Result<bool, CliError> {
        let mut is_new = self.read_lines();
        loop {
            if self.run.is_some() {
                is_new |= self.follow(page)?;
                // What is said during a run stands before its end.
                let Some(end) = self.lines.iter().position(|line| line.what == "ended") else {
                    return Ok(is_new);
                };
                let said: Vec<TalkLine> = self.lines.drain(..=end).collect();
                said.iter().for_each(|line| self.show(line, page));
                self.run = None;
            }
            let Some(line) = self.lines.pop_front() else { return Ok(is_new) };
            if line.what == "run" {
                self.run = Some(JournalFolder::new(&self.inside(&line.journal)));
            } else {
                self.show(&line, page);
            }
        }
    }

    /// Takes the complete lines that were added.
    fn read_lines(&mut self) -> bool {
        let Ok(bytes) = motet_project::files::read_small(&self.folder.join(TALK)) else { return false };
        let added = bytes.get(self.read..).unwrap_or_default();
        let Some(end) = added.iter().rposition(|byte| *byte == b'\n') else { return false };
        let added = added.get(..=end).unwrap_or_default();
        self.read += added.len();
        let text = String::from_utf8_lossy(added);
        // A line of another version says nothing.
        self.lines.extend(text.lines().filter_map(|line| serde_json::from_str::<TalkLine>(line).ok()));
        true
    }

    /// Reads what is new of the run; a swap comes with the lines that led to it.
    fn follow(&mut self, page: &mut LivePage) -> Result<bool, CliError> {
        let Some(mut run) = self.run.take() else { return Ok(false) };
        let news = run.news(page, &mut |page, entry| {
            if matches!(entry, JournalEntry::Swap(_)) {
                let after = self.lines.iter().position(|line| line.what == "policy").map_or(0, |at| at + 1);
                let said: Vec<TalkLine> = self.lines.drain(..after).collect();
                said.iter().for_each(|line| self.show(line, page));
            }
        });
        self.run = Some(run);
        news
    }

    fn inside(&self, name: &str) -> PathBuf {
        // A name of a file in this folder, whatever the line says.
        self.folder.join(Path::new(name).file_name().unwrap_or_default())
    }

    fn show(&mut self, line: &TalkLine, page: &mut LivePage) {
        let item: Option<Value> = match line.what.as_str() {
            "request" => Some(json!({"t": "say", "who": "person", "text": line.text})),
            "answered" => {
                line.answer.as_ref().map(|answer| json!({"t": "say", "who": "robot", "text": answer}))
            }
            "swap_refused" => Some(json!({"t": "say", "who": "host", "text": line.why})),
            "outcome" => Some(json!({"t": "outcome", "is": line.outcome})),
            "question" => {
                self.questions += 1;
                let q = format!("talk-{}", self.questions);
                page.item(&json!({"t": "question", "q": q, "text": line.question, "options": []}));
                Some(json!({"t": "answered", "q": q, "text": line.answer}))
            }
            "policy" => {
                let path = self.inside(&line.file);
                if let Ok(bytes) = motet_project::files::read_small(&path) {
                    page.text(PolicyText::read(&line.file, &String::from_utf8_lossy(&bytes)));
                }
                None
            }
            _ => None,
        };
        if let Some(item) = item {
            page.item(&item);
        }
    }
}
