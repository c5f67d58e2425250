//! Lookahead: candidate bytes, a superset of the bytes that may come next by which tokens are filtered, found
//! without taking one; and optional parts, of which the machine follows the literal and the bytes behind its
//! absence side by side until only one of them fits.

use std::sync::Arc;

use super::event_log::{ArenaMark, Id, State, UNSEEN};
use super::machine::{Machine, StateRef};
use super::word::search;
use crate::automaton::{Op, OptionalPart, WordEnd};

/// A set of bytes as a bit mask.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct ByteSet([u64; 4]);

impl ByteSet {
    pub(super) const ALL: Self = Self([u64::MAX; 4]);
    const NONE: Self = Self([0; 4]);
    /// The bytes of numbers and those that may follow one: no letters.
    const OF_NUMBERS: Self = Self([u64::MAX, !0x07ff_fffe_07ff_fffe, 0, 0]);

    pub(super) fn has(&self, byte: u8) -> bool {
        self.0.get(usize::from(byte >> 6)).is_some_and(|word| word >> (byte & 63) & 1 == 1)
    }

    fn add(&mut self, byte: u8) {
        if let Some(word) = self.0.get_mut(usize::from(byte >> 6)) {
            *word |= 1 << (byte & 63);
        }
    }
}

impl Machine {
    /// The candidate bytes of the current state.
    pub(super) fn candidate_bytes(&mut self) -> ByteSet {
        self.candidate_bytes_of(self.state(), StateRef::Current)
    }

    fn candidate_bytes_of(&mut self, state: State, origin: StateRef) -> ByteSet {
        let context = Arc::clone(&self.context);
        let pos = state.pos as usize;
        let mut bytes = ByteSet::NONE;
        match context.automaton.op(state.op) {
            Op::Literal(literal) => literal.get(pos).into_iter().for_each(|byte| bytes.add(*byte)),
            Op::Choose(alternatives) => {
                let left = |index: usize| pos == 0 || state.lo & (1u32 << index) != 0;
                let alternatives = alternatives.iter().enumerate().filter(|(index, _)| left(*index));
                alternatives
                    .filter_map(|(_, alternative)| alternative.bytes.get(pos))
                    .for_each(|byte| bytes.add(*byte));
            }
            Op::Word(words) => {
                if pos == 0 && words.ends == WordEnd::Quoted {
                    bytes.add(b'"');
                    return bytes;
                }
                let (mut at, end) = self.range(&state, origin, words);
                if self.whole(&state, words).is_some() {
                    // No letter follows a name that has ended.
                    bytes = ByteSet::OF_NUMBERS;
                    at += 1;
                }
                while at < end {
                    let letter = |machine: &Self, index: u32| {
                        machine
                            .arenas
                            .lists
                            .get(index as usize)
                            .and_then(|entry| machine.letter(words, *entry, pos))
                    };
                    let Some(byte) = letter(self, at) else { break };
                    bytes.add(byte);
                    // The words are sorted by their bytes.
                    at = search(at, end, |index| letter(self, index) <= Some(byte));
                }
            }
            Op::Optional(maybe) => {
                if let Some(id) = self.lookahead(&state, origin, maybe) {
                    let next = self.arenas.lookaheads.get(id as usize).copied();
                    bytes = next
                        .map_or(ByteSet::ALL, |next| self.candidate_bytes_of(next, StateRef::Lookahead(id)));
                }
                maybe.bytes.get(pos).into_iter().for_each(|byte| bytes.add(*byte));
            }
            Op::Number(_) => return ByteSet::OF_NUMBERS,
            Op::Fork { .. } => {
                (0..=u8::MAX).filter(|byte| self.may_begin(state.op, *byte)).for_each(|byte| bytes.add(byte));
            }
            Op::Accept => {}
            Op::Text { .. } | Op::Name(_) | Op::Action(_) | Op::Call(_) => return ByteSet::ALL,
            Op::Gives { .. } | Op::Jump(_) | Op::Return => return ByteSet::ALL,
        }
        bytes
    }
}

impl Machine {
    /// The stored state behind a reference.
    pub(super) fn state_mut(&mut self, origin: StateRef) -> Option<&mut State> {
        match origin {
            StateRef::Current => self.states.last_mut(),
            StateRef::Lookahead(id) => self.arenas.lookaheads.get_mut(id as usize),
            StateRef::Detached => None,
        }
    }

    /// The last state and the lookahead states, with the findings that are stored in them.
    pub(super) fn findings(&self) -> (State, Vec<State>) {
        (self.state(), self.arenas.lookaheads.clone())
    }

    /// Truncates the arenas to a mark, and forgets what was found since then.
    pub(super) fn forget_findings(&mut self, mark: ArenaMark, (last, lookaheads): (State, Vec<State>)) {
        self.arenas.truncate(mark);
        self.arenas.lookaheads = lookaheads;
        self.states.last_mut().into_iter().for_each(|state| *state = last);
    }

    /// Truncates the arenas to a mark, keeping the findings about the last state and its lookahead states.
    pub(crate) fn restore(&mut self, mark: ArenaMark) {
        let context = Arc::clone(&self.context);
        let (mut origin, mut lists) = (StateRef::Current, Vec::new());
        while let Some(state) = self.state_mut(origin).copied() {
            match context.automaton.op(state.op) {
                Op::Word(_) if state.hi != UNSEEN => {
                    let list = self.arenas.lists.get(state.lo as usize..state.hi as usize);
                    lists.push((origin, list.unwrap_or_default().to_vec()));
                    break;
                }
                Op::Optional(_) => match state.lookahead() {
                    Some(id) if (id as usize) < mark.lookaheads => origin = StateRef::Lookahead(id),
                    Some(_) => {
                        // The log on the way there is gone.
                        self.state_mut(origin).into_iter().for_each(State::drop_lookahead);
                        break;
                    }
                    None => break,
                },
                _ => break,
            }
        }
        self.arenas.truncate(mark);
        for (origin, list) in lists {
            let lo = u32::try_from(self.arenas.lists.len()).unwrap_or(u32::MAX);
            let is_cut = self.state_mut(origin).is_some_and(|state| state.hi > lo);
            if is_cut {
                self.arenas.lists.extend(list);
                let hi = u32::try_from(self.arenas.lists.len()).unwrap_or(u32::MAX);
                self.state_mut(origin).into_iter().for_each(|state| (state.lo, state.hi) = (lo, hi));
            }
        }
    }

    /// Takes a byte of an optional part, of what follows its absence, or of both.
    pub(super) fn maybe(
        &mut self,
        state: State,
        origin: StateRef,
        maybe: &OptionalPart,
        byte: u8,
    ) -> Option<State> {
        let pos = state.pos as usize;
        let goes_on = maybe.bytes.get(pos) == Some(&byte) && self.has_literal(&state, origin, maybe);
        if goes_on && pos + 1 == maybe.bytes.len() {
            return Some(self.follow_epsilon(state, maybe.then));
        }
        let lookahead = self.lookahead(&state, origin, maybe);
        let next = lookahead.and_then(|id| {
            let next = self.arenas.lookaheads.get(id as usize).copied()?;
            self.advance(next, StateRef::Lookahead(id), byte)
        });
        if !goes_on {
            return next;
        }
        let mut state = State { pos: state.pos + 1, lo: 0, hi: 0, ..state };
        if let Some(next) = next {
            state.set_lookahead(self.arenas.push_lookahead(next));
        }
        Some(state)
    }

    /// The optional part may be present.
    pub(super) fn has_literal(&mut self, state: &State, origin: StateRef, maybe: &OptionalPart) -> bool {
        state.pos > 0 || self.is_open(state, origin, 1, (maybe.bytes.len(), maybe.then), maybe.guard)
    }

    /// The state in which the part is absent and as many bytes were taken as of the part; `None` if absence
    /// leads nowhere.
    pub(super) fn lookahead(&mut self, state: &State, origin: StateRef, maybe: &OptionalPart) -> Option<Id> {
        // The stored state may know more than the copy.
        let known = self.state_mut(origin).map_or(*state, |stored| *stored);
        if known.lookahead().is_some() || state.pos > 0 {
            return known.lookahead();
        }
        if !self.is_open(&known, origin, 2, (0, maybe.other), maybe.absent) {
            return None;
        }
        let next = self.follow_epsilon(*state, maybe.other);
        let id = self.arenas.push_lookahead(next);
        if let Some(stored) = self.state_mut(origin) {
            stored.set_lookahead(id);
        }
        Some(id)
    }
}
