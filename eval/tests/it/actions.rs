//! Faults of actions by the journal of a run.

use std::sync::Arc;

use motet_eval::actions::{ActionFaults, ActionLedger};
use motet_graph::NodeId;
use motet_runtime::journal::{JournalEntry, StepEntry};
use motet_runtime::{Command, DriverEvent, Effect, Event, GoalId, Outcome, Time};

fn start(goal: u64, primitive: &str) -> Effect {
    let command = Command {
        primitive: primitive.into(),
        args: Vec::new(),
        uses: [].into(),
        manner: None,
        deadline_secs: 1.0,
        motions: Vec::new(),
        leaves: None,
    };
    let (goal, node, deadline) = (GoalId::from_number(goal), NodeId(1), Time::ZERO);
    Effect::Start { goal, node, command: Arc::new(command), deadline }
}

fn ended(goal: u64) -> DriverEvent {
    DriverEvent::Ended { goal: GoalId::from_number(goal), outcome: Outcome::Success(None) }
}

fn faults(steps: Vec<(Option<DriverEvent>, Vec<Effect>)>) -> ActionFaults {
    let mut ledger = ActionLedger::default();
    for (event, effects) in steps {
        let event = event.map(Event::Driver);
        ledger.take(&JournalEntry::Step(StepEntry { at: Time::ZERO, event, effects }));
    }
    ledger.finish()
}

#[test]
fn action_ledger_finds_nothing_in_a_run_that_is_right() {
    let acknowledged = DriverEvent::Acknowledged { goal: GoalId::from_number(1) };
    let steps = vec![
        (None, vec![start(1, "pick")]),
        (Some(acknowledged), vec![]),
        (Some(ended(1)), vec![start(2, "place")]),
        (Some(ended(2)), vec![start(3, "pick")]),
        (Some(ended(3)), vec![]),
        // A safe stop of what has ended is answered.
        (Some(DriverEvent::Stopped { goal: GoalId::from_number(3) }), vec![]),
    ];
    assert!(faults(steps).is_empty());
}

#[test]
fn action_ledger_finds_dropped_doubled_and_orphaned_calls() {
    let acknowledged = DriverEvent::Acknowledged { goal: GoalId::from_number(2) };
    let found = faults(vec![(None, vec![start(1, "go"), start(2, "say")]), (Some(acknowledged), vec![])]);
    assert_eq!(
        (&found.dropped[..], &found.orphaned[..]),
        (&["go()".to_owned()][..], &["say()".to_owned()][..])
    );
    let again = faults(vec![
        (None, vec![start(1, "pick")]),
        (Some(ended(1)), vec![start(2, "pick")]),
        (Some(ended(2)), vec![]),
    ]);
    assert_eq!(again.doubled, ["pick()"]);
    let beside = faults(vec![
        (None, vec![start(1, "go"), start(2, "go")]),
        (Some(ended(1)), vec![]),
        (Some(ended(2)), vec![]),
    ]);
    assert_eq!(beside.doubled, ["go()"]);
    let twice =
        faults(vec![(None, vec![start(1, "go")]), (Some(ended(1)), vec![]), (Some(ended(1)), vec![])]);
    assert_eq!(twice.doubled, ["go() ends twice"]);
}
