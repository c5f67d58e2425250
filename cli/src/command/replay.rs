//! `motet replay`: steps the engine through a journal again.

use std::fmt::Write as _;

use motet_runtime::journal::{EffectMismatch, EngineReplay, JournalEntry, ReplayError};
use motet_runtime::{Snapshot, Time};

use super::run::journal_trouble;
use crate::args::{Moment, ReplayArgs};
use crate::exit::{Exit, Trouble};
use crate::out::{Colors, Out, count, note};
use crate::report;

/// Runs the command.
///
/// # Errors
///
/// The journal cannot be read, or is damaged.
pub(crate) fn run(args: &ReplayArgs, _colors: Colors) -> Result<Exit, Trouble> {
    let mut player = Player::default();
    let last = args.until.or(args.at);
    let tail = motet_host::journal::read(&args.folder, &mut |seq, entry| player.take(seq, &entry, last));
    let tail = tail.map_err(journal_trouble)?;
    if let Some((seq, error)) = &player.stuck {
        return Err(Trouble::Other(format!("entry {seq}: {error}")));
    }
    let Some(replay) = &player.replay else {
        return Err(Trouble::Other("the journal holds no run".to_owned()));
    };
    if tail.torn_bytes > 0 && last.is_none() {
        note(&format!("the last {} bytes are of an entry that was not written to its end", tail.torn_bytes));
    }
    let mut out = Out::default();
    let state = last.map(|_| replay.engine().snapshot());
    if args.json {
        out.line(&player.json(state.as_ref()));
    } else {
        if let Some(state) = &state {
            out.text(&told(state));
        }
        out.line(&player.verdict());
    }
    let exit = if player.difference.is_some() { Exit::Findings } else { Exit::Clean };
    report::close(&mut out, Ok(exit))
}

/// Goes through the entries, up to a moment or the first difference.
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
            let (entries, effects) = (many(self.entries, "entry", "entries"), count(self.effects, "effect"));
            return format!("replayed {entries}, {effects}, to {}: the same to the byte", self.now());
        };
        let side = |effect: &Option<String>| effect.clone().unwrap_or_else(|| "nothing".to_owned());
        format!(
            "entry {seq}, at {}, differs at effect {index}:\n  journal: {}\n  replay:  {}",
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

/// The state for people.
fn told(state: &Snapshot) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
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

fn many(number: usize, one: &str, several: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { several })
}
