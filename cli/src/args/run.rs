//! The flags of `motet run`.

use std::path::PathBuf;
use std::str::FromStr;

use clap::{Args, ValueEnum};
use motet_planner::runtime_check::CheckMode;

use super::input::WorldArgs;

/// `motet run`
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet run fetch_mug.motet --robot hsr --scene kitchen --speed max\n  \
    motet run fetch_mug.motet --scene kitchen --faults slips.json --answers person.json --format json\n  \
    motet run fetch_mug.motet --scene kitchen --record run/    write a journal, for `motet replay run/`\n  \
    motet run --resume run/                                    go on after a crash")]
pub(crate) struct RunArgs {
    /// The policy: a file, or `-` for standard input
    #[arg(value_name = "FILE", required_unless_present = "resume")]
    pub(crate) file: Option<PathBuf>,
    /// Which policy of the file; needed where it has several
    #[arg(long, value_name = "NAME")]
    pub(crate) policy: Option<String>,
    /// In which world.
    #[command(flatten)]
    pub(crate) world: WorldArgs,
    /// How the world is simulated.
    #[command(flatten)]
    pub(crate) simulated: SimulatedArgs,
    /// What the simulated person answers: a JSON file
    #[arg(long, value_name = "FILE")]
    pub(crate) answers: Option<PathBuf>,
    /// Write a journal of the run into this folder, which must be empty or not exist
    #[arg(long, value_name = "FOLDER")]
    pub(crate) record: Option<PathBuf>,
    /// Go on with the run whose journal is in this folder, and write on
    #[arg(
        long,
        value_name = "FOLDER",
        conflicts_with_all = ["file", "policy", "record", "seed", "faults", "answers", "robot", "scene", "state", "domain"]
    )]
    pub(crate) resume: Option<PathBuf>,
    /// How to show the run
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub(crate) format: RunFormat,
}

/// How the world of a run is simulated.
#[derive(Args, Debug)]
pub(crate) struct SimulatedArgs {
    /// How much faster than real time: a factor, or `max` for as fast as it can be computed
    #[arg(long, default_value = "1", value_name = "max|FACTOR", allow_negative_numbers = true)]
    pub(crate) speed: Speed,
    /// Seed of everything random in the simulated world
    #[arg(long, default_value_t = 0, value_name = "NUMBER", value_parser = seed, allow_negative_numbers = true)]
    pub(crate) seed: u64,
    /// Faults to inject: a JSON file
    #[arg(long, value_name = "FILE")]
    pub(crate) faults: Option<PathBuf>,
}

/// Reads a seed.
///
/// # Errors
///
/// What to write, for clap to print.
pub(crate) fn seed(text: &str) -> Result<u64, String> {
    text.trim().parse().map_err(|_| format!("write a whole number from 0 to {}, such as 7", u64::MAX))
}

/// How a run is shown.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, ValueEnum)]
pub(crate) enum RunFormat {
    /// The plan as a tree, with the state of every step
    #[default]
    Human,
    /// One JSON object a line for everything that happens
    Json,
}

/// How fast simulated time goes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Speed {
    /// As fast as it can be computed.
    Max,
    /// So many times real time.
    Times(f64),
}

impl Speed {
    /// When motions are searched for that were left to the run: where time is virtual a run is the same each time.
    pub(crate) const fn verifies(self) -> CheckMode {
        match self {
            Self::Max => CheckMode::AtOnce,
            Self::Times(_) => CheckMode::Beside,
        }
    }
}

impl FromStr for Speed {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "max" {
            return Ok(Self::Max);
        }
        let factor: Option<f64> = text.strip_suffix('x').unwrap_or(text).parse().ok();
        match factor {
            Some(factor) if factor.is_finite() && factor > 0.0 => Ok(Self::Times(factor)),
            _ => Err("write `max`, or a factor above 0 such as 10".to_owned()),
        }
    }
}
