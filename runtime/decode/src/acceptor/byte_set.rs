//! Which bytes may come next, as far as that is seen without taking one: what tokens are tried by.

use super::event_log::State;
use super::machine::{Machine, StateRef};
use crate::automaton::{Op, WordEnd};

/// A set of bytes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct ByteSet([u64; 4]);

impl ByteSet {
    pub(super) const ALL: Self = Self([u64::MAX; 4]);
    const NONE: Self = Self([0; 4]);
    /// What a number has, and what may stand behind one: no letter does.
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
    /// The bytes that may come next, and perhaps some that may not.
    pub(super) fn candidate_bytes(&mut self) -> ByteSet {
        self.candidate_bytes_of(self.state(), StateRef::Current)
    }

    fn candidate_bytes_of(&mut self, state: State, origin: StateRef) -> ByteSet {
        let context = std::sync::Arc::clone(&self.context);
        let pos = state.pos as usize;
        let mut bytes = ByteSet::NONE;
        match context.automaton.op(state.op) {
            Op::Literal(literal) => literal.get(pos).into_iter().for_each(|byte| bytes.add(*byte)),
            Op::Choose(ways) => {
                let left = |index: usize| pos == 0 || state.lo & (1u32 << index) != 0;
                let ways = ways.iter().enumerate().filter(|(index, _)| left(*index));
                ways.filter_map(|(_, way)| way.bytes.get(pos)).for_each(|byte| bytes.add(*byte));
            }
            Op::Word(words) => {
                if pos == 0 && words.ends == WordEnd::Quoted {
                    bytes.add(b'"');
                    return bytes;
                }
                let (mut at, end) = self.range(&state, origin, words);
                if self.whole(&state, words).is_some() {
                    // No letter follows a name that is over.
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
                    // The words are in the order of their bytes.
                    at = super::word::search(at, end, |index| letter(self, index) <= Some(byte));
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
            Op::Fork { byte, other, .. } => {
                match context.automaton.op(*other) {
                    Op::Literal(literal) => literal.first().into_iter().for_each(|byte| bytes.add(*byte)),
                    Op::Number(_) => bytes = ByteSet::OF_NUMBERS,
                    _ => return ByteSet::ALL,
                }
                bytes.add(*byte);
            }
            Op::Accept => {}
            Op::Text { .. } | Op::Name(_) | Op::Action(_) | Op::Call(_) | Op::Jump(_) | Op::Return => {
                return ByteSet::ALL;
            }
        }
        bytes
    }
}
