//! What a journal keeps of the geometry that checks the motions of a run: which files they were, and what the scene said.

use std::path::PathBuf;

use motet_compiler::WorldTracker;
use motet_syntax::ast::File;
use serde::{Deserialize, Serialize};

use crate::args::{Format, KnownArgs, WorldArgs};
use crate::exit::Trouble;
use crate::out::{Colors, note};
use crate::report::Report;
use crate::workbench::{Setting, Workbench};

/// Where the robot's body and the room come from. A body is too large to be written into every journal.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SavedGuard {
    /// A name or a folder.
    robot: String,
    /// A name or a file.
    scene: String,
    /// What it said.
    scene_text: Option<String>,
    state: Option<PathBuf>,
    domain: Vec<PathBuf>,
    effort: u16,
}

impl SavedGuard {
    /// None where nobody looks for motions.
    pub(super) fn of(args: &WorldArgs, setting: &Setting) -> Option<Self> {
        setting.geometry.as_ref()?;
        Some(Self {
            robot: args.known.robot.clone().or_else(|| Some(setting.robot.as_ref()?.name.to_string()))?,
            scene: args.known.scene.clone()?,
            scene_text: setting.scene_text.clone(),
            state: args.known.state.clone(),
            domain: args.known.domain.clone(),
            effort: args.effort,
        })
    }

    /// The world at the beginning of the run, for somebody who checks motions in it; none, with a word, where the files have gone or say
    /// something else now.
    pub(super) fn make(&self, colors: Colors) -> Option<WorldTracker> {
        match self.read(colors) {
            Ok(Some(course)) => Some(course),
            Ok(None) => {
                note("the scene is another now than when the run began: motions are left to the driver");
                None
            }
            Err(trouble) => {
                note(&format!("motions are left to the driver: {trouble}"));
                None
            }
        }
    }

    fn read(&self, colors: Colors) -> Result<Option<WorldTracker>, Trouble> {
        let known = KnownArgs {
            robot: Some(self.robot.clone()),
            scene: Some(self.scene.clone()),
            state: self.state.clone(),
            domain: self.domain.clone(),
        };
        let args = WorldArgs { known, effort: self.effort, ..WorldArgs::default() };
        let mut report = Report::new(Format::Human, colors);
        let mut bench = Workbench::open(&args, &mut report)?;
        let setting = bench.setting(&File::default(), &mut report)?;
        let same = setting.scene_text == self.scene_text;
        Ok(setting.session.world_tracker().filter(|_| same))
    }
}
