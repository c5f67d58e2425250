//! Tool that runs a policy in a simulation of its own: no driver hears of it.

use std::sync::Arc;
use std::time::{Duration, Instant};

use motet::run::{Guarded, engine, start_state};
use motet_graph::Graph;
use motet_planner::runtime_check::{CheckMode, Guard};
use motet_project::SimulationInputs;
use motet_runtime::{Driver as _, Effect, EngineSettings, Observer, RunControl, Time};
use motet_sim::{PersonScript, Profile, Sim};
use serde_json::{Value, json};

use super::answer::Refusal;
use super::checker::compile;
use super::environment::AgentEnvironment;
use super::narration::{Line, ending, narrate};
use super::text::{read, within};

/// Time after which a simulation is stopped.
const PATIENCE: Duration = Duration::from_secs(20);
/// The longest simulated time.
const MAX_SIMULATED: Time = Time::from_nanos(4 * 3600 * 1_000_000_000);
/// The most lines of an answer, the first ones.
const MAX_LINES: usize = 300;
/// The most answers of the simulated person.
const MAX_ANSWERS: usize = 50;

/// Inputs of a simulation.
#[derive(Debug)]
pub(super) struct Simulation<'a> {
    pub(super) policy: &'a str,
    pub(super) seed: u64,
    /// Built-in profile of what goes wrong by itself.
    pub(super) profile: Option<&'a str>,
    /// Answers of the simulated person, in order.
    pub(super) answers: &'a [String],
}

/// Checks a policy and simulates it in a situation.
pub(super) fn simulate(situation: &AgentEnvironment, wanted: &Simulation<'_>) -> Result<Value, Refusal> {
    let robot = situation.robot()?;
    if wanted.answers.len() > MAX_ANSWERS {
        return Err(Refusal::new(format!("at most {MAX_ANSWERS} answers are taken")));
    }
    wanted.answers.iter().try_for_each(|answer| within("answer", answer))?;
    let (graph, found) = compile(&situation.session, &situation.project, wanted.policy)?;
    let (_, parsed) = read(wanted.policy)?;
    let profile = wanted.profile.unwrap_or("typical");
    // No call opens a file.
    let profile = match Profile::builtin(profile) {
        Some(profile) => profile,
        None => {
            let names: Vec<&str> = Profile::names().collect();
            return Err(Refusal::unknown("profile", profile, format!("known: {}", names.join(", "))));
        }
    };
    let project = &situation.project;
    let files: Vec<_> = project.domains.iter().chain([&parsed.file]).collect();
    let eye = project.geometry.as_ref().and_then(|geometry| geometry.eye());
    let inputs = SimulationInputs::with_seed(wanted.seed).with_profile(profile).with_eye(eye);
    let mut options = inputs.for_policy(&graph, &files).with_facts(project.told_facts());
    let answers = wanted.answers.iter().map(|answer| Some(answer.clone())).collect();
    options.script = PersonScript { answers };
    let mut simulator = Sim::new(robot, &situation.scene, options);
    let guard = situation.session.world_tracker().map(|course| Guard::new(course, CheckMode::AtOnce));
    let start = start_state(Some(&situation.scene));
    let settings = EngineSettings::default();
    let graph = Arc::new(graph);
    let engine = engine(Graph::clone(&graph), &start, simulator.capabilities(), guard.as_ref(), settings);
    let mut engine = engine.map_err(|error| Refusal::new(error.to_string()))?;
    let mut watch = SimulationWatch {
        graph: Arc::clone(&graph),
        begun: Instant::now(),
        now: Time::ZERO,
        lines: Vec::new(),
        forgotten: 0,
        is_over_time: false,
    };
    let mut observer = Guarded::new(&mut watch, guard);
    let from = simulator.begin_run(Time::ZERO, "simulation", Some(engine.graph()));
    let end = motet_runtime::run(&mut engine, &mut simulator, &mut observer, from);
    let ending = ending(&graph, &end, watch.now);
    let facts = engine.snapshot().facts.into_iter().map(|(query, truth)| format!("{query}: {truth}"));
    Ok(json!({
        "outcome": if watch.is_over_time { "stopped_by_time_limit" } else { ending.outcome },
        "says": ending.says,
        "seconds": watch.now.secs(),
        "events": watch.lines,
        "later_events": watch.forgotten,
        "facts_at_the_end": facts.collect::<Vec<_>>(),
        "check": found.get("says"),
    }))
}

/// Observer that collects lines, and stops a simulation that takes too long.
struct SimulationWatch {
    graph: Arc<Graph>,
    begun: Instant,
    now: Time,
    lines: Vec<String>,
    forgotten: usize,
    is_over_time: bool,
}

impl Observer for SimulationWatch {
    fn effect(&mut self, now: Time, effect: &Effect) {
        self.now = self.now.max(now);
        let Some(Line::Event(line) | Line::Message(line)) = narrate(&self.graph, now, effect) else { return };
        if self.lines.len() < MAX_LINES { self.lines.push(line) } else { self.forgotten += 1 }
    }

    fn reached(&mut self, _now: Time) -> RunControl {
        self.is_over_time |= self.begun.elapsed() > PATIENCE || self.now > MAX_SIMULATED;
        if self.is_over_time { RunControl::Stop } else { RunControl::Continue }
    }
}
