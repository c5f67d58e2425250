//! Description of a run's driver in the head of its journal: enough to open the run again, without the files
//! it was opened from where they are small.

use std::net::SocketAddr;
use std::path::PathBuf;

use indexmap::IndexMap;
use motet_host::remote::DriverAddress;
use motet_robots::card::CameraMount;
use motet_robots::clearance::ClearanceOverride;
use motet_robots::{card, scene};
use motet_sim::{Faults, PersonScript, Profile, Sim, SimOptions};
use motet_syntax::{FileId, Source};
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;

use crate::error::{DiagnosticSink, ProjectError};
use crate::project::{Project, ProjectBuilder, ProjectSession};
use crate::robot::RobotFiles;

/// Driver of a run, as the head of its journal describes it.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum SavedDriver {
    Simulator(Box<SavedSimulator>),
    /// A driver in another process.
    Process {
        address: SavedAddress,
        /// Name that the driver gave itself when it started.
        instance: String,
        #[serde(default)]
        guard: Option<Box<SavedProject>>,
        /// True if a person answered the questions of the policy, not the driver.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        asks: bool,
    },
}

/// DriverAddress of a driver process.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SavedAddress {
    /// Command with its arguments.
    Command(Vec<String>),
    /// TCP port of this machine.
    Tcp(SocketAddr),
}

/// Simulator of a run with all of its inputs.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SavedSimulator {
    /// Text of `robot.toml`.
    card: String,
    /// Text of `primitives.motet`.
    declarations: Option<String>,
    /// Text of the scene.
    scene: Option<String>,
    seed: u64,
    faults: Faults,
    answers: Vec<Option<String>>,
    kinds: IndexMap<SmolStr, SmolStr>,
    entities: Vec<(SmolStr, SmolStr)>,
    told: Vec<(SmolStr, Vec<SmolStr>, bool)>,
    #[serde(default)]
    profile: Profile,
    /// Text of the scene as it is, if it differs from the one that the robot knows.
    #[serde(default)]
    world: Option<String>,
    #[serde(default)]
    eye: Option<CameraMount>,
    #[serde(default)]
    guard: Option<Box<SavedProject>>,
    /// True if a person answered the questions of the policy, not the simulated one.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    asks: bool,
}

impl SavedDriver {
    /// Description of a simulator. `project` is saved if motions are checked during the run.
    #[must_use]
    pub fn simulator(
        robot: &RobotFiles,
        scene: Option<String>,
        options: &SimOptions,
        project: Option<SavedProject>,
    ) -> Self {
        let (card, declarations) = robot.texts();
        let told = options.initial_facts.iter();
        Self::Simulator(Box::new(SavedSimulator {
            card,
            declarations,
            scene,
            seed: options.seed,
            faults: options.faults.clone(),
            answers: options.script.answers.clone(),
            kinds: options.kinds.clone(),
            entities: options.entities.clone(),
            told: told.map(|((name, args), holds)| (name.clone(), args.clone(), *holds)).collect(),
            profile: options.profile.clone(),
            world: options.world.as_ref().map(scene::write),
            eye: options.eye,
            guard: project.map(Box::new),
            asks: false,
        }))
    }

    /// The same, and whether a person answers the questions of the policy.
    #[must_use]
    pub fn with_person(mut self, has_person: bool) -> Self {
        match &mut self {
            Self::Simulator(saved) => saved.asks = has_person,
            Self::Process { asks, .. } => *asks = has_person,
        }
        self
    }

    /// True if a person answered the questions of the policy, not the simulated one or the driver.
    #[must_use]
    pub fn asks(&self) -> bool {
        match self {
            Self::Simulator(saved) => saved.asks,
            Self::Process { asks, .. } => *asks,
        }
    }

    /// Description of a driver process.
    #[must_use]
    pub fn process(address: &DriverAddress, instance: &str, project: Option<SavedProject>) -> Self {
        let address = match address {
            DriverAddress::Command(words) => SavedAddress::Command(words.clone()),
            DriverAddress::Tcp(socket) => SavedAddress::Tcp(*socket),
        };
        let guard = project.map(Box::new);
        Self::Process { address, instance: instance.to_owned(), guard, asks: false }
    }

    /// The same with the name that the driver has given itself for the run.
    #[must_use]
    pub fn with_instance(mut self, name: String) -> Self {
        if let Self::Process { instance, .. } = &mut self {
            *instance = name;
        }
        self
    }

    /// Project in which motions are checked during the run.
    #[must_use]
    pub fn project(&self) -> Option<&SavedProject> {
        match self {
            Self::Simulator(saved) => saved.guard.as_deref(),
            Self::Process { guard, .. } => guard.as_deref(),
        }
    }

    /// JSON of the description, for the head of a journal.
    ///
    /// # Errors
    ///
    /// [`ProjectError::Journal`].
    pub fn to_json(&self) -> Result<serde_json::Value, ProjectError> {
        serde_json::to_value(self)
            .map_err(|error| ProjectError::Journal(format!("cannot describe the driver as JSON: {error}")))
    }

    /// Reads the description in the head of a journal.
    ///
    /// # Errors
    ///
    /// [`ProjectError::Journal`] if the run was part of a conversation, or the journal was written by
    /// another host.
    pub fn from_json(json: &serde_json::Value) -> Result<Self, ProjectError> {
        if json.is_null() {
            let why = "the run was part of a conversation, whose scene earlier runs had changed, or on a \
                       driver inside of a program: it can be replayed but not resumed";
            return Err(ProjectError::Journal(why.to_owned()));
        }
        let wrong = |why: String| {
            ProjectError::Journal(format!("the journal does not describe the driver of the run: {why}"))
        };
        let driver = Self::deserialize(json).map_err(|error| wrong(error.to_string()))?;
        if let Self::Simulator(saved) = &driver {
            saved.check().map_err(wrong)?;
        }
        Ok(driver)
    }
}

fn read_scene(text: &str) -> Result<scene::Scene, ProjectError> {
    let (scene, _) = scene::read(&Source::new("scene.json", text), FileId(0));
    scene.ok_or_else(|| unreadable("scene"))
}

fn unreadable(what: &str) -> ProjectError {
    ProjectError::Journal(format!("cannot read the {what} in the journal"))
}

impl SavedSimulator {
    /// Checks the numbers, as those of the files from which they came were checked.
    fn check(&self) -> Result<(), String> {
        self.faults.check().map_err(|error| error.to_string())?;
        self.profile.check().map_err(|error| error.to_string())?;
        match &self.eye {
            Some(camera) if !camera.is_possible() => {
                Err("the position or the angles of the camera are out of range".to_owned())
            }
            Some(_) | None => Ok(()),
        }
    }

    /// Scene of the run; an empty one if none was given.
    ///
    /// # Errors
    ///
    /// This version cannot read the saved scene.
    pub fn scene(&self) -> Result<scene::Scene, ProjectError> {
        self.scene.as_ref().map_or_else(|| Ok(scene::Scene::default()), |text| read_scene(text))
    }

    /// Simulator in its state at the start of the run.
    ///
    /// # Errors
    ///
    /// This version cannot read the saved card or scene.
    pub fn open(&self) -> Result<Sim, ProjectError> {
        let source = Source::new("robot.toml", self.card.as_str());
        let (robot, _) = card::read(&source, FileId(0), self.declarations.as_deref());
        let robot = robot.ok_or_else(|| unreadable("robot card"))?;
        let scene = self.scene()?;
        let told = self.told.iter();
        let options = SimOptions {
            seed: self.seed,
            faults: self.faults.clone(),
            script: PersonScript { answers: self.answers.clone() },
            kinds: self.kinds.clone(),
            entities: self.entities.clone(),
            initial_facts: told.map(|(name, args, holds)| ((name.clone(), args.clone()), *holds)).collect(),
            eye: self.eye,
            profile: self.profile.clone(),
            world: self.world.as_deref().map(read_scene).transpose()?,
        };
        Ok(Sim::new(&robot, &scene, options))
    }
}

impl From<SavedAddress> for DriverAddress {
    fn from(address: SavedAddress) -> Self {
        match address {
            SavedAddress::Command(words) => Self::Command(words),
            SavedAddress::Tcp(socket) => Self::Tcp(socket),
        }
    }
}

/// Names and paths from which the geometry of a run was opened. A robot's body is too large for every
/// journal, so its files are read again; the text of the scene tells whether it has changed since.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SavedProject {
    /// Name or folder.
    robot: String,
    /// Name or file.
    scene: String,
    scene_text: Option<String>,
    state: Option<PathBuf>,
    domain: Vec<PathBuf>,
    effort: u16,
    #[serde(default, skip_serializing_if = "ClearanceOverride::is_empty")]
    clearance: ClearanceOverride,
}

impl SavedProject {
    /// Inputs of a session; `None` if it does not search motions.
    #[must_use]
    pub fn of(opened: &ProjectSession) -> Option<Self> {
        opened.geometry.as_ref()?;
        let inputs = &opened.inputs;
        Some(Self {
            robot: inputs.robot.clone().or_else(|| Some(opened.robot.as_ref()?.name.to_string()))?,
            scene: inputs.scene.clone()?,
            scene_text: opened.scene_text.clone(),
            state: inputs.state.clone(),
            domain: inputs.domains.clone(),
            effort: inputs.effort?,
            clearance: inputs.clearance,
        })
    }

    /// Session at the beginning of the run; `None` if the scene has changed since then.
    ///
    /// # Errors
    ///
    /// A file is gone, or has errors now.
    pub fn session(&self, sink: &mut dyn DiagnosticSink) -> Result<Option<ProjectSession>, ProjectError> {
        let inputs = ProjectBuilder {
            robot: Some(self.robot.clone()),
            scene: Some(self.scene.clone()),
            state: self.state.clone(),
            domains: self.domain.clone(),
            effort: Some(self.effort),
            clearance: self.clearance,
            ..ProjectBuilder::default()
        };
        let project: Project = inputs.open_with(sink)?;
        let opened = project.into_session(sink)?;
        Ok(Some(opened).filter(|opened| opened.scene_text == self.scene_text))
    }
}
