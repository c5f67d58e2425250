//! The machine itself: a byte in, a state out, or none where no policy goes on like that.

use std::sync::Arc;

use motet_compiler::Session;
use rustc_hash::FxHashSet;

use super::digits::Digits;
use super::event_log::{ArenaMark, Arenas, CallFrame, Event, Id, State, UNSEEN};
use super::memo::Memo;
use super::oracle::Oracle;
use super::word::WordStep;
use crate::automaton::{Automaton, Guard, Meaning, Op, OpId};

/// ByteSet that are kept free beside the shortest completion: where a condition has to be one that refutes nothing, the
/// shortest of all may not do, and it may have to stand under `not`.
const SLACK: usize = 16;

/// What all machines of one session share.
#[derive(Debug)]
pub(crate) struct Context {
    pub(crate) automaton: Arc<Automaton>,
    pub(crate) session: Session,
    /// Callables and entities of which a motion query found that there is no motion.
    pub(crate) infeasible: FxHashSet<(usize, u16)>,
    pub(crate) memo: Memo,
}

/// Where a state is kept, so that what is found of it can be kept there too.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum StateRef {
    /// As the last of the machine.
    Current,
    /// Beside it, where something was left out.
    Lookahead(Id),
    /// Nowhere.
    Detached,
}

/// A machine through the automaton.
#[derive(Clone, Debug)]
pub(crate) struct Machine {
    pub(crate) context: Arc<Context>,
    pub(crate) arenas: Arenas,
    /// The state before each byte, and after the last.
    pub(crate) states: Vec<State>,
    pub(crate) bytes: Vec<u8>,
    pub(crate) budget: usize,
    pub(crate) oracle: Oracle,
}

impl Machine {
    /// A machine that has taken nothing yet; none where not even the shortest policy has at most `budget` bytes.
    pub(crate) fn new(context: Arc<Context>, budget: usize) -> Option<Self> {
        let start = context.automaton.start;
        let least = context.automaton.rest(start) as usize + SLACK;
        let state = State { op: start, pos: 0, lo: UNSEEN, hi: UNSEEN, frame: 0, event: 0, scope: 0 };
        let (arenas, states) = (Arenas::new(), vec![state]);
        (least <= budget).then(|| Self {
            context,
            arenas,
            states,
            bytes: Vec::new(),
            budget,
            oracle: Oracle::default(),
        })
    }

    pub(crate) fn state(&self) -> State {
        let bottom = State { op: OpId::MAX, pos: 0, lo: UNSEEN, hi: UNSEEN, frame: 0, event: 0, scope: 0 };
        self.states.last().copied().unwrap_or(bottom)
    }

    pub(crate) fn frame(&self, id: Id) -> CallFrame {
        // The bottom is always there.
        self.arenas.frame(id).copied().unwrap_or_else(CallFrame::bottom)
    }

    /// Whether the bytes so far are a whole policy.
    pub(crate) fn is_accepting(&self) -> bool {
        matches!(self.context.automaton.op(self.state().op), Op::Accept)
    }

    /// Takes a byte, where one may follow.
    pub(crate) fn push(&mut self, byte: u8) -> bool {
        match self.advance(self.state(), StateRef::Current, byte) {
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
        let state_mut = self.bytes.len().saturating_sub(count);
        self.bytes.truncate(state_mut);
        self.states.truncate(state_mut + 1);
    }

    pub(crate) fn mark(&self) -> ArenaMark {
        self.arenas.mark()
    }

    /// The byte that must come next, where there is only one.
    pub(crate) fn only_byte(&mut self) -> Option<u8> {
        self.only_byte_of(self.state(), StateRef::Current)
    }

    fn only_byte_of(&mut self, state: State, origin: StateRef) -> Option<u8> {
        let context = Arc::clone(&self.context);
        let pos = state.pos as usize;
        let mut only = None;
        let mut offer = |byte: u8| match only {
            Some(other) if other != byte => false,
            _ => {
                only = Some(byte);
                true
            }
        };
        match context.automaton.op(state.op) {
            Op::Literal(bytes) => return bytes.get(pos).copied(),
            Op::Choose(ways) => {
                for (index, way) in ways.iter().enumerate() {
                    let bit = 1u32 << index;
                    let is_open = if pos > 0 {
                        state.lo & bit != 0
                    } else {
                        self.is_open(&state, origin, bit, (way.bytes.len(), way.to), way.guard)
                    };
                    if is_open && !way.bytes.get(pos).is_some_and(|byte| offer(*byte)) {
                        return None;
                    }
                }
            }
            Op::Word(words) => {
                let (lo, hi) = self.range(&state, origin, words);
                let ends = [lo, hi.checked_sub(1)?];
                for index in ends {
                    let entry = self.arenas.lists.get(index as usize).copied()?;
                    if !self.letter(words, entry, pos).is_some_and(&mut offer) {
                        return None;
                    }
                }
            }
            Op::Optional(maybe) => {
                let here = self.has_literal(&state, origin, maybe);
                let byte = maybe.bytes.get(pos).copied().filter(|_| here);
                let Some(lookahead) = self.lookahead(&state, origin, maybe) else { return byte };
                let next = self.arenas.lookaheads.get(lookahead as usize).copied()?;
                let other = self.only_byte_of(next, StateRef::Lookahead(lookahead))?;
                if here && byte != Some(other) {
                    return None;
                }
                only = Some(other);
            }
            Op::Fork { .. }
            | Op::Text { .. }
            | Op::Name(_)
            | Op::Number(_)
            | Op::Action(_)
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
        match self.context.automaton.op(state.op) {
            Op::Literal(bytes) => bytes.get(pos) != Some(&byte),
            Op::Choose(ways) => ways.iter().all(|way| way.bytes.get(pos) != Some(&byte)),
            _ => false,
        }
    }

    pub(super) fn advance(&mut self, mut state: State, mut origin: StateRef, byte: u8) -> Option<State> {
        if self.refuses(&state, byte) {
            return None;
        }
        let context = Arc::clone(&self.context);
        let automaton = &context.automaton;
        // A number ends, and a fork leads on, without a byte of their own.
        loop {
            match automaton.op(state.op) {
                Op::Literal(bytes) => {
                    if bytes.get(state.pos as usize) != Some(&byte) {
                        return None;
                    }
                    state.pos += 1;
                    let is_over = bytes.len() == state.pos as usize;
                    return Some(if is_over { self.follow_epsilon(state, state.op + 1) } else { state });
                }
                Op::Choose(ways) => {
                    let mut left = 0u32;
                    let mut over = None;
                    for (index, way) in ways.iter().enumerate() {
                        let bit = 1u32 << index;
                        if way.bytes.get(state.pos as usize) != Some(&byte)
                            || (state.pos > 0 && state.lo & bit == 0)
                            || (state.pos == 0
                                && !self.is_open(&state, origin, bit, (way.bytes.len(), way.to), way.guard))
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
                    return Some(over.map_or(state, |to| self.follow_epsilon(state, to)));
                }
                Op::Word(words) => match self.word(state, origin, words, byte) {
                    WordStep::To(next) => return next,
                    WordStep::Behind(next) => (state, origin) = (next, StateRef::Detached),
                },
                Op::Optional(maybe) => return self.maybe(state, origin, maybe, byte),
                Op::Fork { byte: sign, then, other } => {
                    origin = StateRef::Detached;
                    let mut lookahead = state;
                    (lookahead.op, lookahead.pos, lookahead.lo, lookahead.hi) = (*then, 0, UNSEEN, UNSEEN);
                    let is_word = byte == *sign
                        && match automaton.op(*then) {
                            Op::Word(words) => {
                                let (lo, hi) = self.list(&lookahead, words);
                                (lookahead.lo, lookahead.hi) = (lo, hi);
                                lo < hi
                            }
                            _ => true,
                        };
                    if is_word {
                        state = lookahead;
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
                    state.event = self.record(state.event, Event::Number(units, automaton.decimals(range)));
                    (state, origin) = (self.follow_epsilon(state, state.op + 1), StateRef::Detached);
                }
                Op::Action(_) | Op::Call(_) | Op::Jump(_) | Op::Return | Op::Accept => return None,
            }
        }
    }

    /// Whether so many bytes more fit, with all that has to follow.
    pub(super) fn fits(&self, more: usize, op: OpId, frame: Id) -> bool {
        let rest = self.context.automaton.rest(op) as usize + self.frame(frame).rest as usize;
        self.bytes.len() + more + rest + SLACK <= self.budget
    }

    /// Whether an alternative of a choice is open; what was found is kept with the state.
    pub(super) fn is_open(
        &mut self,
        state: &State,
        origin: StateRef,
        bit: u32,
        (len, to): (usize, OpId),
        guard: Guard,
    ) -> bool {
        if state.lo != UNSEEN && state.lo & bit != 0 {
            return state.hi & bit != 0;
        }
        let is_open = self.fits(len, to, state.frame) && self.allows(state, guard);
        // The state may be the one of a fork or of a number that has just ended, which is kept nowhere.
        if let Some(top) = self.state_mut(origin) {
            let (known, open) = if top.lo == UNSEEN { (0, 0) } else { (top.lo, top.hi) };
            top.lo = known | bit;
            top.hi = if is_open { open | bit } else { open };
        }
        is_open
    }
}

/// Whether a word of a list is a value that a motion query ruled out.
pub(crate) fn is_ruled_out(context: &Context, callable: usize, arg: usize, meaning: Meaning) -> bool {
    let Meaning::Entity(entity) = meaning else { return false };
    let target = context.automaton.callables.get(callable).and_then(|callable| callable.target);
    target == Some(arg) && context.infeasible.contains(&(callable, entity))
}
