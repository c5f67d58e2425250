//! The walk itself: a byte in, a state out, or none where no policy goes on like that.

use std::sync::Arc;

use motet_compiler::Session;
use rustc_hash::FxHashSet;

use super::arena::{Arenas, Control, Event, Id, Lengths, Name, State, UNSEEN};
use super::ask::Asked;
use super::memo::Memo;
use super::number::Digits;
use crate::program::{Guard, Meaning, Naming, Op, OpId, Program};
use crate::surface::{MAX_NAME_CHARS, MAX_TEXT_CHARS, is_text_char};

/// Bytes that are kept free beside the shortest completion: where a condition has to be one that refutes nothing, the
/// shortest of all may not do, and it may have to stand under `not`.
const SLACK: usize = 16;

/// What all walks of one session share.
#[derive(Debug)]
pub(crate) struct Machine {
    pub(crate) program: Arc<Program>,
    pub(crate) session: Session,
    /// Callables and entities of which a motion query found that there is no motion.
    pub(crate) infeasible: FxHashSet<(usize, u16)>,
    pub(crate) memo: Memo,
}

/// A walk through the program.
#[derive(Clone, Debug)]
pub(crate) struct Walk {
    pub(crate) machine: Arc<Machine>,
    pub(crate) arenas: Arenas,
    /// The state before each byte, and after the last.
    pub(crate) states: Vec<State>,
    pub(crate) bytes: Vec<u8>,
    pub(crate) budget: usize,
    pub(crate) asked: Asked,
}

impl Walk {
    /// A walk that has taken nothing yet; none where not even the shortest policy has at most `budget` bytes.
    pub(crate) fn new(machine: Arc<Machine>, budget: usize) -> Option<Self> {
        let start = machine.program.start;
        let least = machine.program.rest(start) as usize + SLACK;
        let state = State { op: start, pos: 0, lo: UNSEEN, hi: UNSEEN, control: 0, event: 0, scope: 0 };
        let (arenas, states) = (Arenas::new(), vec![state]);
        (least <= budget).then(|| Self {
            machine,
            arenas,
            states,
            bytes: Vec::new(),
            budget,
            asked: Asked::default(),
        })
    }

    pub(crate) fn state(&self) -> State {
        let bottom = State { op: OpId::MAX, pos: 0, lo: UNSEEN, hi: UNSEEN, control: 0, event: 0, scope: 0 };
        self.states.last().copied().unwrap_or(bottom)
    }

    pub(crate) fn control(&self, id: Id) -> Control {
        // The bottom is always there.
        self.arenas.control(id).copied().unwrap_or_else(Control::bottom)
    }

    /// Whether the bytes so far are a whole policy.
    pub(crate) fn is_accepting(&self) -> bool {
        matches!(self.machine.program.op(self.state().op), Op::Accept)
    }

    /// Takes a byte, where one may follow.
    pub(crate) fn push(&mut self, byte: u8) -> bool {
        match self.advance(byte) {
            Some(next) => {
                self.states.push(next);
                self.bytes.push(byte);
                true
            }
            None => false,
        }
    }

    /// Forgets the last bytes.
    pub(crate) fn pop(&mut self, count: usize) {
        let kept = self.bytes.len().saturating_sub(count);
        self.bytes.truncate(kept);
        self.states.truncate(kept + 1);
    }

    pub(crate) fn lengths(&self) -> Lengths {
        self.arenas.lengths()
    }

    /// Cuts the arenas back to what they were before something was tried; what is known of the last state is kept.
    pub(crate) fn keep(&mut self, lengths: Lengths) {
        let state = self.state();
        let words = matches!(self.machine.program.op(state.op), Op::Word(_)) && state.hi != UNSEEN;
        let list = if words { self.arenas.lists.get(state.lo as usize..state.hi as usize) } else { None };
        let list: Vec<u32> = list.unwrap_or_default().to_vec();
        self.arenas.cut(lengths);
        if words && (state.hi as usize) > self.arenas.lists.len() {
            let lo = u32::try_from(self.arenas.lists.len()).unwrap_or(u32::MAX);
            self.arenas.lists.extend(list);
            if let Some(top) = self.states.last_mut() {
                (top.lo, top.hi) = (lo, u32::try_from(self.arenas.lists.len()).unwrap_or(u32::MAX));
            }
        }
    }

    /// The byte that must come next, where there is only one.
    pub(crate) fn only_byte(&mut self) -> Option<u8> {
        let machine = Arc::clone(&self.machine);
        let state = self.state();
        let pos = state.pos as usize;
        let mut only = None;
        let mut offer = |byte: u8| match only {
            Some(other) if other != byte => false,
            _ => {
                only = Some(byte);
                true
            }
        };
        match machine.program.op(state.op) {
            Op::Literal(bytes) => return bytes.get(pos).copied(),
            Op::Choose(ways) => {
                for (index, way) in ways.iter().enumerate() {
                    let bit = 1u32 << index;
                    let is_open = if pos > 0 {
                        state.lo & bit != 0
                    } else {
                        self.is_open(&state, bit, way.bytes.len(), way.to, way.guard)
                    };
                    if is_open && !way.bytes.get(pos).is_some_and(|byte| offer(*byte)) {
                        return None;
                    }
                }
            }
            Op::Word(words) => {
                let (lo, hi) =
                    if state.hi == UNSEEN { self.list(&state, words) } else { (state.lo, state.hi) };
                let ends = [lo, hi.checked_sub(1)?];
                for index in ends {
                    let entry = self.arenas.lists.get(index as usize).copied()?;
                    if !self.letter(words, entry, pos).is_some_and(&mut offer) {
                        return None;
                    }
                }
            }
            Op::Fork { .. }
            | Op::Text { .. }
            | Op::Name(_)
            | Op::Number(_)
            | Op::Act(_)
            | Op::Call(_)
            | Op::Jump(_)
            | Op::Return
            | Op::Accept => return None,
        }
        only
    }

    /// Whether it is seen at once that a byte does not follow: most that are tried do not.
    fn refuses(&self, state: &State, byte: u8) -> bool {
        let pos = state.pos as usize;
        match self.machine.program.op(state.op) {
            Op::Literal(bytes) => bytes.get(pos) != Some(&byte),
            Op::Choose(ways) => ways.iter().all(|way| way.bytes.get(pos) != Some(&byte)),
            _ => false,
        }
    }

    fn advance(&mut self, byte: u8) -> Option<State> {
        if self.refuses(&self.state(), byte) {
            return None;
        }
        let machine = Arc::clone(&self.machine);
        let program = &machine.program;
        let mut state = self.state();
        // A number ends, and a fork leads on, without a byte of their own.
        loop {
            match program.op(state.op) {
                Op::Literal(bytes) => {
                    if bytes.get(state.pos as usize) != Some(&byte) {
                        return None;
                    }
                    state.pos += 1;
                    let is_over = bytes.len() == state.pos as usize;
                    return Some(if is_over { self.settle(state, state.op + 1) } else { state });
                }
                Op::Choose(ways) => {
                    let mut left = 0u32;
                    let mut over = None;
                    for (index, way) in ways.iter().enumerate() {
                        let bit = 1u32 << index;
                        if way.bytes.get(state.pos as usize) != Some(&byte)
                            || (state.pos > 0 && state.lo & bit == 0)
                            || (state.pos == 0
                                && !self.is_open(&state, bit, way.bytes.len(), way.to, way.guard))
                        {
                            continue;
                        }
                        left |= bit;
                        if way.bytes.len() == state.pos as usize + 1 {
                            over = Some(way.to);
                        }
                    }
                    if left == 0 {
                        return None;
                    }
                    state.pos += 1;
                    state.lo = left;
                    return Some(over.map_or(state, |to| self.settle(state, to)));
                }
                Op::Word(words) => return self.word(state, words, byte),
                Op::Fork { byte: sign, then, other } => {
                    let mut ahead = state;
                    (ahead.op, ahead.pos, ahead.lo, ahead.hi) = (*then, 0, UNSEEN, UNSEEN);
                    let is_word = byte == *sign
                        && match program.op(*then) {
                            Op::Word(words) => {
                                let (lo, hi) = self.list(&ahead, words);
                                (ahead.lo, ahead.hi) = (lo, hi);
                                lo < hi
                            }
                            _ => true,
                        };
                    if is_word {
                        state = ahead;
                    } else {
                        state.op = *other;
                        (state.pos, state.lo, state.hi) = (0, UNSEEN, UNSEEN);
                    }
                }
                Op::Text { arg } => return self.text(state, *arg, byte),
                Op::Name(naming) => return self.name(state, *naming, byte),
                Op::Number(range) => {
                    let digits = if state.pos == 0 {
                        Digits::default()
                    } else {
                        Digits::unpack((state.pos, state.lo, state.hi))
                    };
                    if let Some(next) = digits.push(byte, range) {
                        (state.pos, state.lo, state.hi) = next.pack();
                        return Some(state);
                    }
                    let units = digits.finish(range)?;
                    state.event = self.say(state.event, Event::Number(units, range.decimals));
                    state = self.settle(state, state.op + 1);
                }
                Op::Act(_) | Op::Call(_) | Op::Jump(_) | Op::Return | Op::Accept => return None,
            }
        }
    }

    /// Whether so many bytes more fit, with all that has to follow.
    pub(super) fn fits(&self, more: usize, op: OpId, control: Id) -> bool {
        let rest = self.machine.program.rest(op) as usize + self.control(control).rest as usize;
        self.bytes.len() + more + rest + SLACK <= self.budget
    }

    /// Whether an alternative of a choice is open; what was found is kept with the state.
    fn is_open(&mut self, state: &State, bit: u32, len: usize, to: OpId, guard: Guard) -> bool {
        if state.lo != UNSEEN && state.lo & bit != 0 {
            return state.hi & bit != 0;
        }
        let is_open = self.fits(len, to, state.control) && self.allows(state, guard);
        // The state may be the one of a fork or of a number that has just ended, which is kept nowhere.
        if let Some(top) = self.states.last_mut().filter(|top| top.op == state.op && top.pos == 0) {
            let (known, open) = if top.lo == UNSEEN { (0, 0) } else { (top.lo, top.hi) };
            top.lo = known | bit;
            top.hi = if is_open { open | bit } else { open };
        }
        is_open
    }

    fn text(&mut self, mut state: State, arg: Option<u8>, byte: u8) -> Option<State> {
        let next = state.op + 1;
        if byte == b'"' {
            let (start, len) = self.written(state.pos).filter(|_| state.pos > 0)?;
            let event = Event::Text(start, len);
            if arg.is_some() && !self.permits_text(&state, event) {
                return None;
            }
            state.event = self.say(state.event, event);
            return Some(self.settle(state, next));
        }
        let can = is_text_char(char::from(byte))
            && (state.pos as usize) < MAX_TEXT_CHARS
            && !(state.pos == 0 && byte == b'$')
            && self.fits(2, next, state.control);
        state.pos += 1;
        can.then_some(state)
    }

    fn name(&mut self, mut state: State, naming: Naming, byte: u8) -> Option<State> {
        let next = state.op + 1;
        let is_new = matches!(naming, Naming::Result(_) | Naming::Item);
        if byte == b'"' {
            let (start, len) = self.written(state.pos).filter(|_| state.pos > 0)?;
            if is_new && self.is_bound(state.scope, start, len, None) {
                return None;
            }
            state.event = self.say(state.event, Event::Name(start, len));
            if let Naming::Result(ty) = naming {
                state.scope = self.arenas.bind(Name { below: state.scope, start, len, ty });
            }
            return Some(self.settle(state, next));
        }
        let is_letter = byte.is_ascii_alphabetic() || byte == b'_';
        let is_digit = byte.is_ascii_digit() && state.pos > 0;
        if !(is_letter || is_digit) {
            return None;
        }
        let pos = state.pos as usize;
        // A name that is taken needs room to become another.
        let can_grow = pos + 1 < MAX_NAME_CHARS && self.fits(4, next, state.control);
        if !can_grow {
            let can_end = pos < MAX_NAME_CHARS && self.fits(2, next, state.control);
            let (start, len) = self.written(state.pos)?;
            if !can_end || (is_new && self.is_bound(state.scope, start, len, Some(byte))) {
                return None;
            }
        }
        state.pos += 1;
        Some(state)
    }

    /// The place of the last bytes of the walk.
    fn written(&self, count: u32) -> Option<(u32, u32)> {
        let start = u32::try_from(self.bytes.len()).ok()?.checked_sub(count)?;
        Some((start, count))
    }

    /// Whether a name, with one more byte behind it, is bound.
    fn is_bound(&self, scope: Id, start: u32, len: u32, more: Option<u8>) -> bool {
        let bytes =
            |start: u32, len: u32| self.bytes.get(start as usize..(start + len) as usize).unwrap_or_default();
        let name = || bytes(start, len).iter().copied().chain(more);
        self.arenas.in_scope(scope).any(|(_, known)| bytes(known.start, known.len).iter().copied().eq(name()))
    }
}

/// Whether a word of a list is a value that a motion query ruled out.
pub(crate) fn is_ruled_out(machine: &Machine, callable: usize, arg: usize, meaning: Meaning) -> bool {
    let Meaning::Entity(entity) = meaning else { return false };
    let target = machine.program.callables.get(callable).and_then(|callable| callable.target);
    target == Some(arg) && machine.infeasible.contains(&(callable, entity))
}
