//! The flags of `motet dataset`.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};

/// `motet dataset`
#[derive(Args, Debug)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    after_help = "Examples:\n  \
    motet dataset --out data --form trl --scenes 100\n  \
    motet dataset --out data --form inteliplan --robot hsr --room kitchen --wordings wordings.txt --seed 7\n  \
    motet dataset lint data/train.jsonl data/test.jsonl"
)]
pub(crate) struct DatasetArgs {
    /// Instead of making one
    #[command(subcommand)]
    pub(crate) command: Option<DatasetCommand>,
    /// What to make.
    #[command(flatten)]
    pub(crate) make: MakeArgs,
}

/// What else there is to do.
#[derive(Subcommand, Debug)]
pub(crate) enum DatasetCommand {
    /// Find rows whose plan cannot run on its robot, other answers to one input, duplicates, and rooms in several files, and images that are missing or not referred to
    Lint(LintArgs),
}

/// A dataset to be made.
#[derive(Args, Debug)]
pub(crate) struct MakeArgs {
    /// Folder for train.jsonl, test.jsonl and scenes.jsonl
    #[arg(long, value_name = "FOLDER", required = true)]
    pub(crate) out: Option<PathBuf>,
    /// As which trainer reads rows
    #[arg(long, value_enum, default_value_t, value_name = "FORM")]
    pub(crate) form: RowForm,
    /// Give each row a picture of what the robot's camera sees then, in the folder `images`
    #[arg(long)]
    pub(crate) images: bool,
    /// Robot: a built-in name, or a folder with a robot.toml; may be repeated
    #[arg(long, value_name = "NAME|FOLDER", default_values = ["hsr", "anymal_z1"])]
    pub(crate) robot: Vec<String>,
    /// Room to be varied: the name of a built-in scene, or a JSON file; may be repeated
    #[arg(long, value_name = "NAME|FILE", default_values = ["kitchen", "living_room", "lab"])]
    pub(crate) room: Vec<String>,
    /// File with the wordings of requests and answers, `KEY: WORDING` a line; those of Motet where not given
    #[arg(long, value_name = "FILE")]
    pub(crate) wordings: Option<PathBuf>,
    /// Scene whose objects may stand in the rooms, beside those of the room; those of Motet where not given
    #[arg(long, value_name = "FILE")]
    pub(crate) things: Option<String>,
    /// How many varied rooms
    #[arg(long, default_value_t = 30, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub(crate) scenes: u32,
    /// How many conversations for each robot in each of them
    #[arg(long, default_value_t = 10, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub(crate) cases: u32,
    /// Share of the varied rooms for test.jsonl
    #[arg(long, default_value_t = 0.2, value_name = "SHARE", value_parser = share)]
    pub(crate) test: f64,
    /// The same seed gives the same files
    #[arg(long, default_value_t = 0, value_name = "NUMBER")]
    pub(crate) seed: u64,
    /// How motions are verified.
    #[command(flatten)]
    pub(crate) motions: MotionArgs,
}

/// Whether motions are looked for.
#[derive(Args, Debug)]
pub(crate) struct MotionArgs {
    /// Leave motions to the simulated run
    #[arg(long)]
    pub(crate) no_geometry: bool,
    /// How long a motion is looked for: 1 as usual, 4 for four times as many tries
    #[arg(long, value_name = "FACTOR", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub(crate) effort: u16,
}

/// `motet dataset lint`
#[derive(Args, Debug)]
#[command(after_help = "Exit codes: 0 nothing to say against them, 1 something, 2 could not run.")]
pub(crate) struct LintArgs {
    /// Files with a row a line; scenes.jsonl beside them has their rooms
    #[arg(value_name = "FILE", required = true)]
    pub(crate) files: Vec<PathBuf>,
    /// Robot of rows that name none: a built-in name, or a folder with a robot.toml
    #[arg(long, value_name = "NAME|FOLDER")]
    pub(crate) robot: Option<String>,
    /// Room of rows that name none: the name of a built-in scene, or a JSON file
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) scene: Option<String>,
    /// How motions are verified.
    #[command(flatten)]
    pub(crate) motions: MotionArgs,
    /// How to print what is found
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub(crate) format: LintFormat,
}

/// How findings about rows are printed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, ValueEnum)]
pub(crate) enum LintFormat {
    /// A line a finding
    #[default]
    Human,
    /// A JSON object a line
    Json,
}

/// A form of rows.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, ValueEnum)]
pub(crate) enum RowForm {
    /// TRL: `messages`
    #[default]
    Trl,
    /// LLaMA-Factory: `conversations` and `system`, with a dataset_info.json
    Llamafactory,
    /// The trainer of Qwen2.5-VL: `conversations`
    QwenVl,
    /// InteLiPlan's tags and lists of actions, as `text`
    Inteliplan,
}

fn share(text: &str) -> Result<f64, String> {
    let share: f64 = text.parse().map_err(|_| "write a number such as 0.2".to_owned())?;
    if (0.0..1.0).contains(&share) { Ok(share) } else { Err("at least 0, and below 1".to_owned()) }
}
