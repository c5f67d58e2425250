//! Robot, scene, state and domains by name or path, opened into compiler sessions.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use indexmap::IndexMap;
use motet_compiler::{CheckOptions, Geometry, InitialFact, InitialState, Session};
use motet_geometry::planning::SearchBudget;
use motet_robots::builtin;
use motet_robots::card::Robot;
use motet_robots::clearance::ClearanceOverride;
use motet_robots::scene::{self, Scene, StateEntry};
use motet_robots::urdf::Urdf;
use motet_runtime::{Pattern, Query, Truth};
use motet_syntax::ast::File;
use motet_syntax::json::{self, Spanned};
use motet_syntax::{FileId, Source, Sources, suggest};

use crate::error::{DiagnosticSink, Discard, ProjectError, invalid, require};
use crate::files::{add_source, is_inline, read_inline, read_small};
use crate::robot::RobotFiles;

/// Id of the document in the sources of a [`ProjectSession`]. The files of the project follow it.
pub const DOCUMENT: FileId = FileId(0);

/// Inputs of a project, as names and paths.
#[derive(Clone, PartialEq, Debug)]
pub struct ProjectBuilder {
    pub(crate) robot: Option<String>,
    pub(crate) scene: Option<String>,
    pub(crate) state: Option<PathBuf>,
    pub(crate) domains: Vec<PathBuf>,
    pub(crate) max_duration_secs: Option<f64>,
    /// Distances from obstacles in place of those of scene and robot.
    pub(crate) clearance: ClearanceOverride,
    /// Factor of the default search budget; `None` defers every motion.
    pub(crate) effort: Option<u16>,
}

impl Default for ProjectBuilder {
    fn default() -> Self {
        Self {
            robot: None,
            scene: None,
            state: None,
            domains: Vec::new(),
            max_duration_secs: None,
            clearance: ClearanceOverride::default(),
            effort: Some(1),
        }
    }
}

impl ProjectBuilder {
    /// Sets the robot: a built-in name, a folder with a `robot.toml`, or the content of one as a JSON object,
    /// whose files are in its `folder`, or else in the present one. Without a robot, the `for NAME` of each
    /// document names a built-in robot.
    #[must_use]
    pub fn robot(mut self, robot: impl Into<String>) -> Self {
        self.robot = Some(robot.into());
        self
    }

    /// Sets the scene: a built-in name, a JSON file, or its JSON itself.
    #[must_use]
    pub fn scene(mut self, scene: impl Into<String>) -> Self {
        self.scene = Some(scene.into());
        self
    }

    /// Sets the facts at the start: a JSON object such as `{"holding(mug_1)": true}`, or a file with one.
    /// `null` marks a fact as unknown.
    #[must_use]
    pub fn state(mut self, state: impl Into<PathBuf>) -> Self {
        self.state = Some(state.into());
        self
    }

    /// Adds a file of declarations.
    #[must_use]
    pub fn domain(mut self, path: impl Into<PathBuf>) -> Self {
        self.domains.push(path.into());
        self
    }

    /// Sets the maximum duration of a policy, in seconds.
    #[must_use]
    pub fn max_duration(mut self, secs: f64) -> Self {
        self.max_duration_secs = Some(secs);
        self
    }

    /// Multiplies the search budget of motions; 1 is the default.
    #[must_use]
    pub fn motion_effort(mut self, factor: u16) -> Self {
        self.effort = Some(factor);
        self
    }

    /// Sets the distances that motions keep from obstacles, in place of those of the scene and the robot.
    #[must_use]
    pub fn clearance(mut self, clearance: ClearanceOverride) -> Self {
        self.clearance = clearance;
        self
    }

    /// Defers every motion to the run.
    #[must_use]
    pub fn without_motions(mut self) -> Self {
        self.effort = None;
        self
    }

    /// Name, folder or JSON of the robot.
    #[must_use]
    pub fn robot_name(&self) -> Option<&str> {
        self.robot.as_deref()
    }

    /// Name, file or JSON of the scene.
    #[must_use]
    pub fn scene_name(&self) -> Option<&str> {
        self.scene.as_deref()
    }

    /// Distances from obstacles in place of those of the scene and the robot, and the search budget of
    /// motions; `None` if every motion is deferred.
    #[must_use]
    pub fn motions(&self) -> Option<(ClearanceOverride, u16)> {
        Some((self.clearance, self.effort?))
    }

    /// Settings of the checks of documents.
    #[must_use]
    pub fn check_options(&self) -> CheckOptions {
        CheckOptions { max_duration_secs: self.max_duration_secs }
    }

    /// Leaves out the domain with a path, as for a check of that file itself.
    #[must_use]
    pub fn without_domain(mut self, path: &Path) -> Self {
        self.domains.retain(|domain| !is_same_file(domain, path));
        self
    }

    /// Files that the project is read from, as far as names and paths say: those of a robot's body are named
    /// by its card.
    #[must_use]
    pub fn files(&self) -> Vec<PathBuf> {
        let robot = self.robot.iter().filter(|name| RobotFiles::built_in(name).is_none() && !is_inline(name));
        let robot = robot.flat_map(|folder| {
            let folder = Path::new(folder);
            [folder.join("robot.toml"), folder.join("primitives.motet"), folder.to_owned()]
        });
        let scene = self.scene.iter().filter(|name| builtin::scene_text(name).is_none() && !is_inline(name));
        let state = self.state.iter().filter(|path| !path.to_str().is_some_and(is_inline));
        robot.chain(scene.map(PathBuf::from)).chain(state.cloned()).chain(self.domains.clone()).collect()
    }

    /// Reads the files. Warnings about them are dropped; see [`ProjectBuilder::open_with`].
    ///
    /// # Errors
    ///
    /// A name is unknown, or a file cannot be read or has errors.
    pub fn open(self) -> Result<Project, ProjectError> {
        self.open_with(&mut Discard)
    }

    /// Reads the files, and reports all diagnostics about them.
    ///
    /// # Errors
    ///
    /// A name is unknown, or a file cannot be read or has errors.
    pub fn open_with(self, sink: &mut dyn DiagnosticSink) -> Result<Project, ProjectError> {
        let mut sources = Sources::default();
        sources.add(Source::new("", ""));
        let robot = match &self.robot {
            Some(name) => {
                let files = RobotFiles::find(name)?;
                let robot = files.card(&mut sources, sink)?;
                Some((files, robot))
            }
            None => None,
        };
        let mut domains = Vec::new();
        for path in &self.domains {
            domains.push(read_domain(path, &mut sources, sink)?);
        }
        let mut scene = None;
        let mut scene_text = None;
        if let Some(name) = &self.scene {
            let file = FileId(u16::try_from(sources.len()).unwrap_or(u16::MAX));
            let mut read = read_scene(name, &mut sources, sink)?;
            read.clearance = self.clearance.or(read.clearance);
            scene = Some(read);
            scene_text = sources.get(file).map(|source| source.text.to_string());
        }
        let state = match &self.state {
            Some(path) => Some(read_state(path, &mut sources, sink)?),
            None => None,
        };
        let sessions = BTreeMap::new();
        Ok(Project { inputs: Arc::new(self), robot, domains, scene, scene_text, state, sources, sessions })
    }
}

/// Inputs shared by all documents, read once. A compiler session is built for each robot that documents ask
/// for.
#[derive(Debug)]
pub struct Project {
    inputs: Arc<ProjectBuilder>,
    robot: Option<(RobotFiles, Robot)>,
    domains: Vec<File>,
    scene: Option<Scene>,
    scene_text: Option<String>,
    state: Option<InitialState>,
    /// An empty place for the document, then the files of the project.
    sources: Sources,
    /// By name of the robot; the empty name is no robot.
    sessions: BTreeMap<String, Arc<ProjectSession>>,
}

impl Project {
    /// Builder of a project without any input, in which motions are searched with the default budget.
    #[must_use]
    pub fn builder() -> ProjectBuilder {
        ProjectBuilder::default()
    }

    /// Session of the project's own robot, or of no robot.
    ///
    /// # Errors
    ///
    /// The scene, the state or a domain does not fit the robot, or the files of its body have errors.
    pub fn session(&mut self, sink: &mut dyn DiagnosticSink) -> Result<&ProjectSession, ProjectError> {
        self.session_for(&File::default(), sink)
    }

    /// Session of the project's own robot, without the project.
    ///
    /// # Errors
    ///
    /// Those of [`Project::session`].
    pub fn into_session(self, sink: &mut dyn DiagnosticSink) -> Result<ProjectSession, ProjectError> {
        let name = self.robot.as_ref().map(|(_, robot)| robot.name.to_string()).unwrap_or_default();
        self.build(&name, sink)
    }

    /// Session for a document: with the project's own robot, or else with the built-in robot that the
    /// document names.
    ///
    /// # Errors
    ///
    /// The scene, the state or a domain does not fit the robot, or the files of its body have errors.
    pub fn session_for(
        &mut self,
        document: &File,
        sink: &mut dyn DiagnosticSink,
    ) -> Result<&ProjectSession, ProjectError> {
        let wanted = self.robot_for(document);
        if !self.sessions.contains_key(&wanted) {
            let session = Arc::new(self.build(&wanted, sink)?);
            self.sessions.insert(wanted.clone(), session);
        }
        let unknown = || ProjectError::Unknown { what: "robot", name: wanted.clone(), help: String::new() };
        self.sessions.get(&wanted).map(Arc::as_ref).ok_or_else(unknown)
    }

    /// The session of [`Project::session_for`], to be shared with other threads.
    ///
    /// # Errors
    ///
    /// Those of [`Project::session_for`].
    pub fn shared_session_for(
        &mut self,
        document: &File,
        sink: &mut dyn DiagnosticSink,
    ) -> Result<Arc<ProjectSession>, ProjectError> {
        self.session_for(document, sink)?;
        let wanted = self.robot_for(document);
        let unknown = || ProjectError::Unknown { what: "robot", name: wanted.clone(), help: String::new() };
        self.sessions.get(&wanted).cloned().ok_or_else(unknown)
    }

    /// Name of the robot whose session checks a document; empty for no robot.
    #[must_use]
    pub fn robot_for(&self, document: &File) -> String {
        match &self.robot {
            Some((_, robot)) => robot.name.to_string(),
            None => {
                named_robot(document).filter(|name| RobotFiles::built_in(name).is_some()).unwrap_or_default()
            }
        }
    }

    /// Is `true` if the project has a scene.
    #[must_use]
    pub fn has_scene(&self) -> bool {
        self.scene.is_some()
    }

    /// Is `true` if a session of the project searches motions.
    #[must_use]
    pub fn has_geometry(&self) -> bool {
        self.sessions.values().any(|session| session.geometry.is_some())
    }

    fn build(&self, robot: &str, sink: &mut dyn DiagnosticSink) -> Result<ProjectSession, ProjectError> {
        let mut sources = self.sources.clone();
        let robot = match (&self.robot, robot) {
            (Some(given), _) => Some(given.clone()),
            (None, "") => None,
            (None, name) => {
                let files = RobotFiles::find(name)?;
                let robot = files.card(&mut sources, sink)?;
                Some((files, robot))
            }
        };
        let (files, robot) = robot.unzip();
        let inputs = SessionInputs {
            robot: robot.as_ref(),
            scene: self.scene.as_ref(),
            state: self.state.as_ref(),
            domains: &self.domains,
            options: self.inputs.check_options(),
        };
        let mut session = inputs.open("robot, scene, state or domain", &mut sources, sink)?;
        let mut geometry = None;
        if let (Some(effort), Some(files), Some(robot), Some(scene)) =
            (self.inputs.effort, &files, &robot, inputs.scene)
            && let Some(urdf) = files.body(robot, &mut sources, sink)?
        {
            require("scene", &scene::fit(scene, &urdf), &sources, sink)?;
            let budget = SearchBudget::default().times(effort.into());
            (session, geometry) = inputs.add_motions(session, &urdf, budget);
            if let Some(geometry) = &geometry {
                require("scene", &geometry.contradicted_sight(), &sources, sink)?;
            }
        }
        Ok(ProjectSession {
            session,
            robot,
            files,
            scene: self.scene.clone(),
            scene_text: self.scene_text.clone(),
            geometry,
            domains: self.domains.clone(),
            inputs: Arc::clone(&self.inputs),
            sources,
        })
    }
}

/// Inputs of a compiler session, in memory.
#[derive(Clone, Copy, Debug, Default)]
pub struct SessionInputs<'a> {
    pub robot: Option<&'a Robot>,
    pub scene: Option<&'a Scene>,
    pub state: Option<&'a InitialState>,
    pub domains: &'a [File],
    pub options: CheckOptions,
}

impl<'a> SessionInputs<'a> {
    /// Inputs of a robot in a scene, without domains.
    #[must_use]
    pub fn of(robot: &'a Robot, scene: &'a Scene, state: Option<&'a InitialState>) -> Self {
        Self { robot: Some(robot), scene: Some(scene), state, ..Self::default() }
    }

    /// Builds the session, in which motions are deferred to the run. `subject` names the inputs in an error.
    ///
    /// # Errors
    ///
    /// The scene, the state or a domain does not fit the robot.
    pub fn open(
        &self,
        subject: &'static str,
        sources: &mut Sources,
        sink: &mut dyn DiagnosticSink,
    ) -> Result<Session, ProjectError> {
        let session = Session::builder()
            .robot(self.robot)
            .domains(self.domains)
            .scene(self.scene)
            .state(self.state)
            .options(self.options)
            .build(sources);
        require(subject, session.input_diagnostics(), sources, sink)?;
        Ok(session)
    }

    /// Lets a session search motions of the robot with this body; unchanged without a robot and a scene.
    #[must_use]
    pub fn add_motions(
        &self,
        session: Session,
        urdf: &Urdf,
        budget: SearchBudget,
    ) -> (Session, Option<Arc<Geometry>>) {
        let (Some(robot), Some(scene)) = (self.robot, self.scene) else { return (session, None) };
        let geometry = Arc::new(Geometry::new(robot, urdf, scene, self.state, budget));
        (session.with_geometry(Arc::clone(&geometry)), Some(geometry))
    }
}

/// Compiler session with the robot, the scene and the files that it was opened from.
#[derive(Debug)]
pub struct ProjectSession {
    pub session: Session,
    pub robot: Option<Robot>,
    pub files: Option<RobotFiles>,
    pub scene: Option<Scene>,
    /// Text of the scene.
    pub scene_text: Option<String>,
    /// Geometry of the robot in the scene; `None` if motions are deferred to the run.
    pub geometry: Option<Arc<Geometry>>,
    /// Declarations on top of the library.
    pub domains: Vec<File>,
    pub(crate) inputs: Arc<ProjectBuilder>,
    sources: Sources,
}

impl ProjectSession {
    /// Inputs of the project, as they were given.
    #[must_use]
    pub fn inputs(&self) -> &ProjectBuilder {
        &self.inputs
    }

    /// Facts that the state says beside or against the scene, in order. What it makes unknown comes first.
    #[must_use]
    pub fn told_facts(&self) -> Vec<(Query, Truth)> {
        if self.inputs.state.is_none() {
            return Vec::new();
        }
        let without = self.session.with_scene(self.scene.as_ref(), None);
        let keyed = |fact: (Query, Truth)| (format!("{:?}", fact.0), fact);
        let facts =
            |session: &Session| session.initial_facts().map(told_fact).map(keyed).collect::<IndexMap<_, _>>();
        let (with, without) = (facts(&self.session), facts(&without));
        let unknown = without.iter().filter(|(key, _)| !with.contains_key(*key));
        let unknown = unknown.map(|(_, (query, _))| (query.clone(), Truth::Unknown));
        let told = with.iter().filter(|(key, fact)| without.get(*key) != Some(fact));
        unknown.chain(told.map(|(_, fact)| fact.clone())).collect()
    }

    /// Sources of the project with a document in its place, [`DOCUMENT`]: rendering diagnostics needs them.
    #[must_use]
    pub fn sources(&self, document: Source) -> Sources {
        let mut all = Sources::default();
        all.add(document);
        let own = (1..self.sources.len()).filter_map(|index| u16::try_from(index).ok());
        for source in own.filter_map(|index| self.sources.get(FileId(index))) {
            all.add(source.clone());
        }
        all
    }
}

fn told_fact(given: InitialFact) -> (Query, Truth) {
    let args = given.args.into_iter().map(|arg| arg.map_or(Pattern::Any, Pattern::Is)).collect();
    (Query::Fact { fluent: given.fluent, args }, Truth::from(given.holds))
}

/// Robot and, if its card names a URDF, its body.
///
/// ```
/// use motet_project::{Discard, open_robot};
///
/// let (robot, urdf) = open_robot("panda", &mut Default::default(), &mut Discard)?;
/// assert_eq!(robot.name, "panda");
/// assert!(urdf.is_some());
/// # Ok::<(), motet_project::ProjectError>(())
/// ```
///
/// # Errors
///
/// There is no such robot, or a file of it cannot be read or has errors.
pub fn open_robot(
    name: &str,
    sources: &mut Sources,
    sink: &mut dyn DiagnosticSink,
) -> Result<(Robot, Option<Urdf>), ProjectError> {
    let files = RobotFiles::find(name)?;
    let robot = files.card(sources, sink)?;
    let urdf = files.body(&robot, sources, sink)?;
    Ok((robot, urdf))
}

/// Robot that the first policy of a document with a `for NAME` names.
#[must_use]
pub fn named_robot(document: &File) -> Option<String> {
    document.policies().find_map(|policy| policy.robot.as_ref()).map(|name| name.text.to_string())
}

/// Reads a scene by a built-in name, from a JSON file, or from the argument itself if it is a JSON object.
///
/// ```
/// use motet_project::{Discard, read_scene};
///
/// let kitchen = read_scene("kitchen", &mut Default::default(), &mut Discard)?;
/// assert!(kitchen.entities.contains_key("mug_1"));
/// let same = read_scene(&motet_robots::scene::write(&kitchen), &mut Default::default(), &mut Discard)?;
/// assert_eq!(same.entities.len(), kitchen.entities.len());
/// # Ok::<(), motet_project::ProjectError>(())
/// ```
///
/// # Errors
///
/// There is no such scene, or the file cannot be read or has errors.
pub fn read_scene(
    name: &str,
    sources: &mut Sources,
    sink: &mut dyn DiagnosticSink,
) -> Result<Scene, ProjectError> {
    let (name, bytes) = match builtin::scene_text(name) {
        Some(texts) => (format!("{name}.json"), texts.json.as_bytes().to_vec()),
        None if is_inline(name) || looks_like_file(name) => read_inline(Path::new(name), "scene.json")?,
        None => return Err(unknown_scene(name)),
    };
    let (source, file, mut diagnostics) = add_source(&name, &bytes, sources);
    let (scene, more) = scene::read(&source, file);
    diagnostics.extend(more);
    require("scene", &diagnostics, sources, sink)?;
    scene.ok_or_else(|| invalid("scene", diagnostics, sources))
}

fn is_same_file(one: &Path, other: &Path) -> bool {
    let real = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_owned());
    one == other || real(one) == real(other)
}

pub(crate) fn looks_like_file(name: &str) -> bool {
    let path = Path::new(name);
    path.exists() || path.extension().is_some() || path.components().count() > 1
}

fn unknown_scene(name: &str) -> ProjectError {
    let names = || builtin::SCENES.iter().map(|scene| scene.name);
    let near = suggest::closest(name, names()).map(|near| format!("did you mean `{near}`? "));
    let help = format!(
        "{}built-in scenes: {}; your own scene is a JSON file",
        near.unwrap_or_default(),
        suggest::one_of(names())
    );
    ProjectError::Unknown { what: "scene", name: name.to_owned(), help }
}

fn read_domain(
    path: &Path,
    sources: &mut Sources,
    sink: &mut dyn DiagnosticSink,
) -> Result<File, ProjectError> {
    let (source, file, mut diagnostics) =
        add_source(&path.display().to_string(), &read_small(path)?, sources);
    let parsed = motet_syntax::read(&source, file);
    if diagnostics.is_empty() {
        diagnostics = parsed.diagnostics;
    }
    require("domain", &diagnostics, sources, sink)?;
    Ok(parsed.file)
}

/// Reads a state and puts it into a scene: what the hand holds, and which containers are open.
///
/// # Errors
///
/// The file cannot be read or has errors, or a fact needs a pose that the scene does not give.
pub fn read_state_into(
    scene: &mut Scene,
    path: &Path,
    sources: &mut Sources,
    sink: &mut dyn DiagnosticSink,
) -> Result<InitialState, ProjectError> {
    let state = read_state(path, sources, sink)?;
    state.put_into(scene).map_err(|why| ProjectError::State(why.into()))?;
    Ok(state)
}

/// Reads a state.
fn read_state(
    path: &Path,
    sources: &mut Sources,
    sink: &mut dyn DiagnosticSink,
) -> Result<InitialState, ProjectError> {
    let (name, bytes) = read_inline(path, "--state")?;
    let (source, file, mut diagnostics) = add_source(&name, &bytes, sources);
    let (facts, more) = json::read::<IndexMap<Spanned<String>, StateEntry>>(&source, file);
    diagnostics.extend(more);
    require("state", &diagnostics, sources, sink)?;
    Ok(facts.ok_or_else(|| invalid("state", diagnostics, sources))?.into_iter().collect())
}
