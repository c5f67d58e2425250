//! Record of a conversation in a folder: `talk.jsonl` with one event per line, a file for each policy, and a
//! folder with the journal of each run.

use std::cell::RefCell;
use std::fs::{self, File};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use motet::run::journal_head;
use motet_host::journal::{JournalWriter, RunRecorder};
use motet_planner::dialogue::RunRecorder as DialogueRecorder;
use motet_project::SavedDriver;
use motet_runtime::journal::JournalHead;
use motet_runtime::{Driver, Effect, Engine, Observer, RunControl, RunEnd, StartState, Time};
use serde_json::{Value, json};

use crate::error::{CliError, journal_error};
use crate::view::live::SharedPage;
use crate::view::onlooker::PageObserver;

/// Shared writer of a record. It keeps the first error until the end.
#[derive(Clone)]
pub(super) struct ConversationRecord(Rc<RefCell<RecordFiles>>);

struct RecordFiles {
    folder: PathBuf,
    talk: File,
    policies: usize,
    runs: usize,
    error: Option<CliError>,
}

impl ConversationRecord {
    /// Creates the folder.
    pub(super) fn create(folder: &Path) -> Result<Self, CliError> {
        let cannot = |path: &Path| {
            let path = path.to_owned();
            move |source| CliError::Write { path, source }
        };
        fs::create_dir_all(folder).map_err(cannot(folder))?;
        let path = folder.join("talk.jsonl");
        let talk = File::create_new(&path).map_err(cannot(&path))?;
        let record = RecordFiles { folder: folder.to_owned(), talk, policies: 0, runs: 0, error: None };
        Ok(Self(Rc::new(RefCell::new(record))))
    }

    /// Writes an event.
    pub(super) fn write(&self, what: &str, more: Value) {
        self.0.borrow_mut().write(what, more);
    }

    /// Writes a policy that is about to run.
    pub(super) fn policy(&self, text: &str) {
        self.0.borrow_mut().policy(text);
    }

    /// Folder for the journal of the next run.
    pub(super) fn run(&self) -> PathBuf {
        let mut record = self.0.borrow_mut();
        record.runs += 1;
        let name = format!("run_{}", record.runs);
        record.write("run", json!({"journal": name}));
        record.folder.join(name)
    }

    /// Keeps an error of writing, unless there is an earlier one.
    pub(super) fn keep_error(&self, error: CliError) {
        self.0.borrow_mut().error.get_or_insert(error);
    }

    /// Result of writing the record.
    pub(super) fn finish(self) -> Result<(), CliError> {
        self.0.borrow_mut().error.take().map_or(Ok(()), Err)
    }
}

impl RecordFiles {
    fn write(&mut self, what: &str, more: Value) {
        let mut line = json!({"what": what});
        if let (Some(line), Value::Object(more)) = (line.as_object_mut(), more) {
            line.extend(more);
        }
        // At once, so that a process that is killed leaves no half of a line.
        if let Err(source) = self.talk.write_all(format!("{line}\n").as_bytes()) {
            self.error.get_or_insert(CliError::Write { path: self.folder.join("talk.jsonl"), source });
        }
    }

    fn policy(&mut self, text: &str) {
        self.policies += 1;
        let name = format!("policy_{}.motet", self.policies);
        let path = self.folder.join(&name);
        if let Err(source) = fs::write(&path, text) {
            self.error.get_or_insert(CliError::Write { path, source });
        }
        self.write("policy", json!({"file": name}));
    }
}

/// Journal of one run, which `motet replay` reads, or its page, or both.
pub(super) struct RunJournal {
    record: Option<ConversationRecord>,
    page: Option<SharedPage>,
    head: JournalHead,
    saved: Option<SavedDriver>,
}

impl RunJournal {
    pub(super) fn new(
        (record, page): (Option<ConversationRecord>, Option<SharedPage>),
        (run, request): (&str, &str),
        saved: Option<SavedDriver>,
        (engine, start): (&Engine, &StartState),
    ) -> Self {
        let head = JournalHead { instruction: Some(request.to_owned()), ..journal_head(run, engine, start) };
        Self { record, page, head, saved }
    }
}

impl DialogueRecorder for RunJournal {
    fn run(
        self: Box<Self>,
        engine: &mut Engine,
        driver: &mut dyn Driver,
        onlooker: &mut dyn Observer,
        from: Time,
    ) -> RunEnd {
        let Self { record, page, head, saved } = *self;
        // A simulator that runs before this one have changed cannot be opened again as it is.
        let saved = saved.filter(|saved| from == Time::ZERO || !matches!(saved, SavedDriver::Simulator(_)));
        // A driver forgets its goals when a run begins, and then has another name.
        let saved = saved.map(|saved| match driver.instance() {
            Some(instance) => saved.with_instance(instance),
            None => saved,
        });
        let saved = saved.and_then(|saved| saved.to_json().ok()).unwrap_or_default();
        let head = JournalHead { from, driver: saved, ..head };
        let mut shown;
        let onlooker: &mut dyn Observer = match page {
            Some(page) => {
                shown = PageObserver::new(page, onlooker, head.clone());
                &mut shown
            }
            None => onlooker,
        };
        let Some(record) = record else { return motet_runtime::run(engine, driver, onlooker, from) };
        let writer = match JournalWriter::create(&record.run(), head) {
            Ok(writer) => writer,
            Err(error) => {
                record.keep_error(journal_error(error));
                return motet_runtime::run(engine, driver, &mut Stopped, from);
            }
        };
        let mut writing = RunRecorder::new(writer, onlooker).with_motion();
        let end = motet_runtime::run(engine, driver, &mut writing, from);
        if let Err(error) = writing.finish() {
            record.keep_error(journal_error(error));
        }
        end
    }
}

/// Observer that stops a run at once: without its journal nothing starts.
struct Stopped;

impl Observer for Stopped {
    fn commit(&mut self, _now: Time, _effects: &[Effect]) -> RunControl {
        RunControl::Stop
    }
}
