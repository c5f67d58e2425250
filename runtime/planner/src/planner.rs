//! The planner trait: requests in, policies out.

use std::sync::LazyLock;

use motet_compiler::Session;
use motet_graph::Value;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_runtime::CameraImage;
use motet_runtime::memory::Memory;
use smol_str::SmolStr;

use crate::background_work::{BackgroundWork, CHECK_WITHIN, WorkProgress};
use crate::builtin::{self, PlanError, PlannedRequest};
use crate::runtime_check::CheckMode;
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

/// A request without borrows, for a thread.
pub(crate) struct OwnedRequest {
    session: Session,
    robot: Robot,
    request: String,
    scene: Scene,
    context: RequestContext<'static>,
    memory: Memory,
    bound: Vec<(SmolStr, Value)>,
    image: Option<CameraImage>,
}

impl OwnedRequest {
    /// Copies a request.
    pub(crate) fn of(ask: &PlanRequest<'_>) -> Self {
        let RequestContext { scene, holding, supports, spoken_of, came_from, seen_at, meant, prefers } =
            ask.situation.clone();
        // The scene stands beside the context.
        static NOWHERE: LazyLock<Scene> = LazyLock::new(Scene::default);
        let nowhere: &'static Scene = &NOWHERE;
        let context = RequestContext {
            scene: nowhere,
            holding,
            supports,
            spoken_of,
            came_from,
            seen_at,
            meant,
            prefers,
        };
        Self {
            session: ask.session.clone(),
            robot: ask.robot.clone(),
            request: ask.request.to_owned(),
            scene: scene.clone(),
            context,
            memory: ask.memory.clone(),
            bound: ask.bound.to_vec(),
            image: ask.image.cloned(),
        }
    }

    /// Calls a function with the request.
    pub(crate) fn with<T>(self, plan: impl FnOnce(&PlanRequest<'_>) -> T) -> T {
        let Self { session, robot, request, scene, context, memory, bound, image } = self;
        let situation = RequestContext { scene: &scene, ..context };
        plan(&PlanRequest {
            session: &session,
            robot: &robot,
            request: &request,
            situation: &situation,
            memory: &memory,
            bound: &bound,
            image: image.as_ref(),
        })
    }
}

/// The built-in planner, which plans for an instruction during a run on a thread of its own: the run goes on
/// meanwhile. Other requests are planned in place.
#[derive(Default)]
pub struct BackgroundBuiltin {
    /// Policy that is being planned, or none where there is none.
    coming: Option<BackgroundWork<Option<String>>>,
}

impl Planner for BackgroundBuiltin {
    fn plan(&mut self, ask: &PlanRequest<'_>) -> Result<PlannedRequest, PlanError> {
        self.coming = None;
        Builtin.plan(ask)
    }

    fn begin(&mut self, ask: &PlanRequest<'_>) -> bool {
        let owned = OwnedRequest::of(ask);
        let plan = move || owned.with(|ask| Builtin.plan(ask).ok().map(|answered| answered.planned.text));
        self.coming = Some(BackgroundWork::start(CheckMode::Background, CHECK_WITHIN, plan));
        true
    }

    fn rest(&mut self, wait: Wait) -> RemainingSteps {
        let Some(coming) = &self.coming else { return RemainingSteps::Nothing };
        let planned = match wait {
            Wait::Not => coming.progress(),
            Wait::ToTheEnd => coming.wait(|| false),
        };
        let planned = match planned {
            WorkProgress::Coming => return RemainingSteps::Coming,
            WorkProgress::Done(planned) => planned,
            WorkProgress::Late => None,
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
