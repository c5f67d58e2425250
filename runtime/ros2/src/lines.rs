//! Lines of the host on standard input, and for the host on standard output; notes for people on standard
//! error.

use crossbeam_channel::{Receiver, Sender, TrySendError, bounded};
use std::io::{BufRead, Write};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

/// Longest line in bytes.
const MAX_LINE: u64 = 1024 * 1024;
/// Lines that wait for the host to read them.
const WAITING: usize = 4_096;
/// Time for the host to read the last lines.
const FAREWELL: Duration = Duration::from_secs(1);

/// Line of the host, or the end of its lines.
pub(crate) enum Line {
    Text(String),
    Wrong(String),
    End,
}

/// Reads the lines of the host on a thread.
pub(crate) fn read_lines(mut input: impl BufRead + Send + 'static) -> Receiver<Line> {
    let (sender, lines) = bounded(1024);
    std::thread::spawn(move || {
        loop {
            let mut bytes = Vec::new();
            let read = std::io::Read::take(&mut input, MAX_LINE + 1).read_until(b'\n', &mut bytes);
            let line = match read {
                Ok(0) | Err(_) => Line::End,
                Ok(_) if bytes.len() as u64 > MAX_LINE => {
                    Line::Wrong(format!("a line has more than {MAX_LINE} bytes"))
                }
                Ok(_) => String::from_utf8(bytes)
                    .map_or_else(|_| Line::Wrong("a line is not UTF-8".to_owned()), Line::Text),
            };
            let is_last = !matches!(line, Line::Text(_));
            if sender.send(line).is_err() || is_last {
                return;
            }
        }
    });
    lines
}

/// Lines for the host. A thread writes them, so that a host that does not read stops nothing.
pub(crate) struct Output {
    /// `None` once the output is closed.
    lines: Option<Sender<String>>,
    /// Ends when all lines are written.
    written: Receiver<()>,
}

impl Output {
    /// Writes lines to a host.
    pub(crate) fn open(mut output: impl Write + Send + 'static) -> Self {
        let (lines, waiting) = bounded::<String>(WAITING);
        let (end, written) = bounded(0);
        std::thread::spawn(move || {
            // Dropped at the end of the thread.
            let _end: Sender<()> = end;
            for line in waiting {
                if writeln!(output, "{line}").and_then(|()| output.flush()).is_err() {
                    return;
                }
            }
        });
        Self { lines: Some(lines), written }
    }

    /// Writes a line, or keeps it until the host reads.
    ///
    /// # Errors
    ///
    /// The host has closed the output, or has not read for too long.
    pub(crate) fn write(&self, line: String) -> Result<(), String> {
        let Some(lines) = &self.lines else { return Ok(()) };
        lines.try_send(line).map_err(|error| match error {
            TrySendError::Full(_) => format!("the host has not read the last {WAITING} lines"),
            TrySendError::Disconnected(_) => "the host has closed the output".to_owned(),
        })
    }

    /// True if so many lines wait that telemetry is left out.
    pub(crate) fn is_behind(&self) -> bool {
        self.lines.as_ref().is_some_and(|lines| lines.len() > WAITING / 4)
    }
}

impl Drop for Output {
    fn drop(&mut self) {
        self.lines = None;
        // Ends with an error as soon as the thread has ended.
        let _ = self.written.recv_timeout(FAREWELL);
    }
}

/// Notes for people, from the first one on.
static NOTES: Mutex<Option<Output>> = Mutex::new(None);

/// Writes a note to standard error, as [`print_error`] does.
pub(crate) fn note(text: &str) {
    print_error(format!("motet-ros2: {}", text.escape_debug()));
}

/// Writes a line to standard error. One that nobody reads in time is left out, and stops nothing.
pub(crate) fn print_error(line: String) {
    let mut notes = NOTES.lock().unwrap_or_else(PoisonError::into_inner);
    let _ = notes.get_or_insert_with(|| Output::open(std::io::stderr())).write(line);
}

/// Gives who reads the notes the time for the last of them.
pub(crate) fn end_notes() {
    drop(NOTES.lock().unwrap_or_else(PoisonError::into_inner).take());
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::{Arc, Mutex};

    #[derive(Clone, Default)]
    struct Page(Arc<Mutex<Vec<u8>>>, bool);

    impl Write for Page {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            if self.1 {
                return Err(std::io::ErrorKind::BrokenPipe.into());
            }
            self.0.lock().unwrap().extend(bytes);
            Ok(bytes.len())
        }

        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn all_lines_are_written_before_the_end() {
        let page = Page::default();
        let output = Output::open(page.clone());
        (0..100).for_each(|number| output.write(number.to_string()).unwrap());
        drop(output);
        assert!(page.0.lock().unwrap().ends_with(b"98\n99\n"));
    }

    #[test]
    fn host_that_closes_or_does_not_read_is_told() {
        let output = Output::open(Page(Arc::default(), true));
        output.write("one".to_owned()).unwrap();
        while output.write("more".to_owned()).is_ok() {
            std::thread::yield_now();
        }
        let page = Page::default();
        let lock = page.0.lock().unwrap();
        let output = Output::open(page.clone());
        let wrong = (0..WAITING + 2).find_map(|_| output.write("line".to_owned()).err()).unwrap();
        assert_eq!(wrong, "the host has not read the last 4096 lines");
        assert!(output.is_behind());
        drop(lock);
    }
}
