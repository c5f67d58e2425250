//! Hub of a page: the items that every page gets, in order, and the words and wishes of its operator.
//!
//! The run writes, the server reads, on threads of their own. Items stay, so that a page which connects late
//! or again gets all of them.

use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use motet_runtime::{CameraImage, RunControl, Time};
use serde_json::{Value, json};
use tokio::sync::watch;

use crate::swap_checker::{Offer, SwapResult};

/// Bytes of items after which a page gets no more of them.
const MOST_BYTES: usize = 512 * 1024 * 1024;
/// Shortest span between two kept reports of motion.
const MOTION_EVERY: Time = Time::from_nanos(90_000_000);
/// Number of kept reports of motion after which their span doubles, again and again.
const MOTIONS: u64 = 10_000;
/// Time for which a page that has asked for a picture shows it.
const PICTURE_WANTED: Duration = Duration::from_secs(3);
/// Shortest time between two pictures.
const PICTURE_EVERY: Duration = Duration::from_millis(400);

/// Item of a page.
#[derive(Clone, Debug)]
pub(crate) struct Item {
    /// Number of the run and of the journal's entry, such as `1-17`; absent for a report of motion.
    pub(crate) id: Option<Arc<str>>,
    pub(crate) json: Arc<str>,
}

/// Wishes and words of the page's operator.
#[derive(Debug, Default)]
struct Operator {
    /// Receiver of typed lines; `None` where the run takes none.
    lines: Option<Sender<String>>,
    /// Question that waits for a line.
    question: Option<String>,
    /// Desk of policies that are to take over; `None` where the run has none.
    desk: Option<Sender<Offer>>,
    is_stopped: bool,
    is_held: bool,
    wish: Option<RunControl>,
}

/// Motion reports that were kept.
#[derive(Debug, Default)]
struct Motions {
    kept: u64,
    last: Option<Time>,
}

/// Reason for which a line is not taken.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum NotTaken {
    /// Nobody reads lines in this run.
    Nobody,
    /// The question is answered, or is another one.
    Answered,
}

/// Hub of a page.
#[derive(Debug)]
pub(crate) struct Hub {
    items: Mutex<(Vec<Item>, usize)>,
    count: watch::Sender<usize>,
    operator: Mutex<Operator>,
    motions: Mutex<Motions>,
    /// Picture of the robot's camera.
    pub(crate) sight: Sight,
}

/// Picture of the robot's camera, which is taken only while a page shows it.
#[derive(Debug, Default)]
pub(crate) struct Sight(Mutex<SightState>);

#[derive(Debug, Default)]
struct SightState {
    wanted: Option<Instant>,
    taken: Option<Instant>,
    image: Option<CameraImage>,
}

impl Sight {
    /// Latest picture. Asked again and again, it is taken again and again.
    pub(crate) fn want(&self) -> Option<CameraImage> {
        let mut state = locked(&self.0);
        state.wanted = Some(Instant::now());
        state.image.clone()
    }

    /// Is `true` if a page waits for a picture, and the last one was taken a while ago.
    pub(crate) fn is_due(&self) -> bool {
        let state = locked(&self.0);
        let is_wanted = state.wanted.is_some_and(|wanted| wanted.elapsed() < PICTURE_WANTED);
        is_wanted && state.taken.is_none_or(|taken| taken.elapsed() > PICTURE_EVERY)
    }

    /// Takes in a picture, or that there is none.
    pub(crate) fn take(&self, image: Option<CameraImage>) {
        let mut state = locked(&self.0);
        (state.taken, state.image) = (Some(Instant::now()), image);
    }
}

impl Default for Hub {
    fn default() -> Self {
        let (count, _) = watch::channel(0);
        let (operator, motions, sight) = Default::default();
        Self { items: Mutex::default(), count, operator, motions, sight }
    }
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Hub {
    /// Adds an item. Items beyond the limit are left out, and the last one says so.
    pub(crate) fn push(&self, id: &str, item: &Value) {
        self.add(Some(id), item.to_string());
    }

    fn add(&self, id: Option<&str>, json: String) {
        let mut items = locked(&self.items);
        let (list, bytes) = &mut *items;
        if *bytes > MOST_BYTES {
            return;
        }
        *bytes += json.len();
        let json = if *bytes > MOST_BYTES { json!({"t": "full"}).to_string() } else { json };
        list.push(Item { id: id.map(Into::into), json: json.into() });
        let count = list.len();
        drop(items);
        self.count.send_replace(count);
    }

    /// Tells if a report of motion at a time is wanted: not so often that they fill the memory.
    pub(crate) fn wants_motion(&self, at: Time) -> bool {
        let mut motions = locked(&self.motions);
        let doubled = u32::try_from(motions.kept / MOTIONS).unwrap_or(u32::MAX).min(20);
        let every = Time::from_nanos(MOTION_EVERY.nanos() << doubled);
        // A later run may begin at time 0 again.
        let is_due = motions.last.is_none_or(|last| at >= last.after(every) || at < last);
        if is_due {
            motions.last = Some(at);
            motions.kept += 1;
        }
        is_due
    }

    /// Adds a report of motion.
    pub(crate) fn moved(&self, item: &Value) {
        self.add(None, item.to_string());
    }

    /// Items from a position on, at most so many.
    pub(crate) fn from(&self, position: usize, most: usize) -> Vec<Item> {
        locked(&self.items).0.iter().skip(position).take(most).cloned().collect()
    }

    /// Every item so far, in order.
    pub(crate) fn all(&self) -> Vec<Item> {
        self.from(0, usize::MAX)
    }

    /// Position after the item with an id; the beginning for an id that is not there.
    pub(crate) fn after(&self, id: &str) -> usize {
        let is_it = |item: &Item| item.id.as_deref() == Some(id);
        locked(&self.items).0.iter().rposition(is_it).map_or(0, |found| found + 1)
    }

    /// Signal of new items.
    pub(crate) fn news(&self) -> watch::Receiver<usize> {
        self.count.subscribe()
    }

    /// Sends lines of the page to the run from now on.
    pub(crate) fn take_lines(&self, lines: Sender<String>) {
        locked(&self.operator).lines = Some(lines);
    }

    /// Gives a line to the run.
    pub(crate) fn say(&self, line: String) -> Result<(), NotTaken> {
        let operator = locked(&self.operator);
        let lines = operator.lines.as_ref().ok_or(NotTaken::Nobody)?;
        lines.send(line).map_err(|_| NotTaken::Nobody)
    }

    /// Notes the question that waits for a line, or that none does.
    pub(crate) fn ask(&self, question: Option<&str>) {
        locked(&self.operator).question = question.map(ToOwned::to_owned);
    }

    /// Gives the answer to a question to the run: once.
    pub(crate) fn answer(&self, question: &str, line: String) -> Result<(), NotTaken> {
        let mut operator = locked(&self.operator);
        if operator.question.as_deref() != Some(question) {
            return Err(NotTaken::Answered);
        }
        let lines = operator.lines.as_ref().ok_or(NotTaken::Nobody)?;
        lines.send(line).map_err(|_| NotTaken::Nobody)?;
        operator.question = None;
        Ok(())
    }

    /// Sends policies that are to take over to a desk from now on.
    pub(crate) fn take_offers(&self, desk: Sender<Offer>) {
        locked(&self.operator).desk = Some(desk);
    }

    /// Offers a policy that is to take over until some time; what becomes of it arrives in the receiver.
    pub(crate) fn offer(&self, policy: String, until: Instant) -> Result<Receiver<SwapResult>, NotTaken> {
        let (reply, result) = channel();
        let operator = locked(&self.operator);
        let desk = operator.desk.as_ref().ok_or(NotTaken::Nobody)?;
        desk.send(Offer { policy, reply, until }).map_err(|_| NotTaken::Nobody)?;
        Ok(result)
    }

    /// Stops the run, holds it, or lets it go on.
    pub(crate) fn control(&self, wish: RunControl) {
        let mut operator = locked(&self.operator);
        operator.is_stopped |= wish == RunControl::Stop;
        operator.wish = Some(wish);
    }

    /// Is `true` once the page's operator wants the run to stop.
    pub(crate) fn is_stopped(&self) -> bool {
        locked(&self.operator).is_stopped
    }

    /// Is `true` while the page's operator holds the run.
    pub(crate) fn is_held(&self) -> bool {
        locked(&self.operator).is_held
    }

    /// Forgets the wishes of the run before.
    pub(crate) fn begin(&self) {
        let mut operator = locked(&self.operator);
        (operator.is_stopped, operator.is_held, operator.wish) = (false, false, None);
    }

    /// Wish of the page's operator that the run has not heard. A wish to stop stays.
    pub(crate) fn wish(&self) -> RunControl {
        let mut operator = locked(&self.operator);
        if operator.is_stopped {
            return RunControl::Stop;
        }
        let wish = operator.wish.take().unwrap_or(RunControl::Continue);
        match wish {
            RunControl::Hold => operator.is_held = true,
            RunControl::Proceed | RunControl::Stop => operator.is_held = false,
            RunControl::Continue => {}
        }
        wish
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;

    use motet_runtime::{RunControl, Time};
    use serde_json::json;

    use super::{Hub, MOTIONS, NotTaken};

    #[test]
    fn hub_gives_what_follows_an_id() {
        let hub = Hub::default();
        for number in 0..3 {
            hub.push(&format!("1-{number}"), &json!(number));
            hub.moved(&json!({"t": "moved"}));
        }
        let ids = |from: &str| hub.from(hub.after(from), 9).into_iter().filter_map(|item| item.id).count();
        assert_eq!(["1-0", "1-2", "9-9", ""].map(ids), [2, 0, 3, 3]);
        assert_eq!(*hub.news().borrow(), 6);
    }

    #[test]
    fn hub_takes_an_answer_once_and_for_its_question() {
        let hub = Hub::default();
        assert_eq!(hub.say("hello".to_owned()), Err(NotTaken::Nobody));
        let (lines, typed) = channel();
        hub.take_lines(lines);
        hub.ask(Some("1"));
        assert_eq!(hub.answer("2", "no".to_owned()), Err(NotTaken::Answered));
        assert_eq!(hub.answer("1", "yes".to_owned()), Ok(()));
        assert_eq!(hub.answer("1", "again".to_owned()), Err(NotTaken::Answered));
        assert_eq!(typed.try_iter().collect::<Vec<_>>(), ["yes"]);
    }

    #[test]
    fn hub_keeps_a_stop_until_the_next_run() {
        let hub = Hub::default();
        hub.control(RunControl::Hold);
        assert_eq!((hub.wish(), hub.wish(), hub.is_held()), (RunControl::Hold, RunControl::Continue, true));
        hub.control(RunControl::Stop);
        hub.control(RunControl::Proceed);
        assert_eq!([hub.wish(), hub.wish()], [RunControl::Stop; 2]);
        hub.begin();
        assert_eq!((hub.wish(), hub.is_held(), hub.is_stopped()), (RunControl::Continue, false, false));
    }

    #[test]
    fn hub_thins_motion_of_a_long_run() {
        let hub = Hub::default();
        let kept =
            |secs: u64| (0..secs * 10).filter(|at| hub.wants_motion(Time::from_secs(*at as f64 / 10.0)));
        let day = kept(24 * 3600).count() as u64;
        assert!(day > MOTIONS && day < 8 * MOTIONS, "{day}");
    }
}
