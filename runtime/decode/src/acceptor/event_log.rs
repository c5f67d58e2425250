//! The event log of a machine and its other arenas: rule calls, events, bindings, word lists and lookahead
//! states.
//!
//! Arenas only grow and are truncated. A [`State`] holds an index into each of them, so it is small, and
//! going back is forgetting it.

use crate::automaton::{Automaton, Meaning, Op, OpId};
use crate::grammar::{BlockRole, Constant, NodeKind};
use crate::subset::Digits;

/// An index into an arena; entry 0 is the bottom.
pub(crate) type Id = u32;

/// A state of the machine.
#[derive(Clone, Copy, Debug)]
pub(crate) struct State {
    pub(crate) op: OpId,
    /// The number of bytes taken of the operation; of a number, its packed digits.
    pub(crate) pos: u32,
    /// Of a word, the range of its list that is left; of a choice, which alternatives are known and which
    /// are open; of a number, its packed digits.
    pub(crate) lo: u32,
    pub(crate) hi: u32,
    pub(crate) frame: Id,
    pub(crate) event: Id,
    pub(crate) scope: Id,
}

/// `lo` and `hi` of a word or a choice that was not evaluated yet.
pub(crate) const UNSEEN: u32 = u32::MAX;

impl State {
    /// The digits so far of the number that is being written.
    pub(crate) fn digits(&self) -> Digits {
        if self.pos == 0 { Digits::default() } else { Digits::unpack((self.pos, self.lo, self.hi)) }
    }

    /// The lookahead state of an optional part.
    pub(crate) fn lookahead(&self) -> Option<Id> {
        if self.lo == UNSEEN { None } else { (self.hi >> 2).checked_sub(1) }
    }

    pub(crate) fn set_lookahead(&mut self, id: Id) {
        let (known, open) = if self.lo == UNSEEN { (0, 0) } else { (self.lo, self.hi & 3) };
        (self.lo, self.hi) = (known, open | (id + 1) << 2);
    }

    pub(crate) fn drop_lookahead(&mut self) {
        self.hi &= 3;
    }
}

/// The call frame of a rule.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CallFrame {
    pub(crate) below: Id,
    pub(crate) ret: OpId,
    /// The number of bytes that follow its end at least.
    pub(crate) rest: u32,
    /// The number of its members.
    pub(crate) count: u8,
    /// The number of blocks around it, without the policy's own.
    pub(crate) depth: u8,
    /// The number of those that are proved to a fixed point.
    pub(crate) fix: u8,
    /// The number of conditions around it.
    pub(crate) conditions: u8,
    pub(crate) flags: Flags,
    pub(crate) slot: BlockRole,
    /// The scope at its beginning.
    pub(crate) scope: Id,
    /// The scope at the beginning of its present step, if that has blocks.
    pub(crate) begun: Id,
    /// The number of the type of the policy's result, if it gives one.
    pub(crate) result: Option<u16>,
}

/// Properties of a rule and of everything that it calls.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) struct Flags(u8);

impl Flags {
    /// The effects of a step may refute steps elsewhere: in another branch, or in a reaction.
    pub(crate) const SHARED: Self = Self(1);
    /// The body of a `try`.
    pub(crate) const TRIED: Self = Self(2);
    /// The condition must refute nothing.
    pub(crate) const STRICT: Self = Self(4);
    /// The condition stands under one `not`.
    pub(crate) const NEGATED: Self = Self(8);
    /// The condition need not be observable.
    pub(crate) const GOAL: Self = Self(16);
    /// A condition that says nothing about facts refutes nothing.
    pub(crate) const LOOSE: Self = Self(32);
    /// The cleanup of a step or of the policy.
    pub(crate) const CLEANUP: Self = Self(64);

    pub(crate) fn has(self, flag: Self) -> bool {
        self.0 & flag.0 != 0
    }

    pub(crate) fn with(self, flag: Self) -> Self {
        Self(self.0 | flag.0)
    }

    pub(crate) fn without(self, flag: Self) -> Self {
        Self(self.0 & !flag.0)
    }
}

/// An event of the log: the policy as its parser would report it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Event {
    /// A node begins.
    Open(NodeKind),
    /// The innermost node ends.
    Close,
    /// A word of the list of an operation.
    Word(OpId, u32),
    /// A use of a binding.
    Bound(Id),
    /// The first element of a bound list.
    First(Id),
    /// A text: the start and length of its bytes.
    Text(u32, u32),
    /// A new name: the start and length of its bytes.
    Name(u32, u32),
    /// A number: units of the last decimal, and the number of decimals.
    Number(i64, u8),
    /// A value without a word of its own.
    Constant(Constant),
    /// A text that describes no entity; any would do.
    AnyText,
    /// The place of the next step.
    Hole,
    /// Another condition follows, joined by `and` or `or`.
    Joined(NodeKind),
}

/// An entry of the event log.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LogEntry {
    pub(crate) below: Id,
    pub(crate) event: Event,
    /// The last event before the step of the body that contains this one.
    pub(crate) before: Id,
    /// The hash of all events up to here; the same events after a rollback have the same hash.
    pub(crate) hash: u64,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Name {
    pub(crate) below: Id,
    /// The start of its bytes.
    pub(crate) start: u32,
    pub(crate) len: u32,
    /// Its type; `u16::MAX` for a name without a value.
    pub(crate) ty: u16,
    /// True behind the block that bound it, where another binding may have the name.
    pub(crate) is_free: bool,
}

/// The arenas of one machine.
#[derive(Clone, Debug)]
pub(crate) struct Arenas {
    pub(crate) frames: Vec<CallFrame>,
    pub(crate) said: Vec<LogEntry>,
    pub(crate) names: Vec<Name>,
    pub(crate) lists: Vec<u32>,
    /// The lookahead states.
    pub(crate) lookaheads: Vec<State>,
}

/// The lengths of the arenas at some moment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ArenaMark {
    frames: usize,
    said: usize,
    names: usize,
    lists: usize,
    pub(super) lookaheads: usize,
}

impl CallFrame {
    /// The frame below all rules.
    pub(crate) fn bottom() -> Self {
        Self {
            below: 0,
            ret: OpId::MAX,
            rest: 0,
            count: 0,
            depth: 0,
            fix: 0,
            conditions: 0,
            flags: Flags::default(),
            slot: BlockRole::Body,
            scope: 0,
            begun: 0,
            result: None,
        }
    }
}

impl Arenas {
    pub(crate) fn new() -> Self {
        let said = LogEntry { below: 0, event: Event::Close, before: 0, hash: 0 };
        let name = Name { below: 0, start: 0, len: 0, ty: u16::MAX, is_free: true };
        Self {
            frames: vec![CallFrame::bottom()],
            said: vec![said],
            names: vec![name],
            lists: Vec::new(),
            lookaheads: Vec::new(),
        }
    }

    pub(crate) fn mark(&self) -> ArenaMark {
        let Self { frames, said, names, lists, lookaheads } = self;
        ArenaMark {
            frames: frames.len(),
            said: said.len(),
            names: names.len(),
            lists: lists.len(),
            lookaheads: lookaheads.len(),
        }
    }

    pub(crate) fn truncate(&mut self, to: ArenaMark) {
        self.frames.truncate(to.frames);
        self.said.truncate(to.said);
        self.names.truncate(to.names);
        self.lists.truncate(to.lists);
        self.lookaheads.truncate(to.lookaheads);
    }

    pub(crate) fn frame(&self, id: Id) -> Option<&CallFrame> {
        self.frames.get(id as usize)
    }

    pub(crate) fn entry(&self, id: Id) -> Option<&LogEntry> {
        self.said.get(id as usize)
    }

    pub(crate) fn name(&self, id: Id) -> Option<&Name> {
        self.names.get(id as usize).filter(|_| id > 0)
    }

    pub(crate) fn hash(&self, id: Id) -> u64 {
        self.entry(id).map_or(0, |said| said.hash)
    }

    pub(crate) fn push_frame(&mut self, frame: CallFrame) -> Id {
        let id = end(&self.frames);
        self.frames.push(frame);
        id
    }

    /// Appends an event within the same step of the body; `content` is its hash.
    pub(crate) fn record(&mut self, below: Id, event: Event, content: u64) -> Id {
        let (before, hash) = self.entry(below).map_or((0, 0), |said| (said.before, said.hash));
        let id = end(&self.said);
        self.said.push(LogEntry { below, event, before, hash: mix(hash, content) });
        id
    }

    /// Appends the last event of a step of the body: the next event begins another step.
    pub(crate) fn record_step_end(&mut self, below: Id) -> Id {
        let id = self.record(below, Event::Close, LAST);
        if let Some(said) = self.said.get_mut(id as usize) {
            said.before = id;
        }
        id
    }

    pub(crate) fn push_lookahead(&mut self, state: State) -> Id {
        let id = end(&self.lookaheads);
        self.lookaheads.push(state);
        id
    }

    pub(crate) fn bind(&mut self, name: Name) -> Id {
        let id = end(&self.names);
        self.names.push(name);
        id
    }

    /// The entries of the log from `last` back to its beginning.
    pub(crate) fn back(&self, last: Id) -> impl Iterator<Item = &LogEntry> {
        let entry = |id: Id| self.entry(id).filter(|_| id > 0);
        std::iter::successors(entry(last), move |said| entry(said.below))
    }

    /// The events after `before` up to `last`, in order.
    pub(crate) fn between(&self, before: Id, last: Id) -> Vec<Event> {
        let mut events = Vec::new();
        let mut at = last;
        while at > before {
            let Some(said) = self.entry(at) else { break };
            events.push(said.event);
            at = said.below;
        }
        events.reverse();
        events
    }

    /// The events of the step of the body that `last` belongs to, with `more` behind them, and the last event
    /// before it. In the cleanup of the policy, the whole body is that step, behind the mark of a cleanup.
    pub(crate) fn present(&self, last: Id, more: &[Event]) -> (Id, Vec<Event>) {
        let mut before = self.entry(last).map_or(0, |said| said.before);
        let mut events = self.between(before, last);
        if events.first().or(more.first()) == Some(&Event::Open(NodeKind::Finally)) {
            let earlier =
                |at: Id| self.entry(at).and_then(|said| self.entry(said.below)).map(|said| said.before);
            while let Some(step) = earlier(before).filter(|step| *step > 0) {
                before = step;
            }
            events = self.between(before, last);
            // A mark of the whole policy.
            events.insert(0, Event::Open(NodeKind::Finally));
        }
        events.extend_from_slice(more);
        (before, events)
    }

    /// The names in scope, the latest first, with those that later ones hide.
    pub(crate) fn in_scope(&self, scope: Id) -> impl Iterator<Item = (Id, &Name)> + '_ {
        let first = self.name(scope).map(|name| (scope, name));
        std::iter::successors(first, |(_, name)| self.name(name.below).map(|below| (name.below, below)))
    }
}

/// The hash of the event that ends a step of the body.
const LAST: u64 = 0x6c61_7374;

/// Extends a hash (the finaliser of splitmix64).
pub(crate) fn mix(hash: u64, more: u64) -> u64 {
    let mut mixed = hash.rotate_left(17).wrapping_add(0x9e37_79b9_7f4a_7c15) ^ more;
    mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    mixed ^ (mixed >> 31)
}

fn end<T>(list: &[T]) -> Id {
    u32::try_from(list.len()).unwrap_or(u32::MAX)
}

/// The meaning of a word event.
pub(super) fn meaning(automaton: &Automaton, event: Event) -> Option<Meaning> {
    let Event::Word(op, index) = event else { return None };
    let Op::Word(words) = automaton.op(op) else { return None };
    words.table.get(index).map(|entry| entry.meaning)
}
