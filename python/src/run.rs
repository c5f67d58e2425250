//! Runs in the simulator and on drivers in Python, and replays of them.

use std::path::PathBuf;

use motet::host::remote::protocol::Hello;
use motet::host::remote::{DriverTimeouts, RemoteDriver};
use motet::planner::runtime_check::CheckMode;
use motet::project::{SimulationInputs, read_profile, read_scene};
use motet::replay::{JournalPlayer, JournalPosition, described};
use motet::run::{RecordedRun, RunPlan, recorded, remote_settings, run_id, simulator, state_facts};
use motet::runtime::journal::JournalEntry;
use motet::runtime::{Driver as _, DriverClock, EngineSettings, RunControl, Time};
use motet_syntax::Sources;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::errors::{input_error, raised, wrong};
use crate::findings::Findings;
use crate::graph::Graph;
use crate::project::Project;

/// A run that is over.
#[pyclass(frozen, module = "motet._motet")]
pub(crate) struct Run {
    events: Vec<String>,
    journal: Vec<JournalEntry>,
}

#[pymethods]
impl Run {
    /// Events as `motet run --format json` prints them, one object a line.
    fn events(&self) -> String {
        self.events.iter().flat_map(|line| [line.as_str(), "\n"]).collect()
    }

    /// Replay to a time in s, to the entry with a number, or to the end: the verdict and the state for
    /// people, and a JSON object.
    #[pyo3(signature = (at, entry))]
    fn replay(&self, py: Python<'_>, at: Option<f64>, entry: Option<u64>) -> PyResult<Replayed> {
        let mut player = JournalPlayer::until(moment(at, entry)?);
        py.detach(|| {
            for (seq, entry) in (0..).zip(&self.journal) {
                player.take(seq, entry);
            }
        });
        replayed(&player, true)
    }
}

/// Verdict and state for people, and a JSON object.
type Replayed = (String, String, String);

/// Replay of the journal in a folder: the verdict and the state for people, and a JSON object.
#[pyfunction]
#[pyo3(signature = (folder, at, entry))]
pub(crate) fn replay(
    py: Python<'_>,
    folder: PathBuf,
    at: Option<f64>,
    entry: Option<u64>,
) -> PyResult<Replayed> {
    let last = moment(at, entry)?;
    let mut player = JournalPlayer::until(last);
    let read = py.detach(|| motet::host::journal::read(&folder, &mut |seq, entry| player.take(seq, &entry)));
    read.map_err(|error| raised(py, "InputError", (error.to_string(), None::<String>, "")))?;
    replayed(&player, last.is_some())
}

fn replayed(player: &JournalPlayer, has_state: bool) -> PyResult<Replayed> {
    player.require().map_err(wrong)?;
    let state = player.state().filter(|_| has_state);
    Ok((player.verdict(), state.as_ref().map(described).unwrap_or_default(), player.json(state.as_ref())))
}

fn moment(at: Option<f64>, entry: Option<u64>) -> PyResult<Option<JournalPosition>> {
    match (at, entry) {
        (Some(_), Some(_)) => Err(wrong("give either a time or the number of an entry")),
        (Some(at), None) if at.is_finite() && at >= 0.0 => {
            Ok(Some(JournalPosition::Time(Time::from_secs(at))))
        }
        (Some(at), None) => Err(wrong(format!("{at} s is no time of a run"))),
        (None, entry) => Ok(entry.map(JournalPosition::Entry)),
    }
}

#[pymethods]
impl Project {
    /// Checks a policy and runs it in the simulator, as fast as possible. `faults` and `answers` are JSON or
    /// paths, `world` is a scene as in a project.
    #[expect(clippy::too_many_arguments, reason = "most are keywords")]
    #[pyo3(signature = (name, document, policy, *, seed, faults, answers, profile, world, record))]
    fn simulate(
        &self,
        py: Python<'_>,
        name: &str,
        document: Option<&[u8]>,
        policy: Option<String>,
        seed: u64,
        faults: Option<PathBuf>,
        answers: Option<PathBuf>,
        profile: &str,
        world: Option<&str>,
        record: Option<PathBuf>,
    ) -> PyResult<(Option<(Run, Graph)>, Findings)> {
        let (prepared, mut findings) = self.compile(py, name, document, policy)?;
        let Some(prepared) = prepared else { return Ok((None, findings)) };
        let run = py.detach(|| {
            let opened = &prepared.opened;
            let inputs = SimulationInputs::read(seed, faults.as_deref(), answers.as_deref(), &mut findings)?;
            let world = match world {
                Some(name) => Some(read_scene(name, &mut Sources::default(), &mut findings)?),
                None => None,
            };
            let eye = opened.geometry.as_ref().and_then(|geometry| geometry.eye());
            let inputs = inputs.with_profile(read_profile(profile)?).with_world(world).with_eye(eye);
            let policy = (&prepared.graph, &prepared.parsed.file);
            let (mut driver, saved) = simulator(opened, policy, inputs)?;
            let plan = RunPlan {
                opened,
                graph: &prepared.graph,
                run: &run_id(),
                verifies: CheckMode::AtOnce,
                settings: EngineSettings::default(),
                record: record.as_deref().map(|folder| (folder, Some(&saved))),
                looks_every: Time::NEVER,
            };
            followed(&plan, &mut driver)
        });
        let run = finished(py, run)?;
        Ok((Some((run, prepared)), findings))
    }
}

#[pymethods]
impl Graph {
    /// Runs the policy on a driver. `serve` gets the number of a socket and starts to serve it on a thread of
    /// its own; `say` gets what the driver says to people.
    #[pyo3(signature = (*, serve, say, record))]
    fn drive(
        &self,
        py: Python<'_>,
        serve: &Bound<'_, PyAny>,
        say: Py<PyAny>,
        record: Option<PathBuf>,
    ) -> PyResult<Run> {
        let (own, theirs) = std::os::unix::net::UnixStream::pair().map_err(wrong)?;
        serve.call1((std::os::fd::IntoRawFd::into_raw_fd(theirs),))?;
        let run = py.detach(|| {
            let (opened, run) = (&self.opened, run_id());
            let hello = Hello { state: state_facts(opened), ..Hello::of(&self.graph, &run) };
            let log = Box::new(move |text: &str| {
                // A listener that fails does not stop the robot.
                let _ = Python::attach(|py| say.call1(py, PyTuple::new(py, [text])?));
            });
            let timeouts = DriverTimeouts::default();
            let mut driver = RemoteDriver::over_stream(own, hello, timeouts, Time::ZERO, log)
                .map_err(motet::Error::from)?;
            let (verifies, looks_every) = match driver.capabilities().clock {
                DriverClock::Driver => (CheckMode::AtOnce, Time::NEVER),
                DriverClock::Wall => (CheckMode::Background, Time::from_secs(0.1)),
            };
            let plan = RunPlan {
                opened,
                graph: &self.graph,
                run: &run,
                verifies,
                settings: remote_settings(),
                record: record.as_deref().map(|folder| (folder, None)),
                looks_every,
            };
            followed(&plan, &mut driver)
        });
        finished(py, run)
    }
}

/// Runs to the end, with signals of Python looked at now and then. An exception in a handler stops the run
/// and is raised after it.
fn followed(
    plan: &RunPlan<'_>,
    driver: &mut dyn motet::Driver,
) -> Result<Result<RecordedRun, PyErr>, motet::Error> {
    let mut raised = None;
    let run = recorded(plan, driver, &mut || {
        if raised.is_none() {
            raised = Python::attach(|py| py.check_signals()).err();
        }
        if raised.is_some() { RunControl::Stop } else { RunControl::Continue }
    })?;
    Ok(raised.map_or(Ok(run), Err))
}

fn finished(py: Python<'_>, run: Result<Result<RecordedRun, PyErr>, motet::Error>) -> PyResult<Run> {
    let run = run.map_err(|error| input_error(py, &error))??;
    Ok(Run { events: run.events, journal: run.journal })
}
