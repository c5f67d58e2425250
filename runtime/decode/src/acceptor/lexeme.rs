//! Texts and names, letter by letter.

use motet_syntax::Syntax;

use super::event_log::{Event, Id, Name, State};
use super::machine::Machine;
use crate::automaton::NameUse;
use crate::subset::{MAX_NAME_CHARS, MAX_TEXT_CHARS, is_text_char};

impl Machine {
    pub(super) fn text(&mut self, mut state: State, arg: Option<u8>, byte: u8) -> Option<State> {
        let next = state.op + 1;
        if byte == b'"' {
            let (start, len) = self.written(state.pos).filter(|_| state.pos > 0)?;
            let event = Event::Text(start, len);
            if arg.is_some() && !self.permits_text(&state, event) {
                return None;
            }
            state.event = self.record(state.event, event);
            return Some(self.follow_epsilon(state, next));
        }
        let can = is_text_char(char::from(byte))
            && (state.pos as usize) < MAX_TEXT_CHARS
            && !(state.pos == 0 && byte == b'$')
            && self.fits(2, next, state.frame);
        state.pos += 1;
        can.then_some(state)
    }

    pub(super) fn name(&mut self, mut state: State, naming: NameUse, byte: u8) -> Option<State> {
        let next = state.op + 1;
        // What a policy or a group is called is bound nowhere.
        let scope = match naming {
            NameUse::Result(_) | NameUse::Item | NameUse::Let => state.scope,
            NameUse::Policy | NameUse::Group => 0,
        };
        let end = if self.context.automaton.subset.syntax == Syntax::Json { b'"' } else { b' ' };
        if byte == end {
            let (start, len) = self.written(state.pos).filter(|_| state.pos > 0)?;
            if self.is_taken(scope, start, len, None) {
                return None;
            }
            if naming != NameUse::Let {
                state.event = self.record(state.event, Event::Name(start, len));
            }
            let ty = match naming {
                NameUse::Result(ty) => Some(ty),
                // It is no name of anything yet, but taken.
                NameUse::Let => Some(u16::MAX),
                NameUse::Policy | NameUse::Group | NameUse::Item => None,
            };
            if let Some(ty) = ty {
                state.scope = self.arenas.bind(Name { below: state.scope, start, len, ty });
            }
            return Some(self.follow_epsilon(state, next));
        }
        let is_letter = byte.is_ascii_alphabetic() || byte == b'_';
        let is_digit = byte.is_ascii_digit() && state.pos > 0;
        if !(is_letter || is_digit) {
            return None;
        }
        let pos = state.pos as usize;
        // A name that is taken needs room to become another.
        let can_grow = pos + 1 < MAX_NAME_CHARS && self.fits(4, next, state.frame);
        if !can_grow {
            let can_end = pos < MAX_NAME_CHARS && self.fits(2, next, state.frame);
            let (start, len) = self.written(state.pos)?;
            if !can_end || self.is_taken(scope, start, len, Some(byte)) {
                return None;
            }
        }
        state.pos += 1;
        Some(state)
    }

    /// The place of the last bytes of the machine.
    fn written(&self, count: u32) -> Option<(u32, u32)> {
        let start = u32::try_from(self.bytes.len()).ok()?.checked_sub(count)?;
        Some((start, count))
    }

    /// Whether a name, with one more byte behind it, is bound, or means something else.
    fn is_taken(&self, scope: Id, start: u32, len: u32, more: Option<u8>) -> bool {
        let bytes =
            |start: u32, len: u32| self.bytes.get(start as usize..(start + len) as usize).unwrap_or_default();
        let name = || bytes(start, len).iter().copied().chain(more);
        let taken = &self.context.automaton.taken;
        let means_else = || taken.contains(String::from_utf8_lossy(&name().collect::<Vec<u8>>()).as_ref());
        (!taken.is_empty() && means_else())
            || self
                .arenas
                .in_scope(scope)
                .any(|(_, known)| bytes(known.start, known.len).iter().copied().eq(name()))
    }
}
