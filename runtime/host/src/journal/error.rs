//! Errors of journals on disk.

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
        /// Failed action, such as `cannot read`.
        what: &'static str,
        path: PathBuf,
        source: io::Error,
    },
    /// It is damaged.
    #[error("`{}`: {damage}", path.display())]
    Damaged { path: PathBuf, damage: JournalDamage },
    /// A folder that is to hold a new journal is not empty.
    #[error("`{}` is not empty: a journal needs a folder of its own", path.display())]
    NotEmpty { path: PathBuf },
    /// There is no journal in a folder, or not even its first line was written.
    #[error("`{}` holds no journal", path.display())]
    None { path: PathBuf },
    /// Another process writes it.
    #[error("another process writes the journal in `{}`", path.display())]
    Busy { path: PathBuf },
    /// It has too many segments, or they do not follow from each other.
    #[error("`{}`: {what}", path.display())]
    Segments {
        path: PathBuf,
        /// Kind of a validation error.
        what: String,
    },
}

impl JournalError {
    pub(super) fn io(what: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Io { what, path, source }
    }
}
