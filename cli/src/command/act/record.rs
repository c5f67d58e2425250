//! A record of a conversation in a folder: `talk.jsonl`, a line for each thing that happens, every policy in a file of its
//! own, and the journal of every run in a folder of its own.

use std::cell::RefCell;
use std::fs::{self, File};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use serde_json::{Value, json};

use crate::exit::Trouble;

/// Writes a record, from several places. A mistake in writing is kept until the end.
#[derive(Clone)]
pub(super) struct Recorder(Rc<RefCell<Record>>);

struct Record {
    folder: PathBuf,
    talk: File,
    policies: usize,
    runs: usize,
    trouble: Option<Trouble>,
}

impl Recorder {
    /// Makes the folder.
    ///
    /// # Errors
    ///
    /// It cannot be written to, or holds a record already.
    pub(super) fn create(folder: &Path) -> Result<Self, Trouble> {
        let cannot = |path: &Path| {
            let path = path.to_owned();
            move |source| Trouble::Write { path, source }
        };
        fs::create_dir_all(folder).map_err(cannot(folder))?;
        let path = folder.join("talk.jsonl");
        let talk = File::create_new(&path).map_err(cannot(&path))?;
        let record = Record { folder: folder.to_owned(), talk, policies: 0, runs: 0, trouble: None };
        Ok(Self(Rc::new(RefCell::new(record))))
    }

    /// Something happened.
    pub(super) fn write(&self, what: &str, more: Value) {
        self.0.borrow_mut().write(what, more);
    }

    /// A policy is about to run.
    pub(super) fn policy(&self, text: &str) {
        self.0.borrow_mut().policy(text);
    }

    /// A run is about to begin: the folder for its journal.
    pub(super) fn run(&self) -> PathBuf {
        let mut record = self.0.borrow_mut();
        record.runs += 1;
        let name = format!("run_{}", record.runs);
        record.write("run", json!({"journal": name}));
        record.folder.join(name)
    }

    /// Something could not be written.
    pub(super) fn spoil(&self, trouble: Trouble) {
        self.0.borrow_mut().trouble.get_or_insert(trouble);
    }

    /// What went wrong in writing.
    pub(super) fn finish(self) -> Result<(), Trouble> {
        self.0.borrow_mut().trouble.take().map_or(Ok(()), Err)
    }
}

impl Record {
    fn write(&mut self, what: &str, more: Value) {
        let mut line = json!({"what": what});
        if let (Some(line), Value::Object(more)) = (line.as_object_mut(), more) {
            line.extend(more);
        }
        if let Err(source) = writeln!(self.talk, "{line}") {
            self.trouble.get_or_insert(Trouble::Write { path: self.folder.join("talk.jsonl"), source });
        }
    }

    fn policy(&mut self, text: &str) {
        self.policies += 1;
        let name = format!("policy_{}.motet", self.policies);
        let path = self.folder.join(&name);
        if let Err(source) = fs::write(&path, text) {
            self.trouble.get_or_insert(Trouble::Write { path, source });
        }
        self.write("policy", json!({"file": name}));
    }
}
