//! A driver for a robot that runs on a thread of its own, in real time. It loads a graph that `motet compile`
//! wrote and runs it to the end.
//!
//! `cargo run -p motet-host --example robot_thread`
//!
//! The thread stands for a robot's own software. With ROS 2 actions the parts map like this: `start` sends a
//! goal to an action server, the goal response becomes [`DriverEvent::Acknowledged`] or
//! [`DriverEvent::Refused`], the result becomes [`DriverEvent::Ended`], feedback becomes
//! [`DriverEvent::Feedback`], `cancel` sends a cancel request, and `safe_stop` calls the stop service of the
//! controller. The callbacks send these events into the channel that `advance` reads.

#![allow(dead_code, reason = "the tests include this file and do not call `main`")]

use motet_graph::{Value, decode};
use motet_runtime::{
    Answer, Command, Driver, DriverEvent, Engine, GoalId, Outcome, Query, RunEnd, StartState, Time, run,
};
use std::error::Error;
use std::io::Write;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// Written by `motet compile bring_mug.motet --robot hsr --scene kitchen`.
const GRAPH: &str = include_str!("robot_thread/bring_mug.graph.json");

/// A call of the robot's own interface.
enum RobotCall {
    DriveTo { place: String },
    Detect { what: String },
    Grasp { thing: String },
    HandOver { thing: String, person: String },
    Speak { text: String },
}

impl RobotCall {
    /// Maps a command to a call. `Command::args` holds every parameter of the primitive by name; numbers
    /// are in SI units.
    fn parse(command: &Command) -> Option<Self> {
        let entity = |name: &str| match command.arg(name)? {
            Value::Entity(id) => Some(id.to_string()),
            _ => None,
        };
        let text = |name: &str| match command.arg(name)? {
            Value::Text(text) => Some(text.to_string()),
            _ => None,
        };
        Some(match command.primitive.as_str() {
            "go" => Self::DriveTo { place: entity("to")? },
            "detect" => Self::Detect { what: text("what")? },
            "pick" => Self::Grasp { thing: entity("object")? },
            "handover" => Self::HandOver { thing: entity("object")?, person: entity("to")? },
            "say" => Self::Speak { text: text("text")? },
            _ => return None,
        })
    }
}

/// A message to the robot's thread.
enum ToRobot {
    Do(GoalId, RobotCall),
    Cancel,
}

/// The driver: a clock, a channel to the robot and a channel back.
struct RobotDriver {
    origin: Instant,
    robot: Sender<ToRobot>,
    sender: Sender<DriverEvent>,
    reports: Receiver<DriverEvent>,
    _thread: JoinHandle<()>,
}

impl RobotDriver {
    /// Starts the robot's thread. Every action takes `action`.
    fn new(action: Duration) -> Self {
        let (robot, calls) = mpsc::channel();
        let (sender, reports) = mpsc::channel();
        let out = sender.clone();
        let thread = thread::spawn(move || robot_loop(&calls, &out, action));
        Self { origin: Instant::now(), robot, sender, reports, _thread: thread }
    }

    fn now(&self) -> Time {
        Time::from_nanos(u64::try_from(self.origin.elapsed().as_nanos()).unwrap_or(u64::MAX))
    }

    /// Queues an event. `advance` returns it: a driver never reports from within another call.
    fn report(&self, event: DriverEvent) {
        let _ = self.sender.send(event);
    }
}

impl Driver for RobotDriver {
    fn start(&mut self, _now: Time, goal: GoalId, command: &Command) {
        match RobotCall::parse(command) {
            Some(call) => {
                self.report(DriverEvent::Acknowledged { goal });
                let _ = self.robot.send(ToRobot::Do(goal, call));
            }
            None => self.report(DriverEvent::Refused { goal, failure: "failed".into() }),
        }
    }

    fn cancel(&mut self, _now: Time, _goal: GoalId) {
        let _ = self.robot.send(ToRobot::Cancel);
    }

    fn update(&mut self, _now: Time, _goal: GoalId, _command: &Command) {
        // Never called: `capabilities` keeps its default, which updates nothing.
    }

    fn hold(&mut self, _now: Time, goal: GoalId) {
        self.report(DriverEvent::NotHeld { goal });
    }

    fn proceed(&mut self, _now: Time, _goal: GoalId) {}

    fn safe_stop(&mut self, _now: Time, goal: GoalId) {
        // A real robot engages its brakes here and reports after it stands still.
        let _ = self.robot.send(ToRobot::Cancel);
        self.report(DriverEvent::Stopped { goal });
    }

    fn observe(&mut self, _now: Time, query: &Query) {
        self.report(DriverEvent::Observed { query: query.clone(), answer: Answer::Unknown });
    }

    fn watch(&mut self, now: Time, query: &Query) {
        self.observe(now, query);
    }

    fn unwatch(&mut self, _now: Time, _query: &Query) {}

    /// Blocks until the robot reports or the time is `until`, whichever comes first.
    fn advance(&mut self, until: Time) -> Option<(Time, DriverEvent)> {
        let event = if until == Time::NEVER {
            self.reports.recv().ok()?
        } else {
            let left = Duration::from_nanos(until.since(self.now()).nanos());
            match self.reports.recv_timeout(left) {
                Ok(event) => event,
                Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => return None,
            }
        };
        Some((self.now().min(until), event))
    }
}

/// The robot: carries out one call at a time and reports its end.
fn robot_loop(calls: &Receiver<ToRobot>, reports: &Sender<DriverEvent>, action: Duration) {
    while let Ok(message) = calls.recv() {
        let ToRobot::Do(goal, call) = message else { continue };
        // A cancel interrupts the action; any other message waits for its end.
        let outcome = match calls.recv_timeout(action) {
            Ok(ToRobot::Cancel) => Outcome::Interrupted,
            Ok(ToRobot::Do(..)) | Err(_) => Outcome::Success(result(call)),
        };
        if reports.send(DriverEvent::Ended { goal, outcome }).is_err() {
            return;
        }
    }
}

/// Result of a call; only `detect` has one.
fn result(call: RobotCall) -> Option<Value> {
    match call {
        RobotCall::Detect { .. } => Some(Value::Entity("mug_1".into())),
        RobotCall::DriveTo { .. } | RobotCall::Grasp { .. } => None,
        RobotCall::HandOver { .. } | RobotCall::Speak { .. } => None,
    }
}

/// Loads the graph and runs it on the robot.
pub(crate) fn bring_mug(action: Duration) -> Result<RunEnd, Box<dyn Error>> {
    let graph = decode(GRAPH)?;
    let mut engine = Engine::new(graph, &StartState::default()).map_err(|errors| format!("{errors:?}"))?;
    Ok(run(&mut engine, &mut RobotDriver::new(action), &mut (), Time::ZERO))
}

fn main() -> Result<(), Box<dyn Error>> {
    let end = bring_mug(Duration::from_millis(300))?;
    writeln!(std::io::stdout(), "{end}")?;
    Ok(())
}
