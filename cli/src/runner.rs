//! Runs an engine on a driver, in this process or another: paced by the wall clock, shown by a view,
//! recorded in a journal, stopped by Ctrl-C.

use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use motet::run::Room;
use motet_host::journal::{JournalError, JournalWriter, RunRecorder};
use motet_host::remote::protocol::Hello;
use motet_host::remote::{DriverAddress, DriverTimeouts, RemoteDriver};
use motet_planner::runtime_check::Guard;
use motet_robots::scene::Scene;
use motet_runtime::journal::{JournalHead, OpenGoals};
use motet_runtime::{
    Answer, Detection, Driver, DriverEvent, Effect, Engine, Event, GoalId, Observer, Query, RunControl,
    RunEnd, Time, ToldThing, Verifier, resume,
};

use crate::error::{CliError, Exit};
use crate::flags::Speed;
use crate::output::{escape, note};
use crate::run_view::View;
use crate::typed_line;
use crate::view::live::SharedPage;
use crate::view::onlooker::PageObserver;

/// Interval at which a waiting run checks for an interrupt.
pub(crate) const SLICE: Duration = Duration::from_millis(50);

/// Number of requests to stop: presses of Ctrl-C, SIGTERM, and SIGHUP, which a closed terminal sends.
static REQUESTS: AtomicU32 = AtomicU32::new(0);

/// Commands that may move the robot, by their goals. They stay until the driver has said that they ended or
/// stand still, or the run has given up waiting for that.
static MOVING: Mutex<BTreeMap<GoalId, String>> = Mutex::new(BTreeMap::new());

/// Turns a signal to end into a request to stop. The second one ends the process where nothing can move;
/// otherwise it says what may move, and the process ends with the safe stop.
pub(crate) fn catch_interrupts() -> Result<(), CliError> {
    ctrlc::set_handler(|| {
        if REQUESTS.fetch_add(1, Ordering::SeqCst) == 0 {
            return;
        }
        let moving = moving();
        if moving.is_empty() {
            typed_line::restore();
            std::process::exit(130);
        }
        let commands: Vec<&str> = moving.values().map(String::as_str).collect();
        note(&format!(
            "stopping: these commands may still move the robot: {}. The run ends once the driver has \
             confirmed the stop, or has not answered in time.",
            commands.join(", ")
        ));
    })
    .map_err(|error| CliError::Message(format!("cannot handle Ctrl-C: {error}")))
}

fn moving() -> MutexGuard<'static, BTreeMap<GoalId, String>> {
    MOVING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Keeps in mind what an effect lets move.
fn note_effect(effect: &Effect) {
    match effect {
        Effect::Start { goal, command, .. } => {
            moving().insert(*goal, escape(&command.to_string()));
        }
        Effect::Finished(_) => moving().clear(),
        _ => {}
    }
}

/// Keeps in mind what a run that goes on had let move.
pub(crate) fn note_open(ledger: &OpenGoals) {
    let open = ledger.goals.iter().map(|(goal, open)| (*goal, escape(&open.command.to_string())));
    moving().extend(open);
}

/// Keeps in mind what an event says to stand still.
pub(crate) fn note_event(event: &Event) {
    if let Event::Driver(
        DriverEvent::Ended { goal, .. } | DriverEvent::Refused { goal, .. } | DriverEvent::Stopped { goal },
    ) = event
    {
        moving().remove(goal);
    }
}

/// Is `true` after Ctrl-C and after another signal to end.
pub(crate) fn is_interrupted() -> bool {
    REQUESTS.load(Ordering::SeqCst) > 0
}

/// Observer that shows a run, keeps it in step with the wall clock, and checks deferred motions.
pub(crate) struct PacedView {
    view: Box<dyn View>,
    speed: Speed,
    begun: Option<(Instant, Time)>,
    now: Time,
    guard: Option<Guard>,
    /// The room as the robot knows it, with what it has seen.
    room: Room,
}

impl PacedView {
    /// Observer without a guard.
    pub(crate) fn new(view: Box<dyn View>, speed: Speed) -> Self {
        Self { view, speed, begun: None, now: Time::ZERO, guard: None, room: Room::default() }
    }

    /// The same with a guard, which checks deferred motions.
    pub(crate) fn with_guard(self, guard: Option<Guard>) -> Self {
        Self { guard, ..self }
    }

    /// The same in a room that changes by what the driver detects.
    pub(crate) fn with_room(self, scene: Option<Scene>) -> Self {
        Self { room: Room::new(scene), ..self }
    }

    /// Takes effects from before this process began.
    pub(crate) fn past(&mut self, now: Time, effects: &[Effect]) {
        self.now = now;
        effects.iter().for_each(|effect| self.view.past(now, effect));
    }

    /// Time that the run has reached.
    pub(crate) const fn now(&self) -> Time {
        self.now
    }

    /// Lets the view go on below what was printed meanwhile.
    pub(crate) fn go_below(&mut self) {
        self.view.go_below();
    }

    /// Ends the view, since another one shows the policy that takes over.
    pub(crate) fn leave(&mut self, now: Time) {
        self.view.leave(now);
    }

    /// Takes an effect of the policy after it was replaced.
    pub(crate) fn late(&mut self, now: Time, effect: &Effect) {
        self.view.late(now, effect);
    }

    /// Prints how the run ended.
    pub(crate) fn finish(&mut self, end: &RunEnd) {
        self.view.finish(self.now, end);
    }

    /// Waits until the wall clock has reached a time of the run.
    fn wait(&mut self, now: Time) {
        let Speed::Times(factor) = self.speed else { return };
        let (begun, origin) = *self.begun.get_or_insert_with(|| (Instant::now(), now));
        let due = Duration::try_from_secs_f64(now.since(origin).secs() / factor).unwrap_or(Duration::MAX);
        while let Some(left) = due.checked_sub(begun.elapsed()).filter(|left| !left.is_zero()) {
            if is_interrupted() {
                return;
            }
            thread::sleep(left.min(SLICE));
        }
    }
}

impl Observer for PacedView {
    fn event(&mut self, _now: Time, event: &Event) {
        note_event(event);
        self.view.event(event);
    }

    fn effect(&mut self, now: Time, effect: &Effect) {
        note_effect(effect);
        self.now = now;
        if self.begun.is_none() {
            self.begun = Some((Instant::now(), now));
        }
        self.view.effect(now, effect);
    }

    fn reached(&mut self, now: Time) -> RunControl {
        self.now = now;
        self.wait(now);
        self.view.reached(now);
        // A run stops once nobody watches it.
        if is_interrupted() || self.view.is_closed() { RunControl::Stop } else { RunControl::Continue }
    }

    fn detected(&mut self, _now: Time, seen: &[Detection], engine: &Engine) -> Vec<(Query, Answer)> {
        self.room.detected(seen, engine, self.guard.as_mut())
    }

    fn tell(&mut self) -> Option<ToldThing> {
        self.room.tell()
    }

    fn verifier(&mut self) -> Option<&mut dyn Verifier> {
        let guard: &mut dyn Verifier = self.guard.as_mut()?;
        Some(guard)
    }

    fn at_least_every(&self) -> Time {
        match self.speed {
            Speed::Max => Time::NEVER,
            Speed::Times(factor) => Time::from_secs(0.1 * factor),
        }
    }
}

/// Run that is ready to start or to resume.
pub(crate) struct Runner<'a> {
    pub(crate) engine: Engine,
    pub(crate) driver: &'a mut dyn Driver,
    pub(crate) journal: Option<JournalWriter>,
    /// Present time of the driver.
    pub(crate) from: Time,
    /// First events of the engine.
    pub(crate) events: Vec<Event>,
}

/// Start of a run for its page: a head, or the number of the next entry where it goes on.
pub(crate) enum Beginning {
    Head(Box<JournalHead>),
    Entry(u64),
}

impl Runner<'_> {
    /// Runs to the end.
    pub(crate) fn run(
        mut self,
        mut paced: PacedView,
        page: Option<(SharedPage, Beginning)>,
    ) -> Result<Exit, CliError> {
        catch_interrupts()?;
        let shared = page.as_ref().map(|(page, _)| Rc::clone(page));
        let mut shown;
        let onlooker: &mut dyn Observer = match page {
            None => &mut paced,
            Some((page, beginning)) => {
                shown = match beginning {
                    Beginning::Head(head) => PageObserver::new(page, &mut paced, *head),
                    Beginning::Entry(seq) => PageObserver::resumed(page, &mut paced, seq),
                };
                &mut shown
            }
        };
        let end = match self.journal {
            None => resume(&mut self.engine, self.driver, onlooker, self.from, self.events),
            Some(writer) => {
                let mut recorder = RunRecorder::new(writer, onlooker);
                let end = resume(&mut self.engine, self.driver, &mut recorder, self.from, self.events);
                recorder.finish().map_err(journal_error)?;
                end
            }
        };
        paced.finish(&end);
        shared.iter().for_each(|page| page.borrow_mut().finish());
        Ok(exit_of(&end))
    }
}

/// Exit code for the end of a run.
pub(crate) const fn exit_of(end: &RunEnd) -> Exit {
    match end {
        RunEnd::Done { .. } => Exit::Success,
        RunEnd::Failed { .. } | RunEnd::Declined { .. } | RunEnd::Replan { .. } => Exit::Failed,
        RunEnd::Fault(_) => Exit::Failed,
        RunEnd::Interrupted => Exit::Interrupted,
    }
}

/// Error of reading or writing a journal.
pub(crate) fn journal_error(error: JournalError) -> CliError {
    CliError::Message(error.to_string())
}

/// Starts a driver process, or connects to it.
pub(crate) fn connect(address: &DriverAddress, hello: Hello, from: Time) -> Result<RemoteDriver, CliError> {
    let log = |text: &str| note(&format!("driver: {}", escape(text)));
    RemoteDriver::connect(address.clone(), hello, DriverTimeouts::default(), from, Box::new(log))
        .map_err(|breakage| CliError::Message(format!("{} ({address})", escape(&breakage.to_string()))))
}
