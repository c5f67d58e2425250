//! Runs in a world that can fail: the examples, and requests in words, in the profile `harsh`. No run may end
//! as done where its goal does not hold by the truth of the world.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::Path;

use motet_compiler::CheckOptions;
use motet_graph::{Comparison, Condition, FactArg, Graph, Term, Value};
use motet_planner::Builtin;
use motet_planner::dialogue::{
    Conversation, DialogueObserver, DialogueSetup, Kind, Outcome, Person, Problem,
};
use motet_robots::builtin::{self, RobotWithBody};
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_runtime::{Answer, Engine, Event, Observer, Pattern, Query, RunEnd, StartState, Time, run};
use motet_sim::Faults;
use motet_syntax::{FileId, Source, Sources};
use serde::{Deserialize, Serialize};

use crate::bench::{Bench, TrialRobot};
use crate::mutations::Mutant;
use crate::outcome::{FailureSort, StepFailures};
use crate::{dialogue, mutations, setup};

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

/// Result of a run.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct WorldEnd {
    /// Name of the example, or the request.
    pub name: String,
    /// Robot and seed.
    pub robot: String,
    pub seed: u64,
    /// True if it ended as done.
    pub is_done: bool,
    /// True if its goal holds by the truth of the world; none without a goal, or where the world cannot say.
    pub is_true: Option<bool>,
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
    for case in
        dialogue::cases(WORDINGS, dialogue::Objects::Seen).into_iter().filter(|case| case.failures.is_empty())
    {
        let (name, robot, scene) = (case.request.clone(), case.robot.clone(), case.scene.clone());
        tasks.push(WorldRun { name, robot, scene, seed: 0, work: Work::Request(Box::new(case)) });
    }
    let runs = (0..count).filter_map(|index| {
        let task = tasks.get(index % tasks.len().max(1))?.clone();
        Some(WorldRun { seed: index as u64, ..task })
    });
    Ok(runs.collect())
}

/// Carries out runs in a world.
///
/// # Errors
///
/// The driver does not start.
pub fn carry_out(mut runs: Vec<WorldRun>, bench: &Bench) -> Result<Vec<WorldEnd>, String> {
    runs.retain(|run| bench.asks_for(&[&run.robot, &run.scene, &run.name]));
    bench.workers.spread_kept(runs, |run| run.carry_out(bench))
}

/// Notes failures of steps.
#[derive(Default)]
struct Failures(StepFailures);

impl Observer for Failures {
    fn event(&mut self, _now: Time, event: &Event) {
        self.0.take(event);
    }
}

impl DialogueObserver for Failures {
    fn event(&mut self, now: Time, event: &Event) {
        Observer::event(self, now, event);
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
    /// Run of a changed example with a seed.
    pub(crate) fn of_mutant(mutant: &Mutant, seed: u64) -> Self {
        let Mutant { name, text, robot, scene } = mutant.clone();
        Self { name, robot, scene, seed, work: Work::Policy(text) }
    }

    pub(crate) fn carry_out(self, bench: &Bench) -> Result<WorldEnd, String> {
        let mut seen = Failures::default();
        let (is_done, is_true) = match (&self.work, builtin::robot(&self.robot), builtin::scene(&self.scene))
        {
            (Work::Policy(text), Some(body), Some(scene)) => {
                self.policy(text, &body, &scene, bench, &mut seen)?
            }
            (Work::Request(case), Some(body), Some(scene)) => {
                self.request(case, body.robot, scene, bench, &mut seen)?
            }
            (_, _, _) => (false, None),
        };
        let failures = seen.0.counts();
        let failed_by = seen.0.0.last().copied().filter(|_| !is_done);
        Ok(WorldEnd {
            name: self.name,
            robot: self.robot,
            seed: self.seed,
            is_done,
            is_true,
            failures,
            failed_by,
        })
    }

    /// Runs an example. Gives whether it is done, and whether its goal holds, if that can be said.
    fn policy(
        &self,
        text: &str,
        body: &RobotWithBody,
        scene: &Scene,
        bench: &Bench,
        seen: &mut Failures,
    ) -> Result<(bool, Option<bool>), String> {
        let robot = &body.robot;
        let (session, _) = setup::session(Some(robot), Some(scene), &mut Sources::default());
        let session = session.with_geometry(setup::geometry(body, scene));
        let parsed = motet_syntax::read(&Source::new("example.motet", text), FileId(99));
        let Some(graph) = session.compile(&parsed, None).graph else { return Ok((false, None)) };
        let mut robot_in = bench.robot(robot, (scene, scene), self.seed, Faults::default())?;
        let Ok(engine) = Engine::new(graph.clone(), &StartState::default()) else {
            return Ok((false, None));
        };
        let driver = robot_in.driver();
        let mut engine = engine.with_capabilities(driver.capabilities());
        let from = driver.begin_run(Time::ZERO, "run.1", Some(&graph));
        let end = run(&mut engine, driver, seen, from);
        let judge = Judge { graph: &graph, engine: &engine, world: RefCell::new(robot_in) };
        let holds = || decided(graph.goal.iter().map(|part| judge.truth(part)), false);
        let is_true = (!graph.goal.is_empty()).then(holds).flatten();
        Ok((matches!(end, RunEnd::Done { .. }), is_true))
    }

    /// Carries a request out. Gives whether it is done, and whether its goal holds, if that can be said.
    fn request(
        &self,
        case: &dialogue::Case,
        robot: Robot,
        scene: Scene,
        bench: &Bench,
        seen: &mut Failures,
    ) -> Result<(bool, Option<bool>), String> {
        let scene = case.told(scene);
        let mut robot_in = bench.robot(&robot, (&scene, &scene), self.seed, Faults::default())?;
        let options = CheckOptions::default();
        let setting = DialogueSetup { robot, scene, domains: Vec::new(), geometry: None, options };
        let mut talk = Conversation::new(&setting);
        let (driver, mut person) = (robot_in.driver(), Patient(AGAIN));
        let (outcome, _) = talk.carry_out(&case.request, &mut Builtin, driver, &mut person, seen, Time::ZERO);
        let mut holds = |(fluent, args): &(String, Vec<String>)| {
            let args: Vec<&str> = args.iter().map(String::as_str).collect();
            robot_in.holds(fluent, &args)
        };
        let is_true = case.goal.iter().all(&mut holds) && !case.undo.iter().any(&mut holds);
        Ok((outcome == Outcome::Done, Some(is_true)))
    }
}

/// Judge of a goal by the truth of the world, with the bindings at the end of the run.
struct Judge<'a> {
    graph: &'a Graph,
    engine: &'a Engine,
    world: RefCell<TrialRobot>,
}

impl Judge<'_> {
    fn ask(&self, query: &Query) -> Answer {
        self.world.borrow_mut().truth(query)
    }

    /// Truth of a part of a goal; `None` where the world cannot say.
    fn truth(&self, part: &Condition) -> Option<bool> {
        match part {
            Condition::Literal(is_true) => Some(*is_true),
            Condition::Fact(fact) => {
                let fluent = self.graph.fluents.get(fact.fluent.index())?.name.clone();
                let args = fact.args.iter().map(|arg| match arg {
                    FactArg::Any => Some(Pattern::Any),
                    FactArg::Term(term) => self.value(term).map(Pattern::Is),
                });
                let query = Query::Fact { fluent, args: args.collect::<Option<_>>()? };
                match self.ask(&query) {
                    Answer::Truth(is_true) => Some(is_true),
                    Answer::Value(_) | Answer::Unknown => None,
                }
            }
            Condition::Not(inner) => self.truth(inner).map(|is_true| !is_true),
            Condition::All(parts) => decided(parts.iter().map(|part| self.truth(part)), false),
            Condition::AnyOf(parts) => decided(parts.iter().map(|part| self.truth(part)), true),
            Condition::Compare(op, left, right) => self.compare(*op, left, right),
        }
    }

    fn compare(&self, op: Comparison, left: &Term, right: &Term) -> Option<bool> {
        let (left, right) = (self.value(left)?, self.value(right)?);
        let number = |value: &Value| match value {
            Value::Number(number) => Some(*number),
            Value::Int(number) => Some(*number as f64),
            _ => None,
        };
        let order = match (number(&left), number(&right)) {
            (Some(left), Some(right)) => left.partial_cmp(&right)?,
            (None, None) => return equal(op, left == right),
            (_, _) => return None,
        };
        Some(match op {
            Comparison::Less => order.is_lt(),
            Comparison::AtMost => order.is_le(),
            Comparison::More => order.is_gt(),
            Comparison::AtLeast => order.is_ge(),
            Comparison::Equal => order.is_eq(),
            Comparison::Unequal => order.is_ne(),
        })
    }

    /// Value of a term in the world.
    fn value(&self, term: &Term) -> Option<Value> {
        let asked = match term {
            Term::Literal(value) => return Some(value.clone()),
            Term::Binding(binding) => return self.engine.binding(*binding).cloned(),
            Term::Measure(measure, args) => Query::Measure {
                measure: self.graph.measures.get(measure.index())?.name.clone(),
                args: args.iter().map(|arg| self.value(arg)).collect::<Option<_>>()?,
            },
            Term::Field(entity, field) => {
                let Value::Entity(entity) = self.value(entity)? else { return None };
                Query::Field { entity, field: field.clone() }
            }
            _ => return None,
        };
        match self.ask(&asked) {
            Answer::Value(value) => Some(value),
            Answer::Truth(_) | Answer::Unknown => None,
        }
    }
}

/// Truth of several parts, of which one that is `decisive` decides.
fn decided(parts: impl Iterator<Item = Option<bool>>, decisive: bool) -> Option<bool> {
    let parts: Vec<Option<bool>> = parts.collect();
    if parts.contains(&Some(decisive)) {
        return Some(decisive);
    }
    (!parts.contains(&None)).then_some(!decisive)
}

const fn equal(op: Comparison, is_equal: bool) -> Option<bool> {
    match op {
        Comparison::Equal => Some(is_equal),
        Comparison::Unequal => Some(!is_equal),
        Comparison::Less | Comparison::AtMost | Comparison::More | Comparison::AtLeast => None,
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
    /// Runs that ended as done without a goal, or with one of which the world cannot say if it holds.
    pub not_judged: usize,
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
        match end.is_true.filter(|_| end.is_done) {
            Some(true) => sums.done += 1,
            Some(false) => sums.untrue += 1,
            None => sums.not_judged += usize::from(end.is_done),
        }
        if let Some(sort) = end.failed_by {
            *sums.failed_by.entry(sort).or_insert(0) += 1;
        }
        for (sort, count) in &end.failures {
            *sums.failures.entry(*sort).or_insert(0) += count;
        }
    }
    sums
}
