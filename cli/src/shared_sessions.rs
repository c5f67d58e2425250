//! Sessions for documents that several threads check: each is built once, and what is found in building it is
//! printed with the first document, in the order of the documents, that needs it.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use motet_project::{DiagnosticSink, Project, ProjectSession};
use motet_syntax::ast::File;
use motet_syntax::{Diagnostic, Sources};

use crate::error::CliError;
use crate::report::Report;

/// Sessions by robot.
pub(crate) struct SharedSessions {
    inner: Mutex<Inner>,
}

struct Inner {
    project: Project,
    opened: BTreeMap<String, Arc<SharedSession>>,
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

impl SharedSessions {
    pub(crate) fn new(project: Project) -> Self {
        Self { inner: Mutex::new(Inner { project, opened: BTreeMap::new() }) }
    }

    /// Session for a document.
    pub(crate) fn session_for(&self, document: &File) -> Arc<SharedSession> {
        let mut inner = lock(&self.inner);
        let Inner { project, opened } = &mut *inner;
        let robot = project.robot_for(document);
        let open = || {
            let mut opening = Opening::default();
            let session = project.shared_session_for(document, &mut opening);
            let session = session.map_err(|error| opening.error = Some(error.into())).ok();
            Arc::new(SharedSession { session, opening: Mutex::new(opening) })
        };
        Arc::clone(opened.entry(robot).or_insert_with(open))
    }

    /// The project, when no more documents come.
    pub(crate) fn into_project(self) -> Project {
        self.inner.into_inner().unwrap_or_else(PoisonError::into_inner).project
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
