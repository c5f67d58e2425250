//! Why a document cannot be read.

use thiserror::Error;

/// A document that is no graph.
#[derive(Debug, Error)]
pub enum DecodeError {
    /// It is too large.
    #[error("the graph has {bytes} bytes, more than the limit of {limit}")]
    TooLarge {
        /// Its size.
        bytes: usize,
        /// The limit.
        limit: usize,
    },
    /// It is no JSON, or not of the form of a graph.
    #[error("no graph: {0}")]
    Form(#[from] serde_json::Error),
    /// It is of another version.
    #[error("the graph has version {found}; this program reads version {expected}")]
    Version {
        /// Its version.
        found: u64,
        /// The version that is read.
        expected: u32,
    },
    /// It was changed after it was written.
    #[error("the graph was changed after it was written: its hash is {actual}, not {stated}")]
    Hash {
        /// What it says.
        stated: String,
        /// What its content gives.
        actual: String,
    },
}
