//! File with one JSON object per document, in the order of the documents. Each names its document and has a
//! checksum of it, so that a file that was begun can be continued without doing anything twice.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::path::{Path, PathBuf};

use crc32fast::Hasher;
use motet::line_file::LineFile;
use motet_project::files::Bytes;
use serde_json::{Map, Value, json};

use crate::documents::Document;
use crate::error::CliError;
use crate::flags::ResultArgs;
use crate::report::Progress;

/// File of results, open at its end.
pub(crate) struct ResultFile {
    path: PathBuf,
    file: LineFile,
    /// Checksum of the flags that decide the results.
    seed: Hasher,
    /// Results that the file has already.
    done: VecDeque<DoneResult>,
}

/// Result that a file has already.
#[derive(Clone, Debug)]
pub(crate) struct DoneResult {
    checksum: String,
    /// Line of the file, as an object.
    pub(crate) line: Map<String, Value>,
}

impl ResultFile {
    /// Opens the file of the flags; `None` without one. `flags` are those that decide the results.
    pub(crate) fn open(args: &ResultArgs, flags: &str) -> Result<Option<Self>, CliError> {
        let Some(path) = &args.out else { return Ok(None) };
        let cannot = |source| CliError::Write { path: path.clone(), source };
        let mut seed = Hasher::new();
        seed.update(flags.as_bytes());
        if !args.r#continue {
            let file = LineFile::create(path).map_err(|source| match source.kind() {
                std::io::ErrorKind::AlreadyExists => CliError::Advised {
                    problem: format!("the file `{}` exists", path.display()),
                    help: "continue it with --continue, or give another file".to_owned(),
                },
                _ => cannot(source),
            })?;
            return Ok(Some(Self { path: path.clone(), file, seed, done: VecDeque::new() }));
        }
        let (file, lines) = LineFile::continued(path).map_err(cannot)?;
        let done = lines.iter().enumerate().map(|(index, line)| read(path, index + 1, line));
        let done = done.collect::<Result<_, _>>()?;
        Ok(Some(Self { path: path.clone(), file, seed, done }))
    }

    /// The result of a document that the file has already; `None` if the document is next to do.
    fn done(&mut self, document: &Document) -> Result<Option<DoneResult>, CliError> {
        let Some(done) = self.done.pop_front() else { return Ok(None) };
        if done.checksum == self.checksum(document) {
            return Ok(Some(done));
        }
        Err(CliError::Advised {
            problem: format!(
                "`{}` holds the result of another document, or of other flags, than that of `{}`",
                self.path.display(),
                document.name
            ),
            help: "continue with the same inputs and flags, or give another file".to_owned(),
        })
    }

    /// A document of the shard, with its result if the file has it already; `None` for one of another shard.
    pub(crate) fn due(
        results: &RefCell<Option<Self>>,
        is_of_shard: bool,
        document: Document,
        progress: &Progress,
    ) -> Result<Option<(Option<DoneResult>, Document)>, CliError> {
        if !is_of_shard {
            progress.skip(document.size());
            return Ok(None);
        }
        let done = results.borrow_mut().as_mut().map(|results| results.done(&document)).transpose()?;
        Ok(Some((done.flatten(), document)))
    }

    /// Number of results that the file has from an earlier call and that were not asked for yet.
    pub(crate) fn left(&self) -> usize {
        self.done.len()
    }

    /// Checksum of a document and the flags.
    pub(crate) fn checksum(&self, document: &Document) -> String {
        let mut hasher = self.seed.clone();
        hasher.update(document.name.as_bytes());
        hasher.update(&[0]);
        match &document.bytes {
            Bytes::All(bytes) => hasher.update(bytes),
            Bytes::TooMany(bytes) => hasher.update(&bytes.to_le_bytes()),
        }
        format!("{:08x}", hasher.finalize())
    }

    /// Adds the result of a document.
    pub(crate) fn add(&mut self, name: &str, checksum: &str, more: Value) -> Result<(), CliError> {
        let mut line = json!({"document": name, "checksum": checksum});
        if let (Value::Object(line), Value::Object(more)) = (&mut line, more) {
            line.extend(more);
        }
        let written = self.file.add(&line.to_string());
        written.map_err(|source| CliError::Write { path: self.path.clone(), source })
    }
}

/// Result that stands in a line of a file.
fn read(path: &Path, number: usize, line: &[u8]) -> Result<DoneResult, CliError> {
    let wrong =
        || CliError::Message(format!("line {number} of `{}` is no result of this command", path.display()));
    let line: Map<String, Value> = serde_json::from_slice(line).map_err(|_| wrong())?;
    let checksum = line.get("checksum").and_then(Value::as_str).ok_or_else(wrong)?.to_owned();
    Ok(DoneResult { checksum, line })
}
