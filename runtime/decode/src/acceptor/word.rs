//! Recognition letter by letter: of words, by the range of a sorted list that still fits, of texts, and of
//! new names.

use motet_compiler::signature::Type;
use motet_syntax::Syntax;
use motet_syntax::text::MAX_TEXT_VALUES;
use motet_syntax::words::RESERVED;

use super::event_log::{Event, Id, Name, State, UNSEEN};
use super::machine::{Machine, StateRef, WordStep};
use crate::automaton::{BoundNames, WordEnd, WordList};
use crate::grammar::{NameUse, WordRole};
use crate::subset::{MAX_NAME_CHARS, MAX_TEXT_CHARS, is_text_char};

/// Flag of a list entry that is a binding; the other bits are its index.
pub(crate) const BOUND: u32 = 1 << 31;

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
        // The words are sorted by their bytes, so those that share one are adjacent.
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
        // A name that is a prefix of another may have ended, or not.
        if goes_on || (words.ends == WordEnd::Bare && last - first > 1) {
            return WordStep::To(Some(state));
        }
        WordStep::To(Some(self.end_of_word(state, words, entry)))
    }

    /// The word that ends here, among words that end where no letter follows.
    pub(super) fn whole(&self, state: &State, words: &WordList) -> Option<u32> {
        let is_begun = words.ends == WordEnd::Bare && state.pos > 0 && state.lo < state.hi;
        let entry = self.arenas.lists.get(state.lo as usize).copied().filter(|_| is_begun)?;
        self.letter(words, entry, state.pos as usize).is_none().then_some(entry)
    }

    /// The range of the list that is left; evaluated on first use and cached with the state.
    pub(super) fn range(&mut self, state: &State, origin: StateRef, words: &WordList) -> (u32, u32) {
        if state.hi != UNSEEN {
            return (state.lo, state.hi);
        }
        let is_partial = self.taken.is_some();
        let (lo, hi) = self.list(state, words);
        if let Some(stored) = self.state_mut(origin)
            && !is_partial
        {
            (stored.lo, stored.hi) = (lo, hi);
        }
        (lo, hi)
    }

    /// The bytes that are being taken rule a word out of which `pos` letters are here.
    pub(super) fn is_out(&self, words: &WordList, entry: u32, pos: u32) -> bool {
        let Some((begin, bytes)) = &self.taken else { return false };
        let ahead = bytes.get(self.bytes.len().saturating_sub(*begin)..).unwrap_or_default();
        let mut letters = (pos as usize..).map_while(|pos| self.letter(words, entry, pos)).zip(ahead);
        letters.any(|(letter, byte)| letter != *byte)
    }

    fn end_of_word(&mut self, mut state: State, words: &WordList, entry: u32) -> State {
        let next = match entry.checked_sub(BOUND) {
            Some(id) => {
                match words.bound {
                    BoundNames::Lists => state = self.bind_item(state, id),
                    BoundNames::First(_) => state.event = self.record(state.event, Event::First(id)),
                    BoundNames::CaughtField(field) => {
                        state.event = self.record(state.event, Event::Open(field.node()));
                        state.event = self.record(state.event, Event::Bound(id));
                    }
                    BoundNames::None
                    | BoundNames::Type(_)
                    | BoundNames::List
                    | BoundNames::Given
                    | BoundNames::Caught => state.event = self.record(state.event, Event::Bound(id)),
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

    /// Binds the item of a loop to the element type of its list.
    fn bind_item(&mut self, mut state: State, list: Id) -> State {
        let ty = self.element(list);
        let item = self.arenas.entry(state.event).map(|said| said.event);
        state.event = self.record(state.event, Event::Bound(list));
        if let Some(Event::Name(start, len)) = item {
            let item = Name { below: state.scope, start, len, ty, is_free: false };
            state.scope = self.arenas.bind(item);
        }
        state
    }

    /// The number of the type of a bound list's elements; `u16::MAX` for another name.
    pub(super) fn element(&self, list: Id) -> u16 {
        let automaton = &self.context.automaton;
        let element = self.arenas.name(list).and_then(|list| automaton.ty(list.ty)).and_then(|ty| match ty {
            Type::List(element) => Some(element),
            _ => None,
        });
        let ty = element.and_then(|element| automaton.types.iter().position(|ty| ty == &**element));
        ty.and_then(|ty| u16::try_from(ty).ok()).unwrap_or(u16::MAX)
    }

    /// The name before the list that was just written.
    pub(super) fn name_before_list(&self, event: Id) -> Option<(u32, u32)> {
        self.arenas.back(event).find_map(|said| match said.event {
            Event::Name(start, len) => Some((start, len)),
            _ => None,
        })
    }

    /// A byte of a word with the quotes that belong to it; `None` behind its end.
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
                    _ if matches!(words.ends, WordEnd::Bare | WordEnd::Whole) => pos,
                    None => return Some(b'$'),
                    Some(pos) => pos,
                };
                let start = name.start as usize;
                (self.bytes.get(start..start + name.len as usize)?, pos)
            }
        };
        match name.get(pos) {
            None if let BoundNames::CaughtField(field) = words.bound
                && entry >= BOUND =>
            {
                field.spelled().as_bytes().get(pos - name.len()).copied()
            }
            Some(byte) => Some(*byte),
            None => (pos == name.len() && has_quote).then_some(b'"'),
        }
    }
}

/// The first index in `lo..hi` for which `before` is false (binary search).
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

impl NameUse {
    /// The scope whose names this one must differ from; the name of a policy or a sequence is bound nowhere.
    pub(super) fn scope(self, scope: Id) -> Id {
        match self {
            Self::Result(_) | Self::Item | Self::Let => scope,
            Self::Policy | Self::Group => 0,
        }
    }
}

impl Machine {
    pub(super) fn text(&mut self, mut state: State, arg: Option<u8>, byte: u8) -> Option<State> {
        let next = state.op + 1;
        if byte == b'"' {
            if state.lo != UNSEEN || state.hi != UNSEEN {
                return None;
            }
            let (start, len) = self.written(state.pos).filter(|_| state.pos > 0)?;
            let event = Event::Text(start, len);
            if arg.is_some() && !self.permits_text(&state, event) {
                return None;
            }
            state.event = self.record(state.event, event);
            return Some(self.follow_epsilon(state, next));
        }
        // Bytes that must follow for the text to end: those of a value, and the second of two braces.
        let mut open = 0;
        match (state.lo, state.hi, byte) {
            (UNSEEN, UNSEEN, b'{') => (state.lo, open) = (0, 1),
            (UNSEEN, UNSEEN, b'}') => (state.hi, open) = (0, 1),
            (UNSEEN, UNSEEN, _) => {}
            (UNSEEN, _, b'}') => state.hi = UNSEEN,
            (UNSEEN, ..) => return None,
            (0, _, b'{') => state.lo = UNSEEN,
            (begun, ..) => {
                let (start, len) = self.written(begun)?;
                if begun == 0 && self.values_before(state.pos) >= MAX_TEXT_VALUES {
                    return None;
                }
                let rest = self.rest_of_value(&state, (start, len), byte)?;
                state.lo = if byte == b'}' { UNSEEN } else { begun + 1 };
                open = rest;
            }
        }
        let can = is_text_char(char::from(byte))
            && state.pos as usize + open < MAX_TEXT_CHARS
            && !(state.pos == 0 && byte == b'$')
            && self.fits(2 + open, next, state.frame);
        state.pos += 1;
        can.then_some(state)
    }

    /// The number of values among the last `count` bytes of a text, behind which a brace is open.
    fn values_before(&self, count: u32) -> usize {
        let Some((start, len)) = self.written(count) else { return 0 };
        let text = self.bytes.get(start as usize..(start + len) as usize).unwrap_or_default();
        // A brace that is written twice opens nothing.
        let open = text.iter().fold((0usize, false), |(found, is_open), byte| match byte {
            b'{' if is_open => (found - 1, false),
            b'{' => (found + 1, true),
            _ => (found, false),
        });
        open.0.saturating_sub(usize::from(open.1))
    }

    /// The number of bytes that end a value in a text behind one more byte: the shortest value that goes on
    /// like that, and the brace. A value is a bound name, or the length or the first element of a list.
    fn rest_of_value(&self, state: &State, (start, len): (u32, u32), byte: u8) -> Option<usize> {
        let bytes = |start: u32, len: u32| self.bytes.get(start as usize..(start + len) as usize);
        let begun = bytes(start, len)?;
        let automaton = &self.context.automaton;
        // The `$` lets a name be one of the words that the text syntax reserves.
        let is_json = automaton.subset.syntax == Syntax::Json;
        let mut least = None;
        for (_, name) in self.visible(state.scope) {
            let (Some(ty), Some(spelled)) = (automaton.ty(name.ty), bytes(name.start, name.len)) else {
                continue;
            };
            let mut said = ty;
            while let Type::List(element) = said {
                said = element;
            }
            let can_say = *said != Type::Pose;
            let is_list = matches!(ty, Type::List(_));
            // A word of the language is no value by itself.
            let is_plain = !RESERVED.iter().any(|word| word.as_bytes() == spelled);
            let is_caught = is_plain && *ty == Type::Failure && automaton.catches;
            let values: [(bool, &[u8], &[u8]); 5] = [
                (is_plain && can_say, b"", b""),
                (is_caught, b"", b".kind"),
                (is_caught, b"", b".text"),
                (is_list && automaton.counts, if is_json { b"count($" } else { b"count(" }, b")"),
                (is_list && can_say && automaton.firsts, if is_json { b"first($" } else { b"first(" }, b")"),
            ];
            for (_, lead, end) in values.into_iter().filter(|(can, ..)| *can) {
                let mut value = lead.iter().chain(spelled).chain(end).chain(b"}");
                if begun.iter().all(|byte| value.next() == Some(byte)) && value.next() == Some(&byte) {
                    let rest = value.count();
                    least = Some(least.map_or(rest, |least: usize| least.min(rest)));
                }
            }
        }
        least
    }

    pub(super) fn name(&mut self, mut state: State, naming: NameUse, byte: u8) -> Option<State> {
        let next = state.op + 1;
        let scope = naming.scope(state.scope);
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
                // It is not bound yet, but taken.
                NameUse::Let => Some(u16::MAX),
                NameUse::Policy | NameUse::Group | NameUse::Item => None,
            };
            if let Some(ty) = ty {
                let name = Name { below: state.scope, start, len, ty, is_free: false };
                state.scope = self.arenas.bind(name);
            }
            return Some(self.follow_epsilon(state, next));
        }
        let is_letter = byte.is_ascii_alphabetic() || byte == b'_';
        let is_digit = byte.is_ascii_digit() && state.pos > 0;
        if !(is_letter || is_digit) {
            return None;
        }
        let pos = state.pos as usize;
        // A taken name needs room to become another one.
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

    /// The start and length of the last `count` bytes.
    pub(super) fn written(&self, count: u32) -> Option<(u32, u32)> {
        let start = u32::try_from(self.bytes.len()).ok()?.checked_sub(count)?;
        Some((start, count))
    }

    /// A name, with one more byte behind it, is bound already or means something else.
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
                .find(|(_, known)| bytes(known.start, known.len).iter().copied().eq(name()))
                .is_some_and(|(_, known)| !known.is_free)
    }
}
