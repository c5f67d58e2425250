//! Which bytes may come next, as far as that is seen without taking one: what tokens are tried by.

use super::arena::State;
use super::walk::{Home, Walk};
use crate::program::{Ends, Op};

/// A set of bytes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Bytes([u64; 4]);

impl Bytes {
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

impl Walk {
    /// The bytes that may come next, and perhaps some that may not.
    pub(super) fn seen_bytes(&mut self) -> Bytes {
        self.seen_bytes_of(self.state(), Home::Last)
    }

    fn seen_bytes_of(&mut self, state: State, home: Home) -> Bytes {
        let machine = std::sync::Arc::clone(&self.machine);
        let pos = state.pos as usize;
        let mut bytes = Bytes::NONE;
        match machine.program.op(state.op) {
            Op::Literal(literal) => literal.get(pos).into_iter().for_each(|byte| bytes.add(*byte)),
            Op::Choose(ways) => {
                let left = |index: usize| pos == 0 || state.lo & (1u32 << index) != 0;
                let ways = ways.iter().enumerate().filter(|(index, _)| left(*index));
                ways.filter_map(|(_, way)| way.bytes.get(pos)).for_each(|byte| bytes.add(*byte));
            }
            Op::Word(words) => {
                if pos == 0 && words.ends == Ends::Quoted {
                    bytes.add(b'"');
                    return bytes;
                }
                let (mut at, end) = self.range(&state, home, words);
                if self.whole(&state, words).is_some() {
                    // No letter follows a name that is over.
                    bytes = Bytes::OF_NUMBERS;
                    at += 1;
                }
                while at < end {
                    let letter = |walk: &Self, index: u32| {
                        walk.arenas
                            .lists
                            .get(index as usize)
                            .and_then(|entry| walk.letter(words, *entry, pos))
                    };
                    let Some(byte) = letter(self, at) else { break };
                    bytes.add(byte);
                    // The words are in the order of their bytes.
                    at = super::word::search(at, end, |index| letter(self, index) <= Some(byte));
                }
            }
            Op::Maybe(maybe) => {
                if let Some(id) = self.ahead(&state, home, maybe) {
                    let next = self.arenas.aheads.get(id as usize).copied();
                    bytes = next.map_or(Bytes::ALL, |next| self.seen_bytes_of(next, Home::Ahead(id)));
                }
                maybe.bytes.get(pos).into_iter().for_each(|byte| bytes.add(*byte));
            }
            Op::Number(_) => return Bytes::OF_NUMBERS,
            Op::Fork { byte, other, .. } => {
                match machine.program.op(*other) {
                    Op::Literal(literal) => literal.first().into_iter().for_each(|byte| bytes.add(*byte)),
                    Op::Number(_) => bytes = Bytes::OF_NUMBERS,
                    _ => return Bytes::ALL,
                }
                bytes.add(*byte);
            }
            Op::Accept => {}
            Op::Text { .. } | Op::Name(_) | Op::Act(_) | Op::Call(_) | Op::Jump(_) | Op::Return => {
                return Bytes::ALL;
            }
        }
        bytes
    }
}
