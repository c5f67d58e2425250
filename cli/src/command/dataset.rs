//! `motet dataset`: generates and lints instruction and policy pairs for fine-tuning.

mod lint;
mod make;

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum, value_parser};
use motet_dataset::Body;
use motet_geometry::planning::SearchBudget;
use motet_project::open_robot;
use motet_syntax::Sources;

use crate::error::{CliError, Exit};
use crate::flags::{DiagnosticFormat, MotionArgs, OutputFormat};
use crate::output::Colors;
use crate::report::Report;

/// Flags of `motet dataset`.
#[derive(Args, Debug)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    subcommand_help_heading = "Subcommands",
    after_help = "Examples:\n  \
    motet dataset --out data --form trl --scenes 100\n  \
    motet dataset --out data --form inteliplan --robot hsr --room kitchen --seed 7\n  \
    motet dataset lint data/train.jsonl data/test.jsonl"
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
    /// Find rows whose plan cannot run, contradictory or duplicate rows, rooms in several files, and missing
    /// or unused images
    Lint(LintArgs),
}

/// Flags of `motet dataset`, which generates.
#[derive(Args, Debug)]
struct MakeArgs {
    /// Folder for train.jsonl, test.jsonl and scenes.jsonl
    #[arg(long, value_name = "FOLDER", required = true)]
    out: Option<PathBuf>,
    /// Trainer whose format the rows have
    #[arg(long, value_enum, default_value_t, value_name = "FORM")]
    form: RowFormat,
    /// Give each row a picture of the robot's camera, in the folder `images`
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
    /// Scene whose objects are added to the rooms [default: built in]
    #[arg(long, value_name = "FILE")]
    things: Option<String>,
    /// Number of varied rooms
    #[arg(long, default_value_t = 30, value_name = "N", value_parser = value_parser!(u32).range(1..=100_000))]
    scenes: u32,
    /// Number of conversations per robot and room
    #[arg(long, default_value_t = 10, value_name = "N", value_parser = value_parser!(u32).range(1..=10_000))]
    cases: u32,
    /// Share of the rooms for test.jsonl
    #[arg(long, default_value_t = 0.2, value_name = "SHARE", value_parser = share)]
    test: f64,
    /// Seed; the same seed gives the same files
    #[arg(long, default_value_t = 0, value_name = "NUMBER")]
    seed: u64,
    #[command(flatten)]
    motions: MotionArgs,
}

/// Flags of `motet dataset lint`.
#[derive(Args, Debug)]
#[command(after_help = "Exit codes: 0 no findings, 1 findings, 2 the command could not run.")]
struct LintArgs {
    /// Files with one row per line; their rooms are in scenes.jsonl beside them
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
    /// Format of the findings
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    format: OutputFormat,
}

/// Format of rows.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, ValueEnum)]
enum RowFormat {
    #[default]
    Trl,
    /// LLaMA-Factory: `conversations` and `system`, with a dataset_info.json
    Llamafactory,
    /// Trainer of Qwen2.5-VL: `conversations`
    QwenVl,
    /// InteLiPlan: tags and lists of actions, as `text`
    Inteliplan,
}

fn share(text: &str) -> Result<f64, String> {
    let share: f64 = text.parse().map_err(|_| "write a number such as 0.2".to_owned())?;
    if (0.0..1.0).contains(&share) { Ok(share) } else { Err("write a number from 0 to below 1".to_owned()) }
}

/// Runs the command.
///
/// # Errors
///
/// A file cannot be read or written, or has errors.
pub(crate) fn run(args: &DatasetArgs, colors: Colors) -> Result<Exit, CliError> {
    let mut report = Report::new(DiagnosticFormat::Human, colors);
    report.hold();
    let result = match &args.command {
        Some(DatasetCommand::Lint(args)) => lint::lint(args, &mut report),
        None => make::make(&args.make, &mut report),
    };
    report.close(result)
}

fn body(name: &str, report: &mut Report) -> Result<Body, CliError> {
    let (robot, urdf) = open_robot(name, &mut Sources::default(), report)?;
    Ok(Body { robot, urdf })
}

fn effort(args: &MotionArgs) -> Option<SearchBudget> {
    (!args.no_geometry).then(|| SearchBudget::default().times(args.effort.into()))
}
