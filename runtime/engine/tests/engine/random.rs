//! Random graphs under random events: no panic, the laws of effects hold, every run ends, and a replay is the same.

use motet_graph::arbitrary::{graph, steps};
use motet_graph::{Graph, NodeId, Type, Value};
use motet_runtime::{
    Answer, DriverEvent, Effect, Engine, Event, Fault, GoalId, Happening, Outcome, Query, RunEnd, StartState,
    Time,
};
use proptest::collection::vec;
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// What happens next. Numbers pick among the live goals or the open questions.
#[derive(Clone, Debug)]
enum Act {
    Acknowledge(u8),
    Succeed(u8),
    Fail(u8, u8),
    Interrupted(u8),
    Refuse(u8),
    NotHeld(u8),
    Stopped(u8),
    Lost(u8),
    Answer(u8, u8),
    ToWake,
    Nothing,
    Stop,
}

fn acts() -> impl Strategy<Value = Vec<(u64, Act)>> {
    let act = prop_oneof![
        10 => any::<u8>().prop_map(Act::Acknowledge),
        10 => any::<u8>().prop_map(Act::Succeed),
        4 => (any::<u8>(), any::<u8>()).prop_map(|(goal, kind)| Act::Fail(goal, kind)),
        4 => any::<u8>().prop_map(Act::Interrupted),
        1 => any::<u8>().prop_map(Act::Refuse),
        2 => any::<u8>().prop_map(Act::NotHeld),
        2 => any::<u8>().prop_map(Act::Stopped),
        1 => any::<u8>().prop_map(Act::Lost),
        20 => (any::<u8>(), any::<u8>()).prop_map(|(query, answer)| Act::Answer(query, answer)),
        6 => Just(Act::ToWake),
        1 => Just(Act::Nothing),
        1 => prop_oneof![20 => Just(Act::Nothing), 1 => Just(Act::Stop)],
    ];
    vec((prop_oneof![Just(0), 0..1_000_000_000_u64], act), 0..150)
}

/// A live goal as a driver knows it.
#[derive(Debug)]
struct Goal {
    node: NodeId,
    primitive: String,
    uses: Vec<String>,
    acknowledged: bool,
    cancelled: bool,
    held: bool,
}

/// What the laws allow, kept beside the engine.
#[derive(Default)]
struct Ledger {
    live: BTreeMap<GoalId, Goal>,
    ever: BTreeSet<GoalId>,
    watched: Vec<Query>,
    asked: Vec<Query>,
    entered: BTreeSet<NodeId>,
    end: Option<RunEnd>,
    log: Vec<Effect>,
}

impl Ledger {
    fn take(&mut self, effects: &[Effect]) {
        for effect in effects {
            assert!(self.end.is_none(), "an effect after the end: {effect:?}");
            self.log.push(effect.clone());
            match effect {
                Effect::Start { goal, node, command, .. } => {
                    assert!(self.ever.insert(*goal), "a goal id is used twice");
                    let uses: Vec<String> = command.uses.iter().map(ToString::to_string).collect();
                    for other in self.live.values() {
                        assert!(other.node != *node, "a step has two goals");
                        assert!(!conflict(&other.uses, &uses), "{other:?} holds what {command:?} needs");
                    }
                    let primitive = command.primitive.to_string();
                    let goal_state = Goal {
                        node: *node,
                        primitive,
                        uses,
                        acknowledged: false,
                        cancelled: false,
                        held: false,
                    };
                    self.live.insert(*goal, goal_state);
                }
                Effect::Cancel { goal } => {
                    let goal = self.live.get_mut(goal).expect("a cancel of a goal that is not live");
                    assert!(goal.acknowledged && !goal.cancelled, "a cancel too early or twice");
                    goal.cancelled = true;
                }
                Effect::Update { .. } => panic!("an update without a swap"),
                Effect::Hold { goal } => {
                    let goal = self.live.get_mut(goal).expect("a hold of a goal that is not live");
                    assert!(goal.acknowledged && !goal.cancelled && !goal.held, "a hold out of place");
                    goal.held = true;
                }
                Effect::Proceed { goal } => {
                    let goal = self.live.get_mut(goal).expect("a proceed of a goal that is not live");
                    assert!(goal.held && !goal.cancelled, "a proceed out of place");
                    goal.held = false;
                }
                Effect::SafeStop { goal } => {
                    assert!(self.live.contains_key(goal), "a safe stop of a dead goal")
                }
                Effect::Observe { query } => self.asked.push((**query).clone()),
                Effect::Watch { query } => {
                    assert!(!self.watched.contains(query), "watched twice");
                    self.watched.push((**query).clone());
                }
                Effect::Unwatch { query } => {
                    let before = self.watched.len();
                    self.watched.retain(|watched| watched != &**query);
                    assert_eq!(self.watched.len() + 1, before, "unwatched without a watch");
                }
                Effect::Report(record) => match &record.what {
                    Happening::Entered { node } => assert!(self.entered.insert(*node), "entered twice"),
                    Happening::Ended { node, .. } => {
                        assert!(self.entered.remove(node), "ended without an entry")
                    }
                    Happening::Started { node, .. } | Happening::GoalEnded { node, .. } => {
                        assert!(self.entered.contains(node), "a goal of a step that does not run");
                    }
                    Happening::Guard { .. } | Happening::Tested { .. } | Happening::Fired { .. } => {}
                    Happening::WentOn { .. } | Happening::Bound { .. } => {}
                    Happening::Swapped { .. } | Happening::Kept { .. } | Happening::Updated { .. } => {
                        panic!("a swap that nobody asked for")
                    }
                },
                Effect::Finished(end) => {
                    if !matches!(**end, RunEnd::Fault(_)) {
                        assert!(self.live.is_empty(), "over with live goals");
                        assert!(self.watched.is_empty(), "over with watches");
                        assert!(self.entered.is_empty(), "over with running steps");
                    }
                    self.end = Some((**end).clone());
                }
            }
        }
    }

    fn pick(&self, number: u8) -> Option<GoalId> {
        let index = usize::from(number).checked_rem(self.live.len())?;
        self.live.keys().nth(index).copied()
    }

    fn event(&mut self, act: &Act) -> Option<Event> {
        let event = match act {
            Act::Acknowledge(number) => {
                let goal = self.pick(*number)?;
                self.live.get_mut(&goal)?.acknowledged = true;
                DriverEvent::Acknowledged { goal }
            }
            Act::Succeed(number) => {
                let goal = self.pick(*number)?;
                let state = self.live.remove(&goal)?;
                DriverEvent::Ended { goal, outcome: Outcome::Success(result(&state.primitive, *number)) }
            }
            Act::Fail(number, kind) => {
                let goal = self.pick(*number)?;
                self.live.remove(&goal);
                let kinds = ["timeout", "failed", "unreachable", "not_found", "made_up"];
                let kind = kinds[usize::from(*kind) % kinds.len()];
                DriverEvent::Ended { goal, outcome: Outcome::Failure(kind.into()) }
            }
            Act::Interrupted(number) => {
                let goal = self.pick(*number)?;
                // Mostly in answer to a cancel: one of the robot's own accord ends the run.
                if !self.live[&goal].cancelled && number % 8 != 0 {
                    return None;
                }
                self.live.remove(&goal);
                DriverEvent::Ended { goal, outcome: Outcome::Interrupted }
            }
            Act::Refuse(number) => {
                let goal = self.pick(*number)?;
                self.live.remove(&goal);
                DriverEvent::Refused { goal, failure: "refused".into() }
            }
            Act::NotHeld(number) => {
                let goal = self.pick(*number)?;
                DriverEvent::NotHeld { goal }
            }
            Act::Stopped(number) => {
                let goal = self.pick(*number)?;
                self.live.remove(&goal);
                DriverEvent::Stopped { goal }
            }
            Act::Lost(0) => DriverEvent::DriverLost,
            Act::Lost(number) => DriverEvent::Lost { goal: self.pick(*number)? },
            Act::Answer(number, answer) => {
                let open: Vec<&Query> = self.watched.iter().chain(&self.asked).collect();
                let query = (*open.get(usize::from(*number).checked_rem(open.len())?)?).clone();
                self.asked.retain(|asked| *asked != query);
                DriverEvent::Observed { answer: answer_to(&query, *answer), query }
            }
            Act::ToWake | Act::Nothing => return Some(Event::Tick),
            Act::Stop => return Some(Event::Stop),
        };
        Some(Event::Driver(event))
    }
}

/// What the primitives of the vocabulary give.
fn result(primitive: &str, number: u8) -> Option<Value> {
    let object = |number: u8| Value::Entity(["mug", "cup", "bowl"][usize::from(number) % 3].into());
    match primitive {
        "detect" => Some(object(number)),
        "detect_all" => Some(Value::List((0..number % 4).map(object).collect())),
        _ => None,
    }
}

fn answer_to(query: &Query, number: u8) -> Answer {
    match (query, number % 5) {
        (_, 0) => Answer::Unknown,
        (Query::Fact { .. }, number) => Answer::Truth(number % 2 == 0),
        (Query::Measure { .. } | Query::Field { .. }, 1) => Answer::Value(Value::Number(f64::NAN)),
        (Query::Measure { .. } | Query::Field { .. }, number) => {
            Answer::Value(Value::Number(f64::from(number) / 5.0))
        }
    }
}

/// The vocabulary's arm contains its camera.
fn conflict(a: &[String], b: &[String]) -> bool {
    let nested = |x: &str, y: &str| x == "arm" && y == "camera";
    a.iter().any(|a| b.iter().any(|b| a == b || nested(a, b) || nested(b, a)))
}

/// Runs a graph through random acts, then to its end with a driver that does its best. Returns the events.
fn drive(graph: Graph, acts: &[(u64, Act)]) -> (Ledger, Vec<(Time, Event)>) {
    let mut engine = Engine::new(graph, &StartState::default()).unwrap();
    let (mut ledger, mut events, mut out) = (Ledger::default(), Vec::new(), Vec::new());
    let mut now = Time::ZERO;
    let mut feed = |engine: &mut Engine, ledger: &mut Ledger, now: Time, event: Event| {
        events.push((now, event.clone()));
        out.clear();
        engine.handle(now, event, &mut out);
        ledger.take(&out);
    };
    feed(&mut engine, &mut ledger, now, Event::Begin);
    for (later, act) in acts {
        if ledger.end.is_some() {
            break;
        }
        // Most things happen before the engine wants to be woken.
        now = match (act, engine.wake_at()) {
            (Act::ToWake, Some(wake)) => wake.max(now),
            (_, Some(wake)) => now.after(Time::from_nanos(*later)).min(wake).max(now),
            (_, None) => now.after(Time::from_nanos(*later)),
        };
        if let Some(event) = ledger.event(act) {
            feed(&mut engine, &mut ledger, now, event);
        }
    }
    for round in 0_u32.. {
        if ledger.end.is_some() {
            break;
        }
        assert!(round < 200_000, "the run does not end");
        let next =
            ledger.live.iter().map(|(goal, state)| (*goal, state.acknowledged, state.cancelled)).next();
        let event = match next {
            Some((goal, false, _)) => {
                ledger.live.get_mut(&goal).unwrap().acknowledged = true;
                Some(Event::Driver(DriverEvent::Acknowledged { goal }))
            }
            Some((_, true, true)) => ledger.event(&Act::Interrupted(0)),
            // It waits while it is held: then only time helps.
            Some((goal, true, false)) if ledger.live[&goal].held => None,
            Some((_, true, false)) => ledger.event(&Act::Succeed(0)),
            None if ledger.asked.is_empty() => None,
            None => {
                let first = ledger.watched.len() as u8;
                ledger.event(&Act::Answer(first, (round % 256) as u8))
            }
        };
        let event = event.unwrap_or_else(|| {
            now = engine
                .wake_at()
                .expect("nothing runs, nothing is asked, and the engine does not want to be woken");
            Event::Tick
        });
        feed(&mut engine, &mut ledger, now, event);
    }
    assert!(engine.is_over());
    assert_eq!(engine.wake_at(), None);
    (ledger, events)
}

fn replay(graph: Graph, events: &[(Time, Event)]) -> Vec<Effect> {
    let mut engine = Engine::new(graph, &StartState::default()).unwrap();
    let mut out = Vec::new();
    for (now, event) in events {
        engine.handle(*now, event.clone(), &mut out);
    }
    out
}

/// Whether the values that were bound have their types.
fn bound_values_fit(graph: &Graph, log: &[Effect]) -> bool {
    log.iter().all(|effect| match effect {
        Effect::Report(record) => match &record.what {
            Happening::Bound { binding, value } => {
                let ty: &Type = &graph.bindings[binding.index()].ty;
                value.fits(ty)
            }
            _ => true,
        },
        _ => true,
    })
}

fn is_expected(end: &RunEnd, graph: &Graph) -> bool {
    match end {
        RunEnd::Done { .. } | RunEnd::Replan { .. } | RunEnd::Interrupted => true,
        RunEnd::Failed { node, .. } => node.index() < graph.nodes.len(),
        RunEnd::Fault(fault) => matches!(fault, Fault::NotStopped { .. }),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4096, max_shrink_iters: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_laws_hold_and_every_run_ends(steps in steps(), acts in acts()) {
        let graph = graph(&steps);
        let (ledger, events) = drive(graph.clone(), &acts);
        let end = ledger.end.expect("drive runs to the end");
        prop_assert!(is_expected(&end, &graph), "{:?}", end);
        prop_assert!(bound_values_fit(&graph, &ledger.log));
        // Readings that are no number are not equal to themselves, but no effect holds one.
        prop_assert_eq!(replay(graph, &events), ledger.log);
    }

    #[test]
    fn a_mutated_graph_is_refused_or_survived(
        steps in steps(),
        acts in acts(),
        node in any::<prop::sample::Index>(),
        other in any::<prop::sample::Index>(),
        what in 0..4_u8,
    ) {
        let mut graph = graph(&steps);
        if graph.nodes.is_empty() {
            return Ok(());
        }
        let last = graph.nodes.len() - 1;
        // One past the last, so that an edge may lead nowhere.
        let (node, other) = (node.index(last + 1), other.index(last + 2));
        match what {
            0 => graph.nodes[node].next = Some(NodeId(other as u32)),
            1 => graph.nodes[node].next = None,
            2 => graph.nodes.swap(node, other.min(last)),
            _ => {
                let kind = graph.nodes[other.min(last)].kind.clone();
                graph.nodes[node].kind = kind;
            }
        }
        if Engine::new(graph.clone(), &StartState::default()).is_ok() {
            drive(graph, &acts);
        }
    }
}
