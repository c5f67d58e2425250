//! Sessions for documents that several threads check: each is built once, and what is found in building it is
//! printed with the first document, in the order of the documents, that needs it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use motet_project::{DiagnosticSink, ProjectSession};
use motet_syntax::ast::File;
use motet_syntax::{Diagnostic, Sources};

use crate::error::CliError;
use crate::projects::Projects;
use crate::report::Report;

/// Sessions by the folder of a document and its robot.
pub(crate) struct SharedSessions<'a> {
    inner: Mutex<Inner<'a>>,
}

struct Inner<'a> {
    projects: Projects<'a>,
    opened: BTreeMap<(PathBuf, String), Arc<SharedSession>>,
}

/// Session of one robot, or the reason why there is none.
pub(crate) struct SharedSession {
    /// The session; `None` if it cannot be built.
    pub(crate) session: Option<Arc<ProjectSession>>,
    /// Findings and the error of building it, until they are printed.
    opening: Mutex<Opening>,
}

#[derive(Default)]
struct Opening {
    findings: Vec<(Vec<Diagnostic>, Sources)>,
    error: Option<CliError>,
}

impl DiagnosticSink for Opening {
    fn report(&mut self, diagnostics: &[Diagnostic], sources: &Sources) {
        self.findings.push((diagnostics.to_vec(), sources.clone()));
    }
}

impl<'a> SharedSessions<'a> {
    pub(crate) fn new(projects: Projects<'a>) -> Self {
        Self { inner: Mutex::new(Inner { projects, opened: BTreeMap::new() }) }
    }

    /// Session for a document in a folder.
    pub(crate) fn session_for(&self, folder: &Path, document: &File) -> Arc<SharedSession> {
        let mut inner = lock(&self.inner);
        let Inner { projects, opened } = &mut *inner;
        let mut opening = Opening::default();
        let project = match projects.of(folder, &mut opening) {
            Ok(project) => project,
            Err(error) => {
                opening.error = Some(error);
                return Arc::new(SharedSession { session: None, opening: Mutex::new(opening) });
            }
        };
        let robot = project.robot_for(document);
        let open = || {
            let session = project.shared_session_for(document, &mut opening);
            let session = session.map_err(|error| opening.error = Some(error.into())).ok();
            Arc::new(SharedSession { session, opening: Mutex::new(opening) })
        };
        Arc::clone(opened.entry((folder.to_owned(), robot)).or_insert_with(open))
    }

    /// The projects, when no more documents come.
    pub(crate) fn into_projects(self) -> Projects<'a> {
        self.inner.into_inner().unwrap_or_else(PoisonError::into_inner).projects
    }
}

impl SharedSession {
    /// Prints what was found in building the session, once.
    ///
    /// # Errors
    ///
    /// The reason why it cannot be built.
    pub(crate) fn announce(&self, report: &mut Report) -> Result<(), CliError> {
        let opening = std::mem::take(&mut *lock(&self.opening));
        opening.findings.iter().for_each(|(found, sources)| report.print(found, sources));
        opening.error.map_or(Ok(()), Err)
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
