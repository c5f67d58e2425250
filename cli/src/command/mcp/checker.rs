//! Checks of policies on threads of their own, so that a check neither delays a run nor leaves a driver
//! alone, however long it takes.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::thread;

use motet_compiler::Session;
use motet_graph::Graph;
use motet_project::ProjectSession;
use serde_json::Value;
use tokio::sync::Semaphore;

use super::answer::Refusal;
use super::check::findings;
use super::text::read;

/// The most checks at a time: one for a run, and one for a swap.
const MAX_CHECKS: usize = 2;

/// Graph of a policy that checks, with the findings.
pub(super) type Checked = Result<(Graph, Value), Refusal>;

/// Compiles a policy in a session. Refuses it unless it has no error.
pub(super) fn compile(session: &Session, project: &ProjectSession, policy: &str) -> Checked {
    let (source, parsed) = read(policy)?;
    let compiled = session.compile(&parsed, None);
    let found = findings(&compiled.diagnostics, &project.sources(source));
    match compiled.graph {
        Some(graph) => Ok((graph, found)),
        None => Err(Refusal::new("the check refuses the policy: nothing has moved for it").with(found)),
    }
}

/// Checker of policies for the robot.
#[derive(Clone, Debug)]
pub(super) struct Checker {
    project: Arc<ProjectSession>,
    places: Arc<Semaphore>,
}

impl Checker {
    /// Checker of policies in a project.
    pub(super) fn new(project: &Arc<ProjectSession>) -> Self {
        Self { project: Arc::clone(project), places: Arc::new(Semaphore::new(MAX_CHECKS)) }
    }

    /// Begins a check. One that nobody waits for any more keeps its place until it is over.
    pub(super) fn begin(&self, session: Session, policy: String) -> Result<PendingCheck, Refusal> {
        let Ok(place) = Arc::clone(&self.places).try_acquire_owned() else {
            return Err(Refusal::new("earlier checks still go on").with_help("try again later"));
        };
        let project = Arc::clone(&self.project);
        let (sender, result) = channel();
        thread::spawn(move || {
            let checked = compile(&session, &project, &policy);
            drop(place);
            // Who asked may be gone.
            let _ = sender.send(checked);
        });
        Ok(PendingCheck(result))
    }
}

/// Check that goes on.
#[derive(Debug)]
pub(super) struct PendingCheck(Receiver<Checked>);

impl PendingCheck {
    /// Result, once it is there.
    pub(super) fn result(&self) -> Option<Checked> {
        match self.0.try_recv() {
            Ok(checked) => Some(checked),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err(Refusal::new("the check failed inside"))),
        }
    }
}
