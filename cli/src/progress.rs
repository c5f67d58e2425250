//! Progress bar of a batch of documents, on a terminal.

use std::io::{self, IsTerminal};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Number of inputs above which a bar is shown.
const BATCH: usize = 8;

/// Progress bar over the bytes of the inputs; hidden for a few inputs, or without a terminal.
#[derive(Debug)]
pub(crate) struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// Bar for `inputs` documents with `bytes` in total.
    pub(crate) fn new(inputs: usize, bytes: u64, verb: &'static str) -> Self {
        let is_batch = inputs > BATCH || bytes > 1 << 20;
        // On the terminal that shows the findings too, the bar would tear them apart.
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

    /// Advances the bar by a document of this size.
    pub(crate) fn advance(&self, bytes: usize) {
        self.bar.inc(bytes as u64);
    }

    /// Hides the bar while `print` runs.
    pub(crate) fn suspend<T>(&self, print: impl FnOnce() -> T) -> T {
        self.bar.suspend(print)
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
