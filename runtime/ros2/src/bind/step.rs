//! Steps of a primitive.

use super::late;
use serde::Deserialize;
use serde_json::Value;

/// Primitive as steps, one after the other.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Primitive {
    pub(crate) steps: Vec<StepTable>,
}

/// Step as the file writes it: exactly one of its first twelve keys.
#[derive(Clone, PartialEq, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct StepTable {
    motion: Option<Direction>,
    posture: Option<String>,
    gripper: Option<Opening>,
    action: Option<String>,
    service: Option<String>,
    topic: Option<String>,
    wait_secs: Option<f64>,
    require: Option<String>,
    look: Option<bool>,
    detect: Option<bool>,
    search: Option<bool>,
    answer: Option<String>,
    #[serde(rename = "type")]
    type_name: Option<String>,
    message: Option<Value>,
    timeout_secs: Option<f64>,
    /// False for an action or a service that moves nothing.
    moves: Option<bool>,
    /// Failure of the step.
    fails: Option<String>,
    /// Words of the failure.
    text: Option<String>,
    /// Expression of the result.
    value: Option<String>,
}

/// Way along a path.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Direction {
    There,
    Back,
}

/// Goal of the hand.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Opening {
    Open,
    Close,
    /// As wide as the grasp of the path asks for.
    Width,
}

/// Message to an action, a service or a topic.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Call {
    pub(crate) kind: CallKind,
    pub(crate) name: String,
    #[serde(rename = "type")]
    pub(crate) type_name: String,
    #[serde(default)]
    pub(crate) message: Value,
    #[serde(default = "late")]
    pub(crate) timeout_secs: f64,
    /// True if it may move parts of the robot.
    #[serde(default = "yes")]
    pub(crate) moves: bool,
}

const fn yes() -> bool {
    true
}

/// Kind of interface.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum CallKind {
    Action,
    Service,
    Topic,
}

/// Step of a primitive.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Step {
    pub(crate) kind: StepKind,
    /// Failure if the step does not succeed; the first that the primitive declares without one.
    pub(crate) fails: Option<String>,
    pub(crate) text: Option<String>,
}

/// Kind of a step: its effect on the robot.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum StepKind {
    Motion(Direction),
    /// Move to a posture of the card, along a path from where the robot stands.
    Posture(String),
    /// Go to an entity, along a path from where the robot stands: a part of [`StepKind::Search`].
    Go(String),
    Gripper(Opening),
    Call(Call),
    Wait(f64),
    /// Expression that must hold.
    Require(String),
    /// Turn the camera to the entity that the first argument is or describes, if it is known where that is.
    Look,
    /// Wait for a detection of what the first argument describes.
    Detect,
    /// Go to each entity of the argument `around`, and wait there for a detection of what the first argument
    /// describes.
    Search,
    /// Wait for a message of a topic; the expression over it is the result.
    Answer {
        topic: String,
        type_name: String,
        value: String,
        timeout_secs: f64,
    },
}

impl StepTable {
    /// Names of the interfaces that it uses.
    pub(super) fn names(&mut self) -> impl Iterator<Item = &mut String> {
        [&mut self.action, &mut self.service, &mut self.topic, &mut self.answer].into_iter().flatten()
    }

    /// The step.
    ///
    /// # Errors
    ///
    /// The keys that are missing, or are too many.
    pub(crate) fn step(&self) -> Result<Step, String> {
        let call = |kind, name: &String| -> Result<StepKind, String> {
            let type_name = self.type_name.clone().ok_or_else(|| format!("`{name}` needs a `type`"))?;
            let message = self.message.clone().unwrap_or_default();
            let timeout_secs = self.timeout_secs.unwrap_or_else(late);
            // The message of a topic is sent at once: there is nothing to interrupt.
            let moves = kind != CallKind::Topic && self.moves.unwrap_or(true);
            Ok(StepKind::Call(Call { kind, name: name.clone(), type_name, message, timeout_secs, moves }))
        };
        let answer = |topic: &String| -> Result<StepKind, String> {
            let type_name = self.type_name.clone().ok_or_else(|| format!("`{topic}` needs a `type`"))?;
            let value = self.value.clone().ok_or_else(|| format!("`{topic}` needs a `value`"))?;
            let timeout_secs = self.timeout_secs.unwrap_or(60.0);
            Ok(StepKind::Answer { topic: topic.clone(), type_name, value, timeout_secs })
        };
        let step_kinds = [
            self.motion.map(|direction| Ok(StepKind::Motion(direction))),
            self.posture.as_ref().map(|name| Ok(StepKind::Posture(name.clone()))),
            self.gripper.map(|opening| Ok(StepKind::Gripper(opening))),
            self.action.as_ref().map(|name| call(CallKind::Action, name)),
            self.service.as_ref().map(|name| call(CallKind::Service, name)),
            self.topic.as_ref().map(|name| call(CallKind::Topic, name)),
            self.wait_secs.map(|secs| Ok(StepKind::Wait(secs))),
            self.require.as_ref().map(|text| Ok(StepKind::Require(text.clone()))),
            self.look.filter(|is_set| *is_set).map(|_| Ok(StepKind::Look)),
            self.detect.filter(|is_set| *is_set).map(|_| Ok(StepKind::Detect)),
            self.search.filter(|is_set| *is_set).map(|_| Ok(StepKind::Search)),
            self.answer.as_ref().map(answer),
        ];
        let mut step_kinds = step_kinds.into_iter().flatten();
        let kind = match (step_kinds.next(), step_kinds.next()) {
            (Some(kind), None) => kind?,
            _ => {
                return Err("a step has exactly one of motion, posture, gripper, action, service, topic, \
                            wait_secs, require, look, detect, search and answer"
                    .to_owned());
            }
        };
        Ok(Step { kind, fails: self.fails.clone(), text: self.text.clone() })
    }
}
