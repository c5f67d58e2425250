//! A compiler session: library and initial environment, built once and shared by all documents checked
//! against them.
//!
//! Here is the state; [`crate::document`] has the checks of documents, [`crate::plan`] the search for plans.

use std::sync::{Arc, OnceLock};

use motet_graph::Value;
use motet_robots::card::Robot;
use motet_robots::scene::{Grip, Scene};
use motet_syntax::ast::File;
use motet_syntax::{Diagnostic, Sources, Span};
use smol_str::SmolStr;

use crate::declare::{Library, LibraryBuilder};
use crate::environment::{Environment, InitialState};
use crate::feasibility::{Access, Geometry, WorldTracker};
use crate::ir::Term;
use crate::signature::Signatures;

/// Settings of a check.
///
/// ```
/// use motet_compiler::{CheckOptions, Session};
/// use motet_syntax::{FileId, Source, Sources};
///
/// let options = CheckOptions { max_duration_secs: Some(60.0) };
/// let session = Session::builder().options(options).build(&mut Sources::default());
/// let source = Source::new("greet.motet", "policy greet { say(\"hello\") within 5 min }");
/// let diagnostics = session.check(&motet_syntax::read(&source, FileId(99)));
/// assert_eq!(diagnostics[0].code.to_string(), "M0801");
/// ```
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct CheckOptions {
    /// The longest duration that a policy may have, in seconds; `None` allows any.
    pub max_duration_secs: Option<f64>,
}

/// A compiler session: library and environment. Cheap to clone, since clones share both.
///
/// A session is `Send` and `Sync`: threads may check documents against one session at the same time.
#[derive(Clone, Debug)]
pub struct Session {
    pub(crate) builder: Arc<LibraryBuilder>,
    pub(crate) library: Arc<Library>,
    pub(crate) environment: Arc<Environment>,
    pub(crate) state: Option<Arc<InitialState>>,
    pub(crate) options: CheckOptions,
    pub(crate) geometry: Option<Arc<Geometry>>,
    /// Built on first use.
    pub(crate) signatures: Arc<OnceLock<Arc<Signatures>>>,
    diagnostics: Arc<[Diagnostic]>,
}

/// Inputs of a [`Session`], all of them optional; see [`Session::builder`].
#[derive(Clone, Debug, Default)]
pub struct SessionBuilder<'a> {
    robot: Option<&'a Robot>,
    domains: &'a [File],
    scene: Option<&'a Scene>,
    state: Option<&'a InitialState>,
    options: CheckOptions,
    geometry: Option<Arc<Geometry>>,
}

impl<'a> SessionBuilder<'a> {
    /// Sets the robot; without one every primitive of the standard library is allowed.
    #[must_use]
    pub fn robot(mut self, robot: impl Into<Option<&'a Robot>>) -> Self {
        self.robot = robot.into();
        self
    }

    /// Sets the scene; without one entities come from domains and documents alone.
    #[must_use]
    pub fn scene(mut self, scene: impl Into<Option<&'a Scene>>) -> Self {
        self.scene = scene.into();
        self
    }

    /// Sets facts at the start, which override those of the scene.
    #[must_use]
    pub fn state(mut self, state: impl Into<Option<&'a InitialState>>) -> Self {
        self.state = state.into();
        self
    }

    /// Sets the declarations on top of the robot's.
    #[must_use]
    pub fn domains(mut self, domains: &'a [File]) -> Self {
        self.domains = domains;
        self
    }

    /// Sets the options of checks.
    #[must_use]
    pub fn options(mut self, options: CheckOptions) -> Self {
        self.options = options;
        self
    }

    /// Sets the geometry for motion queries, made of the same robot, scene and state.
    #[must_use]
    pub fn geometry(mut self, geometry: impl Into<Option<Arc<Geometry>>>) -> Self {
        self.geometry = geometry.into();
        self
    }

    /// Reads the library and builds the environment. The files of the library are added to `sources`;
    /// diagnostics about the inputs are kept in [`Session::input_diagnostics`].
    #[must_use]
    pub fn build(self, sources: &mut Sources) -> Session {
        let mut builder = Library::builder(self.robot, sources);
        if !self.domains.is_empty() {
            builder.layer(self.domains);
        }
        let (library, mut diagnostics) = builder.clone().build();
        let (environment, of_environment) = Environment::new(&library, self.scene, self.state);
        diagnostics.extend(of_environment);
        motet_syntax::diagnostics::limit(&mut diagnostics);
        Session {
            builder: Arc::new(builder),
            library: Arc::new(library),
            environment: Arc::new(environment),
            state: self.state.cloned().map(Arc::new),
            options: self.options,
            geometry: self.geometry,
            signatures: Arc::default(),
            diagnostics: diagnostics.into(),
        }
    }
}

/// A fact that is known at the start.
#[derive(Clone, PartialEq, Debug)]
pub struct InitialFact {
    /// Name of the fluent.
    pub fluent: SmolStr,
    /// Arguments, entities or cases; `None` stands for any entity.
    pub args: Vec<Option<Value>>,
    pub holds: bool,
}

impl Session {
    /// Starts a session; every input is optional.
    ///
    /// ```
    /// use motet_compiler::Session;
    /// use motet_syntax::Sources;
    ///
    /// let session = Session::builder().build(&mut Sources::default());
    /// assert!(session.input_diagnostics().is_empty());
    /// assert!(session.library().policies().next().is_some(), "the standard library declares policies");
    /// ```
    #[must_use]
    pub fn builder<'a>() -> SessionBuilder<'a> {
        SessionBuilder::default()
    }

    /// Diagnostics about robot, domains, scene and state.
    #[must_use]
    pub fn input_diagnostics(&self) -> &[Diagnostic] {
        &self.diagnostics
    }

    /// The same library in another scene and state, without geometry. Much cheaper than a new session, since
    /// no file is read again. The input diagnostics are about the new scene and state only.
    #[must_use]
    pub fn with_scene(&self, scene: Option<&Scene>, state: Option<&InitialState>) -> Self {
        let (environment, diagnostics) = Environment::new(&self.library, scene, state);
        // Facts do not change which names and types a policy may use.
        let signatures = if environment.has_same_vocabulary(&self.environment) {
            Arc::clone(&self.signatures)
        } else {
            Arc::default()
        };
        Self {
            environment: Arc::new(environment),
            state: state.cloned().map(Arc::new),
            geometry: None,
            signatures,
            diagnostics: diagnostics.into(),
            ..self.clone()
        }
    }

    /// The same session with geometry for motion queries. The geometry is that of the session's robot, scene
    /// and state; it may be shared, and caches its answers. Without geometry every motion is deferred.
    #[must_use]
    pub fn with_geometry(mut self, geometry: Arc<Geometry>) -> Self {
        self.geometry = Some(geometry);
        self
    }

    /// The same session without geometry: every motion is deferred.
    #[must_use]
    pub fn without_geometry(&self) -> Self {
        Self { geometry: None, ..self.clone() }
    }

    /// Returns whether the session answers motion queries.
    #[must_use]
    pub fn has_geometry(&self) -> bool {
        self.geometry.is_some()
    }

    /// Decides whether the robot can reach a thing from where it stands, see [`Geometry::access`]; `None`
    /// without geometry.
    #[must_use]
    pub fn access(&self, id: &str) -> Option<Access> {
        Some(self.geometry.as_ref()?.access(id))
    }

    /// Tracker of the world of a run that begins in this session's environment, for deferred motions; `None`
    /// without geometry.
    #[must_use]
    pub fn world_tracker(&self) -> Option<WorldTracker> {
        Some(WorldTracker::new(Arc::clone(&self.library), Arc::clone(self.geometry.as_ref()?)))
    }

    /// The scene, if there is one.
    #[must_use]
    pub fn scene(&self) -> Option<&Scene> {
        self.environment.scene()
    }

    /// The declarations in force.
    #[must_use]
    pub fn library(&self) -> &Library {
        &self.library
    }

    /// Returns whether a text describes any entity of the scene.
    #[must_use]
    pub fn describes(&self, text: &str) -> bool {
        self.environment.is_description(text)
    }

    /// Returns whether a text that begins like that may describe an entity of the scene.
    #[must_use]
    pub fn may_describe(&self, begun: &str) -> bool {
        self.environment.begins_description(begun)
    }

    /// Names and types that a policy for this robot and scene may use. Computed once for all sessions derived
    /// from one another with the same entities: these share one [`Arc`].
    ///
    /// ```
    /// use motet_compiler::Session;
    /// use motet_syntax::Sources;
    ///
    /// let session = Session::builder().build(&mut Sources::default());
    /// let signatures = session.signatures();
    /// let say = signatures.callable("say").expect("a primitive of the standard library");
    /// assert_eq!(signatures.type_name(&say.params[0].ty), "Text");
    /// ```
    #[must_use]
    pub fn signatures(&self) -> Arc<Signatures> {
        let build = || Arc::new(Signatures::new(&self.library, &self.environment));
        Arc::clone(self.signatures.get_or_init(build))
    }

    /// Grip that the state at the start gives.
    #[must_use]
    pub fn initial_grip(&self) -> Option<&Grip> {
        self.state.as_ref()?.grip.as_ref()
    }

    /// Facts at the start with their values, in order: a later one overrides, and one with `None` as an
    /// argument is about every entity.
    pub fn initial_facts(&self) -> impl Iterator<Item = InitialFact> {
        self.environment.initial_facts().filter_map(|(fact, holds)| {
            let def = self.library.fluent(fact.fluent)?;
            let args = fact.args.iter().map(|arg| match arg {
                None => Some(None),
                Some(Term::Entity(entity)) => Some(Some(Value::Entity(self.environment.name(*entity)))),
                Some(Term::Case(of, case)) => {
                    let cases = &self.library.enums.get(of.index())?.cases;
                    Some(Some(Value::Case(cases.get(usize::from(*case))?.clone())))
                }
                Some(_) => None,
            });
            Some(InitialFact { fluent: def.name.clone(), args: args.collect::<Option<_>>()?, holds })
        })
    }

    /// Type-checks the arguments of a stand-alone motion query, each with its span, and returns the
    /// diagnostics that a call of a primitive with this motion would produce. Empty for a motion of which the
    /// robot has no primitive.
    #[must_use]
    pub fn check_motion(&self, name: &str, args: &[(SmolStr, Span)]) -> Vec<Diagnostic> {
        crate::resolve::check_motion(name, args, &self.library, &self.environment)
    }

    /// The same session with other facts at the start.
    pub(crate) fn with_environment(&self, environment: Environment) -> Self {
        Self { environment: Arc::new(environment), ..self.clone() }
    }

    /// Library and environment.
    pub(crate) fn parts(&self) -> (&Library, &Environment) {
        (&self.library, &self.environment)
    }

    /// The environment at the start.
    pub(crate) fn environment(&self) -> &Environment {
        &self.environment
    }
}
