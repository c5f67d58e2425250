//! `motet dataset lint`: finds faults in files of rows.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;
use motet_dataset::coverage::{Counts, Share};
use motet_dataset::lint::{Finding, ImageCheck, Linter, Place, RowFault, Worlds};
use motet_dataset::{Posture, format, picture};
use motet_project::files::{Bytes, read_small};
use motet_project::{ProjectError, read_scene, robot_names};
use motet_robots::builtin::{self, BuiltinScene};
use motet_robots::scene::{self, Scene};
use motet_syntax::{FileId, Severity, Source, Sources};
use serde_json::{Value, json};
use smol_str::SmolStr;

use super::inputs::{body, effort};
use crate::documents::{Flow, Input};
use crate::error::{CliError, Exit};
use crate::flags::{MotionArgs, OutputFormat};
use crate::output::{count, note};
use crate::report::Report;

/// File with the rooms of the rows beside it.
pub(super) const ROOMS: &str = "scenes.jsonl";

/// Flags of `motet dataset lint`.
#[derive(Args, Debug)]
#[command(after_help = "Exit codes: 0 no findings, 1 findings, 2 the command could not run.")]
pub(super) struct LintArgs {
    /// Files with one row per line; their scenes are in scenes.jsonl beside them
    #[arg(value_name = "FILE", required = true)]
    files: Vec<PathBuf>,
    /// Robot of rows that name none: a built-in name, or a folder with a robot.toml
    #[arg(long, value_name = "NAME|FOLDER")]
    robot: Option<String>,
    /// Scene of rows that name none: a built-in name, or a JSON file
    #[arg(long, value_name = "NAME|FILE")]
    scene: Option<String>,
    #[command(flatten)]
    motions: MotionArgs,
    /// Print the share of the rows that have each construct, failure and recovery
    #[arg(long)]
    shares: bool,
    /// Report constructs in less than 3 % of the rows, and kinds of failure in less than 8 %
    #[arg(long)]
    minimums: bool,
    /// Format of the findings
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    format: OutputFormat,
}

/// Lints files of rows.
pub(super) fn lint(args: &LintArgs, report: &mut Report) -> Result<Exit, CliError> {
    let worlds = worlds(args, report)?;
    let mut images = Images::default();
    let mut linter = Linter::new(&worlds).with_images(&mut images);
    let (mut rows, mut wrong, mut counts) = (0, BTreeSet::new(), Counts::default());
    for path in &args.files {
        let file = path.display().to_string();
        lines(path, &mut |number, line| {
            rows += 1;
            // A line that is no row is a finding below.
            if let Some(Ok(row)) = (args.shares || args.minimums).then(|| format::read(line)) {
                counts.add(&row);
            }
            for finding in linter.line(&file, number, line) {
                wrong.insert((file.clone(), number));
                report.out.document(&shown(&finding, args.format), args.format == OutputFormat::Json);
            }
            Ok(if report.out.is_closed() { Flow::Stop } else { Flow::Continue })
        })?;
    }
    let unused = images.unused(&args.files)?;
    for finding in &unused {
        report.out.document(&shown(finding, args.format), args.format == OutputFormat::Json);
    }
    if rows == 0 {
        note("the files hold no rows");
        return Ok(Exit::Findings);
    }
    let shares = counts.shares();
    for share in shares.iter().filter(|share| args.shares || (args.minimums && share.is_low())) {
        report.out.document(&shown_share(*share, args), args.format == OutputFormat::Json);
    }
    note(&format!("{}, {} with findings", count(rows, "row"), wrong.len()));
    let is_low = args.minimums && shares.iter().any(|share| share.is_low());
    Ok(if wrong.is_empty() && unused.is_empty() && !is_low { Exit::Success } else { Exit::Findings })
}

fn shown_share(share: Share, args: &LintArgs) -> String {
    let (group, name, percent) = (share.subject.group(), share.subject.name(), 100.0 * share.ratio());
    let least = share.subject.least().filter(|_| args.minimums && share.is_low()).map(|least| 100.0 * least);
    match args.format {
        OutputFormat::Human => {
            let least = least.map(|least| format!(", less than {least:.0} %")).unwrap_or_default();
            format!("{group} {name}: {percent:.1} %, {} of {}{least}\n", share.rows, share.of)
        }
        OutputFormat::Json => {
            let is_low = least.is_some();
            let (rows, of) = (share.rows, share.of);
            format!("{}\n", json!({"group": group, "name": name, "rows": rows, "of": of, "low": is_low}))
        }
    }
}

fn shown(finding: &Finding, format: OutputFormat) -> String {
    let Finding { at, fault, message, other } = finding;
    match format {
        OutputFormat::Human => {
            let other = other.as_ref().map(|other| format!(": {}:{}", other.file, other.row));
            let row = if at.row > 0 { format!(":{}", at.row) } else { String::new() };
            format!("{}{row}: {}: {message}{}\n", at.file, fault.name(), other.unwrap_or_default())
        }
        OutputFormat::Json => {
            let other = other.as_ref().map(|other| json!({"file": other.file, "row": other.row}));
            let (file, row, fault) = (&at.file, at.row, fault.name());
            let line = json!({"file": file, "row": row, "fault": fault, "message": message, "other": other});
            format!("{line}\n")
        }
    }
}

/// Robots and rooms that rows may name.
fn worlds(args: &LintArgs, report: &mut Report) -> Result<Worlds, CliError> {
    let mut worlds = Worlds { effort: effort(&args.motions), ..Worlds::default() };
    let own = robot_names().map(str::to_owned);
    for name in own.chain(args.robot.clone()) {
        let body = body(&name, report)?;
        let known = SmolStr::from(body.robot.name.as_str());
        if args.robot.as_deref() == Some(name.as_str()) {
            worlds.robot = Some(known.clone());
        }
        worlds.bodies.insert(known, body);
    }
    for BuiltinScene { name, .. } in builtin::SCENES {
        worlds.scenes.insert(name.into(), read_scene(name, &mut Sources::default(), report)?);
    }
    if let Some(name) = &args.scene {
        worlds.scene = Some(name.into());
        worlds.scenes.insert(name.into(), read_scene(name, &mut Sources::default(), report)?);
    }
    let folders: BTreeSet<PathBuf> =
        args.files.iter().map(|file| file.parent().unwrap_or(Path::new("")).to_owned()).collect();
    for folder in folders {
        let path = folder.join(ROOMS);
        if path.is_file() {
            lines(&path, &mut |number, line| {
                let (name, room, posture) = room(line).map_err(|why| {
                    CliError::Message(format!("`{}`, line {number}: {why}", path.display()))
                })?;
                if !posture.is_empty() {
                    worlds.postures.insert(name.clone(), posture);
                }
                worlds.scenes.insert(name, room);
                Ok(Flow::Continue)
            })?;
        }
    }
    Ok(worlds)
}

/// Reads a line of `scenes.jsonl`: a room with its name.
fn room(line: &str) -> Result<(SmolStr, Scene, Posture), String> {
    let row: Value = serde_json::from_str(line).map_err(|error| format!("it is not JSON: {error}"))?;
    let name = row.get("name").and_then(Value::as_str).ok_or("it has no `name`")?;
    let text = row.get("scene").ok_or("it has no `scene`")?.to_string();
    let posture = match row.get("robot") {
        Some(robot) => serde_json::from_value(robot.clone())
            .map_err(|_| "its `robot` is no object of facts that are true or false")?,
        None => Posture::new(),
    };
    let (scene, diagnostics) = scene::read(&Source::new(name, text), FileId(0));
    let error = diagnostics.iter().find(|found| found.severity == Severity::Error);
    match (scene, error) {
        (Some(scene), None) => Ok((name.into(), scene, posture)),
        (_, error) => {
            Err(error.map_or_else(|| "it is not a scene".to_owned(), |error| error.message.clone()))
        }
    }
}

/// Passes each line of a file that is not empty with its number, from 1.
pub(super) fn lines(
    path: &Path,
    each: &mut dyn FnMut(usize, &str) -> Result<Flow, CliError>,
) -> Result<(), CliError> {
    let input = Input::Lines(path.to_owned());
    input.documents(&mut |document| {
        let number =
            document.name.rsplit(':').next().and_then(|number| number.parse().ok()).unwrap_or_default();
        match &document.bytes {
            Bytes::All(bytes) => each(number, &String::from_utf8_lossy(bytes)),
            Bytes::TooMany(_) => Err(CliError::Message(format!("`{}` is too long for a row", document.name))),
        }
    })?;
    Ok(())
}

/// Extensions of images.
const EXTENSIONS: &[&str] = &["png", "jpg", "jpeg", "webp", "gif"];

/// Images that rows refer to, each with its fault.
#[derive(Debug, Default)]
pub(super) struct Images(BTreeMap<PathBuf, Option<String>>);

impl ImageCheck for Images {
    fn fault(&mut self, file: &str, path: &str) -> Option<String> {
        let found = self.0.entry(folder(Path::new(file)).join(path));
        let place = found.key().clone();
        let fault = found.or_insert_with(|| match read_small(&place) {
            Ok(bytes) => picture::fault(&bytes),
            Err(ProjectError::Read { source, .. }) => Some(source.to_string()),
            Err(error) => Some(error.to_string()),
        });
        fault.as_ref().map(|why| format!("its image `{path}` cannot be used: {why}"))
    }
}

impl Images {
    /// Images beside files of rows to which no row refers, in these files or in others of their folders.
    pub(super) fn unused(mut self, files: &[PathBuf]) -> Result<Vec<Finding>, CliError> {
        let folders: BTreeSet<PathBuf> = files.iter().map(|file| folder(file)).collect();
        let mut folders_with_images: BTreeSet<PathBuf> = self.0.keys().map(|path| folder(path)).collect();
        for folder in &folders {
            folders_with_images.insert(folder.join(picture::FOLDER));
            for other in listed(folder, &["jsonl"]) {
                if !files.contains(&other) && !other.ends_with(ROOMS) {
                    self.refer(&other)?;
                }
            }
        }
        let pictures = folders_with_images.iter().flat_map(|place| listed(place, EXTENSIONS));
        let unused = pictures.filter(|path| !self.0.contains_key(path)).map(|path| Finding {
            at: Place { file: path.display().to_string(), row: 0 },
            fault: RowFault::Image,
            message: "no row refers to it".to_owned(),
            other: None,
        });
        Ok(unused.collect())
    }

    /// Adds the images of the rows in another file.
    fn refer(&mut self, file: &Path) -> Result<(), CliError> {
        lines(file, &mut |_, line| {
            let images = format::read(line).map(|row| row.images).unwrap_or_default();
            self.0.extend(images.into_iter().map(|image| (folder(file).join(image), None)));
            Ok(Flow::Continue)
        })
    }
}

/// Folder of a file.
fn folder(file: &Path) -> PathBuf {
    file.parent().unwrap_or(Path::new("")).to_owned()
}

/// Files of a folder with one of these extensions, in order; none if it is not a folder.
fn listed(folder: &Path, extensions: &[&str]) -> Vec<PathBuf> {
    let place = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let names =
        fs::read_dir(place).into_iter().flatten().flatten().map(|entry| folder.join(entry.file_name()));
    let has_extension = |path: &PathBuf| {
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
        extension.is_some_and(|extension| extensions.contains(&extension.as_str()))
    };
    let mut found: Vec<PathBuf> = names.filter(has_extension).collect();
    found.sort();
    found
}
