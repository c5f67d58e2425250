//! Runs for programs: events as lines of JSON, and the journal in memory.

use std::path::Path;
use std::sync::Arc;

use motet_graph::Graph;
use motet_host::journal::RunRecorder;
use motet_planner::runtime_check::{CheckMode, Guard};
use motet_project::{ProjectSession, SavedDriver};
use motet_runtime::journal::{JournalEntry, StepEntry};
use motet_runtime::{
    Answer, Detection, Driver, Effect, Engine, EngineSettings, Event, Observer, Query, RunControl, RunEnd,
    StartState, Time, ToldThing, Verifier,
};

use super::events::RunEvents;
use super::{ObservedScene, create_journal, engine, journal_head, start_state};
use crate::Error;

/// Run that is over.
#[derive(Clone, Debug)]
pub struct RecordedRun {
    /// Events as `motet run --format json` prints them, one JSON object each; the last says how the run
    /// ended.
    pub events: Vec<String>,
    /// Entries of the journal, for [`crate::replay::JournalPlayer`].
    pub journal: Vec<JournalEntry>,
    pub end: RunEnd,
    /// Time of the last effect.
    pub at: Time,
}

/// Run that is ready to start.
#[derive(Clone, Copy, Debug)]
pub struct RunPlan<'a> {
    pub opened: &'a ProjectSession,
    pub graph: &'a Graph,
    /// Id of the run, as its driver hears it.
    pub run: &'a str,
    /// Schedule of the checks of deferred motions.
    pub verifies: CheckMode,
    /// Time limits and budgets of the engine.
    pub settings: EngineSettings,
    /// Folder of a journal on disk, which must be empty or not exist, and the description of the driver; one
    /// without a description can be replayed but not resumed.
    pub record: Option<(&'a Path, Option<&'a SavedDriver>)>,
    /// Longest time without a call of `control`.
    pub looks_every: Time,
}

/// Runs a policy to its end on a driver whose run begins at time 0. `control` is asked at every time that the
/// run reaches.
///
/// # Errors
///
/// [`Error::Graph`], never for a graph of the session; [`Error::Lacking`]; [`Error::Journal`].
pub fn recorded(
    plan: &RunPlan<'_>,
    driver: &mut dyn Driver,
    control: &mut dyn FnMut() -> RunControl,
) -> Result<RecordedRun, Error> {
    let RunPlan { opened, graph, run, verifies, settings, record, looks_every } = *plan;
    let start = start_state(opened.scene.as_ref());
    let guard = opened.session.world_tracker().map(|course| Guard::new(course, verifies));
    let mut engine = engine(graph.clone(), &start, driver.capabilities(), guard.as_ref(), settings)?;
    let mut recorder = Recorder {
        events: RunEvents::new(Arc::new(graph.clone())),
        lines: Vec::new(),
        journal: vec![first_entry(run, &engine, &start)],
        event: None,
        at: Time::ZERO,
        room: ObservedScene::new(opened.scene.clone()),
        guard,
        control,
        looks_every,
    };
    let end = match record {
        None => motet_runtime::run(&mut engine, driver, &mut recorder, Time::ZERO),
        Some((folder, saved)) => {
            let writer = create_journal(folder, run, (&engine, &start), saved)?;
            let mut writes = RunRecorder::new(writer, &mut recorder);
            let end = motet_runtime::run(&mut engine, driver, &mut writes, Time::ZERO);
            writes.finish()?;
            end
        }
    };
    recorder.lines.push(recorder.events.finish(recorder.at, &end));
    Ok(RecordedRun { events: recorder.lines, journal: recorder.journal, end, at: recorder.at })
}

fn first_entry(run: &str, engine: &Engine, start: &StartState) -> JournalEntry {
    JournalEntry::Head(Box::new(journal_head(run, engine, start)))
}

/// Observer that keeps all that happens.
struct Recorder<'a> {
    events: RunEvents,
    lines: Vec<String>,
    journal: Vec<JournalEntry>,
    /// Event that the engine handles.
    event: Option<Event>,
    at: Time,
    room: ObservedScene,
    guard: Option<Guard>,
    control: &'a mut dyn FnMut() -> RunControl,
    looks_every: Time,
}

impl Observer for Recorder<'_> {
    fn event(&mut self, _now: Time, event: &Event) {
        self.events.event(event);
        self.event = Some(event.clone());
    }

    fn commit(&mut self, now: Time, effects: &[Effect]) -> RunControl {
        let step = StepEntry { at: now, event: self.event.take(), effects: effects.to_vec() };
        let entry = match step.event {
            Some(_) => JournalEntry::Step(step),
            None => JournalEntry::GaveUp(step),
        };
        self.journal.push(entry);
        RunControl::Continue
    }

    fn effect(&mut self, now: Time, effect: &Effect) {
        self.at = now;
        self.lines.extend(self.events.effect(now, effect));
    }

    fn reached(&mut self, now: Time) -> RunControl {
        self.at = now;
        (self.control)()
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

    fn at_least_every(&self) -> Time {
        self.looks_every
    }
}
