//! Cost of a step, an idle event and a swap, compared with `bonsai-bt`. The driver succeeds at once, the
//! trace is on: each step is an event, its records and the next start.

#[path = "steps/beside.rs"]
mod beside;
#[path = "steps/swaps.rs"]
mod swaps;

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use motet_arbitrary::graph::{CallSketch, ReactionSketch, StepSketch, WatchSketch, graph, vocabulary as v};
use motet_graph::{Condition, Value};
use motet_runtime::{
    Answer, DriverEvent, Effect, Engine, Event, GoalId, Outcome, Pattern, Query, StartState, Time,
};
use std::hint::black_box;

/// Runs to the end with a driver that succeeds at once. Returns how many effects went out.
fn run(engine: &mut Engine, out: &mut Vec<Effect>) -> usize {
    let mut effects = 0;
    let mut event = Event::Begin;
    loop {
        out.clear();
        engine.handle(Time::ZERO, event, out);
        effects += out.len();
        let Some(goal) = started(out) else { return effects };
        event = Event::Driver(DriverEvent::Ended { goal, outcome: Outcome::Success(None) });
    }
}

fn started(out: &[Effect]) -> Option<GoalId> {
    out.iter().rev().find_map(|effect| match effect {
        Effect::Start { goal, .. } => Some(*goal),
        _ => None,
    })
}

pub(crate) fn engine(steps: &[StepSketch]) -> Engine {
    // Without a word where a sketch is invalid: the layout's own tests see to it that none is.
    Engine::new(graph(steps), &StartState::default()).unwrap_or_else(|_| engine(&[]))
}

/// A sequence of calls that need nothing and change nothing.
fn calls(c: &mut Criterion) {
    let mut group = c.benchmark_group("sequence of calls");
    for count in [10_usize, 100, 1_000, 10_000] {
        let engine = engine(&vec![StepSketch::say("hello"); count]);
        let mut out = Vec::with_capacity(64);
        group.throughput(Throughput::Elements(count as u64));
        group.bench_function(BenchmarkId::from_parameter(count), |b| {
            b.iter_batched_ref(
                || engine.clone(),
                |engine| black_box(run(engine, &mut out)),
                BatchSize::LargeInput,
            );
        });
    }
    group.finish();
}

/// A sequence of tests that hold, all in one event: transitions without a driver.
fn tests(c: &mut Criterion) {
    let mut group = c.benchmark_group("sequence of tests");
    for count in [10_usize, 1_000, 10_000] {
        let engine = engine(&vec![StepSketch::If(Condition::Literal(true), vec![], None); count]);
        let mut out = Vec::with_capacity(8 * count);
        group.throughput(Throughput::Elements(count as u64));
        group.bench_function(BenchmarkId::from_parameter(count), |b| {
            b.iter_batched_ref(
                || engine.clone(),
                |engine| black_box(run(engine, &mut out)),
                BatchSize::LargeInput,
            );
        });
    }
    group.finish();
}

/// Groups in groups around one call.
fn nesting(c: &mut Criterion) {
    let deep = (0..1_000).fold(StepSketch::say("hello"), |inner, _| StepSketch::Sequence(vec![inner]));
    let engine = engine(&[deep]);
    let mut out = Vec::with_capacity(4_000);
    c.bench_function("nesting 1000", |b| {
        b.iter_batched_ref(
            || engine.clone(),
            |engine| black_box(run(engine, &mut out)),
            BatchSize::LargeInput,
        );
    });
}

/// A thousand monitors over one call: a tick in which nothing happens, and an observation that one of them
/// depends on.
fn monitors(c: &mut Criterion) {
    let deep = (0..1_000).fold(StepSketch::go("table"), |inner, index| {
        let held = Condition::Fact(v::fact(v::HOLDING, vec![v::entity(&format!("mug_{index}"))]));
        StepSketch::Monitor(vec![WatchSketch::new(held, ReactionSketch::Pause(60.0))], vec![inner])
    });
    let mut engine = engine(&[deep]);
    let mut out = Vec::new();
    engine.handle(Time::ZERO, Event::Begin, &mut out);
    c.bench_function("1000 monitors, idle tick", |b| {
        b.iter(|| {
            out.clear();
            engine.handle(Time::from_nanos(1), black_box(Event::Tick), &mut out);
        });
    });
    let args = vec![Pattern::Is(Value::Entity("mug_500".into()))];
    let query = Query::Fact { fluent: "holding".into(), args };
    c.bench_function("1000 monitors, one observation", |b| {
        b.iter(|| {
            out.clear();
            let (query, answer) = (query.clone(), Answer::Truth(false));
            let event = Event::Driver(DriverEvent::Observed { query, answer });
            engine.handle(Time::from_nanos(1), black_box(event), &mut out);
        });
    });
}

/// A call with a guard that is believed and effects that are written.
fn contracts(c: &mut Criterion) {
    let pick = StepSketch::Call(CallSketch::new(v::PICK, vec![v::entity("mug")]));
    let place = StepSketch::Call(CallSketch::new(v::PLACE, vec![v::entity("mug"), v::entity("table")]));
    let steps: Vec<StepSketch> = (0..500).flat_map(|_| [pick.clone(), place.clone()]).collect();
    let engine = engine(&steps);
    let mut out = Vec::with_capacity(64);
    let mut group = c.benchmark_group("calls with guards and effects");
    group.throughput(Throughput::Elements(steps.len() as u64));
    group.bench_function("1000", |b| {
        b.iter_batched_ref(
            || engine.clone(),
            |engine| black_box(run(engine, &mut out)),
            BatchSize::LargeInput,
        );
    });
    group.finish();
}

criterion_group!(
    benches,
    calls,
    tests,
    nesting,
    monitors,
    contracts,
    beside::trees,
    swaps::swaps,
    swaps::bindings
);
criterion_main!(benches);
