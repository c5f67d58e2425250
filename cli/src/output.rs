//! Stdout and stderr. A closed pipe is no error: the rest of the output is dropped. From the first run on,
//! both go through a queue.

pub(crate) mod queue;

use std::fs::{self, File};
use std::io::{self, IsTerminal, Write};
use std::path::Path;

use clap::ValueEnum;
use motet_project::ProjectError;
use motet_syntax::render::{escaped, escaped_json, is_steering};

use crate::error::CliError;
use queue::{Kind, queues};

pub(crate) use motet::printable::escape;

/// Colours of the output.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, ValueEnum)]
pub(crate) enum ColorChoice {
    #[default]
    Auto,
    Always,
    Never,
}

/// Colours of the output streams.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Colors {
    pub(crate) stdout: bool,
    pub(crate) stderr: bool,
}

impl Colors {
    /// Colours by the flag, `NO_COLOR`, `TERM` and the terminals.
    pub(crate) fn new(choice: ColorChoice) -> Self {
        let plain = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty())
            || std::env::var_os("TERM").is_some_and(|term| term == "dumb");
        let decide = |is_terminal: bool| match choice {
            ColorChoice::Auto => is_terminal && !plain,
            ColorChoice::Always => true,
            ColorChoice::Never => false,
        };
        Self { stdout: decide(io::stdout().is_terminal()), stderr: decide(io::stderr().is_terminal()) }
    }
}

/// Stdout, until its reader goes away.
#[derive(Debug, Default)]
pub(crate) struct Output {
    is_used: bool,
    is_closed: bool,
    is_queued: bool,
    error: Option<io::Error>,
}

impl Output {
    /// Writes a text and flushes it. What would steer a terminal is escaped: texts of others may be in it.
    pub(crate) fn text(&mut self, text: &str) {
        self.styled(&escaped(text));
    }

    /// Writes documents of JSON and flushes them. What would steer a terminal is escaped as JSON has it.
    pub(crate) fn json(&mut self, text: &str) {
        self.write(&escaped_json(text), Kind::Document);
    }

    /// Writes a document in its notation and flushes it.
    pub(crate) fn document(&mut self, text: &str, is_json: bool) {
        if is_json { self.json(text) } else { self.text(text) }
    }

    /// Writes a text with its own colours, in which the texts of others are escaped, and flushes it.
    pub(crate) fn styled(&mut self, text: &str) {
        self.write(text, Kind::Line);
    }

    fn write(&mut self, text: &str, kind: Kind) {
        if self.is_closed || text.is_empty() {
            return;
        }
        self.is_used = true;
        if let Some(queues) = queues() {
            self.is_queued = true;
            if queues.stdout.push(text.to_owned(), kind) {
                note("nobody takes the lines of the output any more: it counts as closed");
            }
            return;
        }
        let mut stdout = io::stdout().lock();
        if let Err(error) = stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
            self.is_closed = true;
            if error.kind() != io::ErrorKind::BrokenPipe {
                self.error = Some(error);
            }
        }
    }

    /// Writes a document to a file, or to stdout without one or for `-`.
    pub(crate) fn file(&mut self, path: Option<&Path>, text: &str, is_json: bool) -> Result<(), CliError> {
        match path {
            Some(path) if path.as_os_str() != "-" => replace_file(path, text),
            Some(_) | None => {
                self.document(text, is_json);
                Ok(())
            }
        }
    }

    /// Writes a text and a line break.
    pub(crate) fn line(&mut self, text: &str) {
        self.text(&format!("{text}\n"));
    }

    /// Writes a document of JSON and a line break.
    pub(crate) fn json_line(&mut self, text: &str) {
        self.json(&format!("{text}\n"));
    }

    /// Is `true` after the first write.
    pub(crate) fn is_used(&self) -> bool {
        self.is_used
    }

    /// Is `true` once the reader is gone.
    pub(crate) fn is_closed(&self) -> bool {
        self.is_closed || queues().is_some_and(|queues| queues.stdout.is_closed())
    }

    /// Is `true` while a reader has not taken what was written.
    pub(crate) fn is_behind(&self) -> bool {
        queues().is_some_and(|queues| queues.stdout.is_behind())
    }

    /// Error of a write, other than a closed pipe.
    pub(crate) fn take_error(&mut self) -> Option<io::Error> {
        queue::drain();
        let queues = queues().filter(|_| self.is_queued);
        self.error.take().or_else(|| queues.and_then(|queues| queues.stdout.take_error()))
    }
}

/// Writes a file beside the old one and then puts it in its place: a full disk or an interruption leaves the
/// old one whole. A pipe or a device is written to directly.
pub(crate) fn replace_file(path: &Path, text: &str) -> Result<(), CliError> {
    let cannot = |source| CliError::Write { path: path.to_owned(), source };
    replace_with(path, |mut file| file.write_all(text.as_bytes()).map_err(cannot))
}

/// Replaces a file by what `write` writes, as [`replace_file`] does.
pub(crate) fn replace_with<T>(
    path: &Path,
    write: impl FnOnce(&File) -> Result<T, CliError>,
) -> Result<T, CliError> {
    let cannot = |source| CliError::Write { path: path.to_owned(), source };
    // A link stays a link.
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let old = fs::metadata(&target).ok();
    if old.as_ref().is_some_and(|old| !old.is_file()) {
        return write(&File::create(path).map_err(cannot)?);
    }
    if old.as_ref().is_some_and(|old| old.permissions().readonly()) {
        return Err(cannot(io::ErrorKind::PermissionDenied.into()));
    }
    put_in_place(&target, &mut File::options(), |file| {
        let written = write(file)?;
        let permissions = old.map_or(Ok(()), |old| file.set_permissions(old.permissions()));
        permissions.map(|()| written).map_err(cannot)
    })
}

/// Writes a new file that only its owner reads, in place of an old one or of a link.
pub(crate) fn replace_secret(path: &Path, text: &str) -> Result<(), CliError> {
    let cannot = |source| CliError::Write { path: path.to_owned(), source };
    let mut options = File::options();
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    put_in_place(path, &mut options, |mut file| file.write_all(text.as_bytes()).map_err(cannot))
}

/// Writes a new file beside `target` and then puts it in its place.
fn put_in_place<T>(
    target: &Path,
    options: &mut fs::OpenOptions,
    write: impl FnOnce(&File) -> Result<T, CliError>,
) -> Result<T, CliError> {
    let cannot = |source| CliError::Write { path: target.to_owned(), source };
    let mut beside = target.to_owned().into_os_string();
    beside.push(format!(".{}.partial", std::process::id()));
    let file = options.write(true).create_new(true).open(&beside).map_err(cannot)?;
    let written = write(&file).and_then(|written| {
        let replaced = file.sync_all().and_then(|()| fs::rename(&beside, target));
        replaced.map(|()| written).map_err(cannot)
    });
    written.inspect_err(|_| {
        let _ = fs::remove_file(&beside);
    })
}

/// Writes a line to stderr. What would steer a terminal is escaped: texts of others may be in it.
pub(crate) fn note(text: &str) {
    styled_note(&escaped(text));
}

/// Writes a line with its own colours to stderr.
pub(crate) fn styled_note(text: &str) {
    prompt(&format!("{text}\n"));
}

/// Writes a text to stderr as it is. Errors are ignored: nobody is left to read of them.
pub(crate) fn prompt(text: &str) {
    match queues() {
        Some(queues) => _ = queues.stderr.push(text.to_owned(), Kind::Note),
        None => _ = io::stderr().lock().write_all(text.as_bytes()),
    }
}

/// Text of a model without what would steer a terminal.
pub(crate) fn printable(text: &str) -> String {
    text.chars().filter(|letter| !is_steering(*letter) || *letter == '\n').collect()
}

/// `1 error`, `2 errors`.
pub(crate) fn count(number: usize, one: &str) -> String {
    if number == 1 { format!("1 {one}") } else { format!("{number} {one}s") }
}

/// `1 entry`, `2 entries`.
pub(crate) fn count_irregular(number: usize, one: &str, several: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { several })
}

/// Part of a saved project that was opened again. Without it, a note says why, and what the command does
/// without it.
pub(crate) fn opened_again<T>(
    opened: Result<Option<T>, ProjectError>,
    changed: &str,
    without: &str,
) -> Option<T> {
    match opened {
        Ok(Some(opened)) => return Some(opened),
        Ok(None) => note(&format!("{changed}: {without}")),
        Err(error) => note(&format!("{without}: {}", CliError::from(error))),
    }
    None
}
