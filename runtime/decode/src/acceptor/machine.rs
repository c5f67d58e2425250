//! The pushdown machine that runs the automaton: takes a byte and moves to the next state, or refuses it.

use std::sync::Arc;

use super::context::Context;
use super::event_log::{ArenaMark, Arenas, CallFrame, Event, Id, State, UNSEEN};
use super::open_node::OpenNodes;
use super::proof_cursor::Oracle;
use crate::automaton::{Op, OpId, WordEnd};
use crate::grammar::Guard;

/// Bytes reserved beyond the shortest completion: a condition that may refute nothing can need more than
/// the shortest one, and a `not` around it.
const SLACK: usize = 16;

/// The place where a state is stored, so that findings about it can be stored there too.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum StateRef {
    /// The last state of the machine.
    Current,
    /// A lookahead state beside it.
    Lookahead(Id),
    /// A copy that is not stored.
    Detached,
}

/// The outcome of a byte in a list of words.
pub(super) enum WordStep {
    /// The next state; `None` if no word goes on like that.
    To(Option<State>),
    /// The word had ended before the byte, which is for the operation behind it.
    Behind(State),
}

/// A run of the automaton over one policy. Going back is truncating its lists.
#[derive(Clone, Debug)]
pub(crate) struct Machine {
    pub(crate) context: Arc<Context>,
    pub(crate) arenas: Arenas,
    /// The state before each byte, and the one after the last.
    pub(crate) states: Vec<State>,
    pub(crate) bytes: Vec<u8>,
    pub(crate) budget: usize,
    pub(crate) oracle: Oracle,
    /// The bytes that are being taken together, and where they begin: of a list of words only those are
    /// judged that agree with them.
    pub(super) taken: Option<(usize, Vec<u8>)>,
    pub(super) open: OpenNodes,
}

impl Machine {
    /// A machine at the start; `None` if not even the shortest policy fits `budget` bytes.
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
            taken: None,
            open: OpenNodes::default(),
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

    /// The bytes so far are a whole policy.
    pub(crate) fn is_accepting(&self) -> bool {
        let (automaton, state) = (&self.context.automaton, self.state());
        match automaton.op(state.op) {
            Op::Accept => true,
            // The cleanup of the policy may follow.
            Op::Optional(maybe) => state.pos == 0 && matches!(automaton.op(maybe.other), Op::Accept),
            _ => false,
        }
    }

    /// Takes a byte if it may come next.
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

    /// Takes bytes until one may not follow; returns how many it took. Judges no word that they rule out.
    pub(super) fn take(&mut self, bytes: &[u8]) -> usize {
        let begin = self.bytes.len();
        self.taken = Some((begin, bytes.to_vec()));
        let count = bytes.iter().take_while(|byte| self.push(**byte)).count();
        self.taken = None;
        if count < bytes.len() {
            // Other words that begin like this may follow.
            self.pop(count);
            return bytes.iter().take_while(|byte| self.push(**byte)).count();
        }
        count
    }

    /// Takes back the last `count` bytes.
    pub(crate) fn pop(&mut self, count: usize) {
        let left = self.bytes.len().saturating_sub(count);
        self.bytes.truncate(left);
        self.states.truncate(left + 1);
    }

    pub(crate) fn mark(&self) -> ArenaMark {
        self.arenas.mark()
    }

    /// The only byte that may come next, if there is only one.
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
            Op::Choose(alternatives) => {
                for (index, alternative) in alternatives.iter().enumerate() {
                    let bit = 1u32 << index;
                    let is_open = if pos > 0 {
                        state.lo & bit != 0
                    } else {
                        self.is_open(
                            &state,
                            origin,
                            bit,
                            (alternative.bytes.len(), alternative.to),
                            alternative.guard,
                        )
                    };
                    if is_open && !alternative.bytes.get(pos).is_some_and(|byte| offer(*byte)) {
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
            _ => return None,
        }
        only
    }

    /// Refuses a byte without evaluating guards; most bytes that are tried end here.
    fn refuses(&self, state: &State, byte: u8) -> bool {
        let pos = state.pos as usize;
        match self.context.automaton.op(state.op) {
            Op::Literal(bytes) => bytes.get(pos) != Some(&byte),
            Op::Choose(alternatives) => {
                alternatives.iter().all(|alternative| alternative.bytes.get(pos) != Some(&byte))
            }
            Op::Fork { .. } => !self.may_begin(state.op, byte),
            _ => false,
        }
    }

    /// A byte may begin what stands at an operation, as far as its spelling tells.
    pub(super) fn may_begin(&self, op: OpId, byte: u8) -> bool {
        match self.context.automaton.behind_actions(op) {
            Op::Literal(bytes) => bytes.first() == Some(&byte),
            Op::Choose(alternatives) => {
                alternatives.iter().any(|alternative| alternative.bytes.first() == Some(&byte))
            }
            Op::Fork { byte: sign, other, .. } => byte == *sign || self.may_begin(*other, byte),
            Op::Word(words) if words.ends == WordEnd::Quoted => byte == b'"',
            Op::Number(_) => byte == b'-' || byte.is_ascii_digit(),
            _ => true,
        }
    }

    pub(super) fn advance(&mut self, mut state: State, mut origin: StateRef, byte: u8) -> Option<State> {
        if self.refuses(&state, byte) {
            return None;
        }
        let context = Arc::clone(&self.context);
        let automaton = &context.automaton;
        // The end of a number, and a fork, take no byte: they go on in this loop.
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
                Op::Choose(alternatives) => {
                    let mut left = 0u32;
                    let mut over = None;
                    for (index, alternative) in alternatives.iter().enumerate() {
                        let bit = 1u32 << index;
                        if alternative.bytes.get(state.pos as usize) != Some(&byte)
                            || (state.pos > 0 && state.lo & bit == 0)
                            || (state.pos == 0
                                && !self.is_open(
                                    &state,
                                    origin,
                                    bit,
                                    (alternative.bytes.len(), alternative.to),
                                    alternative.guard,
                                ))
                        {
                            continue;
                        }
                        left |= bit;
                        if alternative.bytes.len() == state.pos as usize + 1 {
                            over = Some(alternative.to);
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
                Op::Fork { byte: sign, then, guard, other } => {
                    origin = StateRef::Detached;
                    let mut lookahead = state;
                    (lookahead.op, lookahead.pos, lookahead.lo, lookahead.hi) = (*then, 0, UNSEEN, UNSEEN);
                    let is_then = byte == *sign
                        && match automaton.op(*then) {
                            Op::Word(words) => {
                                let taken = self.taken.take();
                                let (lo, hi) = self.list(&lookahead, words);
                                self.taken = taken;
                                (lookahead.lo, lookahead.hi) = (lo, hi);
                                lo < hi
                            }
                            _ => {
                                *guard == Guard::Open
                                    || self.fits(1, *then, state.frame) && self.allows(&state, *guard)
                            }
                        };
                    state = match (is_then, automaton.op(*then)) {
                        (true, Op::Word(_)) => lookahead,
                        (true, _) => self.follow_epsilon(state, *then),
                        (false, _) => self.follow_epsilon(state, *other),
                    };
                }
                Op::Text { arg } => return self.text(state, *arg, byte),
                Op::Name(naming) => return self.name(state, *naming, byte),
                Op::Number(range) => {
                    let range = &self.range_of(&state, *range);
                    let digits = state.digits();
                    if let Some(next) = digits.push(byte, range) {
                        (state.pos, state.lo, state.hi) = next.pack();
                        return Some(state);
                    }
                    let units = digits.finish(range)?;
                    state.event = self.record(state.event, Event::Number(units, automaton.decimals(range)));
                    (state, origin) = (self.follow_epsilon(state, state.op + 1), StateRef::Detached);
                }
                Op::Action(_) | Op::Call(_) | Op::Gives { .. } | Op::Jump(_) => return None,
                Op::Return | Op::Accept => return None,
            }
        }
    }

    /// So many more bytes fit the budget, with everything that has to follow.
    pub(super) fn fits(&self, more: usize, op: OpId, frame: Id) -> bool {
        let rest = self.context.automaton.rest(op) as usize + self.frame(frame).rest as usize;
        self.bytes.len() + more + rest + SLACK <= self.budget
    }

    /// Evaluates an alternative of a choice and caches the answer with the state.
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
        // The state behind a fork or a number that just ended is not stored.
        if let Some(top) = self.state_mut(origin) {
            let (known, open) = if top.lo == UNSEEN { (0, 0) } else { (top.lo, top.hi) };
            top.lo = known | bit;
            top.hi = if is_open { open | bit } else { open };
        }
        is_open
    }
}
