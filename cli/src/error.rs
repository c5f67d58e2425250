//! Exit codes of the command, and the errors that keep it from running.

use std::io;
use std::path::PathBuf;

use motet_host::journal::JournalError;
use motet_project::{ProjectError, reason};
use thiserror::Error;

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Exit {
    Success,
    /// Errors were found, or a file would be reformatted.
    Findings,
    /// A bad flag, a missing file or an unreadable card.
    CouldNotRun,
    /// A run failed.
    Failed,
    /// The operator stopped a run.
    Interrupted,
}

impl Exit {
    /// The worse of two codes: an interruption before a failure, a failure before success.
    pub(crate) const fn or_worse(self, other: Self) -> Self {
        match (self, other) {
            (Self::Success, other) => other,
            (first, Self::Success) => first,
            (Self::Interrupted, _) | (_, Self::Interrupted) => Self::Interrupted,
            (first, _) => first,
        }
    }
}

impl Exit {
    /// Exit status of the process.
    pub(crate) const fn status(self) -> u8 {
        match self {
            Self::Success => 0,
            Self::Findings => 1,
            Self::CouldNotRun => 2,
            Self::Failed => 3,
            Self::Interrupted => 130,
        }
    }
}

/// Reason why the command could not run; ends in [`Exit::CouldNotRun`].
#[derive(Error, Debug)]
pub(crate) enum CliError {
    /// A robot, a scene or another input cannot be read.
    #[error(transparent)]
    Project(ProjectError),
    /// An input has errors, which the report has printed.
    #[error("invalid {0} (see the diagnostics above)")]
    Invalid(&'static str),
    #[error("cannot write `{}`: {}", path.display(), reason(source))]
    Write { path: PathBuf, source: io::Error },
    /// Nothing has this name.
    #[error("there is no {what} `{name}`")]
    Unknown { what: &'static str, name: String, help: String },
    /// Any other reason, with advice.
    #[error("{problem}")]
    Advised { problem: String, help: String },
    /// Any other reason, as one clause.
    #[error("{0}")]
    Message(String),
}

impl CliError {
    /// Error of reading a file or stdin.
    pub(crate) fn read(path: impl Into<PathBuf>, source: io::Error) -> Self {
        Self::Project(ProjectError::Read { path: path.into(), source })
    }

    /// Advice on how to correct the error, where one is known.
    pub(crate) fn help(&self) -> Option<&str> {
        match self {
            Self::Unknown { help, .. } | Self::Advised { help, .. } => Some(help),
            Self::Project(error) => error.help(),
            Self::Invalid(_) | Self::Write { .. } | Self::Message(_) => None,
        }
    }
}

impl From<ProjectError> for CliError {
    /// Diagnostics have gone through the report, so they are not printed again.
    fn from(error: ProjectError) -> Self {
        match error {
            ProjectError::Invalid { subject, .. } => Self::Invalid(subject),
            other => Self::Project(other),
        }
    }
}

impl From<motet::Error> for CliError {
    fn from(error: motet::Error) -> Self {
        match error {
            motet::Error::Project(error) => error.into(),
            other => Self::Message(other.to_string()),
        }
    }
}

/// Error of reading or writing a journal.
pub(crate) fn journal_error(error: JournalError) -> CliError {
    CliError::Message(error.to_string())
}
