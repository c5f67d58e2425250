//! Repairs by calls: plans for unmet needs, and the facts that are missing.

use crate::declare::NeedDef;
use crate::ir::Condition;
use crate::plan::achievers::{CandidateCall, MAX_CANDIDATES, Subgoal};
use crate::plan::search::{Bounds, Root, Target, search};
use crate::prove::Prover;
use crate::prove::evaluation::CallFrame;

/// A repair is a short plan.
const BOUNDS: Bounds = Bounds { states: 20, calls: 6, depth: 4, plans: MAX_CANDIDATES };

impl Prover<'_> {
    /// Sequences of calls after which no need is refuted, the best first.
    pub(super) fn plans(
        &mut self,
        needs: &[NeedDef],
        frame: CallFrame<'_>,
        count: usize,
    ) -> Vec<Vec<CandidateCall>> {
        let root = Root::here(self);
        let bounds = Bounds { plans: count, ..BOUNDS };
        let found = search(self, &root, &[], Target { needs, frame, leaves_guards: true }, bounds);
        root.replay(self, &[]);
        found.plans
    }

    /// Facts that are each a first step towards the first refuted need.
    pub(super) fn first_refuted(&self, needs: &[NeedDef], frame: CallFrame<'_>) -> Vec<Subgoal> {
        let mut subgoals = Vec::new();
        for need in needs {
            let (value, each) = self.need(need, frame);
            if value.no.is_some() {
                let each = each.or(frame.each);
                self.subgoals(&need.condition, true, CallFrame { each, ..frame }, &mut subgoals);
                break;
            }
        }
        subgoals
    }

    pub(super) fn subgoals(
        &self,
        condition: &Condition,
        truth: bool,
        frame: CallFrame<'_>,
        subgoals: &mut Vec<Subgoal>,
    ) {
        let value = self.evaluate(condition, frame);
        if !(if truth { value.no } else { value.yes }).is_some() {
            return;
        }
        match condition {
            Condition::Not(inner) => self.subgoals(inner, !truth, frame, subgoals),
            Condition::All(parts) | Condition::AnyOf(parts) => {
                // Of a disjunction any part will do, of a conjunction each in its turn.
                let is_choice = matches!(condition, Condition::AnyOf(_)) == truth;
                for part in parts {
                    if is_choice || subgoals.is_empty() {
                        self.subgoals(part, truth, frame, subgoals);
                    }
                }
            }
            Condition::Fact(fact) => {
                let Some(key) = self.key(fact, frame) else { return };
                if truth || !key.is_pattern() {
                    subgoals.push((fact.fluent, key, truth));
                    return;
                }
                // That none holds: each that may hold has to go.
                let held = self.may_hold(fact.fluent, key).into_iter();
                subgoals.extend(held.map(|(key, _)| (fact.fluent, key, false)));
            }
            Condition::Literal(_)
            | Condition::Compare(..)
            | Condition::MonitoredMeasure(_)
            | Condition::MonitoredFluent(_)
            | Condition::Unknown => {}
        }
    }
}
