//! Python scripts beside the engine: on random policies, with random answers and failures, a script makes the
//! same calls in the same order and comes to the same end. Needs `python3`, and is skipped without it.

#![allow(
    clippy::disallowed_methods,
    clippy::print_stderr,
    reason = "scripts are run by the interpreter of Python, where there is one"
)]

use std::collections::{BTreeMap, VecDeque};
use std::path::{Path, PathBuf};
use std::process::Command as Process;

use motet_arbitrary::graph::{CallSketch, StepSketch, WatchSketch, graph, steps, with_named_failures};
use motet_arbitrary::graph::{ReactionSketch, vocabulary as v};
use motet_graph::{Condition, Graph, Value, python};
use motet_runtime::{
    Answer, Command, DriverEvent, Effect, Engine, Event, FailureReport, GoalId, Outcome, Query, RunEnd,
    StartState, Time,
};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::strategy::ValueTree as _;
use proptest::test_runner::TestRunner;

/// The same steps one after the other; a monitor is a deadline.
fn single(steps: &[StepSketch]) -> Vec<StepSketch> {
    let group = |steps: &[StepSketch]| single(steps);
    let one = |step: &StepSketch| match step {
        StepSketch::Call(call) => StepSketch::Call(CallSketch { deadline_secs: 7.3, ..call.clone() }),
        StepSketch::Sequence(steps) => StepSketch::Sequence(group(steps)),
        StepSketch::Monitor(watches, steps) => {
            let deadline = WatchSketch {
                condition: Condition::Literal(true),
                hold_secs: 5.1 * watches.len() as f64 + 0.017,
                react: ReactionSketch::Pause(0.0),
            };
            StepSketch::Monitor(vec![deadline], group(steps))
        }
        StepSketch::Inline(steps) => StepSketch::Inline(group(steps)),
        StepSketch::If(condition, then, other) => {
            StepSketch::If(condition.clone(), group(then), other.as_ref().map(|steps| group(steps)))
        }
        StepSketch::Finally(body, cleanup) => StepSketch::Finally(group(body), group(cleanup)),
        StepSketch::Try(body, handlers) => {
            let handlers = handlers.iter().map(|(on, steps)| (on.clone(), group(steps)));
            StepSketch::Try(group(body), handlers.collect())
        }
        StepSketch::Repeat(times, steps, until) => StepSketch::Repeat(*times, group(steps), until.clone()),
        StepSketch::Each(list, most, steps) => StepSketch::Each(list.clone(), *most, group(steps)),
        StepSketch::Parallel(branches) => StepSketch::Sequence(group(&branches.concat())),
        StepSketch::Wait(..) | StepSketch::Delay(_) | StepSketch::Let(_) | StepSketch::End(_) => step.clone(),
    };
    steps.iter().map(one).collect()
}

/// A number for a text; `harness.py` has the same function.
pub(crate) fn mix(seed: u64, text: &str) -> u64 {
    let mix = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3).rotate_left(5);
    text.bytes().fold(seed ^ 0xcbf2_9ce4_8422_2325, mix) >> 7
}

/// Answer to an observation: always the same.
pub(crate) fn seen(seed: u64, query: &Query) -> Answer {
    match (query, mix(seed, &query.to_string()) % 4) {
        (_, 0) => Answer::Unknown,
        (Query::Fact { .. }, number) => Answer::Truth(number % 2 == 0),
        (Query::Measure { .. } | Query::Field { .. }, number) => {
            Answer::Value(Value::Number(number as f64 / 5.0))
        }
    }
}

/// The end of the goal of a number, and the seconds until then.
fn fate(seed: u64, number: usize, command: &Command) -> (Outcome, f64) {
    let dice = mix(seed, &format!("goal {number}"));
    let object = |number: u64| Value::Entity(["mug", "cup", "bowl"][(number % 3) as usize].into());
    let value = match command.primitive.as_str() {
        "detect" => Some(object(dice)),
        "detect_all" => Some(Value::List((0..dice % 4).map(object).collect())),
        _ => None,
    };
    let outcome = match dice / 8 % 12 {
        0..4 => Outcome::Failure(FailureReport {
            kind: "timeout".into(),
            text: dice.is_multiple_of(2).then(|| format!("because of {number}").into()),
        }),
        _ => Outcome::Success(value),
    };
    // Some last longer than their deadline.
    (outcome, (dice / 128 % 900) as f64 / 100.0 + 0.001)
}

/// The calls of the engine, with their seconds, and the end of the run.
fn played(seed: u64, graph: &Graph) -> Vec<String> {
    let mut engine = Engine::new(graph.clone(), &StartState::default()).unwrap();
    let mut live: BTreeMap<GoalId, (Time, Outcome)> = BTreeMap::new();
    let (mut asked, mut log, mut out, mut started) = (Vec::new(), Vec::new(), Vec::new(), 0);
    let (mut now, mut reports) = (Time::ZERO, VecDeque::new());
    engine.handle(now, Event::Begin, &mut out);
    loop {
        for effect in out.drain(..) {
            match effect {
                Effect::Start { goal, command, .. } => {
                    started += 1;
                    let manner =
                        command.manner.map(|manner| format!(" {:?}/{:?}", manner.speed, manner.acceleration));
                    let plain = Command { manner: None, ..(*command).clone() };
                    log.push(format!("{plain}{}", manner.unwrap_or_default()));
                    let (outcome, secs) = fate(seed, started, &command);
                    live.insert(goal, (now.after(Time::from_secs(secs)), outcome));
                    reports.push_back(DriverEvent::Acknowledged { goal });
                }
                Effect::Cancel { goal } => {
                    live.remove(&goal);
                    reports.push_back(DriverEvent::Ended { goal, outcome: Outcome::Interrupted });
                }
                Effect::Observe { query } | Effect::Watch { query } => asked.push((*query).clone()),
                Effect::Unwatch { .. } | Effect::Report(_) => {}
                Effect::Finished(end) => {
                    log.push(match *end {
                        RunEnd::Done { .. } => "done".to_owned(),
                        RunEnd::Failed { kind, .. } => format!("failed {kind}"),
                        RunEnd::Declined { .. } => "cannot".to_owned(),
                        RunEnd::Replan { .. } => "replan".to_owned(),
                        RunEnd::Interrupted => "interrupted".to_owned(),
                        RunEnd::Fault(fault) => panic!("{fault}"),
                    });
                    return log;
                }
                other => panic!("not expected: {other:?}"),
            }
        }
        let event = if let Some(report) = reports.pop_front() {
            Event::Driver(report)
        } else if !asked.is_empty() {
            let query: Query = asked.remove(0);
            Event::Driver(DriverEvent::Observed { answer: seen(seed, &query), query })
        } else {
            let next = live.iter().min_by_key(|(_, (at, _))| *at).map(|(goal, (at, _))| (*goal, *at));
            match (next, engine.wake_at()) {
                (Some((goal, at)), wake) if wake.is_none_or(|wake| at < wake) => {
                    now = at;
                    let (_, outcome) = live.remove(&goal).unwrap();
                    Event::Driver(DriverEvent::Ended { goal, outcome })
                }
                (_, Some(wake)) => {
                    now = wake;
                    Event::Tick
                }
                (_, None) => panic!("nothing to wait for: {log:?}"),
            }
        };
        engine.handle(now, event, &mut out);
    }
}

/// A graph for which there is a script.
fn sayable(steps: &[StepSketch]) -> Graph {
    with_named_failures(graph(&single(steps)))
}

fn has_python() -> bool {
    Process::new("python3").arg("--version").output().is_ok_and(|said| said.status.success())
}

/// Writes the scripts of graphs, carries them out by `harness.py`, and returns their calls.
fn scripts_played(cases: &[(u64, Graph)]) -> Vec<Vec<String>> {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("scripts");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut run = Process::new("python3");
    run.arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/engine/harness.py"));
    run.env("PYTHONPATH", root.join("python"));
    let known = [("robot", "Entity"), ("user", "Person")].map(|(id, kind)| (id.into(), kind.into()));
    for (index, (seed, graph)) in cases.iter().enumerate() {
        let path = folder.join(format!("case_{index}.py"));
        std::fs::write(&path, python::script(graph, &known).unwrap()).unwrap();
        run.arg(format!("{seed}:{}", path.display()));
    }
    let said = run.output().unwrap();
    assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stderr));
    let text = String::from_utf8(said.stdout).unwrap();
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn python_script_makes_the_calls_of_the_engine() {
    if !has_python() {
        eprintln!("skipped: there is no python3");
        return;
    }
    let mut runner = TestRunner::deterministic();
    let sketches = vec(steps(), 1..4).prop_map(|steps| steps.concat());
    let cases: Vec<(u64, Graph)> = (0..600_u64)
        .map(|seed| (seed, sayable(&sketches.new_tree(&mut runner).unwrap().current())))
        .collect();
    let scripts = scripts_played(&cases);
    assert_eq!(scripts.len(), cases.len());
    let mut calls = 0;
    for (index, ((seed, graph), script)) in cases.iter().zip(&scripts).enumerate() {
        let engine = played(*seed, graph);
        calls += engine.len() - 1;
        assert_eq!(*script, engine, "case {index}:\n{}", motet_graph::draw::text(graph));
    }
    assert!(calls > 1_000, "{calls} calls");
}

#[test]
fn python_script_cannot_say_what_runs_beside_something() {
    let go = || vec![StepSketch::go("table")];
    let near = WatchSketch::new(v::nearer("user", 0.5), ReactionSketch::Pause(3.0));
    for (steps, path, words) in [
        (
            vec![StepSketch::Sequence(vec![StepSketch::Parallel(vec![go(), go()])])],
            "/steps/0/0",
            "`parallel`",
        ),
        (vec![StepSketch::go("shelf"), StepSketch::Monitor(vec![near], go())], "/steps/1", "`monitor`"),
    ] {
        let why = python::script(&graph(&steps), &[]).unwrap_err();
        assert_eq!((why.path.as_str(), why.what.contains(words)), (path, true), "{why}");
    }
}
