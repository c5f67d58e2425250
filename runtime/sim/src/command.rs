//! A command as the simulator understands it: the standard primitives, and everything else.

use crate::world::SimWorld;
use motet_graph::{Pose, Value};
use motet_runtime::Command;
use motet_stdlib::lang::primitives;
use smol_str::SmolStr;

#[derive(Clone, PartialEq, Debug)]
pub(crate) enum SimCommand {
    Go(SmolStr),
    /// A drive to a pose of the base.
    GoToPose(Pose),
    Turn(f64),
    Home,
    StartPose,
    WakeUp,
    Pick(SmolStr),
    /// The object, and the pose at which the hand closes.
    Grasp(SmolStr, Option<Pose>),
    Lift,
    /// The object, its support, and the rules for its place.
    Place(SmolStr, SmolStr, Placing),
    Handover(SmolStr, SmolStr),
    Open(SmolStr),
    Close(SmolStr),
    Push(SmolStr),
    Detect(SmolStr),
    DetectAll(SmolStr),
    /// A search for a description at some places in order.
    Search(SmolStr, Vec<SmolStr>),
    Locate(SmolStr),
    Ground(SmolStr),
    Inspect(SmolStr),
    Say(SmolStr),
    Ask(SmolStr),
    Choose(Vec<SmolStr>),
    /// Not one of the standard primitives, or not with their arguments.
    Unknown,
}

impl SimCommand {
    /// Parses a driver command. A robot's own primitive with the name of a standard one but other parameters
    /// is [`Self::Unknown`].
    pub(crate) fn of(command: &Command) -> Self {
        Self::parse(command).unwrap_or(Self::Unknown)
    }

    fn parse(command: &Command) -> Option<Self> {
        let entity = |name: &str| match command.arg(name)? {
            Value::Entity(id) => Some(id.clone()),
            Value::Bool(_) | Value::Int(_) | Value::Number(_) | Value::Text(_) => None,
            Value::Case(_) | Value::Pose(_) | Value::List(_) => None,
        };
        let text = |name: &str| match command.arg(name)? {
            Value::Text(text) => Some(text.clone()),
            Value::Bool(_) | Value::Int(_) | Value::Number(_) | Value::Entity(_) => None,
            Value::Case(_) | Value::Pose(_) | Value::List(_) => None,
        };
        Some(match command.primitive.as_str() {
            primitives::GO => Self::Go(entity("to")?),
            primitives::GO_TO_POSE => Self::GoToPose(pose(command.arg("to")?)?),
            primitives::TURN => Self::Turn(number(command.arg("by")?)?),
            primitives::HOME => Self::Home,
            primitives::START_POSE => Self::StartPose,
            primitives::WAKE_UP => Self::WakeUp,
            primitives::PICK => Self::Pick(entity("object")?),
            primitives::GRASP => Self::Grasp(entity("object")?, command.arg("at").and_then(pose)),
            primitives::LIFT => Self::Lift,
            primitives::PLACE => {
                let on = entity("on")?;
                let other = |name: &str| entity(name).filter(|id| *id != on);
                let rules = Placing {
                    near: other("near"),
                    beside: other("beside"),
                    from_edge: command.arg("away_from_edge").and_then(number).unwrap_or(0.0).max(0.0),
                    at: None,
                };
                Self::Place(entity("object")?, on, rules)
            }
            primitives::PLACE_AT => {
                let rules = Placing { at: Some(pose(command.arg("at")?)?), ..Placing::default() };
                Self::Place(entity("object")?, entity("on")?, rules)
            }
            primitives::HANDOVER => Self::Handover(entity("object")?, entity("to")?),
            primitives::OPEN => Self::Open(entity("what")?),
            primitives::CLOSE => Self::Close(entity("what")?),
            primitives::PUSH => Self::Push(entity("what")?),
            primitives::DETECT => Self::Detect(text("what")?),
            primitives::DETECT_ALL => Self::DetectAll(text("what")?),
            primitives::SEARCH => Self::Search(
                text("what")?,
                ids(command.arg("around")?).or_else(|| Some(vec![entity("around")?]))?,
            ),
            primitives::LOCATE => Self::Locate(entity("object")?),
            primitives::GROUND => Self::Ground(entity("object")?),
            primitives::INSPECT => Self::Inspect(entity("what")?),
            primitives::SAY => Self::Say(text("text")?),
            primitives::ASK => Self::Ask(text("question")?),
            primitives::CHOOSE => Self::Choose(ids(command.arg("among")?)?),
            _ => return None,
        })
    }

    /// True if it drives to a place, where it may look around.
    pub(crate) const fn is_drive(&self) -> bool {
        matches!(self, Self::Go(_) | Self::GoToPose(_) | Self::Search(_, _))
    }

    /// Share of the deadline that the work takes, driving aside.
    pub(crate) const fn share(&self) -> f64 {
        match self {
            Self::Go(_) | Self::GoToPose(_) | Self::Turn(_) => 0.0,
            Self::Search(_, _) => 0.01,
            Self::Ask(_) | Self::Choose(_) => 0.05,
            Self::Say(_) => 0.08,
            Self::Home | Self::StartPose | Self::WakeUp | Self::Handover(_, _) => 0.25,
            Self::Detect(_) | Self::DetectAll(_) | Self::Locate(_) | Self::Ground(_) | Self::Inspect(_) => {
                0.3
            }
            Self::Pick(_) | Self::Grasp(..) | Self::Place(..) | Self::Open(_) | Self::Close(_) => 0.2,
            Self::Lift | Self::Push(_) => 0.4,
            Self::Unknown => 0.5,
        }
    }

    /// Sets the pose of the arm after the command.
    pub(crate) fn leave_arm(&self, world: &mut SimWorld) {
        use crate::world::ArmPose;
        let arm = match self {
            Self::Home => ArmPose::Home,
            Self::StartPose | Self::Search(_, _) => ArmPose::Ready,
            Self::Lift => ArmPose::Carry,
            Self::Pick(_) | Self::Grasp(..) | Self::Place(..) | Self::Handover(_, _) => ArmPose::Out,
            Self::Open(_) | Self::Close(_) | Self::Push(_) => ArmPose::Out,
            Self::Go(_) | Self::GoToPose(_) | Self::Turn(_) | Self::WakeUp | Self::Unknown => return,
            Self::Detect(_) | Self::DetectAll(_) | Self::Locate(_) | Self::Ground(_) | Self::Inspect(_) => {
                return;
            }
            Self::Say(_) | Self::Ask(_) | Self::Choose(_) => return,
        };
        (world.arm, world.gaze) = (arm, None);
    }
}

/// Rules for the place of a thing on its support.
#[derive(Clone, PartialEq, Debug, Default)]
pub(crate) struct Placing {
    /// Entities near which and beside which it is put.
    pub(crate) near: Option<SmolStr>,
    pub(crate) beside: Option<SmolStr>,
    /// Least distance in m of its whole outline to the rim of the support.
    pub(crate) from_edge: f64,
    /// Point that its middle is put over, and its turn.
    pub(crate) at: Option<Pose>,
}

impl Placing {
    /// True if any place will do.
    pub(crate) fn is_any(&self) -> bool {
        *self == Self::default()
    }
}

const fn pose(value: &Value) -> Option<Pose> {
    match value {
        Value::Pose(pose) => Some(*pose),
        Value::Bool(_) | Value::Int(_) | Value::Number(_) | Value::Text(_) => None,
        Value::Entity(_) | Value::Case(_) | Value::List(_) => None,
    }
}

pub(crate) const fn number(value: &Value) -> Option<f64> {
    match value {
        Value::Number(number) => Some(*number),
        Value::Int(number) => Some(*number as f64),
        Value::Bool(_) | Value::Text(_) | Value::Entity(_) | Value::Case(_) => None,
        Value::Pose(_) | Value::List(_) => None,
    }
}

fn ids(value: &Value) -> Option<Vec<SmolStr>> {
    let Value::List(items) = value else { return None };
    let id = |item: &Value| match item {
        Value::Entity(id) => Some(id.clone()),
        Value::Bool(_) | Value::Int(_) | Value::Number(_) | Value::Text(_) => None,
        Value::Case(_) | Value::Pose(_) | Value::List(_) => None,
    };
    items.iter().map(id).collect()
}
