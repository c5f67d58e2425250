//! Abstract truth values: sets of {true, false, unobserved}, each with the step that caused it.

use crate::ir::StepId;

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

    /// Step of the policy as a cause.
    pub(crate) fn step(id: StepId) -> Self {
        Self(id.0.saturating_add(3))
    }

    /// The step, if a step is the cause.
    pub(crate) fn as_step(self) -> Option<StepId> {
        self.0.checked_sub(3).map(StepId)
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

    /// Union, as at a join of paths. The causes of `self` win.
    pub(crate) fn join(self, other: Self) -> Self {
        Self { yes: self.yes.or(other.yes), no: self.no.or(other.no), open: self.open.or(other.open) }
    }

    /// Returns whether both sets hold the same truth values, whatever their causes.
    pub(crate) fn same_set(self, other: Self) -> bool {
        self.yes.is_some() == other.yes.is_some()
            && self.no.is_some() == other.no.is_some()
            && self.open.is_some() == other.open.is_some()
    }

    /// Value after a write of `new` that may have been about another fact: the same, or unobserved.
    pub(crate) fn maybe(self, new: Self, cause: Cause) -> Self {
        if self.same_set(new) { self } else { Self::open(cause) }
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
