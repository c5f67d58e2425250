//! `motet dataset`: generates a dataset and writes its files.

use std::fs::{self, File};
use std::io::{BufWriter, Write as _};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;

use motet_dataset::form::{self, Form};
use motet_dataset::generate::{self, Dataset, Order, Part};
use motet_dataset::lint::family;
use motet_dataset::picture::{FOLDER, Pictures};
use motet_dataset::{Row, scenery, wordings};
use motet_project::files::read_small;
use motet_project::read_scene;
use motet_robots::scene;
use motet_syntax::Sources;
use serde_json::{Value, json};
use smol_str::SmolStr;

use super::{MakeArgs, RowFormat};
use crate::error::{CliError, Exit};
use crate::output::{count, note};
use crate::report::Report;

/// Generates a dataset.
///
/// # Errors
///
/// A file cannot be read or written, or has errors.
pub(super) fn make(args: &MakeArgs, report: &mut Report) -> Result<Exit, CliError> {
    let Some(folder) = &args.out else {
        return Err(CliError::Message("give a folder with --out FOLDER".to_owned()));
    };
    if args.images && args.form == RowFormat::Inteliplan {
        return Err(CliError::Message("rows in the format `inteliplan` are texts without images".to_owned()));
    }
    let order = order(args, report)?;
    let dataset = generate::gather(&order, parts(&order));
    fs::create_dir_all(folder).map_err(|source| CliError::Write { path: folder.clone(), source })?;
    for (name, rows) in [("train", &dataset.train), ("test", &dataset.test)] {
        let lines = rows.iter().map(|row| form::write(row, order.form));
        write(&folder.join(format!("{name}.jsonl")), lines)?;
        let rooms: std::collections::BTreeSet<&str> =
            rows.iter().map(|row| family(&row.about.scene)).collect();
        report.out.line(&format!(
            "{name}.jsonl: {} in {}{}",
            count(rows.len(), "row"),
            count(rooms.len(), "room"),
            kinds(rows)
        ));
    }
    write(&folder.join("scenes.jsonl"), scenes(&dataset))?;
    if order.form == Form::LlamaFactory {
        let info = form::dataset_info(&["train", "test"], order.pictures);
        write(&folder.join("dataset_info.json"), [info].into_iter())?;
    }
    if order.pictures == Pictures::EachRow {
        pictures(folder, &dataset)?;
        report.out.line(&format!("{FOLDER}: {}", count(dataset.pictures.len(), "picture")));
    }
    for (why, dropped) in &dataset.dropped {
        note(&format!("left out {dropped}: {why}"));
    }
    if dataset.train.is_empty() {
        return Err(CliError::Message("the dataset is empty".to_owned()));
    }
    Ok(Exit::Success)
}

fn order(args: &MakeArgs, report: &mut Report) -> Result<Order, CliError> {
    let wordings = match &args.wordings {
        Some(path) => {
            let bytes = read_small(path)?;
            wordings::read(&String::from_utf8_lossy(&bytes))
                .map_err(|wrong| CliError::Message(format!("`{}`, {wrong}", path.display())))?
        }
        None => wordings::read(wordings::OWN).map_err(|wrong| CliError::Message(wrong.to_string()))?,
    };
    let things = match &args.things {
        Some(name) => read_scene(name, &mut Sources::default(), report)?,
        None => scenery::things(),
    };
    let mut rooms = Vec::new();
    for name in &args.room {
        let scene = read_scene(name, &mut Sources::default(), report)?;
        let stem =
            Path::new(name).file_stem().map_or(name.clone(), |stem| stem.to_string_lossy().into_owned());
        rooms.push((SmolStr::from(stem.replace('.', "_")), scene));
    }
    let bodies = args.robot.iter().map(|name| super::body(name, report)).collect::<Result<_, _>>()?;
    Ok(Order {
        seed: args.seed,
        bodies,
        rooms,
        things,
        wordings,
        scenes: args.scenes as usize,
        cases: args.cases as usize,
        test: args.test,
        effort: super::effort(&args.motions),
        form: match args.form {
            RowFormat::Trl => Form::Trl,
            RowFormat::Llamafactory => Form::LlamaFactory,
            RowFormat::QwenVl => Form::QwenVl,
            RowFormat::Inteliplan => Form::InteLiPlan,
        },
        pictures: if args.images { Pictures::EachRow } else { Pictures::None },
    })
}

/// Parts of a dataset in order, generated on all cores.
fn parts(order: &Order) -> Vec<Part> {
    let workers = std::thread::available_parallelism().map_or(1, usize::from).min(order.scenes);
    let next = AtomicUsize::new(0);
    let (send, receive) = mpsc::channel();
    std::thread::scope(|scope| {
        for _ in 0..workers {
            let (send, next) = (send.clone(), &next);
            scope.spawn(move || {
                loop {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    if number >= order.scenes || send.send((number, generate::part(order, number))).is_err() {
                        return;
                    }
                }
            });
        }
    });
    drop(send);
    let mut parts: Vec<(usize, Part)> = receive.into_iter().collect();
    parts.sort_by_key(|(number, _)| *number);
    parts.into_iter().map(|(_, part)| part).collect()
}

/// Suffix with the number of rows after a failure.
fn kinds(rows: &[Row]) -> String {
    let later = rows.iter().filter(|row| row.about.turn > 0).count();
    if later == 0 { String::new() } else { format!(", {later} of them after a failure") }
}

/// Writes the images of the rows.
fn pictures(folder: &Path, dataset: &Dataset) -> Result<(), CliError> {
    let place = folder.join(FOLDER);
    let cannot = |path: &Path| {
        let path = path.to_owned();
        move |source| CliError::Write { path, source }
    };
    fs::create_dir_all(&place).map_err(cannot(&place))?;
    for (name, bytes) in &dataset.pictures {
        let path = folder.join(name.as_str());
        fs::write(&path, bytes).map_err(cannot(&path))?;
    }
    Ok(())
}

fn scenes(dataset: &Dataset) -> impl Iterator<Item = String> + '_ {
    dataset.scenes.iter().map(|(name, room)| {
        let room: Value = serde_json::from_str(&scene::write(room)).unwrap_or_default();
        json!({"name": name.as_str(), "scene": room}).to_string()
    })
}

fn write(path: &Path, lines: impl Iterator<Item = String>) -> Result<(), CliError> {
    let cannot = |source| CliError::Write { path: path.to_owned(), source };
    let mut file = BufWriter::new(File::create(path).map_err(cannot)?);
    for line in lines {
        writeln!(file, "{line}").map_err(cannot)?;
    }
    file.flush().map_err(cannot)
}
