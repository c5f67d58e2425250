//! Runs an engine on a driver, in this process or another: paced by the wall clock, shown by a view,
//! recorded in a journal, stopped by Ctrl-C.

use std::rc::Rc;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use motet::run::ObservedScene;
use motet_graph::Graph;
use motet_host::journal::{JournalWriter, RunRecorder};
use motet_planner::runtime_check::Guard;
use motet_robots::scene::Scene;
use motet_runtime::journal::JournalHead;
use motet_runtime::{
    Answer, Detection, Driver, Effect, Engine, Event, Observer, PreparedSwap, Query, RetiredGraph,
    RunControl, RunEnd, SwapRefusal, Time, ToldThing, Verifier, resume,
};

use crate::error::{CliError, Exit, journal_error};
use crate::flags::Speed;
use crate::interrupt::{SLICE, guard_runs, is_interrupted, note_effect, note_event};
use crate::output::note;
use crate::output::queue::WhenFull;
use crate::run_view::{SpokenControl, View};
use crate::swap_checker::SwapChecker;
use crate::view::live::SharedPage;
use crate::view::onlooker::PageObserver;

/// Observer that shows a run, keeps it in step with the wall clock, and checks deferred motions.
pub(crate) struct PacedView {
    view: Box<dyn View>,
    speed: Speed,
    begun: Option<(Instant, Time)>,
    now: Time,
    guard: Option<Guard>,
    /// The room as the robot knows it, with what it has seen.
    room: ObservedScene,
    /// Words of a person.
    words: Option<Box<dyn SpokenControl>>,
    /// Desk of policies that are to take over, with the view of one that does.
    desk: Option<(SwapChecker, ViewOf)>,
}

/// Maker of the view of a graph.
pub(crate) type ViewOf = Box<dyn Fn(&Graph) -> Box<dyn View>>;

impl PacedView {
    /// Observer without a guard.
    pub(crate) fn new(view: Box<dyn View>, speed: Speed) -> Self {
        Self {
            view,
            speed,
            begun: None,
            now: Time::ZERO,
            guard: None,
            room: ObservedScene::default(),
            words: None,
            desk: None,
        }
    }

    /// The same with a guard, which checks deferred motions.
    pub(crate) fn with_guard(self, guard: Option<Guard>) -> Self {
        Self { guard, ..self }
    }

    /// The same with words of a person.
    pub(crate) fn with_words(self, words: Option<Box<dyn SpokenControl>>) -> Self {
        Self { words, ..self }
    }

    /// The same with a desk of policies that are to take over.
    pub(crate) fn with_desk(self, desk: Option<SwapChecker>, view_of: ViewOf) -> Self {
        Self { desk: desk.map(|desk| (desk, view_of)), ..self }
    }

    /// The same in a room that changes by what the driver detects.
    pub(crate) fn with_room(self, scene: Option<Scene>) -> Self {
        Self { room: ObservedScene::new(scene), ..self }
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
        if is_interrupted() || self.view.is_closed() {
            return RunControl::Stop;
        }
        let said = self.words.as_mut().and_then(|words| words.control(now));
        said.iter().for_each(|_| self.view.go_below());
        said.unwrap_or(RunControl::Continue)
    }

    fn detected(&mut self, _now: Time, seen: &[Detection], engine: &Engine) -> Vec<(Query, Answer)> {
        self.room.detected(seen, engine, self.guard.as_mut())
    }

    fn tell(&mut self) -> Option<ToldThing> {
        self.room.tell()
    }

    fn verifier(&mut self) -> Option<&mut dyn Verifier> {
        self.guard.as_mut().map(|guard| guard as &mut dyn Verifier)
    }

    fn swap(&mut self, _now: Time, engine: &Engine) -> Option<PreparedSwap> {
        self.desk.as_mut()?.0.swap(engine)
    }

    fn swapped(&mut self, now: Time, graph: &Arc<Graph>, result: Result<RetiredGraph, SwapRefusal>) {
        let Some((desk, view_of)) = &mut self.desk else { return };
        desk.swapped(graph, &result);
        if result.is_ok() {
            self.view.leave(now);
            self.view = view_of(graph);
        }
    }

    fn at_least_every(&self) -> Time {
        let words = self.words.as_ref().map_or(Time::NEVER, |words| words.at_least_every());
        match self.speed {
            Speed::Max => words,
            Speed::Times(factor) => words.min(Time::from_secs(0.1 * factor)),
        }
    }

    fn glance_every(&self) -> Time {
        match (&self.desk, self.speed) {
            (None, _) => Time::NEVER,
            (Some(_), Speed::Max) => Time::from_secs(1.0),
            (Some((desk, _)), Speed::Times(factor)) => Time::from_secs(desk.glance_every().secs() * factor),
        }
    }
}

/// Run that is ready to start or to resume.
pub(crate) struct Runner<'a> {
    pub(crate) engine: Engine,
    pub(crate) driver: &'a mut dyn Driver,
    pub(crate) journal: Option<JournalWriter>,
    /// `true` if the run can be simulated again, so that its motion need not be written down.
    pub(crate) is_simulated: bool,
    /// `true` if a person stopped the run before it was resumed.
    pub(crate) was_stopped: bool,
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
        guard_runs(if self.is_simulated { WhenFull::Wait } else { WhenFull::GoOn })?;
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
                let recorder = RunRecorder::new(writer, onlooker);
                let mut recorder = if self.is_simulated { recorder } else { recorder.with_motion() };
                let end = resume(&mut self.engine, self.driver, &mut recorder, self.from, self.events);
                recorder.finish().map_err(journal_error)?;
                end
            }
        };
        paced.finish(&end);
        shared.iter().for_each(|page| page.borrow_mut().finish());
        if end == RunEnd::Interrupted && paced.words.as_ref().is_some_and(|words| words.is_stopped()) {
            return Ok(Exit::Failed);
        }
        let by_page = shared.as_ref().is_some_and(|page| page.borrow().hub().is_stopped());
        let is_asked = self.was_stopped || is_interrupted() || paced.view.is_closed() || by_page;
        if end == RunEnd::Interrupted && !is_asked {
            note("the driver ended a step as interrupted, although nobody had asked for that");
            return Ok(Exit::Failed);
        }
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
