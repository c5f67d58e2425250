//! Swaps in the middle of an action, and reading a binding.

use super::engine;
use criterion::{BatchSize, BenchmarkId, Criterion, Throughput};
use motet_arbitrary::graph::{StepSketch, graph};
use motet_graph::{BindingId, Graph, Value};
use motet_runtime::{DriverEvent, Effect, Engine, Event, Outcome, PreparedSwap, Time};
use std::hint::black_box;

/// Goes, then says so many words.
fn policy(nodes: usize) -> Graph {
    let mut steps = vec![StepSketch::go("table")];
    steps.resize(nodes, StepSketch::say("hello"));
    graph(&steps)
}

/// On its way.
fn going(nodes: usize) -> Engine {
    let mut steps = vec![StepSketch::go("table")];
    steps.resize(nodes, StepSketch::say("hello"));
    let mut engine = engine(&steps);
    engine.handle(Time::ZERO, Event::Begin, &mut Vec::new());
    engine
}

/// Preparing a policy, and committing it while its first action runs already: that goes on.
pub(crate) fn swaps(c: &mut Criterion) {
    for nodes in [10, 100, 1_000] {
        let base = going(nodes);
        let mut group = c.benchmark_group("swap");
        let mut out: Vec<Effect> = Vec::with_capacity(64);
        group.bench_function(BenchmarkId::new("commit", nodes), |b| {
            b.iter_batched(
                || Some((base.clone(), PreparedSwap::new(policy(nodes), &base.running()).ok()?)),
                |ready| {
                    out.clear();
                    // What is left behind is handed out, to be freed outside the measurement.
                    ready.map(|(mut engine, prepared)| {
                        let retired = engine.swap(Time::ZERO, prepared, &mut out);
                        (engine, retired)
                    })
                },
                BatchSize::LargeInput,
            );
        });
        group.throughput(Throughput::Elements(nodes as u64));
        group.bench_function(BenchmarkId::new("prepare", nodes), |b| {
            b.iter_batched(
                || policy(nodes),
                |graph| PreparedSwap::new(graph, &base.running()),
                BatchSize::LargeInput,
            );
        });
        group.finish();
    }
}

/// Reading a name that is bound.
pub(crate) fn bindings(c: &mut Criterion) {
    let mut engine = engine(&[StepSketch::detect("mug"), StepSketch::say("found")]);
    let mut out = Vec::new();
    engine.handle(Time::ZERO, Event::Begin, &mut out);
    let goal = out.iter().find_map(|effect| match effect {
        Effect::Start { goal, .. } => Some(*goal),
        _ => None,
    });
    let outcome = Outcome::Success(Some(Value::Entity("mug_1".into())));
    if let Some(goal) = goal {
        engine.handle(Time::ZERO, Event::Driver(DriverEvent::Ended { goal, outcome }), &mut out);
    }
    c.bench_function("reading a binding", |b| b.iter(|| black_box(engine.binding(black_box(BindingId(0))))));
}
