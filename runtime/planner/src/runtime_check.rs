//! Run-time checks of the motions that the compiler deferred, in the scene as the run has left it, with the
//! compiler's own geometry.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, Sender, TryRecvError};

use motet_compiler::{Forecast, WorldTracker};
use motet_graph::Value;
use motet_robots::scene::{Entity, Grip};
use motet_runtime::{
    Answer, CheckId, Command, DeferredMotion, DriverEvent, Effect, Event, GoalId, Moved, Outcome, Pattern,
    Query, Time, Verification, Verifier,
};
use motet_stdlib::lang::{self, fluents};

/// Time limit of the engine for a verdict: longer than any search within its budget.
pub const WITHIN: Time = Time::from_nanos(10_000_000_000);

/// Greatest age of a report of where the robot is at which it counts: a little more than the span between two
/// reports. A stopped robot stands where such a report says.
const RECENT: Time = Time::from_nanos(25_000_000);

/// Checks the deferred motions of a run, and tracks the scene along the run.
#[derive(Debug)]
pub struct Guard(Schedule);

#[derive(Debug)]
enum Schedule {
    /// Searches inside the calls.
    AtOnce { tracker: Box<RunTracker>, verdicts: VecDeque<(CheckId, Verification)> },
    /// Thread that receives every event in order and ends with the last sender.
    Background { thread: Sender<GuardMessage>, verdicts: Receiver<(CheckId, Verification)>, awaited: usize },
}

/// Schedule of the motion searches in a run.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum CheckMode {
    /// Search when a verdict is requested. In virtual time this takes no time, so every run is the same.
    AtOnce,
    /// Search on a thread of its own, so that neither a search nor the tracking of the scene delays the run.
    Background,
}

/// Message to the thread of the checks.
#[derive(Debug)]
enum GuardMessage {
    Reported(Time, DriverEvent),
    Moved(Moved),
    Began(GoalId, Arc<Command>),
    Asked(CheckId, Arc<DeferredMotion>),
    Saw(Vec<Entity>),
}

impl Guard {
    /// Guard for a run that begins in the tracker's state.
    #[must_use]
    pub fn new(course: WorldTracker, verifies: CheckMode) -> Self {
        match verifies {
            CheckMode::AtOnce => {
                let tracker = Box::new(RunTracker::new(course));
                Self(Schedule::AtOnce { tracker, verdicts: VecDeque::new() })
            }
            CheckMode::Background => Self::in_background(course),
        }
    }

    fn in_background(course: WorldTracker) -> Self {
        let (thread, message) = mpsc::channel();
        let (answers, verdicts) = mpsc::channel();
        std::thread::spawn(move || {
            let mut tracker = RunTracker::new(course);
            for one in message {
                if let Some(verdict) = tracker.hear(one)
                    && answers.send(verdict).is_err()
                {
                    return;
                }
            }
        });
        Self(Schedule::Background { thread, verdicts, awaited: 0 })
    }

    /// Takes in things where they were seen, also those that the scene lacks.
    pub fn saw(&mut self, things: Vec<Entity>) {
        if !things.is_empty() {
            self.tell(GuardMessage::Saw(things));
        }
    }

    fn tell(&mut self, message: GuardMessage) {
        match &mut self.0 {
            Schedule::AtOnce { tracker, verdicts } => verdicts.extend(tracker.hear(message)),
            Schedule::Background { thread, awaited, .. } => {
                *awaited += usize::from(matches!(message, GuardMessage::Asked(..)));
                // A thread that is gone gives no verdicts; the engine does not wait for them for ever.
                let _ = thread.send(message);
            }
        }
    }
}

impl Verifier for Guard {
    fn event(&mut self, now: Time, event: &Event) {
        if let Event::Driver(event) = event {
            self.tell(GuardMessage::Reported(now, event.clone()));
        }
    }

    fn moved(&mut self, moved: &Moved) {
        // Where things are is not read off telemetry.
        let (joints, things) = (moved.joints.clone(), Vec::new());
        self.tell(GuardMessage::Moved(Moved { joints, things, ..*moved }));
    }

    fn effect(&mut self, effect: &Effect) {
        if let Effect::Start { goal, command, .. } | Effect::Update { goal, command, .. } = effect {
            self.tell(GuardMessage::Began(*goal, Arc::clone(command)));
        }
    }

    fn ask(&mut self, check: CheckId, motion: &Arc<DeferredMotion>) {
        self.tell(GuardMessage::Asked(check, Arc::clone(motion)));
    }

    fn verdict(&mut self) -> Option<(CheckId, Verification)> {
        match &mut self.0 {
            Schedule::AtOnce { verdicts, .. } => verdicts.pop_front(),
            Schedule::Background { verdicts, awaited, .. } => {
                let verdict = verdicts.try_recv();
                match verdict {
                    Ok(_) => *awaited = awaited.saturating_sub(1),
                    Err(TryRecvError::Empty) => {}
                    Err(TryRecvError::Disconnected) => *awaited = 0,
                }
                verdict.ok()
            }
        }
    }

    fn is_busy(&self) -> bool {
        match &self.0 {
            Schedule::AtOnce { .. } => false,
            Schedule::Background { awaited, .. } => *awaited > 0,
        }
    }
}

/// Grip that a reading tells: how the hand holds a thing.
pub(crate) fn grip(query: &Query, value: &Value) -> Option<Grip> {
    match (query, value) {
        (Query::Field { entity, field }, Value::Pose(pose)) if field == lang::GRIP => {
            Grip::new(entity.clone(), pose.xyz, pose.quaternion)
        }
        _ => None,
    }
}

/// Tracker of the scene along a run.
#[derive(Debug)]
struct RunTracker {
    course: WorldTracker,
    live: BTreeMap<GoalId, Arc<Command>>,
    /// Latest place of the robot, by the driver's reports.
    stood: Option<Moved>,
}

impl RunTracker {
    fn new(course: WorldTracker) -> Self {
        Self { course, live: BTreeMap::new(), stood: None }
    }

    /// Takes in a message; returns the verdict if the message requests one.
    fn hear(&mut self, message: GuardMessage) -> Option<(CheckId, Verification)> {
        match message {
            GuardMessage::Reported(now, event) => self.report(now, &event),
            GuardMessage::Began(goal, command) => self.began(goal, command),
            GuardMessage::Moved(moved) => {
                let stood = self.stood.get_or_insert_default();
                stood.merge(&moved);
                self.course.stands(stood.base, &stood.joints);
            }
            GuardMessage::Saw(things) => self.course.saw(things),
            GuardMessage::Asked(check, motion) => return Some((check, self.motion(&motion))),
        }
        None
    }

    fn report(&mut self, now: Time, event: &DriverEvent) {
        match event {
            DriverEvent::Ended { goal, outcome } => {
                let Some(command) = self.live.remove(goal) else { return };
                match outcome {
                    Outcome::Success(value) => {
                        self.course.succeeded(&command.primitive, &command.args, value.as_ref());
                        self.stand(now);
                    }
                    Outcome::Failure(_) | Outcome::Interrupted => self.stopped(now, &command),
                }
            }
            DriverEvent::Refused { goal, .. } => {
                if let Some(command) = self.live.remove(goal) {
                    self.course.refused(&command.primitive);
                }
            }
            DriverEvent::Stopped { goal } => {
                if let Some(command) = self.live.remove(goal) {
                    self.stopped(now, &command);
                }
            }
            DriverEvent::Observed { query: Query::Fact { fluent, args }, answer: Answer::Truth(holds) } => {
                match args.as_slice() {
                    [Pattern::Is(Value::Entity(entity))] => self.course.observed(fluent, entity, *holds),
                    [Pattern::Any] if fluent == fluents::HOLDING && !holds => self.course.emptied(),
                    [Pattern::Is(Value::Case(_))] if fluent == fluents::FREE && *holds => self.course.freed(),
                    _ => {}
                }
                self.stand(now);
            }
            DriverEvent::Observed { query, answer: Answer::Value(value) } => {
                grip(query, value).into_iter().for_each(|grip| self.course.felt(grip));
            }
            DriverEvent::Observed { .. }
            | DriverEvent::Acknowledged { .. }
            | DriverEvent::Feedback { .. } => {}
            DriverEvent::NotHeld { .. } | DriverEvent::Lost { .. } => {}
            DriverEvent::DriverLost | DriverEvent::DriverGone => {}
        }
    }

    fn stopped(&mut self, now: Time, command: &Command) {
        self.course.stopped(&command.primitive, &command.args);
        self.stand(now);
    }

    /// Takes in where the robot stands, if that was told lately.
    fn stand(&mut self, now: Time) {
        if let Some(stood) = self.stood.as_ref().filter(|stood| now.since(stood.at) <= RECENT) {
            self.course.stands(stood.base, &stood.joints);
        }
    }

    fn began(&mut self, goal: GoalId, command: Arc<Command>) {
        let name = command.primitive.clone();
        // What an updated goal did before was interrupted.
        if let Some(before) = self.live.insert(goal, command) {
            self.course.stopped(&before.primitive, &before.args);
        }
        self.course.began(&name);
    }

    fn motion(&self, motion: &DeferredMotion) -> Verification {
        let Command { primitive, args, manner, .. } = &*motion.command;
        match self.course.motion(primitive, (args, *manner), &motion.query, &motion.args) {
            Forecast::Feasible { witness, leaves } => {
                Verification::Feasible { witness: Some(witness), leaves }
            }
            Forecast::Infeasible { failure, why } => Verification::Infeasible { failure, why: why.into() },
            Forecast::Unknown { why } => Verification::Unknown { why: why.into() },
        }
    }
}
