//! Driver whose `ground` asks a model. The question runs on a thread of its own: the engine and the
//! simulation continue, and simulated time is no faster than the clock while an answer is awaited.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::time::{Duration, Instant};

use motet_graph::{CallNode, Graph, NodeKind, Pose, Term, Value};
use motet_robots::scene::Scene;
use motet_runtime::{
    Capabilities, Command, Driver, DriverEvent, FailureReport, GoalId, Outcome, Perception, Query, RgbdView,
    Time,
};
use motet_stdlib::lang::{failures, primitives};
use smol_str::SmolStr;

use super::ground::{NoPoint, Pointer, Purpose, ground};

/// Primitive that this driver answers itself.
const GROUND: &str = primitives::GROUND;
/// Waiting time for an answer before the simulation advances.
const SLICE: Duration = Duration::from_millis(5);

/// Result of a question for a point.
#[derive(Clone, Copy, Debug)]
pub struct GroundedPoint<'a> {
    pub object: &'a SmolStr,
    /// Purpose of the point.
    pub used_for: &'a SmolStr,
    /// The pose, or the reason why there is none.
    pub found: &'a Result<Pose, NoPoint>,
}

/// Driver with a pointer beside it. It keeps the laws of the inner driver, with one exception to the sixth:
/// the time of an answer depends on the pointer.
pub struct GroundingDriver<'d> {
    driver: &'d mut dyn Driver,
    eyes: &'d mut dyn Perception,
    scene: &'d Scene,
    listener: Box<dyn FnMut(GroundedPoint<'_>) + 'd>,
    questions: Sender<Question>,
    answers: Receiver<(u64, Result<Pose, NoPoint>)>,
    task: Rc<RefCell<GroundingTask>>,
    /// Open questions by goal.
    asked: BTreeMap<GoalId, PendingGoal>,
    /// Goals that the inner driver never saw.
    own: BTreeSet<GoalId>,
    /// Number of questions so far.
    count: u64,
    outbox: VecDeque<(Time, DriverEvent)>,
    now: Time,
}

/// Task of the robot, for the questions about points.
#[derive(Clone, Debug, Default)]
pub struct GroundingTask {
    /// The request that it carries out.
    pub instruction: String,
    /// The policy that runs.
    pub graph: Option<Arc<Graph>>,
}

impl GroundingTask {
    fn purpose(&self, name: String, object: &SmolStr, used_for: &str) -> Purpose {
        let next = self.graph.as_ref().and_then(|graph| next_call(graph, object)).unwrap_or_default();
        let instruction = self.instruction.clone();
        Purpose { object: name, used_for: used_for.to_owned(), instruction, next }
    }
}

/// Call behind the first `ground` of an object, in the order of the policy.
fn next_call(graph: &Graph, object: &SmolStr) -> Option<String> {
    let mut calls = graph.nodes.iter().filter_map(|node| match &node.kind {
        NodeKind::Call(call) => Some(call),
        _ => None,
    });
    let name =
        |call: &CallNode| graph.primitives.get(call.primitive.index()).map(|primitive| &primitive.name);
    let is_object = |arg: &Term| match arg {
        Term::Literal(Value::Entity(id)) => id == object,
        // A binding may stand for it.
        Term::Binding(_) => true,
        _ => false,
    };
    calls.find(|call| name(call).is_some_and(|name| name == GROUND) && call.args.iter().any(is_object))?;
    let next = calls.next()?;
    let args = next.args.iter().filter_map(|arg| match arg {
        Term::Literal(value) => Some(value.to_string()),
        Term::Binding(id) => graph.bindings.get(id.index()).map(|binding| binding.name.to_string()),
        _ => None,
    });
    Some(format!("{}({})", name(next)?, args.collect::<Vec<_>>().join(", ")))
}

/// A question in transit.
struct Question {
    number: u64,
    view: RgbdView,
    purpose: Purpose,
    is_wanted: Arc<AtomicBool>,
}

/// A goal that waits for an answer.
struct PendingGoal {
    number: u64,
    object: SmolStr,
    used_for: SmolStr,
    /// Times of the question, in the simulation and by the clock.
    at: Time,
    clock: Instant,
    is_wanted: Arc<AtomicBool>,
}

impl Drop for PendingGoal {
    fn drop(&mut self) {
        self.is_wanted.store(false, Ordering::Relaxed);
    }
}

impl<'d> GroundingDriver<'d> {
    /// Puts a pointer beside a driver. The pointer's thread ends after the driver, once its last question is
    /// answered.
    #[must_use]
    pub fn new(
        driver: &'d mut dyn Driver,
        eyes: &'d mut dyn Perception,
        scene: &'d Scene,
        mut pointer: Box<dyn Pointer + Send>,
    ) -> Self {
        let (questions, inbox) = mpsc::channel::<Question>();
        let (replies, answers) = mpsc::channel();
        std::thread::spawn(move || {
            for Question { number, view, purpose, is_wanted } in inbox {
                // It was cancelled before its turn came.
                if !is_wanted.load(Ordering::Relaxed) {
                    continue;
                }
                let found = ground(&mut *pointer, &view, &purpose);
                if replies.send((number, found)).is_err() {
                    return;
                }
            }
        });
        Self {
            driver,
            eyes,
            scene,
            listener: Box::new(|_| {}),
            questions,
            answers,
            task: Rc::default(),
            asked: BTreeMap::new(),
            own: BTreeSet::new(),
            count: 0,
            outbox: VecDeque::new(),
            now: Time::ZERO,
        }
    }

    /// Adds the task that the questions tell, which its owner keeps up to date.
    #[must_use]
    pub fn with_task(self, task: Rc<RefCell<GroundingTask>>) -> Self {
        Self { task, ..self }
    }

    /// Adds a listener for the result of each awaited question.
    #[must_use]
    pub fn with_listener(self, listener: impl FnMut(GroundedPoint<'_>) + 'd) -> Self {
        Self { listener: Box::new(listener), ..self }
    }

    /// Sends a question. Returns `false` if there is no object to ask about.
    fn ask(&mut self, now: Time, goal: GoalId, command: &Command) -> bool {
        let (Some(Value::Entity(object)), Some(Value::Text(used_for))) =
            (command.arg("object"), command.arg("use"))
        else {
            return false;
        };
        let Some(view) = self.eyes.view(now, object) else {
            (self.listener)(GroundedPoint { object, used_for, found: &Err(NoPoint::Unseen) });
            return false;
        };
        self.count += 1;
        let is_wanted = Arc::new(AtomicBool::new(true));
        let question = Question {
            number: self.count,
            view,
            purpose: self.task.borrow().purpose(self.scene.called(object), object, used_for),
            is_wanted: Arc::clone(&is_wanted),
        };
        let (object, used_for) = (object.clone(), used_for.clone());
        let (number, clock) = (self.count, Instant::now());
        self.asked.insert(goal, PendingGoal { number, object, used_for, at: now, clock, is_wanted });
        self.questions.send(question).is_ok()
    }

    fn end(&mut self, at: Time, goal: GoalId, outcome: Outcome) {
        self.asked.remove(&goal);
        self.outbox.push_back((at, DriverEvent::Ended { goal, outcome }));
    }

    /// Takes an answer. An answer that is no longer awaited is dropped.
    fn take(&mut self, number: u64, found: Result<Pose, NoPoint>) {
        let waiting = self.asked.iter().find(|(_, asked)| asked.number == number);
        let Some((goal, asked)) = waiting.map(|(goal, asked)| (*goal, asked)) else { return };
        let at = self.now.max(asked.due());
        (self.listener)(GroundedPoint { object: &asked.object, used_for: &asked.used_for, found: &found });
        let outcome = match found {
            Ok(pose) => Outcome::Success(Some(Value::Pose(pose))),
            Err(why) => Outcome::Failure(FailureReport {
                kind: SmolStr::new_static(why.failure()),
                text: Some(why.to_string().into()),
            }),
        };
        self.end(at, goal, outcome);
    }

    /// Next report that is due by a time.
    fn due(&mut self, until: Time) -> Option<(Time, DriverEvent)> {
        let (at, event) = self.outbox.pop_front()?;
        // The clock is ahead of the world by the length of a slice at most.
        self.now = self.now.max(at.min(until));
        Some((self.now, event))
    }

    /// Lets the inner driver advance.
    fn forward(&mut self, until: Time) -> Option<(Time, DriverEvent)> {
        let event = self.driver.advance(until);
        let reached = event.as_ref().map_or(until, |(at, _)| *at);
        if reached != Time::NEVER {
            self.now = self.now.max(reached);
        }
        event
    }
}

impl PendingGoal {
    /// Latest permitted time of the simulation: as much after the question as the clock.
    fn due(&self) -> Time {
        Time::from_secs(self.at.secs() + self.clock.elapsed().as_secs_f64())
    }
}

impl Driver for GroundingDriver<'_> {
    fn start(&mut self, now: Time, goal: GoalId, command: &Command) {
        if command.primitive != GROUND {
            return self.driver.start(now, goal, command);
        }
        self.now = self.now.max(now);
        self.own.insert(goal);
        self.outbox.push_back((now, DriverEvent::Acknowledged { goal }));
        if !self.ask(now, goal, command) {
            self.end(now, goal, Outcome::Failure(failures::NOT_FOUND.into()));
        }
    }

    fn begin_run(&mut self, now: Time, run: &str, graph: Option<&Graph>) -> Time {
        // Goals of the run before have the same numbers; an answer to one of its questions is dropped.
        self.asked.clear();
        self.own.clear();
        self.outbox.clear();
        self.driver.begin_run(now, run, graph)
    }

    fn cancel(&mut self, now: Time, goal: GoalId) {
        if self.asked.contains_key(&goal) {
            self.end(now, goal, Outcome::Interrupted);
        } else if !self.own.contains(&goal) {
            self.driver.cancel(now, goal);
        }
    }

    fn capabilities(&self) -> Capabilities {
        let can = self.driver.capabilities();
        Capabilities { primitives: can.primitives.with([GROUND]), ..can }
    }

    fn base(&self) -> Option<[f64; 3]> {
        self.driver.base()
    }

    fn update(&mut self, now: Time, goal: GoalId, command: &Command) {
        if !self.own.contains(&goal) {
            return self.driver.update(now, goal, command);
        }
        // The old answer is no longer wanted.
        if self.asked.remove(&goal).is_some() && !self.ask(now, goal, command) {
            self.end(now, goal, Outcome::Failure(failures::NOT_FOUND.into()));
        }
    }

    fn hold(&mut self, now: Time, goal: GoalId) {
        if !self.own.contains(&goal) {
            return self.driver.hold(now, goal);
        }
        // An answer that has come already and was not reported yet does not wait either, and this is said
        // before it.
        let is_end =
            |event: &DriverEvent| matches!(event, DriverEvent::Ended { goal: of, .. } if *of == goal);
        let end = self.outbox.iter().position(|(_, event)| is_end(event));
        if end.is_some() || self.asked.contains_key(&goal) {
            let place = end.unwrap_or(self.outbox.len());
            self.outbox.insert(place, (now, DriverEvent::NotHeld { goal }));
        }
    }

    fn proceed(&mut self, now: Time, goal: GoalId) {
        if !self.own.contains(&goal) {
            self.driver.proceed(now, goal);
        }
    }

    fn safe_stop(&mut self, now: Time, goal: GoalId) {
        if !self.own.contains(&goal) {
            return self.driver.safe_stop(now, goal);
        }
        self.asked.remove(&goal);
        self.outbox.push_back((now, DriverEvent::Stopped { goal }));
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
        loop {
            if let Some(event) = self.due(until) {
                return Some(event);
            }
            while let Ok((number, found)) = self.answers.try_recv() {
                self.take(number, found);
            }
            if let Some(event) = self.due(until) {
                return Some(event);
            }
            let clocks = self.asked.values().map(PendingGoal::due);
            let Some(limit) = clocks.min().filter(|limit| *limit < until) else { return self.forward(until) };
            if let Some(event) = self.forward(limit) {
                return Some(event);
            }
            match self.answers.recv_timeout(SLICE) {
                Ok((number, found)) => self.take(number, found),
                Err(RecvTimeoutError::Timeout) => {}
                // Whoever points is gone, and no answer will come.
                Err(RecvTimeoutError::Disconnected) => {
                    let goals: Vec<GoalId> = self.asked.keys().copied().collect();
                    for goal in goals {
                        self.end(self.now, goal, Outcome::Failure(failures::NOT_FOUND.into()));
                    }
                }
            }
        }
    }

    fn inner(&mut self) -> Option<&mut dyn Driver> {
        Some(&mut *self.driver)
    }
}
