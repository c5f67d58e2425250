//! Conditions that must refute nothing: the test of a loop whose back edge is refuted without one, and the
//! condition of a `wait` beside concurrent steps.

use motet_compiler::incremental::{LoopTest, is_used_up};

use super::context::Question;
use super::event_log::{Event, Flags, Id, State, meaning, mix};
use super::machine::Machine;
use crate::automaton::Meaning;
use crate::grammar::NodeKind;
use crate::subset::MAX_CONDITION_DEPTH;

/// Number of values tried for an argument beside `any`, bindings and the values named in the current step.
/// Each takes a proof of everything that is open. An argument that is open here is open when its turn
/// comes, so every condition that is begun can be completed.
const MOST_TRIED: usize = 3;

/// The shape of a condition that was just written.
pub(super) struct Last {
    /// The nesting depth of conditions in it.
    height: usize,
    pub(super) is_comparison: bool,
    /// It stands behind `and` or `or`.
    is_joined: bool,
}

impl Machine {
    /// Some fluent, or with `negated` some fluent under `not`, is a condition behind `more` that refutes
    /// nothing.
    pub(super) fn some_condition_holds(&mut self, state: &State, more: &[Event], negated: bool) -> bool {
        let mut events = more.to_vec();
        let is_negated = self.frame(state.frame).flags.has(Flags::NEGATED);
        if negated && !is_negated {
            events.push(Event::Open(NodeKind::Not));
        }
        let key = self.key(Question::Test, state.event, events.iter().copied());
        self.answer(key, |machine| {
            let count = u16::try_from(machine.context.automaton.fluents.len()).unwrap_or(0);
            (0..count).any(|fluent| machine.condition_holds(state, fluent, &mut events))
        })
    }

    pub(super) fn condition_holds(&mut self, state: &State, fluent: u16, events: &mut Vec<Event>) -> bool {
        let signature = self.context.automaton.signatures.fluents.get(usize::from(fluent));
        if !signature.is_some_and(|signature| signature.is_observable && signature.name != "monitored") {
            return false;
        }
        let before = events.len();
        events.push(Event::Open(NodeKind::Is(fluent)));
        let key = self.key(Question::Test, state.event, events.iter().copied());
        let holds = self.answer(key, |machine| machine.completes(state, fluent, 0, events));
        events.truncate(before);
        holds
    }

    /// Some arguments behind this one make a condition that refutes nothing.
    pub(super) fn completes_with(&mut self, state: &State, fluent: u16, place: usize, arg: Event) -> bool {
        self.completes(state, fluent, place + 1, &mut vec![arg])
    }

    /// Some arguments from the one at `place` on make a condition that refutes nothing.
    fn completes(&mut self, state: &State, fluent: u16, place: usize, events: &mut Vec<Event>) -> bool {
        let op =
            self.context.automaton.fluents.get(usize::from(fluent)).and_then(|args| args.get(place)).copied();
        let Some(op) = op else { return self.refutes_nothing(state.event, events) };
        let mut options = self.words_of(op, state.scope, None);
        let said = self.values_said(state.event);
        let mut tried = 0;
        options.retain(|option| match meaning(&self.context.automaton, *option) {
            None | Some(Meaning::Any) => true,
            Some(value) => {
                tried += 1;
                tried <= MOST_TRIED || said.contains(&value)
            }
        });
        // The first values are the least likely to be meant.
        options.reverse();
        options.into_iter().any(|option| {
            events.push(option);
            let holds = self.completes(state, fluent, place + 1, events);
            events.pop();
            holds
        })
    }

    /// The values named in the current step of the body.
    fn values_said(&self, event: Id) -> Vec<Meaning> {
        let before = self.arenas.entry(event).map_or(0, |said| said.before);
        let events = self.arenas.between(before, event).into_iter();
        events.filter_map(|event| meaning(&self.context.automaton, event)).collect()
    }

    /// A whole condition, the end of the log with `more` behind it, refutes nothing.
    fn refutes_nothing(&mut self, event: Id, more: &[Event]) -> bool {
        let Some((body, fluent, negated, args)) = self.test_of_loop(event, more) else {
            return self.verify_beside(event, more);
        };
        match self.test(body, fluent, negated, &args) {
            _ if is_used_up() => true,
            LoopTest::Holds if self.is_independent(event, more) => true,
            // The body is right without a test, so the back edge was refuted.
            LoopTest::Idle if !self.may_iterate(body) => false,
            LoopTest::Holds | LoopTest::Idle | LoopTest::Open => {
                let round = self.permits_round(body, Some((fluent, negated, &args)));
                is_used_up() || round.is_some_and(|facts| self.is_right_beside((body, facts), event, more))
            }
        }
    }

    /// Verifies everything beside a loop with a test that leaves certain facts at the end of the body. If
    /// another test that leaves the same facts was refuted, so is this one.
    fn is_right_beside(&mut self, (body, facts): (Id, u64), event: Id, more: &[Event]) -> bool {
        if self.is_independent(event, more) {
            return true;
        }
        let others = mix(self.key(Question::Beside, body, None), facts);
        let own = self.key(Question::Verify, event, more.iter().copied());
        if self.known(own).is_none() && self.known(others) == Some(false) {
            return false;
        }
        let is_right = self.verify(event, more);
        if !is_right {
            self.context.memo.put(others, false);
        }
        is_right
    }

    /// The body of a loop may end behind `event`, whatever the test.
    pub(super) fn may_iterate(&mut self, event: Id) -> bool {
        let key = self.key(Question::Round, event, None);
        self.answer(key, |machine| machine.permits_round(event, None).is_some())
            && self.verify_beside(event, &[Event::Close])
    }

    /// The loop needs no test; its body ended with the last event.
    pub(super) fn needs_no_test(&mut self, event: Id) -> bool {
        match self.arenas.entry(event) {
            Some(said) if event > 0 && said.event == Event::Close => {
                let body = said.below;
                self.may_iterate(body)
            }
            _ => self.verify(event, &[]),
        }
    }

    /// `and` or `or` may follow the condition that was just written.
    pub(super) fn may_join(&self, state: &State, outside: u8) -> bool {
        let last = self.last_condition(state.event);
        !last.is_joined && usize::from(outside) + last.height < MAX_CONDITION_DEPTH
    }

    /// The shape of the condition that ends the log.
    pub(super) fn last_condition(&self, event: Id) -> Last {
        let (mut closed, mut events) = (0usize, Vec::new());
        let mut log = self.arenas.back(event);
        for said in log.by_ref() {
            events.push(said.event);
            match said.event {
                Event::Close => closed += 1,
                Event::Open(_) => closed = closed.saturating_sub(1),
                _ => {}
            }
            if closed == 0 {
                break;
            }
        }
        let before = log.next().map(|said| said.event);
        let (mut open, mut height) = (Vec::new(), 0);
        for event in events.iter().rev() {
            match event {
                Event::Open(kind) => open.push(matches!(kind, NodeKind::Not | NodeKind::Group)),
                Event::Close => {
                    open.pop();
                }
                _ => {}
            }
            height = height.max(open.iter().filter(|counts| **counts).count());
        }
        Last {
            height,
            is_comparison: matches!(
                events.last(),
                Some(Event::Open(NodeKind::Get(_) | NodeKind::Field(_) | NodeKind::Count | NodeKind::Caught))
            ),
            is_joined: matches!(before, Some(Event::Joined(_))),
        }
    }

    /// The loop test that ends the log with `more` behind it: the event before the end of the loop's body,
    /// the fluent, its negation and its arguments.
    fn test_of_loop(&self, event: Id, more: &[Event]) -> Option<(Id, u16, bool, Vec<Event>)> {
        let asks = |event: &Event| matches!(event, Event::Open(NodeKind::Wait | NodeKind::If));
        if more.iter().any(asks) {
            return None;
        }
        let (mut said, mut log) = (Vec::new(), self.arenas.back(event));
        let mut is_closed = more.contains(&Event::Close);
        let mut body = if is_closed { event } else { 0 };
        while !is_closed {
            let entry = log.next()?;
            match entry.event {
                Event::Close => {
                    is_closed = true;
                    body = entry.below;
                }
                event
                @ (Event::Open(NodeKind::Not | NodeKind::Is(_)) | Event::Word(..) | Event::Bound(_)) => {
                    said.push(event);
                }
                _ => return None,
            }
        }
        said.reverse();
        said.extend(more.iter().copied().filter(|event| *event != Event::Close));
        let negated = said.first() == Some(&Event::Open(NodeKind::Not));
        let mut rest = said.into_iter().skip(usize::from(negated));
        let Some(Event::Open(NodeKind::Is(fluent))) = rest.next() else { return None };
        Some((body, fluent, negated, rest.collect()))
    }
}
