//! `motet robots add`: a first card from a URDF.

use std::path::{Path, PathBuf};

use motet_robots::{card, urdf};
use motet_syntax::{FileId, Sources};

use crate::exit::{Exit, Trouble};
use crate::input::read_small;
use crate::report::Report;

/// Runs the command.
///
/// # Errors
///
/// The URDF cannot be read or has a mistake, there is a card already, or it cannot be written.
pub(super) fn run(path: &Path, to: Option<&Path>, report: &mut Report) -> Result<Exit, Trouble> {
    let bytes = read_small(path)?;
    let (source, mut said) = crate::document::decode(&path.display().to_string(), &bytes, FileId(0));
    let mut sources = Sources::default();
    sources.add(source.clone());
    let (robot, more) = urdf::read(&source, FileId(0));
    said.extend(more);
    report.say(&said, &sources);
    let Some(robot) = robot else { return Ok(Exit::Findings) };
    let beside = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let folder = to.unwrap_or(beside);
    let target = folder.join("robot.toml");
    if target.exists() {
        return Err(Trouble::Other(format!("`{}` is there already, and is left as it is", target.display())));
    }
    let write = |source| Trouble::Write { path: target.clone(), source };
    std::fs::create_dir_all(folder).map_err(write)?;
    let text = card::draft(&robot, &seen_from(path, beside, folder)?);
    std::fs::write(&target, &text).map_err(write)?;
    let guesses = text.lines().filter(|line| line.contains("guessed")).count();
    report.out.line(&format!("{}: written, with {guesses} guesses to look at", target.display()));
    report.out.line(&format!("motet robots check {}", folder.display()));
    Ok(Exit::Clean)
}

/// The path of the URDF as seen from the card's folder: its name where it lies there, else its whole path.
fn seen_from(path: &Path, beside: &Path, folder: &Path) -> Result<String, Trouble> {
    let whole = |path: &Path| -> Result<PathBuf, Trouble> {
        path.canonicalize().map_err(|source| Trouble::Read { path: path.to_owned(), source })
    };
    let seen = if whole(beside)? == whole(folder)? {
        path.file_name().map(PathBuf::from)
    } else {
        Some(whole(path)?)
    };
    Ok(seen.unwrap_or_default().display().to_string())
}
