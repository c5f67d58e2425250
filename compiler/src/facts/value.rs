//! Keys of facts, and their abstract truth values. A key is a single fact or a pattern as one number; a value
//! is a set of {true, false, unobserved}, each with the step that caused it.

use smol_str::SmolStr;

use crate::ir::{Entity, Fluent, StepId};

/// Arguments of a fact, 16 bits each, the first lowest.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub(crate) struct FactKey(pub(crate) u64);

/// Argument of a key that stands for `any`.
pub(crate) const ANY: u16 = u16::MAX;

impl FactKey {
    /// Pattern of every fact of a fluent.
    pub(crate) const ALL: Self = Self(u64::MAX);

    pub(crate) fn new(args: impl Iterator<Item = u16>) -> Self {
        Self(args.take(4).enumerate().fold(0, |key, (index, arg)| key | (u64::from(arg) << (16 * index))))
    }

    pub(crate) fn arg(self, index: usize) -> u16 {
        u16::try_from((self.0 >> (16 * index.min(3))) & 0xffff).unwrap_or(ANY)
    }

    /// Replaces one argument.
    pub(crate) fn with(self, index: usize, arg: u16) -> Self {
        let shift = 16 * index.min(3);
        Self((self.0 & !(0xffff << shift)) | (u64::from(arg) << shift))
    }

    /// Mask of the arguments that are `any`.
    #[inline]
    pub(super) fn any(self) -> u64 {
        const HIGH: u64 = 0x8000_8000_8000_8000;
        // The high bit of each part of the complement that is zero, found for all four at once.
        let rest = !self.0;
        let zero = !(((rest & !HIGH) + !HIGH) | rest) & HIGH;
        (zero >> 15) * 0xffff
    }

    /// Number of arguments that are `any`.
    pub(super) fn width(self) -> u32 {
        self.any().count_ones() / 16
    }

    pub(crate) fn is_pattern(self) -> bool {
        self.any() != 0
    }

    /// First argument; `None` if it is `any`.
    pub(super) fn head(self) -> Option<u16> {
        let head = self.arg(0);
        (head != ANY).then_some(head)
    }

    /// Facts that two patterns share, if neither covers the other.
    pub(super) fn crossing(self, other: Self) -> Option<Self> {
        let (one, two) = (self.any(), other.any());
        let agree = (self.0 ^ other.0) & !one & !two == 0;
        // What is `any` on one side is taken from the other.
        let shared = (self.0 & !one) | (other.0 & one);
        (agree && one & !two != 0 && two & !one != 0).then_some(Self(shared))
    }

    /// Returns whether two patterns share a fact.
    pub(crate) fn meets(self, other: Self) -> bool {
        (self.0 ^ other.0) & !self.any() & !other.any() == 0
    }

    /// Returns whether every fact of `other` belongs to this pattern.
    pub(crate) fn covers(self, other: Self) -> bool {
        (self.0 ^ other.0) & !self.any() == 0
    }
}

/// A fluent with a key.
pub(crate) type Atom = (Fluent, FactKey);

/// Spelling of a fact: "`on(cup, table)`".
pub(crate) fn show(name: &str, key: FactKey, arity: usize, arg: impl Fn(usize, u16) -> SmolStr) -> String {
    let args: Vec<_> = (0..arity)
        .map(|index| {
            let value = key.arg(index);
            if value == ANY { SmolStr::new_static("any") } else { arg(index, value) }
        })
        .collect();
    format!("`{name}({})`", args.join(", "))
}

/// Argument of a key that stands for an entity.
pub(crate) fn arg(entity: Entity) -> u16 {
    entity.0
}

/// Cause of a value; [`Cause::NONE`] means that the value is not in the set.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub(crate) struct Cause(u32);

impl Cause {
    /// The value is not in the set.
    pub(crate) const NONE: Self = Self(0);
    /// No step: the fact is unobserved, or false in a closed world.
    pub(crate) const NOTHING: Self = Self(1);
    /// The scene, the state, the card or `initially`.
    pub(crate) const START: Self = Self(2);

    /// Mark of a step that saw the fact, which then lasts only so long.
    const SEEN: u32 = 1 << 31;
    /// Mark of a fact of the start that was seen before it.
    const AT_START: u32 = 1 << 30;
    /// Several steps that saw the fact, on paths that have met.
    pub(crate) const SEEN_BY_SEVERAL: Self = Self(u32::MAX);

    /// Step of the policy as a cause.
    pub(crate) fn step(id: StepId) -> Self {
        Self(id.0.saturating_add(3).min(Self::AT_START - 1))
    }

    /// Perception before the start, by the position of its lifetime in the environment.
    pub(crate) fn seen_at_start(index: usize) -> Self {
        let index = u32::try_from(index).unwrap_or(u32::MAX).min(Self::AT_START - 2);
        Self(index | Self::AT_START | Self::SEEN)
    }

    /// Position of the lifetime, if the fact was seen before the start.
    pub(crate) fn as_seen_at_start(self) -> Option<usize> {
        let is_seen = self != Self::SEEN_BY_SEVERAL && self.0 & Self::AT_START != 0;
        is_seen.then_some((self.0 & (Self::AT_START - 1)) as usize)
    }

    /// Returns whether the fact is one of the start.
    pub(crate) fn is_start(self) -> bool {
        self == Self::START || self.as_seen_at_start().is_some()
    }

    /// Step that saw the fact.
    pub(crate) fn seen_by(id: StepId) -> Self {
        Self(Self::step(id).0 | Self::SEEN)
    }

    /// The step, if a step is the cause.
    pub(crate) fn as_step(self) -> Option<StepId> {
        let step = (self.0 & !Self::SEEN).checked_sub(3);
        step.filter(|_| self.0 & Self::AT_START == 0).map(StepId)
    }

    /// The cause, if the fact lasts only so long.
    pub(crate) fn seen(self) -> Option<Self> {
        (self.0 & Self::SEEN != 0).then_some(self)
    }

    /// Cause at a join of paths: the fact lasts no longer than what one of them saw.
    pub(crate) fn join(self, other: Self) -> Self {
        match (self.seen(), other.seen()) {
            (Some(one), Some(two)) if one != two => Self::SEEN_BY_SEVERAL,
            (None, Some(seen)) => seen,
            (_, _) => self.or(other),
        }
    }

    pub(crate) fn is_some(self) -> bool {
        self.0 != 0
    }

    pub(crate) fn or(self, other: Self) -> Self {
        if self.is_some() { self } else { other }
    }
}

/// Set of truth values with their causes. Not empty in a reachable state.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) struct TruthSet {
    pub(crate) yes: Cause,
    pub(crate) no: Cause,
    pub(crate) open: Cause,
}

impl TruthSet {
    pub(crate) const NOTHING_KNOWN: Self = Self { yes: Cause::NONE, no: Cause::NONE, open: Cause::NOTHING };

    pub(crate) fn yes(cause: Cause) -> Self {
        Self { yes: cause, ..Self::default() }
    }

    pub(crate) fn no(cause: Cause) -> Self {
        Self { no: cause, ..Self::default() }
    }

    pub(crate) fn open(cause: Cause) -> Self {
        Self { open: cause, ..Self::default() }
    }

    pub(crate) fn of(truth: bool, cause: Cause) -> Self {
        if truth { Self::yes(cause) } else { Self::no(cause) }
    }

    /// Union, as at a join of paths. The causes of `self` win, but for those that saw the fact.
    pub(crate) fn join(self, other: Self) -> Self {
        Self { yes: self.yes.join(other.yes), no: self.no.join(other.no), open: self.open.or(other.open) }
    }

    /// Returns whether both sets hold the same truth values, whatever their causes.
    pub(crate) fn same_set(self, other: Self) -> bool {
        self.yes.is_some() == other.yes.is_some()
            && self.no.is_some() == other.no.is_some()
            && self.open.is_some() == other.open.is_some()
    }

    /// Perceptions that limit how long the fact is true or false.
    fn seen(self) -> [Option<Cause>; 2] {
        [self.yes.seen(), self.no.seen()]
    }

    /// Returns whether both sets hold the same truth values, and for as long.
    pub(crate) fn lasts_as(self, other: Self) -> bool {
        self.same_set(other) && self.seen() == other.seen()
    }

    /// The truth values, and how long they last.
    pub(super) fn known(self) -> (bool, bool, bool, [Option<Cause>; 2]) {
        (self.yes.is_some(), self.no.is_some(), self.open.is_some(), self.seen())
    }

    /// Value after a write of `new` that may have been about another fact: on paths where both say the same,
    /// that; on others unobserved.
    pub(crate) fn maybe(self, new: Self, cause: Cause) -> Self {
        if self.same_set(new) {
            return self.join(new);
        }
        // What the run has perhaps seen again, it perhaps believes for a time.
        let kept = |own: Cause, new: Cause| {
            if own.is_some() { own.join(new) } else { new.seen().unwrap_or(own) }
        };
        let rest = Self::open(cause);
        if new.is_true() {
            Self { yes: kept(self.yes, new.yes), ..rest }
        } else if new.is_false() {
            Self { no: kept(self.no, new.no), ..rest }
        } else {
            rest
        }
    }

    pub(crate) fn is_true(self) -> bool {
        self.yes.is_some() && !self.no.is_some() && !self.open.is_some()
    }

    pub(crate) fn is_false(self) -> bool {
        self.no.is_some() && !self.yes.is_some() && !self.open.is_some()
    }

    pub(crate) fn not(self) -> Self {
        Self { yes: self.no, no: self.yes, open: self.open }
    }

    /// Possible values of a conjunction.
    pub(crate) fn and(self, other: Self) -> Self {
        let both = self.yes.is_some() && other.yes.is_some();
        let unfalse =
            (self.yes.is_some() || self.open.is_some()) && (other.yes.is_some() || other.open.is_some());
        Self {
            yes: if both { self.yes } else { Cause::NONE },
            no: self.no.or(other.no),
            open: if unfalse { self.open.or(other.open) } else { Cause::NONE },
        }
    }

    /// Possible values of a disjunction.
    pub(crate) fn or(self, other: Self) -> Self {
        self.not().and(other.not()).not()
    }

    /// Value after an observation that the fact is `truth`; `None` if it cannot be.
    pub(crate) fn narrow(self, truth: bool, cause: Cause) -> Option<Self> {
        let known = if truth { self.yes } else { self.no };
        if known.is_some() {
            return Some(Self::of(truth, known));
        }
        self.open.is_some().then(|| Self::of(truth, cause))
    }
}

/// A fact or pattern as one number, sorted in the order of writing: patterns first, the widest before the
/// others, so that the facts that they cover are written later; then by fluent and key.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct Rank(pub(super) u128);

impl Rank {
    /// Number of arguments of a key that are not `any`, for a single fact.
    const SINGLE: u32 = 4;

    pub(super) fn of((fluent, key): Atom) -> Self {
        let narrow = Self::SINGLE.saturating_sub(key.width());
        Self(u128::from(narrow) << 80 | u128::from(fluent.0) << 64 | u128::from(key.0))
    }

    pub(super) fn atom(self) -> Atom {
        (Fluent((self.0 >> 64) as u16), FactKey(self.0 as u64))
    }

    pub(super) fn is_pattern(self) -> bool {
        self.0 >> 80 < u128::from(Self::SINGLE)
    }

    /// Sorts facts and patterns, and removes duplicates.
    pub(super) fn each_once(atoms: impl Iterator<Item = Self>) -> Vec<Self> {
        let mut ranks: Vec<_> = atoms.collect();
        ranks.sort_unstable();
        ranks.dedup();
        ranks
    }
}
