//! `motet replay`: replays a journal through the engine and compares the effects.

use std::path::PathBuf;

use clap::Args;
use motet::replay::{JournalPlayer, JournalPosition, described};
use motet_runtime::Time;

use crate::error::{CliError, Exit, journal_error};
use crate::flags::duration;
use crate::output::{Output, note};
use crate::report;

/// Flags of `motet replay`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet replay run/                 compare the whole run\n  \
    motet replay run/ --until 40      compare up to entry 40, and show the state there\n  \
    motet replay run/ --at 12.5s      show the state 12.5 s into the run")]
pub(crate) struct ReplayArgs {
    /// Folder of the journal
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
    /// Stop after an entry, given by number or time, and show the state there
    #[arg(long, value_name = "NUMBER|TIME", value_parser = moment)]
    until: Option<JournalPosition>,
    /// Show the state after an entry, given by number or time
    #[arg(long, value_name = "NUMBER|TIME", value_parser = moment, conflicts_with = "until")]
    at: Option<JournalPosition>,
    /// Print the state and the result as JSON
    #[arg(long)]
    json: bool,
}

/// Reads a position in a journal.
fn moment(text: &str) -> Result<JournalPosition, String> {
    if let Ok(number) = text.parse() {
        return Ok(JournalPosition::Entry(number));
    }
    let wrong = || "write the number of an entry, or a time such as 12.5s".to_owned();
    duration(text).map(|secs| JournalPosition::Time(Time::from_secs(secs))).map_err(|_| wrong())
}

/// Runs the command.
pub(crate) fn run(args: &ReplayArgs) -> Result<Exit, CliError> {
    let last = args.until.or(args.at);
    let mut player = JournalPlayer::until(last);
    let tail = motet_host::journal::read(&args.folder, &mut |seq, entry| player.take(seq, &entry));
    let tail = tail.map_err(journal_error)?;
    player.require().map_err(CliError::Message)?;
    if tail.torn_bytes > 0 && last.is_none() {
        note(&format!("the last {} bytes belong to an unfinished entry", tail.torn_bytes));
    }
    let mut out = Output::default();
    let state = last.and_then(|_| player.state());
    if args.json {
        out.json_line(&player.json(state.as_ref()));
    } else {
        if let Some(state) = &state {
            out.text(&described(state));
        }
        out.line(&player.verdict());
    }
    let exit = if player.is_identical() { Exit::Success } else { Exit::Findings };
    report::close(&mut out, Ok(exit))
}
