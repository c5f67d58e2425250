//! A conversation: requests carried out one after the other, with new plans and questions, in a world that
//! lasts.

use std::cell::OnceCell;
use std::sync::Arc;

use motet_compiler::{CheckOptions, Geometry, Session};
use motet_graph::Graph;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_runtime::memory::{Memory, MemoryLimits};
use motet_runtime::{
    CameraImage, Capabilities, Driver, Engine, EngineSettings, Perception, StartState, Time,
};
use motet_syntax::Sources;
use motet_syntax::ast::File;
use smol_str::SmolStr;

use super::knowledge::Knowledge;
use super::manager::Pursuit;
use super::observer::{DialogueObserver, Person};
use super::problem::{Kind, Problem};
use crate::builtin::{PlanError, PlannedRequest};
use crate::runtime_check::WITHIN;
use crate::{PlanRequest, Planner};
use motet_requests::RequestContext;

/// In which world requests are carried out.
#[derive(Clone, Debug)]
pub struct DialogueSetup {
    pub robot: Robot,
    /// Scene at the start.
    pub scene: Scene,
    /// Declarations on top of the library.
    pub domains: Vec<File>,
    /// The robot's body in the scene, where motions are checked beforehand: as long as all is as the scene
    /// says.
    pub geometry: Option<Arc<Geometry>>,
    /// Settings of the check.
    pub options: CheckOptions,
}

/// Ending of a conversation about one request.
#[derive(Clone, PartialEq, Debug)]
pub enum Outcome {
    /// The request is done.
    Done,
    /// A person gave it up.
    GivenUp,
    /// A person stopped the robot.
    Stopped,
    /// It could not be done, and nobody said what to do instead.
    Failed(Problem),
}

/// Carries out requests, one after the other, in a world that lasts.
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

    /// The same with eyes, from which a fresh image goes to who plans, each time anew.
    #[must_use]
    pub fn with_eyes(self, eyes: impl Perception + 'a) -> Self {
        Self { eyes: Some(Box::new(eyes)), ..self }
    }

    /// Carries out a request to its end. Runs from the driver's present time `from`; gives the time at the
    /// end too.
    pub fn carry_out(
        &mut self,
        request: &str,
        planner: &mut dyn Planner,
        driver: &mut dyn Driver,
        person: &mut dyn Person,
        watcher: &mut dyn DialogueObserver,
        from: Time,
    ) -> (Outcome, Time) {
        self.hear(request);
        self.memory.instruct(from, request);
        let mut pursuit = Pursuit::new(self, (planner, person, watcher), request, from);
        let outcome = pursuit.pursue(driver);
        (outcome, pursuit.now)
    }

    /// Takes in what a request says of where things are.
    pub(super) fn hear(&mut self, request: &str) {
        let scene = self.known.scene(&self.setting.scene);
        if let Ok(understood) = motet_requests::understand(request, &self.known.situation(&scene)) {
            understood.located.iter().for_each(|one| self.known.hear(one));
            if understood.aims.is_empty() {
                self.known.spoken_of = understood.spoken_of;
            }
        }
    }

    /// A fresh image, where there are eyes.
    pub(super) fn look(&mut self, now: Time) -> Option<CameraImage> {
        self.eyes.as_mut()?.image(now)
    }

    /// A session in what is known; with motions where it is known where everything is.
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

    /// The library, in the scene as the setting has it.
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

    /// An engine for a policy, in the state that is known, with that state.
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
