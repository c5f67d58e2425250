//! Reading bounded: no file is taken into memory before its size is known to be sane.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use motet_syntax::ast::MAX_BYTES;

use crate::exit::Trouble;

/// The bytes of a document.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Bytes {
    /// All of them.
    All(Vec<u8>),
    /// There are more than [`MAX_BYTES`]: so many, as far as is known.
    TooMany(usize),
}

/// Reads a file.
///
/// # Errors
///
/// It cannot be read.
pub(crate) fn read_file(path: &Path) -> Result<Bytes, Trouble> {
    let fail = |source| Trouble::Read { path: path.to_owned(), source };
    let file = File::open(path).map_err(fail)?;
    let metadata = file.metadata().map_err(fail)?;
    if metadata.is_dir() {
        return Err(Trouble::Folder { path: path.to_owned() });
    }
    read(file, usize::try_from(metadata.len()).ok()).map_err(fail)
}

/// Reads a file that is no document of its own right: a card, a scene, a state, a domain.
///
/// # Errors
///
/// It cannot be read, or is too large.
pub(crate) fn read_small(path: &Path) -> Result<Vec<u8>, Trouble> {
    match read_file(path)? {
        Bytes::All(bytes) => Ok(bytes),
        Bytes::TooMany(_) => Err(Trouble::TooLarge { path: path.to_owned() }),
    }
}

/// Reads at most [`MAX_BYTES`]; nothing where the size is known to be greater.
pub(super) fn read(reader: impl Read, size: Option<usize>) -> io::Result<Bytes> {
    if let Some(size) = size.filter(|size| *size > MAX_BYTES) {
        return Ok(Bytes::TooMany(size));
    }
    let mut bytes = Vec::with_capacity(size.unwrap_or_default());
    reader.take(MAX_BYTES as u64 + 1).read_to_end(&mut bytes)?;
    Ok(if bytes.len() > MAX_BYTES { Bytes::TooMany(bytes.len()) } else { Bytes::All(bytes) })
}
