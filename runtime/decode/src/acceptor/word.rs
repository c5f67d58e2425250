//! WordList, letter by letter: a list in the order of its bytes, and the range of it that is left.

use super::event_log::{Event, Id, Name, State, UNSEEN};
use super::machine::{Machine, StateRef};
use crate::automaton::{BoundNames, WordEnd, WordList, WordRole};

/// The entry of a list that is a name which was bound: its number, and this.
pub(crate) const BOUND: u32 = 1 << 31;

/// Where a byte leads in a list of words.
pub(super) enum WordStep {
    /// There, or nowhere.
    To(Option<State>),
    /// The word was over before the byte: it is for what follows there.
    Behind(State),
}

impl Machine {
    pub(super) fn word(
        &mut self,
        mut state: State,
        origin: StateRef,
        words: &WordList,
        byte: u8,
    ) -> WordStep {
        (state.lo, state.hi) = self.range(&state, origin, words);
        let pos = state.pos as usize;
        let at = |machine: &Self, index: u32| {
            machine.arenas.lists.get(index as usize).and_then(|entry| machine.letter(words, *entry, pos))
        };
        // The words are in the order of their bytes, so those that go on with one stand together.
        let first = search(state.lo, state.hi, |index| at(self, index) < Some(byte));
        let last = search(first, state.hi, |index| at(self, index) <= Some(byte));
        if first >= last {
            let whole = self.whole(&state, words);
            return whole
                .map_or(WordStep::To(None), |entry| WordStep::Behind(self.end_of_word(state, words, entry)));
        }
        (state.lo, state.hi) = (first, last);
        state.pos += 1;
        let Some(entry) = self.arenas.lists.get(first as usize).copied() else { return WordStep::To(None) };
        let goes_on = self.letter(words, entry, pos + 1).is_some();
        // A name that begins another one may be over, or not.
        if goes_on || (words.ends == WordEnd::Bare && last - first > 1) {
            return WordStep::To(Some(state));
        }
        WordStep::To(Some(self.end_of_word(state, words, entry)))
    }

    /// The word that is over where the state is, of those that end where no letter follows.
    pub(super) fn whole(&self, state: &State, words: &WordList) -> Option<u32> {
        let is_begun = words.ends == WordEnd::Bare && state.pos > 0 && state.lo < state.hi;
        let entry = self.arenas.lists.get(state.lo as usize).copied().filter(|_| is_begun)?;
        self.letter(words, entry, state.pos as usize).is_none().then_some(entry)
    }

    /// The range of the list that is left, which is made where it is not there yet and kept with the state.
    pub(super) fn range(&mut self, state: &State, origin: StateRef, words: &WordList) -> (u32, u32) {
        if state.hi != UNSEEN {
            return (state.lo, state.hi);
        }
        let (lo, hi) = self.list(state, words);
        if let Some(state_mut) = self.state_mut(origin) {
            (state_mut.lo, state_mut.hi) = (lo, hi);
        }
        (lo, hi)
    }

    fn end_of_word(&mut self, mut state: State, words: &WordList, entry: u32) -> State {
        let next = match entry.checked_sub(BOUND) {
            Some(id) => {
                if words.bound == BoundNames::Lists {
                    state = self.bind_item(state, id);
                } else {
                    state.event = self.record(state.event, Event::Bound(id));
                }
                words.next
            }
            None => {
                let says = !matches!(
                    words.role,
                    WordRole::Callable | WordRole::Fluent | WordRole::Head | WordRole::Keyword
                );
                if says {
                    state.event = self.record(state.event, Event::Word(state.op, entry));
                }
                words.table.get(entry).and_then(|entry| entry.to).unwrap_or(words.next)
            }
        };
        self.follow_epsilon(state, next)
    }

    /// A loop's list is known: so is what its item is.
    fn bind_item(&mut self, mut state: State, list: Id) -> State {
        let automaton = &self.context.automaton;
        let element = self.arenas.name(list).and_then(|list| automaton.ty(list.ty)).and_then(|ty| match ty {
            motet_compiler::signature::Type::List(element) => Some(element),
            _ => None,
        });
        let ty = element.and_then(|element| automaton.types.iter().position(|ty| ty == &**element));
        let ty = ty.and_then(|ty| u16::try_from(ty).ok()).unwrap_or(u16::MAX);
        let item = self.arenas.entry(state.event).map(|said| said.event);
        state.event = self.record(state.event, Event::Bound(list));
        if let Some(Event::Name(start, len)) = item {
            state.scope = self.arenas.bind(Name { below: state.scope, start, len, ty });
        }
        state
    }

    /// The name that was said before the list that was just written.
    pub(super) fn name_before_list(&self, event: Id) -> Option<(u32, u32)> {
        let mut at = event;
        while let Some(said) = self.arenas.entry(at).filter(|_| at > 0) {
            if let Event::Name(start, len) = said.event {
                return Some((start, len));
            }
            at = said.below;
        }
        None
    }

    /// A byte of an alternative, with the quotes that belong to it; none behind its end.
    pub(crate) fn letter(&self, words: &WordList, entry: u32, pos: usize) -> Option<u8> {
        let pos = match (words.ends, pos.checked_sub(1)) {
            (WordEnd::Quoted, None) => return Some(b'"'),
            (WordEnd::Quoted, Some(pos)) => pos,
            _ => pos,
        };
        let has_quote = matches!(words.ends, WordEnd::Quoted | WordEnd::Tail);
        let (name, pos) = match entry.checked_sub(BOUND) {
            None => (words.table.get(entry)?.name.as_bytes(), pos),
            Some(id) => {
                let name = self.arenas.name(id)?;
                let pos = match pos.checked_sub(1) {
                    _ if words.ends == WordEnd::Bare => pos,
                    None => return Some(b'$'),
                    Some(pos) => pos,
                };
                let start = name.start as usize;
                (self.bytes.get(start..start + name.len as usize)?, pos)
            }
        };
        match name.get(pos) {
            Some(byte) => Some(*byte),
            None => (pos == name.len() && has_quote).then_some(b'"'),
        }
    }
}

/// The first index in `lo..hi` at which `before` does not hold; it holds up to there.
pub(super) fn search(mut lo: u32, mut hi: u32, before: impl Fn(u32) -> bool) -> u32 {
    while lo < hi {
        let middle = lo + (hi - lo) / 2;
        if before(middle) {
            lo = middle + 1;
        } else {
            hi = middle;
        }
    }
    lo
}
