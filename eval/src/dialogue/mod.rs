//! InteLiPlan's protocol in simulation: commands in many wordings, with and without failures of each kind,
//! one and two rounds of recovery, on two robots, carried out by the planner that needs no model.
//!
//! A case is made from a line of a wordings file, which knows a task and the words for it, and from a room,
//! which knows what there is. The planner sees the words alone; the goal is looked at only to judge the end.

mod cases;
mod tables;

use std::time::{Duration, Instant};

use motet_compiler::CheckOptions;
use motet_planner::builtin::{PlanError, PlannedRequest};
use motet_planner::dialogue::{Conversation, DialogueSetup, Kind, Outcome, Person, Problem};
use motet_planner::{Builtin, PlanRequest, Planner};
use motet_runtime::Time;
use motet_sim::{Faults, Sim, SimOptions};

pub use cases::{Case, cases};
pub use tables::{sums, table};

use crate::setup;

/// Result of a case.
#[derive(Clone, Debug)]
pub struct Trial {
    /// The case.
    pub case: Case,
    /// True if the goal held at the end.
    pub is_reached: bool,
    /// The kinds of the problems that were put to the person.
    pub asked: Vec<Kind>,
    /// True if every failure of the case was put to the person as what it is.
    pub is_explained: bool,
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

/// The planner with a watch.
#[derive(Default)]
struct Timed {
    words: Duration,
    check: Duration,
    plan: Duration,
}

impl Planner for Timed {
    fn plan(&mut self, ask: &PlanRequest<'_>) -> Result<PlannedRequest, PlanError> {
        let begin = Instant::now();
        let _ = motet_requests::understand(ask.request, ask.situation);
        self.words += begin.elapsed();
        let begin = Instant::now();
        let answered = Builtin.plan(ask);
        let took = begin.elapsed();
        // What the plan took, without the words and the check that come with it.
        let begin = Instant::now();
        if let Ok(answered) = &answered {
            let _ = ask.session.compile(&answered.planned.parsed, None);
        }
        let check = begin.elapsed();
        self.check += check;
        self.plan += took.saturating_sub(check);
        answered
    }
}

/// Carries out a case.
#[must_use]
pub fn run(case: Case) -> Trial {
    let robot = setup::robot(&case.robot);
    let told = case.told(setup::scene(&case.scene));
    let real = case.real(&told);
    let faults = Faults::from_json(&case.faults()).unwrap_or_default();
    let mut sim = Sim::new(&robot, &real, SimOptions { faults, ..SimOptions::default() });
    let setting = DialogueSetup {
        robot,
        scene: told,
        domains: Vec::new(),
        geometry: None,
        options: CheckOptions::default(),
    };
    let mut talk = Conversation::new(&setting);
    let mut person = Scripted { answers: case.answers(), asked: Vec::new(), questions: Vec::new() };
    let mut planner = Timed::default();
    let (outcome, _) =
        talk.carry_out(&case.request, &mut planner, &mut sim, &mut person, &mut (), Time::ZERO);
    let is_reached = case.goal.iter().all(|(fluent, args)| {
        let args: Vec<&str> = args.iter().map(String::as_str).collect();
        sim.holds(fluent, &args) == Some(true)
    }) && case.undo.iter().all(|(fluent, args)| {
        let args: Vec<&str> = args.iter().map(String::as_str).collect();
        sim.holds(fluent, &args) == Some(false)
    });
    let is_explained = case.failures.iter().all(|kind| person.asked.contains(kind));
    let note = (!is_reached || outcome != Outcome::Done).then(|| match &outcome {
        Outcome::Failed(problem) => format!("{}: {}", problem.kind.name(), problem.question),
        other => format!("{other:?}, asked {:?}", person.questions),
    });
    Trial {
        is_reached: is_reached && outcome == Outcome::Done,
        asked: person.asked,
        is_explained,
        note,
        vision: planner.words,
        feasibility: planner.check,
        planner: planner.plan,
        case,
    }
}
