//! Conditions that have to refute nothing: the test of a loop whose back edge is wrong without one, and what is waited for
//! beside something that runs at once.

use motet_compiler::draft::Test;

use super::event_log::{Event, Flags, Id, State, mix};
use super::machine::Machine;
use super::memo::Question;
use super::oracle::meaning;
use crate::automaton::{Meaning, NodeKind};
use crate::subset::MAX_CONDITION_DEPTH;

/// Each value of an argument that is tried takes a proof of all that is open. Behind the one in question these are `any`, what is
/// bound, what the step speaks of, and so many others: one that is open here is open when its turn comes, so what is begun
/// can still be completed.
const MOST_TRIED: usize = 3;

/// A condition that was written.
pub(super) struct Last {
    /// How many conditions stand in one another in it.
    height: usize,
    pub(super) is_comparison: bool,
    /// Whether it stands behind `and` or `or`.
    is_joined: bool,
}

impl Machine {
    /// Whether the step of the body, with `more` behind what was said, is no error with some fluent as the condition that
    /// comes then, or with some fluent under `not`.
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

    /// Whether the argument at `place` can be this one, with some arguments behind it.
    pub(super) fn completes_with(&mut self, state: &State, fluent: u16, place: usize, arg: Event) -> bool {
        self.completes(state, fluent, place + 1, &mut vec![arg])
    }

    /// Whether some arguments from the one at `place` on make a condition that refutes nothing.
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
        // What stands first is what the policy is less likely to be about.
        options.reverse();
        options.into_iter().any(|option| {
            events.push(option);
            let holds = self.completes(state, fluent, place + 1, events);
            events.pop();
            holds
        })
    }

    /// The values that were said in the step of the body that is being written.
    fn values_said(&self, event: Id) -> Vec<Meaning> {
        let before = self.arenas.entry(event).map_or(0, |said| said.before);
        let events = self.arenas.between(before, event).into_iter();
        events.filter_map(|event| meaning(&self.context.automaton, event)).collect()
    }

    /// Whether a whole condition, of which what was said is the beginning and `more` the rest, refutes nothing.
    fn refutes_nothing(&mut self, event: Id, more: &[Event]) -> bool {
        let Some((body, fluent, negated, args)) = self.test_of_loop(event, more) else {
            return self.verify_beside(event, more);
        };
        match self.test(body, fluent, negated, &args) {
            Test::Holds if self.is_independent(event, more) => true,
            // The body was no error without a test, so it was the back edge.
            Test::Idle if !self.may_iterate(body) => false,
            Test::Holds | Test::Idle | Test::Open => {
                let round = self.permits_round(body, Some((fluent, negated, &args)));
                round.is_some_and(|facts| self.is_right_beside((body, facts), event, more))
            }
        }
    }

    /// Whether what stands beside a loop is no error with a test, which is the last of what was said and `more`; it leaves
    /// certain facts where the body of the loop ends. Where another that leaves the same was wrong, so is this one.
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

    /// Whether the body of a loop may end behind `event`, whatever test there may be.
    pub(super) fn may_iterate(&mut self, event: Id) -> bool {
        let key = self.key(Question::Round, event, None);
        self.answer(key, |machine| machine.permits_round(event, None).is_some())
            && self.verify_beside(event, &[Event::Close])
    }

    /// Whether the loop may do without a test whose body ended with the last event.
    pub(super) fn needs_no_test(&mut self, event: Id) -> bool {
        match self.arenas.entry(event) {
            Some(said) if event > 0 && said.event == Event::Close => {
                let body = said.below;
                self.may_iterate(body)
            }
            _ => self.verify(event, &[]),
        }
    }

    /// Whether `and` or `or` may stand behind the condition that was just written: it stands in nothing, nor beside anything.
    pub(super) fn may_join(&self, state: &State, outside: u8) -> bool {
        let last = self.last_condition(state.event);
        !last.is_joined && usize::from(outside) + last.height < MAX_CONDITION_DEPTH
    }

    /// What was just written, which ends a condition without `and` or `or` around it.
    pub(super) fn last_condition(&self, event: Id) -> Last {
        let (mut at, mut closed, mut events) = (event, 0usize, Vec::new());
        while let Some(said) = self.arenas.entry(at).filter(|_| at > 0) {
            at = said.below;
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
        let before = self.arenas.entry(at).filter(|_| at > 0).map(|said| said.event);
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
            is_comparison: matches!(events.last(), Some(Event::Open(NodeKind::Get(_) | NodeKind::Field(_)))),
            is_joined: matches!(before, Some(Event::Joined(_))),
        }
    }

    /// Where a condition is the test of a loop: the event before the end of the loop's body, and the condition.
    fn test_of_loop(&self, event: Id, more: &[Event]) -> Option<(Id, u16, bool, Vec<Event>)> {
        if more.contains(&Event::Open(NodeKind::Wait)) {
            return None;
        }
        let (mut said, mut at) = (Vec::new(), event);
        let mut is_closed = more.contains(&Event::Close);
        let mut body = if is_closed { event } else { 0 };
        while !is_closed {
            let said_here = self.arenas.entry(at).filter(|_| at > 0)?;
            match said_here.event {
                Event::Close => {
                    is_closed = true;
                    body = said_here.below;
                }
                event
                @ (Event::Open(NodeKind::Not | NodeKind::Is(_)) | Event::Word(..) | Event::Bound(_)) => {
                    said.push(event);
                }
                _ => return None,
            }
            at = said_here.below;
        }
        said.reverse();
        said.extend(more.iter().copied().filter(|event| *event != Event::Close));
        let negated = said.first() == Some(&Event::Open(NodeKind::Not));
        let mut rest = said.into_iter().skip(usize::from(negated));
        let Some(Event::Open(NodeKind::Is(fluent))) = rest.next() else { return None };
        Some((body, fluent, negated, rest.collect()))
    }
}
