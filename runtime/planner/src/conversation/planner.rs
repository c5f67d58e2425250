//! Who makes policies of requests, and what they are asked.

use motet_compiler::Session;
use motet_robots::card::Robot;
use motet_runtime::CameraImage;
use motet_runtime::memory::Memory;

use crate::builtin::{self, Answered, Unplanned};
use motet_requests::RequestContext;

/// Makes policies of requests.
pub trait Planner {
    /// A policy for a request, or why there is none. It is asked again after a failure, with what is known by then.
    ///
    /// # Errors
    ///
    /// Why there is none.
    fn plan(&mut self, ask: &Ask<'_>) -> Result<Answered, Unplanned>;

    /// Whether it makes something of any answer. Else an answer that was not understood is asked for again.
    fn reads_answers(&self) -> bool {
        false
    }

    /// Begins to plan for a request while something runs, which nobody must keep waiting; [`Planner::rest`] gives what comes
    /// of it. False where [`Planner::plan`] answers at once.
    fn begin(&mut self, _ask: &Ask<'_>) -> bool {
        false
    }

    /// The rest of the policy that was given last, where that was only its first step, or what was begun.
    fn rest(&mut self, _wait: Wait) -> Rest {
        Rest::Nothing
    }
}

/// Whether something is waited for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Wait {
    /// No: what has come has come.
    Not,
    /// Yes, until it is complete.
    ToTheEnd,
}

/// The rest of a policy that is still being written.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Rest {
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

/// What a planner is asked.
#[derive(Clone, Copy, Debug)]
pub struct Ask<'a> {
    /// What the policy is checked against.
    pub session: &'a Session,
    /// The robot.
    pub robot: &'a Robot,
    /// The request, as it stands after the answers that changed it.
    pub request: &'a str,
    /// What is known.
    pub situation: &'a RequestContext<'a>,
    /// What was asked and done.
    pub memory: &'a Memory,
    /// What the robot sees at the moment, where it has eyes.
    pub image: Option<&'a CameraImage>,
}

/// The planner that needs no model.
#[derive(Clone, Copy, Debug, Default)]
pub struct Builtin;

impl Planner for Builtin {
    fn plan(&mut self, ask: &Ask<'_>) -> Result<Answered, Unplanned> {
        builtin::answer(ask.session, Some(ask.robot), ask.request, ask.situation)
    }
}
