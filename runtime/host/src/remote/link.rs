//! Lines to and from a driver. Two threads read and write, so that a driver that does not listen holds up
//! nobody.

use super::protocol::{
    MAX_BEFORE_ANSWER, MAX_BREACHES, MAX_ERROR_LINE_BYTES, MAX_ERROR_LINES_A_SECOND, MAX_FACT_BYTES,
    MAX_LAST_LINES, MAX_LINE_BYTES, MAX_LOOK_BYTES, MAX_WAITING,
};
use super::rate::LineRate;
use motet_runtime::Time;
use std::collections::VecDeque;
use std::fmt;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::{Shutdown, TcpStream};
#[cfg(unix)]
use std::os::unix::net::UnixStream;
use std::process::Child;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// Function that takes a line of the standard error of a driver.
pub type ErrorOutput = fn(&str);

/// Error that ends the connection to a driver.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum LinkError {
    /// It could not be started or called.
    NotReached(String),
    /// It ended, or closed the connection.
    Closed,
    Read(String),
    /// It said nothing for so long, though it was asked for a sign of life.
    Silent(Duration),
    /// It has answered its greeting, and nothing behind it for so long.
    Mute(Duration),
    /// It does not take in what is said to it.
    Deaf,
    /// It said a line that is too long.
    Flood,
    /// It said more than so many of something in a second.
    Hasty(u32, &'static str),
    /// It told a fact that is not watched in too long a line.
    LongFact,
    /// It said more before an answer than is kept.
    Crowded,
    /// It broke more promises than are borne.
    Faithless,
    /// It said a line that is no message; the beginning of the line, and why.
    Nonsense(String, String),
    /// It did not answer the greeting, or otherwise than it should.
    Greeting(String),
    /// It answered a call with this error.
    Refused(String),
}

impl fmt::Display for LinkError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotReached(why) => write!(f, "the driver cannot be reached: {why}"),
            Self::Closed => f.write_str("the driver ended, or closed the connection"),
            Self::Read(why) => write!(f, "the driver cannot be heard: {why}"),
            Self::Silent(span) => {
                write!(f, "the driver gave no sign of life for {:.1} s", span.as_secs_f64())
            }
            Self::Mute(span) => {
                write!(
                    f,
                    "the driver answered its greeting, and then nothing for {:.1} s",
                    span.as_secs_f64()
                )?;
                f.write_str("; it was told to do nothing")
            }
            Self::Deaf => f.write_str("the driver does not read its messages"),
            Self::Flood => {
                write!(f, "the driver said a line of more than {MAX_LINE_BYTES} bytes, or a larger picture")
            }
            Self::LongFact => {
                write!(f, "the driver told a fact that is not watched in more than {MAX_FACT_BYTES} bytes")
            }
            Self::Hasty(most, what) => write!(f, "the driver said more than {most} {what} in a second"),
            Self::Crowded => {
                write!(f, "the driver said more than {MAX_BEFORE_ANSWER} things before it answered a call")
            }
            Self::Faithless => write!(f, "the driver broke its promises more than {MAX_BREACHES} times"),
            Self::Nonsense(line, why) => write!(f, "the driver said `{line}`, which is no message: {why}"),
            Self::Greeting(why) => write!(f, "the driver did not answer the greeting: {why}"),
            Self::Refused(why) => write!(f, "the driver says: {why}"),
        }
    }
}

impl std::error::Error for LinkError {}

/// Other end of the link, ended together with it.
#[derive(Debug)]
pub(super) enum Peer {
    Process(Child),
    Socket(TcpStream),
    /// A driver in this process.
    #[cfg(unix)]
    Stream(UnixStream),
}

#[derive(Debug)]
pub(super) struct Link {
    heard: Receiver<Result<String, LinkError>>,
    said: SyncSender<String>,
    speaker: JoinHandle<()>,
    peer: Peer,
    /// True while a picture is due, whose line may be longer than others.
    awaits_picture: Arc<AtomicBool>,
    /// True where the link says something by itself while the host is busy.
    keeps_alive: Arc<AtomicBool>,
    /// Passes the standard error of a process on.
    errors: Option<JoinHandle<()>>,
}

/// Sign of life that the link gives by itself: its line, asked for anew each time, and after what silence of
/// the host.
pub(super) struct KeepAlive {
    pub(super) line: Box<dyn Fn() -> String + Send>,
    pub(super) after: Duration,
}

impl Link {
    pub(super) fn new(
        reader: impl BufRead + Send + 'static,
        writer: Box<dyn Write + Send>,
        peer: Peer,
        keep_alive: KeepAlive,
    ) -> Self {
        let (tell, heard) = sync_channel(MAX_WAITING);
        let (said, lines) = sync_channel(MAX_WAITING);
        let awaits_picture = Arc::new(AtomicBool::new(false));
        let keeps_alive = Arc::new(AtomicBool::new(false));
        let (picture, is_alive) = (Arc::clone(&awaits_picture), Arc::clone(&keeps_alive));
        thread::spawn(move || listen(reader, &tell, &picture));
        let speaker = thread::spawn(move || speak(writer, &lines, &keep_alive, &is_alive));
        Self { heard, said, speaker, peer, awaits_picture, keeps_alive, errors: None }
    }

    /// Lets the link give signs of life by itself from now on.
    pub(super) fn keep_alive(&self) {
        self.keeps_alive.store(true, Ordering::SeqCst);
    }

    /// Permits or forbids the long line of a picture.
    pub(super) fn await_picture(&self, is_due: bool) {
        self.awaits_picture.store(is_due, Ordering::SeqCst);
    }

    pub(super) fn of_child(
        mut child: Child,
        keep_alive: KeepAlive,
        errors: Option<ErrorOutput>,
    ) -> Result<Self, LinkError> {
        let (Some(stdout), Some(stdin)) = (child.stdout.take(), child.stdin.take()) else {
            return Err(LinkError::Closed);
        };
        let errors = errors
            .zip(child.stderr.take())
            .map(|(take, stderr)| thread::spawn(move || pass_errors(BufReader::new(stderr), take)));
        let mut link = Self::new(BufReader::new(stdout), Box::new(stdin), Peer::Process(child), keep_alive);
        link.errors = errors;
        Ok(link)
    }

    /// Says a line; it is not waited for.
    pub(super) fn say(&self, line: String) -> Result<(), LinkError> {
        self.said.try_send(line).map_err(|_| LinkError::Deaf)
    }

    /// The next line, if one comes in time and before the wait `is_over`.
    pub(super) fn hear_unless(
        &self,
        within: Duration,
        is_over: fn() -> bool,
    ) -> Result<Option<String>, LinkError> {
        let due = Instant::now() + within;
        loop {
            let left = due.saturating_duration_since(Instant::now());
            match self.hear(left.min(SLICE))? {
                None if !left.is_zero() && !is_over() => {}
                heard => return Ok(heard),
            }
        }
    }

    /// The next line, if one comes in time.
    pub(super) fn hear(&self, within: Duration) -> Result<Option<String>, LinkError> {
        match self.heard.recv_timeout(within) {
            Ok(line) => line.map(Some),
            Err(RecvTimeoutError::Timeout) => Ok(None),
            Err(RecvTimeoutError::Disconnected) => Err(LinkError::Closed),
        }
    }
}

/// The longest wait without a look at what is due.
pub(super) const SLICE: Duration = Duration::from_millis(50);
/// Grace period for a driver to end by itself after its link is dropped.
const MOMENT: Duration = Duration::from_millis(200);

impl Drop for Link {
    /// A process gets a moment to end by itself.
    fn drop(&mut self) {
        self.end(MOMENT);
    }
}

impl Link {
    /// Says what still waits to be said, closes the connection, and gives a process so long to end by itself.
    /// With its connection closed it has no other way to learn that nobody is there any more.
    pub(super) fn end(&mut self, within: Duration) {
        let due = Instant::now() + within;
        let (closed, _) = sync_channel(1);
        // The speaking thread says what waits; then it ends, and with it the standard input of a process.
        drop(std::mem::replace(&mut self.said, closed));
        wait_for(due, || self.speaker.is_finished());
        match &mut self.peer {
            Peer::Process(child) => {
                let is_over = wait_for(due, || matches!(child.try_wait(), Ok(Some(_))));
                kill_group(child);
                if !is_over {
                    let _ = child.kill();
                    let _ = child.wait();
                }
                // What it has written is passed on, also where it ended by itself.
                let due = Instant::now() + MOMENT;
                wait_for(due, || self.errors.as_ref().is_none_or(JoinHandle::is_finished));
            }
            Peer::Socket(stream) => {
                let _ = stream.shutdown(Shutdown::Both);
            }
            #[cfg(unix)]
            Peer::Stream(stream) => {
                let _ = stream.shutdown(Shutdown::Both);
            }
        }
    }
}

/// Ends all processes of a driver, also those that it has started: behind `sh -c` it is one of them that
/// moves the robot.
#[cfg(unix)]
fn kill_group(child: &Child) {
    use rustix::process::{Pid, Signal, kill_process_group};
    let leader = i32::try_from(child.id()).ok().and_then(Pid::from_raw);
    if let Some(leader) = leader {
        // Mostly nobody is left.
        let _ = kill_process_group(leader, Signal::KILL);
    }
}

#[cfg(not(unix))]
fn kill_group(_child: &Child) {}

/// True if something came true in time.
fn wait_for(due: Instant, mut is_true: impl FnMut() -> bool) -> bool {
    loop {
        if is_true() {
            return true;
        }
        if Instant::now() >= due {
            return false;
        }
        thread::sleep(Duration::from_millis(5));
    }
}

/// Passes the standard error of a driver on, line by line. A line that is too long is cut in two, and what
/// comes too fast is left out, but for the last lines: they tell why a driver has ended.
fn pass_errors(mut reader: impl BufRead, take: ErrorOutput) {
    let (mut rate, mut bytes) = (LineRate::default(), Vec::new());
    let (mut kept, mut left_out) = (VecDeque::new(), 0);
    let catch_up = |kept: &mut VecDeque<Vec<u8>>, left_out: &mut usize| {
        if std::mem::take(left_out) > 0 {
            take("…");
        }
        kept.drain(..).for_each(|line| take(&shown(&line)));
    };
    while let Ok(1..) = reader.by_ref().take(MAX_ERROR_LINE_BYTES).read_until(b'\n', &mut bytes) {
        let line = std::mem::take(&mut bytes);
        if rate.exceeds(MAX_ERROR_LINES_A_SECOND, Instant::now()) {
            kept.push_back(line);
            if kept.len() > MAX_LAST_LINES {
                kept.pop_front();
                left_out += 1;
            }
        } else {
            catch_up(&mut kept, &mut left_out);
            take(&shown(&line));
        }
    }
    catch_up(&mut kept, &mut left_out);
}

/// A line without its end.
fn shown(line: &[u8]) -> String {
    String::from_utf8_lossy(line).trim_end_matches(['\n', '\r']).to_owned()
}

/// Reads lines until there are no more, or one is wrong.
fn listen(
    mut reader: impl BufRead,
    tell: &SyncSender<Result<String, LinkError>>,
    awaits_picture: &AtomicBool,
) {
    loop {
        let line = line(&mut reader, awaits_picture);
        let is_last = line.is_err();
        if tell.send(line).is_err() || is_last {
            return;
        }
    }
}

fn line(reader: &mut impl BufRead, awaits_picture: &AtomicBool) -> Result<String, LinkError> {
    let mut bytes = Vec::new();
    let mut most = MAX_LINE_BYTES;
    read_to(reader, &mut bytes, most)?;
    // Whether a picture is due is asked late: the reader waits for a line before the call is made.
    if bytes.len() > most && !bytes.ends_with(b"\n") && awaits_picture.load(Ordering::SeqCst) {
        most = MAX_LOOK_BYTES;
        read_to(reader, &mut bytes, most)?;
    }
    match bytes.pop() {
        None => Err(LinkError::Closed),
        Some(b'\n') => String::from_utf8(bytes).map_err(|error| {
            let line = String::from_utf8_lossy(error.as_bytes()).chars().take(80).collect();
            LinkError::Nonsense(line, "it is not UTF-8".to_owned())
        }),
        Some(_) if bytes.len() >= most => Err(LinkError::Flood),
        // The end in the middle of a line.
        Some(_) => Err(LinkError::Closed),
    }
}

/// Reads on to the end of the line, or to one byte more than it may have.
fn read_to(reader: &mut impl BufRead, bytes: &mut Vec<u8>, most: usize) -> Result<(), LinkError> {
    let limit = (most + 1).saturating_sub(bytes.len()) as u64;
    let read = reader.by_ref().take(limit).read_until(b'\n', bytes);
    read.map(|_| ()).map_err(|error: io::Error| LinkError::Read(error.to_string()))
}

fn speak(
    mut writer: Box<dyn Write + Send>,
    lines: &Receiver<String>,
    keep_alive: &KeepAlive,
    is_alive: &AtomicBool,
) {
    loop {
        let mut line = match lines.recv_timeout(keep_alive.after) {
            Ok(line) => line,
            Err(RecvTimeoutError::Timeout) if is_alive.load(Ordering::SeqCst) => (keep_alive.line)(),
            Err(RecvTimeoutError::Timeout) => continue,
            Err(RecvTimeoutError::Disconnected) => return,
        };
        line.push('\n');
        if writer.write_all(line.as_bytes()).and_then(|()| writer.flush()).is_err() {
            // The reader notices.
            return;
        }
    }
}

/// Time that began at an instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clock {
    origin: Instant,
    from: Time,
}

impl Clock {
    /// It is `from` now.
    pub(super) fn new(from: Time) -> Self {
        Self { origin: Instant::now(), from }
    }

    pub(super) fn now(&self) -> Time {
        let passed = u64::try_from(self.origin.elapsed().as_nanos()).unwrap_or(u64::MAX);
        self.from.after(Time::from_nanos(passed))
    }

    /// Duration until a time; `None` for [`Time::NEVER`].
    pub(super) fn left(&self, until: Time) -> Option<Duration> {
        (until != Time::NEVER).then(|| Duration::from_nanos(until.since(self.now()).nanos()))
    }
}
