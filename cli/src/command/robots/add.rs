//! `motet robots add`: a first card from a URDF, with the SRDF beside it where there is one.

use std::path::{Path, PathBuf};

use motet_robots::card::{DraftInputs, DraftStance};
use motet_robots::srdf::{self, Srdf};
use motet_robots::urdf::Urdf;
use motet_robots::{card, urdf};
use motet_syntax::Sources;

use super::stance;
use crate::exit::{Exit, Trouble};
use crate::input::read_small;
use crate::report::Report;
use crate::workbench::{Card, add};

/// Runs the command.
///
/// # Errors
///
/// The URDF cannot be read, there is a card already, or it cannot be written.
pub(super) fn run(
    path: &Path,
    to: Option<&Path>,
    srdf: Option<&Path>,
    report: &mut Report,
) -> Result<Exit, Trouble> {
    let mut sources = Sources::default();
    let (source, file, mut said) = add(&path.display().to_string(), &read_small(path)?, &mut sources);
    let (robot, more) = urdf::read(&source, file);
    said.extend(more);
    let is_sound = report.usable("URDF", &said, &sources).is_ok();
    // What was read of bytes that are no text is no robot of anyone's.
    let Some(robot) = robot.filter(|_| is_sound) else { return Ok(Exit::Findings) };
    let folder = to.unwrap_or(folder_of(path));
    let target = folder.join("robot.toml");
    if target.exists() {
        return Err(Trouble::Other(format!("`{}` is there already, and is left as it is", target.display())));
    }
    let srdf = srdf.map_or_else(|| lies_beside(path), |given| Some(given.to_owned()));
    let described = match &srdf {
        Some(path) => {
            let Some(srdf) = described(path, &robot, &mut sources, report)? else {
                return Ok(Exit::Findings);
            };
            Some((srdf, seen_from(path, folder)?))
        }
        None => None,
    };
    let file = seen_from(path, folder)?;
    let mut beside =
        DraftInputs { srdf: described.as_ref().map(|(srdf, name)| (srdf, name.as_str())), stance: None };
    let stance = stands(folder, &card::draft(&robot, &file, &beside));
    let touch = stance.as_ref().and_then(|stance| stance.touch.clone());
    beside.stance = stance;
    let text = card::draft(&robot, &file, &beside);
    let write = |source| Trouble::Write { path: target.clone(), source };
    std::fs::create_dir_all(folder).map_err(write)?;
    std::fs::write(&target, &text).map_err(write)?;
    let guesses = text.lines().filter(|line| line.contains("guessed")).count();
    report.out.line(&format!("{}: written, with {guesses} guesses to look at", target.display()));
    if let Some((_, name)) = &described {
        report.out.line(&format!("read with its SRDF, {}", name.escape_debug()));
    }
    if let Some([one, other]) = touch {
        let (one, other) = (one.escape_debug(), other.escape_debug());
        report.out.line(&format!(
            "warning: `{one}` touches `{other}`, and no posture was found in which nothing touches: no motion starts from it"
        ));
    }
    report.out.line(&format!("motet robots check {}", folder.display()));
    Ok(Exit::Clean)
}

/// The SRDF; none where it has a mistake, which the report says.
fn described(
    path: &Path,
    robot: &Urdf,
    sources: &mut Sources,
    report: &mut Report,
) -> Result<Option<Srdf>, Trouble> {
    let (source, file, mut said) = add(&path.display().to_string(), &read_small(path)?, sources);
    let (srdf, more) = srdf::read(&source, file, robot);
    said.extend(more);
    let is_sound = report.usable("SRDF", &said, sources).is_ok();
    Ok(srdf.filter(|_| is_sound))
}

/// How the robot of a card stands, with its meshes and its SRDF; none where its body cannot be used, which `check` says.
fn stands(folder: &Path, card: &str) -> Option<DraftStance> {
    let (mut sources, mut report) = (Sources::default(), Report::silent());
    let card = Card::drafted(folder, card);
    let robot = card.read(&mut sources, &mut report).ok()?;
    let body = card.body(&robot, &mut sources, &mut report).ok()??;
    Some(stance::find(&robot, &body))
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// The SRDF beside a URDF: that of the same name, else the only one.
fn lies_beside(path: &Path) -> Option<PathBuf> {
    let same = path.with_extension("srdf");
    if same.is_file() {
        return Some(same);
    }
    let is_srdf = |path: &PathBuf| path.extension().is_some_and(|end| end == "srdf") && path.is_file();
    let inside = std::fs::read_dir(folder_of(path)).ok()?;
    let mut found = inside.flatten().map(|entry| entry.path()).filter(is_srdf);
    found.next().filter(|_| found.next().is_none())
}

/// The path of a file as seen from the card's folder: its name where it lies there, else its whole path.
fn seen_from(path: &Path, folder: &Path) -> Result<String, Trouble> {
    let whole = |path: &Path| -> Result<PathBuf, Trouble> {
        path.canonicalize().map_err(|source| Trouble::Read { path: path.to_owned(), source })
    };
    // A folder that is not there yet holds no file.
    let is_there =
        folder.canonicalize().is_ok_and(|folder| whole(folder_of(path)).is_ok_and(|own| own == folder));
    let seen = if is_there { path.file_name().map(PathBuf::from) } else { Some(whole(path)?) };
    Ok(seen.unwrap_or_default().display().to_string())
}
