//! What a journal keeps of the world that a run moves in, so that it can be made again without the files of then.

use std::net::SocketAddr;

use indexmap::IndexMap;
use motet_host::remote::DriverAddress;
use motet_robots::{card, scene};
use motet_sim::{Faults, PersonScript, Sim, SimOptions};
use motet_syntax::{FileId, Source};
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;

use super::saved_guard::SavedGuard;
use crate::exit::Trouble;
use crate::workbench::Card;

/// A driver, as the head of a journal describes it.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum Saved {
    /// The simulator.
    Simulator(Box<SavedSim>),
    /// A driver in another process.
    Process {
        /// Where it is: a command and its arguments, or a port.
        address: SavedAddress,
        /// What it calls itself since it was started.
        instance: String,
        /// Who checks the motions that are left to the run.
        #[serde(default)]
        guard: Option<Box<SavedGuard>>,
    },
}

/// Where a driver is.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum SavedAddress {
    /// A command with its arguments.
    Command(Vec<String>),
    /// A TCP port of this machine.
    Tcp(SocketAddr),
}

/// A simulated world.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SavedSim {
    /// The text of robot.toml.
    card: String,
    /// The text of primitives.motet.
    declarations: Option<String>,
    /// The text of the scene.
    scene: Option<String>,
    seed: u64,
    faults: Faults,
    answers: Vec<Option<String>>,
    kinds: IndexMap<SmolStr, SmolStr>,
    entities: Vec<(SmolStr, SmolStr)>,
    told: Vec<(SmolStr, Vec<SmolStr>, bool)>,
    /// Who checks the motions that are left to the run.
    #[serde(default)]
    guard: Option<Box<SavedGuard>>,
}

impl Saved {
    pub(super) fn simulator(
        robot: &Card,
        scene: Option<String>,
        options: &SimOptions,
        guard: Option<SavedGuard>,
    ) -> Self {
        let (card, declarations) = robot.texts();
        let told = options.initial_facts.iter();
        Self::Simulator(Box::new(SavedSim {
            card,
            declarations,
            scene,
            seed: options.seed,
            faults: options.faults.clone(),
            answers: options.script.answers.clone(),
            kinds: options.kinds.clone(),
            entities: options.entities.clone(),
            told: told.map(|((name, args), holds)| (name.clone(), args.clone(), *holds)).collect(),
            guard: guard.map(Box::new),
        }))
    }

    pub(super) fn process(address: &DriverAddress, instance: &str, guard: Option<SavedGuard>) -> Self {
        let address = match address {
            DriverAddress::Command(words) => SavedAddress::Command(words.clone()),
            DriverAddress::Tcp(socket) => SavedAddress::Tcp(*socket),
        };
        Self::Process { address, instance: instance.to_owned(), guard: guard.map(Box::new) }
    }

    /// Who checks the motions that are left to the run, as at its beginning.
    pub(super) fn guard(&self) -> Option<&SavedGuard> {
        match self {
            Self::Simulator(saved) => saved.guard.as_deref(),
            Self::Process { guard, .. } => guard.as_deref(),
        }
    }

    pub(super) fn to_json(&self) -> Result<serde_json::Value, Trouble> {
        serde_json::to_value(self)
            .map_err(|error| Trouble::Other(format!("the world cannot be written down: {error}")))
    }

    /// What a head says.
    ///
    /// # Errors
    ///
    /// It was written by another host.
    pub(super) fn of(json: &serde_json::Value) -> Result<Self, Trouble> {
        if json.is_null() {
            let why = "the run was part of a conversation, in a world that had gone on before it: it can be replayed and not resumed";
            return Err(Trouble::Other(why.to_owned()));
        }
        Self::deserialize(json).map_err(|error| {
            Trouble::Other(format!("the journal does not say in which world the run moved: {error}"))
        })
    }
}

fn unreadable(what: &str) -> Trouble {
    Trouble::Other(format!("the {what} in the journal cannot be read"))
}

impl SavedSim {
    /// The scene; an empty one where none was given.
    ///
    /// # Errors
    ///
    /// It cannot be read any more.
    pub(super) fn scene(&self) -> Result<scene::Scene, Trouble> {
        let Some(text) = &self.scene else { return Ok(scene::Scene::default()) };
        let (scene, _) = scene::read(&Source::new("scene.json", text.as_str()), FileId(0));
        scene.ok_or_else(|| unreadable("scene"))
    }

    /// The simulator as it was at the start.
    ///
    /// # Errors
    ///
    /// The card or the scene cannot be read any more.
    pub(super) fn make(&self) -> Result<Sim, Trouble> {
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
            eye: None,
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
