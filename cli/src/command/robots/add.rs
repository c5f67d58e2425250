//! `motet robots add`: writes a first card from a URDF and, if there is one, its SRDF.

use std::path::{Path, PathBuf};

use motet_project::files::{add_source, read_small};
use motet_project::{Discard, RobotFiles, find_stance, require};
use motet_robots::card::{DraftInputs, DraftStance};
use motet_robots::srdf::{self, Srdf};
use motet_robots::urdf::Urdf;
use motet_robots::{card, urdf};
use motet_syntax::Sources;

use crate::error::{CliError, Exit};
use crate::report::Report;

/// Runs the command.
///
/// # Errors
///
/// The URDF cannot be read, or the card exists already or cannot be written.
pub(super) fn run(
    path: &Path,
    to: Option<&Path>,
    srdf: Option<&Path>,
    report: &mut Report,
) -> Result<Exit, CliError> {
    let mut sources = Sources::default();
    let (source, file, mut diagnostics) =
        add_source(&path.display().to_string(), &read_small(path)?, &mut sources);
    let (robot, more) = urdf::read(&source, file);
    diagnostics.extend(more);
    let is_sound = require("URDF", &diagnostics, &sources, report).is_ok();
    // Bytes that are not text may still parse as an empty robot.
    let Some(robot) = robot.filter(|_| is_sound) else { return Ok(Exit::Findings) };
    let folder = to.unwrap_or(folder_of(path));
    let target = folder.join("robot.toml");
    if target.exists() {
        return Err(CliError::Message(format!("`{}` exists already", target.display())));
    }
    let srdf = srdf.map_or_else(|| srdf_beside(path), |given| Some(given.to_owned()));
    let srdf_read = match &srdf {
        Some(path) => {
            let Some(srdf) = read_srdf(path, &robot, &mut sources, report)? else {
                return Ok(Exit::Findings);
            };
            Some((srdf, relative_to(path, folder)?))
        }
        None => None,
    };
    let file = relative_to(path, folder)?;
    let mut beside =
        DraftInputs { srdf: srdf_read.as_ref().map(|(srdf, name)| (srdf, name.as_str())), stance: None };
    let stance = stance_of(folder, &card::draft(&robot, &file, &beside));
    let touch = stance.as_ref().and_then(|stance| stance.touch.clone());
    beside.stance = stance;
    let text = card::draft(&robot, &file, &beside);
    let write = |source| CliError::Write { path: target.clone(), source };
    std::fs::create_dir_all(folder).map_err(write)?;
    std::fs::write(&target, &text).map_err(write)?;
    let guesses = text.lines().filter(|line| line.contains("guessed")).count();
    report.out.line(&format!("wrote {}, with {guesses} guesses to review", target.display()));
    if let Some((_, name)) = &srdf_read {
        report.out.line(&format!("used the SRDF {}", name.escape_debug()));
    }
    if let Some([one, other]) = touch {
        let (one, other) = (one.escape_debug(), other.escape_debug());
        report.out.line(&format!(
            "warning: `{one}` touches `{other}`, and no posture without contact was found: \
             no motion can start"
        ));
    }
    report.out.line(&format!("next: motet robots check {}", folder.display()));
    Ok(Exit::Success)
}

/// Reads the SRDF; `None` if it has errors, which go to the report.
fn read_srdf(
    path: &Path,
    robot: &Urdf,
    sources: &mut Sources,
    report: &mut Report,
) -> Result<Option<Srdf>, CliError> {
    let (source, file, mut diagnostics) =
        add_source(&path.display().to_string(), &read_small(path)?, sources);
    let (srdf, more) = srdf::read(&source, file, robot);
    diagnostics.extend(more);
    let is_sound = require("SRDF", &diagnostics, sources, report).is_ok();
    Ok(srdf.filter(|_| is_sound))
}

/// DraftStance of the robot of a card; `None` if its body has errors, which `motet robots check` reports.
fn stance_of(folder: &Path, card: &str) -> Option<DraftStance> {
    let mut sources = Sources::default();
    let files = RobotFiles::draft(folder, card);
    let robot = files.card(&mut sources, &mut Discard).ok()?;
    let body = files.body(&robot, &mut sources, &mut Discard).ok()??;
    Some(find_stance(&robot, &body))
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// SRDF beside a URDF: the one of the same name, or else the only one.
fn srdf_beside(path: &Path) -> Option<PathBuf> {
    let same = path.with_extension("srdf");
    if same.is_file() {
        return Some(same);
    }
    let is_srdf = |path: &PathBuf| path.extension().is_some_and(|end| end == "srdf") && path.is_file();
    let inside = std::fs::read_dir(folder_of(path)).ok()?;
    let mut found = inside.flatten().map(|entry| entry.path()).filter(is_srdf);
    found.next().filter(|_| found.next().is_none())
}

/// Path of a file in the card: its name if the file is in the card's folder, otherwise its absolute path.
fn relative_to(path: &Path, folder: &Path) -> Result<String, CliError> {
    let whole = |path: &Path| -> Result<PathBuf, CliError> {
        path.canonicalize().map_err(|source| CliError::read(path, source))
    };
    // A folder that does not exist yet holds no file.
    let is_there =
        folder.canonicalize().is_ok_and(|folder| whole(folder_of(path)).is_ok_and(|own| own == folder));
    let seen = if is_there { path.file_name().map(PathBuf::from) } else { Some(whole(path)?) };
    Ok(seen.unwrap_or_default().display().to_string())
}
