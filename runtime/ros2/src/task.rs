//! A goal of the host as a row of steps: trajectories, navigations, the hand, and calls.

mod calls;
mod move_group;
mod moving;
mod searching;
mod stopping;

pub(crate) use stopping::stand_still;

use crate::action::{End, GoalEvent, Uuid};
use crate::bind::{Step, StepKind};
use crate::cdr::Message;
use crate::joint::Part;
use crate::observe::Found;
use crate::plan::{Card, NoPath};
use crate::robot::{Robot, RobotEvent};
use crate::service::Ticket;
use crate::state::Parts;
use crate::world::World;
use crossbeam_channel::{Receiver, TryRecvError};
use motet_graph::{Value as Argument, Witness};
use motet_host::remote::protocol::CalledPrimitive;
use motet_runtime::{Command, FailureReport, Outcome};
use motet_stdlib::lang::failures;
use serde_json::Value;
use std::collections::{BTreeSet, VecDeque};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Time for the robot to stand still once all servers have succeeded.
const SETTLES: Duration = Duration::from_secs(5);

/// Time for the detector to tell of everything in view, in s.
const FINDS_ALL_SECS: f64 = 1.0;

/// What a task needs besides the robot.
pub(crate) struct Surroundings<'a> {
    pub(crate) robot: &'a mut Robot,
    pub(crate) world: &'a mut World,
    pub(crate) card: &'a Card,
}

/// A part of a motion.
#[derive(Clone, Debug)]
enum Move {
    Follow(Part, Vec<String>),
    Navigate([f64; 3]),
    /// Close the hand, where a path does.
    Grip,
    /// Goal of MoveGroup.
    Group(Value),
}

/// A goal of an action server that runs for a task.
#[derive(Clone, Debug)]
struct Running {
    action: usize,
    id: Uuid,
    sent: Instant,
    deadline: Instant,
    is_gripper: bool,
}

#[derive(Debug)]
enum Phase {
    /// The next move or step is due.
    Next,
    /// Servers are looked for before a goal is sent.
    Discovering {
        since: Instant,
    },
    /// Another thread looks for a path, as long as it is wanted.
    Planning {
        answer: Receiver<Box<Result<Witness, NoPath>>>,
        _wanted: Arc<()>,
    },
    Acting,
    Calling {
        service: usize,
        ticket: Ticket,
        until: Instant,
    },
    Waiting {
        until: Instant,
    },
    Detecting {
        until: Instant,
    },
    Answering {
        topic: String,
        value: String,
        until: Instant,
    },
}

/// Why a task is brought to a standstill.
#[derive(Clone, PartialEq, Debug)]
enum Ending {
    /// It goes on later.
    Hold,
    Cancel,
    Fail(FailureReport),
    SafeStop,
}

#[derive(Debug)]
struct Stopping {
    ending: Ending,
    since: Instant,
    /// Time of the last trajectories that stand still, with the actions that got one.
    stopped: Instant,
    replaced: Vec<usize>,
    is_told: bool,
}

/// End of a task.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Finish {
    Ended(Outcome),
    Stopped,
    Lost,
}

/// A goal of the host.
pub(crate) struct Task {
    pub(crate) command: Arc<Command>,
    /// Declaration of the primitive.
    called: CalledPrimitive,
    steps: VecDeque<Step>,
    moves: VecDeque<Move>,
    running: Vec<Running>,
    /// Goals of action servers whose end nobody knows.
    lost: Vec<(usize, Uuid)>,
    phase: Phase,
    /// Path of the last way there, with the names of its joints.
    path: Option<(Part, Vec<String>)>,
    /// Positions of the joints before MoveGroup moved them, for the way back.
    before: Option<Vec<(String, f64)>>,
    /// Opening of the hand that the grasp of the path asks for, in m.
    width: Option<f64>,
    /// Parts of the robot that the task has used.
    parts: Parts,
    result: Option<Argument>,
    detected: BTreeSet<String>,
    /// Move that runs, for a hold.
    current: Option<Move>,
    /// Places of a search that are left, and the one where it looks.
    elsewhere: VecDeque<String>,
    place: Option<String>,
    /// True once a path of the step has closed the hand: the rest of it is not looked for anew.
    has_gripped: bool,
    /// Number of paths of the step that were looked for because the robot was elsewhere.
    detours: u32,
    held: bool,
    stopping: Option<Stopping>,
    /// Everything has succeeded since, and the robot is to stand still.
    settling: Option<Instant>,
    /// Texts for people.
    pub(crate) feedback: Vec<String>,
    /// Feedback about motions that do not follow the path of the command.
    pub(crate) own_motions: Vec<String>,
}

impl Task {
    /// A task of some steps of a primitive.
    #[must_use]
    pub(crate) fn new(command: Arc<Command>, steps: Vec<Step>, called: CalledPrimitive) -> Self {
        Self {
            command,
            called,
            steps: steps.into(),
            moves: VecDeque::new(),
            running: Vec::new(),
            lost: Vec::new(),
            phase: Phase::Next,
            path: None,
            before: None,
            width: None,
            parts: Parts::default(),
            result: None,
            detected: BTreeSet::new(),
            current: None,
            elsewhere: VecDeque::new(),
            place: None,
            has_gripped: false,
            detours: 0,
            held: false,
            stopping: None,
            settling: None,
            feedback: Vec::new(),
            own_motions: Vec::new(),
        }
    }

    /// True if it is being brought to a standstill.
    #[must_use]
    pub(crate) fn is_stopping(&self) -> bool {
        self.stopping.is_some()
    }

    /// Arguments of the command by name.
    #[must_use]
    pub(crate) fn args(&self) -> Vec<(String, Argument)> {
        self.command.args.iter().map(|(name, value)| (name.to_string(), value.clone())).collect()
    }

    fn words(&self) -> Vec<String> {
        let word = |(_, value): &(smol_str::SmolStr, Argument)| match value {
            Argument::Text(text) | Argument::Entity(text) | Argument::Case(text) => text.to_string(),
            other => other.to_string(),
        };
        self.command.args.iter().map(word).collect()
    }

    /// A failure of the step that runs, in words.
    fn failure(&self, text: String) -> FailureReport {
        let step = self.steps.front();
        let fails = &self.called.fails;
        let kind = step
            .and_then(|step| step.fails.as_deref())
            .and_then(|kind| fails.iter().find(|own| *own == kind));
        let kind = kind.or(fails.first()).cloned().unwrap_or_else(|| failures::FAILED.into());
        FailureReport { kind, text: Some(text.into()) }
    }

    /// Brings the task to an early end.
    pub(crate) fn cancel(&mut self, around: &mut Surroundings<'_>) {
        self.stop(around, Ending::Cancel);
    }

    /// Brings the task to a safe stop.
    pub(crate) fn safe_stop(&mut self, around: &mut Surroundings<'_>) {
        self.stop(around, Ending::SafeStop);
    }

    /// Brings the task to a standstill. A stop that has begun goes on, with an ending that asks for more.
    fn stop(&mut self, around: &mut Surroundings<'_>, ending: Ending) {
        let (is_hold, is_safe_stop) = (ending == Ending::Hold, ending == Ending::SafeStop);
        match &mut self.stopping {
            Some(stopping) => {
                let asks_more = match stopping.ending {
                    Ending::Hold => !is_hold,
                    Ending::Cancel | Ending::Fail(_) => is_safe_stop,
                    Ending::SafeStop => false,
                };
                if !asks_more {
                    return;
                }
                stopping.ending = ending;
            }
            None => {
                for running in &self.running {
                    around.robot.actions[running.action].cancel(&around.robot.layouts, running.id);
                }
                let now = Instant::now();
                self.stopping =
                    Some(Stopping { ending, since: now, stopped: now, replaced: Vec::new(), is_told: false });
            }
        }
        if is_safe_stop && (self.parts.drives || self.parts.all || !around.robot.binding.stop.is_empty()) {
            around.robot.send_stops();
        }
        if is_hold {
            return;
        }
        if let Phase::Calling { service, ticket, .. } = self.phase {
            around.robot.services[service].forget(ticket);
        }
        self.phase = Phase::Next;
        self.current = None;
        self.steps.truncate(1);
        self.moves.clear();
    }

    /// Keeps still until [`Self::proceed`].
    pub(crate) fn hold(&mut self, around: &mut Surroundings<'_>) {
        self.held = true;
        if matches!(self.phase, Phase::Discovering { .. }) {
            // Nothing was sent yet; servers are looked for anew afterwards.
            self.phase = Phase::Next;
        }
        if !self.running.is_empty() {
            self.stop(around, Ending::Hold);
        }
    }

    /// Continues after a hold.
    pub(crate) fn proceed(&mut self) {
        self.held = false;
    }

    /// Takes in what was heard of goals, calls and topics.
    pub(crate) fn hear(&mut self, around: &mut Surroundings<'_>, heard: &RobotEvent) {
        match heard {
            RobotEvent::Goal(action, GoalEvent::Accepted(id)) => {
                if let Some(running) = self.running.iter().find(|one| one.action == *action && one.id == *id)
                {
                    let millis = running.sent.elapsed().as_secs_f64() * 1e3;
                    let name = &around.robot.actions[*action].name;
                    self.feedback.push(format!("{name} accepted after {millis:.2} ms"));
                }
            }
            RobotEvent::Goal(action, GoalEvent::Ended(id, end)) => self.hear_end(around, *action, *id, end),
            RobotEvent::Response(service, ticket, message) => {
                if let Phase::Calling { service: own, ticket: open, .. } = &self.phase
                    && own == service
                    && open == ticket
                {
                    let is_refused = message.get("success") == Some(&Message::Bool(false));
                    if is_refused {
                        let text = format!("the service answered: {}", message.text("message"));
                        self.fail(around, text);
                    } else {
                        self.step_done();
                    }
                }
            }
            RobotEvent::Detected(things) => {
                if matches!(self.phase, Phase::Detecting { .. }) {
                    self.hear_detections(around, things);
                }
            }
            RobotEvent::Goal(_, GoalEvent::Feedback(..)) | RobotEvent::Kept => {}
        }
    }

    fn hear_end(&mut self, around: &mut Surroundings<'_>, action: usize, id: Uuid, end: &End) {
        let Some(at) = self.running.iter().position(|one| one.action == action && one.id == id) else {
            return;
        };
        let running = self.running.swap_remove(at);
        if matches!(end, End::Lost(_)) {
            self.lost.push((action, id));
        }
        if self.stopping.is_some() {
            return;
        }
        let name = around.robot.actions[action].name.clone();
        match end {
            End::Succeeded(result) if move_group::is_failure(result) => {
                self.fail(around, format!("{name}: {}", move_group::error(result)));
            }
            End::Succeeded(_) => {}
            // A hand that closes on a thing stalls, which some controllers report as an abort.
            End::Aborted(result) if running.is_gripper && result.is_true("stalled") => {}
            End::Aborted(result) => {
                self.fail(around, format!("{name} aborted: {}", move_group::error(result)));
            }
            End::Rejected => self.fail(around, format!("{name} refused the goal")),
            End::Canceled => self.fail(around, format!("somebody canceled the goal of {name}")),
            End::Lost(why) => self.fail(around, why.clone()),
        }
        if self.stopping.is_none() && self.running.is_empty() && matches!(self.phase, Phase::Acting) {
            self.current = None;
            if self.moves.is_empty() { self.step_done() } else { self.phase = Phase::Next }
        }
    }

    /// Ends the step in a failure, once everything stands still.
    fn fail(&mut self, around: &mut Surroundings<'_>, text: String) {
        let text = match self.steps.front().and_then(|step| step.text.clone()) {
            Some(own) => format!("{own} ({text})"),
            None => text,
        };
        let failure = self.failure(text);
        self.stop(around, Ending::Fail(failure));
    }

    fn step_done(&mut self) {
        self.steps.pop_front();
        (self.phase, self.detours, self.has_gripped) = (Phase::Next, 0, false);
    }

    /// True once the parts that the task has moved stand still: a server that says that it has succeeded is
    /// no reason to say that the robot does.
    fn stands(&mut self, around: &mut Surroundings<'_>) -> bool {
        // What a call moves nobody knows, and other tasks may move the rest.
        let known = Parts { all: false, ..self.parts.clone() };
        let is_still = around.robot.body.is_still(&known, &around.robot.binding);
        let since = *self.settling.get_or_insert_with(Instant::now);
        if !is_still && since.elapsed() > SETTLES {
            self.fail(around, "the servers have succeeded, and the robot does not stand still".to_owned());
        }
        is_still
    }

    /// Goes on as far as possible; the end of the task, if it has come.
    pub(crate) fn advance(&mut self, around: &mut Surroundings<'_>) -> Option<Finish> {
        if self.stopping.is_some() {
            return self.advance_stop(around);
        }
        for _ in 0..64 {
            if self.stopping.is_some() {
                return self.advance_stop(around);
            }
            let is_blocked = match &self.phase {
                Phase::Next if self.held => true,
                Phase::Next if self.moves.is_empty() && self.steps.is_empty() => {
                    if self.stands(around) {
                        return Some(Finish::Ended(Outcome::Success(self.result.clone())));
                    }
                    self.stopping.is_none()
                }
                Phase::Next | Phase::Discovering { .. } => !self.begin(around),
                _ => !self.is_over(around),
            };
            if is_blocked {
                return None;
            }
        }
        None
    }

    /// Begins the next move or step. `false` if it has to wait.
    fn begin(&mut self, around: &mut Surroundings<'_>) -> bool {
        if let Some(next) = self.moves.front().cloned() {
            return self.begin_move(around, next);
        }
        let Some(step) = self.steps.front().cloned() else { return true };
        match step.kind {
            StepKind::Motion(direction) => self.begin_motion(around, direction),
            StepKind::Posture(_) | StepKind::Go(_) => self.begin_way(around),
            StepKind::Search => self.begin_search(around),
            StepKind::Look => self.begin_look(around),
            StepKind::Gripper(opening) => self.begin_gripper(around, opening),
            StepKind::Call(call) => self.begin_call(around, &call),
            StepKind::Wait(secs) => {
                let until = Instant::now() + Duration::from_secs_f64(secs.clamp(0.0, 3600.0));
                self.phase = Phase::Waiting { until };
                false
            }
            StepKind::Require(text) => {
                match around.robot.holds(&text, &self.words()) {
                    Ok(true) => self.step_done(),
                    Ok(false) => self.fail(around, format!("`{text}` is false")),
                    Err(wrong) => self.fail(around, wrong),
                }
                true
            }
            StepKind::Detect => {
                let secs = around.robot.binding.detections.as_ref().map_or(0.0, |topic| topic.timeout_secs);
                let most = if self.finds_all() { FINDS_ALL_SECS } else { 3600.0 };
                let until = Instant::now() + Duration::from_secs_f64(secs.clamp(0.0, most));
                self.detected.clear();
                self.phase = Phase::Detecting { until };
                false
            }
            StepKind::Answer { topic, value, timeout_secs, .. } => {
                around.robot.forget(&topic);
                let until = Instant::now() + Duration::from_secs_f64(timeout_secs.clamp(0.0, 3600.0));
                self.phase = Phase::Answering { topic, value, until };
                false
            }
        }
    }

    /// True if what the phase waits for has come, and the next step is due.
    fn is_over(&mut self, around: &mut Surroundings<'_>) -> bool {
        let now = Instant::now();
        match &self.phase {
            Phase::Planning { answer, .. } => {
                let answer = match answer.try_recv() {
                    Ok(answer) => answer,
                    Err(TryRecvError::Empty) => return false,
                    Err(TryRecvError::Disconnected) => {
                        Box::new(Err("the search for a path has broken off".to_owned().into()))
                    }
                };
                let looks = self.steps.front().is_some_and(|step| step.kind == StepKind::Look);
                match *answer {
                    Ok(witness) => self.take_path(around, &witness),
                    Err(_) if looks => self.step_done(),
                    // A goal of MoveGroup is that of the command.
                    Err(why) if self.way().is_some() => self.fail(around, why.says),
                    Err(why) => self.plan_by_move_group(around, &why),
                }
                true
            }
            Phase::Acting => {
                let late = self.running.iter().find(|running| now > running.deadline).cloned();
                if let Some(late) = late {
                    let name = around.robot.actions[late.action].name.clone();
                    self.fail(around, format!("{name} did not end in time"));
                    return true;
                }
                // A robot of which nothing is heard cannot be said to move as it should.
                let silent = unheard(around.robot).filter(|_| !self.parts.is_empty());
                if let Some(silent) = silent {
                    self.fail(around, silent);
                    return true;
                }
                false
            }
            Phase::Calling { service, ticket, until } => {
                if now > *until {
                    let (service, ticket) = (*service, *ticket);
                    around.robot.services[service].forget(ticket);
                    self.fail(around, "a service did not answer in time".to_owned());
                    return true;
                }
                false
            }
            Phase::Waiting { until } => {
                let is_over = now > *until;
                if is_over {
                    self.step_done();
                }
                is_over
            }
            Phase::Detecting { until } => {
                let is_late = now > *until;
                self.find_detected(around, is_late)
            }
            Phase::Answering { topic, value, until } => {
                let (topic, value, is_late) = (topic.clone(), value.clone(), now > *until);
                match around.robot.evaluate(&topic, &value, &self.words(), Duration::from_secs(5)) {
                    // Without a result, the value is what is waited for.
                    Some(Found::Truth(false)) if self.called.result.is_none() && !is_late => false,
                    Some(Found::Truth(false)) if self.called.result.is_none() => {
                        self.fail(around, format!("`{value}` is false on {topic}"));
                        true
                    }
                    Some(found) => {
                        match self.answered(around, found) {
                            Ok(answer) => {
                                self.result = answer;
                                self.step_done();
                            }
                            Err(why) => self.fail(around, why),
                        }
                        true
                    }
                    None if is_late => {
                        self.fail(around, format!("no answer on {topic}"));
                        true
                    }
                    None => false,
                }
            }
            Phase::Next | Phase::Discovering { .. } => true,
        }
    }
}

/// What the robot has not said of its joints or its base, which a motion needs.
fn unheard(robot: &Robot) -> Option<String> {
    let joints = robot.binding.controllers.iter().flat_map(|controller| &controller.joints);
    let mut unknown = joints.filter(|joint| robot.body.position(joint).is_none());
    if let Some(joint) = unknown.next() {
        return Some(format!("no fresh state of `{joint}` on {}", robot.binding.joints.topic));
    }
    let is_driving = robot.binding.base.odometry.is_some();
    is_driving.then(|| robot.body.base(&robot.binding).err()).flatten()
}
