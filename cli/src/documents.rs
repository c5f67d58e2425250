//! Documents on the command line: files, folders, stdin, and `.jsonl` files with one policy per line. The
//! front ends of the language decide what the bytes mean.

use std::collections::{BTreeMap, HashSet};
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::iter;
use std::path::{Path, PathBuf};

use ignore::WalkBuilder;
use motet_project::ProjectError;
use motet_project::files::{Bytes, read_bounded, read_file};
use motet_syntax::ast::MAX_BYTES;
use motet_syntax::{Parsed, Source, Syntax};
use serde::de::IgnoredAny;

use crate::error::CliError;
use crate::flags::folder_of;

/// Reads all of stdin.
pub(crate) fn read_stdin() -> Result<Bytes, CliError> {
    read_bounded(io::stdin().lock(), None).map_err(|source| CliError::read("-", source))
}

/// Source of documents.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Input {
    Stdin,
    File(PathBuf),
    /// A file with one document per line.
    Lines(PathBuf),
}

/// Document as it was read.
#[derive(Debug)]
pub(crate) struct Document {
    /// Name in diagnostics: a path, `-`, or `file.jsonl:LINE`.
    pub(crate) name: String,
    /// File and number of the line that holds the document, from 1.
    pub(crate) line_of: Option<(String, usize)>,
    /// File that holds this document alone.
    pub(crate) path: Option<PathBuf>,
    pub(crate) bytes: Bytes,
}

/// Inputs that the arguments name.
#[derive(Debug)]
pub(crate) struct Inputs {
    /// In the order of the arguments; within a folder sorted by path.
    pub(crate) inputs: Vec<Input>,
    /// Sum of the known sizes, for a progress bar.
    pub(crate) size: u64,
    /// JSON files in folders that are not policies.
    pub(crate) skipped: Vec<PathBuf>,
}

/// Finds the inputs behind the paths of the command line.
pub(crate) fn collect(paths: &[PathBuf]) -> Result<Inputs, CliError> {
    let mut found = Inputs { inputs: Vec::new(), size: 0, skipped: Vec::new() };
    for path in paths {
        if path.as_os_str() == "-" {
            found.inputs.push(Input::Stdin);
            continue;
        }
        let metadata = path.metadata().map_err(|source| CliError::read(path, source))?;
        if metadata.is_dir() {
            add_folder(path, &mut found)?;
        } else {
            found.size += metadata.len();
            found.inputs.push(of_file(path.clone()));
        }
    }
    let mut seen = HashSet::new();
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

impl Inputs {
    /// Documents of the inputs, read as they are asked for.
    pub(crate) fn documents(&self) -> impl Iterator<Item = Result<Document, CliError>> + '_ {
        self.inputs.iter().flat_map(Input::reader)
    }
}

impl Input {
    /// Reads the documents one after the other, until `each` stops it.
    pub(crate) fn documents(
        &self,
        each: &mut dyn FnMut(Document) -> Result<Flow, CliError>,
    ) -> Result<Flow, CliError> {
        for document in self.reader() {
            if each(document?)? == Flow::Stop {
                return Ok(Flow::Stop);
            }
        }
        Ok(Flow::Continue)
    }

    /// Documents of the input, read as they are asked for. An error is the last.
    fn reader(&self) -> Box<dyn Iterator<Item = Result<Document, CliError>> + '_> {
        match self {
            Self::Stdin => Box::new(iter::once_with(|| {
                let bytes = read_stdin()?;
                Ok(Document { name: "-".to_owned(), line_of: None, path: None, bytes })
            })),
            Self::File(path) => Box::new(iter::once_with(|| {
                let bytes = read_file(path)?;
                let name = path.display().to_string();
                Ok(Document { name, line_of: None, path: Some(path.clone()), bytes })
            })),
            Self::Lines(path) => match motet_project::files::open(path) {
                Ok(file) => Box::new(Lines { path, reader: Some(BufReader::new(file)), number: 0 }),
                Err(source) => Box::new(iter::once(Err(source.into()))),
            },
        }
    }
}

/// Documents of a file with one document per line.
struct Lines<'a> {
    path: &'a Path,
    /// Rest of the file; `None` after an error.
    reader: Option<BufReader<File>>,
    /// Number of the line that was read last.
    number: usize,
}

impl Iterator for Lines<'_> {
    type Item = Result<Document, CliError>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let bytes = match next_line(self.reader.as_mut()?) {
                Ok(bytes) => bytes?,
                Err(source) => {
                    self.reader = None;
                    return Some(Err(CliError::read(self.path, source)));
                }
            };
            self.number += 1;
            if matches!(&bytes, Bytes::All(line) if line.trim_ascii().is_empty()) {
                continue;
            }
            let file = self.path.display().to_string();
            let (name, line_of) = (format!("{file}:{}", self.number), Some((file, self.number)));
            return Some(Ok(Document { name, line_of, path: None, bytes }));
        }
    }
}

/// Reads a file or stdin with one document.
pub(crate) fn one_document(path: &Path) -> Result<Document, CliError> {
    let input = if path.as_os_str() == "-" { Input::Stdin } else { Input::File(path.to_owned()) };
    let mut found = None;
    input.documents(&mut |document| {
        found = Some(document);
        Ok(Flow::Continue)
    })?;
    found.ok_or_else(|| ProjectError::Folder { path: path.to_owned() }.into())
}

impl Document {
    /// Is `true` if the document is, byte for byte, this text.
    pub(crate) fn is(&self, text: &str) -> bool {
        matches!(&self.bytes, Bytes::All(bytes) if bytes == text.as_bytes())
    }

    /// Number of bytes, for a progress bar.
    pub(crate) fn size(&self) -> usize {
        match &self.bytes {
            Bytes::All(bytes) => bytes.len(),
            Bytes::TooMany(bytes) => *bytes,
        }
    }

    /// Folder of the file, or else the present one.
    pub(crate) fn folder(&self) -> PathBuf {
        let file = self.path.as_deref().or_else(|| self.line_of.as_ref().map(|(file, _)| Path::new(file)));
        file.map_or(Path::new("."), folder_of).to_owned()
    }

    /// Parses the document. Bytes that are not text, or are too many, are diagnostics.
    pub(crate) fn parse(&self) -> (Source, Parsed) {
        self.parse_as(|source| motet_syntax::read(source, motet_project::DOCUMENT))
    }

    /// Is `true` if the document is in the JSON syntax.
    pub(crate) fn is_json(&self) -> bool {
        self.parse().1.syntax == Syntax::Json
    }

    /// Parses a document of another language.
    pub(crate) fn parse_as(&self, read: impl FnOnce(&Source) -> Parsed) -> (Source, Parsed) {
        let line_of = self.line_of.as_ref().map(|(file, line)| (file.as_str(), *line));
        motet::document::parse_as(&self.name, &self.bytes, line_of, read)
    }
}

/// Continuation of a loop over documents.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Flow {
    Continue,
    /// Nobody reads the output any more.
    Stop,
}

/// Longest line that is stepped over: an endless one would never be done.
const MAX_SKIPPED: usize = 4 * MAX_BYTES;

/// Next line without its line break, or the length of a line that is too long; `None` at the end.
fn next_line(reader: &mut impl BufRead) -> io::Result<Option<Bytes>> {
    let mut line = Vec::new();
    let mut length = reader.by_ref().take(MAX_BYTES as u64 + 1).read_until(b'\n', &mut line)?;
    if length == 0 {
        return Ok(None);
    }
    if line.last() == Some(&b'\n') {
        line.pop();
        return Ok(Some(Bytes::All(line)));
    }
    if length <= MAX_BYTES {
        return Ok(Some(Bytes::All(line)));
    }
    loop {
        let (skipped, is_over) = {
            let buffer = reader.fill_buf()?;
            match buffer.iter().position(|byte| *byte == b'\n') {
                Some(end) => (end + 1, true),
                None => (buffer.len(), buffer.is_empty()),
            }
        };
        reader.consume(skipped);
        length += skipped;
        if is_over {
            return Ok(Some(Bytes::TooMany(length)));
        }
        if length > MAX_SKIPPED {
            let why = format!("a line of it has more than {} MiB", MAX_SKIPPED >> 20);
            return Err(io::Error::new(io::ErrorKind::InvalidData, why));
        }
    }
}

/// Adds the .motet and .json files of a folder that Git does not ignore, sorted by path.
fn add_folder(path: &Path, found: &mut Inputs) -> Result<(), CliError> {
    let mut files = Vec::new();
    for entry in WalkBuilder::new(path).require_git(false).build() {
        let entry = entry.map_err(|error| {
            let path = failed_path(&error).unwrap_or(path).to_owned();
            let source = error.into_io_error();
            CliError::read(path, source.unwrap_or_else(|| io::Error::other("the folder cannot be listed")))
        })?;
        let file = entry.path();
        let is_file = entry.file_type().is_some_and(|kind| kind.is_file());
        if !is_file || !(has_extension(file, "motet") || has_extension(file, "json")) {
            continue;
        }
        if has_extension(file, "json") && !may_be_policy(file)? {
            found.skipped.push(file.to_owned());
            continue;
        }
        found.size += entry.metadata().map_or(0, |metadata| metadata.len());
        files.push(file.to_owned());
    }
    files.sort();
    found.inputs.extend(files.into_iter().map(Input::File));
    Ok(())
}

/// Is `true` if a JSON file in a folder may be a policy: scenes, states and other data are there too. Broken
/// JSON counts as one, so that its errors are reported.
fn may_be_policy(path: &Path) -> Result<bool, CliError> {
    let Bytes::All(bytes) = read_file(path)? else { return Ok(true) };
    let has = |members: &Members, keys: &[&str]| keys.iter().any(|key| members.contains_key(*key));
    Ok(match serde_json::from_slice::<Members>(&bytes) {
        Ok(members) => has(&members, &["motet", "policy", "steps", "achieves", "do"]),
        // A list of steps without the policy around it.
        Err(error) if error.is_data() => serde_json::from_slice::<Vec<Members>>(&bytes).is_ok_and(|items| {
            items.iter().any(|item| has(item, &["do", "sequence", "monitor", "parallel"]))
        }),
        Err(_) => true,
    })
}

/// Members of an object, without their values.
type Members = BTreeMap<String, IgnoredAny>;

/// File or folder of an error in a walk.
fn failed_path(error: &ignore::Error) -> Option<&Path> {
    match error {
        ignore::Error::WithPath { path, .. } => Some(path),
        ignore::Error::WithDepth { err, .. } | ignore::Error::WithLineNumber { err, .. } => failed_path(err),
        ignore::Error::Partial(errors) => errors.iter().find_map(failed_path),
        ignore::Error::Loop { child, .. } => Some(child),
        ignore::Error::Io(_)
        | ignore::Error::Glob { .. }
        | ignore::Error::UnrecognizedFileType(_)
        | ignore::Error::InvalidDefinition => None,
    }
}
