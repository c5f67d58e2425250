//! The planner trait: requests in, policies out.

use motet_compiler::Session;
use motet_robots::card::Robot;
use motet_runtime::CameraImage;
use motet_runtime::memory::Memory;

use crate::builtin::{self, PlanError, PlannedRequest};
use motet_requests::RequestContext;

/// Makes policies of requests.
pub trait Planner {
    /// A policy for a request, or why there is none. It is asked again after a failure, with what is known
    /// by then.
    ///
    /// # Errors
    ///
    /// Why there is none.
    fn plan(&mut self, ask: &PlanRequest<'_>) -> Result<PlannedRequest, PlanError>;

    /// Returns `true` if the planner can use any answer. Otherwise the dialogue repeats a question whose
    /// answer it could not read.
    fn reads_answers(&self) -> bool {
        false
    }

    /// Begins to plan for a request while something runs, which nobody must keep waiting; [`Planner::rest`]
    /// gives what comes
    /// of it. False where [`Planner::plan`] answers at once.
    fn begin(&mut self, _ask: &PlanRequest<'_>) -> bool {
        false
    }

    /// The rest of the policy that was given last, where that was only its first step, or what was begun.
    fn rest(&mut self, _wait: Wait) -> RemainingSteps {
        RemainingSteps::Nothing
    }
}

/// Decision to wait for more, or not.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Wait {
    /// No: what has come has come.
    Not,
    /// Yes, until it is complete.
    ToTheEnd,
}

/// The rest of a policy that is still being written.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum RemainingSteps {
    /// There is none: what was given was the whole.
    Nothing,
    /// It has not come yet.
    Coming,
    /// The whole policy, first step and all, as it was written.
    Whole(String),
    /// It cannot be used: what follows the first step has to be planned anew.
    Broken,
    /// A person stopped it.
    Stopped,
}

/// Input of a planner.
#[derive(Clone, Copy, Debug)]
pub struct PlanRequest<'a> {
    /// Session that checks the policy.
    pub session: &'a Session,
    pub robot: &'a Robot,
    /// The request, as it stands after the answers that changed it.
    pub request: &'a str,
    /// Context in which the request is read: scene, knowledge, and recent mentions.
    pub situation: &'a RequestContext<'a>,
    /// Earlier requests and their endings.
    pub memory: &'a Memory,
    /// Current camera image, if the robot has a camera.
    pub image: Option<&'a CameraImage>,
}

/// The planner that needs no model.
#[derive(Clone, Copy, Debug, Default)]
pub struct Builtin;

impl Planner for Builtin {
    fn plan(&mut self, ask: &PlanRequest<'_>) -> Result<PlannedRequest, PlanError> {
        builtin::answer(ask.session, Some(ask.robot), ask.request, ask.situation)
    }
}
