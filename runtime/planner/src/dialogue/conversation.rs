//! A conversation: the environment, the knowledge and the memory that last from one request to the next, and
//! the observers of a dialogue. The dialogue manager carries out its requests.

use std::cell::OnceCell;
use std::sync::Arc;

use motet_compiler::{CheckOptions, Geometry, Session};
use motet_graph::Graph;
use motet_requests::RequestContext;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_runtime::memory::{Memory, MemoryLimits};
use motet_runtime::{
    CameraImage, Capabilities, Detection, Driver, Effect, Engine, EngineSettings, Event, Moved, Observer,
    Perception, RunControl, RunEnd, StartState, SwapRefusal, Time,
};
use motet_syntax::Sources;
use motet_syntax::ast::File;
use smol_str::SmolStr;

use super::knowledge::Knowledge;
use super::problem::{Kind, Problem};
use crate::builtin::{PlanError, PlannedRequest};
use crate::runtime_check::{CheckMode, WITHIN};
use crate::{PlanRequest, Planner};

/// Environment in which requests are carried out.
#[derive(Clone, Debug)]
pub struct DialogueSetup {
    pub robot: Robot,
    /// Scene at the start.
    pub scene: Scene,
    /// Declarations on top of the library.
    pub domains: Vec<File>,
    /// The robot's body in the scene; with it, motions are checked before a run as long as every object is
    /// at its place in the scene.
    pub geometry: Option<Arc<Geometry>>,
    /// Settings of the check.
    pub options: CheckOptions,
}

/// Ending of a conversation about one request.
#[derive(Clone, PartialEq, Debug)]
pub enum Outcome {
    /// The request is done.
    Done,
    /// The policy declined the request, for a reason; empty without one.
    Declined(String),
    /// A person gave it up.
    GivenUp,
    /// A person stopped the robot.
    Stopped,
    /// The request could not be done, and nobody said how to go on.
    Failed(Problem),
}

/// Carries out requests one after the other. Knowledge and memory last from one request to the next.
pub struct Conversation<'a> {
    pub(super) setting: &'a DialogueSetup,
    /// Knowledge beyond the given scene.
    pub known: Knowledge,
    /// Earlier requests and their endings.
    pub memory: Memory,
    /// The library, read once.
    base: OnceCell<Session>,
    eyes: Option<Box<dyn Perception + 'a>>,
}

impl<'a> Conversation<'a> {
    /// A conversation in a setting.
    #[must_use]
    pub fn new(setting: &'a DialogueSetup) -> Self {
        let (known, memory) = (Knowledge::default(), Memory::new(MemoryLimits::default()));
        Self { setting, known, memory, base: OnceCell::new(), eyes: None }
    }

    /// Adds a camera: each plan gets a fresh image.
    #[must_use]
    pub fn with_eyes(self, eyes: impl Perception + 'a) -> Self {
        Self { eyes: Some(Box::new(eyes)), ..self }
    }

    /// Takes in the locations that a request states.
    pub(super) fn hear(&mut self, request: &str) {
        let scene = self.known.scene(&self.setting.scene);
        if let Ok(understood) = motet_requests::understand(request, &self.known.situation(&scene)) {
            understood.located.iter().for_each(|one| self.known.hear(one));
            if understood.aims.is_empty() {
                self.known.spoken_of = understood.spoken_of;
            }
        }
    }

    /// A fresh image, if there is a camera.
    pub(super) fn look(&mut self, now: Time) -> Option<CameraImage> {
        self.eyes.as_mut()?.image(now)
    }

    /// A session in the known state; with motions if the place of every object is known.
    pub(super) fn session(&self, scene: &Scene, known: &Knowledge, base: Option<[f64; 3]>) -> Session {
        let session = self.base().with_scene(Some(scene), Some(&known.state()));
        let Some(geometry) = &self.setting.geometry else { return session };
        if known.is_empty() {
            return session.with_geometry(Arc::clone(geometry));
        }
        match base.and_then(|base| known.placed(&self.setting.scene, base)) {
            Some(placed) => session.with_geometry(Arc::new(geometry.elsewhere(&placed))),
            None => session,
        }
    }

    /// Session of the library in the scene of the setup.
    pub(super) fn base(&self) -> &Session {
        let DialogueSetup { robot, domains, options, scene, .. } = self.setting;
        self.base.get_or_init(|| {
            Session::builder()
                .robot(robot)
                .domains(domains)
                .scene(scene)
                .options(*options)
                .build(&mut Sources::default())
        })
    }

    pub(super) fn plan_for(
        &self,
        (request, image): (&str, Option<&CameraImage>),
        meant: &[(String, SmolStr)],
        planner: &mut dyn Planner,
        (session, scene, known): (&Session, &Scene, &Knowledge),
    ) -> Result<PlannedRequest, PlanError> {
        let situation = RequestContext { meant: meant.to_vec(), ..known.situation(scene) };
        planner.plan(&PlanRequest { image, ..self.ask(session, request, &situation) })
    }

    pub(super) fn ask<'s>(
        &'s self,
        session: &'s Session,
        request: &'s str,
        situation: &'s RequestContext<'s>,
    ) -> PlanRequest<'s> {
        PlanRequest {
            session,
            robot: &self.setting.robot,
            request,
            situation,
            memory: &self.memory,
            image: None,
        }
    }

    /// Engine for a policy in the known state, and its start state.
    pub(super) fn engine(
        &self,
        graph: Graph,
        scene: &Scene,
        can: Capabilities,
        verifies: bool,
    ) -> Result<(Engine, StartState), Problem> {
        let session = self.session(scene, &self.known, None);
        let settings =
            EngineSettings { verify_within: verifies.then_some(WITHIN), ..EngineSettings::default() };
        let start = self.known.start(scene, &session);
        let engine = Engine::new(graph, &start);
        let ready = |engine: Engine| (engine.with_settings(settings).with_capabilities(can), start);
        engine.map(ready).map_err(|wrong| Problem {
            kind: Kind::ActionFailed,
            question: wrong.first().map_or_else(|| "the graph is not valid".to_owned(), ToString::to_string),
            options: Vec::new(),
            about: None,
            said: None,
        })
    }
}

/// Person who answers the robot's questions.
pub trait Person {
    /// Asks a question. `None` if nobody answers.
    fn ask(&mut self, problem: &Problem) -> Option<String>;
}

/// Person who never answers.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoOperator;

impl Person for NoOperator {
    fn ask(&mut self, _problem: &Problem) -> Option<String> {
        None
    }
}

/// Observer of a dialogue, which may also bring new requests.
pub trait DialogueObserver {
    /// Recorder of the run that is about to begin, if there is one. The engine has handled no event yet.
    fn scribe(&mut self, _engine: &Engine, _start: &StartState) -> Option<Box<dyn RunRecorder>> {
        None
    }
    /// A policy is about to run, or to take over.
    fn planned(&mut self, _answered: &PlannedRequest, _graph: &Arc<Graph>) {}
    /// An event is about to be handled.
    fn event(&mut self, _now: Time, _event: &Event) {}
    /// An effect is about to be carried out.
    fn effect(&mut self, _now: Time, _effect: &Effect) {}
    /// True if it wants to hear of every motion.
    fn wants_telemetry(&self) -> bool {
        false
    }
    /// The driver saw something new.
    fn detected(&mut self, _now: Time, _seen: &[Detection]) {}
    /// The driver sent telemetry.
    fn moved(&mut self, _moved: &Moved) {}
    /// Notes that time has passed, and decides if the run continues. An observer that paces the run waits
    /// here.
    fn reached(&mut self, _now: Time) -> RunControl {
        RunControl::Continue
    }
    /// Longest span without a call of [`DialogueObserver::reached`].
    fn at_least_every(&self) -> Time {
        Time::NEVER
    }
    /// Schedule of the checks of deferred motions.
    fn verifies(&self) -> CheckMode {
        CheckMode::AtOnce
    }
    /// Returns a request that somebody made during the run.
    fn request(&mut self, _now: Time) -> Option<String> {
        None
    }
    /// True once a person wants everything to stop, also during a question.
    fn is_stopped(&self) -> bool {
        false
    }
    /// Notes that a policy took over, or could not.
    fn swapped(&mut self, _now: Time, _refusal: Option<&SwapRefusal>) {}
    /// A run has ended.
    fn ended(&mut self, _now: Time, _end: &RunEnd) {}
    /// Notes a question before it is asked, or its answer.
    fn asked(&mut self, _problem: &Problem, _answer: Option<&str>) {}
}

/// Observer that does nothing.
impl DialogueObserver for () {}

/// Recorder of one run.
pub trait RunRecorder {
    /// Runs an engine to its end as [`motet_runtime::run`] does, and records its events and effects.
    fn run(
        self: Box<Self>,
        engine: &mut Engine,
        driver: &mut dyn Driver,
        onlooker: &mut dyn Observer,
        from: Time,
    ) -> RunEnd;
}
