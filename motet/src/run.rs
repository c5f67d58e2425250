//! Runs of checked policies: the engine, the journal, and the checks of deferred motions.
//!
//! [`Motet::run`](crate::Motet::run) covers most embedders. These parts serve hosts that pace a run, show
//! it, write a journal or resume one, as the `motet` command does.

pub mod events;
mod observed_scene;
mod recorded;

use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use motet_graph::{Graph, Pose, Value};
use motet_host::journal::JournalWriter;
use motet_host::remote::DriverTimeouts;
use motet_host::remote::protocol::StateFact;
use motet_planner::runtime_check::{Guard, WITHIN};
use motet_project::{ProjectSession, SavedDriver, SavedProject, SimulationInputs};
use motet_robots::quaternion::from_rpy;
use motet_robots::scene::{Grip, Placement, Scene};
use motet_runtime::journal::JournalHead;
use motet_runtime::{
    Capabilities, Effect, Engine, EngineSettings, Observer, Query, RunControl, StartState, Time, Truth,
    Verifier,
};
use motet_sim::Sim;
use motet_stdlib::lang::GRIP;
use motet_syntax::ast::File;

use crate::Error;

pub use observed_scene::ObservedScene;
pub use recorded::{RecordedRun, RunPlan, recorded};

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
/// [`Error::Graph`] if the graph is not valid; a graph of the compiler always is. [`Error::Lacking`] if it
/// calls primitives that the driver does not have.
pub fn engine(
    graph: Graph,
    start: &StartState,
    capabilities: Capabilities,
    guard: Option<&Guard>,
    settings: EngineSettings,
) -> Result<Engine, Error> {
    let engine = Engine::new(graph, start).map_err(Error::Graph)?;
    let missing = capabilities.missing(engine.graph());
    if !missing.is_empty() {
        return Err(Error::Lacking(missing));
    }
    let settings = EngineSettings { verify_within: guard.map(|_| WITHIN), ..settings };
    Ok(engine.with_capabilities(capabilities).with_settings(settings))
}

/// Creates the journal of a run of this id that begins now, in a folder that is empty or does not exist. A
/// run without a description of its driver can be replayed but not resumed.
///
/// # Errors
///
/// The folder cannot be written to, or holds a journal.
pub fn create_journal(
    folder: &Path,
    run: &str,
    (engine, start): (&Engine, &StartState),
    driver: Option<&SavedDriver>,
) -> Result<JournalWriter, Error> {
    let driver = driver.map_or(Ok(serde_json::Value::Null), SavedDriver::to_json)?;
    let head = JournalHead { driver, ..journal_head(run, engine, start) };
    Ok(JournalWriter::create(folder, head)?)
}

/// Simulator for a compiled policy in a project, and its description for a journal.
///
/// # Errors
///
/// [`Error::NoRobot`], and [`Error::Project`] for a fault with an unknown name.
pub fn simulator(
    opened: &ProjectSession,
    (graph, document): (&Graph, &File),
    inputs: SimulationInputs,
) -> Result<(Sim, SavedDriver), Error> {
    let (Some(robot), Some(files)) = (&opened.robot, &opened.files) else { return Err(Error::NoRobot) };
    inputs.check_names(&opened.session.signatures())?;
    let declarations: Vec<_> = opened.domains.iter().chain([document]).collect();
    let options = inputs.for_policy(graph, &declarations).with_facts(opened.told_facts());
    let (text, project) = (opened.scene_text.clone(), SavedProject::of(opened));
    let saved = SavedDriver::simulator(files, text, &options, project);
    let scene = opened.scene.clone().unwrap_or_default();
    Ok((Sim::new(robot, &scene, options), saved))
}

/// Facts that a driver hears at the beginning of a run: those that the state says beside or against the
/// scene.
#[must_use]
pub fn state_facts(opened: &ProjectSession) -> Vec<StateFact> {
    let known = opened.told_facts().into_iter().filter_map(|(query, truth)| match truth {
        Truth::True => Some(StateFact { query, holds: true, value: None }),
        Truth::False => Some(StateFact { query, holds: false, value: None }),
        Truth::Unknown => None,
    });
    let grip = opened.session.initial_grip().map(|Grip { of, tip_from_object: Placement { xyz, rpy } }| {
        let value = Some(Value::Pose(Pose { xyz: *xyz, quaternion: from_rpy(*rpy) }));
        StateFact { query: Query::Field { entity: of.clone(), field: GRIP.into() }, holds: true, value }
    });
    known.chain(grip).collect()
}

/// Settings of an engine whose driver may have to be reached again: a safe stop may take as long as that.
#[must_use]
pub fn remote_settings() -> EngineSettings {
    let recovery = u64::try_from(DriverTimeouts::default().recovery().as_nanos()).unwrap_or(u64::MAX);
    EngineSettings { safe_stop_within: Time::from_nanos(recovery), ..EngineSettings::default() }
}

/// Head of the journal of a run of this id that begins now, at time 0, without a description of the driver.
#[must_use]
pub fn journal_head(run: &str, engine: &Engine, start: &StartState) -> JournalHead {
    JournalHead { began_unix_ns: unix_ns(), ..undated_head(run, engine, start) }
}

/// The same for a run of which nobody asks when it began: no clock is read.
pub(crate) fn undated_head(run: &str, engine: &Engine, start: &StartState) -> JournalHead {
    JournalHead {
        run: run.to_owned(),
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
    fn inner(&mut self) -> Option<&mut dyn Observer> {
        Some(self.observer)
    }

    fn commit(&mut self, now: Time, effects: &[Effect]) -> RunControl {
        self.observer.commit(now, effects)
    }

    fn reached(&mut self, now: Time) -> RunControl {
        self.observer.reached(now)
    }

    fn wants_telemetry(&self) -> bool {
        self.observer.wants_telemetry()
    }

    fn wants_picture(&self) -> bool {
        self.observer.wants_picture()
    }

    fn verifier(&mut self) -> Option<&mut dyn Verifier> {
        self.guard.as_mut().map(|guard| guard as &mut dyn Verifier)
    }

    fn at_least_every(&self) -> Time {
        self.observer.at_least_every()
    }

    fn glance_every(&self) -> Time {
        self.observer.glance_every()
    }
}
