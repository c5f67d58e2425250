//! Projects of documents: the robot, scene and domains that the nearest `motet.toml` names, opened once and
//! again when one of their files changes.

use std::collections::BTreeMap;
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::SystemTime;

use motet_project::{Discard, ProjectBuilder, ProjectSession, named_robot};
use motet_syntax::ast::File;

use crate::editor::declarations::Declarations;

/// Reader of the settings for a folder: its `motet.toml`, or what the command line says. The problem is a
/// clause for people.
pub type OpenFolder = Box<dyn Fn(&Path) -> Result<ProjectBuilder, String> + Send + Sync>;

/// Greatest number of sessions that are kept.
const MAX_SESSIONS: usize = 16;

/// Session of a project, with the declarations of its files.
#[derive(Debug)]
pub(crate) struct OpenedSession {
    session: Arc<ProjectSession>,
    /// Collected on first use.
    declarations: OnceLock<Declarations>,
}

impl OpenedSession {
    /// Declarations of the library, the robot, the domains and the scene.
    pub(crate) fn declarations(&self) -> &Declarations {
        self.declarations.get_or_init(|| Declarations::of_project(&self.session))
    }
}

impl Deref for OpenedSession {
    type Target = ProjectSession;

    fn deref(&self) -> &ProjectSession {
        &self.session
    }
}

/// Sessions of all documents.
pub(crate) struct Workspace {
    open: OpenFolder,
    sessions: Mutex<BTreeMap<SessionKey, StampedSession>>,
}

/// Session with the files that it was opened from.
type StampedSession = (Vec<FileStamp>, Arc<OpenedSession>);

/// Inputs of a session: the settings, and the robot that a document names.
type SessionKey = (String, Option<String>);

/// File with the time of its last change; `None` if there is none.
type FileStamp = (PathBuf, Option<(SystemTime, u64)>);

impl Workspace {
    pub(crate) fn new(open: OpenFolder) -> Self {
        Self { open, sessions: Mutex::default() }
    }

    /// Session for a document. A domain of the project is checked against the other domains.
    ///
    /// # Errors
    ///
    /// A clause that says why there is none: the settings, or a file that they name, cannot be used.
    pub(crate) fn session(&self, path: Option<&Path>, document: &File) -> Result<Arc<OpenedSession>, String> {
        let folder = path.and_then(Path::parent).unwrap_or(Path::new("."));
        let mut builder = (self.open)(folder)?;
        if let Some(path) = path {
            builder = builder.without_domain(path);
        }
        let key = (format!("{builder:?}"), named_robot(document));
        let stamps: Vec<FileStamp> = builder.files().into_iter().map(stamp).collect();
        let mut sessions = self.sessions.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((known, session)) = sessions.get(&key)
            && *known == stamps
        {
            return Ok(Arc::clone(session));
        }
        let text = |error: motet_project::ProjectError| match error.help() {
            Some(help) => format!("{error}; {help}"),
            None => error.to_string(),
        };
        let mut project = builder.open().map_err(text)?;
        let session = project.shared_session_for(document, &mut Discard).map_err(text)?;
        let session = Arc::new(OpenedSession { session, declarations: OnceLock::new() });
        if sessions.len() >= MAX_SESSIONS {
            sessions.clear();
        }
        sessions.insert(key, (stamps, Arc::clone(&session)));
        Ok(session)
    }
}

fn stamp(path: PathBuf) -> FileStamp {
    let state = std::fs::metadata(&path).ok();
    let state = state.and_then(|state| Some((state.modified().ok()?, state.len())));
    (path, state)
}
