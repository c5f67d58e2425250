//! Reading lines: what holds, where a torn tail begins, and where a journal is damaged.

use super::entry::JournalEntry;
use super::line::{self, LineChain, LineError};
use super::{MAX_LINE_BYTES, VERSION};
use crate::effect::{Command, Effect};
use crate::event::{DriverEvent, Event};
use crate::ids::GoalId;
use crate::query::Query;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;
use thiserror::Error;

/// Position of a segment in its journal.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum SegmentPosition {
    /// Others follow: it has to be whole.
    Middle,
    /// The last one: what was being written when the process ended may be torn.
    Last,
}

/// State of the end of a segment.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum SegmentEnd {
    /// With a whole line.
    Whole,
    /// With a line that was not written to its end.
    Torn {
        /// Number of valid bytes; the rest is to be cut off before appending.
        good_bytes: u64,
        /// Number of bytes after them.
        torn_bytes: u64,
    },
}

/// A journal that cannot be trusted, with the place of the first line that is wrong.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
pub struct JournalDamage {
    /// The segment's name.
    pub segment: String,
    /// The line in the segment, from 1.
    pub line: u64,
    /// Offset of the line in bytes from the beginning of the segment.
    pub offset: u64,
    /// Kind of a validation error.
    pub wrong: DamageKind,
}

/// Kind of damage to a journal.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
pub enum DamageKind {
    /// The line in itself.
    #[error("{0}")]
    Line(LineError),
    /// A segment that others follow ends in the middle of a line.
    #[error("it is not written to its end, though another segment follows")]
    Unfinished,
    /// It is too long.
    #[error("it is longer than {} MiB", MAX_LINE_BYTES >> 20)]
    TooLong,
    /// A line before it is missing, or it stands there twice.
    #[error("it has number {found}, number {expected} was to come")]
    Order {
        found: u64,
        /// The number that was to come.
        expected: u64,
    },
    /// The line before it was changed.
    #[error("it does not follow from the line before: that one was changed, or belongs to another journal")]
    Chain,
    /// The first line is no head, or another one is.
    #[error("{0}")]
    Head(&'static str),
    /// A version that this program does not read.
    #[error("the journal has version {found}; this program reads version {VERSION}")]
    Version { found: u32 },
}

impl fmt::Display for JournalDamage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { segment, line, offset, wrong } = self;
        write!(f, "the journal is damaged in {segment}, line {line} (byte {offset}): {wrong}")
    }
}

/// Reads the segments of a journal, in order.
#[derive(Clone, Debug, Default)]
pub struct JournalReader {
    chain: LineChain,
}

impl JournalReader {
    /// Reads a segment and gives every entry with its number to `take`. Tells how the segment ended.
    ///
    /// A last line without a line feed is torn. So is one with it whose checksum fails and that holds a NUL
    /// byte: a block that the file system had made room for and never written. Any other line that does not
    /// hold is damage.
    ///
    /// # Errors
    ///
    /// The first line that is wrong. Entries before it were given.
    pub fn segment(
        &mut self,
        name: &str,
        bytes: &[u8],
        place: SegmentPosition,
        take: &mut dyn FnMut(u64, JournalEntry),
    ) -> Result<SegmentEnd, JournalDamage> {
        let (mut rest, mut offset, mut number) = (bytes, 0_usize, 0_u64);
        while !rest.is_empty() {
            number += 1;
            let at = |wrong| JournalDamage {
                segment: name.to_owned(),
                line: number,
                offset: offset as u64,
                wrong,
            };
            let torn = SegmentEnd::Torn { good_bytes: offset as u64, torn_bytes: rest.len() as u64 };
            let Some(end) = rest.iter().position(|byte| *byte == b'\n') else {
                return if place == SegmentPosition::Last {
                    Ok(torn)
                } else {
                    Err(at(DamageKind::Unfinished))
                };
            };
            let (line, after) = rest.split_at(end);
            let after = after.split_first().map_or(&[][..], |(_, after)| after);
            match self.line(line) {
                Ok((seq, entry)) => take(seq, entry),
                Err(DamageKind::Line(LineError::Checksum { .. } | LineError::NoChecksum))
                    if place == SegmentPosition::Last && after.is_empty() && line.contains(&0) =>
                {
                    return Ok(torn);
                }
                Err(wrong) => return Err(at(wrong)),
            }
            offset += end + 1;
            rest = after;
        }
        Ok(SegmentEnd::Whole)
    }

    /// The end of what was read, to append to.
    #[must_use]
    pub fn into_chain(self) -> LineChain {
        self.chain
    }

    fn line(&mut self, line: &[u8]) -> Result<(u64, JournalEntry), DamageKind> {
        if line.len() > MAX_LINE_BYTES {
            return Err(DamageKind::TooLong);
        }
        let (seq, prev, entry) = line::decode(line).map_err(DamageKind::Line)?;
        if seq != self.chain.next_seq() {
            return Err(DamageKind::Order { found: seq, expected: self.chain.next_seq() });
        }
        if prev != self.chain.prev() {
            return Err(DamageKind::Chain);
        }
        match (&entry, seq) {
            (JournalEntry::Head(head), 0) => {
                let found = if head.motet_journal == VERSION { head.wire } else { head.motet_journal };
                if found != VERSION {
                    return Err(DamageKind::Version { found });
                }
            }
            (JournalEntry::Head(_), _) => {
                return Err(DamageKind::Head("a journal has one head, and here is another"));
            }
            (_, 0) => return Err(DamageKind::Head("a journal begins with its head")),
            (
                JournalEntry::Step(_)
                | JournalEntry::Swap(_)
                | JournalEntry::GaveUp(_)
                | JournalEntry::Resumed(_),
                _,
            ) => {}
        }
        self.chain.advance(line);
        Ok((seq, entry))
    }
}

/// Unanswered commands between the engine and its driver.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct OpenGoals {
    /// Goals that have not ended, by number.
    pub goals: BTreeMap<GoalId, OpenGoal>,
    /// Watched queries in order.
    pub watches: Vec<Query>,
    /// Observations that were not answered, in order.
    pub observations: Vec<Query>,
    /// Commands of the last entry. Whether they reached the driver, the journal cannot know.
    pub uncertain: Vec<Effect>,
    /// True if the run is over.
    pub is_over: bool,
}

/// A goal that has not ended.
#[derive(Clone, PartialEq, Debug)]
pub struct OpenGoal {
    pub command: Arc<Command>,
    /// True if it was given new arguments since.
    pub updated: bool,
    /// Last command about its progress: hold, proceed, cancel or safe stop.
    pub told: Option<Effect>,
}

impl OpenGoals {
    /// Takes an entry in.
    pub fn take(&mut self, entry: &JournalEntry) {
        match entry {
            JournalEntry::Head(_) | JournalEntry::Resumed(_) => {}
            JournalEntry::Step(step) | JournalEntry::GaveUp(step) => {
                if let Some(Event::Driver(event)) = &step.event {
                    self.event(event);
                }
                self.uncertain.clear();
                step.effects.iter().for_each(|effect| self.effect(effect));
            }
            JournalEntry::Swap(swap) => {
                self.uncertain.clear();
                swap.effects.iter().for_each(|effect| self.effect(effect));
            }
        }
    }

    fn event(&mut self, event: &DriverEvent) {
        match event {
            DriverEvent::Refused { goal, .. }
            | DriverEvent::Ended { goal, .. }
            | DriverEvent::Stopped { goal } => {
                self.goals.remove(goal);
            }
            DriverEvent::NotHeld { goal } => self.with(*goal, |open| open.told = None),
            DriverEvent::Observed { query, .. } => self.observations.retain(|asked| asked != query),
            DriverEvent::Acknowledged { .. } | DriverEvent::Feedback { .. } => {}
            DriverEvent::Lost { .. } | DriverEvent::DriverLost | DriverEvent::DriverGone => {}
        }
    }

    fn effect(&mut self, effect: &Effect) {
        match effect {
            Effect::Start { goal, command, .. } => {
                let open = OpenGoal { command: Arc::clone(command), updated: false, told: None };
                self.goals.insert(*goal, open);
            }
            Effect::Update { goal, command, .. } => {
                self.with(*goal, |open| (open.command, open.updated) = (Arc::clone(command), true));
            }
            Effect::Cancel { goal }
            | Effect::Hold { goal }
            | Effect::Proceed { goal }
            | Effect::SafeStop { goal } => self.with(*goal, |open| open.told = Some(effect.clone())),
            Effect::Observe { query } => self.observations.push(Query::clone(query)),
            Effect::Watch { query } => {
                if !self.watches.contains(query) {
                    self.watches.push(Query::clone(query));
                }
            }
            Effect::Unwatch { query } => self.watches.retain(|watched| *watched != **query),
            Effect::Finished(_) => self.is_over = true,
            Effect::Verify { .. } | Effect::Report(_) => return,
        }
        if !self.is_over {
            self.uncertain.push(effect.clone());
        }
    }

    fn with(&mut self, goal: GoalId, change: impl FnOnce(&mut OpenGoal)) {
        if let Some(open) = self.goals.get_mut(&goal) {
            change(open);
        }
    }
}
