//! Lines for people. A thread writes them, so that a reader who pauses holds nothing up.

use std::io::Write;
use std::sync::LazyLock;
use std::sync::mpsc::{SyncSender, sync_channel};

/// Writes a note to standard error. One that nobody reads in time is left out, and stops nothing.
pub(crate) fn note(text: &str) {
    static NOTES: LazyLock<SyncSender<String>> = LazyLock::new(|| write_lines(std::io::stderr()));
    let _ = NOTES.try_send(format!("motet-fleet: {}", text.escape_debug()));
}

/// Lines to a writer that may block, of which a thousand wait.
pub(crate) fn write_lines(mut to: impl Write + Send + 'static) -> SyncSender<String> {
    let (lines, waiting) = sync_channel::<String>(1_000);
    std::thread::spawn(move || waiting.iter().try_for_each(|line| writeln!(to, "{line}")));
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_that_nobody_reads_hold_nothing_up() {
        let (_reader, writer) = std::io::pipe().unwrap();
        let lines = write_lines(writer);
        let left_out = (0..3_000).filter(|_| lines.try_send("x".repeat(100)).is_err());
        assert!(left_out.count() > 1_000);
    }
}
