//! A goal of the host as a row of steps: trajectories, navigations, the hand, and calls.

use crate::action::{End, News, Uuid};
use crate::bind::{Call, CallKind, Deed, Direction, Opening, Step};
use crate::cdr::Message;
use crate::joint::{Axis, Part, Trajectory};
use crate::observe::Found;
use crate::plan::{self, Question};
use crate::robot::{Heard, Robot};
use crate::service::Ticket;
use crate::state::Parts;
use crate::template::{fill, of_argument, of_pose};
use crate::tf::{Planar, Transform};
use crate::world::World;
use crossbeam_channel::{Receiver, bounded};
use motet_graph::{Value as Argument, Witness};
use motet_runtime::{Command, FailureReport, Outcome};
use serde_json::{Value, json};
use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Time for a server to end a goal after its cancel. Then a trajectory that stands still takes its place.
const HEEDS: Duration = Duration::from_millis(1500);
/// Time between two stops that are sent to a robot that still moves.
const STOPS_AGAIN: Duration = Duration::from_millis(500);
/// Time for standstill before an interrupted goal counts as lost.
const STANDS: Duration = Duration::from_secs(6);

/// What a task needs besides the robot.
pub struct Surroundings<'a> {
    pub robot: &'a mut Robot,
    pub world: &'a mut World,
    /// Robot as the command line names it, and the command that plans.
    pub card: &'a str,
    pub planner: Option<&'a PathBuf>,
}

/// A part of a motion.
#[derive(Clone, Debug)]
enum Move {
    Follow(Part, Vec<String>),
    Navigate([f64; 3]),
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
    Discovering { since: Instant },
    /// Another thread looks for a path.
    Planning { answer: Receiver<Result<Witness, String>> },
    Acting,
    Calling { service: usize, ticket: Ticket, until: Instant },
    Waiting { until: Instant },
    Detecting { until: Instant },
    Answering { topic: String, value: String, until: Instant },
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
pub enum Finish {
    Ended(Outcome),
    Stopped,
    Lost,
}

/// A goal of the host.
pub struct Task {
    pub command: Arc<Command>,
    fails: Vec<String>,
    steps: VecDeque<Step>,
    moves: VecDeque<Move>,
    running: Vec<Running>,
    phase: Phase,
    /// Path of the last way there, with the names of its joints.
    path: Option<(Part, Vec<String>)>,
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
    pub feedback: Vec<String>,
}

impl Task {
    /// A task of some steps. `fails` are the failures that its primitive declares.
    #[must_use]
    pub fn new(command: Arc<Command>, steps: Vec<Step>, fails: Vec<String>) -> Self {
        Self {
            command,
            fails,
            steps: steps.into(),
            moves: VecDeque::new(),
            running: Vec::new(),
            phase: Phase::Next,
            path: None,
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
    pub fn args(&self) -> Vec<(String, Argument)> {
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
    pub fn cancel(&mut self, around: &mut Surroundings<'_>) {
        self.stop(around, Ending::Cancel);
    }

    /// Brings the task to a safe stop.
    pub fn safe_stop(&mut self, around: &mut Surroundings<'_>) {
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
    pub fn hold(&mut self, around: &mut Surroundings<'_>) {
        self.held = true;
        if self.current.is_some() && !self.holding {
            self.holding = true;
            for running in &self.running {
                around.robot.actions[running.action].cancel(&around.robot.layouts, running.id);
            }
        }
    }

    /// Continues after a hold.
    pub fn proceed(&mut self) {
        self.held = false;
    }

    /// Takes in what was heard of goals, calls and topics.
    pub fn hear(&mut self, around: &mut Surroundings<'_>, heard: &Heard) {
        match heard {
            Heard::Goal(action, News::Accepted(id)) => {
                if let Some(running) = self.running.iter().find(|one| one.action == *action && one.id == *id) {
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
            Heard::Goal(_, News::Feedback(..)) | Heard::Kept(_) => {}
        }
    }

    fn hear_end(&mut self, around: &mut Surroundings<'_>, action: usize, id: Uuid, end: &End) {
        let Some(at) = self.running.iter().position(|one| one.action == action && one.id == id) else { return };
        let running = self.running.swap_remove(at);
        if self.stopping.is_some() || self.holding {
            return;
        }
        let name = around.robot.actions[action].name.clone();
        match end {
            End::Succeeded(_) => {}
            // A hand that closes on a thing stalls, which some controllers report as an abort.
            End::Aborted(result) if running.is_gripper && result.is_true("stalled") => {}
            End::Aborted(result) => {
                let code = ["error_code", "error_string", "error_msg"].map(|field| match result.get(field) {
                    Some(Message::Text(text)) => text.clone(),
                    Some(Message::Int(code)) => code.to_string(),
                    Some(Message::Uint(code)) => code.to_string(),
                    _ => String::new(),
                });
                let code = code.iter().filter(|part| !part.is_empty()).cloned().collect::<Vec<_>>().join(" ");
                self.fail(around, format!("{name} aborted: {code}"));
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
    pub fn advance(&mut self, around: &mut Surroundings<'_>) -> Option<Finish> {
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
                match answer {
                    Ok(witness) => self.take_path(around, &witness),
                    Err(_) if looks => self.step_done(),
                    Err(why) => self.fail(around, why),
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

    // Motions.

    fn begin_motion(&mut self, around: &mut Surroundings<'_>, direction: Direction) -> bool {
        if direction == Direction::Back {
            let Some((part, names)) = self.path.clone() else {
                self.fail(around, "no way there was followed before".to_owned());
                return true;
            };
            self.plan_moves(around, &part.reversed(), &names);
            return true;
        }
        let Some(motion) = self.command.motions.first().cloned() else {
            self.fail(around, "the command has no motion".to_owned());
            return true;
        };
        if let Some(missing) = unheard(around.robot) {
            return !self.waits_for(around, &missing) && self.stopping.is_some();
        }
        if let Some(witness) = &motion.witness {
            match self.departure(around, witness) {
                Ok(()) => {
                    self.take_path(around, &witness.clone());
                    return true;
                }
                Err(away) => self.feedback.push(format!("{away}; a new path is looked for")),
            }
        }
        if let Err(why) = self.plan(around, plan::motion(&motion)) {
            self.fail(around, why);
            return true;
        }
        false
    }

    /// Turns the camera to what the first argument is or describes. Without a place or a way to look the step
    /// is over: the detection says what is in view.
    fn begin_look(&mut self, around: &mut Surroundings<'_>) -> bool {
        if let Some(missing) = unheard(around.robot) {
            return !self.waits_for(around, &missing) && self.stopping.is_some();
        }
        let wanted = match self.command.args.first() {
            Some((_, Argument::Entity(id))) => Some(id.to_string()),
            Some((_, Argument::Text(text))) => {
                around.world.matches(text).into_iter().find(|id| around.world.pose(id).is_some())
            }
            _ => None,
        };
        let looks = wanted.map(|id| format!("look({})", plan::written(&Argument::Entity(id.into()))));
        if looks.is_none_or(|motion| self.plan(around, motion).is_err()) {
            self.step_done();
            return true;
        }
        false
    }

    /// Looks for a path from where the robot stands, on another thread.
    fn plan(&mut self, around: &Surroundings<'_>, motion: String) -> Result<(), String> {
        let binding = &around.robot.binding;
        let base = around.robot.body.base(binding).or_else(|why| match binding.base.odometry {
            None => {
                let [x, y, yaw] = around.world.scene.robot.base;
                Ok(Planar { x, y, yaw })
            }
            Some(_) => Err(why),
        })?;
        let program = around.planner.ok_or("the robot does not stand where the path begins")?.clone();
        let positions = around.robot.body.positions();
        let controlled = positions.iter().filter(|(name, _)| binding.controls(name));
        let joints = controlled.map(|(name, value)| (binding.card_joint(name).to_owned(), *value)).collect();
        let question = Question::new(program, around.card, &around.world.scene, motion, base, &joints);
        let (sender, answer) = bounded(1);
        std::thread::spawn(move || sender.send(question.ask()));
        self.phase = Phase::Planning { answer };
        Ok(())
    }

    /// Says how far the robot is from the start of a path, if it is too far.
    fn departure(&self, around: &Surroundings<'_>, witness: &Witness) -> Result<(), String> {
        let binding = &around.robot.binding;
        let Some(first) = witness.path.first() else { return Err("the path has no waypoint".to_owned()) };
        for (joint, value) in witness.joints.iter().zip(&first.joints) {
            let name = binding.ros_joint(joint);
            // Joints of the hand are moved by the steps of the primitive.
            if !binding.controls(name) {
                continue;
            }
            let is = around.robot.body.position(name);
            let Some(is) = is else { return Err(format!("the position of `{name}` is unknown")) };
            if (is - value).abs() > binding.start.joints {
                return Err(format!("`{name}` is at {is:.3}, and the path begins at {value:.3}"));
            }
        }
        if binding.base.odometry.is_some() {
            let base = around.robot.body.base(binding)?;
            let apart = (base.x - first.base[0]).hypot(base.y - first.base[1]);
            let turn = wrapped(base.yaw - first.base[2]).abs();
            if apart > binding.start.base || turn > binding.start.turn {
                return Err(format!("the base is {apart:.3} m and {turn:.3} rad from where the path begins"));
            }
        }
        Ok(())
    }

    fn take_path(&mut self, around: &mut Surroundings<'_>, witness: &Witness) {
        let binding = &around.robot.binding;
        // The path was checked for the expected place of the base: it needs room for the error of that place.
        if let Some(sigma) = around.robot.body.sigma {
            let needed = sigma * binding.base.sigmas;
            if witness.clearance < needed {
                let text = format!(
                    "the path keeps {:.3} m clear, and the localisation has an error of {needed:.3} m",
                    witness.clearance
                );
                self.fail(around, text);
                return;
            }
        }
        self.width = witness.grasp.as_ref().map_or(0.0, |grasp| grasp.width);
        let stretch = self.command.manner.map_or(1.0, motet_graph::Manner::stretch);
        let is_planned = self.command.motions.first().and_then(|motion| motion.witness.as_deref()) != Some(witness);
        let mut part = Part::of(witness);
        if is_planned {
            // A path of the driver's own has the times of full speed.
            part.legs.iter_mut().flatten().for_each(|secs| *secs *= stretch);
        }
        let names: Vec<String> = witness.joints.iter().map(ToString::to_string).collect();
        self.path = Some((part.clone(), names.clone()));
        self.plan_moves(around, &part, &names);
    }

    /// Splits a path into moves that the controllers can carry out.
    fn plan_moves(&mut self, around: &mut Surroundings<'_>, part: &Part, names: &[String]) {
        let binding = &around.robot.binding;
        let follows = binding.controllers.iter().any(|controller| !controller.base.is_empty());
        if !part.drives() || follows {
            self.moves.push_back(Move::Follow(part.clone(), names.to_vec()));
        } else if binding.navigation.is_some() {
            let Some(phases) = part.phases() else {
                self.fail(around, "base and arm move at once, which a navigation cannot".to_owned());
                return;
            };
            for (drives, phase) in phases {
                let end = phase.waypoints.last().map_or([0.0; 3], |(base, _)| *base);
                self.moves.push_back(if drives { Move::Navigate(end) } else { Move::Follow(phase, names.to_vec()) });
            }
        } else {
            self.fail(around, "nothing is bound that drives the base".to_owned());
            return;
        }
        self.phase = Phase::Next;
        if self.moves.is_empty() {
            self.step_done();
        }
    }

    fn begin_move(&mut self, around: &mut Surroundings<'_>, next: Move) -> bool {
        let goals = match self.goals(around, &next) {
            Ok(goals) => goals,
            Err(why) => {
                self.fail(around, why);
                return true;
            }
        };
        if goals.is_empty() {
            // The robot is where the move ends.
            self.moves.pop_front();
            if self.moves.is_empty() { self.step_done() } else { self.phase = Phase::Next }
            return true;
        }
        let actions: Vec<usize> = goals.iter().map(|(action, ..)| *action).collect();
        if !self.are_there(around, &actions) {
            return self.stopping.is_some();
        }
        self.moves.pop_front();
        self.current = Some(next);
        self.send(around, goals, false);
        self.stopping.is_some()
    }

    /// Goals of a move, with the seconds that each may take.
    fn goals(&mut self, around: &Surroundings<'_>, next: &Move) -> Result<Vec<(usize, Value, f64)>, String> {
        let robot = &around.robot;
        match next {
            Move::Navigate(end) => {
                let navigation = robot.binding.navigation.as_ref().ok_or("no navigation is bound")?;
                let action = robot.action_at(&navigation.action).ok_or("the navigation is not open")?;
                let pose = Transform::from_rpy([end[0], end[1], 0.0], [0.0, 0.0, end[2]]);
                let header = json!({"frame_id": robot.binding.frames.map});
                let goal = json!({"pose": {"header": header, "pose": of_pose(pose.xyz, pose.quaternion)},
                    "behavior_tree": navigation.behavior_tree});
                self.parts.1 = true;
                Ok(vec![(action, goal, self.command.deadline_secs)])
            }
            Move::Follow(part, names) => {
                let names: Vec<&str> = names.iter().map(String::as_str).collect();
                let mut goals = Vec::new();
                for controller in &robot.binding.controllers {
                    let action = robot.action_at(&controller.action).ok_or("a controller is not open")?;
                    let trajectory = self.trajectory(robot, controller, part, &names)?;
                    if let Some(trajectory) = trajectory {
                        if controller.base.is_empty() {
                            self.parts.0.extend(controller.joints.iter().cloned());
                        } else {
                            self.parts.1 = true;
                        }
                        goals.push((action, trajectory.goal(), part.secs() + controller.late_secs));
                    }
                }
                self.check_controlled(robot, part, &names)?;
                Ok(goals)
            }
        }
    }

    fn trajectory(
        &self,
        robot: &Robot,
        controller: &crate::bind::Controller,
        part: &Part,
        names: &[&str],
    ) -> Result<Option<Trajectory>, String> {
        if controller.base.len() == 3 {
            if !part.drives() {
                return Ok(None);
            }
            let frames = &robot.binding.frames;
            let frame = robot.body.frames.look_up(&frames.map, &controller.frame, None, frames.age_secs)?;
            let axes = [Axis::Base(0), Axis::Base(1), Axis::Base(2)];
            let mut trajectory = part.trajectory(&controller.base, &axes, names, frame.planar());
            // An axis of yaw may have gone round before: of all turns, the one where it is.
            let (points, is) = (trajectory.iter_mut().flat_map(|one| &mut one.points), robot.body.position(&controller.base[2]));
            let mut turns = None;
            for point in points {
                let yaw = &mut point.positions[2];
                let turns = *turns.get_or_insert_with(|| is.map_or(0.0, |is| is - *yaw - wrapped(is - *yaw)));
                *yaw += turns;
            }
            return Ok(trajectory);
        }
        let axes: Vec<Axis<'_>> = controller
            .joints
            .iter()
            .map(|joint| Axis::Joint(robot.binding.card_joint(joint), robot.body.position(joint).unwrap_or(f64::NAN)))
            .collect();
        let trajectory = part.trajectory(&controller.joints, &axes, names, Planar::default());
        let is_known = |trajectory: &Trajectory| {
            trajectory.points.iter().all(|point| point.positions.iter().all(|position| position.is_finite()))
        };
        match trajectory {
            Some(trajectory) if !is_known(&trajectory) => {
                Err(format!("the position of a joint of {} is unknown", controller.action))
            }
            other => Ok(other),
        }
    }

    /// Refuses a path whose joints nobody controls, apart from those of the hand.
    fn check_controlled(&self, robot: &Robot, part: &Part, names: &[&str]) -> Result<(), String> {
        let (Some(first), Some(last)) = (part.waypoints.first(), part.waypoints.last()) else { return Ok(()) };
        for (at, name) in names.iter().enumerate() {
            let moves = part.waypoints.iter().any(|(_, joints)| (joints[at] - first.1[at]).abs() > 1e-6);
            let ros = robot.binding.ros_joint(name);
            // A path opens the hand on its way; the steps of the primitive do it.
            if moves && !robot.binding.controls(ros) && !is_hand(name) {
                let end = last.1[at];
                return Err(format!("the path moves `{name}` to {end:.3}, and no controller is bound to it"));
            }
        }
        Ok(())
    }

    /// True if DDS knows all endpoints of some actions. A goal is sent only then.
    fn are_there(&mut self, around: &mut Surroundings<'_>, actions: &[usize]) -> bool {
        let missing = actions.iter().find_map(|at| around.robot.missing(*at).first().cloned());
        let Some(missing) = missing else { return true };
        self.waits_for(around, &format!("nobody serves `{missing}`"));
        false
    }

    /// Waits for something that is missing, as long as the binding says. `false` if it has not come, and the
    /// step fails.
    fn waits_for(&mut self, around: &mut Surroundings<'_>, missing: &str) -> bool {
        let patience = Duration::from_secs_f64(around.robot.binding.ros.discovery_secs.unwrap_or(5.0).clamp(0.0, 600.0));
        match self.phase {
            Phase::Discovering { since } if since.elapsed() > patience => {
                self.fail(around, missing.to_owned());
                return false;
            }
            Phase::Discovering { .. } => {}
            _ => self.phase = Phase::Discovering { since: Instant::now() },
        }
        true
    }

    fn send(&mut self, around: &mut Surroundings<'_>, goals: Vec<(usize, Value, f64)>, is_gripper: bool) {
        self.phase = Phase::Acting;
        for (action, goal, secs) in goals {
            let sent = Instant::now();
            match around.robot.actions[action].start(&around.robot.layouts, &goal) {
                Ok(id) => {
                    let deadline = sent + Duration::from_secs_f64(secs.clamp(0.1, 1e5));
                    self.running.push(Running { action, id, sent, deadline, is_gripper });
                }
                Err(why) => {
                    self.fail(around, why);
                    return;
                }
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
        let named = |name: &str| if name == "width" { Ok(json!(width)) } else { Err(format!("no value `{name}`")) };
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
                        let until = Instant::now() + Duration::from_secs_f64(call.timeout_secs.clamp(0.0, 3600.0));
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
        let (name, frame) = name.split_once(" in ").map_or((name, None), |(name, frame)| (name, Some(frame.trim())));
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
                (Argument::Pose(pose), None) => Some(Transform { xyz: pose.xyz, quaternion: pose.quaternion }),
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

    // Ends.

    /// Waits until the servers have ended their goals and everything stands still.
    fn advance_stop(&mut self, around: &mut Surroundings<'_>) -> Option<Finish> {
        let parts = self.parts();
        let stopping = self.stopping.as_mut()?;
        let is_still = around.robot.body.is_still(&parts, &around.robot.binding);
        if is_still && (self.running.is_empty() || stopping.since.elapsed() > HEEDS) {
            if !self.running.is_empty() {
                // The robot stands, but a server has not said the end of its goal.
                self.running.clear();
            }
            return Some(match &stopping.ending {
                Ending::Cancel => Finish::Ended(Outcome::Interrupted),
                Ending::Fail(failure) => Finish::Ended(Outcome::Failure(failure.clone())),
                Ending::SafeStop => Finish::Stopped,
            });
        }
        if stopping.since.elapsed() > HEEDS && stopping.stopped.elapsed() > STOPS_AGAIN {
            stopping.stopped = Instant::now();
            if !stopping.is_told {
                stopping.is_told = true;
                let moving = around.robot.body.fastest(&parts).map_or_else(String::new, |(joint, speed)| {
                    format!("; `{joint}` moves with {speed:.3} per second")
                });
                self.feedback.push(format!(
                    "the robot moves on after the cancel{moving}; trajectories that stand still are sent"
                ));
            }
            stand_still(around.robot, &self.parts);
        }
        if stopping.since.elapsed() > STANDS && stopping.ending != Ending::SafeStop {
            return Some(Finish::Lost);
        }
        None
    }

    /// Waits for standstill in a hold, and then goes on from where the robot stands.
    fn advance_hold(&mut self, around: &mut Surroundings<'_>) {
        if self.held || !self.running.is_empty() || !around.robot.body.is_still(&self.parts(), &around.robot.binding) {
            return;
        }
        self.holding = false;
        self.phase = Phase::Next;
        match self.current.take() {
            Some(Move::Follow(part, names)) => {
                let rest = self.rest(around.robot, &part, &names);
                self.moves.push_front(Move::Follow(rest, names));
            }
            Some(navigate) => self.moves.push_front(navigate),
            None => {}
        }
    }

    /// Rest of a path from where the robot stands, which is on one of its legs.
    fn rest(&self, robot: &Robot, part: &Part, names: &[String]) -> Part {
        let base = robot.body.base(&robot.binding).ok();
        let here = |at: usize| -> ([f64; 3], Vec<f64>) {
            let (planned, joints) = &part.waypoints[at];
            let base = base.filter(|_| part.drives()).map_or(*planned, |base| {
                [base.x, base.y, planned[2] + wrapped(base.yaw - planned[2])]
            });
            let joint = |(at, name): (usize, &String)| {
                robot.body.position(robot.binding.ros_joint(name)).filter(|_| !is_hand(name)).unwrap_or(joints[at])
            };
            (base, names.iter().enumerate().map(joint).collect())
        };
        let gap = |one: &([f64; 3], Vec<f64>), other: &([f64; 3], Vec<f64>)| {
            let base = one.0.iter().zip(other.0).map(|(one, other)| (one - other).powi(2)).sum::<f64>();
            let joints = one.1.iter().zip(&other.1).map(|(one, other)| (one - other).powi(2)).sum::<f64>();
            (base + joints).sqrt()
        };
        // The leg whose ends are together nearest, compared with its length.
        let excess = |leg: &usize| {
            let here = here(*leg);
            let (from, to) = (&part.waypoints[*leg], &part.waypoints[leg + 1]);
            gap(from, &here) + gap(&here, to) - gap(from, to)
        };
        let legs = 0..part.legs.len();
        let leg = legs.min_by(|one, other| excess(one).total_cmp(&excess(other))).unwrap_or(0);
        let mut waypoints = vec![here(leg)];
        waypoints.extend(part.waypoints.iter().skip(leg + 1).cloned());
        Part { waypoints, legs: part.legs.iter().skip(leg).copied().collect() }
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

/// Sends trajectories that stand still to the controllers of some joints, and zero speeds to the base.
pub fn stand_still(robot: &mut Robot, (joints, drives): &(Vec<String>, bool)) {
    for at in 0..robot.binding.controllers.len() {
        let controller = robot.binding.controllers[at].clone();
        let Some(action) = robot.action_at(&controller.action) else { continue };
        let trajectory = if controller.base.len() == 3 && *drives {
            let names = &robot.binding.frames;
            let base = robot.body.base(&robot.binding);
            let frame = robot.body.frames.look_up(&names.map, &controller.frame, None, names.age_secs);
            let (Ok(base), Ok(frame)) = (base, frame) else { continue };
            let place = frame.planar().seen_from([base.x, base.y, base.yaw]);
            Trajectory::standing(&controller.base, &place)
        } else if controller.joints.iter().any(|joint| joints.contains(joint)) {
            let positions: Option<Vec<f64>> = controller.joints.iter().map(|joint| robot.body.position(joint)).collect();
            let Some(positions) = positions else { continue };
            Trajectory::standing(&controller.joints, &positions)
        } else {
            continue;
        };
        if let Err(why) = robot.actions[action].start(&robot.layouts, &trajectory.goal()) {
            robot.tell(&why);
        }
    }
    if *drives {
        robot.send_stops();
    }
}

/// Parts of the whole robot, as its controllers have them.
#[must_use]
pub fn whole(robot: &Robot) -> (Vec<String>, bool) {
    let joints = robot.binding.controllers.iter().flat_map(|controller| controller.joints.iter().cloned());
    (joints.collect(), robot.binding.base.odometry.is_some())
}

/// True for joints of the hand, by the words that descriptions use.
fn is_hand(joint: &str) -> bool {
    ["hand", "finger", "gripper", "knuckle"].iter().any(|word| joint.to_lowercase().contains(word))
}

/// Angle from -π to π.
fn wrapped(angle: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    angle - turn * (angle / turn).round()
}
