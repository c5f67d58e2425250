//! `motet replay`: replays a journal through the engine and compares the effects.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;
use motet_runtime::journal::{EffectMismatch, EngineReplay, JournalEntry, ReplayError};
use motet_runtime::{Snapshot, Time};

use crate::error::{CliError, Exit, journal_error};
use crate::flags::duration;
use crate::output::{Output, count, count_irregular, note};
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
    #[arg(long, value_name = "NUMBER|TIME")]
    until: Option<Moment>,
    /// Show the state after an entry, given by number or time
    #[arg(long, value_name = "NUMBER|TIME", conflicts_with = "until")]
    at: Option<Moment>,
    /// Print the state and the result as JSON
    #[arg(long)]
    json: bool,
}

/// Position in a journal.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Moment {
    /// After the entry with this number.
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
    /// Is `true` if the entry comes after this position.
    fn is_before(self, seq: u64, at: Time) -> bool {
        match self {
            Self::Entry(last) => seq > last,
            Self::Time(last) => at > last,
        }
    }
}

/// Runs the command.
pub(crate) fn run(args: &ReplayArgs) -> Result<Exit, CliError> {
    let mut player = Player::default();
    let last = args.until.or(args.at);
    let tail = motet_host::journal::read(&args.folder, &mut |seq, entry| player.take(seq, &entry, last));
    let tail = tail.map_err(journal_error)?;
    if let Some((seq, error)) = &player.stuck {
        return Err(CliError::Message(format!("entry {seq}: {error}")));
    }
    let Some(replay) = &player.replay else {
        return Err(CliError::Message("the journal holds no run".to_owned()));
    };
    if tail.torn_bytes > 0 && last.is_none() {
        note(&format!("the last {} bytes belong to an unfinished entry", tail.torn_bytes));
    }
    let mut out = Output::default();
    let state = last.map(|_| replay.engine().snapshot());
    if args.json {
        out.line(&player.json(state.as_ref()));
    } else {
        if let Some(state) = &state {
            out.text(&describe(state));
        }
        out.line(&player.verdict());
    }
    let exit = if player.difference.is_some() { Exit::Findings } else { Exit::Success };
    report::close(&mut out, Ok(exit))
}

/// Replay up to a moment or to the first difference.
#[derive(Debug, Default)]
struct Player {
    replay: Option<EngineReplay>,
    entries: usize,
    effects: usize,
    difference: Option<(u64, EffectMismatch)>,
    stuck: Option<(u64, ReplayError)>,
    is_past: bool,
}

impl Player {
    fn take(&mut self, seq: u64, entry: &JournalEntry, last: Option<Moment>) {
        let at = entry.happened().map(|(at, _)| at);
        let now = at.unwrap_or_else(|| self.now());
        self.is_past |= last.is_some_and(|last| last.is_before(seq, now));
        if self.is_past || self.difference.is_some() || self.stuck.is_some() {
            return;
        }
        self.entries += 1;
        if let JournalEntry::Head(head) = entry {
            match EngineReplay::new(head) {
                Ok(replay) => self.replay = Some(replay),
                Err(error) => self.stuck = Some((seq, error)),
            }
        }
        let Some(replay) = &mut self.replay else { return };
        match replay.take(entry) {
            Ok(None) => self.effects += replay.effects().len(),
            Ok(Some(difference)) => self.difference = Some((seq, difference)),
            Err(error) => self.stuck = Some((seq, error)),
        }
    }

    fn now(&self) -> Time {
        self.replay.as_ref().map_or(Time::ZERO, EngineReplay::now)
    }

    fn verdict(&self) -> String {
        let Some((seq, EffectMismatch { index, journal, replay })) = &self.difference else {
            let (entries, effects) =
                (count_irregular(self.entries, "entry", "entries"), count(self.effects, "effect"));
            return format!("replayed {entries}, {effects}, to {}: identical", self.now());
        };
        let side = |effect: &Option<String>| effect.clone().unwrap_or_else(|| "no effect".to_owned());
        format!(
            "entry {seq} at {} differs at effect {index}:\n  journal: {}\n  replay:  {}",
            self.now(),
            side(journal),
            side(replay)
        )
    }

    fn json(&self, state: Option<&Snapshot>) -> String {
        let difference = self.difference.as_ref().map(|(seq, difference)| {
            serde_json::json!({
                "entry": seq,
                "effect": difference.index,
                "journal": difference.journal,
                "replay": difference.replay,
            })
        });
        serde_json::json!({
            "entries": self.entries,
            "effects": self.effects,
            "at": self.now().nanos(),
            "difference": difference,
            "state": state,
        })
        .to_string()
    }
}

/// State of the engine, for people.
fn describe(state: &Snapshot) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(text, "`{}` at {}, revision {}", state.policy, state.at, state.revision);
    for (fact, holds) in state.state() {
        let word = match holds {
            Some(true) => "true",
            Some(false) => "false",
            None => "unknown",
        };
        let _ = writeln!(text, "  {fact}: {word}");
    }
    for motet_runtime::Reading { query, value, at } in &state.readings {
        let _ = writeln!(text, "  {query} = {value}, read at {at}");
    }
    for (name, value) in &state.bindings {
        let _ = writeln!(text, "  let {name} = {value}");
    }
    for live in &state.goals {
        let _ = writeln!(text, "  runs {} {} ({})", live.goal, live.command, live.path);
    }
    text
}
