//! BehaviorTree.CPP beside the engine: on random policies, with random answers and failures, an exported tree
//! makes the same calls in the same order and comes to the same end. `tests/peers/btcpp/run.sh` builds the
//! runner and names it in `MOTET_BTCPP_RUNNER`; without one the test is skipped.

#![allow(
    clippy::disallowed_methods,
    clippy::print_stderr,
    reason = "the peer is another program, and the variable names it"
)]

use std::collections::{BTreeMap, VecDeque};
use std::path::PathBuf;
use std::process::Command as Process;

use motet_arbitrary::graph::graph;
use motet_btcpp::{Leaves, PortType, export};
use motet_graph::{Graph, NodeKind, Value};
use motet_runtime::{
    Answer, Command, Driver, DriverEvent, Engine, FailureReport, GoalId, Outcome, Pattern, Query, RunEnd,
    StartState, Time, Truth,
};
use proptest::strategy::{Strategy as _, ValueTree as _};
use proptest::test_runner::TestRunner;

use super::sketch::{Use, sayable};

/// Ends of calls that are nearer are not told apart: the decorators of a tree take some ticks.
const NEAR: Time = Time::from_nanos(100_000_000_000);
/// Number of policies that are compared.
const CASES: usize = 200;
const OBJECTS: [&str; 3] = ["mug", "cup", "bowl"];

fn mix(seed: u64, text: &str) -> u64 {
    let start = seed ^ 0xcbf2_9ce4_8422_2325;
    text.bytes()
        .fold(start, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3).rotate_left(5))
        >> 7
}

/// Number of the answer to a query. With an odd seed everything is known.
fn number(seed: u64, text: &str) -> u64 {
    match mix(seed, text) % 4 {
        0 if seed % 2 == 1 => 2,
        number => number,
    }
}

fn truth(seed: u64, text: &str) -> Truth {
    if text.contains("any") {
        let each = OBJECTS.iter().map(|object| truth(seed, &text.replacen("any", object, 1)));
        return each.fold(Truth::False, Truth::or);
    }
    match number(seed, text) {
        0 => Truth::Unknown,
        number if number % 2 == 0 => Truth::True,
        _ => Truth::False,
    }
}

/// A driver of dice, as the runner has them.
struct Dice {
    seed: u64,
    now: Time,
    started: usize,
    log: Vec<String>,
    live: BTreeMap<GoalId, (Time, Outcome)>,
    reports: VecDeque<DriverEvent>,
    /// True once two calls ended so near that their order is a matter of ticks.
    is_close: bool,
}

impl Dice {
    fn answer(&mut self, query: &Query) {
        let text = query.to_string();
        let answer = match query {
            Query::Fact { .. } => match truth(self.seed, &text) {
                Truth::Unknown => Answer::Unknown,
                known => Answer::Truth(known == Truth::True),
            },
            Query::Measure { .. } | Query::Field { .. } => match number(self.seed, &text) {
                0 => Answer::Unknown,
                number => Answer::Value(Value::Number(number as f64 / 5.0)),
            },
        };
        self.reports.push_back(DriverEvent::Observed { query: query.clone(), answer });
    }
}

impl Driver for Dice {
    fn start(&mut self, now: Time, goal: GoalId, command: &Command) {
        self.started += 1;
        let args: Vec<String> = command.args.iter().map(|(_, value)| text(value)).collect();
        self.log.push(format!("{}({})", command.primitive, args.join(", ")));
        let dice = mix(self.seed, &format!("goal {}", self.started));
        let object = |number: u64| Value::Entity(OBJECTS[(number % 3) as usize].into());
        let outcome = match (dice / 8 % 12) as usize {
            fate @ 0..4 => {
                let kind = ["timeout", "failed", "unreachable", "not_found"][fate];
                Outcome::Failure(FailureReport { kind: kind.into(), text: None })
            }
            _ => Outcome::Success(match command.primitive.as_str() {
                "detect" => Some(object(dice)),
                "detect_all" => Some(Value::List((0..dice % 4).map(object).collect())),
                _ => None,
            }),
        };
        let end = now.after(Time::from_secs((1 + dice / 128 % 2000) as f64));
        let is_near = |other: &Time| other.since(end).max(end.since(*other)) < NEAR;
        self.is_close |= self.live.values().any(|(other, _)| is_near(other));
        self.live.insert(goal, (end, outcome));
        self.reports.push_back(DriverEvent::Acknowledged { goal });
    }

    fn cancel(&mut self, _now: Time, goal: GoalId) {
        self.live.remove(&goal);
        self.reports.push_back(DriverEvent::Ended { goal, outcome: Outcome::Interrupted });
    }

    fn update(&mut self, _now: Time, _goal: GoalId, _command: &Command) {}
    fn hold(&mut self, _now: Time, _goal: GoalId) {}
    fn proceed(&mut self, _now: Time, _goal: GoalId) {}
    fn safe_stop(&mut self, _now: Time, _goal: GoalId) {}

    fn observe(&mut self, _now: Time, query: &Query) {
        self.answer(query);
    }

    fn watch(&mut self, _now: Time, query: &Query) {
        self.answer(query);
    }

    fn unwatch(&mut self, _now: Time, _query: &Query) {}

    fn advance(&mut self, until: Time) -> Option<(Time, DriverEvent)> {
        if let Some(report) = self.reports.pop_front() {
            return Some((self.now, report));
        }
        let next = self.live.iter().min_by_key(|(_, (at, _))| *at).map(|(goal, (at, _))| (*goal, *at));
        let Some((goal, at)) = next.filter(|(_, at)| *at <= until) else {
            self.now = if until == Time::NEVER { self.now } else { until };
            return None;
        };
        self.now = at;
        let (_, outcome) = self.live.remove(&goal)?;
        Some((at, DriverEvent::Ended { goal, outcome }))
    }
}

/// A value as the port of a leaf has it.
fn text(value: &Value) -> String {
    match value {
        Value::Text(text) | Value::Entity(text) | Value::Case(text) => text.to_string(),
        Value::List(items) => items.iter().map(text).collect::<Vec<_>>().join(";"),
        Value::Bool(_) | Value::Int(_) | Value::Number(_) | Value::Pose(_) => value.to_string(),
    }
}

/// The calls of the engine and the end of its run; none where the order of calls is a matter of ticks.
fn played(seed: u64, graph: &Graph) -> Option<Vec<String>> {
    let mut dice = Dice {
        seed,
        now: Time::ZERO,
        started: 0,
        log: Vec::new(),
        live: BTreeMap::new(),
        reports: VecDeque::new(),
        is_close: false,
    };
    let mut start = StartState::default();
    if seed % 2 == 1 {
        let is = |id: &str| Pattern::Is(Value::Entity(id.into()));
        let held = OBJECTS.map(|id| Query::Fact { fluent: "holding".into(), args: vec![is(id)] });
        let at = ["table", "shelf", "user"]
            .map(|id| Query::Fact { fluent: "at".into(), args: vec![is("robot"), is(id)] });
        for query in held.into_iter().chain(at) {
            let holds = truth(seed, &query.to_string());
            start.facts.push((query, holds));
        }
    }
    let mut engine = Engine::new(graph.clone(), &start).unwrap();
    let end = motet_runtime::run(&mut engine, &mut dice, &mut (), Time::ZERO);
    let (ending, outcome) = match end {
        RunEnd::Done { .. } => (None, "success"),
        RunEnd::Failed { .. } | RunEnd::Declined { .. } | RunEnd::Replan { .. } => {
            (None::<String>, "failure")
        }
        RunEnd::Interrupted | RunEnd::Fault(_) => panic!("{end:?}"),
    };
    dice.log.extend(ending);
    dice.log.push(outcome.to_owned());
    (!dice.is_close).then_some(dice.log)
}

/// A graph without what changes facts, so that a test finds what it observes.
fn still(mut graph: Graph, seed: u64) -> Graph {
    graph.initial.clear();
    graph.observe_within_secs = 0.001;
    for node in &mut graph.nodes {
        match &mut node.kind {
            NodeKind::Call(call) => {
                call.effects.clear();
                call.unsettles.clear();
            }
            // What is unknown fires a monitor in the tree at once, and in the engine after a time.
            NodeKind::Monitor { watches, .. } if seed.is_multiple_of(2) => {
                watches.retain(|watch| watch.condition == motet_graph::Condition::Literal(true));
            }
            _ => {}
        }
    }
    graph
}

/// Names of the ports of the vocabulary's conditions.
fn leaves() -> Leaves {
    let ports = |names: &[&str]| names.iter().map(|name| ((*name).into(), PortType::Name)).collect();
    Leaves {
        fluents: vec![("holding".into(), ports(&["object"])), ("at".into(), ports(&["what", "where"]))],
        measures: vec![("distance".into(), ports(&["to"]), PortType::Number)],
        ..Leaves::default()
    }
}

#[test]
fn exported_tree_makes_the_calls_of_the_engine() {
    let Some(runner) = std::env::var_os("MOTET_BTCPP_RUNNER") else {
        eprintln!("skipped: tests/peers/btcpp/run.sh builds BehaviorTree.CPP and runs this");
        return;
    };
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("trees");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    let mut dice = TestRunner::deterministic();
    let sketches = sayable(Use::Peer).no_shrink();
    let (mut cases, mut peer) = (Vec::new(), Process::new(runner));
    let (mut refused, mut close) = (0, 0);
    for seed in 0..10_000_u64 {
        let graph = still(graph(&sketches.new_tree(&mut dice).unwrap().current()), seed);
        if motet_graph::validate(&graph).is_err() {
            continue;
        }
        // The engine observes before it starts a branch, and the tree does not. So the order of branches
        // differs, and how far each comes before another one fails.
        if graph.nodes.iter().any(|node| matches!(node.kind, NodeKind::Parallel { .. })) {
            continue;
        }
        let Ok(tree) = export(&graph, &leaves()) else {
            refused += 1;
            continue;
        };
        let Some(calls) = played(seed, &graph).filter(|calls| calls.len() > 2) else {
            close += 1;
            continue;
        };
        let path = folder.join(format!("case_{}.xml", cases.len()));
        std::fs::write(&path, &tree).unwrap();
        peer.arg(format!("{seed}:{}", path.display()));
        cases.push((calls, graph, path));
        if cases.len() == CASES {
            break;
        }
    }
    let said = peer.output().unwrap();
    assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stderr));
    let lines = String::from_utf8(said.stdout).unwrap();
    let lines: Vec<&str> = lines.lines().collect();
    assert_eq!((cases.len(), lines.len()), (CASES, CASES));
    let (mut calls, mut kinds) = (0, BTreeMap::<String, usize>::new());
    for ((engine, graph, path), line) in cases.iter().zip(lines) {
        let quoted: Vec<String> = engine.iter().map(|call| format!("{call:?}")).collect();
        let expected = format!("[{}]", quoted.join(", "));
        let why = format!("{}\n{}", path.display(), motet_graph::draw::text(graph));
        assert_eq!(line, expected, "{why}");
        calls += engine.len() - 1;
        for word in std::fs::read_to_string(path)
            .unwrap()
            .split('<')
            .filter_map(|tag| tag.split([' ', '>', '/']).next())
        {
            *kinds.entry(word.to_owned()).or_default() += 1;
        }
    }
    eprintln!(
        "{CASES} policies with {calls} calls; {refused} refused, {close} too close or too short; {kinds:?}"
    );
    for kind in ["Fallback", "IfThenElse", "RetryUntilSuccessful", "LoopString", "ReactiveSequence"] {
        assert!(kinds.contains_key(kind), "no tree has a `{kind}`");
    }
    assert!(calls > 500, "{calls} calls");
}
