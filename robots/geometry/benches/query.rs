//! How long motion queries take for the HSR in the kitchen: the room made ready, each reach, and all of them.

#![allow(missing_docs, clippy::unwrap_used, reason = "a benchmark fails by panicking")]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use motet_geometry::query::{Budget, Machine, Query, Room, World};
use motet_robots::{card, scene, urdf};
use motet_syntax::{FileId, Source};

fn query(criterion: &mut Criterion) {
    let (_, toml, own) = card::embedded().iter().find(|(name, ..)| *name == "hsr").unwrap();
    let robot = card::read(&Source::new("hsr", *toml), FileId(0), *own).0.unwrap();
    let text = card::embedded_urdf("hsr").unwrap();
    let urdf = urdf::read(&Source::new("hsr", text), FileId(0)).0.unwrap();
    let text = scene::embedded().iter().find(|(name, _)| *name == "kitchen").unwrap().1;
    let scene = scene::read(&Source::new("kitchen", text), FileId(0)).0.unwrap();
    let machine = Machine::new(&robot, &urdf, None);
    let world = World::new(&machine, &scene);
    let room = Room::new(&machine, &scene, &world);
    let mut group = criterion.benchmark_group("hsr, kitchen");
    group.sample_size(20);
    group.bench_function("room", |bencher| bencher.iter(|| Room::new(black_box(&machine), &scene, &world)));
    group.bench_function("go_to(sink)", |bencher| {
        let query = Query::GoTo("sink".into());
        bencher.iter(|| room.answer(black_box(&query), Budget::default()));
    });
    for id in scene.entities.iter().filter(|(_, entity)| entity.kind == "Object").map(|(id, _)| id) {
        let query = Query::Reach(id.clone(), None);
        group.bench_function(query.to_string(), |bencher| {
            bencher.iter(|| room.answer(black_box(&query), Budget::default()));
        });
    }
    group.finish();
}

criterion_group!(benches, query);
criterion_main!(benches);
