//! Makes a dataset and writes its files.

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
use motet_robots::scene;
use motet_syntax::Sources;
use serde_json::{Value, json};
use smol_str::SmolStr;

use crate::args::{MakeArgs, RowForm};
use crate::exit::{Exit, Trouble};
use crate::input::read_small;
use crate::out::{count, note};
use crate::report::Report;
use crate::workbench::read_scene;

/// Makes a dataset.
///
/// # Errors
///
/// A file cannot be read or written, or what it says cannot be used.
pub(super) fn make(args: &MakeArgs, report: &mut Report) -> Result<Exit, Trouble> {
    let Some(folder) = &args.out else {
        return Err(Trouble::Other("a folder is needed: give --out FOLDER".to_owned()));
    };
    if args.images && args.form == RowForm::Inteliplan {
        return Err(Trouble::Other("rows in the form `inteliplan` are texts and have no images".to_owned()));
    }
    let order = order(args, report)?;
    let dataset = generate::gather(&order, parts(&order));
    fs::create_dir_all(folder).map_err(|source| Trouble::Write { path: folder.clone(), source })?;
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
        return Err(Trouble::Other("no row came of it".to_owned()));
    }
    Ok(Exit::Clean)
}

fn order(args: &MakeArgs, report: &mut Report) -> Result<Order, Trouble> {
    let wordings = match &args.wordings {
        Some(path) => {
            let bytes = read_small(path)?;
            wordings::read(&String::from_utf8_lossy(&bytes))
                .map_err(|wrong| Trouble::Other(format!("`{}`, {wrong}", path.display())))?
        }
        None => wordings::read(wordings::OWN).map_err(|wrong| Trouble::Other(wrong.to_string()))?,
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
            RowForm::Trl => Form::Trl,
            RowForm::Llamafactory => Form::LlamaFactory,
            RowForm::QwenVl => Form::QwenVl,
            RowForm::Inteliplan => Form::InteLiPlan,
        },
        pictures: if args.images { Pictures::EachRow } else { Pictures::None },
    })
}

/// The parts of a dataset, made on all cores, in their order.
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

/// `, of which 12 are behind a failure`
fn kinds(rows: &[Row]) -> String {
    let later = rows.iter().filter(|row| row.about.turn > 0).count();
    if later == 0 { String::new() } else { format!(", {later} of them after something went wrong") }
}

/// Writes the pictures of rows.
fn pictures(folder: &Path, dataset: &Dataset) -> Result<(), Trouble> {
    let place = folder.join(FOLDER);
    let cannot = |path: &Path| {
        let path = path.to_owned();
        move |source| Trouble::Write { path, source }
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

fn write(path: &Path, lines: impl Iterator<Item = String>) -> Result<(), Trouble> {
    let cannot = |source| Trouble::Write { path: path.to_owned(), source };
    let mut file = BufWriter::new(File::create(path).map_err(cannot)?);
    for line in lines {
        writeln!(file, "{line}").map_err(cannot)?;
    }
    file.flush().map_err(cannot)
}
