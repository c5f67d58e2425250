//! `motet dataset`: generates and lints instruction and policy pairs for fine-tuning.

mod from_journal;
mod inputs;
mod lint;

use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand, value_parser};
use motet::batch;
use motet::line_file::LineFile;
use motet_dataset::format;
use motet_dataset::generate::{self, Dataset, HeldOut, Order, SceneRows};
use motet_dataset::lint::family;
use motet_dataset::picture::{FOLDER, Pictures};
use motet_dataset::{Row, lesson, scenery, wordings};
use motet_project::files::read_small;
use motet_project::read_scene;
use motet_robots::scene;
use motet_syntax::Sources;
use serde_json::{Value, json};
use smol_str::SmolStr;

use self::from_journal::FromJournalArgs;
use self::inputs::{RowFormat, body, effort, write};
use self::lint::LintArgs;
use crate::error::{CliError, Exit};
use crate::flags::{DiagnosticFormat, JobArgs, MotionArgs};
use crate::output::{Colors, count, note};
use crate::report::{Progress, Report};

/// Flags of `motet dataset`.
#[derive(Args, Debug)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    subcommand_help_heading = "Subcommands",
    after_help = "Examples:\n  \
    motet dataset --out data --form trl --scenes 100\n  \
    motet dataset --out data/0 --form trl --scenes 1000 --shard 0/4\n  \
    motet dataset --out data --form inteliplan --robot hsr --room kitchen --seed 7\n  \
    motet dataset lint data/train.jsonl data/test.jsonl\n  \
    motet dataset from-journal talk/ --robot hsr --scene kitchen --out own.jsonl"
)]
pub(crate) struct DatasetArgs {
    #[command(subcommand)]
    command: Option<DatasetCommand>,
    #[command(flatten)]
    make: MakeArgs,
}

/// Subcommands of `motet dataset`.
#[derive(Subcommand, Debug)]
enum DatasetCommand {
    /// Find rows whose plan cannot run, contradictory or duplicate rows, scenes in several files, and missing
    /// or unused images
    Lint(LintArgs),
    /// Make rows from recorded conversations: requests that were done, with their plans
    FromJournal(FromJournalArgs),
}

/// Flags of `motet dataset`, which generates.
#[derive(Args, Debug)]
struct MakeArgs {
    /// Folder for train.jsonl, test.jsonl and scenes.jsonl
    #[arg(long, value_name = "FOLDER", required = true)]
    out: Option<PathBuf>,
    /// Row format, by trainer
    #[arg(long, value_enum, default_value_t, value_name = "FORM")]
    form: RowFormat,
    /// Give each row an image of the robot's camera, in the folder `images`
    #[arg(long)]
    images: bool,
    /// Robot: a built-in name, or a folder with a robot.toml; repeatable
    #[arg(long, value_name = "NAME|FOLDER", default_values = ["hsr", "anymal_z1"])]
    robot: Vec<String>,
    /// Scene to vary: a built-in name, or a JSON file; repeatable
    #[arg(long, value_name = "NAME|FILE", default_values = ["kitchen", "living_room", "lab"])]
    room: Vec<String>,
    /// File with the wordings of requests and answers, one `KEY: WORDING` per line [default: built in]
    #[arg(long, value_name = "FILE")]
    wordings: Option<PathBuf>,
    /// File with lessons: requests with the steps that they ask for [default: built in]
    #[arg(long, value_name = "FILE")]
    lessons: Option<PathBuf>,
    /// Scene whose objects are added to the varied scenes [default: built in]
    #[arg(long, value_name = "FILE")]
    things: Option<String>,
    /// Number of varied scenes
    #[arg(long, default_value_t = 30, value_name = "N", value_parser = value_parser!(u32).range(1..=100_000))]
    scenes: u32,
    /// Number of conversations per robot and varied scene
    #[arg(long, default_value_t = 10, value_name = "N", value_parser = value_parser!(u32).range(1..=10_000))]
    cases: u32,
    /// Share of the varied scenes for test.jsonl
    #[arg(long, default_value_t = 0.2, value_name = "SHARE", value_parser = share)]
    test: f64,
    /// Seed; the same seed gives the same files
    #[arg(long, default_value_t = 0, value_name = "NUMBER")]
    seed: u64,
    /// Go on with a folder that an earlier call with the same flags has begun
    #[arg(long)]
    r#continue: bool,
    #[command(flatten)]
    jobs: JobArgs,
    #[command(flatten)]
    motions: MotionArgs,
}

fn share(text: &str) -> Result<f64, String> {
    let share: f64 = text.parse().map_err(|_| "write a number such as 0.2".to_owned())?;
    if (0.0..1.0).contains(&share) { Ok(share) } else { Err("write a number from 0 to below 1".to_owned()) }
}

/// Runs the command.
pub(crate) fn run(args: &DatasetArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run_held(DiagnosticFormat::Human, colors, |report| match &args.command {
        Some(DatasetCommand::Lint(args)) => lint::lint(args, report),
        Some(DatasetCommand::FromJournal(args)) => from_journal::from_journal(args, report),
        None => make(&args.make, report),
    })
}

/// Generates a dataset.
fn make(args: &MakeArgs, report: &mut Report) -> Result<Exit, CliError> {
    let Some(folder) = &args.out else {
        return Err(CliError::Message("give a folder with --out FOLDER".to_owned()));
    };
    if args.images && args.form == RowFormat::Inteliplan {
        return Err(CliError::Message("rows in the format `inteliplan` are texts without images".to_owned()));
    }
    let order = order(args, report)?;
    fs::create_dir_all(folder).map_err(|source| CliError::Write { path: folder.clone(), source })?;
    let kept = KeptScenes::open(folder, &order, args)?;
    let parts = folder.join(PARTS);
    let dataset = generate::gather(&order, made(&order, args.jobs, kept)?);
    for (name, rows) in [("train", &dataset.train), ("test", &dataset.test)] {
        let lines = rows.iter().map(|row| format::write(row, order.form));
        write(&folder.join(format!("{name}.jsonl")), lines)?;
        let scenes: std::collections::BTreeSet<&str> =
            rows.iter().map(|row| family(&row.about.scene)).collect();
        report.out.line(&format!(
            "{name}.jsonl: {} in {}{}",
            count(rows.len(), "row"),
            count(scenes.len(), "scene"),
            kinds(rows)
        ));
    }
    write(&folder.join("scenes.jsonl"), scenes(&dataset))?;
    if order.form == format::RowFormat::LlamaFactory {
        let info = format::dataset_info(&["train", "test"], order.pictures);
        write(&folder.join("dataset_info.json"), [info].into_iter())?;
    }
    if order.pictures == Pictures::EachRow {
        pictures(folder, &dataset)?;
        report.out.line(&format!("{FOLDER}: {}", count(dataset.pictures.len(), "picture")));
    }
    for (why, dropped) in &dataset.dropped {
        note(&format!("left out {dropped}: {why}"));
    }
    // The dataset is whole: nothing is left to continue.
    fs::remove_file(&parts).map_err(|source| CliError::Write { path: parts, source })?;
    if dataset.train.is_empty() && args.jobs.shard().is_whole() {
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
    let lessons = match &args.lessons {
        Some(path) => {
            let bytes = read_small(path)?;
            lesson::read(&String::from_utf8_lossy(&bytes))
                .map_err(|wrong| CliError::Message(format!("`{}`, {wrong}", path.display())))?
        }
        None => lesson::read(lesson::OWN).map_err(|wrong| CliError::Message(wrong.to_string()))?,
    };
    let things = match &args.things {
        Some(name) => read_scene(name, &mut Sources::default(), report)?,
        None => scenery::things(),
    };
    let mut bases = Vec::new();
    for name in &args.room {
        let scene = read_scene(name, &mut Sources::default(), report)?;
        let stem =
            Path::new(name).file_stem().map_or(name.clone(), |stem| stem.to_string_lossy().into_owned());
        bases.push((SmolStr::from(stem.replace('.', "_")), scene));
    }
    let bodies = args.robot.iter().map(|name| body(name, report)).collect::<Result<_, _>>()?;
    Ok(Order {
        seed: args.seed,
        bodies,
        bases,
        things,
        wordings,
        held_out: HeldOut::own(),
        lessons,
        scenes: args.scenes as usize,
        cases: args.cases as usize,
        test: args.test,
        effort: effort(&args.motions),
        form: args.form.into(),
        pictures: if args.images { Pictures::EachRow } else { Pictures::None },
    })
}

/// File of a folder with the rows of the scenes that are made, as long as some are missing.
const PARTS: &str = "unfinished.jsonl";

/// Rows of scenes that are made, kept in a file, so that a later call continues.
struct KeptScenes {
    path: PathBuf,
    file: LineFile,
    /// Rows of the first scenes of the shard.
    done: Vec<SceneRows>,
}

impl KeptScenes {
    /// Opens the file of a folder. Its first line is a checksum of the order and the shard.
    fn open(folder: &Path, order: &Order, args: &MakeArgs) -> Result<Self, CliError> {
        let path = folder.join(PARTS);
        let cannot = |source| CliError::Write { path: path.clone(), source };
        let other = || CliError::Advised {
            problem: format!("`{}` holds a dataset that is not finished", folder.display()),
            help: "finish it with --continue and the flags with which it was begun, or give another folder"
                .to_owned(),
        };
        if path.exists() && !args.r#continue {
            return Err(other());
        }
        let shard = args.jobs.shard();
        let head = format!("{:08x}", crc32fast::hash(format!("{shard:?} {order:?}").as_bytes()));
        let (file, lines) = LineFile::headed(&path, &head).map_err(cannot)?.ok_or_else(other)?;
        let done = lines.iter().map(|line| serde_json::from_slice(line)).collect::<Result<_, _>>();
        Ok(Self { file, done: done.map_err(|_| other())?, path })
    }

    fn add(&mut self, rows: &SceneRows) -> Result<(), CliError> {
        let line = serde_json::to_string(rows).map_err(std::io::Error::from);
        let added = line.and_then(|line| self.file.add(&line));
        added.map_err(|source| CliError::Write { path: self.path.clone(), source })
    }
}

/// Rows of the scenes of a shard with their numbers, in order.
fn made(order: &Order, jobs: JobArgs, mut kept: KeptScenes) -> Result<Vec<(usize, SceneRows)>, CliError> {
    let shard = jobs.shard();
    let numbers: Vec<usize> = (0..order.scenes).filter(|number| shard.has(*number)).collect();
    let mut parts: Vec<_> = numbers.iter().copied().zip(std::mem::take(&mut kept.done)).collect();
    let numbers: Vec<usize> = numbers.into_iter().skip(parts.len()).collect();
    let progress = Progress::of_items(numbers.len(), "generating");
    let part = |number| (number, generate::part(order, number));
    let ended = batch::in_order(jobs.jobs(), 1, numbers, part, |part| {
        progress.advance(1);
        let added = kept.add(&part.1);
        parts.push(part);
        match added {
            Err(why) => ControlFlow::Break(why),
            Ok(()) => ControlFlow::Continue(()),
        }
    });
    match ended {
        ControlFlow::Break(why) => Err(why),
        ControlFlow::Continue(()) => Ok(parts),
    }
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
    dataset.scenes.iter().map(|(name, scene)| {
        let scene: Value = serde_json::from_str(&scene::write(scene)).unwrap_or_default();
        let mut line = json!({"name": name.as_str(), "scene": scene});
        if let (Value::Object(line), Some(posture)) = (&mut line, dataset.postures.get(name)) {
            line.insert("robot".to_owned(), json!(posture));
        }
        line.to_string()
    })
}
