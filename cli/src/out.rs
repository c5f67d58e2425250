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

/// The most characters of a text that came from another process, as people are shown it.
const MAX_TOLD_CHARS: usize = 500;

/// A text that came from elsewhere, as one line for a terminal: what would steer the terminal or turn the line around is
/// escaped (`\u{1b}`), and of a long one only the beginning is left.
#[must_use]
pub(crate) fn plain(text: &str) -> String {
    let steers = |letter: char| {
        letter.is_control()
            || matches!(letter, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    let mut told = String::new();
    for (index, letter) in text.chars().enumerate() {
        if index == MAX_TOLD_CHARS {
            told.push('…');
            break;
        }
        if steers(letter) { told.extend(letter.escape_default()) } else { told.push(letter) }
    }
    told
}

/// `1 error`, `2 errors`.
#[must_use]
pub(crate) fn count(number: usize, one: &str) -> String {
    if number == 1 { format!("1 {one}") } else { format!("{number} {one}s") }
}

#[cfg(test)]
mod tests {
    use super::{MAX_TOLD_CHARS, plain};

    #[test]
    fn what_steers_a_terminal_is_escaped_and_long_texts_are_cut() {
        assert_eq!(plain("gripper 40 °C, ok"), "gripper 40 °C, ok");
        assert_eq!(plain("a\u{1b}[2Jb\u{9b}c\nd\u{202e}e"), r"a\u{1b}[2Jb\u{9b}c\nd\u{202e}e");
        assert_eq!(plain(&"x".repeat(900_000)).chars().count(), MAX_TOLD_CHARS + 1);
    }
}
