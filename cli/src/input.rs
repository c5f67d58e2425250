//! Documents to read: files, folders, standard input, `.jsonl` with a policy a line. The bytes are handed to the front
//! ends as they are; what they mean is decided there.

mod bytes;
mod lines;
mod walk;

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use crate::exit::Trouble;

pub(crate) use bytes::{Bytes, read_file, read_small};

/// Reads standard input.
///
/// # Errors
///
/// It cannot be read.
pub(crate) fn read_stdin() -> std::io::Result<Bytes> {
    bytes::read(std::io::stdin().lock(), None)
}

/// Where documents come from.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Input {
    /// `-`
    Stdin,
    /// A file with one document.
    File(PathBuf),
    /// A file with a document a line.
    Lines(PathBuf),
}

/// A document as it was found.
#[derive(Debug)]
pub(crate) struct Document {
    /// The name by which diagnostics call it: a path, `-`, or `file.jsonl:LINE`.
    pub(crate) name: String,
    /// The file of which it is one line, and which, from 1.
    pub(crate) line_of: Option<(String, usize)>,
    /// Its file, where it is all of that file.
    pub(crate) path: Option<PathBuf>,
    /// Its bytes, or how many they are where those are too many.
    pub(crate) bytes: Bytes,
}

/// All inputs.
#[derive(Debug)]
pub(crate) struct Inputs {
    /// In the order of the arguments; within a folder sorted by path.
    pub(crate) inputs: Vec<Input>,
    /// The sum of their sizes where known, for a progress bar.
    pub(crate) size: u64,
    /// Scenes and other JSON files in folders that are no policies.
    pub(crate) skipped: Vec<PathBuf>,
}

/// Finds the inputs that paths stand for.
///
/// # Errors
///
/// A path that does not exist or cannot be listed.
pub(crate) fn collect(paths: &[PathBuf]) -> Result<Inputs, Trouble> {
    let mut found = Inputs { inputs: Vec::new(), size: 0, skipped: Vec::new() };
    for path in paths {
        if path.as_os_str() == "-" {
            found.inputs.push(Input::Stdin);
            continue;
        }
        let metadata = path.metadata().map_err(|source| Trouble::Read { path: path.clone(), source })?;
        if metadata.is_dir() {
            walk::folder(path, &mut found)?;
        } else {
            found.size += metadata.len();
            found.inputs.push(of_file(path.clone()));
        }
    }
    let mut seen = std::collections::HashSet::new();
    found.inputs.retain(|input| match input {
        Input::Stdin => seen.insert(PathBuf::from("-")),
        Input::File(path) | Input::Lines(path) => seen.insert(path.clone()),
    });
    Ok(found)
}

fn of_file(path: PathBuf) -> Input {
    if has_extension(&path, "jsonl") { Input::Lines(path) } else { Input::File(path) }
}

fn has_extension(path: &Path, wanted: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(wanted))
}

impl Input {
    /// Reads its documents one after the other, until `each` says to stop.
    ///
    /// # Errors
    ///
    /// The input cannot be read.
    pub(crate) fn documents(
        &self,
        each: &mut dyn FnMut(Document) -> Result<Flow, Trouble>,
    ) -> Result<Flow, Trouble> {
        match self {
            Self::Stdin => {
                let bytes = bytes::read(std::io::stdin().lock(), None)
                    .map_err(|source| Trouble::Read { path: PathBuf::from("-"), source })?;
                each(Document { name: "-".to_owned(), line_of: None, path: None, bytes })
            }
            Self::File(path) => {
                let bytes = read_file(path)?;
                let name = path.display().to_string();
                each(Document { name, line_of: None, path: Some(path.clone()), bytes })
            }
            Self::Lines(path) => {
                let fail = |source| Trouble::Read { path: path.clone(), source };
                let mut reader = BufReader::new(File::open(path).map_err(fail)?);
                let mut number = 0;
                while let Some(bytes) = lines::next(&mut reader).map_err(fail)? {
                    number += 1;
                    if matches!(&bytes, Bytes::All(line) if line.trim_ascii().is_empty()) {
                        continue;
                    }
                    let file = path.display().to_string();
                    let (name, line_of) = (format!("{file}:{number}"), Some((file, number)));
                    if each(Document { name, line_of, path: None, bytes })? == Flow::Stop {
                        return Ok(Flow::Stop);
                    }
                }
                Ok(Flow::GoOn)
            }
        }
    }
}

/// Reads the one document of a file or of standard input.
///
/// # Errors
///
/// It is a folder, or it cannot be read.
pub(crate) fn one_document(path: &Path) -> Result<Document, Trouble> {
    let input = if path.as_os_str() == "-" { Input::Stdin } else { Input::File(path.to_owned()) };
    let mut found = None;
    input.documents(&mut |document| {
        found = Some(document);
        Ok(Flow::GoOn)
    })?;
    found.ok_or_else(|| Trouble::Folder { path: path.to_owned() })
}

impl Document {
    /// Whether it is, byte for byte, this text.
    #[must_use]
    pub(crate) fn is(&self, text: &str) -> bool {
        matches!(&self.bytes, Bytes::All(bytes) if bytes == text.as_bytes())
    }
}

/// Whether reading goes on.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Flow {
    /// With the next document.
    GoOn,
    /// It does not: nobody reads what is said.
    Stop,
}
