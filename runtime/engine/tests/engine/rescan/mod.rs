//! The engine beside an interpreter without lists, masks, timers or subscriptions: after each transition it scans the whole
//! policy for the first one that is enabled, watches first. Policies with everything that runs at once: parallel branches,
//! waits, and monitors of every reaction. Primitives have no contracts here, and time stands still; both are the affair of
//! the other interpreter and of the laws.

mod enter;
mod goal;
mod leave;
mod plain;
mod state;
mod watch;

use motet_graph::arbitrary::{Step, steps};
use motet_graph::{Graph, ROOT, Value};
use motet_runtime::{
    Answer, Capabilities, DriverEvent, Effect, Engine, Event, GoalId, Outcome, Pattern, Primitives, Query,
    RunEnd, StartState, Time,
};
use plain::known;
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use state::Naive;
use std::cell::Cell;
use std::collections::BTreeMap;

/// What the world does next; numbers pick among the live goals.
#[derive(Clone, Debug)]
enum Act {
    Acknowledge(u8),
    End(u8, u8),
    See(u8, bool),
    Stop,
}

fn acts() -> impl Strategy<Value = Vec<Act>> {
    let act = prop_oneof![
        8 => any::<u8>().prop_map(Act::Acknowledge),
        8 => (any::<u8>(), any::<u8>()).prop_map(|(goal, how)| Act::End(goal, how)),
        8 => (any::<u8>(), any::<bool>()).prop_map(|(object, held)| Act::See(object, held)),
        1 => prop_oneof![30 => (any::<u8>(), any::<bool>()).prop_map(|(object, held)| Act::See(object, held)),
            1 => Just(Act::Stop)],
    ];
    prop::collection::vec(act, 0..60)
}

/// The engine, with its goals numbered by their starts.
struct Beside {
    engine: Engine,
    goals: BTreeMap<GoalId, usize>,
    out: Vec<Effect>,
}

impl Beside {
    fn handle(&mut self, event: Event) -> Vec<String> {
        self.engine.handle(Time::ZERO, event, &mut self.out);
        let mut said = Vec::new();
        for effect in self.out.drain(..) {
            match effect {
                Effect::Start { goal, node, .. } => {
                    self.goals.insert(goal, self.goals.len() + 1);
                    said.push(format!("start {} {node:?}", self.goals.len()));
                }
                Effect::Cancel { goal } => said.push(format!("cancel {}", self.goals[&goal])),
                Effect::Hold { goal } => said.push(format!("hold {}", self.goals[&goal])),
                Effect::Proceed { goal } => said.push(format!("proceed {}", self.goals[&goal])),
                Effect::Finished(end) => said.push(format!("finished {end:?}")),
                Effect::Watch { .. } | Effect::Unwatch { .. } | Effect::Report(_) => {}
                other => panic!("not expected: {other:?}"),
            }
        }
        said
    }

    fn goal(&self, number: usize) -> GoalId {
        *self.goals.iter().find(|(_, of)| **of == number).unwrap().0
    }
}

/// How often what was seen.
#[derive(Default)]
struct Counts {
    starts: Cell<usize>,
    cancels: Cell<usize>,
    holds: Cell<usize>,
    ends: Cell<usize>,
}

fn compare(graph: &Graph, acts: &[Act], counts: &Counts) -> Result<(), TestCaseError> {
    let hold = Primitives::Only(["go", "pick", "say"].map(Into::into).into());
    let capabilities = Capabilities { hold, ..Capabilities::default() };
    let engine = Engine::new(graph.clone(), &StartState::default()).unwrap().with_capabilities(capabilities);
    let mut beside = Beside { engine, goals: BTreeMap::new(), out: Vec::new() };
    let mut naive = Naive::new(graph.clone());
    naive.enter_region(ROOT);
    naive.settle();
    prop_assert_eq!(beside.handle(Event::Begin), std::mem::take(&mut naive.out));
    for act in acts {
        if naive.over {
            break;
        }
        let pick = |number: u8| {
            let index = usize::from(number).checked_rem(naive.goals.len())?;
            naive.goals.keys().nth(index).copied()
        };
        let event = match act {
            Act::Acknowledge(number) => {
                let Some(number) = pick(*number) else { continue };
                naive.acknowledged(number);
                Event::Driver(DriverEvent::Acknowledged { goal: beside.goal(number) })
            }
            Act::End(number, how) => {
                let Some(number) = pick(*number) else { continue };
                let outcome = match how {
                    0..40 => Outcome::Interrupted,
                    40..80 => Outcome::Failure(["timeout", "unreachable"][usize::from(how % 2)].into()),
                    80.. => Outcome::Success(None),
                };
                naive.ended(number, &outcome);
                Event::Driver(DriverEvent::Ended { goal: beside.goal(number), outcome })
            }
            Act::See(object, held) => {
                let object = ["mug", "cup", "bowl"][usize::from(object % 3)];
                if *held {
                    naive.held.insert(object.into())
                } else {
                    naive.held.remove(object)
                };
                let args = vec![Pattern::Is(Value::Entity(object.into()))];
                let query = Query::Fact { fluent: "holding".into(), args };
                Event::Driver(DriverEvent::Observed { query, answer: Answer::Truth(*held) })
            }
            Act::Stop => {
                if naive.ending.is_none() {
                    naive.ending = Some(RunEnd::Interrupted);
                    naive.stop(ROOT);
                }
                Event::Stop
            }
        };
        naive.settle();
        let expected = std::mem::take(&mut naive.out);
        let count = |cell: &Cell<usize>, word: &str| {
            cell.set(cell.get() + expected.iter().filter(|line| line.starts_with(word)).count());
        };
        count(&counts.starts, "start");
        count(&counts.cancels, "cancel");
        count(&counts.holds, "hold");
        count(&counts.ends, "finished");
        prop_assert_eq!(beside.handle(event), expected);
    }
    Ok(())
}

#[test]
fn what_runs_at_once_goes_as_in_a_naive_interpreter() {
    let cases = (prop::collection::vec(steps(), 1..3), prop::collection::vec(acts(), 12));
    let config = ProptestConfig {
        cases: 1_500,
        max_shrink_iters: 20_000,
        failure_persistence: None,
        ..ProptestConfig::default()
    };
    let counts = Counts::default();
    let result = TestRunner::new(config).run(&cases, |(steps, runs)| {
        // Beside itself, so that something runs at once in most of them.
        let graph = known(&[Step::Parallel(steps.clone()), Step::Sequence(steps.concat())]);
        runs.iter().try_for_each(|acts| compare(&graph, acts, &counts))
    });
    result.unwrap_or_else(|failure| panic!("{failure}"));
    let Counts { starts, cancels, holds, ends } = &counts;
    let seen = [starts, cancels, holds, ends].map(Cell::get);
    assert!(seen.iter().all(|count| *count > 100), "starts, cancels, holds, ends: {seen:?}");
}
