//! The arguments of `eval reach`, and what it prints.

use std::path::PathBuf;

use motet_geometry::planning::SearchBudget;

use crate::judge::{Settings, run};

/// What `--help` says.
const HELP: &str = "usage: reach [SCENE|--rooms N --seed S] [OPTIONS]

Asks `reach` in rooms at random, or for every object of a scene file, and judges the answers.

  --robot NAME      a robot, several times for more: hsr, anymal_z1, panda (all)
  --rooms N         rooms at random (10)
  --seed S          what they are drawn from (1)
  --cells N         cells that a proof may look at
  --quick           a shorter search for the truth
  --unjudged        no search for the truth: answers are counted and witnesses checked
  --witnesses FILE  writes the witnesses there
  --targets FILE    writes the targets there
  --json            only the tables, as JSON";

/// Runs the evaluation: what to print, and whether every witness holds and nothing reachable is certified
/// not to be.
///
/// # Errors
///
/// An argument that is not known, or a file that cannot be read or written.
pub fn command(args: &[String]) -> Result<(String, bool), String> {
    let mut settings = Settings {
        robots: vec![],
        rooms: 10,
        seed: 1,
        scene: None,
        is_quick: false,
        budget: SearchBudget::default(),
        is_unjudged: false,
        cache: Some(PathBuf::from("target/reach")),
        witnesses: None,
        targets: None,
    };
    if args.iter().any(|arg| arg == "--help" || arg == "-h") {
        return Ok((HELP.to_owned(), true));
    }
    let mut is_json = false;
    let mut args = args.iter();
    while let Some(arg) = args.next() {
        let mut value = || args.next().ok_or_else(|| format!("`{arg}` needs a value"));
        let number = |text: &String| text.parse().map_err(|_| format!("`{text}` is no number"));
        match arg.as_str() {
            "--robot" => settings.robots.push(value()?.clone()),
            "--rooms" => settings.rooms = number(value()?)?,
            "--seed" => settings.seed = number(value()?)?,
            "--quick" => settings.is_quick = true,
            "--cells" => settings.budget.cells = number(value()?)? as usize,
            "--unjudged" => settings.is_unjudged = true,
            "--witnesses" => settings.witnesses = Some(value()?.into()),
            "--targets" => settings.targets = Some(value()?.into()),
            "--json" => is_json = true,
            file if !file.starts_with('-') => {
                settings.scene =
                    Some(std::fs::read_to_string(file).map_err(|error| format!("{file}: {error}"))?);
            }
            other => return Err(format!("`{other}` is not known: see --help")),
        }
    }
    if settings.robots.is_empty() {
        settings.robots = ["hsr", "anymal_z1", "panda"].map(String::from).to_vec();
    }
    let (mut lines, tables) = run(&settings)?;
    let is_good = tables.iter().all(|table| table.uncertified_positives == 0 && table.contradicted == 0);
    if is_json {
        lines = vec![serde_json::to_string_pretty(&tables).map_err(|error| error.to_string())?];
    } else {
        lines.extend(tables.iter().map(ToString::to_string));
    }
    Ok((lines.join("\n"), is_good))
}
