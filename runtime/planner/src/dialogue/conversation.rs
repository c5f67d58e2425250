//! A conversation: the environment, the knowledge and the memory that last from one request to the next, and
//! the observers of a dialogue. The dialogue manager carries out its requests.

use std::cell::OnceCell;
use std::sync::Arc;

use motet_compiler::{CheckOptions, Geometry, Session};
use motet_graph::{Graph, Value};
use motet_requests::RequestContext;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_runtime::memory::{Memory, MemoryLimits};
use motet_runtime::{
    CameraImage, Capabilities, Detection, Driver, Effect, Engine, EngineSettings, Event, Moved, Observer,
    Perception, Query, RunControl, RunEnd, StartState, SwapRefusal, Time, Truth,
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
    /// The robot's body in the scene; with it, motions are checked before a run, as far as it is known where
    /// things are.
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
    /// Results of the steps of the latest policy, by name.
    pub(super) bound: Vec<(SmolStr, Value)>,
    /// The library, read once.
    base: OnceCell<Session>,
    eyes: Option<Box<dyn Perception + 'a>>,
    settings: EngineSettings,
    pub(super) on_instruction: OnInstruction,
    /// Id of the conversation, with which those of its runs begin, and the number of runs so far.
    runs: (String, u32),
}

/// Behaviour of a moving robot while a new instruction is planned.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum OnInstruction {
    /// It goes on with what it does.
    #[default]
    GoOn,
    /// It keeps still until the new policy takes over.
    Pause,
}

impl<'a> Conversation<'a> {
    /// A conversation in a setting.
    #[must_use]
    pub fn new(setting: &'a DialogueSetup) -> Self {
        let (known, memory) = (Knowledge::default(), Memory::new(MemoryLimits::default()));
        Self {
            setting,
            known,
            memory,
            bound: Vec::new(),
            base: OnceCell::new(),
            eyes: None,
            settings: EngineSettings::default(),
            on_instruction: OnInstruction::default(),
            runs: ("run".to_owned(), 0),
        }
    }

    /// Sets the settings of the engines, the behaviour on an instruction during a run, and the id with which
    /// the ids of all runs begin.
    #[must_use]
    pub fn with_runs(self, id: &str, settings: EngineSettings, on_instruction: OnInstruction) -> Self {
        Self { runs: (id.to_owned(), 0), settings, on_instruction, ..self }
    }

    /// Takes a session of the setting's robot, domains, scene and options, without geometry, in the place of
    /// one that would be built. Many conversations in one setting share it.
    #[must_use]
    pub fn with_session(self, session: Session) -> Self {
        Self { base: OnceCell::from(session), ..self }
    }

    /// Takes in facts that are known beside the scene, such as those of a state.
    pub fn tell(&mut self, facts: impl IntoIterator<Item = (Query, Truth)>) {
        self.known.tell(facts);
    }

    /// Id for the next run.
    pub(super) fn next_run(&mut self) -> String {
        let (id, count) = &mut self.runs;
        *count += 1;
        format!("{id}.{count}")
    }

    /// Adds a camera: each plan gets a fresh image.
    #[must_use]
    pub fn with_eyes(self, eyes: impl Perception + 'a) -> Self {
        Self { eyes: Some(Box::new(eyes)), ..self }
    }

    /// Takes in a statement, such as "the coke is in the fridge". False if the line asks for something, or is
    /// not understood.
    pub fn note(&mut self, line: &str) -> bool {
        let scene = self.known.scene(&self.setting.scene);
        let understood = motet_requests::understand(line, &self.known.situation(&scene));
        let is_statement =
            understood.is_ok_and(|intent| intent.aims.is_empty() && !intent.located.is_empty());
        if is_statement {
            self.hear(line);
        }
        is_statement
    }

    /// Takes in the locations that a request states.
    pub(super) fn hear(&mut self, request: &str) {
        let scene = self.known.scene(&self.setting.scene);
        if let Ok(understood) = motet_requests::understand(request, &self.known.situation(&scene)) {
            understood.located.iter().for_each(|one| self.known.hear(one));
            if !understood.prefers.is_empty() {
                self.known.prefers = understood.prefers;
            }
            if understood.aims.is_empty() {
                self.known.spoken_of = understood.spoken_of;
            } else {
                // What the robot does may fill a place again.
                self.known.looked_at.clear();
            }
        }
    }

    /// A fresh image, if there is a camera.
    pub(super) fn look(&mut self, now: Time) -> Option<CameraImage> {
        self.eyes.as_mut()?.image(now)
    }

    /// A session in the known state, with the motions in it. A thing whose place is not known has none, and
    /// the others have theirs.
    pub(super) fn session(&self, scene: &Scene, known: &Knowledge, base: Option<[f64; 3]>) -> Session {
        let session = self.base().with_scene(Some(scene), Some(&known.state()));
        let Some(geometry) = &self.setting.geometry else { return session };
        if known.is_empty() {
            return session.with_geometry(Arc::clone(geometry));
        }
        // Before the first run the robot stands where the scene says.
        let base = base.or_else(|| (self.runs.1 == 0).then_some(self.setting.scene.robot.base));
        let geometry = match base.map(|base| known.placed(&self.setting.scene, base)) {
            Some(Some((placed, unplaced))) => geometry.elsewhere(&placed).with_unplaced(unplaced),
            Some(None) => geometry.astray("it is not known which doors are open"),
            None => geometry.astray("the driver does not tell where the robot stands"),
        };
        session.with_geometry(Arc::new(geometry))
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
            bound: &self.bound,
            image: None,
        }
    }

    /// Engine for a policy in the known state, and its start state. With `verifies` it asks for a verdict on
    /// every motion that the compiler deferred.
    ///
    /// # Errors
    ///
    /// The graph is not valid; one of the compiler always is. Or the driver does not have its primitives.
    pub fn engine(
        &self,
        graph: Graph,
        scene: &Scene,
        can: Capabilities,
        verifies: bool,
    ) -> Result<(Engine, StartState), Problem> {
        let session = self.session(scene, &self.known, None);
        let settings = EngineSettings { verify_within: verifies.then_some(WITHIN), ..self.settings };
        let start = self.known.start(scene, &session);
        let missing = can.missing(&graph);
        if !missing.is_empty() {
            return Err(Problem::lacking(&missing));
        }
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
    /// Recorder of the run of this id that is about to begin, if there is one. The engine has handled no
    /// event yet.
    fn scribe(&mut self, _run: &str, _engine: &Engine, _start: &StartState) -> Option<Box<dyn RunRecorder>> {
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
    /// A person holds the run, or lets it go on.
    fn held(&mut self, _is_held: bool) {}
    /// A question was answered, from knowledge or by a look. `None` if nobody knows.
    fn answered(&mut self, _question: &str, _answer: Option<&str>) {}
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
