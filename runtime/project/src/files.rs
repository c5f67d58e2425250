//! Bounded reading of files: no file enters memory before its size is known to be sane.

use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::Path;

use motet_syntax::ast::MAX_BYTES;
use motet_syntax::json;
use motet_syntax::{Diagnostic, FileId, Source, Sources};
use schemars::JsonSchema;
use serde::de::DeserializeOwned;

use crate::error::{DiagnosticSink, ProjectError, invalid, require};

/// Content of a document.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Bytes {
    /// The whole content, at most [`MAX_BYTES`].
    All(Vec<u8>),
    /// Size of a document with more than [`MAX_BYTES`], as far as it is known.
    TooMany(usize),
}

/// Opens a regular file, or a pipe that is open already: `/dev/stdin`, or the `/dev/fd/63` of a shell. To
/// open a named pipe or a device may take for ever, and to read one too.
///
/// # Errors
///
/// [`ProjectError::Read`], [`ProjectError::Folder`] or [`ProjectError::Irregular`].
pub fn open(path: &Path) -> Result<File, ProjectError> {
    let fail = |source| ProjectError::Read { path: path.to_owned(), source };
    let kind = path.metadata().map_err(fail)?.file_type();
    if kind.is_dir() {
        return Err(ProjectError::Folder { path: path.to_owned() });
    }
    let is_open_already = ["/dev/fd", "/dev/stdin", "/proc/self/fd"].iter().any(|of| path.starts_with(of));
    if !kind.is_file() && !is_open_already {
        return Err(ProjectError::Irregular { path: path.to_owned() });
    }
    File::open(path).map_err(fail)
}

/// Reads a file of at most [`MAX_BYTES`].
///
/// # Errors
///
/// Those of [`open`], and [`ProjectError::Read`].
pub fn read_file(path: &Path) -> Result<Bytes, ProjectError> {
    let fail = |source| ProjectError::Read { path: path.to_owned(), source };
    let file = open(path)?;
    let size = file.metadata().map_err(fail)?.len();
    read_bounded(file, usize::try_from(size).ok()).map_err(fail)
}

/// Reads a file that must fit into [`MAX_BYTES`]: a card, a scene, a state or a domain.
///
/// # Errors
///
/// Those of [`read_file`], and [`ProjectError::TooLarge`].
pub fn read_small(path: &Path) -> Result<Vec<u8>, ProjectError> {
    match read_file(path)? {
        Bytes::All(bytes) => Ok(bytes),
        Bytes::TooMany(_) => Err(ProjectError::TooLarge { path: path.to_owned() }),
    }
}

/// Name and content of an input: the text itself if it is JSON, under a name in diagnostics, or else the file
/// of this path.
pub(crate) fn read_inline(input: &Path, name: &str) -> Result<(String, Vec<u8>), ProjectError> {
    match input.to_str().filter(|text| is_inline(text)) {
        Some(text) => Ok((name.to_owned(), text.as_bytes().to_vec())),
        None => Ok((input.display().to_string(), read_small(input)?)),
    }
}

/// Is `true` for an input that is JSON itself, and no path.
pub(crate) fn is_inline(input: &str) -> bool {
    input.trim_start().starts_with(['{', '['])
}

/// Name and content of a file; `None` if it does not exist.
pub(crate) fn read_optional(path: &Path) -> Result<Option<(String, Vec<u8>)>, ProjectError> {
    match read_small(path) {
        Ok(bytes) => Ok(Some((path.display().to_string(), bytes))),
        Err(ProjectError::Read { source, .. }) if source.kind() == ErrorKind::NotFound => Ok(None),
        Err(other) => Err(other),
    }
}

/// Reads at most [`MAX_BYTES`] from a stream; nothing if `size` is known to exceed them.
///
/// # Errors
///
/// Those of the reader.
pub fn read_bounded(reader: impl Read, size: Option<usize>) -> io::Result<Bytes> {
    if let Some(size) = size.filter(|size| *size > MAX_BYTES) {
        return Ok(Bytes::TooMany(size));
    }
    let mut bytes = Vec::with_capacity(size.unwrap_or_default());
    reader.take(MAX_BYTES as u64 + 1).read_to_end(&mut bytes)?;
    Ok(if bytes.len() > MAX_BYTES { Bytes::TooMany(bytes.len()) } else { Bytes::All(bytes) })
}

/// Decodes bytes to a source text, with a diagnostic if they are not UTF-8.
#[must_use]
pub fn decode(name: &str, bytes: &[u8], file: FileId) -> (Source, Vec<Diagnostic>) {
    match motet_syntax::decode(bytes, file) {
        Ok(text) => (Source::new(name, text), Vec::new()),
        Err(mistake) => (Source::new(name, String::from_utf8_lossy(bytes)), vec![*mistake]),
    }
}

/// Adds a file to the sources, with a diagnostic if it is not UTF-8.
pub fn add_source(name: &str, bytes: &[u8], sources: &mut Sources) -> (Source, FileId, Vec<Diagnostic>) {
    let file = FileId(u16::try_from(sources.len()).unwrap_or(u16::MAX));
    let (source, diagnostics) = decode(name, bytes, file);
    sources.add(source.clone());
    (source, file, diagnostics)
}

/// Reads JSON that is not a policy, from a file or from the argument itself. `subject` names it in errors.
///
/// # Errors
///
/// The file cannot be read, or does not have the shape of `T`.
pub fn read_json<T: DeserializeOwned + JsonSchema>(
    path: &Path,
    subject: &'static str,
    sink: &mut dyn DiagnosticSink,
) -> Result<(T, Source), ProjectError> {
    let mut sources = Sources::default();
    let (name, bytes) = read_inline(path, subject)?;
    let (source, file, mut diagnostics) = add_source(&name, &bytes, &mut sources);
    let (value, more) = json::read::<T>(&source, file);
    diagnostics.extend(more);
    require(subject, &diagnostics, &sources, sink)?;
    let value = value.ok_or_else(|| invalid(subject, diagnostics, &sources))?;
    Ok((value, source))
}
