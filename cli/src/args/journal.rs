//! The flags of commands that read a journal.

use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;
use motet_runtime::Time;

use super::duration::duration;

/// `motet replay`
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet replay run/                 does the engine do the same again?\n  \
    motet replay run/ --until 40      up to entry 40, and the state there\n  \
    motet replay run/ --at 12.5s      the state 12.5 s into the run")]
pub(crate) struct ReplayArgs {
    /// The folder of the journal
    #[arg(value_name = "FOLDER")]
    pub(crate) folder: PathBuf,
    /// Stop after an entry, by its number or by time, and show the state there
    #[arg(long, value_name = "NUMBER|TIME")]
    pub(crate) until: Option<Moment>,
    /// Show the engine's state after an entry, by its number or by time, and stop there
    #[arg(long, value_name = "NUMBER|TIME", conflicts_with = "until")]
    pub(crate) at: Option<Moment>,
    /// Print the state, or what was found, as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// A moment of a run.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Moment {
    /// After the entry of this number.
    Entry(u64),
    /// After all entries up to this time.
    Time(Time),
}

impl FromStr for Moment {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if let Ok(number) = text.parse() {
            return Ok(Self::Entry(number));
        }
        let wrong = || "write the number of an entry, or a time such as 12.5s".to_owned();
        duration(text).map(|secs| Self::Time(Time::from_secs(secs))).map_err(|_| wrong())
    }
}

impl Moment {
    /// Whether an entry comes after it.
    pub(crate) fn is_before(self, seq: u64, at: Time) -> bool {
        match self {
            Self::Entry(last) => seq > last,
            Self::Time(last) => at > last,
        }
    }
}
