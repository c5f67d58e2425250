//! The driver protocol on standard input and output, in front of the robot.

mod stopping;

use crate::lines::{Line, Output, note};
use crate::observe::Found;
use crate::plan::Card;
use crate::robot::{Robot, RobotEvent};
use crate::task::{Finish, Surroundings, Task};
use crate::world::World;
use crossbeam_channel::{Receiver, select, tick};
use motet_graph::Value as Argument;
use motet_host::remote::protocol::{CalledPrimitive, Detections, REFUSED};
use motet_host::remote::protocol::{
    DriverCall, DriverReport, EndedParams, FeedbackParams, GoalParams, GoalState, GoalStatus, Hello,
    MovedParams, ObservedParams, QueryResult, RefusedData, StartParams, StatusResult, ToldParams, VERSION,
    Welcome,
};
use motet_runtime::{Answer, Capabilities, FailureReport, GoalId, Pattern, PrimitiveSet, Query};
use motet_stdlib::lang::failures;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

/// Time between two looks at what runs.
const TICK: Duration = Duration::from_millis(10);
/// Time between two reports of telemetry.
const MOVES: Duration = Duration::from_millis(50);
/// Time between two looks at what the host watches.
const WATCHES: Duration = Duration::from_millis(50);
/// Silence after which the host is gone.
const SILENCE: Duration = Duration::from_secs(5);
/// Messages that are taken in before anything moves on.
const BURST: usize = 1_024;
/// Goals whose end is remembered.
const MAX_GOALS: usize = 100_000;
/// Error codes of JSON-RPC.
const INVALID: i64 = -32602;
const UNKNOWN_METHOD: i64 = -32601;

/// State of a goal.
enum Goal {
    Running(Box<Task>),
    Refused(FailureReport),
    Ended(motet_runtime::Outcome),
    Stopped,
    /// It does not run any more, and nobody knows how it ended.
    Lost,
}

/// The driver: goals, watched queries, and the robot.
pub(crate) struct Driver {
    robot: Robot,
    world: World,
    card: Card,
    out: Output,
    run: Option<String>,
    /// Primitives of the policy, with what they declare.
    called: HashMap<String, CalledPrimitive>,
    goals: BTreeMap<u64, Goal>,
    /// Goals up to this one are forgotten.
    forgotten: u64,
    /// Goals of the run before, which are being stopped. No other goal begins before they have.
    former: Vec<Task>,
    /// Safe stops of goals that do not run any more.
    stopping: BTreeSet<u64>,
    /// The whole robot is to come to rest; the time of the last stop that was sent.
    whole_stop: Option<Instant>,
    watched: Vec<(Query, Answer)>,
    detections: Vec<motet_host::remote::protocol::DetectedThing>,
    /// Name of this process, and how often it has forgotten the goals of a run.
    instance: String,
    forgets: u32,
    /// Goals that were lost, of which the host has asked for the state.
    lost_again: Vec<GoalId>,
    heard: Instant,
    moved: Instant,
    looked: Instant,
    is_greeted: bool,
}

impl Driver {
    /// A driver of a robot in a room.
    pub(crate) fn new(robot: Robot, world: World, card: Card, out: Output) -> Self {
        let started = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).unwrap_or_default();
        let now = Instant::now();
        Self {
            robot,
            world,
            card,
            out,
            run: None,
            called: HashMap::new(),
            goals: BTreeMap::new(),
            forgotten: 0,
            former: Vec::new(),
            stopping: BTreeSet::new(),
            whole_stop: None,
            watched: Vec::new(),
            detections: Vec::new(),
            instance: format!("{}-{}", std::process::id(), started.as_nanos()),
            forgets: 0,
            lost_again: Vec::new(),
            heard: now,
            moved: now,
            looked: now,
            is_greeted: false,
        }
    }

    /// Serves the host until it leaves. Everything stands still at the end, if the robot heeds.
    ///
    /// # Errors
    ///
    /// Why a line of the host cannot be read, an answer cannot be written, or nobody knows that the robot
    /// stands still.
    pub(crate) fn serve(&mut self, lines: &Receiver<Line>) -> Result<(), String> {
        // A panic is a defect of the driver, and no reason to let the robot move on.
        let served = catch_unwind(AssertUnwindSafe(|| self.listen(lines)));
        let left = catch_unwind(AssertUnwindSafe(|| self.leave()));
        let broken = || Err("the driver has a defect; see above".to_owned());
        served.unwrap_or_else(|_| broken()).and(left.unwrap_or_else(|_| broken()))
    }

    /// Answers the host until it leaves.
    fn listen(&mut self, lines: &Receiver<Line>) -> Result<(), String> {
        let ticks = tick(TICK);
        let received = self.robot.received.clone();
        loop {
            select! {
                recv(lines) -> line => match line {
                    Ok(Line::Text(line)) => {
                        self.heard = Instant::now();
                        if !self.answer(&line)? {
                            return Ok(());
                        }
                    }
                    Ok(Line::Wrong(why)) => return Err(why),
                    Ok(Line::End) | Err(_) => return Ok(()),
                },
                recv(received) -> message => {
                    if let Ok(message) = message {
                        self.take(&message);
                    }
                    // Whatever else has come, before anything moves on.
                    let others: Vec<_> = received.try_iter().take(BURST).collect();
                    others.iter().for_each(|message| self.take(message));
                }
                recv(ticks) -> _ => {
                    let heard = self.robot.tick();
                    self.pass(&heard);
                    if self.is_greeted && self.heard.elapsed() > SILENCE {
                        note("the host has said nothing for 5 s; everything stops");
                        return Ok(());
                    }
                }
            }
            self.advance()?;
        }
    }

    fn take(&mut self, message: &crate::dds::Received) {
        let entities = &self.world.scene.entities;
        let mut heard = self.robot.hear(message, &|id| entities.contains_key(id));
        for news in &mut heard {
            if let RobotEvent::Detected(things) = news {
                self.world.recognise(things);
            }
        }
        self.pass(&heard);
    }

    /// Passes news on to the goals.
    fn pass(&mut self, heard: &[RobotEvent]) {
        for news in heard {
            if let RobotEvent::Detected(things) = news {
                for thing in things {
                    if let Some(id) = &thing.id {
                        self.world.note(thing);
                        self.world.saw(id, thing.pose.map(Into::into));
                    }
                }
                self.detections.clone_from(things);
            }
            let mut around =
                Surroundings { robot: &mut self.robot, world: &mut self.world, card: &self.card };
            let running = self.goals.values_mut().filter_map(|goal| match goal {
                Goal::Running(task) => Some(task.as_mut()),
                _ => None,
            });
            running.chain(&mut self.former).for_each(|task| task.hear(&mut around, news));
        }
    }

    /// Lets all goals go on, and reports what has changed.
    fn advance(&mut self) -> Result<(), String> {
        let mut reports = Vec::new();
        let detections = self.world.take_news();
        if !detections.is_empty() {
            reports.push(DriverReport::Detected(Detections { detections }));
        }
        self.advance_former();
        // While the whole robot stops, only what stops goes on.
        let is_free = self.former.is_empty() && self.whole_stop.is_none();
        for (number, goal) in &mut self.goals {
            let Goal::Running(task) = goal else { continue };
            if !is_free && !task.is_stopping() {
                continue;
            }
            let mut around =
                Surroundings { robot: &mut self.robot, world: &mut self.world, card: &self.card };
            let finish = task.advance(&mut around);
            let id = GoalId::from_number(*number);
            let own = task.own_motions.drain(..).map(|text| (text, true));
            let said = task.feedback.drain(..).map(|text| (text, false)).chain(own);
            reports.extend(said.map(|(text, own_motion)| {
                DriverReport::Feedback(FeedbackParams { goal: id, text, own_motion })
            }));
            let Some(finish) = finish else { continue };
            let (primitive, args) = (task.command.primitive.to_string(), task.args());
            match finish {
                Finish::Ended(outcome) => {
                    match &outcome {
                        motet_runtime::Outcome::Success(_) => self.world.done(&primitive, &args),
                        _ => self.world.failed(&primitive, &args),
                    }
                    reports.push(DriverReport::Ended(EndedParams { goal: id, outcome: outcome.clone() }));
                    *goal = Goal::Ended(outcome);
                }
                Finish::Stopped => {
                    self.world.failed(&primitive, &args);
                    reports.push(DriverReport::Stopped(GoalParams { goal: id }));
                    *goal = Goal::Stopped;
                }
                Finish::Lost => {
                    self.world.failed(&primitive, &args);
                    reports.push(DriverReport::Lost(GoalParams { goal: id }));
                    *goal = Goal::Lost;
                }
            }
        }
        let again = std::mem::take(&mut self.lost_again).into_iter();
        reports.extend(again.map(|goal| DriverReport::Lost(GoalParams { goal })));
        reports.extend(self.advance_whole_stop());
        reports.extend(self.changes());
        reports.extend(self.telemetry());
        reports.iter().try_for_each(|report| self.report(report))
    }

    /// Answers of watched queries that have changed.
    fn changes(&mut self) -> Vec<DriverReport> {
        if self.looked.elapsed() < WATCHES {
            return Vec::new();
        }
        self.looked = Instant::now();
        let watched = std::mem::take(&mut self.watched);
        let mut reports = Vec::new();
        for (query, before) in watched {
            let answer = self.observe(&query);
            if answer != before {
                reports.push(DriverReport::Observed(ObservedParams {
                    query: query.clone(),
                    answer: answer.clone(),
                }));
            }
            self.watched.push((query, answer));
        }
        reports
    }

    fn telemetry(&mut self) -> Option<DriverReport> {
        if !self.is_greeted || self.moved.elapsed() < MOVES || self.out.is_behind() {
            return None;
        }
        self.moved = Instant::now();
        let base = match self.robot.body.base(&self.robot.binding) {
            Ok(base) => [base.x, base.y, base.yaw],
            Err(_) if self.robot.binding.base.odometry.is_none() => self.world.scene.robot.base,
            Err(_) => return None,
        };
        let joints = self.robot.body.positions();
        let joints =
            joints.iter().map(|(name, value)| (self.robot.binding.card_joint(name).into(), *value)).collect();
        Some(DriverReport::Moved(MovedParams { at: None, base, joints, things: Vec::new() }))
    }

    /// Answer to a query: by a bound topic, or by the beliefs of the driver.
    fn observe(&mut self, query: &Query) -> Answer {
        let (bound, args) = match query {
            Query::Fact { fluent, args } => (self.robot.binding.facts.get(fluent.as_str()), words(args)),
            Query::Measure { measure, args } => {
                let args = args.iter().map(word).collect();
                (self.robot.binding.measures.get(measure.as_str()), Some(args))
            }
            Query::Field { .. } => (None, None),
        };
        if let Some((bound, args)) = bound.cloned().zip(args) {
            return match self.robot.observe(&bound, &args) {
                Some(Found::Truth(truth)) => Answer::Truth(truth),
                Some(Found::Number(number)) => Answer::Value(Argument::Number(number)),
                Some(Found::Text(text)) => Answer::Value(Argument::Text(text.into())),
                None => Answer::Unknown,
            };
        }
        let base = self.robot.body.base(&self.robot.binding).ok().map(|base| [base.x, base.y]);
        match self.world.answer(query, base) {
            Some(Argument::Bool(truth)) => Answer::Truth(truth),
            Some(value) => Answer::Value(value),
            None => Answer::Unknown,
        }
    }

    // Calls.

    /// Answers a line of the host. `false` if the host leaves.
    fn answer(&mut self, line: &str) -> Result<bool, String> {
        let Ok(mut message) = serde_json::from_str::<Value>(line) else {
            return self
                .say(&json!({"jsonrpc": "2.0", "id": null, "error": {"code": -32700, "message": "no JSON"}}))
                .map(|()| true);
        };
        let id = message.get("id").cloned();
        if let Some(fields) = message.as_object_mut() {
            fields.remove("jsonrpc");
            fields.remove("id");
        }
        let method = message.get("method").and_then(Value::as_str).unwrap_or_default().to_owned();
        let result = match serde_json::from_value::<DriverCall>(message) {
            Ok(DriverCall::Bye(_)) => return Ok(false),
            Ok(call) => self.call(call),
            Err(error) if KNOWN.contains(&method.as_str()) => Err((INVALID, error.to_string(), Value::Null)),
            Err(_) => Err((UNKNOWN_METHOD, format!("no method `{}`", method.escape_debug()), Value::Null)),
        };
        let Some(id) = id else { return Ok(true) };
        let answer = match result {
            Ok(result) => json!({"jsonrpc": "2.0", "id": id, "result": result}),
            Err((code, message, data)) => {
                json!({"jsonrpc": "2.0", "id": id, "error": {"code": code, "message": message, "data": data}})
            }
        };
        self.say(&answer)?;
        Ok(true)
    }

    fn call(&mut self, call: DriverCall) -> Result<Value, (i64, String, Value)> {
        let nothing = Ok(json!({}));
        match call {
            DriverCall::Hello(hello) => self.greet(&hello),
            DriverCall::Start(start) => self.start(&start),
            DriverCall::Update(_) => Err((INVALID, "no goal takes new arguments".to_owned(), Value::Null)),
            DriverCall::Cancel(GoalParams { goal }) => {
                self.with_task(goal, Task::cancel);
                nothing
            }
            DriverCall::Hold(GoalParams { goal }) => {
                self.with_task(goal, Task::hold);
                nothing
            }
            DriverCall::Proceed(GoalParams { goal }) => {
                self.with_task(goal, |task, _| task.proceed());
                nothing
            }
            DriverCall::SafeStop(GoalParams { goal }) => {
                if !self.with_task(goal, Task::safe_stop) {
                    self.stopping.insert(goal.number());
                    self.stop_whole();
                }
                nothing
            }
            DriverCall::Observe(asked) => value(&QueryResult { answer: self.observe(&asked.query) }),
            DriverCall::Watch(asked) => {
                let answer = self.observe(&asked.query);
                self.watched.retain(|(query, _)| *query != asked.query);
                self.watched.push((asked.query, answer.clone()));
                value(&QueryResult { answer })
            }
            DriverCall::Unwatch(asked) => {
                self.watched.retain(|(query, _)| *query != asked.query);
                nothing
            }
            DriverCall::Look(asked) => match self.robot.look(asked.camera.as_deref()) {
                Ok(picture) => value(&picture),
                Err(why) => Err((INVALID, why, Value::Null)),
            },
            DriverCall::Detections(_) => value(&Detections { detections: self.detections.clone() }),
            DriverCall::Told(ToldParams { thing }) => {
                self.world.told(&thing);
                nothing
            }
            DriverCall::Status(asked) => {
                // To a host that has not heard of it, a goal that was lost is told again.
                let is_lost = |goal: &&GoalId| matches!(self.goals.get(&goal.number()), Some(Goal::Lost));
                let lost: Vec<GoalId> = asked.goals.iter().filter(is_lost).copied().collect();
                self.lost_again.extend(lost);
                let state = |goal: &GoalId| GoalState { goal: *goal, state: self.status(*goal) };
                value(&StatusResult { goals: asked.goals.iter().map(state).collect() })
            }
            DriverCall::Ping(_) => nothing,
            DriverCall::Truth(_) => {
                Err((UNKNOWN_METHOD, "a robot knows no more than it sees".to_owned(), Value::Null))
            }
            DriverCall::Advance(_) => {
                Err((UNKNOWN_METHOD, "time is that of the wall".to_owned(), Value::Null))
            }
            DriverCall::Bye(_) => nothing,
        }
    }

    fn greet(&mut self, hello: &Hello) -> Result<Value, (i64, String, Value)> {
        if hello.protocol != VERSION {
            let text = format!("this driver speaks version {VERSION} of the protocol");
            return Err((INVALID, text, Value::Null));
        }
        if self.run.as_ref().is_some_and(|run| *run != hello.run) {
            self.stop_all();
            let goals = std::mem::take(&mut self.goals).into_values();
            for goal in goals {
                match goal {
                    Goal::Running(task) => self.former.push(*task),
                    Goal::Lost => self.stop_whole(),
                    Goal::Refused(_) | Goal::Ended(_) | Goal::Stopped => {}
                }
            }
            self.forgotten = 0;
            // Who knew the driver before is not to take a forgotten goal for one that never began.
            self.forgets += 1;
            self.stopping.clear();
            self.watched.clear();
        }
        self.run = Some(hello.run.clone());
        self.is_greeted = true;
        self.called = hello.primitives.iter().map(|one| (one.name.clone(), one.clone())).collect();
        let binding = &self.robot.binding;
        let holds = binding.primitives.keys().filter(|name| binding.holds(name));
        let capabilities = Capabilities {
            primitives: PrimitiveSet::Only(
                binding.primitives.keys().map(|name| name.as_str().into()).collect(),
            ),
            hold: PrimitiveSet::Only(holds.map(|name| name.as_str().into()).collect()),
            update: PrimitiveSet::Only(BTreeSet::new()),
            moved: true,
            look: !self.robot.binding.cameras.is_empty(),
            detections: self.robot.binding.detections.is_some(),
            told: true,
            ..Capabilities::default()
        };
        let driver = concat!("motet-ros2 ", env!("CARGO_PKG_VERSION")).to_owned();
        let instance = format!("{}-{}", self.instance, self.forgets);
        value(&Welcome { protocol: VERSION, driver, instance, capabilities })
    }

    fn start(&mut self, start: &StartParams) -> Result<Value, (i64, String, Value)> {
        let number = start.goal.number();
        if number <= self.forgotten && !self.goals.contains_key(&number) {
            return Err((INVALID, "the goal was started long ago".to_owned(), Value::Null));
        }
        if !self.goals.contains_key(&number) {
            let primitive = start.command.primitive.as_str();
            let called = self.called.get(primitive).cloned();
            let unknown = || CalledPrimitive { name: primitive.to_owned(), result: None, fails: Vec::new() };
            let called = called.unwrap_or_else(unknown);
            let goal = match self.robot.binding.steps(primitive) {
                Some(steps) => Goal::Running(Box::new(Task::new(start.command.clone(), steps, called))),
                None => {
                    let kind = called.fails.first().map_or(failures::REFUSED, smol_str::SmolStr::as_str);
                    let text = format!("the binding has no steps for `{primitive}`");
                    Goal::Refused(FailureReport { kind: kind.into(), text: Some(text.into()) })
                }
            };
            self.goals.insert(number, goal);
            self.forget_oldest();
        }
        match self.goals.get(&number) {
            Some(Goal::Refused(failure)) => {
                let data = serde_json::to_value(RefusedData { failure: failure.clone() }).unwrap_or_default();
                Err((REFUSED, "the goal is refused".to_owned(), data))
            }
            _ => Ok(json!({})),
        }
    }

    /// Forgets the ends of the oldest goals, beyond as many as are remembered.
    fn forget_oldest(&mut self) {
        if self.goals.len() <= MAX_GOALS {
            return;
        }
        let is_over =
            |(_, goal): &(&u64, &Goal)| matches!(goal, Goal::Refused(_) | Goal::Ended(_) | Goal::Stopped);
        if let Some(number) = self.goals.iter().find(is_over).map(|(number, _)| *number) {
            self.goals.remove(&number);
            self.forgotten = self.forgotten.max(number);
        }
    }

    fn status(&self, goal: GoalId) -> GoalStatus {
        if self.stopping.contains(&goal.number()) {
            return GoalStatus::Running;
        }
        match self.goals.get(&goal.number()) {
            None => GoalStatus::Unknown,
            Some(Goal::Running(_) | Goal::Lost) => GoalStatus::Running,
            Some(Goal::Refused(failure)) => GoalStatus::Refused(failure.clone()),
            Some(Goal::Ended(outcome)) => GoalStatus::Ended(outcome.clone()),
            Some(Goal::Stopped) => GoalStatus::Stopped,
        }
    }

    /// Does something with a task that runs; `false` if the goal does not run.
    fn with_task(&mut self, goal: GoalId, act: impl FnOnce(&mut Task, &mut Surroundings<'_>)) -> bool {
        let Some(Goal::Running(task)) = self.goals.get_mut(&goal.number()) else { return false };
        let mut around = Surroundings { robot: &mut self.robot, world: &mut self.world, card: &self.card };
        act(task, &mut around);
        true
    }

    fn report(&self, report: &DriverReport) -> Result<(), String> {
        let mut message = serde_json::to_value(report).map_err(|error| error.to_string())?;
        if let Some(fields) = message.as_object_mut() {
            fields.insert("jsonrpc".to_owned(), json!("2.0"));
        }
        self.say(&message)
    }

    fn say(&self, message: &Value) -> Result<(), String> {
        self.out.write(message.to_string())
    }
}

/// Methods of the protocol.
const KNOWN: [&str; 18] = [
    "hello",
    "start",
    "update",
    "cancel",
    "hold",
    "proceed",
    "safe_stop",
    "observe",
    "watch",
    "unwatch",
    "advance",
    "look",
    "detections",
    "told",
    "truth",
    "status",
    "ping",
    "bye",
];

fn value(result: &impl serde::Serialize) -> Result<Value, (i64, String, Value)> {
    serde_json::to_value(result).map_err(|error| (-32603, error.to_string(), Value::Null))
}

/// Arguments of a fact as words; none where one is open.
fn words(args: &[Pattern]) -> Option<Vec<String>> {
    let word = |pattern: &Pattern| match pattern {
        Pattern::Is(value) => Some(word(value)),
        Pattern::Any => None,
    };
    args.iter().map(word).collect()
}

fn word(value: &Argument) -> String {
    match value {
        Argument::Entity(text) | Argument::Text(text) | Argument::Case(text) => text.to_string(),
        other => other.to_string(),
    }
}
