//! Runs a sketched policy through a script of events and writes down every effect.

use motet_arbitrary::graph::{StepSketch, graph};
use motet_graph::{Graph, Value};
use motet_runtime::{
    Answer, Capabilities, DriverEvent, Effect, Engine, Event, GoalId, Outcome, Pattern, PreparedSwap,
    PrimitiveSet, Query, StartState, Time,
};
use std::collections::BTreeMap;
use std::fmt::Write;

/// An event of a script. Goals go by the number of their start.
pub(crate) enum Feed {
    Ack(u32),
    Done(u32),
    Gives(u32, Value),
    Fails(u32, &'static str),
    Interrupted(u32),
    Refused(u32, &'static str),
    Stopped(u32),
    NotHeld(u32),
    Lost(u32),
    DriverLost,
    DriverGone,
    See(Query, Answer),
    Tick,
    Stop,
    Swap(Vec<StepSketch>),
}

/// The transcript of a policy under a script.
pub(crate) fn transcript(steps: &[StepSketch], script: Vec<(f64, Feed)>) -> String {
    transcript_of(graph(steps), script)
}

/// The transcript of a graph under a script.
pub(crate) fn transcript_of(graph: Graph, script: Vec<(f64, Feed)>) -> String {
    transcript_from(graph, &StartState::default(), script)
}

/// The transcript of a graph under a script, from a state.
pub(crate) fn transcript_from(graph: Graph, start: &StartState, script: Vec<(f64, Feed)>) -> String {
    let go = PrimitiveSet::Only(["go".into()].into());
    let capabilities = Capabilities { update: go, ..Capabilities::default() };
    let mut engine = Engine::new(graph, start).unwrap().with_capabilities(capabilities);
    let mut goals = BTreeMap::new();
    let mut text = String::new();
    step(&mut engine, 0.0, Event::Begin, "begin", &mut goals, &mut text);
    for (at, feed) in script {
        let goal = |number: u32| -> GoalId { goals[&number] };
        let driver = match feed {
            Feed::Ack(number) => DriverEvent::Acknowledged { goal: goal(number) },
            Feed::Done(number) => DriverEvent::Ended { goal: goal(number), outcome: Outcome::Success(None) },
            Feed::Gives(number, value) => {
                DriverEvent::Ended { goal: goal(number), outcome: Outcome::Success(Some(value)) }
            }
            Feed::Fails(number, kind) => {
                DriverEvent::Ended { goal: goal(number), outcome: Outcome::Failure(kind.into()) }
            }
            Feed::Interrupted(number) => {
                DriverEvent::Ended { goal: goal(number), outcome: Outcome::Interrupted }
            }
            Feed::Refused(number, kind) => DriverEvent::Refused { goal: goal(number), failure: kind.into() },
            Feed::Stopped(number) => DriverEvent::Stopped { goal: goal(number) },
            Feed::NotHeld(number) => DriverEvent::NotHeld { goal: goal(number) },
            Feed::Lost(number) => DriverEvent::Lost { goal: goal(number) },
            Feed::DriverLost => DriverEvent::DriverLost,
            Feed::DriverGone => DriverEvent::DriverGone,
            Feed::See(query, answer) => DriverEvent::Observed { query, answer },
            Feed::Tick => {
                step(&mut engine, at, Event::Tick, "tick", &mut goals, &mut text);
                continue;
            }
            Feed::Swap(steps) => {
                swap(&mut engine, at, &steps, &mut goals, &mut text);
                continue;
            }
            Feed::Stop => {
                step(&mut engine, at, Event::Stop, "stop", &mut goals, &mut text);
                continue;
            }
        };
        let label = driver.to_string();
        step(&mut engine, at, Event::Driver(driver), &label, &mut goals, &mut text);
    }
    if let Some(wake) = engine.wake_at() {
        writeln!(text, "wakes at {wake}").unwrap();
    }
    text
}

fn step(
    engine: &mut Engine,
    at: f64,
    event: Event,
    label: &str,
    goals: &mut BTreeMap<u32, GoalId>,
    text: &mut String,
) {
    writeln!(text, "{at} s: {label}").unwrap();
    let mut out = Vec::new();
    engine.handle(Time::from_secs(at), event, &mut out);
    write_down(engine, &out, goals, text);
}

/// The new policy is proved from nothing.
fn swap(
    engine: &mut Engine,
    at: f64,
    steps: &[StepSketch],
    goals: &mut BTreeMap<u32, GoalId>,
    text: &mut String,
) {
    writeln!(text, "{at} s: swap").unwrap();
    let mut graph = graph(steps);
    graph.initial.clear();
    let prepared = PreparedSwap::new(graph, &engine.running()).unwrap();
    let mut out = Vec::new();
    match engine.swap(Time::from_secs(at), prepared, &mut out) {
        Ok(_) => write_down(engine, &out, goals, text),
        Err(refusal) => writeln!(text, "    refused: {refusal}").unwrap(),
    }
}

fn write_down(engine: &Engine, out: &[Effect], goals: &mut BTreeMap<u32, GoalId>, text: &mut String) {
    for effect in out {
        if let Effect::Start { goal, .. } = effect {
            goals.insert(goals.len() as u32 + 1, *goal);
        }
        writeln!(text, "    {}", engine.describe(effect)).unwrap();
    }
}

/// What is seen: `holding(object)`.
pub(crate) fn holding(object: &str, truth: impl Into<Option<bool>>) -> Feed {
    let args = vec![Pattern::Is(Value::Entity(object.into()))];
    see(Query::Fact { fluent: "holding".into(), args }, truth)
}

/// What is seen: `holding(any)`.
pub(crate) fn holding_any(truth: impl Into<Option<bool>>) -> Feed {
    see(Query::Fact { fluent: "holding".into(), args: vec![Pattern::Any] }, truth)
}

/// What is seen: `at(robot, place)`.
pub(crate) fn at(place: &str, truth: impl Into<Option<bool>>) -> Feed {
    let args = ["robot", place].map(|id| Pattern::Is(Value::Entity(id.into()))).to_vec();
    see(Query::Fact { fluent: "at".into(), args }, truth)
}

fn see(query: Query, truth: impl Into<Option<bool>>) -> Feed {
    Feed::See(query, truth.into().map_or(Answer::Unknown, Answer::Truth))
}

/// What is seen: the distance to the user in metres.
pub(crate) fn distance(metres: f64) -> Feed {
    let args = vec![Value::Entity("user".into())];
    Feed::See(Query::Measure { measure: "distance".into(), args }, Answer::Value(Value::Number(metres)))
}

/// An entity as a result.
pub(crate) fn entity(id: &str) -> Value {
    Value::Entity(id.into())
}

/// Compares the transcript of a policy under a script with its snapshot.
#[macro_export]
macro_rules! check {
    ($steps:expr, $script:expr $(,)?) => {
        insta::assert_snapshot!($crate::script::transcript(&$steps, $script.into()))
    };
}
