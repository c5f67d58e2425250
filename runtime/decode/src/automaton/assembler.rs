//! Assembly of operations, and the length of the shortest completion of each.

use smol_str::SmolStr;

use super::{BoundNames, Branch, Op, OpId, OptionalPart, Word, WordList};
use crate::grammar::{Action, Guard, NameUse, WordRole};
use crate::subset::MAX_NAME_CHARS;

/// An alternative with the place where it goes on.
pub(super) type Transition = (SmolStr, OpId, Guard);

/// A list of operations that grows; places are kept for operations whose goals are known later.
#[derive(Debug, Default)]
pub(crate) struct Assembler {
    pub(crate) ops: Vec<Op>,
}

/// More bytes than any document has: no path leads on.
const ENDLESS: u32 = 1 << 24;

impl Assembler {
    /// The place of the next operation.
    pub(crate) fn here(&self) -> OpId {
        u32::try_from(self.ops.len()).unwrap_or(u32::MAX)
    }

    pub(crate) fn put(&mut self, op: Op) -> OpId {
        let here = self.here();
        self.ops.push(op);
        here
    }

    pub(crate) fn literal(&mut self, text: &str) -> OpId {
        self.put(Op::Literal(text.as_bytes().into()))
    }

    pub(crate) fn act(&mut self, act: Action) -> OpId {
        self.put(Op::Action(act))
    }

    /// Keeps a place for an operation that is set later.
    pub(crate) fn later(&mut self) -> OpId {
        self.put(Op::Accept)
    }

    pub(crate) fn set(&mut self, at: OpId, op: Op) {
        if let Some(slot) = self.ops.get_mut(at as usize) {
            *slot = op;
        }
    }

    pub(crate) fn choose(&mut self, at: OpId, alternatives: &[Transition]) {
        let made = alternatives.iter().map(|(text, to, guard)| Branch {
            bytes: text.as_bytes().into(),
            to: *to,
            guard: *guard,
        });
        let made = made.collect();
        self.set(at, Op::Choose(made));
    }

    /// Sets an optional part at a place that was kept for it.
    pub(crate) fn optional(
        &mut self,
        at: OpId,
        (text, then, guard): (&str, OpId, Guard),
        (other, absent): (OpId, Guard),
    ) {
        self.set(
            at,
            Op::Optional(OptionalPart { bytes: text.as_bytes().into(), then, guard, other, absent }),
        );
    }

    /// Computes the shortest completion of each operation: the number of bytes to the end of its rule. A
    /// list of words counts with its longest path, because which words are open is not known here.
    /// O(operations × nesting).
    pub(crate) fn rests(&self) -> Vec<u32> {
        let mut rest = vec![ENDLESS; self.ops.len()];
        loop {
            let mut changed = false;
            for index in (0..self.ops.len()).rev() {
                let Some(op) = self.ops.get(index) else { continue };
                let new = self.rest_of(op, index, &rest).min(ENDLESS);
                if let Some(old) = rest.get_mut(index).filter(|old| new < **old) {
                    *old = new;
                    changed = true;
                }
            }
            if !changed {
                return rest;
            }
        }
    }

    fn rest_of(&self, op: &Op, index: usize, rest: &[u32]) -> u32 {
        let at = |id: OpId| rest.get(id as usize).copied().unwrap_or(ENDLESS);
        let next = rest.get(index + 1).copied().unwrap_or(0);
        match op {
            Op::Literal(bytes) => len(bytes) + next,
            Op::Choose(alternatives) => {
                // Alternatives that depend on the state may be closed.
                let transitions = alternatives.iter().filter(|transition| is_always_open(transition.guard));
                transitions
                    .map(|transition| len(&transition.bytes) + at(transition.to))
                    .min()
                    .unwrap_or(ENDLESS)
            }
            Op::Word(words) if words.role == WordRole::Keyword => keyword(words, rest),
            Op::Word(words) => self.word(words, rest),
            Op::Optional(maybe) if maybe.guard == Guard::Pose => {
                either(len(&maybe.bytes) + at(maybe.then), at(maybe.other))
            }
            Op::Optional(maybe) => {
                let here = is_always_open(maybe.guard).then(|| len(&maybe.bytes) + at(maybe.then));
                let there = is_always_open(maybe.absent).then(|| at(maybe.other));
                here.into_iter().chain(there).min().unwrap_or(ENDLESS)
            }
            // A pose may be all that can stand there.
            Op::Fork { then, guard: Guard::Pose, other, .. } => either(at(*then), at(*other)),
            Op::Fork { other, .. } => at(*other),
            Op::Text { .. } => 2 + next,
            Op::Name(naming) => match naming {
                NameUse::Policy | NameUse::Group => 4 + next,
                NameUse::Result(_) | NameUse::Item | NameUse::Let => 4 + next,
            },
            Op::Number(range) => width(range.least, range.greatest, range.decimals) + next,
            Op::Action(_) => next,
            Op::Call(rule) => at(*rule) + next,
            Op::Gives { then, other } => at(*then).max(at(*other)),
            Op::Jump(to) => at(*to),
            Op::Return | Op::Accept => 0,
        }
    }

    fn word(&self, words: &WordList, rest: &[u32]) -> u32 {
        let at = |id: OpId| rest.get(id as usize).copied().unwrap_or(ENDLESS);
        let own = words.table.entries.iter().map(|entry| {
            let name = u32::try_from(entry.name.len()).unwrap_or(ENDLESS);
            name.saturating_add(at(entry.to.unwrap_or(words.next)))
        });
        let bound = match words.bound {
            BoundNames::None => None,
            // Another word is always there.
            BoundNames::CaughtField(_) => None,
            BoundNames::Type(_)
            | BoundNames::Lists
            | BoundNames::List
            | BoundNames::First(_)
            | BoundNames::Given
            | BoundNames::Caught => Some(u32::try_from(MAX_NAME_CHARS).unwrap_or(0) + 1 + at(words.next)),
        };
        own.chain(bound)
            .filter(|length| *length < ENDLESS)
            .max()
            .map_or(ENDLESS, |most| most.saturating_add(2))
    }
}

/// The alternative is always there as a last resort.
fn is_always_open(guard: Guard) -> bool {
    match guard {
        // A rule that is full ends: its last resort is the end.
        Guard::Open | Guard::Below(_) | Guard::Loose | Guard::Is | Guard::Several | Guard::Any => true,
        // Those of a cleanup, which cannot fail.
        Guard::Room | Guard::Cleaned => true,
        _ => false,
    }
}

/// The length of the path through keywords that is always open. Among conditions, where one must be found
/// that refutes nothing, the longest fluent counts; among calls only, the longest call.
fn keyword(words: &WordList, rest: &[u32]) -> u32 {
    let length = |entry: &Word| {
        let to = rest.get(entry.to.unwrap_or(words.next) as usize).copied().unwrap_or(ENDLESS);
        len(entry.name.as_bytes()).saturating_add(to)
    };
    let entries = words.table.entries.iter();
    let fluents = entries.clone().filter(|entry| matches!(entry.guard, Guard::Fluent(_)));
    let longest = |lengths: &mut dyn Iterator<Item = u32>| lengths.filter(|length| *length < ENDLESS).max();
    let open = entries.clone().filter(|entry| is_always_open(entry.guard)).map(length).min();
    let calls = entries.filter(|entry| matches!(entry.guard, Guard::Callable(_)));
    let calls = || longest(&mut calls.map(length));
    longest(&mut fluents.map(length)).or(open).or_else(calls).unwrap_or(ENDLESS)
}

/// The longer of two paths of which either may be the only one.
fn either(one: u32, other: u32) -> u32 {
    if one < ENDLESS && other < ENDLESS { one.max(other) } else { one.min(other) }
}

fn len(bytes: &[u8]) -> u32 {
    u32::try_from(bytes.len()).unwrap_or(ENDLESS)
}

/// The length of the longest number of a range, in bytes.
pub(crate) fn width(least: i64, greatest: i64, decimals: u8) -> u32 {
    let scale = 10u64.pow(u32::from(decimals));
    let digits = |units: i64| (units.unsigned_abs() / scale).checked_ilog10().unwrap_or(0) + 1;
    let fraction = if decimals > 0 { u32::from(decimals) + 1 } else { 0 };
    digits(least).max(digits(greatest)) + fraction + u32::from(least < 0)
}
