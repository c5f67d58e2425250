//! Flags that several commands share: the documents, the world they are checked against, the form of what is said.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::duration::duration;

/// The documents.
#[derive(Args, Debug)]
pub(crate) struct DocumentArgs {
    /// Files, folders (every .motet and .json file below), .jsonl files with a policy a line, or `-` for standard input
    #[arg(value_name = "PATH", required = true)]
    pub(crate) paths: Vec<PathBuf>,
}

/// The robot, the room and what else is known.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct KnownArgs {
    /// Robot: a built-in name (`motet robots`), or a folder with a robot.toml. Where not given, the policy's own
    /// `for NAME` decides
    #[arg(long, value_name = "NAME|FOLDER")]
    pub(crate) robot: Option<String>,
    /// Scene: a built-in name, or a JSON file
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) scene: Option<String>,
    /// What is known at the start: a JSON object such as '{"holding(mug_1)": true, "free(hand)": false}', or a file with one
    #[arg(long, value_name = "FACTS|FILE")]
    pub(crate) state: Option<PathBuf>,
    /// File of further declarations; may be repeated
    #[arg(long, value_name = "FILE")]
    pub(crate) domain: Vec<PathBuf>,
}

/// What policies are checked against.
#[derive(Args, Debug, Default)]
pub(crate) struct WorldArgs {
    /// In which world.
    #[command(flatten)]
    pub(crate) known: KnownArgs,
    /// The longest that a policy may take, such as 90s or 10min
    #[arg(long, value_name = "TIME", value_parser = duration)]
    pub(crate) max_duration: Option<f64>,
    /// Leave every motion to the run: none is looked for in the scene
    #[arg(long)]
    pub(crate) no_geometry: bool,
    /// How long a motion is looked for before it is left to the run: 1 as usual, 4 for four times as many tries
    #[arg(long, value_name = "FACTOR", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub(crate) effort: u16,
}

impl From<KnownArgs> for WorldArgs {
    /// For what asks for no motions.
    fn from(known: KnownArgs) -> Self {
        Self { known, max_duration: None, no_geometry: true, effort: 1 }
    }
}

/// The form of diagnostics.
#[derive(Args, Clone, Copy, Debug)]
pub(crate) struct FormatArgs {
    /// How to print diagnostics
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub(crate) format: Format,
}

/// How diagnostics are printed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, ValueEnum)]
pub(crate) enum Format {
    /// With the source and colours, for people
    #[default]
    Human,
    /// One JSON object a line (`motet schema diagnostic`)
    Json,
    /// SARIF 2.1.0, for code scanners
    Sarif,
    /// Workflow commands of GitHub Actions
    Github,
    /// Short plain sentences for a language model's next prompt, the most useful first
    Llm,
}
