//! Against what documents are checked: the robot, the scene, the state, the domains. Read once; a session is made for
//! each robot that the documents ask for.

mod body;
mod cards;
mod scenes;
mod state;

use std::collections::BTreeMap;
use std::sync::Arc;

use motet_compiler::{Geometry, Options, Session, State};
use motet_geometry::planning::SearchBudget;
use motet_robots::card::Robot;
use motet_robots::scene::{self, Scene};
use motet_syntax::ast::File;
use motet_syntax::{Diagnostic, FileId, Parsed, Source, Sources};

use crate::args::WorldArgs;
use crate::exit::Trouble;
use crate::input::read_small;
use crate::report::Report;

pub(crate) use cards::{Card, robot_names};
pub(crate) use scenes::read as read_scene;

/// The id of the document in the sources of its setting. The files of the setting come after it.
pub(crate) const DOCUMENT: FileId = FileId(0);

/// What all documents have in common.
#[derive(Debug)]
pub(crate) struct Workbench {
    robot: Option<(Card, Robot)>,
    domains: Vec<File>,
    scene: Option<Scene>,
    /// The scene as it was read.
    scene_text: Option<String>,
    state: Option<State>,
    options: Options,
    /// How long motions are looked for; not at all where there is none.
    effort: Option<SearchBudget>,
    /// An empty place for the document, then the files that were given.
    sources: Sources,
    settings: BTreeMap<String, Setting>,
}

/// A session with the sources of its files.
#[derive(Debug)]
pub(crate) struct Setting {
    /// The session.
    pub(crate) session: Session,
    /// The robot, if any.
    pub(crate) robot: Option<Robot>,
    /// Its card, as it was read.
    pub(crate) card: Option<Card>,
    /// The scene, if any.
    pub(crate) scene: Option<Scene>,
    /// The scene as it was read.
    pub(crate) scene_text: Option<String>,
    /// The robot's body in the scene, where motions are looked for.
    pub(crate) geometry: Option<Arc<Geometry>>,
    /// The domains on top of the library.
    pub(crate) domains: Vec<File>,
    sources: Sources,
}

impl Workbench {
    /// Reads what the flags name. Its diagnostics go to the report.
    ///
    /// # Errors
    ///
    /// A file cannot be read, or what it says cannot be used.
    pub(crate) fn open(args: &WorldArgs, report: &mut Report) -> Result<Self, Trouble> {
        let mut sources = Sources::default();
        sources.add(Source::new("", ""));
        let robot = match &args.known.robot {
            Some(name) => {
                let card = Card::find(name)?;
                let robot = card.read(&mut sources, report)?;
                Some((card, robot))
            }
            None => None,
        };
        let mut domains = Vec::new();
        for path in &args.known.domain {
            let name = path.display().to_string();
            let parsed = read_text(&name, &read_small(path)?, &mut sources);
            report.usable("domain", &parsed.diagnostics, &sources)?;
            domains.push(parsed.file);
        }
        let scene = match &args.known.scene {
            Some(name) => Some(scenes::read(name, &mut sources, report)?),
            None => None,
        };
        let last = u16::try_from(sources.len().saturating_sub(1)).ok();
        let scene_text =
            last.and_then(|last| sources.get(FileId(last))).map(|source| source.text.to_string());
        let scene_text = scene_text.filter(|_| scene.is_some());
        let state = match &args.known.state {
            Some(path) => Some(state::read(path, &mut sources, report)?),
            None => None,
        };
        let options = Options { max_duration_secs: args.max_duration };
        let effort = (!args.no_geometry).then(|| SearchBudget::default().times(args.effort.into()));
        let settings = BTreeMap::new();
        Ok(Self { robot, domains, scene, scene_text, state, options, effort, sources, settings })
    }

    /// The setting for a document: with the robot that was given, else with the one that the document names.
    ///
    /// # Errors
    ///
    /// The state, the scene or a domain does not fit the robot.
    pub(crate) fn setting(&mut self, document: &File, report: &mut Report) -> Result<&Setting, Trouble> {
        let wanted = match &self.robot {
            Some((_, robot)) => robot.name.to_string(),
            None => wanted_robot(document).filter(|name| cards::embedded(name).is_some()).unwrap_or_default(),
        };
        if !self.settings.contains_key(&wanted) {
            let setting = self.make(&wanted, report)?;
            self.settings.insert(wanted.clone(), setting);
        }
        self.settings.get(&wanted).ok_or_else(|| Trouble::Unknown {
            what: "robot",
            name: wanted,
            help: String::new(),
        })
    }

    /// Whether a scene was given.
    #[must_use]
    pub(crate) fn has_scene(&self) -> bool {
        self.scene.is_some()
    }

    /// Whether motions were looked for in a scene.
    #[must_use]
    pub(crate) fn has_geometry(&self) -> bool {
        self.settings.values().any(|setting| setting.geometry.is_some())
    }

    fn make(&self, robot: &str, report: &mut Report) -> Result<Setting, Trouble> {
        let mut sources = self.sources.clone();
        let robot = match (&self.robot, robot) {
            (Some(given), _) => Some(given.clone()),
            (None, "") => None,
            (None, name) => {
                let card = Card::find(name)?;
                let robot = card.read(&mut sources, report)?;
                Some((card, robot))
            }
        };
        let (card, robot) = robot.unzip();
        let (scene, state) = (self.scene.as_ref(), self.state.as_ref());
        let (mut session, said) =
            Session::new(robot.as_ref(), &self.domains, scene, state, self.options, &mut sources);
        report.usable("robot, scene, state or domain", &said, &sources)?;
        let mut geometry = None;
        if let (Some(budget), Some(card), Some(robot), Some(scene)) = (self.effort, &card, &robot, scene)
            && let Some(urdf) = card.body(robot, &mut sources, report)?
        {
            report.usable("scene", &scene::fit(scene, &urdf), &sources)?;
            let made = Arc::new(Geometry::new(robot, &urdf, scene, state, budget));
            session = session.with_geometry(Arc::clone(&made));
            geometry = Some(made);
        }
        let (scene, scene_text) = (self.scene.clone(), self.scene_text.clone());
        let domains = self.domains.clone();
        Ok(Setting { session, robot, card, scene, scene_text, geometry, domains, sources })
    }
}

impl Setting {
    /// The sources with a document in its place.
    #[must_use]
    pub(crate) fn sources(&self, document: Source) -> Sources {
        let mut all = Sources::default();
        all.add(document);
        for index in 1..self.sources.len() {
            if let Some(source) = u16::try_from(index).ok().and_then(|index| self.sources.get(FileId(index)))
            {
                all.add(source.clone());
            }
        }
        all
    }
}

/// Adds a text to the sources and reads it.
fn read_text(name: &str, bytes: &[u8], sources: &mut Sources) -> Parsed {
    let (source, file, said) = add(name, bytes, sources);
    let mut parsed = motet_syntax::read(&source, file);
    if !said.is_empty() {
        parsed.diagnostics = said;
    }
    parsed
}

/// Adds a file to the sources, with what is wrong with its bytes as text.
pub(crate) fn add(name: &str, bytes: &[u8], sources: &mut Sources) -> (Source, FileId, Vec<Diagnostic>) {
    let file = FileId(u16::try_from(sources.len()).unwrap_or(u16::MAX));
    let (source, said) = crate::document::decode(name, bytes, file);
    sources.add(source.clone());
    (source, file, said)
}

/// The robot that a document names first.
#[must_use]
pub(crate) fn wanted_robot(document: &File) -> Option<String> {
    document.policies().find_map(|policy| policy.robot.as_ref()).map(|name| name.text.to_string())
}
