//! How the command ends: its exit codes, and what keeps it from running at all.

use std::io;
use std::path::PathBuf;
use std::process::ExitCode;

use thiserror::Error;

/// The exit codes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Exit {
    /// Nothing to say against it.
    Clean,
    /// Errors were found, or a file would be reformatted.
    Findings,
    /// A bad flag, a missing file, an unreadable card.
    CouldNotRun,
    /// A run failed.
    Failed,
    /// A run was stopped by a person.
    Interrupted,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(match exit {
            Exit::Clean => 0,
            Exit::Findings => 1,
            Exit::CouldNotRun => 2,
            Exit::Failed => 3,
            Exit::Interrupted => 130,
        })
    }
}

/// Why the command could not run; ends in [`Exit::CouldNotRun`].
#[derive(Error, Debug)]
pub(crate) enum Trouble {
    /// A file or folder cannot be read.
    #[error("cannot read `{}`: {}", path.display(), reason(source))]
    Read {
        /// Which.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A file cannot be written.
    #[error("cannot write `{}`: {}", path.display(), reason(source))]
    Write {
        /// Which.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// A folder where a file is asked for.
    #[error("`{}` is a folder, a file is asked for", path.display())]
    Folder {
        /// Which.
        path: PathBuf,
    },
    /// A file that is too large to be read.
    #[error("`{}` is larger than {} MiB", path.display(), motet_syntax::ast::MAX_BYTES >> 20)]
    TooLarge {
        /// Which.
        path: PathBuf,
    },
    /// A folder without a card.
    #[error("the folder `{}` has no robot.toml", path.display())]
    NoCard {
        /// Which.
        path: PathBuf,
    },
    /// A name that nothing has.
    #[error("there is no {what} `{name}`")]
    Unknown {
        /// What was asked for: `robot`, `scene`, `code`.
        what: &'static str,
        /// The name as given.
        name: String,
        /// What to write instead.
        help: String,
    },
    /// Diagnostics about the robot, the scene, the state or a domain, which have been printed.
    #[error("the {0} cannot be used: see above")]
    Diagnosed(&'static str),
    /// Anything else that keeps the run from starting.
    #[error("{0}")]
    Other(String),
}

impl Trouble {
    /// What to do about it, where that is known.
    #[must_use]
    pub(crate) fn help(&self) -> Option<&str> {
        match self {
            Self::Unknown { help, .. } => Some(help),
            Self::NoCard { .. } => {
                Some("a robot's folder holds robot.toml, and primitives.motet where its signatures differ")
            }
            Self::TooLarge { .. } => Some("split it into several files"),
            Self::Read { .. }
            | Self::Write { .. }
            | Self::Folder { .. }
            | Self::Diagnosed(_)
            | Self::Other(_) => None,
        }
    }
}

/// What the system said, in the words of the other messages.
fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file or folder".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        _ => error.to_string(),
    }
}
