//! Many questions answered by one proof. What runs at once is proved as a whole for each call that is tried; where a proof in
//! which any of them may stand refutes nothing, none of them is refuted.

use std::sync::Arc;

use motet_syntax::ast::Step;

use super::event_log::{Event, Id, State};
use super::machine::Machine;
use super::memo::Question;
use super::oracle::{Argument, CallSite};
use super::proof_cursor::Transcript;
use crate::automaton::NodeKind;

/// As few as these are asked one by one.
const FEW: usize = 2;

impl Machine {
    /// Answers for all primitives that may stand at a place beside what runs at once, as far as one proof can. A policy does more and
    /// is refuted more often: it is asked alone.
    pub(super) fn probe_callables(&mut self, site: CallSite) {
        let key = self.key(Question::Probed, site.event, None);
        if self.known(key).is_some() {
            return;
        }
        self.context.memo.put(key, true);
        let context = Arc::clone(&self.context);
        let mut calls = Vec::new();
        for (callable, _) in
            (0..).zip(&context.automaton.callables).filter(|(_, made)| made.primitive.is_some())
        {
            let own = self.site_of(callable, site).filter(|site| site.shared);
            calls.extend(own.and_then(|site| self.likely_call(callable, &mut Vec::new(), site)));
        }
        self.probe((site.event, site.event), &calls);
    }

    /// The same for the values of an argument.
    pub(super) fn probe_values(
        &mut self,
        callable: u16,
        given: &mut Vec<Argument>,
        values: &[Event],
        site: CallSite,
    ) {
        if !site.shared {
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

    /// The same for the values of an argument of a fluent that is waited for, the last one.
    pub(super) fn probe_conditions(&mut self, state: &State, values: &[Event]) {
        let event = state.event;
        let Some((fluent, place)) = self.fluent_so_far(event) else { return };
        let params = self.context.automaton.fluents.get(usize::from(fluent)).map_or(0, Vec::len);
        let Some(wait) = self.open_wait(event).filter(|_| place + 1 == params) else { return };
        let ways: Vec<Vec<Event>> = values
            .iter()
            .filter(|value| !self.is_independent(event, &[**value]))
            .map(|value| vec![*value])
            .collect();
        self.probe((wait, event), &ways);
    }

    /// The event before the `wait` whose condition is being written and no other.
    fn open_wait(&self, event: Id) -> Option<Id> {
        let mut at = event;
        loop {
            let said = self.arenas.entry(at).filter(|_| at > 0)?;
            at = said.below;
            match said.event {
                Event::Open(NodeKind::Wait) => return Some(at),
                Event::Open(NodeKind::Not | NodeKind::Is(_)) | Event::Word(..) | Event::Bound(_) => {}
                _ => return None,
            }
        }
    }

    /// Answers whether the step of the body is no error with each of some ways to go on behind `event`, where a proof of many of
    /// them tells. They are steps that begin behind `from`.
    fn probe(&mut self, (from, event): (Id, Id), ways: &[Vec<Event>]) {
        let mut open: Vec<(u64, &[Event])> = Vec::new();
        for way in ways {
            let key = self.key(Question::Verify, event, way.iter().copied());
            if self.known(key).is_none() {
                open.push((key, way));
            }
        }
        let mut left = vec![open.as_slice()];
        while let Some(ways) = left.pop() {
            if ways.len() <= FEW {
                continue;
            }
            if self.permits_any((from, event), ways.iter().map(|(_, way)| *way)) {
                ways.iter().for_each(|(key, _)| self.context.memo.put(*key, true));
            } else {
                let (first, second) = ways.split_at(ways.len() / 2);
                left.extend([first, second]);
            }
        }
    }

    /// Whether the step of the body that is being written is no error, whichever of some ways goes on behind `event`; where it
    /// is one, that may be due to some of them.
    fn permits_any<'c>(&mut self, (from, event): (Id, Id), ways: impl Iterator<Item = &'c [Event]>) -> bool {
        let before = self.arenas.entry(from).map_or(0, |said| said.before);
        let mut events = self.arenas.between(before, from);
        events.push(Event::Hole);
        let begun = self.arenas.between(from, event);
        let transcript = Transcript { context: &self.context, arenas: &self.arenas, bytes: &self.bytes };
        let choice = ways.map(|way| transcript.step(&[&begun, way].concat())).collect::<Option<Vec<Step>>>();
        let step = choice.and_then(|choice| transcript.step_with(&events, &choice));
        let draft = self.oracle.verifier.follow(&transcript, before);
        draft.zip(step).is_some_and(|(draft, step)| draft.permits_any(&self.context.session, &step))
    }
}
