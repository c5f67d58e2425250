//! Driver that lets somebody answer the questions of a policy, and leaves everything else to the robot's
//! driver. The run goes on while a question is open: monitors watch, deadlines count, and it can be stopped.

use std::collections::VecDeque;
use std::thread;
use std::time::Duration;

use motet_graph::{Graph, Value};
use motet_runtime::{Capabilities, Command, Driver, DriverEvent, GoalId, Outcome, Query, Time};
use motet_stdlib::lang::primitives;
use smol_str::SmolStr;

use crate::flags::Speed;
use crate::run_view::Clock;

/// Span after which it is looked whether an answer has come.
const SLICE: Time = Time::from_nanos(50_000_000);

/// Question of a policy.
#[derive(Clone, Debug)]
pub(crate) struct Question {
    pub(crate) goal: GoalId,
    pub(crate) text: SmolStr,
    /// Things to choose from; `None` if any text is an answer.
    pub(crate) options: Option<Vec<SmolStr>>,
}

impl Question {
    /// Question of a command; `None` for other commands.
    fn of(goal: GoalId, command: &Command) -> Option<Self> {
        let Some(Value::Text(text)) = command.arg("question") else { return None };
        let options = options(command);
        let is_question = options.is_some() || command.primitive == primitives::ASK;
        is_question.then(|| Self { goal, text: text.clone(), options })
    }
}

/// Things among which a command lets a person choose; none for other commands.
fn options(command: &Command) -> Option<Vec<SmolStr>> {
    let among = command.arg("among").filter(|_| command.primitive == primitives::CHOOSE);
    let Some(Value::List(among)) = among else { return None };
    let id = |value: &Value| if let Value::Entity(id) = value { Some(id.clone()) } else { None };
    among.iter().map(id).collect()
}

/// True if the time of a run jumps from one event to the next.
pub(crate) fn jumps(speed: Speed, clock: Clock) -> bool {
    speed == Speed::Max && clock == Clock::Simulated
}

/// Capabilities of a driver beside which somebody answers questions.
pub(crate) fn answering(can: Capabilities) -> Capabilities {
    Capabilities { primitives: can.primitives.with([primitives::ASK, primitives::CHOOSE]), ..can }
}

/// A person or a program that answers questions, one at a time.
pub(crate) trait Answerer {
    /// Begins to ask a question.
    fn ask(&mut self, question: &Question);
    /// Outcome of the question that was asked, once it is answered.
    fn outcome(&mut self, question: &Question) -> Option<Outcome>;
    /// The question is not asked any more.
    fn withdraw(&mut self);
}

/// Driver with somebody who answers `ask` and `choose`.
pub(crate) struct QuestionDriver<'a, A> {
    driver: &'a mut dyn Driver,
    answerer: A,
    /// True if time jumps: an open question then holds it to the clock on the wall.
    jumps: bool,
    now: Time,
    /// Open questions with whether they are held, the oldest first. The first one is asked.
    open: VecDeque<(Question, bool)>,
    outbox: VecDeque<DriverEvent>,
}

impl<'a, A: Answerer> QuestionDriver<'a, A> {
    /// Driver for a run that begins at a time.
    pub(crate) fn new(driver: &'a mut dyn Driver, answerer: A, now: Time, jumps: bool) -> Self {
        Self { driver, answerer, jumps, now, open: VecDeque::new(), outbox: VecDeque::new() }
    }

    fn at(&mut self, now: Time) {
        self.now = self.now.max(now);
    }

    /// Number of an open question.
    fn index(&self, goal: GoalId) -> Option<usize> {
        self.open.iter().position(|(question, _)| question.goal == goal)
    }

    /// Takes a question away, and asks the next one.
    fn remove(&mut self, index: usize, is_answered: bool) {
        self.open.remove(index);
        if index > 0 {
            return;
        }
        if !is_answered {
            self.answerer.withdraw();
        }
        if let Some((next, _)) = self.open.front() {
            self.answerer.ask(next);
        }
    }

    /// Ends an open question by an event. `false` if the goal is none.
    fn end(&mut self, goal: GoalId, event: DriverEvent) -> bool {
        let Some(index) = self.index(goal) else { return false };
        self.outbox.push_back(event);
        self.remove(index, false);
        true
    }

    /// Holds an open question, or lets it go on. `false` if the goal is none.
    fn set_held(&mut self, goal: GoalId, is_held: bool) -> bool {
        let question = self.open.iter_mut().find(|(question, _)| question.goal == goal);
        question.map(|(_, held)| *held = is_held).is_some()
    }

    /// Event that follows from the answer, if it has come.
    fn answered(&mut self) -> Option<DriverEvent> {
        let (question, is_held) = self.open.front()?;
        let outcome = if *is_held { None } else { self.answerer.outcome(question) }?;
        let goal = question.goal;
        self.remove(0, true);
        Some(DriverEvent::Ended { goal, outcome })
    }
}

impl<A: Answerer> Driver for QuestionDriver<'_, A> {
    fn start(&mut self, now: Time, goal: GoalId, command: &Command) {
        self.at(now);
        let Some(question) = Question::of(goal, command) else {
            return self.driver.start(now, goal, command);
        };
        if self.open.is_empty() {
            self.answerer.ask(&question);
        }
        self.open.push_back((question, false));
        self.outbox.push_back(DriverEvent::Acknowledged { goal });
    }

    fn begin_run(&mut self, now: Time, run: &str, graph: Option<&Graph>) -> Time {
        // Goals of the run before have the same numbers.
        if !self.open.is_empty() {
            self.answerer.withdraw();
        }
        (self.open, self.outbox) = (VecDeque::new(), VecDeque::new());
        self.now = self.driver.begin_run(now, run, graph);
        self.now
    }

    fn cancel(&mut self, now: Time, goal: GoalId) {
        self.at(now);
        if !self.end(goal, DriverEvent::Ended { goal, outcome: Outcome::Interrupted }) {
            self.driver.cancel(now, goal);
        }
    }

    fn hold(&mut self, now: Time, goal: GoalId) {
        if !self.set_held(goal, true) {
            self.driver.hold(now, goal);
        }
    }

    fn proceed(&mut self, now: Time, goal: GoalId) {
        if !self.set_held(goal, false) {
            self.driver.proceed(now, goal);
        }
    }

    fn safe_stop(&mut self, now: Time, goal: GoalId) {
        self.at(now);
        if !self.end(goal, DriverEvent::Stopped { goal }) {
            self.driver.safe_stop(now, goal);
        }
    }

    fn capabilities(&self) -> Capabilities {
        answering(self.driver.capabilities())
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
            let slice = if self.open.is_empty() { until } else { until.min(self.now.after(SLICE)) };
            if let Some((at, event)) = self.driver.advance(slice) {
                self.at(at);
                return Some((at, event));
            }
            if slice != Time::NEVER {
                self.at(slice);
            }
            if self.jumps && !self.open.is_empty() {
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

#[cfg(test)]
mod tests {
    use std::cell::RefCell;
    use std::rc::Rc;

    use super::*;

    /// Robot that ends a motion after a second.
    #[derive(Default)]
    struct Robot {
        ends: Option<(Time, GoalId)>,
    }

    impl Driver for Robot {
        fn start(&mut self, now: Time, goal: GoalId, _command: &Command) {
            self.ends = Some((now.after(Time::from_secs(1.0)), goal));
        }

        fn advance(&mut self, until: Time) -> Option<(Time, DriverEvent)> {
            let (at, goal) = self.ends.take_if(|(at, _)| *at <= until)?;
            Some((at, DriverEvent::Ended { goal, outcome: Outcome::Success(None) }))
        }

        fn cancel(&mut self, _now: Time, _goal: GoalId) {}
        fn update(&mut self, _now: Time, _goal: GoalId, _command: &Command) {}
        fn hold(&mut self, _now: Time, _goal: GoalId) {}
        fn proceed(&mut self, _now: Time, _goal: GoalId) {}
        fn safe_stop(&mut self, _now: Time, _goal: GoalId) {}
        fn observe(&mut self, _now: Time, _query: &Query) {}
        fn watch(&mut self, _now: Time, _query: &Query) {}
        fn unwatch(&mut self, _now: Time, _query: &Query) {}
    }

    /// Questions that were asked or withdrawn, and the answer to give.
    #[derive(Default)]
    struct Said {
        heard: Vec<String>,
        answer: Option<&'static str>,
    }

    struct Person(Rc<RefCell<Said>>);

    impl Answerer for Person {
        fn ask(&mut self, question: &Question) {
            self.0.borrow_mut().heard.push(question.text.to_string());
        }

        fn outcome(&mut self, _question: &Question) -> Option<Outcome> {
            let answer = self.0.borrow_mut().answer.take()?;
            Some(Outcome::Success(Some(Value::Text(answer.into()))))
        }

        fn withdraw(&mut self) {
            self.0.borrow_mut().heard.push("withdrawn".to_owned());
        }
    }

    fn command(primitive: &str, args: Vec<(SmolStr, Value)>) -> Command {
        let uses = [].into();
        let primitive = primitive.into();
        Command {
            primitive,
            args,
            uses,
            manner: None,
            deadline_secs: 60.0,
            motions: Vec::new(),
            leaves: None,
        }
    }

    fn ask(text: &str) -> Command {
        command(primitives::ASK, vec![("question".into(), Value::Text(text.into()))])
    }

    fn goal(number: u64) -> GoalId {
        GoalId::from_number(number)
    }

    #[test]
    fn robot_moves_on_while_a_question_is_open() {
        let (mut robot, said) = (Robot::default(), Rc::<RefCell<Said>>::default());
        let mut driver = QuestionDriver::new(&mut robot, Person(Rc::clone(&said)), Time::ZERO, false);
        driver.start(Time::ZERO, goal(1), &command("go", Vec::new()));
        driver.start(Time::ZERO, goal(2), &ask("May I?"));
        let acknowledged = driver.advance(Time::from_secs(9.0));
        assert_eq!(acknowledged, Some((Time::ZERO, DriverEvent::Acknowledged { goal: goal(2) })));
        let (at, ended) = driver.advance(Time::from_secs(9.0)).unwrap();
        assert_eq!((at, ended.goal()), (Time::from_secs(1.0), Some(goal(1))));
        assert_eq!(driver.advance(Time::from_secs(3.0)), None);
        said.borrow_mut().answer = Some("yes");
        let (at, ended) = driver.advance(Time::from_secs(9.0)).unwrap();
        assert_eq!((at, ended.goal()), (Time::from_secs(3.0), Some(goal(2))));
    }

    #[test]
    fn questions_are_asked_one_after_the_other() {
        let (mut robot, said) = (Robot::default(), Rc::<RefCell<Said>>::default());
        let mut driver = QuestionDriver::new(&mut robot, Person(Rc::clone(&said)), Time::ZERO, false);
        ["One?", "Two?", "Three?"].iter().zip(1..).for_each(|(text, number)| {
            driver.start(Time::ZERO, goal(number), &ask(text));
        });
        assert_eq!(said.borrow().heard, ["One?"]);
        driver.cancel(Time::ZERO, goal(2));
        driver.safe_stop(Time::ZERO, goal(1));
        assert_eq!(said.borrow().heard, ["One?", "withdrawn", "Three?"]);
        said.borrow_mut().answer = Some("yes");
        driver.hold(Time::ZERO, goal(3));
        let events: Vec<_> = std::iter::from_fn(|| driver.advance(Time::from_secs(1.0))).collect();
        let interrupted = DriverEvent::Ended { goal: goal(2), outcome: Outcome::Interrupted };
        assert_eq!(
            events[3..].iter().map(|(_, event)| event.clone()).collect::<Vec<_>>(),
            [interrupted, DriverEvent::Stopped { goal: goal(1) }]
        );
        driver.proceed(Time::from_secs(1.0), goal(3));
        let (_, ended) = driver.advance(Time::from_secs(2.0)).unwrap();
        assert_eq!(ended.goal(), Some(goal(3)));
        assert_eq!(said.borrow().heard.len(), 3);
    }
}
