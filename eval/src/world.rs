//! Runs in a world that can fail: the examples, and requests in words, in the profile `harsh`. No run may end
//! as done where its goal does not hold by the truth of the world.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use motet_compiler::{CheckOptions, Geometry, Session};
use motet_geometry::planning::SearchBudget;
use motet_graph::{Condition, FactArg, Graph, Term, Value};
use motet_planner::Builtin;
use motet_planner::dialogue::{
    Conversation, DialogueObserver, DialogueSetup, Kind, Outcome, Person, Problem,
};
use motet_robots::builtin;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_runtime::{
    Driver as _, DriverEvent, Engine, Event, Observer, Outcome as Ending, RunEnd, StartState, Time, run,
};
use motet_sim::{Profile, Sim, SimOptions};
use motet_stdlib::lang::failures;
use motet_syntax::{FileId, Source, Sources};
use serde::Serialize;

use crate::{dialogue, mutations};

/// Requests in words, by their tasks.
const WORDINGS: &str = "\
    bring: Bring me {thing}.\nput: Put {thing} on {place}.\nstow: Put {thing} in {place}.\n\
    throw: Throw {thing} away.\ngo: Go to {place}.\nopen: Open {place}.\nclose: Close {place}.";
/// Number of times a person lets the robot try again.
const AGAIN: u32 = 2;

/// Task: an example, or a request.
#[derive(Clone, Debug)]
enum Work {
    /// Text of a policy.
    Policy(String),
    Request(Box<dialogue::Case>),
}

/// Run of a task with a seed.
#[derive(Clone, Debug)]
pub struct WorldRun {
    name: String,
    robot: String,
    scene: String,
    seed: u64,
    work: Work,
}

/// Sort of a failure.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FailureSort {
    /// A thing was not found, or not told apart.
    Perception,
    /// No way, no reach, or something in the way.
    Planning,
    /// A hand, a door or a person did not do its part.
    Execution,
}

impl FailureSort {
    fn of(kind: &str) -> Self {
        match kind {
            failures::NOT_FOUND | failures::AMBIGUOUS => Self::Perception,
            failures::UNREACHABLE | failures::BLOCKED => Self::Planning,
            _ => Self::Execution,
        }
    }
}

/// Result of a run.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct WorldEnd {
    /// Name of the example, or the request.
    pub name: String,
    /// Robot and seed.
    pub robot: String,
    pub seed: u64,
    /// True if it ended as done.
    pub is_done: bool,
    /// True if its goal holds by the truth of the world.
    pub is_true: bool,
    /// Failures of its steps by their sort.
    pub failures: BTreeMap<FailureSort, usize>,
    /// Sort of the last failure, where it is not done.
    pub failed_by: Option<FailureSort>,
}

/// So many runs, in turns through the examples of a folder and the requests.
///
/// # Errors
///
/// An example cannot be read, or does not name its robot and its scene.
pub fn runs(folder: &Path, count: usize) -> Result<Vec<WorldRun>, String> {
    let mut tasks: Vec<WorldRun> = Vec::new();
    for example in mutations::examples(folder)? {
        let (name, robot, scene) = (example.name, example.robot, example.scene);
        tasks.push(WorldRun { name, robot, scene, seed: 0, work: Work::Policy(example.text) });
    }
    for case in dialogue::cases(WORDINGS).into_iter().filter(|case| case.failures.is_empty()) {
        let (name, robot, scene) = (case.request.clone(), case.robot.clone(), case.scene.clone());
        tasks.push(WorldRun { name, robot, scene, seed: 0, work: Work::Request(Box::new(case)) });
    }
    let runs = (0..count).filter_map(|index| {
        let task = tasks.get(index % tasks.len().max(1))?.clone();
        Some(WorldRun { seed: index as u64, ..task })
    });
    Ok(runs.collect())
}

/// Carries out runs in a profile.
#[must_use]
pub fn carry_out(runs: Vec<WorldRun>, profile: &Profile) -> Vec<WorldEnd> {
    super::spread(runs, |run| run.carry_out(profile))
}

/// The failures of steps that a driver reports, in order.
#[derive(Default)]
struct Failures(Vec<FailureSort>);

impl Failures {
    fn take(&mut self, event: &Event) {
        if let Event::Driver(DriverEvent::Ended { outcome: Ending::Failure(failure), .. }) = event {
            self.0.push(FailureSort::of(&failure.kind));
        }
    }
}

impl Observer for Failures {
    fn event(&mut self, _now: Time, event: &Event) {
        self.take(event);
    }
}

impl DialogueObserver for Failures {
    fn event(&mut self, _now: Time, event: &Event) {
        self.take(event);
    }
}

/// Person who lets the robot try again, and knows no more than the robot.
struct Patient(u32);

impl Person for Patient {
    fn ask(&mut self, problem: &Problem) -> Option<String> {
        let is_worth_it = matches!(problem.kind, Kind::ActionFailed | Kind::NotReachable);
        self.0 = self.0.checked_sub(1).filter(|_| is_worth_it)?;
        Some("Please try again.".to_owned())
    }
}

impl WorldRun {
    fn carry_out(self, profile: &Profile) -> WorldEnd {
        let mut seen = Failures::default();
        let (is_done, is_true) = match (&self.work, builtin::robot(&self.robot), builtin::scene(&self.scene))
        {
            (Work::Policy(text), Some(body), Some(scene)) => {
                let geometry = Geometry::new(&body.robot, &body.urdf, &scene, None, SearchBudget::default());
                self.policy(text, &body.robot, &scene, Arc::new(geometry), profile, &mut seen)
            }
            (Work::Request(case), Some(body), Some(scene)) => {
                self.request(case, body.robot, scene, profile, &mut seen)
            }
            (_, _, _) => (false, false),
        };
        let mut failures = BTreeMap::new();
        for sort in &seen.0 {
            *failures.entry(*sort).or_insert(0) += 1;
        }
        let failed_by = seen.0.last().copied().filter(|_| !is_done);
        WorldEnd {
            name: self.name,
            robot: self.robot,
            seed: self.seed,
            is_done,
            is_true,
            failures,
            failed_by,
        }
    }

    fn options(&self, profile: &Profile) -> SimOptions {
        SimOptions { seed: self.seed, profile: profile.clone(), ..SimOptions::default() }
    }

    /// Runs an example. Gives whether it is done, and whether its goal holds.
    fn policy(
        &self,
        text: &str,
        robot: &Robot,
        scene: &Scene,
        geometry: Arc<Geometry>,
        profile: &Profile,
        seen: &mut Failures,
    ) -> (bool, bool) {
        let session = Session::builder().robot(robot).scene(scene).build(&mut Sources::default());
        let session = session.with_geometry(geometry);
        let parsed = motet_syntax::read(&Source::new("example.motet", text), FileId(99));
        let Some(graph) = session.compile(&parsed, None).graph else { return (false, false) };
        let mut sim = Sim::new(robot, scene, self.options(profile));
        let Ok(engine) = Engine::new(graph.clone(), &StartState::default()) else { return (false, false) };
        let mut engine = engine.with_capabilities(sim.capabilities());
        let end = run(&mut engine, &mut sim, seen, Time::ZERO);
        let is_true = graph.goal.iter().all(|part| truth(part, &graph, &sim) != Some(false));
        (matches!(end, RunEnd::Done { .. }), is_true)
    }

    /// Carries a request out. Gives whether it is done, and whether its goal holds.
    fn request(
        &self,
        case: &dialogue::Case,
        robot: Robot,
        scene: Scene,
        profile: &Profile,
        seen: &mut Failures,
    ) -> (bool, bool) {
        let scene = case.told(scene);
        let mut sim = Sim::new(&robot, &scene, self.options(profile));
        let options = CheckOptions::default();
        let setting = DialogueSetup { robot, scene, domains: Vec::new(), geometry: None, options };
        let mut talk = Conversation::new(&setting);
        let (outcome, _) =
            talk.carry_out(&case.request, &mut Builtin, &mut sim, &mut Patient(AGAIN), seen, Time::ZERO);
        let holds = |(fluent, args): &(String, Vec<String>)| {
            let args: Vec<&str> = args.iter().map(String::as_str).collect();
            sim.holds(fluent, &args) == Some(true)
        };
        (outcome == Outcome::Done, case.goal.iter().all(holds) && !case.undo.iter().any(holds))
    }
}

/// Truth of a part of a goal, where it is about entities that the policy names.
fn truth(part: &Condition, graph: &Graph, sim: &Sim) -> Option<bool> {
    match part {
        Condition::Literal(is_true) => Some(*is_true),
        Condition::Fact(fact) => {
            let fluent = graph.fluents.get(fact.fluent.index())?;
            let args = fact.args.iter().map(|arg| match arg {
                FactArg::Term(Term::Literal(Value::Entity(id) | Value::Case(id))) => Some(id.as_str()),
                FactArg::Term(_) | FactArg::Any => None,
            });
            sim.holds(&fluent.name, &args.collect::<Option<Vec<_>>>()?)
        }
        Condition::Not(inner) => truth(inner, graph, sim).map(|is_true| !is_true),
        Condition::All(parts) => {
            let parts: Vec<_> = parts.iter().map(|part| truth(part, graph, sim)).collect();
            if parts.contains(&Some(false)) {
                Some(false)
            } else {
                parts.into_iter().collect::<Option<Vec<_>>>().map(|_| true)
            }
        }
        Condition::Compare(..) | Condition::AnyOf(_) => None,
    }
}

/// Sums over runs.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct WorldSums {
    pub total: usize,
    /// Runs that ended as done with their goal.
    pub done: usize,
    /// Runs that ended as done without their goal.
    pub untrue: usize,
    /// Runs that were not done, by the sort of their last failure.
    pub failed_by: BTreeMap<FailureSort, usize>,
    /// Failures of steps, by their sort.
    pub failures: BTreeMap<FailureSort, usize>,
}

/// Adds up runs.
#[must_use]
pub fn sums(ends: &[WorldEnd]) -> WorldSums {
    let mut sums = WorldSums { total: ends.len(), ..WorldSums::default() };
    for end in ends {
        sums.done += usize::from(end.is_done && end.is_true);
        sums.untrue += usize::from(end.is_done && !end.is_true);
        if let Some(sort) = end.failed_by {
            *sums.failed_by.entry(sort).or_insert(0) += 1;
        }
        for (sort, count) in &end.failures {
            *sums.failures.entry(*sort).or_insert(0) += count;
        }
    }
    sums
}
