//! Why a journal cannot be read or written.

use motet_runtime::journal::JournalDamage;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A journal that cannot be used.
#[derive(Debug, Error)]
pub enum JournalError {
    /// The system says no.
    #[error("{what} `{}`: {source}", path.display())]
    Io {
        /// What was tried: `cannot read`, `cannot write`.
        what: &'static str,
        /// Which file or folder.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// It is damaged.
    #[error("`{}`: {damage}", path.display())]
    Damaged {
        /// The folder.
        path: PathBuf,
        /// Where, and what is wrong.
        damage: JournalDamage,
    },
    /// A folder that is to hold a new journal is not empty.
    #[error("`{}` is not empty: a journal needs a folder of its own", path.display())]
    NotEmpty {
        /// The folder.
        path: PathBuf,
    },
    /// There is no journal in a folder, or not even its first line was written.
    #[error("`{}` holds no journal", path.display())]
    None {
        /// The folder.
        path: PathBuf,
    },
    /// Another process writes it.
    #[error("another process writes the journal in `{}`", path.display())]
    Busy {
        /// The folder.
        path: PathBuf,
    },
    /// It has too many segments, or they do not follow from each other.
    #[error("`{}`: {what}", path.display())]
    Segments {
        /// The folder.
        path: PathBuf,
        /// What is wrong.
        what: String,
    },
}

impl JournalError {
    pub(super) fn io(what: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Io { what, path, source }
    }
}
