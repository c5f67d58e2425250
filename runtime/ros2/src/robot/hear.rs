//! Messages that come from the robot, by what they are for.

use super::{Channel, Robot, RobotEvent};
use crate::bind::StepKind;
use crate::cdr::decode;
use crate::dds::Received;
use crate::perceive::{box_detections, detections};

impl Robot {
    /// Takes in a message. `known` says if an id is an entity of the scene.
    pub(crate) fn hear(&mut self, received: &Received, known: &dyn Fn(&str) -> bool) -> Vec<RobotEvent> {
        let channel = self.channels.get(received.source as usize).cloned();
        let heard = match channel {
            Some(channel) => self.hear_on(&channel, received, known),
            None => Ok(Vec::new()),
        };
        heard.unwrap_or_else(|wrong| {
            self.tell(&format!("a message is left out: {wrong}"));
            Vec::new()
        })
    }

    fn hear_on(
        &mut self,
        channel: &Channel,
        received: &Received,
        known: &dyn Fn(&str) -> bool,
    ) -> Result<Vec<RobotEvent>, String> {
        let read = |name: &str| {
            decode(&self.layouts, name, &received.bytes).map_err(|wrong| format!("{name}: {wrong}"))
        };
        match channel {
            Channel::Action(at) => {
                let news = self.actions[*at].hear(&self.layouts, received)?;
                return Ok(news.into_iter().map(|news| RobotEvent::Goal(*at, news)).collect());
            }
            Channel::Service(at) => {
                let response = self.services[*at].hear(&self.layouts, received)?;
                return Ok(response
                    .into_iter()
                    .map(|(ticket, message)| RobotEvent::Response(*at, ticket, message))
                    .collect());
            }
            Channel::Joints => {
                let message = read("sensor_msgs/JointState")?;
                self.body.hear_joints(&message, &self.binding.standstill, received.at);
            }
            Channel::Odometry => {
                let message = read("nav_msgs/Odometry")?;
                self.body.hear_odometry(&message, &self.binding.standstill, received.at);
            }
            Channel::Localization => {
                let message = read("geometry_msgs/PoseWithCovarianceStamped")?;
                self.body.hear_localization(&message);
            }
            Channel::Frames(is_static) => {
                let message = read("tf2_msgs/TFMessage")?;
                self.body.hear_frames(&message, *is_static, received.at);
            }
            Channel::Kept(topic) => {
                let type_name = self.type_of(topic);
                self.kept.insert(topic.clone(), (received.bytes.clone(), received.at, type_name));
                return Ok(vec![RobotEvent::Kept]);
            }
            Channel::Camera(at, feed) => {
                self.cameras[*at].hear(*feed, received.bytes.clone(), received.at);
            }
            Channel::Detections(camera) => {
                let (binding, frames) = (&self.binding, &self.body.frames);
                let (things, wrong) = match camera {
                    Some(at) => {
                        let message = read("vision_msgs/Detection2DArray")?;
                        box_detections(&message, &self.cameras[*at], binding, &self.layouts, frames, known)
                    }
                    None => detections(&read("vision_msgs/Detection3DArray")?, binding, frames, known),
                };
                if let Some(wrong) = wrong {
                    self.tell(&format!("a detection is left out: {wrong}"));
                }
                return Ok(vec![RobotEvent::Detected(things)]);
            }
        }
        Ok(Vec::new())
    }

    /// Type of a topic whose messages are kept.
    fn type_of(&self, topic: &str) -> String {
        let observations = self.binding.facts.values().chain(self.binding.measures.values());
        let observed = observations.filter(|one| one.topic == topic).map(|one| one.type_name.clone()).next();
        let answers = || {
            let names = self.binding.primitives.keys();
            let step_kinds =
                names.flat_map(|name| self.binding.steps(name).unwrap_or_default()).map(|step| step.kind);
            let mut types = step_kinds.filter_map(|kind| match kind {
                StepKind::Answer { topic: own, type_name, .. } if own == topic => Some(type_name),
                _ => None,
            });
            types.next()
        };
        observed.or_else(answers).unwrap_or_default()
    }
}
