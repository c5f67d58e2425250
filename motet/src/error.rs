//! The one error of the facade.

use motet_graph::InvalidGraph;
use motet_host::journal::JournalError;
use motet_host::remote::LinkError;
use motet_planner::builtin::PlanError;
use motet_project::ProjectError;
use motet_runtime::MissingPrimitive;
use motet_syntax::{Diagnostic, Severity, Sources, render};
use thiserror::Error as ThisError;

/// Reason why a project cannot be opened, or why a policy is not compiled, planned or run.
#[derive(ThisError, Debug)]
#[non_exhaustive]
pub enum Error {
    /// The robot, the scene or another input cannot be used.
    #[error(transparent)]
    Project(#[from] ProjectError),
    /// The check refuses the policy. `diagnostics` are in the order of the document, with spans in `sources`.
    #[error("the policy is refused: {}", first_error(diagnostics))]
    Refused { diagnostics: Vec<Diagnostic>, sources: Box<Sources> },
    /// The planner finds no policy for a request.
    #[error("no plan: {0}")]
    Plan(#[from] PlanError),
    /// The operation needs a robot, and the project has none.
    #[error("the project has no robot")]
    NoRobot,
    /// Motions are asked for, and the card of the robot names no body.
    #[error("the card of `{0}` names no URDF under [model]")]
    NoBody(String),
    /// The graph was not made by the compiler and is not valid.
    #[error("the graph is not valid{}", .0.first().map_or_else(String::new, |error| format!(": {error}")))]
    Graph(Vec<InvalidGraph>),
    /// The policy calls primitives that the driver does not have. Nothing has moved.
    #[error("the driver does not have {}", MissingPrimitive::list(.0))]
    Lacking(Vec<MissingPrimitive>),
    /// A driver does not speak the driver protocol.
    #[error("{0}")]
    Driver(#[from] LinkError),
    /// A journal cannot be read or written.
    #[error(transparent)]
    Journal(#[from] JournalError),
}

impl Error {
    /// Diagnostics inside the error; empty if it is about something else than a text.
    #[must_use]
    pub fn diagnostics(&self) -> &[Diagnostic] {
        match self {
            Self::Refused { diagnostics, .. } => diagnostics,
            Self::Project(error) => error.diagnostics(),
            Self::Plan(PlanError::Refused { diagnostics, .. }) => diagnostics,
            _ => &[],
        }
    }

    /// The error for people, in up to `width` columns without colours: diagnostics with the source around
    /// each span.
    #[must_use]
    pub fn render(&self, width: usize) -> String {
        match self {
            Self::Refused { diagnostics, sources }
            | Self::Project(ProjectError::Invalid { diagnostics, sources, .. }) => {
                render::human(diagnostics, sources, render::ColorChoice::Off, width)
            }
            other => format!("{other}\n"),
        }
    }
}

fn first_error(diagnostics: &[Diagnostic]) -> &str {
    let mut errors = diagnostics.iter().filter(|found| found.severity == Severity::Error);
    errors.next().map_or("it holds no single policy", |error| error.message.as_str())
}
