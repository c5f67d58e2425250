//! Motions of a task: paths from the command or of the driver's own, as trajectories and navigations.

use super::{Move, Phase, Running, Surroundings, Task, unheard};
use crate::bind::{Binding, Controller, Direction, Opening, StepKind};
use crate::joint::{Axis, Part, Trajectory};
use crate::plan::{self, Question};
use crate::robot::Robot;
use crate::template::of_pose;
use crate::tf::{Planar, Transform};
use crossbeam_channel::bounded;
use motet_graph::{Value as Argument, Witness};
use motet_robots::clearance::GREATEST_CLEARANCE;
use serde_json::{Value, json};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Greatest number of paths of a step that are looked for because the robot is not where a path begins.
const MAX_DETOURS: u32 = 2;

impl Task {
    pub(super) fn begin_motion(&mut self, around: &mut Surroundings<'_>, direction: Direction) -> bool {
        if direction == Direction::Back {
            if let Some(before) = self.before.take() {
                self.return_by_move_group(around, &before);
                return true;
            }
            let Some((part, names)) = self.path.clone() else {
                self.fail(around, "no way there was followed before".to_owned());
                return true;
            };
            self.plan_moves(around, &[part.reversed()], &names);
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
            let start = witness.path.first().map(|first| (first.base, first.joints.clone()));
            let start = start.ok_or_else(|| "the path has no waypoint".to_owned());
            let is_there = start.and_then(|start| is_at(around.robot, &start, &names_of(witness)));
            match is_there.and_then(|()| is_clear(around.robot, witness)) {
                Ok(()) => {
                    self.take_path(around, &witness.clone());
                    return true;
                }
                Err(away) => self.own_motions.push(format!("{away}; a new path is looked for")),
            }
        }
        if let Err(why) = self.plan(around, plan::motion(&motion)) {
            self.fail(around, why);
            return true;
        }
        false
    }

    /// Looks for another path where the robot is not where a move begins, such as behind a navigation that
    /// ends near its goal. A way back has none.
    pub(super) fn plan_anew(&mut self, around: &mut Surroundings<'_>, away: String) {
        let is_there = self.steps.front().is_some_and(|step| step.kind == StepKind::Motion(Direction::There));
        let own = self.command.motions.first().filter(|_| is_there).map(|motion| plan::motion(motion));
        let is_free = self.detours < MAX_DETOURS && !self.has_gripped;
        let Some(motion) = self.way().or(own).filter(|_| is_free) else {
            self.fail(around, away);
            return;
        };
        self.detours += 1;
        self.moves.clear();
        self.own_motions.push(format!("{away}; a new path is looked for"));
        if let Err(why) = self.plan(around, motion) {
            self.fail(around, why);
        }
    }

    /// Turns the camera to what the first argument is or describes. Without a place or a way to look the step
    /// is over: the detection says what is in view.
    pub(super) fn begin_look(&mut self, around: &mut Surroundings<'_>) -> bool {
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
    pub(super) fn plan(&mut self, around: &Surroundings<'_>, motion: String) -> Result<(), String> {
        let binding = &around.robot.binding;
        let base = around.robot.body.base(binding).or_else(|why| match binding.base.odometry {
            None => {
                let [x, y, yaw] = around.world.scene.robot.base;
                Ok(Planar { x, y, yaw })
            }
            Some(_) => Err(why),
        })?;
        let positions = around.robot.body.positions();
        let controlled = positions.iter().filter(|(name, _)| binding.controls(name));
        let joints = controlled.map(|(name, value)| (binding.card_joint(name).to_owned(), *value)).collect();
        let clearance = needed_clearance(around.robot);
        if clearance > GREATEST_CLEARANCE {
            return Err(format!("the localisation has an error of {clearance:.3} m"));
        }
        let question = Question::new(around.card, &around.world.scene, motion, base, &joints, clearance);
        let question = question.ok_or("the command `motet`, which plans paths, was not found")?;
        let ((sender, answer), wanted) = (bounded(1), Arc::new(()));
        let is_wanted = Arc::downgrade(&wanted);
        std::thread::spawn(move || {
            // The task may be over before its answer.
            let _ = sender.send(Box::new(question.ask(&is_wanted)));
        });
        self.phase = Phase::Planning { answer, _wanted: wanted };
        Ok(())
    }

    pub(super) fn take_path(&mut self, around: &mut Surroundings<'_>, witness: &Witness) {
        // The localisation may have become worse while the path was looked for.
        if let Err(text) = is_clear(around.robot, witness) {
            self.fail(around, text);
            return;
        }
        let mut part = match Part::of(witness) {
            Ok(part) => part,
            Err(wrong) => {
                self.fail(around, wrong);
                return;
            }
        };
        self.width = witness.grasp.as_ref().map(|grasp| grasp.width);
        let stretch = self.command.manner.map_or(1.0, motet_graph::Manner::stretch);
        let is_planned =
            self.command.motions.first().and_then(|motion| motion.witness.as_deref()) != Some(witness);
        if is_planned {
            // A path of the driver's own has the times of full speed.
            part.legs.iter_mut().flatten().for_each(|secs| *secs *= stretch);
        }
        let names = names_of(witness);
        self.path = Some((part.clone(), names.clone()));
        let place =
            |(joint, open): (&String, &f64)| Some((names.iter().position(|own| own == joint)?, *open));
        let hand: Vec<(usize, f64)> = around.card.open_hand.iter().filter_map(place).collect();
        self.plan_moves(around, &part.between_grips(&hand), &names);
    }

    /// Splits a path into moves that the controllers can carry out. Between its parts the hand closes.
    pub(super) fn plan_moves(&mut self, around: &mut Surroundings<'_>, parts: &[Part], names: &[String]) {
        for (at, part) in parts.iter().enumerate() {
            if at > 0 {
                self.moves.push_back(Move::Grip);
            }
            if let Err(why) = self.plan_part(&around.robot.binding, part, names) {
                self.fail(around, why);
                return;
            }
        }
        self.phase = Phase::Next;
        if self.moves.is_empty() {
            self.step_done();
        }
    }

    fn plan_part(&mut self, binding: &Binding, part: &Part, names: &[String]) -> Result<(), String> {
        let follows = binding.controllers.iter().any(|controller| !controller.base.is_empty());
        if part.legs.is_empty() {
            return Ok(());
        }
        if !part.drives() || follows {
            self.moves.push_back(Move::Follow(part.clone(), names.to_vec()));
            return Ok(());
        }
        if binding.navigation.is_none() {
            return Err("nothing is bound that drives the base".to_owned());
        }
        let phases = part.phases().ok_or("base and arm move at once, which a navigation cannot")?;
        for (drives, phase) in phases {
            let end = phase.waypoints.last().map_or([0.0; 3], |(base, _)| *base);
            let follow = || Move::Follow(phase.clone(), names.to_vec());
            self.moves.push_back(if drives { Move::Navigate(end) } else { follow() });
        }
        Ok(())
    }

    pub(super) fn begin_move(&mut self, around: &mut Surroundings<'_>, next: Move) -> bool {
        if let Move::Follow(part, names) = &next
            && let Some(start) = part.waypoints.first()
        {
            if let Some(missing) = unheard(around.robot) {
                return !self.waits_for(around, &missing) && self.stopping.is_some();
            }
            if let Err(away) = is_at(around.robot, start, names) {
                self.plan_anew(around, away);
                return self.stopping.is_some();
            }
        }
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
            if self.moves.is_empty() {
                self.step_done()
            } else {
                self.phase = Phase::Next
            }
            return true;
        }
        let actions: Vec<usize> = goals.iter().map(|(action, ..)| *action).collect();
        if !self.are_there(around, &actions) {
            return self.stopping.is_some();
        }
        self.moves.pop_front();
        let is_grip = matches!(next, Move::Grip);
        self.has_gripped |= is_grip;
        self.current = Some(next);
        self.send(around, goals, is_grip);
        self.stopping.is_some()
    }

    /// Goals of a move, with the seconds that each may take.
    pub(super) fn goals(
        &mut self,
        around: &Surroundings<'_>,
        next: &Move,
    ) -> Result<Vec<(usize, Value, f64)>, String> {
        let robot = &around.robot;
        match next {
            Move::Navigate(end) => {
                let navigation = robot.binding.navigation.as_ref().ok_or("no navigation is bound")?;
                let action = robot.action_at(&navigation.action).ok_or("the navigation is not open")?;
                let pose = Transform::from_rpy([end[0], end[1], 0.0], [0.0, 0.0, end[2]]);
                let header = json!({"frame_id": robot.binding.frames.map});
                let goal = json!({"pose": {"header": header, "pose": of_pose(pose.xyz, pose.quaternion)},
                    "behavior_tree": navigation.behavior_tree});
                self.parts.drives = true;
                Ok(vec![(action, goal, self.command.deadline_secs)])
            }
            Move::Grip => self.gripper_goal(around, Opening::Close).map(|goal| vec![goal]),
            Move::Group(goal) => {
                let bound = robot.binding.move_group.as_ref().ok_or("MoveGroup is not bound")?;
                let action = robot.action_at(&bound.action).ok_or("MoveGroup is not open")?;
                self.parts = robot.parts();
                Ok(vec![(action, goal.clone(), self.command.deadline_secs)])
            }
            Move::Follow(part, names) => {
                let names: Vec<&str> = names.iter().map(String::as_str).collect();
                let mut goals = Vec::new();
                for controller in &robot.binding.controllers {
                    let action = robot.action_at(&controller.action).ok_or("a controller is not open")?;
                    let trajectory = self.trajectory(robot, controller, part, &names)?;
                    if let Some(trajectory) = trajectory {
                        if controller.base.is_empty() {
                            self.parts.joints.extend(controller.joints.iter().cloned());
                        } else {
                            self.parts.drives = true;
                        }
                        goals.push((action, trajectory.goal(), part.secs() + controller.late_secs));
                    }
                }
                self.check_controlled(robot, part, &names)?;
                Ok(goals)
            }
        }
    }

    pub(super) fn trajectory(
        &self,
        robot: &Robot,
        controller: &Controller,
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
            if let Some(trajectory) = &mut trajectory {
                turn_to(robot, controller, trajectory);
            }
            return Ok(trajectory);
        }
        let axes: Vec<Axis<'_>> = controller
            .joints
            .iter()
            .map(|joint| {
                Axis::Joint(robot.binding.card_joint(joint), robot.body.position(joint).unwrap_or(f64::NAN))
            })
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
    pub(super) fn check_controlled(&self, robot: &Robot, part: &Part, names: &[&str]) -> Result<(), String> {
        let (Some(first), Some(last)) = (part.waypoints.first(), part.waypoints.last()) else {
            return Ok(());
        };
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
    pub(super) fn are_there(&mut self, around: &mut Surroundings<'_>, actions: &[usize]) -> bool {
        let missing = actions.iter().find_map(|at| around.robot.missing(*at).first().cloned());
        let Some(missing) = missing else { return true };
        self.waits_for(around, &format!("nobody serves `{missing}`"));
        false
    }

    /// Waits for something that is missing, as long as the binding says. `false` if it has not come, and the
    /// step fails.
    pub(super) fn waits_for(&mut self, around: &mut Surroundings<'_>, missing: &str) -> bool {
        let patience =
            Duration::from_secs_f64(around.robot.binding.ros.discovery_secs.unwrap_or(5.0).clamp(0.0, 600.0));
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

    pub(super) fn send(
        &mut self,
        around: &mut Surroundings<'_>,
        goals: Vec<(usize, Value, f64)>,
        is_gripper: bool,
    ) {
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
}

/// Turns a trajectory of the base as often as its axis of yaw has gone round before.
pub(super) fn turn_to(robot: &Robot, controller: &Controller, trajectory: &mut Trajectory) {
    let is = controller.base.get(2).and_then(|yaw| robot.body.position(yaw));
    let first = trajectory.points.first().and_then(|point| point.positions.get(2));
    let Some((is, first)) = is.zip(first) else { return };
    let turns = is - first - wrapped(is - first);
    trajectory.points.iter_mut().filter_map(|point| point.positions.get_mut(2)).for_each(|yaw| *yaw += turns);
}

fn names_of(witness: &Witness) -> Vec<String> {
    witness.joints.iter().map(ToString::to_string).collect()
}

/// Says how far the robot is from where a path begins, if it is too far. `names` are those of the joints.
fn is_at(robot: &Robot, (base, joints): &([f64; 3], Vec<f64>), names: &[String]) -> Result<(), String> {
    let binding = &robot.binding;
    for (joint, value) in names.iter().zip(joints) {
        let name = binding.ros_joint(joint);
        // Joints of the hand are moved by the steps of the primitive.
        if !binding.controls(name) || is_hand(name) {
            continue;
        }
        let is = robot.body.position(name);
        let Some(is) = is else { return Err(format!("the position of `{name}` is unknown")) };
        if (is - value).abs() > binding.start.joints {
            return Err(format!("`{name}` is at {is:.3}, and the path begins at {value:.3}"));
        }
    }
    if binding.base.odometry.is_none() {
        return Ok(());
    }
    match base_away(robot.body.base(binding)?, *base, binding) {
        Some(away) => Err(format!("the base is {away} from where the path begins")),
        None => Ok(()),
    }
}

/// Distance of the base from a place, in words, if it is too great.
pub(super) fn base_away(is: Planar, place: [f64; 3], binding: &Binding) -> Option<String> {
    let (apart, turn) = ((is.x - place[0]).hypot(is.y - place[1]), wrapped(is.yaw - place[2]).abs());
    let is_away = apart > binding.start.base || turn > binding.start.turn;
    is_away.then(|| format!("{apart:.3} m and {turn:.3} rad"))
}

/// Distance in m that paths must keep for the error of the localisation.
fn needed_clearance(robot: &Robot) -> f64 {
    robot.body.sigma.map_or(0.0, |sigma| sigma * robot.binding.base.sigmas)
}

/// Says that a path does not keep clear enough. It was checked for the expected place of the base, and needs
/// room for the error of that place.
fn is_clear(robot: &Robot, witness: &Witness) -> Result<(), String> {
    let (keeps, needed) = (witness.clearance, needed_clearance(robot));
    if keeps >= needed {
        return Ok(());
    }
    Err(format!("the path keeps {keeps:.3} m clear, and the localisation has an error of {needed:.3} m"))
}

/// True for joints of the hand, by the words that descriptions use.
pub(super) fn is_hand(joint: &str) -> bool {
    ["hand", "finger", "gripper", "knuckle"].iter().any(|word| joint.to_lowercase().contains(word))
}

/// Angle from -π to π.
pub(super) fn wrapped(angle: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    angle - turn * (angle / turn).round()
}
