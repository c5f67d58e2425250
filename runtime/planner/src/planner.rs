//! The planner trait: requests in, policies out.

use std::sync::mpsc::{self, Receiver, TryRecvError};

use motet_compiler::Session;
use motet_graph::Value;
use motet_robots::card::Robot;
use motet_runtime::CameraImage;
use motet_runtime::memory::Memory;
use smol_str::SmolStr;

use crate::builtin::{self, PlanError, PlannedRequest};
use motet_requests::RequestContext;

/// Planner of policies for requests.
pub trait Planner {
    /// Plans a policy for a request. The dialogue asks again after a failure, with the knowledge at that
    /// time.
    ///
    /// # Errors
    ///
    /// The reason why there is no policy.
    fn plan(&mut self, ask: &PlanRequest<'_>) -> Result<PlannedRequest, PlanError>;

    /// True if the planner can use any answer. Otherwise the dialogue repeats a question whose
    /// answer it could not read.
    fn reads_answers(&self) -> bool {
        false
    }

    /// Begins to plan for a request during a run without blocking; [`Planner::rest`] returns the result.
    /// Returns `false` if the planner only plans in [`Planner::plan`].
    fn begin(&mut self, _ask: &PlanRequest<'_>) -> bool {
        false
    }

    /// The rest of the last policy if only its first step was returned, or the policy of [`Planner::begin`].
    fn rest(&mut self, _wait: Wait) -> RemainingSteps {
        RemainingSteps::Nothing
    }
}

/// Decision to wait for the rest, or not.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Wait {
    /// Take the pieces that have arrived.
    Not,
    /// Wait until the policy is complete.
    ToTheEnd,
}

/// The rest of a policy that is still being written.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum RemainingSteps {
    /// The returned policy was complete.
    Nothing,
    /// The rest has not arrived yet.
    Coming,
    /// The whole policy, including its first step, as it was written.
    Whole(String),
    /// The rest cannot be used: the request must be planned anew after the first step.
    Broken,
    /// A person stopped the planning.
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
    /// Results of the steps of the latest policy, by name.
    pub bound: &'a [(SmolStr, Value)],
    /// Current camera image, if the robot has a camera.
    pub image: Option<&'a CameraImage>,
}

/// The built-in planner, which plans for an instruction during a run on a thread of its own: the run goes on
/// meanwhile. Other requests are planned in place.
#[derive(Debug, Default)]
pub struct BuiltinBeside {
    /// Policy that is being planned, or the reason why there is none.
    coming: Option<Receiver<Option<String>>>,
}

impl Planner for BuiltinBeside {
    fn plan(&mut self, ask: &PlanRequest<'_>) -> Result<PlannedRequest, PlanError> {
        self.coming = None;
        Builtin.plan(ask)
    }

    fn begin(&mut self, ask: &PlanRequest<'_>) -> bool {
        let (session, robot, request) = (ask.session.clone(), ask.robot.clone(), ask.request.to_owned());
        let (situation, scene) = (ask.situation.clone(), ask.situation.scene.clone());
        let RequestContext { holding, supports, spoken_of, came_from, meant, seen_at, prefers, .. } =
            situation;
        let (told, coming) = mpsc::channel();
        std::thread::spawn(move || {
            let scene = &scene;
            let context =
                RequestContext { holding, supports, spoken_of, came_from, ..RequestContext::new(scene) };
            let situation = RequestContext { meant, seen_at, prefers, ..context };
            let planned = builtin::answer(&session, Some(&robot), &request, &situation);
            // Nobody waits for it any more if the run is over.
            let _ = told.send(planned.ok().map(|answered| answered.planned.text));
        });
        self.coming = Some(coming);
        true
    }

    fn rest(&mut self, wait: Wait) -> RemainingSteps {
        let Some(coming) = &self.coming else { return RemainingSteps::Nothing };
        let planned = match wait {
            Wait::Not => match coming.try_recv() {
                Err(TryRecvError::Empty) => return RemainingSteps::Coming,
                planned => planned.ok().flatten(),
            },
            Wait::ToTheEnd => coming.recv().ok().flatten(),
        };
        self.coming = None;
        planned.map_or(RemainingSteps::Broken, RemainingSteps::Whole)
    }
}

/// The built-in planner, which needs no model.
#[derive(Clone, Copy, Debug, Default)]
pub struct Builtin;

impl Planner for Builtin {
    fn plan(&mut self, ask: &PlanRequest<'_>) -> Result<PlannedRequest, PlanError> {
        builtin::answer(ask.session, Some(ask.robot), ask.request, ask.situation)
    }
}
