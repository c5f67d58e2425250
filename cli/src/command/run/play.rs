//! Plays a run: an engine, a driver, a view, and a journal if there is one.

use std::io::{self, IsTerminal};
use std::path::Path;
use std::sync::Arc;
use std::time::{SystemTime, UNIX_EPOCH};

use motet_graph::Graph;
use motet_host::journal::{JournalError, JournalWriter, RunRecorder};
use motet_planner::runtime_check::{Guard, WITHIN};
use motet_runtime::journal::JournalHead;
use motet_runtime::{Capabilities, Driver, Engine, EngineSettings, Event, RunEnd, StartState, Time, resume};

use super::pace::{Pace, catch_interrupts};
use super::saved::Saved;
use super::view::{Clock, View};
use super::{events, lines, screen};
use crate::args::RunFormat;
use crate::exit::{Exit, Trouble};
use crate::out::Colors;

/// All that a run needs.
pub(super) struct Play<'a> {
    pub(super) engine: Engine,
    pub(super) driver: &'a mut dyn Driver,
    pub(super) journal: Option<JournalWriter>,
    /// The driver's present time.
    pub(super) from: Time,
    /// What the engine takes in first.
    pub(super) events: Vec<Event>,
}

impl Play<'_> {
    /// Runs to the end.
    ///
    /// # Errors
    ///
    /// Ctrl-C cannot be caught, or the journal could not be written; the run was stopped then.
    pub(super) fn run(mut self, mut pace: Pace) -> Result<RunEnd, Trouble> {
        catch_interrupts()?;
        let end = match self.journal {
            None => resume(&mut self.engine, self.driver, &mut pace, self.from, self.events),
            Some(writer) => {
                let mut recorder = RunRecorder::new(writer, &mut pace);
                let end = resume(&mut self.engine, self.driver, &mut recorder, self.from, self.events);
                recorder.finish().map_err(journal_trouble)?;
                end
            }
        };
        pace.finish(&end);
        Ok(end)
    }
}

/// An engine for a compiled graph. A guard answers what its settings leave to nobody.
pub(super) fn engine(
    graph: Graph,
    start: &StartState,
    can: Capabilities,
    guard: Option<&Guard>,
    settings: EngineSettings,
) -> Result<Engine, Trouble> {
    let engine = Engine::new(graph, start).map_err(|wrong| {
        let first = wrong.first().map_or_else(String::new, |wrong| format!(": {wrong}"));
        Trouble::Other(format!("the compiled graph is not valid{first}"))
    })?;
    let settings = EngineSettings { verify_within: guard.map(|_| WITHIN), ..settings };
    Ok(engine.with_capabilities(can).with_settings(settings))
}

/// A new journal in a folder.
pub(super) fn journal(
    folder: &Path,
    engine: &Engine,
    start: &StartState,
    driver: &Saved,
) -> Result<JournalWriter, Trouble> {
    let head = JournalHead { driver: driver.to_json()?, ..head(engine, start) };
    JournalWriter::create(folder, head).map_err(journal_trouble)
}

/// The head of a journal of a run that begins now, at time 0.
pub(in crate::command) fn head(engine: &Engine, start: &StartState) -> JournalHead {
    JournalHead {
        began_unix_ns: unix_ns(),
        start: start.clone(),
        settings: *engine.settings(),
        capabilities: engine.capabilities().clone(),
        ..JournalHead::new(engine.graph())
    }
}

/// The view in a format, of a run by that clock.
pub(super) fn view(format: RunFormat, graph: &Graph, colors: Colors, clock: Clock) -> Box<dyn View> {
    let graph = Arc::new(graph.clone());
    match format {
        RunFormat::Json => Box::new(events::Events::new(graph)),
        RunFormat::Human if io::stdout().is_terminal() => {
            Box::new(screen::Screen::new(graph, colors.stdout, clock))
        }
        RunFormat::Human => Box::new(lines::Lines::new(graph, colors.stdout, clock)),
    }
}

/// The exit code of an end.
pub(super) const fn exit(end: &RunEnd) -> Exit {
    match end {
        RunEnd::Done { .. } => Exit::Clean,
        RunEnd::Failed { .. } | RunEnd::Replan { .. } | RunEnd::Fault(_) => Exit::Failed,
        RunEnd::Interrupted => Exit::Interrupted,
    }
}

/// The wall clock, in ns since 1970.
pub(super) fn unix_ns() -> u64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    since.map_or(0, |since| u64::try_from(since.as_nanos()).unwrap_or(u64::MAX))
}

/// A journal that cannot be used.
pub(in crate::command) fn journal_trouble(error: JournalError) -> Trouble {
    Trouble::Other(error.to_string())
}
