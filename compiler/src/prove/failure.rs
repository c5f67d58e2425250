//! Failures on their way out, to the handler that takes them.

use super::Prover;
use super::collector::Enclosing;
use crate::declare::PrimitiveDef;
use crate::ir::Failure;

impl Prover<'_> {
    /// The state as it is fails with `kind`: the innermost handler below `depth` that takes it sees the state.
    pub(crate) fn throw(&mut self, kind: Failure, depth: usize) {
        let Self { enclosing, facts, .. } = self;
        for enclosing in enclosing.iter_mut().take(depth).rev() {
            let Enclosing::Try { catches } = enclosing else { continue };
            let taker =
                catches.iter_mut().find(|(on, ..)| on.as_ref().is_none_or(|kinds| kinds.contains(&kind)));
            if let Some((_, states, kinds)) = taker {
                // The same state for another kind adds nothing but the kind.
                states.see(facts);
                if !kinds.contains(&kind) {
                    kinds.push(kind);
                }
                return;
            }
        }
    }

    /// The state as it is fails with any of the kinds that a primitive can end in.
    pub(crate) fn throw_all(&mut self, def: &PrimitiveDef) {
        if self.enclosing.is_empty() {
            return;
        }
        let depth = self.enclosing.len();
        // A handler sees one state once, however many kinds reach it.
        for kind in &def.fails {
            self.throw(*kind, depth);
        }
    }

    /// Enclosing monitors may fire in the state as it is.
    pub(crate) fn see_states(&mut self) {
        let Self { enclosing, facts, .. } = self;
        for enclosing in enclosing {
            if let Enclosing::Monitor { states } = enclosing {
                states.see(facts);
            }
        }
    }
}
