//! Failure flow: from a failing step to the handler that catches it.

use super::Prover;
use super::collector::Enclosing;
use crate::declare::PrimitiveDef;
use crate::ir::Failure;

impl Prover<'_> {
    /// Throws a failure in the present state: the innermost handler below `depth` that catches it collects
    /// the state.
    pub(crate) fn throw(&mut self, kind: Failure, depth: usize) {
        let (enclosing, facts) = (&mut self.control.enclosing, &self.state.facts);
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

    /// Throws every failure of a primitive in the present state.
    pub(crate) fn throw_all(&mut self, def: &PrimitiveDef) {
        if self.control.enclosing.is_empty() {
            return;
        }
        let depth = self.control.enclosing.len();
        // A handler sees one state once, however many kinds reach it.
        for kind in &def.fails {
            self.throw(*kind, depth);
        }
    }

    /// Lets enclosing monitors collect the present state, in which they may fire.
    pub(crate) fn see_states(&mut self) {
        let (enclosing, facts) = (&mut self.control.enclosing, &self.state.facts);
        for enclosing in enclosing {
            if let Enclosing::Monitor { states } = enclosing {
                states.see(facts);
            }
        }
    }
}
