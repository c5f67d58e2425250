//! A robot in a scene, ready to check, compile, plan and run policies.

use motet_compiler::Session;
use motet_graph::Graph;
use motet_planner::runtime_check::{CheckMode, Guard};
use motet_project::{DOCUMENT, Project, ProjectBuilder, ProjectSession, SimulationInputs};
use motet_runtime::{Driver, EngineSettings, Observer, RunEnd, Time};
use motet_sim::Sim;
use motet_syntax::ast::File;
use motet_syntax::{Diagnostic, Parsed, Source};

use crate::{Error, run};

/// A robot in a scene with a compiler session: checks, compiles, plans and runs policies.
///
/// Opening is expensive, since it reads the library, the robot's body and the scene; checks and compilations
/// share the result. The value is `Send` and can be shared between threads.
///
/// ```
/// let motet = motet::Motet::open("hsr", "kitchen")?;
/// let policy = motet.compile("policy greet { say(\"Hello!\") done }")?;
/// let end = motet.run(&policy, &mut motet.simulator(&policy, 7)?)?;
/// assert!(matches!(end, motet::RunEnd::Done { .. }));
/// # Ok::<(), motet::Error>(())
/// ```
#[derive(Debug)]
pub struct Motet {
    opened: ProjectSession,
    warnings: Vec<Diagnostic>,
}

/// Policy that has passed the check, with its execution graph.
#[derive(Clone, Debug)]
pub struct CheckedPolicy {
    graph: Graph,
    warnings: Vec<Diagnostic>,
    file: File,
}

impl CheckedPolicy {
    /// Execution graph, which a robot's own computer can run without the compiler.
    ///
    /// ```
    /// let motet = motet::Motet::open("hsr", "kitchen")?;
    /// let policy = motet.compile("policy greet { say(\"Hello!\") done }")?;
    /// assert_eq!(policy.graph().policy, "greet");
    /// # Ok::<(), motet::Error>(())
    /// ```
    #[must_use]
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// Warnings of the check, in the order of the document.
    #[must_use]
    pub fn warnings(&self) -> &[Diagnostic] {
        &self.warnings
    }
}

/// Policy that the planner wrote for a request.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The policy in the canonical text syntax.
    pub text: String,
    /// Remarks for the person who asked, such as an assumption that the planner made.
    pub notes: Vec<String>,
    pub policy: CheckedPolicy,
}

impl Motet {
    /// Opens a robot in a scene. Either is a built-in name, or a path: a folder with a `robot.toml`, a scene
    /// in JSON.
    ///
    /// # Errors
    ///
    /// [`Error::Project`].
    pub fn open(robot: &str, scene: &str) -> Result<Self, Error> {
        Self::from_builder(Project::builder().robot(robot).scene(scene))
    }

    /// Opens a robot in a scene with a state, domains or other settings.
    ///
    /// ```
    /// let inputs = motet::Project::builder()
    ///     .robot("hsr")
    ///     .scene("kitchen")
    ///     .state(r#"{"open(fridge_1)": true}"#)
    ///     .max_duration(120.0);
    /// let motet = motet::Motet::from_builder(inputs)?;
    /// # Ok::<(), motet::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Project`].
    pub fn from_builder(inputs: ProjectBuilder) -> Result<Self, Error> {
        let mut warnings = Vec::new();
        let opened = inputs.open_with(&mut warnings)?.into_session(&mut warnings)?;
        Ok(Self { opened, warnings })
    }

    /// Warnings about the robot, the scene and the other inputs.
    #[must_use]
    pub fn warnings(&self) -> &[Diagnostic] {
        &self.warnings
    }

    /// Compiler session, for all that the facade does not cover.
    #[must_use]
    pub fn session(&self) -> &Session {
        &self.opened.session
    }

    /// Robot, scene and files that the session was opened from.
    #[must_use]
    pub fn project(&self) -> &ProjectSession {
        &self.opened
    }

    /// Checks a document in the text or the JSON syntax. Returns all errors and warnings in the order of the
    /// document.
    ///
    /// ```
    /// let motet = motet::Motet::open("hsr", "kitchen")?;
    /// let found = motet.check("policy drop for hsr { place(mug_1, shelf) done }");
    /// assert_eq!(found[0].code.0, "M0501");
    /// # Ok::<(), motet::Error>(())
    /// ```
    #[must_use]
    pub fn check(&self, text: &str) -> Vec<Diagnostic> {
        self.opened.session.check(&read(text).1)
    }

    /// Checks and compiles a document with one policy in the text or the JSON syntax, motions included.
    ///
    /// # Errors
    ///
    /// [`Error::Refused`] with the diagnostics.
    pub fn compile(&self, text: &str) -> Result<CheckedPolicy, Error> {
        let (source, parsed) = read(text);
        let compiled = self.opened.session.compile(&parsed, None);
        match compiled.graph {
            Some(graph) => Ok(CheckedPolicy { graph, warnings: compiled.diagnostics, file: parsed.file }),
            None => Err(Error::Refused {
                diagnostics: compiled.diagnostics,
                sources: Box::new(self.opened.sources(source)),
            }),
        }
    }

    /// Plans a policy for a request in English, without a model. The same request gives the same policy.
    ///
    /// ```
    /// let motet = motet::Motet::open("hsr", "kitchen")?;
    /// let plan = motet.plan("bring me the red mug")?;
    /// println!("{}", plan.text);
    /// # Ok::<(), motet::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Plan`]: the request is not clear, or no plan reaches its goals.
    pub fn plan(&self, request: &str) -> Result<Plan, Error> {
        let answered = crate::plan::for_request(&self.opened, request)?;
        let planned = answered.planned;
        let graph = planned.compiled.graph.ok_or_else(|| Error::Graph(Vec::new()))?;
        let warnings = planned.compiled.diagnostics;
        let policy = CheckedPolicy { graph, warnings, file: planned.parsed.file };
        Ok(Plan { text: planned.text, notes: answered.understood.notes, policy })
    }

    /// Simulator of the robot in the scene, in the state that the policy starts from. The same seed gives
    /// the same run.
    ///
    /// # Errors
    ///
    /// [`Error::NoRobot`].
    pub fn simulator(&self, policy: &CheckedPolicy, seed: u64) -> Result<Sim, Error> {
        let robot = self.opened.robot.as_ref().ok_or(Error::NoRobot)?;
        let scene = self.opened.scene.clone().unwrap_or_default();
        let files: Vec<_> = self.opened.domains.iter().chain([&policy.file]).collect();
        let options = SimulationInputs::with_seed(seed).for_policy(&policy.graph, &files);
        Ok(Sim::new(robot, &scene, options))
    }

    /// Runs a policy on a driver to its end. Motions that the compiler deferred are checked just before they
    /// start.
    ///
    /// # Errors
    ///
    /// [`Error::Graph`], never for a policy of this session; [`Error::Lacking`].
    pub fn run(&self, policy: &CheckedPolicy, driver: &mut dyn Driver) -> Result<RunEnd, Error> {
        self.run_observed(policy, driver, &mut ())
    }

    /// Runs a policy on a driver with an observer, which may log, pace or stop the run, look through the
    /// camera and let other policies take over.
    ///
    /// # Errors
    ///
    /// [`Error::Graph`], never for a policy of this session; [`Error::Lacking`].
    pub fn run_observed(
        &self,
        policy: &CheckedPolicy,
        driver: &mut dyn Driver,
        observer: &mut dyn Observer,
    ) -> Result<RunEnd, Error> {
        let guard = self.opened.session.world_tracker().map(|course| Guard::new(course, CheckMode::AtOnce));
        let start = run::start_state(self.opened.scene.as_ref());
        let capabilities = driver.capabilities();
        let graph = policy.graph.clone();
        let mut engine = run::engine(graph, &start, capabilities, guard.as_ref(), EngineSettings::default())?;
        let mut observer = run::Guarded::new(observer, guard);
        let from = driver.begin_run(Time::ZERO, &run::run_id(), Some(engine.graph()));
        Ok(motet_runtime::run(&mut engine, driver, &mut observer, from))
    }
}

fn read(text: &str) -> (Source, Parsed) {
    let source = Source::new("policy", text);
    let parsed = motet_syntax::read(&source, DOCUMENT);
    (source, parsed)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use motet_graph::Graph;
    use motet_runtime::{Effect, Engine, Observer, PreparedSwap, RetiredGraph, RunEnd, SwapRefusal, Time};

    use super::Motet;

    /// Lets a policy take over, and keeps what is started.
    #[derive(Default)]
    struct Newer {
        offer: Option<Graph>,
        taken: usize,
        started: Vec<String>,
    }

    impl Observer for Newer {
        fn effect(&mut self, _now: Time, effect: &Effect) {
            if let Effect::Start { command, .. } = effect {
                self.started.push(command.to_string());
            }
        }

        fn swap(&mut self, _now: Time, engine: &Engine) -> Option<PreparedSwap> {
            PreparedSwap::new(self.offer.take()?, &engine.running()).ok()
        }

        fn swapped(&mut self, _now: Time, _graph: &Arc<Graph>, result: Result<RetiredGraph, SwapRefusal>) {
            self.taken += usize::from(result.is_ok());
        }
    }

    #[test]
    fn an_observer_lets_a_policy_take_over() {
        let motet = Motet::open("hsr", "kitchen").unwrap();
        let policy = |said: &str| motet.compile(&format!("policy p {{ say(\"{said}\") done }}")).unwrap();
        let (old, new) = (policy("old"), policy("new"));
        let mut observer = Newer { offer: Some(new.graph().clone()), ..Newer::default() };
        let end = motet.run_observed(&old, &mut motet.simulator(&old, 7).unwrap(), &mut observer).unwrap();
        assert!(matches!(end, RunEnd::Done { .. }), "{end}");
        assert_eq!(observer.taken, 1);
        assert!(observer.started.iter().any(|command| command.contains("new")), "{:?}", observer.started);
    }
}
