//! A goal of the host as a row of steps: trajectories, navigations, the hand, and calls.

mod move_group;
mod moving;
mod stopping;

pub(crate) use stopping::stand_still;

use crate::action::{End, News, Uuid};
use crate::bind::{Call, CallKind, Deed, Opening, Step};
use crate::cdr::Message;
use crate::joint::Part;
use crate::observe::Found;
use crate::plan::{Card, NoPath};
use crate::robot::{Heard, Robot};
use crate::service::Ticket;
use crate::state::Parts;
use crate::template::{fill, of_argument, of_pose};
use crate::tf::Transform;
use crate::world::World;
use crossbeam_channel::Receiver;
use motet_graph::{Value as Argument, Witness};
use motet_runtime::{Command, FailureReport, Outcome};
use serde_json::{Value, json};
use std::collections::VecDeque;
use std::sync::Arc;
use std::time::{Duration, Instant};

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
    /// Another thread looks for a path.
    Planning {
        answer: Receiver<Box<Result<Witness, NoPath>>>,
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

/// Why a task is brought to an end.
#[derive(Clone, PartialEq, Debug)]
enum Ending {
    Cancel,
    Fail(FailureReport),
    SafeStop,
}

#[derive(Debug)]
struct Stopping {
    ending: Ending,
    since: Instant,
    stopped: Instant,
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
    fails: Vec<String>,
    steps: VecDeque<Step>,
    moves: VecDeque<Move>,
    running: Vec<Running>,
    phase: Phase,
    /// Path of the last way there, with the names of its joints.
    path: Option<(Part, Vec<String>)>,
    /// Positions of the joints before MoveGroup moved them, for the way back.
    before: Option<Vec<(String, f64)>>,
    width: f64,
    parts: (Vec<String>, bool),
    result: Option<Argument>,
    detected: Vec<String>,
    /// Move that runs, for a hold.
    current: Option<Move>,
    held: bool,
    holding: bool,
    stopping: Option<Stopping>,
    /// Texts for people.
    pub(crate) feedback: Vec<String>,
}

impl Task {
    /// A task of some steps. `fails` are the failures that its primitive declares.
    #[must_use]
    pub(crate) fn new(command: Arc<Command>, steps: Vec<Step>, fails: Vec<String>) -> Self {
        Self {
            command,
            fails,
            steps: steps.into(),
            moves: VecDeque::new(),
            running: Vec::new(),
            phase: Phase::Next,
            path: None,
            before: None,
            width: 0.0,
            parts: (Vec::new(), false),
            result: None,
            detected: Vec::new(),
            current: None,
            held: false,
            holding: false,
            stopping: None,
            feedback: Vec::new(),
        }
    }

    /// Parts of the robot that the task has used.
    fn parts(&self) -> Parts {
        Parts::Some(self.parts.0.clone(), self.parts.1)
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
        let kind = step.and_then(|step| step.fails.clone()).filter(|kind| self.fails.contains(kind));
        let kind = kind.or_else(|| self.fails.first().cloned()).unwrap_or_else(|| "failed".to_owned());
        FailureReport { kind: kind.into(), text: Some(text.into()) }
    }

    /// Brings the task to an early end.
    pub(crate) fn cancel(&mut self, around: &mut Surroundings<'_>) {
        self.stop(around, Ending::Cancel);
    }

    /// Brings the task to a safe stop.
    pub(crate) fn safe_stop(&mut self, around: &mut Surroundings<'_>) {
        self.stop(around, Ending::SafeStop);
    }

    fn stop(&mut self, around: &mut Surroundings<'_>, ending: Ending) {
        let is_safe_stop = ending == Ending::SafeStop;
        if let Some(stopping) = &mut self.stopping {
            if is_safe_stop {
                (stopping.ending, stopping.since) = (ending, Instant::now());
            }
            return;
        }
        for running in &self.running {
            around.robot.actions[running.action].cancel(&around.robot.layouts, running.id);
        }
        if is_safe_stop && (self.parts.1 || !around.robot.binding.stop.is_empty()) {
            around.robot.send_stops();
        }
        let now = Instant::now();
        self.stopping = Some(Stopping { ending, since: now, stopped: now, is_told: false });
        self.steps.truncate(1);
        self.moves.clear();
    }

    /// Keeps still until [`Self::proceed`].
    pub(crate) fn hold(&mut self, around: &mut Surroundings<'_>) {
        self.held = true;
        if self.current.is_some() && !self.holding {
            self.holding = true;
            for running in &self.running {
                around.robot.actions[running.action].cancel(&around.robot.layouts, running.id);
            }
        }
    }

    /// Continues after a hold.
    pub(crate) fn proceed(&mut self) {
        self.held = false;
    }

    /// Takes in what was heard of goals, calls and topics.
    pub(crate) fn hear(&mut self, around: &mut Surroundings<'_>, heard: &Heard) {
        match heard {
            Heard::Goal(action, News::Accepted(id)) => {
                if let Some(running) = self.running.iter().find(|one| one.action == *action && one.id == *id)
                {
                    let millis = running.sent.elapsed().as_secs_f64() * 1e3;
                    let name = &around.robot.actions[*action].name;
                    self.feedback.push(format!("{name} accepted after {millis:.2} ms"));
                }
            }
            Heard::Goal(action, News::Ended(id, end)) => self.hear_end(around, *action, *id, end),
            Heard::Response(service, ticket, message) => {
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
            Heard::Detected(things) => {
                if matches!(self.phase, Phase::Detecting { .. }) {
                    self.detected.extend(things.iter().filter_map(|thing| thing.id.clone()));
                }
            }
            Heard::Goal(_, News::Feedback(..)) | Heard::Kept => {}
        }
    }

    fn hear_end(&mut self, around: &mut Surroundings<'_>, action: usize, id: Uuid, end: &End) {
        let Some(at) = self.running.iter().position(|one| one.action == action && one.id == id) else {
            return;
        };
        let running = self.running.swap_remove(at);
        if self.stopping.is_some() || self.holding {
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
        self.phase = Phase::Next;
    }

    /// Goes on as far as possible; the end of the task, if it has come.
    pub(crate) fn advance(&mut self, around: &mut Surroundings<'_>) -> Option<Finish> {
        if self.stopping.is_some() {
            return self.advance_stop(around);
        }
        if self.holding {
            self.advance_hold(around);
            return None;
        }
        for _ in 0..64 {
            if self.stopping.is_some() {
                return self.advance_stop(around);
            }
            let is_blocked = match &self.phase {
                Phase::Next if self.held => true,
                Phase::Next if self.moves.is_empty() && self.steps.is_empty() => {
                    let outcome = Outcome::Success(self.result.clone());
                    return Some(Finish::Ended(outcome));
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
        match step.deed {
            Deed::Motion(direction) => self.begin_motion(around, direction),
            Deed::Look => self.begin_look(around),
            Deed::Gripper(opening) => self.begin_gripper(around, opening),
            Deed::Call(call) => self.begin_call(around, &call),
            Deed::Wait(secs) => {
                let until = Instant::now() + Duration::from_secs_f64(secs.clamp(0.0, 3600.0));
                self.phase = Phase::Waiting { until };
                false
            }
            Deed::Require(text) => {
                match around.robot.holds(&text, &self.words()) {
                    Ok(true) => self.step_done(),
                    Ok(false) => self.fail(around, format!("`{text}` is false")),
                    Err(wrong) => self.fail(around, wrong),
                }
                true
            }
            Deed::Detect => {
                let secs = around.robot.binding.detections.as_ref().map_or(0.0, |topic| topic.timeout_secs);
                let until = Instant::now() + Duration::from_secs_f64(secs.clamp(0.0, 3600.0));
                self.detected.clear();
                self.phase = Phase::Detecting { until };
                false
            }
            Deed::Answer { topic, value, timeout_secs, .. } => {
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
            Phase::Planning { answer } => {
                let Ok(answer) = answer.try_recv() else { return false };
                let looks = self.steps.front().is_some_and(|step| step.deed == Deed::Look);
                match *answer {
                    Ok(witness) => self.take_path(around, &witness),
                    Err(_) if looks => self.step_done(),
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
                let silent = unheard(around.robot).filter(|_| !self.parts.0.is_empty() || self.parts.1);
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
                    Some(found) => {
                        self.result = Some(match found {
                            Found::Truth(truth) => Argument::Bool(truth),
                            Found::Number(number) => Argument::Number(number),
                            Found::Text(text) => Argument::Text(text.into()),
                        });
                        self.step_done();
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

    fn find_detected(&mut self, around: &mut Surroundings<'_>, is_late: bool) -> bool {
        let what = self.words().into_iter().next().unwrap_or_default();
        let wanted = around.world.matches(&what);
        let mut found: Vec<String> = wanted.into_iter().filter(|id| self.detected.contains(id)).collect();
        found.sort();
        let ambiguous = self.fails.iter().any(|kind| kind == "ambiguous");
        match found.as_slice() {
            [] if is_late => {
                let failure = FailureReport {
                    kind: "not_found".into(),
                    text: Some(format!("no detection is called {what}").into()),
                };
                self.stop(around, Ending::Fail(failure));
                true
            }
            [] => false,
            [_, _, ..] if ambiguous => {
                let text = format!("{} detections are called {what}", found.len());
                let failure = FailureReport { kind: "ambiguous".into(), text: Some(text.into()) };
                self.stop(around, Ending::Fail(failure));
                true
            }
            [id, ..] => {
                self.result = Some(Argument::Entity(id.as_str().into()));
                self.step_done();
                true
            }
        }
    }

    // Hand and calls.

    fn begin_gripper(&mut self, around: &mut Surroundings<'_>, opening: Opening) -> bool {
        let Some(gripper) = around.robot.binding.gripper.clone() else { return true };
        let Some(action) = around.robot.action_at(&gripper.action) else { return true };
        if !self.are_there(around, &[action]) {
            return self.stopping.is_some();
        }
        let template = match opening {
            Opening::Open => &gripper.open,
            Opening::Close => &gripper.close,
            Opening::Width => gripper.width.as_ref().unwrap_or(&gripper.open),
        };
        let width = gripper.offset + gripper.scale * self.width;
        let named =
            |name: &str| if name == "width" { Ok(json!(width)) } else { Err(format!("no value `{name}`")) };
        match fill(template, &named) {
            Ok(goal) => self.send(around, vec![(action, goal, gripper.timeout_secs)], true),
            Err(why) => self.fail(around, why),
        }
        self.stopping.is_some()
    }

    fn begin_call(&mut self, around: &mut Surroundings<'_>, call: &Call) -> bool {
        let message = fill(&call.message, &|name| self.named(around, name));
        let message = match message {
            Ok(message) => message,
            Err(why) => {
                self.fail(around, why);
                return true;
            }
        };
        match call.kind {
            CallKind::Topic => {
                match around.robot.publish(&call.name, &message) {
                    Ok(()) => self.step_done(),
                    Err(why) => self.fail(around, why),
                }
                true
            }
            CallKind::Service => {
                let Some(service) = around.robot.service_at(&call.name) else { return true };
                match around.robot.services[service].call(&around.robot.layouts, &message) {
                    Ok(ticket) => {
                        let until =
                            Instant::now() + Duration::from_secs_f64(call.timeout_secs.clamp(0.0, 3600.0));
                        self.phase = Phase::Calling { service, ticket, until };
                        false
                    }
                    Err(why) => {
                        self.fail(around, why);
                        true
                    }
                }
            }
            CallKind::Action => {
                let Some(action) = around.robot.action_at(&call.name) else { return true };
                if !self.are_there(around, &[action]) {
                    return self.stopping.is_some();
                }
                self.send(around, vec![(action, message, call.timeout_secs)], false);
                self.stopping.is_some()
            }
        }
    }

    /// Value in a message: an argument, `NAME.pose` of an entity, the `goal` of the base, or a pose
    /// `NAME in FRAME`.
    fn named(&self, around: &Surroundings<'_>, name: &str) -> Result<Value, String> {
        let (name, frame) =
            name.split_once(" in ").map_or((name, None), |(name, frame)| (name, Some(frame.trim())));
        let (name, field) = name.split_once('.').map_or((name, None), |(name, field)| (name, Some(field)));
        let pose = if name == "goal" {
            let (part, _) = self.path.as_ref().ok_or("the command has no path yet")?;
            let [x, y, yaw] = part.waypoints.last().map_or([0.0; 3], |(base, _)| *base);
            Some(Transform::from_rpy([x, y, 0.0], [0.0, 0.0, yaw]))
        } else {
            let argument = self.command.args.iter().find(|(own, _)| own == name);
            let (_, value) = argument.ok_or_else(|| format!("the command has no argument `{name}`"))?;
            match (value, field) {
                (Argument::Entity(id), Some("pose")) => {
                    Some(around.world.pose(id).ok_or_else(|| format!("nobody knows where `{id}` is"))?)
                }
                (Argument::Pose(pose), None) => {
                    Some(Transform { xyz: pose.xyz, quaternion: pose.quaternion })
                }
                (value, None) => return Ok(of_argument(value)),
                (_, Some(field)) => return Err(format!("`{name}` has no `{field}`")),
            }
        };
        let mut pose = pose.ok_or_else(|| format!("`{name}` is no pose"))?;
        if let Some(frame) = frame {
            let frames = &around.robot.binding.frames;
            let to_map = around.robot.body.frames.look_up(frame, &frames.map, None, frames.age_secs)?;
            pose = to_map.then(pose);
        }
        Ok(of_pose(pose.xyz, pose.quaternion))
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
