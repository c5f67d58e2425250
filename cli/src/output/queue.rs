//! Queue between a run and the readers of its output, so that a robot never waits for a reader. A thread
//! writes. What does not fit is left out with a count, or ends the run where it is for programs.

use std::collections::VecDeque;
use std::io::{self, Write};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Bytes that wait in a full queue.
const FULL: usize = 4 << 20;
/// The most bytes of documents that wait for a slow reader.
const MOST: usize = 64 << 20;
/// Time for which a program may take nothing from a full queue.
const PATIENCE: Duration = Duration::from_secs(5);
/// Time for which the end of the command waits for a reader who takes nothing.
const LAST: Duration = Duration::from_secs(2);
/// Interval at which a waiting writer looks for an interrupt.
const SLICE: Duration = Duration::from_millis(50);
/// Bytes that a pipe takes as a whole.
const PIECE: usize = 4096;

/// Meaning of a full queue for a run.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum WhenFull {
    /// It waits: only a simulation stands still.
    Wait,
    GoOn,
}

/// Kind of a text.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Kind {
    /// A note to people, for which nothing waits.
    Note,
    /// A result for people.
    Line,
    /// JSON, of which no line may be missing.
    Document,
}

/// Queues of the output streams.
#[derive(Clone, Debug)]
pub(super) struct Queues {
    pub(super) stdout: Arc<Queue>,
    /// The same one where both streams go to one place, so that their order holds.
    pub(super) stderr: Arc<Queue>,
}

static QUEUES: Mutex<Option<Queues>> = Mutex::new(None);

/// Lets the output go through queues from now on. Nothing waits longer than needed once `is_interrupted`.
pub(crate) fn begin(when: WhenFull, is_interrupted: fn() -> bool) -> io::Result<()> {
    let mut queues = lock(&QUEUES);
    if queues.is_none() {
        let stdout = Queue::start(io::stdout(), when, is_interrupted)?;
        let stderr = match has_one_place() {
            true => Arc::clone(&stdout),
            false => Queue::start(io::stderr(), WhenFull::GoOn, is_interrupted)?,
        };
        *queues = Some(Queues { stdout, stderr });
    }
    Ok(())
}

/// The queues, from the first run on.
pub(super) fn queues() -> Option<Queues> {
    lock(&QUEUES).clone()
}

/// Waits until all is written, or its reader takes nothing more.
pub(crate) fn drain() {
    queues().iter().for_each(|Queues { stdout, stderr }| {
        stdout.drain();
        stderr.drain();
    });
}

/// Writes what is left, and ends the queues.
pub(crate) fn end() {
    drain();
    if let Some(Queues { stdout, stderr }) = lock(&QUEUES).take() {
        stdout.end();
        stderr.end();
    }
}

#[cfg(unix)]
fn has_one_place() -> bool {
    use std::os::fd::AsFd;
    use std::os::unix::fs::MetadataExt as _;
    let place = |stream: &dyn AsFd| {
        let file = std::fs::File::from(stream.as_fd().try_clone_to_owned().ok()?);
        file.metadata().ok().map(|data| (data.dev(), data.ino()))
    };
    place(&io::stdout()).is_some_and(|out| place(&io::stderr()) == Some(out))
}

#[cfg(not(unix))]
fn has_one_place() -> bool {
    use std::io::IsTerminal as _;
    io::stdout().is_terminal() && io::stderr().is_terminal()
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Queue of a stream.
#[derive(Debug)]
pub(super) struct Queue {
    state: Mutex<State>,
    changed: Condvar,
    when: WhenFull,
    is_interrupted: fn() -> bool,
}

#[derive(Debug)]
struct State {
    texts: VecDeque<String>,
    /// Bytes that are not written yet, also of the text that is being written.
    bytes: usize,
    /// Lines that were left out since the last text.
    dropped: usize,
    /// Time at which the reader took something, or was given the first text.
    moved: Instant,
    is_over: bool,
    is_closed: bool,
    error: Option<io::Error>,
}

impl State {
    fn add(&mut self, text: String) {
        self.bytes += text.len();
        self.texts.push_back(text);
    }

    fn add_count(&mut self) {
        if self.dropped > 0 {
            let dropped = std::mem::take(&mut self.dropped);
            self.add(format!("… {dropped} lines were not shown\n"));
        }
    }

    fn close(&mut self) {
        self.texts.clear();
        (self.bytes, self.dropped, self.is_closed) = (0, 0, true);
    }
}

impl Queue {
    fn start(
        to: impl Write + Send + 'static,
        when: WhenFull,
        is_interrupted: fn() -> bool,
    ) -> io::Result<Arc<Self>> {
        let (texts, moved) = (VecDeque::new(), Instant::now());
        let state =
            State { texts, bytes: 0, dropped: 0, moved, is_over: false, is_closed: false, error: None };
        let (state, changed) = (Mutex::new(state), Condvar::new());
        let queue = Arc::new(Self { state, changed, when, is_interrupted });
        let written = Arc::clone(&queue);
        thread::Builder::new().name("output".to_owned()).spawn(move || written.write(to))?;
        Ok(queue)
    }

    /// Takes a text. True if the queue gives its reader up with it.
    pub(super) fn push(&self, text: String, kind: Kind) -> bool {
        let mut state = lock(&self.state);
        let waits = self.when == WhenFull::Wait && kind != Kind::Note;
        while waits && state.bytes > FULL && !(self.is_interrupted)() {
            state = self.wait(state);
        }
        if state.is_closed {
            return false;
        }
        if state.bytes > FULL {
            if kind != Kind::Document {
                state.dropped += text.lines().count();
                return false;
            }
            if state.bytes > MOST || state.moved.elapsed() >= PATIENCE {
                state.is_closed = true;
                return true;
            }
        }
        if state.bytes == 0 {
            state.moved = Instant::now();
        }
        state.add_count();
        state.add(text);
        self.changed.notify_all();
        false
    }

    fn wait<'a>(&self, state: MutexGuard<'a, State>) -> MutexGuard<'a, State> {
        self.changed.wait_timeout(state, SLICE).unwrap_or_else(PoisonError::into_inner).0
    }

    /// True while something waits for the reader.
    pub(super) fn is_behind(&self) -> bool {
        lock(&self.state).bytes > 0
    }

    /// True once the reader is gone, or was given up.
    pub(super) fn is_closed(&self) -> bool {
        lock(&self.state).is_closed
    }

    /// Error of a write, other than a closed pipe.
    pub(super) fn take_error(&self) -> Option<io::Error> {
        lock(&self.state).error.take()
    }

    fn drain(&self) {
        let begun = Instant::now();
        let mut state = lock(&self.state);
        while state.bytes > 0 || state.dropped > 0 {
            let since = if (self.is_interrupted)() { begun } else { state.moved.max(begun) };
            if since.elapsed() >= LAST {
                return state.close();
            }
            state = self.wait(state);
        }
    }

    fn end(&self) {
        lock(&self.state).is_over = true;
        self.changed.notify_all();
    }

    fn next(&self) -> Option<String> {
        let mut state = lock(&self.state);
        loop {
            if state.texts.is_empty() {
                state.add_count();
            }
            match state.texts.pop_front() {
                None if state.is_over => return None,
                None => state = self.wait(state),
                text => return text,
            }
        }
    }

    fn write(&self, mut to: impl Write) {
        while let Some(text) = self.next() {
            for piece in text.as_bytes().chunks(PIECE) {
                let written = to.write_all(piece).and_then(|()| to.flush());
                let mut state = lock(&self.state);
                (state.bytes, state.moved) = (state.bytes.saturating_sub(piece.len()), Instant::now());
                if let Err(error) = written {
                    state.close();
                    state.error = Some(error).filter(|error| error.kind() != io::ErrorKind::BrokenPipe);
                }
                self.changed.notify_all();
                if state.is_closed && state.bytes == 0 {
                    break;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io;
    use std::sync::mpsc::{Receiver, Sender, channel};
    use std::time::Duration;

    use super::{FULL, Kind, Queue, WhenFull, lock};

    /// A reader that takes a piece for each word that it is given.
    struct Slow(Receiver<()>, Sender<Vec<u8>>);

    impl io::Write for Slow {
        fn write(&mut self, piece: &[u8]) -> io::Result<usize> {
            self.0.recv().map_err(|_| io::ErrorKind::BrokenPipe)?;
            self.1.send(piece.to_vec()).map_err(|_| io::ErrorKind::BrokenPipe)?;
            Ok(piece.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn queue_that_is_full_counts_lines_and_gives_up_programs() {
        let ((go, may), (tell, read)) = (channel(), channel());
        let queue = Queue::start(Slow(may, tell), WhenFull::GoOn, || false).unwrap();
        assert!(!queue.push("x".repeat(FULL + 1), Kind::Document));
        assert!(!queue.push("lost\n".to_owned(), Kind::Note));
        assert!(!queue.push("lost\nlost\n".to_owned(), Kind::Line));
        assert!(!queue.push("kept\n".to_owned(), Kind::Document), "the reader has time left");
        for _ in 0..4096 {
            go.send(()).unwrap();
        }
        let expected = "… 3 lines were not shown\nkept\n";
        let told: Vec<u8> = read.iter().flatten().skip(FULL + 1).take(expected.len()).collect();
        assert_eq!(String::from_utf8_lossy(&told), expected);
        drop(go);
    }

    #[test]
    fn queue_gives_a_program_up_that_takes_nothing() {
        let ((go, may), (tell, _read)) = (channel(), channel());
        let queue = Queue::start(Slow(may, tell), WhenFull::GoOn, || false).unwrap();
        assert!(!queue.push("x".repeat(FULL + 1), Kind::Document));
        lock(&queue.state).moved -= super::PATIENCE + Duration::from_secs(1);
        assert!(queue.push("late\n".to_owned(), Kind::Document) && queue.is_closed());
        drop(go);
    }
}
