//! What may be left out: the walk goes on beside it, side by side with what is left out, for as long as both may be meant.

use std::sync::Arc;

use super::arena::{Id, Lengths, State, UNSEEN};
use super::walk::{Home, Walk};
use crate::program::{Maybe, Op};

impl Walk {
    /// A state where it is kept.
    pub(super) fn kept(&mut self, home: Home) -> Option<&mut State> {
        match home {
            Home::Last => self.states.last_mut(),
            Home::Ahead(id) => self.arenas.aheads.get_mut(id as usize),
            Home::Nowhere => None,
        }
    }

    /// Cuts the arenas back to what they were before something was tried; what is known of the last state, and of those
    /// beside it, is kept.
    pub(crate) fn keep(&mut self, lengths: Lengths) {
        let machine = Arc::clone(&self.machine);
        let (mut home, mut lists) = (Home::Last, Vec::new());
        while let Some(state) = self.kept(home).copied() {
            match machine.program.op(state.op) {
                Op::Word(_) if state.hi != UNSEEN => {
                    let list = self.arenas.lists.get(state.lo as usize..state.hi as usize);
                    lists.push((home, list.unwrap_or_default().to_vec()));
                    break;
                }
                Op::Maybe(_) => match state.ahead() {
                    Some(id) if (id as usize) < lengths.aheads => home = Home::Ahead(id),
                    Some(_) => {
                        // What was said on the way there is forgotten.
                        self.kept(home).into_iter().for_each(State::forget_ahead);
                        break;
                    }
                    None => break,
                },
                _ => break,
            }
        }
        self.arenas.cut(lengths);
        for (home, list) in lists {
            let lo = u32::try_from(self.arenas.lists.len()).unwrap_or(u32::MAX);
            let is_cut = self.kept(home).is_some_and(|state| state.hi > lo);
            if is_cut {
                self.arenas.lists.extend(list);
                let hi = u32::try_from(self.arenas.lists.len()).unwrap_or(u32::MAX);
                self.kept(home).into_iter().for_each(|state| (state.lo, state.hi) = (lo, hi));
            }
        }
    }

    /// What may be left out, and what goes on where it is: side by side for as long as both may be meant.
    pub(super) fn maybe(&mut self, state: State, home: Home, maybe: &Maybe, byte: u8) -> Option<State> {
        let pos = state.pos as usize;
        let goes_on = maybe.bytes.get(pos) == Some(&byte) && self.has_literal(&state, home, maybe);
        if goes_on && pos + 1 == maybe.bytes.len() {
            return Some(self.settle(state, maybe.then));
        }
        let ahead = self.ahead(&state, home, maybe);
        let next = ahead.and_then(|id| {
            let next = self.arenas.aheads.get(id as usize).copied()?;
            self.advance(next, Home::Ahead(id), byte)
        });
        if !goes_on {
            return next;
        }
        let mut state = State { pos: state.pos + 1, lo: 0, hi: 0, ..state };
        if let Some(next) = next {
            state.set_ahead(self.arenas.push_ahead(next));
        }
        Some(state)
    }

    /// Whether what may be left out may be there.
    pub(super) fn has_literal(&mut self, state: &State, home: Home, maybe: &Maybe) -> bool {
        state.pos > 0 || self.is_open(state, home, 1, (maybe.bytes.len(), maybe.then), maybe.guard)
    }

    /// The state where it is left out and as many bytes were taken as of it; none where that leads nowhere.
    pub(super) fn ahead(&mut self, state: &State, home: Home, maybe: &Maybe) -> Option<Id> {
        // What is kept may know more than the copy.
        let known = self.kept(home).map_or(*state, |kept| *kept);
        if known.ahead().is_some() || state.pos > 0 {
            return known.ahead();
        }
        if !self.is_open(&known, home, 2, (0, maybe.other), maybe.absent) {
            return None;
        }
        let next = self.settle(*state, maybe.other);
        let id = self.arenas.push_ahead(next);
        if let Some(kept) = self.kept(home) {
            kept.set_ahead(id);
        }
        Some(id)
    }
}
