//! Random graphs under random events and random swaps: no panic, the laws of effects hold, every run ends, a
//! refused swap changes nothing, and a replay is the same.

use crate::verify::with_motions;
use motet_arbitrary::graph::vocabulary::{PICK, PLACE};
use motet_arbitrary::graph::{StepSketch, graph, steps, vocabulary as v, with_named_failures};
use motet_graph::{Condition, Graph, NodeId, NodeKind, PrimitiveId, Type, Value};
use motet_runtime::{
    Answer, Capabilities, CheckId, DriverEvent, Effect, Engine, EngineSettings, Event, Fault, GoalId,
    NodeEnding, Outcome, PreparedSwap, PrimitiveSet, Query, RunEnd, StartState, Time, TraceEventKind,
    Verification,
};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::SeedableRng as _;
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
    Swap(u8),
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
        2 => any::<u8>().prop_map(Act::Swap),
    ];
    vec((prop_oneof![Just(0), 0..1_000_000_000_u64], act), 0..150)
}

/// A live goal as a driver knows it.
#[derive(Debug)]
struct Goal {
    /// With the number of its graph.
    node: (u32, NodeId),
    primitive: String,
    uses: Vec<String>,
    acknowledged: bool,
    cancelled: bool,
    held: bool,
}

/// How much was tried.
#[derive(Clone, Copy, Default, Debug)]
struct Counts {
    events: u64,
    swaps: u64,
    committed: u64,
    /// Committed while a goal was live.
    in_action: u64,
    kept: u64,
    updated: u64,
}

impl Counts {
    fn add(&mut self, other: Self) {
        self.events += other.events;
        self.swaps += other.swaps;
        self.committed += other.committed;
        self.in_action += other.in_action;
        self.kept += other.kept;
        self.updated += other.updated;
    }
}

/// Primitives whose motions are left to the run; the others are free to be updated.
const ASKED: [PrimitiveId; 2] = [PICK, PLACE];

/// How often each policy runs.
const RUNS: usize = 135;

/// What the laws allow, kept beside the engine.
#[derive(Default)]
struct Ledger {
    live: BTreeMap<GoalId, Goal>,
    ever: BTreeSet<GoalId>,
    watched: Vec<Query>,
    asked: Vec<Query>,
    checks: Vec<CheckId>,
    ever_asked: BTreeSet<CheckId>,
    entered: BTreeSet<(u32, NodeId)>,
    /// Goals whose end was not reported, with their steps. That of a success is the end of its step.
    unended: BTreeMap<GoalId, (u32, NodeId)>,
    revision: u32,
    counts: Counts,
    end: Option<RunEnd>,
    log: Vec<Effect>,
    /// Whether the driver fails only in listed ways.
    strict: bool,
}

impl Ledger {
    fn take(&mut self, effects: &[Effect]) {
        for effect in effects {
            assert!(self.end.is_none(), "an effect after the end: {effect:?}");
            self.log.push(effect.clone());
            match effect {
                Effect::Start { goal, node, command, .. } => {
                    assert!(self.ever.insert(*goal), "a goal id is used twice");
                    self.unended.insert(*goal, (self.revision, *node));
                    let uses: Vec<String> = command.uses.iter().map(ToString::to_string).collect();
                    let node = (self.revision, *node);
                    for other in self.live.values() {
                        assert!(other.node != node, "a step has two goals");
                        assert!(!conflict(&other.uses, &uses), "{other:?} holds what {command:?} needs");
                    }
                    let primitive = command.primitive.to_string();
                    let goal_state =
                        Goal { node, primitive, uses, acknowledged: false, cancelled: false, held: false };
                    self.live.insert(*goal, goal_state);
                }
                Effect::Cancel { goal } => {
                    let goal = self.live.get_mut(goal).expect("a cancel of a goal that is not live");
                    assert!(goal.acknowledged && !goal.cancelled, "a cancel too early or twice");
                    goal.cancelled = true;
                }
                Effect::Update { goal, node, command, .. } => {
                    let state = self.live.get_mut(goal).expect("an update of a goal that is not live");
                    assert!(state.acknowledged && !state.cancelled, "an update out of place");
                    assert_eq!(state.primitive, command.primitive.as_str());
                    state.node = (self.revision, *node);
                    self.unended.insert(*goal, state.node);
                    self.counts.updated += 1;
                }
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
                Effect::Verify { check, .. } => {
                    assert!(self.ever_asked.insert(*check), "a check is asked for twice");
                    self.checks.push(*check);
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
                    TraceEventKind::Entered { node } => {
                        assert!(self.entered.insert((record.revision, *node)), "entered twice")
                    }
                    TraceEventKind::Ended { node, ending, .. } => {
                        if *ending == NodeEnding::Success {
                            self.unended.retain(|_, of| *of != (record.revision, *node));
                        }
                        assert!(self.entered.remove(&(record.revision, *node)), "ended without an entry")
                    }
                    TraceEventKind::Started { node, .. } | TraceEventKind::Updated { node, .. } => {
                        assert!(self.entered.contains(&(record.revision, *node)), "a step that does not run");
                    }
                    TraceEventKind::GoalEnded { node, goal, .. } => {
                        assert!(self.unended.remove(goal).is_some(), "a goal ends twice");
                        let here = self.entered.contains(&(record.revision, *node));
                        assert!(
                            here || record.revision < self.revision,
                            "a goal of a step that does not run"
                        );
                    }
                    TraceEventKind::Kept { node, goal } => {
                        let state = self.live.get_mut(goal).expect("a goal that is not live goes on");
                        assert!(!state.cancelled, "a cancelled goal goes on");
                        state.node = (record.revision, *node);
                        self.unended.insert(*goal, state.node);
                        self.counts.kept += 1;
                    }
                    TraceEventKind::Swapped { .. } => {
                        assert!(self.entered.is_empty(), "swapped with running steps");
                        assert_eq!(record.revision, self.revision + 1);
                        self.revision = record.revision;
                    }
                    TraceEventKind::Guard { .. }
                    | TraceEventKind::GoalObserved { .. }
                    | TraceEventKind::Tested { .. }
                    | TraceEventKind::Fired { .. } => {}
                    TraceEventKind::WentOn { .. }
                    | TraceEventKind::Bound { .. }
                    | TraceEventKind::CleanupFailed { .. }
                    | TraceEventKind::CleanupSkipped { .. }
                    | TraceEventKind::Verified { .. } => {}
                },
                Effect::Finished(end) => {
                    if !matches!(**end, RunEnd::Fault(_)) {
                        assert!(self.live.is_empty(), "over with live goals");
                        assert!(self.watched.is_empty(), "over with watches");
                        assert!(self.entered.is_empty(), "over with running steps");
                        assert!(self.unended.is_empty(), "over with goals whose end was not reported");
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

    /// A failure of a goal: mostly one that its primitive lists.
    fn kind(&self, goal: GoalId, number: u8) -> &'static str {
        let listed: &[&str] = match self.live[&goal].primitive.as_str() {
            "go" | "place" => &["timeout", "unreachable"],
            "pick" => &["timeout", "unreachable", "not_found"],
            "detect" => &["timeout", "not_found"],
            _ => &["timeout"],
        };
        match number {
            250.. if !self.strict => "made_up",
            number => listed[usize::from(number) % listed.len()],
        }
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
                let kind = self.kind(goal, *kind);
                self.live.remove(&goal);
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
                let kind = self.kind(goal, *number);
                self.live.remove(&goal);
                DriverEvent::Refused { goal, failure: kind.into() }
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
            // What nobody waits for any more is answered too: it is to be ignored.
            Act::Answer(number, answer) if number % 2 == 1 && !self.checks.is_empty() => {
                let check = self.checks.remove(usize::from(*number) % self.checks.len());
                return Some(Event::Verified { check, verdict: verdict(*answer) });
            }
            Act::Answer(number, answer) => {
                let open: Vec<&Query> = self.watched.iter().chain(&self.asked).collect();
                let query = (*open.get(usize::from(*number).checked_rem(open.len())?)?).clone();
                self.asked.retain(|asked| *asked != query);
                DriverEvent::Observed { answer: answer_to(&query, *answer), query }
            }
            Act::ToWake | Act::Nothing => return Some(Event::Tick),
            Act::Stop => return Some(Event::Stop),
            Act::Swap(_) => return None,
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

fn verdict(number: u8) -> Verification {
    match number % 4 {
        0 => Verification::Infeasible { failure: "unreachable".into(), why: "too far".into() },
        1 => Verification::Unknown { why: "too hard".into() },
        _ => Verification::Feasible { witness: None, leaves: None },
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

/// What is fed to an engine.
#[derive(Clone, Debug)]
enum Input {
    Event(Event),
    Swap(Box<Graph>),
}

/// It can update `go` and `pick`, and hold all but `place`.
fn engine(graph: Graph) -> Result<Engine, Vec<motet_graph::InvalidGraph>> {
    let only = |names: &[&str]| PrimitiveSet::Only(names.iter().map(|name| (*name).into()).collect());
    let hold = only(&["go", "pick", "detect", "detect_all", "say"]);
    let capabilities = Capabilities { hold, update: only(&["go", "pick"]), ..Capabilities::default() };
    let settings =
        EngineSettings { verify_within: Some(Time::from_nanos(300_000_000)), ..EngineSettings::default() };
    let engine = Engine::new(graph, &StartState::default())?.with_settings(settings);
    Ok(engine.with_capabilities(capabilities))
}

/// Swaps, and sees that a refused one changes nothing.
fn swap(engine: &mut Engine, ledger: &mut Ledger, now: Time, graph: Graph, out: &mut Vec<Effect>) -> bool {
    ledger.counts.swaps += 1;
    let live = !ledger.live.is_empty();
    let before = engine.clone();
    let prepared = PreparedSwap::new(graph, &engine.running()).expect("sketched graphs are valid");
    match engine.swap(now, prepared, out) {
        Ok(retired) => {
            assert_eq!(retired.revision() + 1, engine.revision());
            ledger.counts.committed += 1;
            ledger.counts.in_action += u64::from(live);
            true
        }
        Err(_) => {
            assert_eq!(format!("{engine:?}"), format!("{before:?}"), "a refused swap changed something");
            assert!(out.is_empty(), "a refused swap has effects");
            false
        }
    }
}

/// Runs a graph through random acts, then to its end with a driver that does its best. Returns what was fed.
fn drive(
    engine: &Engine,
    others: &[Graph],
    acts: &[(u64, Act)],
    strict: bool,
) -> (Ledger, Vec<(Time, Input)>) {
    let mut engine = engine.clone();
    let (mut ledger, mut inputs, mut out) = (Ledger { strict, ..Ledger::default() }, Vec::new(), Vec::new());
    let mut now = Time::ZERO;
    let mut feed = |engine: &mut Engine, ledger: &mut Ledger, now: Time, input: Input| {
        out.clear();
        ledger.counts.events += 1;
        match &input {
            Input::Event(event) => engine.handle(now, event.clone(), &mut out),
            Input::Swap(graph) => {
                if !swap(engine, ledger, now, (**graph).clone(), &mut out) {
                    return;
                }
            }
        }
        inputs.push((now, input));
        ledger.take(&out);
    };
    feed(&mut engine, &mut ledger, now, Input::Event(Event::Begin));
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
        let input = match act {
            Act::Swap(number) => usize::from(*number)
                .checked_rem(others.len())
                .and_then(|index| others.get(index).cloned())
                .map(|graph| Input::Swap(Box::new(graph))),
            act => ledger.event(act).map(Input::Event),
        };
        if let Some(input) = input {
            feed(&mut engine, &mut ledger, now, input);
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
            None if !ledger.checks.is_empty() => ledger.event(&Act::Answer(1, (round % 256) as u8)),
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
        feed(&mut engine, &mut ledger, now, Input::Event(event));
    }
    assert!(engine.is_over());
    assert_eq!(engine.wake_at(), None);
    (ledger, inputs)
}

fn replay(engine: &Engine, inputs: &[(Time, Input)]) -> Vec<Effect> {
    let mut engine = engine.clone();
    let mut out = Vec::new();
    for (now, input) in inputs {
        match input {
            Input::Event(event) => engine.handle(*now, event.clone(), &mut out),
            Input::Swap(graph) => {
                let prepared = PreparedSwap::new((**graph).clone(), &engine.running()).unwrap();
                engine.swap(*now, prepared, &mut out).unwrap();
            }
        }
    }
    out
}

/// Whether the values that were bound have their types.
fn bound_values_fit(graphs: &[&Graph], log: &[Effect]) -> bool {
    log.iter().all(|effect| match effect {
        Effect::Report(record) => match &record.what {
            TraceEventKind::Bound { binding, value } => {
                let ty: &Type = &graphs[record.revision as usize].bindings[binding.index()].ty;
                value.fits(ty)
            }
            _ => true,
        },
        _ => true,
    })
}

/// The failures that a policy may end in: the engine's own, and those that the contracts of what it calls
/// list.
fn listed(graph: &Graph) -> BTreeSet<&str> {
    let mut listed = BTreeSet::from(["timeout", "failed", "exhausted"]);
    for node in &graph.nodes {
        let NodeKind::Call(call) = &node.kind else { continue };
        let fails = graph.primitives[call.primitive.index()].fails.iter();
        let needs = call.needs.iter().map(|need| &need.failure);
        listed.extend(fails.chain(needs).map(|id| graph.failures[id.index()].as_str()));
    }
    listed
}

/// Whether a run may end like that.
fn is_expected(end: &RunEnd, graph: &Graph, strict: bool) -> bool {
    match end {
        RunEnd::Done { .. } | RunEnd::Declined { .. } | RunEnd::Replan { .. } | RunEnd::Interrupted => true,
        RunEnd::Failed { why: Some(why), .. } if why.starts_with("the goal does not hold") => true,
        RunEnd::Failed { node, kind, .. } => {
            node.index() < graph.nodes.len() && (!strict || listed(graph).contains(kind.as_str()))
        }
        RunEnd::Fault(fault) => matches!(fault, Fault::NotStopped { .. }),
    }
}

/// A policy, others to swap to, and the seed of what happens. The others are one of its own, the policy
/// itself, proved from nothing, and itself with something before it, so that goals are often met again.
fn cases() -> impl Strategy<Value = (Graph, Vec<Graph>, u64)> {
    (vec(steps(), 2..5), steps(), any::<bool>(), any::<u64>()).prop_map(|(own, other, proved, seed)| {
        let own = own.concat();
        let named = |steps: &[StepSketch]| with_named_failures(graph(steps));
        let graph = |steps: &[StepSketch]| {
            let held = Condition::Fact(v::fact(v::HOLDING, vec![v::entity("mug")]));
            let goal = if seed % 2 == 0 { vec![held] } else { Vec::new() };
            Graph { goal, ..with_motions(named(steps), &ASKED) }
        };
        let mut others = vec![graph(&other), graph(&own), graph(&[own.clone(), other.clone()].concat())];
        others.iter_mut().skip(usize::from(proved)).for_each(|graph| graph.initial.clear());
        (graph(&own), others, seed)
    })
}

/// Happenings at random.
struct Dice(SplitMix64);

impl Dice {
    fn below(&mut self, limit: u64) -> u64 {
        self.0.next_u64() % limit
    }

    fn byte(&mut self) -> u8 {
        self.below(256) as u8
    }

    /// What happens, in the proportions of [`acts`].
    fn acts(&mut self) -> Vec<(u64, Act)> {
        let act = |dice: &mut Self| match dice.below(62) {
            0..10 => Act::Acknowledge(dice.byte()),
            10..20 => Act::Succeed(dice.byte()),
            20..22 => Act::Fail(dice.byte(), dice.byte()),
            22..26 => Act::Interrupted(dice.byte()),
            26 => Act::Refuse(dice.byte()),
            27..29 => Act::NotHeld(dice.byte()),
            29 => Act::Stopped(dice.byte()),
            30 => Act::Lost(dice.byte()),
            31..51 => Act::Answer(dice.byte(), dice.byte()),
            51..57 => Act::ToWake,
            57 if dice.below(10) == 0 => Act::Stop,
            57..59 => Act::Nothing,
            _ => Act::Swap(dice.byte()),
        };
        (0..self.below(200)).map(|_| (self.below(2) * self.below(1_000_000_000), act(self))).collect()
    }
}

#[test]
fn engine_laws_hold_and_every_run_ends() {
    let config = ProptestConfig {
        cases: 1_200,
        max_shrink_iters: 2_000,
        failure_persistence: None,
        ..ProptestConfig::default()
    };
    let total = std::cell::RefCell::new(Counts::default());
    let result = TestRunner::new(config).run(&cases(), |(graph, others, seed)| {
        let mut dice = Dice(SplitMix64::seed_from_u64(seed));
        let engine = engine(graph.clone()).unwrap();
        for run in 0..RUNS {
            let strict = dice.below(2) == 0;
            let (ledger, inputs) = drive(&engine, &others, &dice.acts(), strict);
            let swapped = inputs.iter().filter_map(|(_, input)| match input {
                Input::Swap(graph) => Some(&**graph),
                Input::Event(_) => None,
            });
            let graphs: Vec<&Graph> = std::iter::once(&graph).chain(swapped).collect();
            let end = ledger.end.expect("drive runs to the end");
            prop_assert!(is_expected(&end, graphs[graphs.len() - 1], strict), "{:?}", end);
            prop_assert!(bound_values_fit(&graphs, &ledger.log));
            // Readings that are no number are not equal to themselves, but no effect holds one.
            if run % 8 == 0 {
                prop_assert_eq!(replay(&engine, &inputs), ledger.log);
            }
            total.borrow_mut().add(ledger.counts);
        }
        Ok(())
    });
    result.unwrap_or_else(|failure| panic!("{failure}"));
    let counts = total.into_inner();
    assert!(counts.events >= 1_000_000, "{counts:?}");
    assert!(counts.committed * 2 >= counts.swaps, "{counts:?}");
    assert!(counts.in_action * 3 >= counts.committed, "{counts:?}");
    assert!(counts.kept > 0 && counts.updated > 0, "{counts:?}");
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 1_024,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn engine_mutated_graph_is_refused_or_survived(
        steps in steps(),
        acts in acts(),
        node in any::<prop::sample::Index>(),
        other in any::<prop::sample::Index>(),
        what in 0..4_u8,
    ) {
        let mut graph = with_motions(graph(&steps), &ASKED);
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
        if let Ok(engine) = engine(graph) {
            drive(&engine, &[], &acts, false);
        }
    }
}
