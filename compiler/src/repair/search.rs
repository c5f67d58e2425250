//! Backward search from unmet needs, on the facts as they would be.

use motet_syntax::Span;

use super::{MAX_CALLS, MAX_DEPTH, MAX_TRIES};
use crate::declare::NeedDef;
use crate::facts::Cause;
use crate::ir::Condition;
use crate::plan::achievers::{Achiever, CandidateCall, MAX_CANDIDATES, Subgoal};
use crate::prove::Prover;
use crate::prove::effects::FactChange;
use crate::prove::evaluation::CallFrame;

impl Prover<'_> {
    /// Sequences of calls after which all needs hold, the shortest first.
    pub(super) fn plans(&mut self, needs: &[NeedDef], frame: CallFrame<'_>) -> Vec<Vec<CandidateCall>> {
        let mut plans = Vec::new();
        let mut tries = MAX_TRIES;
        for subgoal in self.first_refuted(needs, frame) {
            for achiever in self.achievers(subgoal) {
                let mark = self.state.facts.mark();
                let mut calls = Vec::new();
                let is_found = self.perform(&achiever, MAX_DEPTH, &mut tries, &mut calls)
                    && self.satisfy(needs, frame, MAX_DEPTH, &mut tries, &mut calls);
                self.back_to(mark);
                if is_found && !plans.contains(&calls) {
                    plans.push(calls);
                }
            }
        }
        plans.sort_by_key(Vec::len);
        plans.truncate(MAX_CANDIDATES);
        plans
    }

    /// Extends `calls`, and the facts with them, until no need is refuted.
    pub(super) fn satisfy(
        &mut self,
        needs: &[NeedDef],
        frame: CallFrame<'_>,
        depth: usize,
        tries: &mut usize,
        calls: &mut Vec<CandidateCall>,
    ) -> bool {
        loop {
            let subgoals = self.first_refuted(needs, frame);
            if subgoals.is_empty() {
                // Either all is well, or what is refuted is no fact that a step could change.
                return needs.iter().all(|need| !self.need(need, frame).0.no.is_some());
            }
            if depth == 0 || calls.len() >= MAX_CALLS {
                return false;
            }
            let before = calls.len();
            let is_found = subgoals.into_iter().any(|subgoal| {
                self.achievers(subgoal).into_iter().any(|achiever| {
                    let mark = self.state.facts.mark();
                    let is_found = self.perform(&achiever, depth - 1, tries, calls);
                    if !is_found {
                        self.back_to(mark);
                        calls.truncate(before);
                    }
                    is_found
                })
            });
            if !is_found {
                return false;
            }
        }
    }

    /// Achieves the needs of a call, and applies it. Returns false if that fails; the caller then restores
    /// facts and calls.
    pub(super) fn perform(
        &mut self,
        achiever: &Achiever<'_>,
        depth: usize,
        tries: &mut usize,
        calls: &mut Vec<CandidateCall>,
    ) -> bool {
        let library = self.library;
        let Achiever { call, subgoal, when } = achiever;
        let Some(def) = library.primitive(call.primitive) else { return false };
        let Some(left) = tries.checked_sub(1) else { return false };
        *tries = left;
        if calls.contains(call) {
            return false;
        }
        let frame = CallFrame { args: &call.args, result: call.result, each: None };
        let is_met = match when {
            None => self.satisfy(&def.needs, frame, depth, tries, calls),
            // First what the effect stands under: it says which of several things is meant.
            Some((when, each)) => {
                let first =
                    NeedDef { condition: (*when).clone(), each: None, when: None, span: Span::default() };
                let needs: Vec<_> = std::iter::once(first).chain(def.needs.iter().cloned()).collect();
                self.satisfy(&needs, CallFrame { each: *each, ..frame }, depth, tries, calls)
            }
        };
        if !is_met || calls.len() >= MAX_CALLS {
            return false;
        }
        let (mut makes, mut unsettles): (Vec<FactChange>, Vec<FactChange>) = Default::default();
        self.changes(&def.makes, frame, &mut makes);
        self.changes(&def.unsettles, frame, &mut unsettles);
        self.unsettle(&unsettles, Cause::NOTHING);
        self.make(&makes, Cause::NOTHING);
        calls.push(call.clone());
        let (fluent, key, truth) = *subgoal;
        let holds = if key.is_pattern() { None } else { Some(self.read(fluent, key)) };
        holds.is_none_or(|value| if truth { value.is_true() } else { value.is_false() })
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
