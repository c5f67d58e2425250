//! Lines that people type and policies that models write while a robot moves: the loop of the run goes on
//! while they are read and checked.

use std::time::Duration;

use motet_compiler::CheckOptions;
use motet_planner::builtin::{PlanError, PlannedRequest};
use motet_planner::dialogue::{Conversation, DialogueObserver, DialogueSetup, NoOperator, Outcome};
use motet_planner::runtime_check::CheckMode;
use motet_planner::{Builtin, PlanRequest, Planner, RemainingSteps, Wait};
use motet_runtime::{RunControl, SwapRefusal, Time};
use motet_sim::{Sim, SimOptions};
use motet_tests::setup;

fn setting() -> DialogueSetup {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    DialogueSetup { robot, scene, domains: Vec::new(), geometry: None, options: CheckOptions::default() }
}

/// Somebody who types a line while the robot moves, and counts how often the loop of the run comes round
/// before something follows from it.
#[derive(Default)]
struct Typist {
    line: Option<String>,
    is_said: bool,
    rounds: usize,
    swaps: usize,
    answers: Vec<Option<String>>,
}

impl Typist {
    fn new(line: &str) -> Self {
        Self { line: Some(line.to_owned()), ..Self::default() }
    }
}

impl DialogueObserver for Typist {
    fn verifies(&self) -> CheckMode {
        CheckMode::Background
    }

    fn at_least_every(&self) -> Time {
        Time::from_secs(0.02)
    }

    fn reached(&mut self, _now: Time) -> RunControl {
        // A real robot takes its time.
        std::thread::sleep(Duration::from_millis(1));
        self.rounds += usize::from(self.is_said && self.swaps == 0 && self.answers.is_empty());
        RunControl::Continue
    }

    fn request(&mut self, now: Time) -> Option<String> {
        let line = self.line.take_if(|_| now >= Time::from_secs(2.0))?;
        self.is_said = true;
        Some(line)
    }

    fn answered(&mut self, _question: &str, answer: Option<&str>) {
        self.answers.push(answer.map(str::to_owned));
    }

    fn swapped(&mut self, _now: Time, _refusal: Option<&SwapRefusal>) {
        self.swaps += 1;
    }
}

/// Planner with a model that has written its reply at once.
struct Written(String);

impl Planner for Written {
    fn plan(&mut self, ask: &PlanRequest<'_>) -> Result<PlannedRequest, PlanError> {
        Builtin.plan(ask)
    }

    fn begin(&mut self, _ask: &PlanRequest<'_>) -> bool {
        true
    }

    fn rest(&mut self, _wait: Wait) -> RemainingSteps {
        if self.0.is_empty() {
            return RemainingSteps::Nothing;
        }
        RemainingSteps::Whole(std::mem::take(&mut self.0))
    }
}

fn carried_out(planner: &mut dyn Planner, line: &str) -> (Outcome, Typist) {
    let setting = setting();
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
    let (mut talk, mut typist) = (Conversation::new(&setting), Typist::new(line));
    let request = "bring me the coke";
    let (outcome, _) = talk.carry_out(request, planner, &mut sim, &mut NoOperator, &mut typist, Time::ZERO);
    (outcome, typist)
}

#[test]
fn beside_a_run_goes_on_while_a_line_is_read() {
    let line = format!("bring {}", "<a>".repeat(500));
    let (outcome, typist) = carried_out(&mut Builtin, &line);
    assert!(typist.rounds > 5, "the loop came round {} times", typist.rounds);
    // It is no request that anybody understands, so the robot stops and asks.
    assert!(matches!(outcome, Outcome::Failed(_)), "{outcome:?}");
}

#[test]
fn beside_a_run_goes_on_while_a_reply_is_checked() {
    let monitor = "monitor when distance(user) < 0.3 m for 1 s then resume at most 2 { say(\"Hello.\") } \
                   during { go(counter) go(sink) }\n";
    let reply = format!("policy watch for hsr {{\n{}}}\n", monitor.repeat(40));
    let (outcome, typist) = carried_out(&mut Written(reply), "bring me the apple instead");
    assert!(typist.rounds > 5, "the loop came round {} times", typist.rounds);
    // Either it takes over, or it is no policy and the robot plans the request anew.
    assert!(typist.swaps == 1 || outcome == Outcome::Done, "{outcome:?}");
}

#[test]
fn beside_a_run_a_question_is_answered_and_a_request_takes_over() {
    let (outcome, typist) = carried_out(&mut Builtin, "where is the apple?");
    assert_eq!((outcome, typist.swaps, typist.answers.len()), (Outcome::Done, 0, 1));
    assert!(
        typist.answers[0].as_ref().is_some_and(|answer| answer.contains("kitchen table")),
        "{:?}",
        typist.answers
    );
    let (outcome, typist) = carried_out(&mut Builtin, "bring me the apple instead");
    assert_eq!((outcome, typist.swaps), (Outcome::Done, 1));
}
