//! Questions to the checker: their keys in the memo of answers, and batches that one proof answers.
//!
//! Concurrent steps are proved together for each call that is tried. If a proof in which any of the calls
//! may stand refutes nothing, none of them is refuted; otherwise halves of them are asked.

use std::hash::{Hash, Hasher};
use std::sync::Arc;

use motet_compiler::incremental::is_used_up;
use motet_syntax::ast::Step;
use rustc_hash::FxHasher;

use super::context::Question;
use super::event_log::{Event, Id, State, mix};
use super::machine::Machine;
use super::oracle::{Argument, CallSite};
use super::proof_cursor::Transcript;
use crate::grammar::NodeKind;

impl Machine {
    /// Appends an event to the log.
    pub(crate) fn record(&mut self, below: Id, event: Event) -> Id {
        // The name of the policy decides nothing, unless a callable has the same name.
        let is_title =
            matches!(event, Event::Name(start, len) if below == 0 && !self.is_callable(start, len));
        let content = if is_title { 0 } else { self.content(event) };
        self.arenas.record(below, event, content)
    }

    fn is_callable(&self, start: u32, len: u32) -> bool {
        let name = self.bytes.get(start as usize..(start.saturating_add(len)) as usize).unwrap_or_default();
        self.context.automaton.signatures.callables.iter().any(|callable| callable.name.as_bytes() == name)
    }

    /// The hash of an event's content, wherever its bytes stand.
    fn content(&self, event: Event) -> u64 {
        let mut hasher = FxHasher::default();
        let mut spelled = |sort: u8, start: u32, len: u32| {
            sort.hash(&mut hasher);
            self.bytes.get(start as usize..(start.saturating_add(len)) as usize).hash(&mut hasher);
        };
        match event {
            Event::Bound(id) | Event::First(id) => {
                if let Some(name) = self.arenas.name(id) {
                    spelled(if matches!(event, Event::First(_)) { 4 } else { 1 }, name.start, name.len);
                }
            }
            Event::Text(start, len) => spelled(2, start, len),
            Event::Name(start, len) => spelled(3, start, len),
            _ => {
                // Zeros leave the state of this hasher at zero, and the first cases are zeros.
                5u8.hash(&mut hasher);
                event.hash(&mut hasher);
            }
        }
        mix(hasher.finish(), 0)
    }

    /// The key of a question about the log up to an event, with `more` behind it.
    pub(crate) fn key(&self, question: Question, event: Id, more: impl IntoIterator<Item = Event>) -> u64 {
        let said =
            more.into_iter().fold(self.arenas.hash(event), |hash, event| mix(hash, self.content(event)));
        mix(said, question as u64)
    }

    /// The answer to a question that was asked before.
    pub(crate) fn known(&self, key: u64) -> Option<bool> {
        self.context.memo.get(key)
    }

    /// The answer to a question; asks the checker only if it is not known, and if some effort is left.
    /// Without an answer it is yes.
    pub(crate) fn answer(&mut self, key: u64, ask: impl FnOnce(&mut Self) -> bool) -> bool {
        if let Some(answer) = self.context.memo.get(key) {
            return answer;
        }
        if is_used_up() {
            return true;
        }
        let answer = ask(self);
        if is_used_up() {
            return true;
        }
        self.context.memo.put(key, answer);
        answer
    }
}

/// A pause, as a step.
pub(super) const PAUSE: [Event; 2] = [Event::Open(NodeKind::Within), Event::Close];

/// Up to this many are asked one by one.
const FEW: usize = 2;

impl Machine {
    /// Probes all primitives, or all policies, that may stand at a place beside concurrent steps. Policies do
    /// more and are refuted more often, so they are asked apart. With the primitives goes a pause, which
    /// monitors ask for.
    pub(super) fn probe_callables(&mut self, site: CallSite, policies: bool) {
        let key = mix(self.key(Question::Probed, site.event, None), u64::from(policies));
        if is_used_up() || self.known(key).is_some() {
            return;
        }
        let context = Arc::clone(&self.context);
        let mut calls = Vec::new();
        for (callable, _) in
            (0..).zip(&context.automaton.callables).filter(|(_, made)| made.primitive.is_none() == policies)
        {
            let own = self.site_of(callable, site).filter(|site| site.shared);
            calls.extend(own.and_then(|site| self.likely_call(callable, &mut Vec::new(), site)));
        }
        if !policies && !site.cleans {
            calls.push(PAUSE.to_vec());
        }
        self.probe((site.event, site.event), &calls);
        if !is_used_up() {
            self.context.memo.put(key, true);
        }
    }

    /// Probes the values of an argument of a call.
    pub(super) fn probe_values(
        &mut self,
        callable: u16,
        given: &mut Vec<Argument>,
        values: &[Event],
        site: CallSite,
    ) {
        if !site.shared || is_used_up() {
            return;
        }
        let mut calls = Vec::new();
        for value in values {
            given.push(Argument::One(*value));
            calls.extend(self.likely_call(callable, given, site));
            given.pop();
        }
        self.probe((site.event, site.event), &calls);
    }

    /// Probes the values of the last argument of a fluent that is waited for.
    pub(super) fn probe_conditions(&mut self, state: &State, values: &[Event]) {
        let event = state.event;
        let Some((fluent, place)) = self.fluent_so_far(event) else { return };
        let params = self.context.automaton.fluents.get(usize::from(fluent)).map_or(0, Vec::len);
        let Some(wait) = self.open_wait(event).filter(|_| place + 1 == params) else { return };
        let mut choices: Vec<Vec<Event>> = values.iter().map(|value| vec![*value]).collect();
        choices.retain(|choice| !self.is_independent(event, choice));
        self.probe((wait, event), &choices);
    }

    /// The event before the `wait` whose condition is being written.
    fn open_wait(&self, event: Id) -> Option<Id> {
        let is_inside = |event: Event| {
            matches!(event, Event::Open(NodeKind::Not | NodeKind::Is(_)) | Event::Word(..) | Event::Bound(_))
        };
        let begin = self.arenas.back(event).find(|said| !is_inside(said.event))?;
        (begin.event == Event::Open(NodeKind::Wait)).then_some(begin.below)
    }

    /// Verifies the current step with each of several continuations behind `event`, as far as common proofs
    /// tell. The continuations are steps that begin behind `from`.
    fn probe(&mut self, (from, event): (Id, Id), choices: &[Vec<Event>]) {
        let mut open: Vec<(u64, &[Event])> = Vec::new();
        for choice in choices {
            let key = self.key(Question::Verify, event, choice.iter().copied());
            if self.known(key).is_none() {
                open.push((key, choice));
            }
        }
        let mut left = vec![open.as_slice()];
        while let Some(choices) = left.pop() {
            if is_used_up() {
                return;
            }
            if choices.len() <= FEW {
                continue;
            }
            if self.permits_any((from, event), choices.iter().map(|(_, choice)| *choice)) {
                choices.iter().for_each(|(key, _)| self.context.memo.put(*key, true));
            } else {
                let (first, second) = choices.split_at(choices.len() / 2);
                left.extend([first, second]);
            }
        }
    }

    /// Verifies the current step with all continuations at once. If that fails, some of them may still be
    /// right.
    fn permits_any<'c>(
        &mut self,
        (from, event): (Id, Id),
        choices: impl Iterator<Item = &'c [Event]>,
    ) -> bool {
        let (before, events) = self.arenas.present(from, &[Event::Hole]);
        let begun = self.arenas.between(from, event);
        let transcript = Transcript { context: &self.context, arenas: &self.arenas, bytes: &self.bytes };
        let choice =
            choices.map(|choice| transcript.step(&[&begun, choice].concat())).collect::<Option<Vec<Step>>>();
        let step = choice.and_then(|choice| transcript.step_with(&events, &choice));
        let draft = self.oracle.verifier.follow(&transcript, before);
        draft.zip(step).is_some_and(|(draft, step)| draft.permits_any(&self.context.session, &step))
    }
}
