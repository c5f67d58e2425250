//! Steps of a task that are no motions: the hand, calls, and detections.

use super::{Ending, Phase, Surroundings, Task};
use crate::bind::{Call, CallKind, Opening};
use crate::template::{fill, of_argument, of_pose};
use crate::tf::Transform;
use motet_graph::Value as Argument;
use motet_host::remote::protocol::DetectedThing;
use motet_runtime::FailureReport;
use serde_json::{Value, json};
use std::time::{Duration, Instant};

impl Task {
    /// Takes in detections. What the step looks for and the scene lacks becomes a thing of the room, unless a
    /// known thing is seen that is described so: a detector may see one thing twice.
    pub(super) fn hear_detections(&mut self, around: &mut Surroundings<'_>, things: &[DetectedThing]) {
        let known: Vec<String> = things.iter().filter_map(|thing| thing.id.clone()).collect();
        let what = self.words().into_iter().next().unwrap_or_default();
        let is_seen = around.world.matches(&what).iter().any(|id| known.contains(id));
        if !is_seen {
            let unknown = things.iter().filter(|thing| thing.id.is_none());
            self.detected.extend(unknown.filter_map(|thing| around.world.discover(&what, thing)));
        }
        self.detected.extend(known);
    }

    /// Ends the step if what was looked for is detected. True if it is over.
    pub(super) fn find_detected(&mut self, around: &mut Surroundings<'_>, is_late: bool) -> bool {
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

    pub(super) fn begin_gripper(&mut self, around: &mut Surroundings<'_>, opening: Opening) -> bool {
        let Some(gripper) = around.robot.binding.gripper.clone() else { return true };
        let Some(action) = around.robot.action_at(&gripper.action) else { return true };
        if !self.are_there(around, &[action]) {
            return self.stopping.is_some();
        }
        let template = match opening {
            Opening::Open => &gripper.open,
            Opening::Close => &gripper.close,
            Opening::Width => {
                gripper.width.as_ref().filter(|_| self.width.is_some()).unwrap_or(&gripper.open)
            }
        };
        let width = self.width.map(|width| gripper.offset + gripper.scale * width);
        let named = |name: &str| match (name, width) {
            ("width", Some(width)) => Ok(json!(width)),
            ("width", None) => Err("no path says how wide the hand is to open".to_owned()),
            _ => Err(format!("no value `{name}`")),
        };
        self.parts.all |= gripper.joints.is_empty();
        self.parts.joints.extend(gripper.joints.iter().cloned());
        match fill(template, &named) {
            Ok(goal) => self.send(around, vec![(action, goal, gripper.timeout_secs)], true),
            Err(why) => self.fail(around, why),
        }
        self.stopping.is_some()
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
