//! What may be left out: the machine goes on beside it, side by side with what is left out, for as long as both may be meant.

use std::sync::Arc;

use super::event_log::{ArenaMark, Id, State, UNSEEN};
use super::machine::{Machine, StateRef};
use crate::automaton::{Op, OptionalPart};

impl Machine {
    /// A state where it is kept.
    pub(super) fn state_mut(&mut self, origin: StateRef) -> Option<&mut State> {
        match origin {
            StateRef::Current => self.states.last_mut(),
            StateRef::Lookahead(id) => self.arenas.lookaheads.get_mut(id as usize),
            StateRef::Detached => None,
        }
    }

    /// Cuts the arenas back to what they were before something was tried; what is known of the last state, and of those
    /// beside it, is kept.
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
                        // What was said on the way there is forgotten.
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

    /// What may be left out, and what goes on where it is: side by side for as long as both may be meant.
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

    /// Whether what may be left out may be there.
    pub(super) fn has_literal(&mut self, state: &State, origin: StateRef, maybe: &OptionalPart) -> bool {
        state.pos > 0 || self.is_open(state, origin, 1, (maybe.bytes.len(), maybe.then), maybe.guard)
    }

    /// The state where it is left out and as many bytes were taken as of it; none where that leads nowhere.
    pub(super) fn lookahead(&mut self, state: &State, origin: StateRef, maybe: &OptionalPart) -> Option<Id> {
        // What is kept may know more than the copy.
        let known = self.state_mut(origin).map_or(*state, |state_mut| *state_mut);
        if known.lookahead().is_some() || state.pos > 0 {
            return known.lookahead();
        }
        if !self.is_open(&known, origin, 2, (0, maybe.other), maybe.absent) {
            return None;
        }
        let next = self.follow_epsilon(*state, maybe.other);
        let id = self.arenas.push_lookahead(next);
        if let Some(state_mut) = self.state_mut(origin) {
            state_mut.set_lookahead(id);
        }
        Some(id)
    }
}
