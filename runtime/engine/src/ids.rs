//! Ids that the engine hands out in a run, of goals and of checks of motions, and the table of live goals.

use motet_graph::NodeId;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Bits of a [`GoalId`] that hold its slot in the table of goals; the running number of the start stands
/// above them.
pub(crate) const SLOT_BITS: u32 = 24;

/// Id of one start of a primitive. The engine chooses it and never uses it twice in a run, not even for a
/// retry.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct GoalId(pub(crate) u64);

impl GoalId {
    /// Id of the first start of a run; no engine hands out a lower one.
    pub const FIRST: Self = Self(1 << SLOT_BITS);

    /// The id as a number, for a protocol or a log.
    #[must_use]
    pub const fn number(self) -> u64 {
        self.0
    }

    /// The id with a number. An id of no live goal is harmless: events about it are ignored.
    #[must_use]
    pub const fn from_number(number: u64) -> Self {
        Self(number)
    }
}

impl fmt::Display for GoalId {
    /// Writes the running number of the start, from 1; the whole number of an id that no engine hands out.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 >> SLOT_BITS {
            0 => write!(f, "{}", self.0),
            start => write!(f, "#{start}"),
        }
    }
}

/// Id of one question to a verifier. The engine chooses it and never uses it twice in a run.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct CheckId(pub(crate) u64);

impl CheckId {
    /// The id as a number, for a protocol or a log.
    #[must_use]
    pub const fn number(self) -> u64 {
        self.0
    }

    /// The id with a number. A verdict on a check that no step waits for is ignored.
    #[must_use]
    pub const fn from_number(number: u64) -> Self {
        Self(number)
    }
}

impl fmt::Display for CheckId {
    /// Writes the running number of the question, from 1.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "?{}", self.0)
    }
}

/// The step of a goal that has none.
const NOBODY: NodeId = NodeId(u32::MAX);

/// The live goals. A goal's id names its slot, so finding its step costs one look.
#[derive(Clone, Debug, Default)]
pub(crate) struct GoalTable {
    slots: Vec<Option<(GoalId, NodeId)>>,
    free: Vec<u32>,
    starts: u64,
}

impl GoalTable {
    /// A new goal for a step.
    #[inline]
    pub(crate) fn open(&mut self, node: NodeId) -> GoalId {
        self.starts += 1;
        let slot = self.free.pop().unwrap_or_else(|| {
            self.slots.push(None);
            (self.slots.len() - 1) as u32
        });
        let goal = GoalId(self.starts << SLOT_BITS | u64::from(slot));
        if let Some(place) = self.slots.get_mut(slot as usize) {
            *place = Some((goal, node));
        }
        goal
    }

    /// The step of a live goal.
    #[inline]
    pub(crate) fn node(&self, goal: GoalId) -> Option<NodeId> {
        match self.slots.get(Self::slot(goal)) {
            Some(Some((live, node))) if *live == goal && *node != NOBODY => Some(*node),
            Some(Some(_) | None) | None => None,
        }
    }

    /// A live goal is for this step from now on.
    pub(crate) fn assign(&mut self, goal: GoalId, node: NodeId) {
        if let Some(Some((live, of))) = self.slots.get_mut(Self::slot(goal))
            && *live == goal
        {
            *of = node;
        }
    }

    /// A live goal is for no step any more.
    pub(crate) fn disown(&mut self, goal: GoalId) {
        self.assign(goal, NOBODY);
    }

    /// The goal is no longer live. Gives the step that it was for; none where it was not live or for no step.
    #[inline]
    pub(crate) fn close(&mut self, goal: GoalId) -> Option<NodeId> {
        let index = Self::slot(goal);
        let place = self.slots.get_mut(index)?;
        let (_, node) = place.take_if(|(live, _)| *live == goal)?;
        self.free.push(index as u32);
        Some(node).filter(|node| *node != NOBODY)
    }

    /// All live goals that have a step, in the order of their starts.
    pub(crate) fn live(&self) -> Vec<(GoalId, NodeId)> {
        let own = self.slots.iter().flatten().copied().filter(|(_, node)| *node != NOBODY);
        let mut live: Vec<_> = own.collect();
        live.sort_unstable();
        live
    }

    fn slot(goal: GoalId) -> usize {
        (goal.0 & ((1 << SLOT_BITS) - 1)) as usize
    }
}
