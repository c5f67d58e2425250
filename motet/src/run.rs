//! Runs of checked policies: the engine, the journal, and the checks of deferred motions.
//!
//! [`Motet::run`](crate::Motet::run) covers most embedders. These parts serve hosts that pace a run, show
//! it, write a journal or resume one, as the `motet` command does.

use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use motet_graph::Graph;
use motet_host::journal::JournalWriter;
use motet_planner::runtime_check::{Guard, WITHIN};
use motet_project::SavedDriver;
use motet_robots::scene::Scene;
use motet_runtime::journal::JournalHead;
use motet_runtime::{
    Answer, Capabilities, Detection, Effect, Engine, EngineSettings, Event, Heard, Moved, Observer, Query,
    RunControl, StartState, Time, ToldThing, Verifier,
};

use crate::Error;

/// Entities that the engine knows at the start besides those in the graph: all of the scene.
#[must_use]
pub fn start_state(scene: Option<&Scene>) -> StartState {
    let entities = scene.iter().flat_map(|scene| &scene.entities);
    StartState {
        entities: entities.map(|(id, entity)| (id.clone(), entity.kind.clone())).collect(),
        ..StartState::default()
    }
}

/// Engine for a compiled graph and a driver with these capabilities. With a guard, the engine asks for a
/// verdict on every motion that the compiler deferred.
///
/// # Errors
///
/// [`Error::Graph`] if the graph is not valid; a graph of the compiler always is.
pub fn engine(
    graph: Graph,
    start: &StartState,
    capabilities: Capabilities,
    guard: Option<&Guard>,
    settings: EngineSettings,
) -> Result<Engine, Error> {
    let engine = Engine::new(graph, start).map_err(Error::Graph)?;
    let settings = EngineSettings { verify_within: guard.map(|_| WITHIN), ..settings };
    Ok(engine.with_capabilities(capabilities).with_settings(settings))
}

/// Creates the journal of a run of this id that begins now, in a folder that is empty or does not exist.
///
/// # Errors
///
/// The folder cannot be written to, or holds a journal.
pub fn create_journal(
    folder: &Path,
    run: &str,
    (engine, start): (&Engine, &StartState),
    driver: &SavedDriver,
) -> Result<JournalWriter, Error> {
    let head = JournalHead { driver: driver.to_json()?, ..journal_head(run, engine, start) };
    Ok(JournalWriter::create(folder, head)?)
}

/// Head of the journal of a run of this id that begins now, at time 0, without a description of the driver.
#[must_use]
pub fn journal_head(run: &str, engine: &Engine, start: &StartState) -> JournalHead {
    JournalHead {
        run: run.to_owned(),
        began_unix_ns: unix_ns(),
        start: start.clone(),
        settings: *engine.settings(),
        capabilities: engine.capabilities().clone(),
        ..JournalHead::new(engine.graph())
    }
}

/// New id for a run: another one for every run of this machine.
#[must_use]
pub fn run_id() -> String {
    format!("{:x}-{:x}", unix_ns(), std::process::id())
}

/// Wall clock, in ns since 1970.
#[must_use]
pub fn unix_ns() -> u64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    since.map_or(0, |since| u64::try_from(since.as_nanos()).unwrap_or(u64::MAX))
}

/// Observer that adds a guard to another observer.
pub struct Guarded<'a> {
    observer: &'a mut dyn Observer,
    guard: Option<Guard>,
}

impl<'a> Guarded<'a> {
    /// Observer with a guard; without one, deferred motions are left to the driver.
    pub fn new(observer: &'a mut dyn Observer, guard: Option<Guard>) -> Self {
        Self { observer, guard }
    }
}

impl Observer for Guarded<'_> {
    fn event(&mut self, now: Time, event: &Event) {
        self.observer.event(now, event);
    }

    fn commit(&mut self, now: Time, effects: &[Effect]) -> RunControl {
        self.observer.commit(now, effects)
    }

    fn effect(&mut self, now: Time, effect: &Effect) {
        self.observer.effect(now, effect);
    }

    fn reached(&mut self, now: Time) -> RunControl {
        self.observer.reached(now)
    }

    fn wants_telemetry(&self) -> bool {
        self.observer.wants_telemetry()
    }

    fn moved(&mut self, moved: &Moved) {
        self.observer.moved(moved);
    }

    fn detected(&mut self, now: Time, seen: &[Detection], engine: &Engine) -> Vec<(Query, Answer)> {
        self.observer.detected(now, seen, engine)
    }

    fn tell(&mut self) -> Option<ToldThing> {
        self.observer.tell()
    }

    fn heard(&mut self, now: Time, heard: &Heard) {
        self.observer.heard(now, heard);
    }

    fn verifier(&mut self) -> Option<&mut dyn Verifier> {
        let guard: &mut dyn Verifier = self.guard.as_mut()?;
        Some(guard)
    }

    fn at_least_every(&self) -> Time {
        self.observer.at_least_every()
    }
}
