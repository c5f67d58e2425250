//! What a machine remembers, in lists that only grow and are cut back: who called the rule, what was said, what was bound.
//! A state of a machine names a place in each, so it is a small value, and going back is forgetting it.

use crate::automaton::{BlockRole, Constant, NodeKind, OpId};

/// A place in an arena; the first entry of each is the bottom.
pub(crate) type Id = u32;

/// A place in a machine.
#[derive(Clone, Copy, Debug)]
pub(crate) struct State {
    pub(crate) op: OpId,
    /// How far into it; of a number, what it has so far.
    pub(crate) pos: u32,
    /// Of a word the range of the list that is left, of a choice what is known and what is open, of a number its digits.
    pub(crate) lo: u32,
    pub(crate) hi: u32,
    pub(crate) frame: Id,
    pub(crate) event: Id,
    pub(crate) scope: Id,
}

/// `lo` and `hi` of a word or a choice at which nobody has looked yet.
pub(crate) const UNSEEN: u32 = u32::MAX;

impl State {
    /// Of what may be left out: the state beside it, where it is.
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

/// A rule that was called.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CallFrame {
    pub(crate) below: Id,
    pub(crate) ret: OpId,
    /// How many bytes follow its end at least.
    pub(crate) rest: u32,
    /// How many members it has.
    pub(crate) count: u8,
    /// How many blocks it is in, below the policy's own.
    pub(crate) depth: u8,
    /// How many of them are proved to a fixed point.
    pub(crate) fix: u8,
    /// How many conditions it is in.
    pub(crate) conditions: u8,
    pub(crate) flags: Flags,
    pub(crate) slot: BlockRole,
    /// What was bound where it began.
    pub(crate) scope: Id,
}

/// What is so in a rule and in all that it calls.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) struct Flags(u8);

impl Flags {
    /// What a step does may refute what stands elsewhere: in another branch, or in a reaction.
    pub(crate) const SHARED: Self = Self(1);
    /// In the body of a `try`.
    pub(crate) const TRIED: Self = Self(2);
    /// The condition has to be one that refutes nothing.
    pub(crate) const STRICT: Self = Self(4);
    /// Under one `not`.
    pub(crate) const NEGATED: Self = Self(8);
    /// The condition need not be observable.
    pub(crate) const GOAL: Self = Self(16);
    /// A condition that tells nothing of the facts refutes nothing.
    pub(crate) const LOOSE: Self = Self(32);

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

/// Something that was said.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Event {
    /// Something with parts begins.
    Open(NodeKind),
    /// It ends.
    Close,
    /// A word of the list of an operation.
    Word(OpId, u32),
    /// A name that is bound.
    Bound(Id),
    /// A text: these bytes of the machine.
    Text(u32, u32),
    /// A new name: these bytes of the machine.
    Name(u32, u32),
    /// A number: units, and how many decimals they are.
    Number(i64, u8),
    /// A value that needs no bytes.
    Constant(Constant),
    /// A text that describes nothing, where any would do.
    AnyText,
    /// Where the next step will stand.
    Hole,
    /// Another condition follows beside the one before, of which all hold, or any.
    Joined(NodeKind),
}

/// Something that was said, and what was said before.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LogEntry {
    pub(crate) below: Id,
    pub(crate) event: Event,
    /// The last event before the step of the policy's body in which this is.
    pub(crate) before: Id,
    /// A hash of everything that was said up to here. What is said again after a way back has the same.
    pub(crate) hash: u64,
}

/// A name that was bound.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Name {
    pub(crate) below: Id,
    /// Its bytes in the machine.
    pub(crate) start: u32,
    pub(crate) len: u32,
    pub(crate) ty: u16,
}

/// The arenas.
#[derive(Clone, Debug)]
pub(crate) struct Arenas {
    pub(crate) frames: Vec<CallFrame>,
    pub(crate) said: Vec<LogEntry>,
    pub(crate) names: Vec<Name>,
    pub(crate) lists: Vec<u32>,
    /// What goes on where something was left out, beside the machine that wrote it.
    pub(crate) lookaheads: Vec<State>,
}

/// How long the arenas were.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ArenaMark {
    frames: usize,
    said: usize,
    names: usize,
    lists: usize,
    pub(super) lookaheads: usize,
}

impl CallFrame {
    /// Where nothing is open.
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
        }
    }
}

impl Arenas {
    pub(crate) fn new() -> Self {
        let said = LogEntry { below: 0, event: Event::Close, before: 0, hash: 0 };
        let name = Name { below: 0, start: 0, len: 0, ty: u16::MAX };
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

    /// Says something in the same step of the body; `content` is a hash of it.
    pub(crate) fn record(&mut self, below: Id, event: Event, content: u64) -> Id {
        let (before, hash) = self.entry(below).map_or((0, 0), |said| (said.before, said.hash));
        let id = end(&self.said);
        self.said.push(LogEntry { below, event, before, hash: mix(hash, content) });
        id
    }

    /// The last event of a step of the body: the next one begins another.
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

    /// The names from the latest on.
    pub(crate) fn in_scope(&self, scope: Id) -> impl Iterator<Item = (Id, &Name)> + '_ {
        let first = self.name(scope).map(|name| (scope, name));
        std::iter::successors(first, |(_, name)| self.name(name.below).map(|below| (name.below, below)))
    }
}

/// The content of the event that ends a step of the body.
const LAST: u64 = 0x6c61_7374;

/// A hash with one thing more behind it (the finaliser of splitmix64).
pub(crate) fn mix(hash: u64, more: u64) -> u64 {
    let mut mixed = hash.rotate_left(17).wrapping_add(0x9e37_79b9_7f4a_7c15) ^ more;
    mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    mixed ^ (mixed >> 31)
}

fn end<T>(list: &[T]) -> Id {
    u32::try_from(list.len()).unwrap_or(u32::MAX)
}
