//! Driver that lets a client answer the questions of a policy, and leaves everything else to the robot's
//! driver. The run goes on while a question is open: monitors watch, deadlines count, and it can be stopped.

use std::collections::VecDeque;
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use motet_graph::Value;
use motet_runtime::{Capabilities, Command, Driver, DriverEvent, GoalId, Outcome, Query, Time};
use motet_stdlib::lang::{failures, primitives};
use smol_str::SmolStr;

use super::run_table::{GivenAnswer, RunTable};

/// Span after which it is looked whether an answer has come.
const SLICE: Time = Time::from_nanos(50_000_000);

/// Question that waits for its answer.
struct OpenGoal {
    goal: GoalId,
    /// True if the answer is one of the things to choose from.
    is_choice: bool,
    is_held: bool,
}

/// Driver that answers `ask` and `choose` by the run table.
pub(super) struct QuestionDriver<'a> {
    driver: &'a mut dyn Driver,
    runs: Arc<RunTable>,
    run: String,
    /// True if time jumps: an open question then holds it to the clock on the wall.
    jumps: bool,
    now: Time,
    open: Option<OpenGoal>,
    outbox: VecDeque<DriverEvent>,
}

impl<'a> QuestionDriver<'a> {
    /// Driver for a run that begins at a time.
    pub(super) fn new(
        driver: &'a mut dyn Driver,
        (runs, run): (&Arc<RunTable>, &str),
        now: Time,
        jumps: bool,
    ) -> Self {
        let (runs, run, outbox) = (Arc::clone(runs), run.to_owned(), VecDeque::new());
        Self { driver, runs, run, jumps, now, open: None, outbox }
    }

    fn at(&mut self, now: Time) {
        self.now = self.now.max(now);
    }

    /// True if a goal is the open question.
    fn is_open(&self, goal: GoalId) -> bool {
        self.open.as_ref().is_some_and(|open| open.goal == goal)
    }

    /// Withdraws the open question, and reports this of it.
    fn end(&mut self, event: DriverEvent) {
        self.open = None;
        self.runs.withdraw(&self.run);
        self.outbox.push_back(event);
    }

    /// Event that follows from the answer, if it has come.
    fn answered(&mut self) -> Option<DriverEvent> {
        let open = self.open.as_ref().filter(|open| !open.is_held)?;
        let (goal, is_choice) = (open.goal, open.is_choice);
        let answer = self.runs.take_answer(&self.run)?;
        self.open = None;
        Some(DriverEvent::Ended { goal, outcome: outcome(answer, is_choice) })
    }
}

fn outcome(answer: GivenAnswer, is_choice: bool) -> Outcome {
    match answer {
        None => Outcome::Failure(SmolStr::new_static(failures::REFUSED).into()),
        Some(id) if is_choice => Outcome::Success(Some(Value::Entity(id.into()))),
        Some(text) => Outcome::Success(Some(Value::Text(text.into()))),
    }
}

/// Things among which a command lets a person choose; none for other commands.
fn options(command: &Command) -> Option<Vec<String>> {
    let among = command.arg("among").filter(|_| command.primitive == primitives::CHOOSE);
    let Some(Value::List(among)) = among else { return None };
    let id = |value: &Value| if let Value::Entity(id) = value { Some(id.to_string()) } else { None };
    among.iter().map(id).collect()
}

impl Driver for QuestionDriver<'_> {
    fn start(&mut self, now: Time, goal: GoalId, command: &Command) {
        self.at(now);
        let question = match command.arg("question") {
            Some(Value::Text(question)) => question.clone(),
            _ => return self.driver.start(now, goal, command),
        };
        let options = options(command);
        if options.is_none() && command.primitive != primitives::ASK {
            return self.driver.start(now, goal, command);
        }
        let is_choice = options.is_some();
        self.runs.ask(&self.run, &question, &options.unwrap_or_default());
        self.open = Some(OpenGoal { goal, is_choice, is_held: false });
        self.outbox.push_back(DriverEvent::Acknowledged { goal });
    }

    fn cancel(&mut self, now: Time, goal: GoalId) {
        self.at(now);
        if self.is_open(goal) {
            self.end(DriverEvent::Ended { goal, outcome: Outcome::Interrupted });
        } else {
            self.driver.cancel(now, goal);
        }
    }

    fn hold(&mut self, now: Time, goal: GoalId) {
        match &mut self.open {
            Some(open) if open.goal == goal => open.is_held = true,
            _ => self.driver.hold(now, goal),
        }
    }

    fn proceed(&mut self, now: Time, goal: GoalId) {
        match &mut self.open {
            Some(open) if open.goal == goal => open.is_held = false,
            _ => self.driver.proceed(now, goal),
        }
    }

    fn safe_stop(&mut self, now: Time, goal: GoalId) {
        self.at(now);
        if self.is_open(goal) {
            self.end(DriverEvent::Stopped { goal });
        } else {
            self.driver.safe_stop(now, goal);
        }
    }

    fn capabilities(&self) -> Capabilities {
        self.driver.capabilities()
    }

    fn base(&self) -> Option<[f64; 3]> {
        self.driver.base()
    }

    fn update(&mut self, now: Time, goal: GoalId, command: &Command) {
        self.driver.update(now, goal, command);
    }

    fn observe(&mut self, now: Time, query: &Query) {
        self.at(now);
        self.driver.observe(now, query);
    }

    fn watch(&mut self, now: Time, query: &Query) {
        self.at(now);
        self.driver.watch(now, query);
    }

    fn unwatch(&mut self, now: Time, query: &Query) {
        self.driver.unwatch(now, query);
    }

    fn advance(&mut self, until: Time) -> Option<(Time, DriverEvent)> {
        loop {
            if let Some(event) = self.outbox.pop_front().or_else(|| self.answered()) {
                return Some((self.now, event));
            }
            // Without an open question, time passes as the driver lets it.
            let slice = if self.open.is_some() { until.min(self.now.after(SLICE)) } else { until };
            if let Some((at, event)) = self.driver.advance(slice) {
                self.at(at);
                return Some((at, event));
            }
            if slice != Time::NEVER {
                self.at(slice);
            }
            if self.jumps && self.open.is_some() {
                thread::sleep(Duration::from_nanos(SLICE.nanos()));
            }
            if slice == until {
                return None;
            }
        }
    }

    fn inner(&mut self) -> Option<&mut dyn Driver> {
        Some(&mut *self.driver)
    }
}
