//! The engine beside an interpreter without lists, masks, timers or subscriptions: after each transition it
//! scans the whole policy for the first one that is enabled, watches first. Policies with everything that
//! runs at once: parallel branches, waits, and monitors of every reaction; with deadlines, drivers that lose
//! goals and are silent, and swaps at any moment. Primitives have no contracts here: these are the affair of
//! the other interpreter and of the laws.

mod clock;
mod enter;
mod goal;
mod leave;
mod plain;
mod state;
mod swap;
mod watch;

use motet_arbitrary::graph::{ReactionSketch, StepSketch, WatchSketch, steps, vocabulary as v};
use motet_graph::{Condition, Graph, NodeId, NodeKind, ROOT, Value};
use motet_runtime::{
    Answer, Capabilities, DriverEvent, Effect, Engine, Event, GoalId, Outcome, Pattern, PreparedSwap,
    PrimitiveSet, Query, RunEnd, StartState, SwapRefusal, Time, TraceEventKind,
};
use plain::{elsewhere, known};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use state::{At, Naive, Phase, Wish};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

/// What the world does next; numbers pick among the live goals.
#[derive(Clone, Debug)]
enum Act {
    Acknowledge(u8),
    End(u8, u8),
    Refuse(u8),
    NotHeld(u8),
    Stopped(u8),
    Lost(u8),
    DriverLost,
    See(u8, bool),
    Swap(u8),
    Stop,
    Nothing,
}

/// What happens, each so long in ns after the one before.
fn acts() -> impl Strategy<Value = Vec<(u64, Act)>> {
    let act = prop_oneof![
        12 => any::<u8>().prop_map(Act::Acknowledge),
        8 => (any::<u8>(), any::<u8>()).prop_map(|(goal, how)| Act::End(goal, how)),
        12 => (any::<u8>(), any::<bool>()).prop_map(|(object, held)| Act::See(object, held)),
        1 => any::<u8>().prop_map(Act::Refuse),
        1 => any::<u8>().prop_map(Act::NotHeld),
        1 => any::<u8>().prop_map(Act::Stopped),
        1 => any::<u8>().prop_map(Act::Lost),
        2 => any::<u8>().prop_map(Act::Swap),
        1 => prop_oneof![20 => Just(Act::Nothing), 1 => Just(Act::DriverLost), 1 => Just(Act::Stop)],
    ];
    let later = prop_oneof![1 => Just(0), 8 => 1..300_000_000_u64, 1 => 1..3_000_000_000_u64];
    prop::collection::vec((later, act), 0..120)
}

/// The engine, with its goals numbered by their starts.
struct Beside {
    engine: Engine,
    goals: BTreeMap<GoalId, usize>,
    out: Vec<Effect>,
}

impl Beside {
    fn handle(&mut self, now: u64, event: Event) -> Vec<String> {
        self.engine.handle(Time::from_nanos(now), event, &mut self.out);
        self.said()
    }

    /// False where the swap is refused.
    fn swap(&mut self, now: u64, graph: &Graph) -> bool {
        let prepared = PreparedSwap::new(graph.clone(), &self.engine.running()).unwrap();
        match self.engine.swap(Time::from_nanos(now), prepared, &mut self.out) {
            Ok(_) => true,
            Err(SwapRefusal::Over) => false,
            Err(other) => panic!("{other}"),
        }
    }

    fn said(&mut self) -> Vec<String> {
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
                Effect::SafeStop { goal } => said.push(format!("safe_stop {}", self.goals[&goal])),
                Effect::Update { goal, node, .. } => {
                    said.push(format!("update {} {node:?}", self.goals[&goal]))
                }
                Effect::Report(record) => {
                    if let TraceEventKind::Kept { node, goal } = record.what {
                        said.push(format!("keep {} {node:?}", self.goals[&goal]));
                    }
                }
                Effect::Finished(end) => said.push(format!("finished {end:?}")),
                Effect::Watch { .. } | Effect::Unwatch { .. } => {}
                other => panic!("not expected: {other:?}"),
            }
        }
        said
    }

    fn goal(&self, number: usize) -> GoalId {
        *self.goals.iter().find(|(_, of)| **of == number).unwrap().0
    }
}

/// How often what was seen, by its first word.
type Counts = RefCell<BTreeMap<String, usize>>;

/// The interpreter takes an act in; gives what the engine is to be told, and nothing where the act says
/// nothing.
fn take(naive: &mut Naive, act: &Act, goal: impl Fn(usize) -> GoalId) -> Option<Event> {
    let live: BTreeSet<usize> =
        naive.goals.keys().copied().chain(naive.orphans.iter().map(|orphan| orphan.number)).collect();
    let pick = |number: u8| live.iter().nth(usize::from(number).checked_rem(live.len())?).copied();
    let orphan = |naive: &Naive, number: usize| naive.orphans.iter().position(|of| of.number == number);
    let end = |naive: &mut Naive, number: usize, outcome: &Outcome| match orphan(naive, number) {
        Some(place) => naive.orphan_ended(place),
        None => naive.ended(number, outcome),
    };
    let event = match act {
        Act::Acknowledge(number) => {
            let number = pick(*number)?;
            match orphan(naive, number) {
                Some(place) => naive.orphan_acknowledged(place),
                None => naive.acknowledged(number),
            }
            DriverEvent::Acknowledged { goal: goal(number) }
        }
        Act::End(number, how) => {
            let number = pick(*number)?;
            let outcome = match how {
                0..12 => Outcome::Interrupted,
                12..36 => Outcome::Failure(["timeout", "unreachable"][usize::from(how % 2)].into()),
                36.. => Outcome::Success(None),
            };
            end(naive, number, &outcome);
            DriverEvent::Ended { goal: goal(number), outcome }
        }
        Act::Refuse(number) => {
            let number = pick(*number)?;
            end(naive, number, &Outcome::Failure("unreachable".into()));
            DriverEvent::Refused { goal: goal(number), failure: "unreachable".into() }
        }
        Act::Stopped(number) => {
            let number = pick(*number)?;
            end(naive, number, &Outcome::Interrupted);
            DriverEvent::Stopped { goal: goal(number) }
        }
        Act::NotHeld(number) => {
            let number = pick(*number)?;
            if let Some(node) = naive.goals.get(&number).copied()
                && matches!(naive.nodes[&node].at, At::Goal(_, Phase::Held, _))
            {
                naive.cancel(node, Wish::Suspend);
            }
            DriverEvent::NotHeld { goal: goal(number) }
        }
        Act::Lost(number) => {
            let number = pick(*number)?;
            naive.lost(number);
            DriverEvent::Lost { goal: goal(number) }
        }
        Act::DriverLost => {
            let orphans = naive.orphans.iter().map(|orphan| orphan.number);
            let all: Vec<usize> = orphans.chain(naive.goals.keys().copied()).collect();
            all.into_iter().for_each(|number| naive.lost(number));
            DriverEvent::DriverLost
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
            DriverEvent::Observed { query, answer: Answer::Truth(*held) }
        }
        Act::Stop => {
            let cleans = |node: &NodeId| {
                matches!(naive.kind(*node), NodeKind::Finally { .. }) && naive.nodes[node].at == At::Inside
            };
            let is_open = naive.ending.is_none() || naive.nodes.keys().any(cleans);
            if !naive.halted && is_open {
                naive.halted = true;
                naive.ending = Some(RunEnd::Interrupted);
                naive.stop(ROOT);
            }
            return Some(Event::Stop);
        }
        Act::Nothing => return Some(Event::Tick),
        Act::Swap(_) => return None,
    };
    Some(Event::Driver(event))
}

/// Both say the same and want to be woken at the same instant.
fn agree(naive: &mut Naive, beside: &Beside, said: &[String], counts: &Counts) -> Result<(), TestCaseError> {
    let expected = std::mem::take(&mut naive.out);
    prop_assert_eq!(said, &expected[..]);
    prop_assert_eq!(beside.engine.wake_at().map(Time::nanos), naive.wake_at());
    for line in expected {
        let word = line.split(' ').next().unwrap_or_default().to_owned();
        *counts.borrow_mut().entry(word).or_default() += 1;
    }
    Ok(())
}

fn compare(graphs: &[Graph], acts: &[(u64, Act)], counts: &Counts) -> Result<(), TestCaseError> {
    let only = |names: &[&str]| PrimitiveSet::Only(names.iter().map(|name| (*name).into()).collect());
    let capabilities =
        Capabilities { hold: only(&["go", "pick", "say"]), update: only(&["go"]), ..Capabilities::default() };
    let engine = Engine::new(graphs[0].clone(), &StartState::default()).unwrap();
    let engine = engine.with_capabilities(capabilities);
    let mut beside = Beside { engine, goals: BTreeMap::new(), out: Vec::new() };
    let mut naive = Naive::new(graphs[0].clone());
    naive.enter_region(ROOT);
    naive.settle();
    let said = beside.handle(0, Event::Begin);
    agree(&mut naive, &beside, &said, counts)?;
    for (later, act) in acts {
        let at = naive.now + later;
        while let Some(wake) = naive.wake_at().filter(|wake| *wake <= at) {
            naive.now = wake;
            naive.settle();
            naive.catch_up();
            let said = beside.handle(wake, Event::Tick);
            agree(&mut naive, &beside, &said, counts)?;
        }
        if naive.over {
            break;
        }
        naive.now = at;
        if let Act::Swap(number) = act {
            let graph = &graphs[1 + usize::from(*number) % (graphs.len() - 1)];
            prop_assert_eq!(beside.swap(at, graph), naive.swap(graph.clone()));
        } else if let Some(event) = take(&mut naive, act, |number| beside.goal(number)) {
            beside.engine.handle(Time::from_nanos(at), event, &mut beside.out);
            naive.settle();
        }
        naive.catch_up();
        let said = beside.said();
        agree(&mut naive, &beside, &said, counts)?;
    }
    Ok(())
}

#[test]
fn engine_what_runs_at_once_goes_as_in_a_naive_interpreter() {
    let cases = (prop::collection::vec(steps(), 1..3), steps(), prop::collection::vec(acts(), 12));
    let config = ProptestConfig {
        cases: 1_000,
        max_shrink_iters: 20_000,
        failure_persistence: None,
        ..ProptestConfig::default()
    };
    let counts = Counts::default();
    let result = TestRunner::new(config).run(&cases, |(steps, other, runs)| {
        // Beside itself, so that something runs at once in most of them.
        let twice = StepSketch::Repeat(2, vec![StepSketch::Parallel(steps.clone())], None);
        let cup = Condition::Fact(v::fact(v::HOLDING, vec![v::entity("cup")]));
        let pause = WatchSketch::new(cup, ReactionSketch::Pause(1.0));
        // A second attempt keeps runs from ending early, and a pause around all of it makes goals hold.
        let tried = StepSketch::Try(vec![twice], vec![(None, vec![StepSketch::Sequence(steps.concat())])]);
        let first = [StepSketch::Monitor(vec![pause], vec![tried])];
        let again = [first.to_vec(), other.clone()].concat();
        let changed: Vec<StepSketch> = first.iter().map(elsewhere).collect();
        let all = [first.to_vec(), first.to_vec(), changed, other, again];
        let mut graphs = all.map(|steps| known(&steps));
        // Proved from nothing.
        graphs.iter_mut().skip(1).for_each(|graph| graph.initial.clear());
        runs.iter().try_for_each(|acts| compare(&graphs, acts, &counts))
    });
    result.unwrap_or_else(|failure| panic!("{failure}"));
    let counts = counts.into_inner();
    for word in ["start", "cancel", "hold", "proceed", "safe_stop", "keep", "update", "finished"] {
        assert!(counts.get(word).is_some_and(|count| *count > 50), "{word}: {counts:?}");
    }
}
