//! Steps of a task that are no motions: the hand, calls, and detections.

use super::{Phase, Surroundings, Task};
use crate::bind::{Call, CallKind, Opening};
use crate::template::{ValueName, fill, in_unit, of_argument, of_pose};
use crate::tf::Transform;
use motet_graph::Value as Argument;
use serde_json::{Value, json};
use std::time::{Duration, Instant};

impl Task {
    pub(super) fn begin_gripper(&mut self, around: &mut Surroundings<'_>, opening: Opening) -> bool {
        let goal = match self.gripper_goal(around, opening) {
            Ok(goal) => goal,
            Err(why) => {
                self.fail(around, why);
                return true;
            }
        };
        if self.are_there(around, &[goal.0]) {
            self.send(around, vec![goal], true);
        }
        self.stopping.is_some()
    }

    /// Goal of the hand: its action, the message, and the seconds that it may take.
    pub(super) fn gripper_goal(
        &mut self,
        around: &Surroundings<'_>,
        opening: Opening,
    ) -> Result<(usize, Value, f64), String> {
        let gripper = around.robot.binding.gripper.as_ref().ok_or("no [gripper] is bound")?;
        let action = around.robot.action_at(&gripper.action).ok_or("the gripper is not open")?;
        let template = match opening {
            Opening::Open => &gripper.open,
            Opening::Close => &gripper.close,
            Opening::Width => {
                gripper.width.as_ref().filter(|_| self.width.is_some()).unwrap_or(&gripper.open)
            }
        };
        let width = self.width.map(|width| gripper.offset + gripper.scale * width);
        let named = |name: &str| {
            let ValueName { name, within, .. } = ValueName::of(name);
            let width = width.filter(|_| name == "width");
            let width = width.ok_or_else(|| match name {
                "width" => "no path says how wide the hand is to open".to_owned(),
                _ => format!("no value `{name}`"),
            })?;
            within.map_or(Ok(json!(width)), |unit| in_unit(width, unit))
        };
        let goal = fill(template, &named)?;
        self.parts.all |= gripper.joints.is_empty();
        self.parts.joints.extend(gripper.joints.iter().cloned());
        Ok((action, goal, gripper.timeout_secs))
    }

    pub(super) fn begin_call(&mut self, around: &mut Surroundings<'_>, call: &Call) -> bool {
        let message = fill(&call.message, &|name| self.named(around, name));
        let message = match message {
            Ok(message) => message,
            Err(why) => {
                self.fail(around, why);
                return true;
            }
        };
        self.parts.all |= call.moves;
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

    /// Value in a message: an argument, `NAME.pose` of an entity, the `goal` of the base, a pose
    /// `NAME in FRAME`, or a number `NAME in UNIT`.
    fn named(&self, around: &Surroundings<'_>, name: &str) -> Result<Value, String> {
        let ValueName { name, field, within: frame } = ValueName::of(name);
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
                (Argument::Pose(pose), None) => Some(Transform::from(*pose)),
                (Argument::Number(number), None) if frame.is_some() => {
                    return in_unit(*number, frame.unwrap_or_default());
                }
                (value, None) if frame.is_some() => {
                    return Err(format!("`{name}` is {value}, which has neither a frame nor a unit"));
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
