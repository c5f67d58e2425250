//! The end of a chain of lines, to which the next one is added.

use super::entry::{JournalEntry, JournalHead, StepEntry, SwapEntry};
use super::line::{self, Body};
use crate::effect::Effect;
use crate::event::Event;
use crate::time::Time;
use motet_graph::Graph;

/// Numbers lines and links each to the one before.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct LineChain {
    seq: u64,
    prev: String,
}

impl Default for LineChain {
    /// Before the first line.
    fn default() -> Self {
        Self { seq: 0, prev: line::hash(b"") }
    }
}

impl LineChain {
    /// The number that the next line gets.
    #[must_use]
    pub const fn next_seq(&self) -> u64 {
        self.seq
    }

    /// The hash of the last line.
    pub(super) fn prev(&self) -> &str {
        &self.prev
    }

    /// A line was added.
    pub(super) fn advance(&mut self, line: &[u8]) {
        self.seq += 1;
        self.prev = line::hash(line);
    }

    /// The line of an entry, with its line feed.
    pub fn line(&mut self, entry: JournalEntry) -> String {
        let body = Body { seq: self.seq, prev: std::mem::take(&mut self.prev), entry };
        let mut line = line::encode(&body);
        self.advance(line.as_bytes());
        line.push('\n');
        line
    }

    /// The first line.
    pub fn head(&mut self, head: JournalHead) -> String {
        self.line(JournalEntry::Head(Box::new(head)))
    }

    /// The line of an event with its effects.
    pub fn step(&mut self, at: Time, event: &Event, effects: &[Effect]) -> String {
        self.line(JournalEntry::Step(StepEntry { at, event: Some(event.clone()), effects: effects.to_vec() }))
    }

    /// The line of giving up.
    pub fn gave_up(&mut self, at: Time, effects: &[Effect]) -> String {
        self.line(JournalEntry::GaveUp(StepEntry { at, event: None, effects: effects.to_vec() }))
    }

    /// The line of a new policy.
    pub fn swap(&mut self, at: Time, graph: &Graph, effects: &[Effect]) -> String {
        let graph = motet_graph::encode::document(graph);
        self.line(JournalEntry::Swap(Box::new(SwapEntry { at, graph, effects: effects.to_vec() })))
    }
}
