//! InteLiPlan's protocol in simulation: commands in many wordings, with and without failures of each kind,
//! one and two rounds of recovery, on two robots, carried out by the planner that needs no model.
//!
//! A case is made from a line of a wordings file, which knows a task and the words for it, and from a room,
//! which knows what there is. The planner sees the words alone; the goal is looked at only to judge the end.

mod cases;
mod objects;
mod rooms;
mod tables;

use std::time::Duration;

use motet_compiler::CheckOptions;
use motet_planner::dialogue::{Conversation, DialogueSetup, Kind, Outcome, Person, Problem};
use motet_runtime::Time;
use motet_sim::Faults;
use serde::{Deserialize, Serialize};

pub use cases::{Case, cases};
pub use objects::{Objects, UNSEEN};
pub use tables::{sums, table};

use crate::actions::ActionFaults;
use crate::bench::{Bench, TrialObserver};
use crate::outcome::FailureSort;
use crate::planners::Timed;
use crate::setup;

/// Result of a case.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Trial {
    /// The case.
    #[serde(skip)]
    pub case: Case,
    /// True if the goal held at the end.
    pub is_reached: bool,
    /// The kinds of the problems that were put to the person.
    pub asked: Vec<Kind>,
    /// True if every failure of the case was put to the person as what it is.
    pub is_explained: bool,
    /// Faults of the actions, counted from the journals.
    pub faults: ActionFaults,
    /// Sort of the failure, where the goal was not reached.
    pub failed_by: Option<FailureSort>,
    /// Its end, where it is not done.
    pub note: Option<String>,
    /// Time for the words: which things are meant.
    pub vision: Duration,
    /// Time for the checks of what is feasible.
    pub feasibility: Duration,
    /// Time for the plan.
    pub planner: Duration,
}

/// Answers from a list.
struct Scripted {
    answers: Vec<(Kind, String)>,
    asked: Vec<Kind>,
    questions: Vec<String>,
}

impl Person for Scripted {
    fn ask(&mut self, problem: &Problem) -> Option<String> {
        self.asked.push(problem.kind);
        self.questions.push(problem.question.clone());
        let next = self.answers.iter().position(|(kind, _)| *kind == problem.kind)?;
        Some(self.answers.remove(next).1)
    }
}

/// Carries out a case with a seed.
///
/// # Errors
///
/// The driver does not start, or a journal cannot be read.
pub fn run(bench: &Bench, case: Case, seed: u64) -> Result<Trial, String> {
    let robot = setup::robot(&case.robot);
    let told = case.told(setup::scene(&case.scene));
    let real = case.real(&told);
    let faults = Faults::from_json(&case.faults()).map_err(|error| error.to_string())?;
    let mut robot_in = bench.robot(&robot, (&told, &real), seed, faults)?;
    let geometry = bench.geometry(&case.robot, &told);
    let setting =
        DialogueSetup { robot, scene: told, domains: Vec::new(), geometry, options: CheckOptions::default() };
    let mut talk = bench.sighted(Conversation::new(&setting), &robot_in);
    let mut person = Scripted { answers: case.answers(), asked: Vec::new(), questions: Vec::new() };
    let mut planner = Timed::new(bench.planner.make()?);
    let mut observer = TrialObserver::new(None)?;
    let driver = robot_in.driver();
    let (outcome, _) =
        talk.carry_out(&case.request, &mut planner, driver, &mut person, &mut observer, Time::ZERO);
    let mut holds = |(fluent, args): &(String, Vec<String>)| {
        let args: Vec<&str> = args.iter().map(String::as_str).collect();
        robot_in.holds(fluent, &args)
    };
    let is_true = case.goal.iter().all(&mut holds) && !case.undo.iter().any(&mut holds);
    let is_reached = is_true && outcome == Outcome::Done;
    let is_explained = case.failures.iter().all(|kind| person.asked.contains(kind));
    let note = (!is_reached).then(|| match &outcome {
        Outcome::Failed(problem) => format!("{}: {}", problem.kind.name(), problem.question),
        other => format!("{other:?}, asked {:?}", person.questions),
    });
    let problem = if let Outcome::Failed(problem) = &outcome { Some(problem.kind) } else { None };
    // The end of the conversation says more than an injected failure before it.
    let last = problem.map(FailureSort::of_problem).or(observer.failures.0.last().copied());
    Ok(Trial {
        is_reached,
        asked: person.asked,
        is_explained,
        faults: observer.journals.faults()?,
        failed_by: (!is_reached).then_some(last.unwrap_or(FailureSort::Planning)),
        note,
        vision: planner.words,
        feasibility: planner.check,
        planner: planner.plan,
        case,
    })
}

/// All cases of a wordings file.
///
/// # Errors
///
/// The reason of [`run`].
pub fn trials(bench: &Bench, wordings: &str, objects: Objects) -> Result<Vec<Trial>, String> {
    let mut cases = cases(wordings, objects);
    cases.retain(|case| {
        let failures = case.failures.iter().map(|kind| kind.name());
        let words = [case.robot.as_str(), &case.scene, &case.request].into_iter().chain(failures);
        bench.asks_for(&words.collect::<Vec<_>>())
    });
    let seeded: Vec<_> = cases.into_iter().enumerate().step_by(bench.every.max(1)).collect();
    let shard = bench.workers.shard;
    let own =
        seeded.iter().enumerate().filter(|(place, _)| shard.has(*place)).map(|(_, (_, case))| case.clone());
    let own: Vec<_> = own.collect();
    let mut trials = bench.workers.spread_kept(seeded, |(index, case)| run(bench, case, index as u64))?;
    for (trial, case) in trials.iter_mut().zip(own) {
        // A trial that an earlier call has kept is without it.
        trial.case = case;
    }
    Ok(trials)
}
