//! Cost of writing an event: as a line, in a group, and synced to disk one by one.

use criterion::{Criterion, criterion_group, criterion_main};
use motet_arbitrary::graph::{StepSketch, graph};
use motet_host::journal::{JournalWriter, SyncGrouping};
use motet_runtime::journal::{JournalHead, LineChain};
use motet_runtime::{DriverEvent, Effect, Engine, Event, GoalId, Outcome, StartState, Time};
use std::hint::black_box;
use std::path::Path;

/// An event with its effects: a call ends and the next one starts.
fn step() -> (Event, Vec<Effect>) {
    let graph = graph(&[StepSketch::go("table"), StepSketch::go("shelf")]);
    // Without a word where the sketch is invalid: the layout's own tests see to it that none is.
    let Ok(mut engine) = Engine::new(graph, &StartState::default()) else { return (Event::Tick, Vec::new()) };
    let mut out = Vec::new();
    engine.handle(Time::ZERO, Event::Begin, &mut out);
    let goal = out.iter().find_map(|effect| match effect {
        Effect::Start { goal, .. } => Some(*goal),
        _ => None,
    });
    let goal = goal.unwrap_or(GoalId::from_number(0));
    let event = Event::Driver(DriverEvent::Ended { goal, outcome: Outcome::Success(None) });
    out.clear();
    engine.handle(Time::ZERO, event.clone(), &mut out);
    (event, out)
}

fn lines(c: &mut Criterion) {
    let (event, effects) = step();
    let mut chain = LineChain::default();
    c.bench_function("line of an event", |b| {
        b.iter(|| black_box(chain.step(Time::ZERO, &event, &effects)));
    });
}

fn files(c: &mut Criterion) {
    let (event, effects) = step();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("journal_bench");
    for (name, synced) in [("append, synced in groups", false), ("append, each synced", true)] {
        let _ = std::fs::remove_dir_all(&folder);
        let head = JournalHead::new(&graph(&[StepSketch::go("table")]));
        let Ok(writer) = JournalWriter::create(&folder, head) else { return };
        let mut writer = writer.with_grouping(SyncGrouping::default());
        c.bench_function(name, |b| {
            b.iter(|| {
                let written = writer.append(|chain| chain.step(Time::ZERO, &event, &effects));
                let synced = if synced { writer.sync() } else { writer.sync_group() };
                black_box((written.is_ok(), synced.is_ok()))
            });
        });
    }
    let _ = std::fs::remove_dir_all(&folder);
}

criterion_group!(benches, lines, files);
criterion_main!(benches);
