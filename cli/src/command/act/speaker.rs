//! A robot with a person before it: what it asks, it asks them.

use std::collections::VecDeque;
use std::rc::Rc;

use motet_graph::Value;
use motet_planner::dialogue::{Kind, Person as _, Problem};
use motet_runtime::{Capabilities, Command, Driver, DriverEvent, GoalId, Outcome, Query, Time};

use super::model::printable;
use super::person::{Asked, Asking};

/// Answers `ask` itself, and leaves everything else to the robot's driver.
pub(super) struct Speaker<'a> {
    driver: &'a mut dyn Driver,
    person: Asking,
    /// What is to be reported of questions, which are answered at once.
    outbox: VecDeque<(Time, DriverEvent)>,
}

impl<'a> Speaker<'a> {
    pub(super) fn new(driver: &'a mut dyn Driver, asked: Rc<Asked>) -> Self {
        Self { driver, person: Asking(asked), outbox: VecDeque::new() }
    }
}

impl Driver for Speaker<'_> {
    fn start(&mut self, now: Time, goal: GoalId, command: &Command) {
        let question = match command.arg("question") {
            Some(Value::Text(question)) if command.primitive == "ask" => printable(question),
            _ => return self.driver.start(now, goal, command),
        };
        let problem =
            Problem { kind: Kind::AmbiguousTask, question, options: Vec::new(), about: None, said: None };
        let outcome = match self.person.ask(&problem) {
            Some(answer) => Outcome::Success(Some(Value::Text(answer.into()))),
            None => Outcome::Failure("refused".into()),
        };
        self.outbox.push_back((now, DriverEvent::Acknowledged { goal }));
        self.outbox.push_back((now, DriverEvent::Ended { goal, outcome }));
    }

    fn cancel(&mut self, now: Time, goal: GoalId) {
        self.driver.cancel(now, goal);
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

    fn hold(&mut self, now: Time, goal: GoalId) {
        self.driver.hold(now, goal);
    }

    fn proceed(&mut self, now: Time, goal: GoalId) {
        self.driver.proceed(now, goal);
    }

    fn safe_stop(&mut self, now: Time, goal: GoalId) {
        self.driver.safe_stop(now, goal);
    }

    fn observe(&mut self, now: Time, query: &Query) {
        self.driver.observe(now, query);
    }

    fn watch(&mut self, now: Time, query: &Query) {
        self.driver.watch(now, query);
    }

    fn unwatch(&mut self, now: Time, query: &Query) {
        self.driver.unwatch(now, query);
    }

    fn advance(&mut self, until: Time) -> Option<(Time, DriverEvent)> {
        self.outbox.pop_front().or_else(|| self.driver.advance(until))
    }
}
