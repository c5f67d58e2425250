//! The same shapes as behaviour trees of `bonsai-bt`: a closure answers for every action, nothing is traced.

use bonsai_bt::Behavior::{Action, Sequence};
use bonsai_bt::{BT, Behavior, Event, RUNNING, Status, UpdateArgs};
use criterion::{BatchSize, BenchmarkId, Criterion, Throughput};
use std::hint::black_box;

/// Behaviour of a leaf.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Leaf {
    Succeed,
    Run,
}

fn tick(tree: &mut BT<Leaf, ()>) -> Option<(Status, f64)> {
    let event: Event = UpdateArgs { dt: 0.0 }.into();
    tree.tick(&event, &mut |args: bonsai_bt::ActionArgs<'_, Event, Leaf>, ()| match args.action {
        Leaf::Succeed => (Status::Success, args.dt),
        Leaf::Run => RUNNING,
    })
}

/// Sequences, nesting, and conditions over one running action.
pub(crate) fn trees(c: &mut Criterion) {
    let mut group = c.benchmark_group("bonsai-bt sequence");
    for count in [10_usize, 100, 1_000, 10_000] {
        group.throughput(Throughput::Elements(count as u64));
        group.bench_function(BenchmarkId::from_parameter(count), |b| {
            b.iter_batched_ref(
                || BT::new(Sequence(vec![Action(Leaf::Succeed); count]), ()),
                |tree| black_box(tick(tree)),
                BatchSize::LargeInput,
            );
        });
    }
    group.finish();
    let deep = (0..1_000).fold(Action(Leaf::Succeed), |inner, _| Sequence(vec![inner]));
    c.bench_function("bonsai-bt nesting 1000", |b| {
        b.iter_batched_ref(|| BT::new(deep.clone(), ()), |tree| black_box(tick(tree)), BatchSize::LargeInput);
    });
    // Reactive: all conditions are asked again in every tick.
    let mut watched: Vec<Behavior<Leaf>> = vec![Action(Leaf::Succeed); 1_000];
    watched.push(Action(Leaf::Run));
    let mut tree = BT::new(Sequence(watched).memory(false), ());
    c.bench_function("bonsai-bt 1000 conditions, idle tick", |b| b.iter(|| black_box(tick(&mut tree))));
}
