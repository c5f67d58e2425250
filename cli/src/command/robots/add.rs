//! `motet robots add`: the first card of a robot, from its URDF or xacro.

use std::path::{Path, PathBuf};

use motet_geometry::planning::RobotModel;
use motet_project::files::{add_source, read_small};
use motet_project::{Discard, RobotFiles, Touching, find_stance, require, touching};
use motet_robots::card::{self, DraftInputs, Robot};
use motet_robots::srdf::{self, Srdf};
use motet_robots::urdf::{self, Urdf, UrdfShape};
use motet_syntax::Sources;
use smol_str::SmolStr;

use super::xacro;
use crate::error::{CliError, Exit};
use crate::flags::folder_of;
use crate::output::{count, replace_file};
use crate::report::Report;

/// Inputs of the command.
pub(super) struct AddInputs<'a> {
    pub(super) urdf: &'a Path,
    pub(super) to: Option<&'a Path>,
    pub(super) srdf: Option<&'a Path>,
    pub(super) packages: &'a [PathBuf],
    pub(super) arguments: &'a [String],
    pub(super) tip: Option<&'a str>,
}

/// Runs the command.
pub(super) fn add(inputs: &AddInputs<'_>, report: &mut Report) -> Result<Exit, CliError> {
    let folder = inputs.to.unwrap_or(folder_of(inputs.urdf));
    let target = folder.join("robot.toml");
    if target.exists() {
        return Err(CliError::Message(format!("`{}` exists already", target.display())));
    }
    let expanded;
    let path = if inputs.urdf.extension().is_some_and(|end| end == "xacro") {
        expanded = expand(inputs, folder, report)?;
        &expanded
    } else {
        inputs.urdf
    };
    let mut sources = Sources::default();
    let (source, file, mut diagnostics) =
        add_source(&path.display().to_string(), &read_small(path)?, &mut sources);
    let (robot, more) = urdf::read(&source, file);
    diagnostics.extend(more);
    let is_sound = require("URDF", &diagnostics, &sources, report).is_ok();
    // Bytes that are not text may still parse as an empty robot.
    let Some(robot) = robot.filter(|_| is_sound) else { return Ok(Exit::Findings) };
    if let Some(tip) = inputs.tip.filter(|tip| robot.links.iter().all(|link| link.name != *tip)) {
        return Err(CliError::Message(format!("the URDF has no link `{}`", tip.escape_debug())));
    }
    let srdf = inputs.srdf.map_or_else(|| srdf_beside(path), |given| Some(given.to_owned()));
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
    let mut packages = package_folders(inputs, &robot)?;
    packages.extend(foreign_folders(&[Some(path), srdf.as_deref()], folder));
    let mut beside = DraftInputs {
        srdf: srdf_read.as_ref().map(|(srdf, name)| (srdf, name.as_str())),
        packages: &packages,
        tip: inputs.tip,
        stance: None,
    };
    let body = body_of(folder, &card::draft(&robot, &file, &beside));
    let stance = body.as_ref().map(|(card, body)| find_stance(card, body));
    let touch = stance.as_ref().and_then(|stance| stance.touch.clone());
    beside.stance = stance;
    let text = card::draft(&robot, &file, &beside);
    let write = |source| CliError::Write { path: target.clone(), source };
    std::fs::create_dir_all(folder).map_err(write)?;
    replace_file(&target, &text)?;
    let guesses = text.lines().filter(|line| line.contains("guessed")).count();
    report.out.line(&format!("wrote {}, with {guesses} guesses to review", target.display()));
    if let Some((_, name)) = &srdf_read {
        report.out.line(&format!("used the SRDF {}", name.escape_debug()));
    }
    tell_unread(body.as_ref(), report);
    tell_arms(&robot, folder, &text, report);
    if let Some([one, other]) = touch {
        let (one, other) = (one.escape_debug(), other.escape_debug());
        report.out.line(&format!(
            "warning: `{one}` touches `{other}`, and no posture without contact was found: \
             no motion can start"
        ));
        if let Some((card, body)) = body_of(folder, &text) {
            let machine = RobotModel::new(&card, &body);
            let found = touching(&machine, machine.rest());
            if !found.pairs.is_empty() {
                let lines = srdf_lines(&found, "Default");
                report.out.line(&format!("  help: an SRDF may allow it: {lines}"));
            }
        }
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

/// Folders for the card in which the packages of the meshes are; those that were given if no package is
/// found.
fn package_folders(inputs: &AddInputs<'_>, robot: &Urdf) -> Result<Vec<String>, CliError> {
    let given: Vec<&Path> = inputs.packages.iter().map(PathBuf::as_path).collect();
    let own = inputs.urdf.canonicalize().map_err(|source| CliError::read(inputs.urdf, source))?;
    let shapes = robot.links.iter().flat_map(|link| &link.collisions);
    let names = shapes.filter_map(|solid| match &solid.shape {
        UrdfShape::Mesh { file, .. } => Some(file.strip_prefix("package://")?.split('/').next()?.to_owned()),
        _ => None,
    });
    let mut folders: Vec<PathBuf> = Vec::new();
    for name in names.collect::<std::collections::BTreeSet<String>>() {
        let found = xacro::package(&own, &given, &name);
        folders.extend(found.and_then(|folder| Some(folder.parent()?.to_owned())));
    }
    if folders.is_empty() {
        for folder in &given {
            folders.push(folder.canonicalize().map_err(|source| CliError::read(folder, source))?);
        }
    }
    folders.sort();
    folders.dedup();
    Ok(folders.iter().map(|folder| folder.display().to_string()).collect())
}

/// Folders of files outside the folder of the card, which reads no others.
fn foreign_folders(files: &[Option<&Path>], folder: &Path) -> Vec<String> {
    let own = folder.canonicalize().ok();
    let mut folders: Vec<PathBuf> = Vec::new();
    for file in files.iter().flatten() {
        let parent = file.canonicalize().ok().and_then(|file| Some(file.parent()?.to_owned()));
        let is_foreign = |parent: &PathBuf| own.as_ref().is_none_or(|own| !parent.starts_with(own));
        folders.extend(parent.filter(is_foreign));
    }
    folders.sort();
    folders.dedup();
    folders.iter().map(|folder| folder.display().to_string()).collect()
}

/// Lines of an SRDF that allow pairs of links to touch, with the reason that `MoveIt` gives for such lines.
pub(super) fn srdf_lines(found: &Touching, reason: &str) -> String {
    let line = |[one, other]: &[SmolStr; 2]| {
        let (one, other) = (one.escape_debug(), other.escape_debug());
        format!("`<disable_collisions link1=\"{one}\" link2=\"{other}\" reason=\"{reason}\"/>`")
    };
    let mut lines: Vec<String> = found.pairs.iter().map(line).collect();
    if found.more > 0 {
        lines.push(format!("and {} more", count(found.more, "pair")));
    }
    lines.join(" ")
}

/// Tells the links whose meshes were not read: motions know no shape of them.
fn tell_unread(body: Option<&(Robot, Urdf)>, report: &mut Report) {
    let Some((card, body)) = body else { return };
    let machine = RobotModel::new(card, body);
    let unread = machine.body().uncovered_links();
    let names = unread.iter().filter_map(|at| machine.tree().links().get(*at));
    let names: Vec<String> = names.map(|name| format!("`{}`", name.escape_debug())).collect();
    if !names.is_empty() {
        report.out.line(&format!(
            "warning: the meshes of {} were not read, so no motion is computed: {}; \
             `--packages FOLDER` says where packages are",
            count(names.len(), "link"),
            names.join(", ")
        ));
    }
}

/// Tells the arms that the card leaves out.
fn tell_arms(urdf: &Urdf, folder: &Path, text: &str, report: &mut Report) {
    let tip =
        body_of(folder, text).and_then(|(card, _)| card.hands.first().and_then(|(_, hand)| hand.tip.clone()));
    for (other, joints) in card::other_arms(urdf, tip.as_deref().unwrap_or_default()) {
        let other = other.escape_debug();
        report.out.line(&format!(
            "note: the card leaves out the arm of {} to `{other}`; `--tip {other}` takes it instead",
            count(joints, "joint")
        ));
    }
}

/// Expands a xacro, and writes the URDF into the folder of the card.
fn expand(inputs: &AddInputs<'_>, folder: &Path, report: &mut Report) -> Result<PathBuf, CliError> {
    let packages: Vec<&Path> = inputs.packages.iter().map(PathBuf::as_path).collect();
    let text = xacro::expand(inputs.urdf, &packages, inputs.arguments).map_err(CliError::Message)?;
    let write = |source| CliError::Write { path: folder.to_owned(), source };
    std::fs::create_dir_all(folder).map_err(write)?;
    let target = folder.join("robot.urdf");
    if target.exists() {
        return Err(CliError::Message(format!("`{}` exists already", target.display())));
    }
    replace_file(&target, &text)?;
    report.out.line(&format!("wrote {}, expanded from the xacro", target.display()));
    Ok(target)
}

/// Card and body of a draft; `None` if its body has errors, which `motet robots check` reports.
fn body_of(folder: &Path, card: &str) -> Option<(Robot, Urdf)> {
    let mut sources = Sources::default();
    let files = RobotFiles::draft(folder, card);
    let robot = files.card(&mut sources, &mut Discard).ok()?;
    let body = files.body(&robot, &mut sources, &mut Discard).ok()??;
    Some((robot, body))
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
