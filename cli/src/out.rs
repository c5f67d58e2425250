//! Standard output and standard error. A reader that goes away is no mistake: what is left to write is dropped.

use std::io::{self, IsTerminal, Write};

use crate::args::ColorChoice;

/// Whether what is written is coloured.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Colors {
    /// On standard output.
    pub(crate) stdout: bool,
    /// On standard error.
    pub(crate) stderr: bool,
}

impl Colors {
    /// Decides from the flag, the environment and the terminals.
    #[must_use]
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

/// Standard output.
#[derive(Debug, Default)]
pub(crate) struct Out {
    is_used: bool,
    is_closed: bool,
    error: Option<io::Error>,
}

impl Out {
    /// Writes a text and flushes it.
    pub(crate) fn text(&mut self, text: &str) {
        if self.is_closed || text.is_empty() {
            return;
        }
        self.is_used = true;
        let mut stdout = io::stdout().lock();
        if let Err(error) = stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
            self.is_closed = true;
            if error.kind() != io::ErrorKind::BrokenPipe {
                self.error = Some(error);
            }
        }
    }

    /// Writes a text and a line break.
    pub(crate) fn line(&mut self, text: &str) {
        self.text(&format!("{text}\n"));
    }

    /// Whether anything was written.
    #[must_use]
    pub(crate) fn is_used(&self) -> bool {
        self.is_used
    }

    /// Whether nobody reads any more.
    #[must_use]
    pub(crate) fn is_closed(&self) -> bool {
        self.is_closed
    }

    /// Why writing failed, other than by a reader that went away.
    pub(crate) fn take_error(&mut self) -> Option<io::Error> {
        self.error.take()
    }
}

/// Writes a line to standard error; nothing can be done where that fails.
pub(crate) fn note(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// `1 error`, `2 errors`.
#[must_use]
pub(crate) fn count(number: usize, one: &str) -> String {
    if number == 1 { format!("1 {one}") } else { format!("{number} {one}s") }
}
