//! State of the prover at a program point, and of control around it.

use rustc_hash::FxHashMap;

use super::collector::Enclosing;
use super::effects::PerceptionLifetime;
use super::{Volatile, Watched};
use crate::environment::Environment;
use crate::facts::{Cause, FactStore, PathPartition, TruthSet};
use crate::ir::{Fluent, StepId};

/// Abstract state at a program point.
#[derive(Clone, Debug, Default)]
pub(crate) struct AbstractState<'w> {
    pub(crate) facts: FactStore<'w>,
    pub(crate) lasting: FxHashMap<StepId, PerceptionLifetime>,
    pub(super) watched: Vec<Watched>,
    /// Facts that a reaction may change at any moment, with their values.
    pub(super) volatile: Vec<Volatile>,
    /// Paths of earlier joins, the latest last.
    pub(super) partitions: Vec<PathPartition>,
    /// Position in the trail at which the round of the innermost loop began.
    pub(super) head: Option<usize>,
    /// Position in the trail before the effects of reactions at this point.
    pub(super) before_reactions: usize,
}

impl<'w> AbstractState<'w> {
    /// State before the first step, and the table of bindings that are not stale.
    pub(super) fn at_start(environment: &'w Environment) -> (Self, Fluent) {
        let mut facts = FactStore::above(&environment.facts);
        let fresh = facts.add_table(TruthSet::yes(Cause::NOTHING));
        (Self { facts, ..Self::default() }, fresh)
    }

    /// Lays the state above the facts of an environment, which must be those that it was lifted from.
    pub(super) fn over(self, environment: &Environment) -> AbstractState<'_> {
        AbstractState {
            facts: self.facts.over(&environment.facts),
            lasting: self.lasting,
            watched: self.watched,
            volatile: self.volatile,
            partitions: self.partitions,
            head: self.head,
            before_reactions: self.before_reactions,
        }
    }

    /// Takes the state without the facts of its environment.
    pub(super) fn lift(self) -> AbstractState<'static> {
        AbstractState {
            facts: self.facts.lift(),
            lasting: self.lasting,
            watched: self.watched,
            volatile: self.volatile,
            partitions: self.partitions,
            head: self.head,
            before_reactions: self.before_reactions,
        }
    }
}

/// Control flow around the step that is being proved.
#[derive(Clone, Debug, Default)]
pub(crate) struct Control {
    pub(super) enclosing: Vec<Enclosing>,
    /// The call that is being proved.
    pub(crate) here: Option<StepId>,
    /// False if no path leads here.
    pub(crate) live: bool,
    /// Number of enclosing fixed points.
    pub(super) fixpoints: usize,
    /// Number of enclosing runs that only find the effects of a reaction.
    pub(super) rehearsals: usize,
}
