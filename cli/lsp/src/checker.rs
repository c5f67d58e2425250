//! Checks beside the loop of the server: first without motions, which takes milliseconds, then with them. Of
//! several versions of a document only the newest is checked.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;

use crossbeam_channel::{Receiver, Sender, unbounded};
use motet_compiler::StepInspection;
use motet_project::DOCUMENT;
use motet_syntax::{Diagnostic, Parsed, Source};

use crate::documents::OpenDocument;
use crate::editor::declarations::Declarations;
use crate::lines::LineIndex;
use crate::workspace::{OpenedSession, Workspace};

/// Version of a document that is read, with the session that it is checked against.
#[derive(Debug)]
pub(crate) struct Snapshot {
    pub(crate) uri: String,
    pub(crate) version: i32,
    pub(crate) generation: u64,
    pub(crate) lines: LineIndex,
    pub(crate) source: Source,
    pub(crate) parsed: Parsed,
    /// The session, or a clause that says why there is none.
    pub(crate) session: Result<Arc<OpenedSession>, String>,
}

impl Snapshot {
    /// Reads a document, and opens its session.
    pub(crate) fn new(document: &OpenDocument, workspace: &Workspace) -> Self {
        let name = document.path.as_ref().map_or(document.uri.clone(), |path| path.display().to_string());
        let source = Source::new(name, Arc::clone(document.lines.text()));
        let parsed = motet_syntax::read(&source, DOCUMENT);
        let session = workspace.session(document.path.as_deref(), &parsed.file);
        Self {
            uri: document.uri.clone(),
            version: document.version,
            generation: document.generation,
            lines: document.lines.clone(),
            source,
            parsed,
            session,
        }
    }

    /// Declarations of the project; none without a session.
    pub(crate) fn declarations(&self) -> &Declarations {
        static NONE: Declarations = Declarations::none();
        self.session.as_ref().map_or(&NONE, |session| session.declarations())
    }
}

/// Result of a check.
#[derive(Debug)]
pub(crate) struct CheckedSnapshot {
    pub(crate) snapshot: Arc<Snapshot>,
    /// Errors, warnings, and notes on what is left to the run.
    pub(crate) diagnostics: Vec<Diagnostic>,
    pub(crate) steps: Vec<StepInspection>,
    /// False while a check with motions is to follow.
    pub(crate) is_final: bool,
}

/// Threads that check documents.
pub(crate) struct Checker {
    jobs: Sender<OpenDocument>,
    newest: Newest,
    pub(crate) results: Receiver<CheckedSnapshot>,
}

impl Checker {
    pub(crate) fn start(workspace: &Arc<Workspace>) -> Self {
        let (jobs, documents) = unbounded::<OpenDocument>();
        let (motions, unsearched) = unbounded::<Arc<Snapshot>>();
        let (done, results) = unbounded();
        let newest = Newest::default();
        let (workspace, first, second) = (Arc::clone(workspace), newest.clone(), newest.clone());
        let (first_done, second_done) = (done.clone(), done);
        thread::spawn(move || {
            for document in documents {
                if !first.is_newest(&document.uri, document.generation) {
                    continue;
                }
                let checked = catch_unwind(AssertUnwindSafe(|| {
                    let snapshot = Arc::new(Snapshot::new(&document, &workspace));
                    (check(&snapshot, false), snapshot)
                }));
                // A fault of the compiler costs the check of one version.
                let Ok((checked, snapshot)) = checked else { continue };
                let is_final = checked.is_final;
                if first_done.send(checked).is_err() || (!is_final && motions.send(snapshot).is_err()) {
                    return;
                }
            }
        });
        thread::spawn(move || {
            for snapshot in unsearched {
                if !second.is_newest(&snapshot.uri, snapshot.generation) {
                    continue;
                }
                let checked = catch_unwind(AssertUnwindSafe(|| check(&snapshot, true)));
                if checked.is_ok_and(|checked| second_done.send(checked).is_err()) {
                    return;
                }
            }
        });
        Self { jobs, newest, results }
    }

    /// Has the newest version of a document checked.
    pub(crate) fn check(&self, document: &OpenDocument) {
        self.newest.lock().insert(document.uri.clone(), document.generation);
        // The threads end with the server only.
        let _ = self.jobs.send(document.clone());
    }

    /// Drops the checks of a document.
    pub(crate) fn forget(&self, uri: &str) {
        self.newest.lock().remove(uri);
    }
}

/// Number of the newest content of each open document, by URI.
#[derive(Clone, Default)]
struct Newest(Arc<Mutex<BTreeMap<String, u64>>>);

impl Newest {
    fn lock(&self) -> MutexGuard<'_, BTreeMap<String, u64>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn is_newest(&self, uri: &str, generation: u64) -> bool {
        self.lock().get(uri) == Some(&generation)
    }
}

/// Checks a document, with motions if they are wanted and the project searches any.
pub(crate) fn check(snapshot: &Arc<Snapshot>, with_motions: bool) -> CheckedSnapshot {
    let Ok(opened) = &snapshot.session else {
        let diagnostics = snapshot.parsed.diagnostics.clone();
        return CheckedSnapshot {
            snapshot: Arc::clone(snapshot),
            diagnostics,
            steps: Vec::new(),
            is_final: true,
        };
    };
    let has_motions = opened.session.has_geometry();
    let session = match with_motions || !has_motions {
        true => opened.session.clone(),
        false => opened.session.without_geometry(),
    };
    let (checked, steps) = session.inspect_document(&snapshot.parsed);
    let is_final = with_motions || !has_motions;
    // Without the motions, each of them would be a note.
    let diagnostics = match is_final {
        true => motet::document::listed(checked, opened, false),
        false => checked.diagnostics,
    };
    CheckedSnapshot { snapshot: Arc::clone(snapshot), diagnostics, steps, is_final }
}
