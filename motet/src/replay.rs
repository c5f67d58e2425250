//! Replays of a journal: the engine goes through it again, and its effects are compared with those of the
//! run.

use std::fmt::Write as _;

use motet_runtime::journal::{EffectMismatch, EngineReplay, JournalEntry, ReplayError};
use motet_runtime::{Snapshot, Time};

/// Position in a journal.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum JournalPosition {
    /// After the entry with this number.
    Entry(u64),
    /// After all entries up to this time.
    Time(Time),
}

impl JournalPosition {
    /// Is `true` if the entry comes after this position.
    fn is_before(self, seq: u64, at: Time) -> bool {
        match self {
            Self::Entry(last) => seq > last,
            Self::Time(last) => at > last,
        }
    }
}

/// Replay up to a moment or to the first difference.
#[derive(Debug, Default)]
pub struct JournalPlayer {
    last: Option<JournalPosition>,
    replay: Option<EngineReplay>,
    entries: usize,
    effects: usize,
    difference: Option<(u64, EffectMismatch)>,
    stuck: Option<(u64, ReplayError)>,
    is_past: bool,
}

impl JournalPlayer {
    /// Replay that stops after a position, or else at the end.
    #[must_use]
    pub fn until(last: Option<JournalPosition>) -> Self {
        Self { last, ..Self::default() }
    }

    /// Refuses a journal that holds no run, or one that the engine cannot go through.
    ///
    /// # Errors
    ///
    /// A clause that says why.
    pub fn require(&self) -> Result<(), String> {
        match (&self.stuck, &self.replay) {
            (Some((seq, error)), _) => Err(format!("entry {seq}: {error}")),
            (None, None) => Err("the journal holds no run".to_owned()),
            (None, Some(_)) => Ok(()),
        }
    }

    /// Is `true` if the engine did again all that it had done.
    #[must_use]
    pub fn is_identical(&self) -> bool {
        self.difference.is_none()
    }

    /// State of the engine after the last entry that was taken; `None` before the first.
    #[must_use]
    pub fn state(&self) -> Option<Snapshot> {
        self.replay.as_ref().map(|replay| replay.engine().snapshot())
    }

    /// Takes the next entry with its number.
    pub fn take(&mut self, seq: u64, entry: &JournalEntry) {
        let at = entry.happened().map(|(at, _)| at);
        let now = at.unwrap_or_else(|| self.now());
        self.is_past |= self.last.is_some_and(|last| last.is_before(seq, now));
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

    /// Result of the comparison, for people.
    #[must_use]
    pub fn verdict(&self) -> String {
        let Some((seq, EffectMismatch { index, journal, replay })) = &self.difference else {
            let entries = if self.entries == 1 { "entry" } else { "entries" };
            let effects = if self.effects == 1 { "effect" } else { "effects" };
            let (read, given) = (self.entries, self.effects);
            return format!("replayed {read} {entries}, {given} {effects}, to {}: identical", self.now());
        };
        let side = |effect: &Option<String>| effect.clone().unwrap_or_else(|| "no effect".to_owned());
        format!(
            "entry {seq} at {} differs at effect {index}:\n  journal: {}\n  replay:  {}",
            self.now(),
            side(journal),
            side(replay)
        )
    }

    /// Result of the comparison, and a state, as a JSON object on one line.
    #[must_use]
    pub fn json(&self, state: Option<&Snapshot>) -> String {
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
#[must_use]
pub fn described(state: &Snapshot) -> String {
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
