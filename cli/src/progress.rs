//! The progress bar of a batch, on a terminal.

use std::io::{self, IsTerminal};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// From so many inputs on, a bar is shown.
const BATCH: usize = 8;

/// A bar over the bytes of the inputs; nothing where there are few, or where nobody looks.
#[derive(Debug)]
pub(crate) struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// A bar for so many inputs of so many bytes in all.
    #[must_use]
    pub(crate) fn new(inputs: usize, bytes: u64, verb: &'static str) -> Self {
        let is_batch = inputs > BATCH || bytes > 1 << 20;
        // On a terminal that also shows the findings the bar would tear them apart.
        if !is_batch || !io::stderr().is_terminal() || io::stdout().is_terminal() && inputs <= BATCH {
            return Self { bar: ProgressBar::hidden() };
        }
        let bar = ProgressBar::with_draw_target(Some(bytes), ProgressDrawTarget::stderr_with_hz(10));
        let template = "{msg} {wide_bar} {bytes}/{total_bytes} {eta}";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.set_message(verb);
        Self { bar }
    }

    /// So many bytes more are done.
    pub(crate) fn advance(&self, bytes: usize) {
        self.bar.inc(bytes as u64);
    }

    /// Takes the bar away while something is printed.
    pub(crate) fn suspend<T>(&self, print: impl FnOnce() -> T) -> T {
        self.bar.suspend(print)
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
