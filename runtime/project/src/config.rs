//! Settings of a folder, `motet.toml`: the robot, the scene and what else the policies in it are checked
//! against. Paths in it are relative to its folder.

use std::path::{Path, PathBuf};

use motet_robots::builtin;
use motet_robots::clearance::{ClearanceOverride, GREATEST_CLEARANCE};
use motet_syntax::unit::{Dimension, parse_quantity};
use serde::Deserialize;

use crate::error::ProjectError;
use crate::files::read_small;
use crate::project::{Project, ProjectBuilder};
use crate::robot::RobotFiles;

/// Name of the file.
pub const CONFIG: &str = "motet.toml";

/// Keys of the file, all of them optional.
#[derive(Deserialize, Debug)]
#[serde(deny_unknown_fields)]
struct ConfigTable {
    /// A built-in name, or a folder.
    robot: Option<String>,
    /// A built-in name, or a file.
    scene: Option<String>,
    state: Option<PathBuf>,
    #[serde(default)]
    domains: Vec<PathBuf>,
    #[serde(default)]
    clearance: ClearanceTable,
    max_duration: Option<Quantity>,
    /// False if all motions are left to the run.
    #[serde(default = "always")]
    geometry: bool,
    effort: Option<u16>,
}

#[derive(Deserialize, Debug, Default)]
#[serde(deny_unknown_fields)]
struct ClearanceTable {
    base: Option<Quantity>,
    arm: Option<Quantity>,
}

/// A number in the SI unit, or a text with a unit.
#[derive(Deserialize, Debug)]
#[serde(untagged)]
enum Quantity {
    Number(f64),
    Text(String),
}

fn always() -> bool {
    true
}

impl Quantity {
    /// Value in the SI unit, from zero to the greatest.
    fn value(&self, key: &str, dimension: Dimension, greatest: f64) -> Result<f64, String> {
        let value = match self {
            Self::Number(number) => Some(*number),
            Self::Text(text) => parse_quantity(text)
                .filter(|(_, unit)| unit.dimension() == dimension)
                .map(|(number, unit)| unit.to_si(number)),
        };
        let value = value.filter(|value| (0.0..=greatest).contains(value));
        value.ok_or_else(|| {
            format!("`{key}` has to be from 0 to {greatest}, or such a quantity with its unit")
        })
    }
}

/// Nearest `motet.toml`, in a folder or one around it. O(depth of the folder).
#[must_use]
pub fn find_config(folder: &Path) -> Option<PathBuf> {
    let folder = std::path::absolute(folder).ok()?;
    folder.ancestors().map(|folder| folder.join(CONFIG)).find(|file| file.is_file())
}

/// Reads a `motet.toml` as the inputs of a project.
///
/// # Errors
///
/// The file cannot be read, is not TOML of its form, or has a number out of range. The files that it
/// names are read later, by [`ProjectBuilder::open`].
pub fn read_config(path: &Path) -> Result<ProjectBuilder, ProjectError> {
    let wrong = |problem: String| ProjectError::Config { path: path.to_owned(), problem };
    let bytes =
        String::from_utf8(read_small(path)?).map_err(|_| ProjectError::NotText { path: path.to_owned() })?;
    let table: ConfigTable = toml::from_str(&bytes).map_err(|error| {
        let line =
            error.span().and_then(|span| bytes.get(..span.start)).map(|before| before.matches('\n').count());
        let line = line.map_or_else(String::new, |line| format!("line {}: ", line + 1));
        wrong(format!("{line}{}", error.message()))
    })?;
    let folder = path.parent().unwrap_or(Path::new("."));
    let mut project = Project::builder();
    if let Some(robot) = table.robot {
        let is_known = RobotFiles::built_in(&robot).is_some();
        project = project.robot(if is_known { robot } else { within(folder, &robot) });
    }
    if let Some(scene) = table.scene {
        let is_known = builtin::scene_text(&scene).is_some();
        project = project.scene(if is_known { scene } else { within(folder, &scene) });
    }
    if let Some(state) = table.state {
        project = project.state(folder.join(state));
    }
    for domain in table.domains {
        project = project.domain(folder.join(domain));
    }
    if let Some(time) = table.max_duration {
        project =
            project.max_duration(time.value("max_duration", Dimension::DURATION, 604_800.0).map_err(wrong)?);
    }
    let distance = |key: &str, length: Option<Quantity>| {
        length.map(|length| length.value(key, Dimension::LENGTH, GREATEST_CLEARANCE)).transpose()
    };
    let base_m = distance("clearance.base", table.clearance.base).map_err(wrong)?;
    let arm_m = distance("clearance.arm", table.clearance.arm).map_err(wrong)?;
    project = project.clearance(ClearanceOverride { base_m, arm_m });
    if let Some(effort) = table.effort {
        if effort == 0 || effort > 1000 {
            return Err(wrong("`effort` has to be from 1 to 1000".to_owned()));
        }
        project = project.motion_effort(effort);
    }
    Ok(if table.geometry { project } else { project.without_motions() })
}

/// Path below a folder as the text that a project takes.
fn within(folder: &Path, path: &str) -> String {
    folder.join(path).display().to_string()
}
