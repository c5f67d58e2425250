//! Times of motion queries for the HSR: in the kitchen the prepared context and each reach, and the same
//! queries among 100 and among 10,000 objects.

#![allow(
    missing_docs,
    clippy::unwrap_used,
    clippy::unreachable,
    clippy::indexing_slicing,
    reason = "a benchmark fails by panicking"
)]

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use motet_geometry::planning::{
    AllowedCollisions, Configuration, MotionAnswer, MotionQuery, QueryContext, RobotModel, SceneState,
    SearchBudget,
};
use motet_robots::builtin::{self, RobotWithBody};
use motet_robots::scene::{Entity, EntityShape, Placement, Scene};

fn query(criterion: &mut Criterion) {
    let RobotWithBody { robot, urdf } = builtin::robot("hsr").unwrap();
    let scene = builtin::scene("kitchen").unwrap();
    let machine = RobotModel::new(&robot, &urdf);
    let world = SceneState::new(&machine, &scene);
    let room = QueryContext::new(&machine, &scene, &world);
    let mut group = criterion.benchmark_group("hsr, kitchen");
    group.sample_size(20);
    group.bench_function("room", |bencher| {
        bencher.iter(|| QueryContext::new(black_box(&machine), &scene, &world))
    });
    group.bench_function("go_to(sink)", |bencher| {
        let query = MotionQuery::GoTo("sink".into());
        bencher.iter(|| room.answer(black_box(&query), SearchBudget::default()));
    });
    for id in scene.entities.iter().filter(|(_, entity)| entity.kind == "Object").map(|(id, _)| id) {
        let query = MotionQuery::Reach(id.clone(), None);
        group.bench_function(query.to_string(), |bencher| {
            bencher.iter(|| room.answer(black_box(&query), SearchBudget::default()));
        });
    }
    // Configurations along the way to the mug, as a search looks at them.
    let near = along(&room, "mug_1");
    group.throughput(Throughput::Elements(near.len() as u64));
    group.bench_function("whole-body configurations", |bencher| {
        bencher.iter(|| room.contacts(black_box(&near), AllowedCollisions::default()));
    });
    group.finish();
}

/// States on the last legs of a way to a thing, where it is narrowest.
fn along(room: &QueryContext<'_>, id: &str) -> Vec<Configuration> {
    let MotionAnswer::Feasible(witness) =
        room.answer(&MotionQuery::Reach(id.into(), None), SearchBudget::default())
    else {
        unreachable!("it is feasible")
    };
    let legs = witness.path.windows(2).rev().skip(1).take(2);
    legs.flat_map(|pair| (0..256).map(|at| pair[0].towards(&pair[1], f64::from(at) / 256.0))).collect()
}

/// Tables in rows, 3 m from one to the next, with nine cups on each; the robot stands between the first four.
fn depot(tables: i32) -> Scene {
    let mut scene = Scene::default();
    let mut add = |id: String, kind: &str, xyz: [f64; 3], shape: EntityShape| {
        let mut entity = Entity::place(id.as_str().into(), Placement { xyz, rpy: [0.0; 3] });
        entity.kind = kind.into();
        entity.shape = Some(shape);
        scene.entities.insert(entity.id.clone(), entity);
    };
    let side = (1..).find(|side| side * side >= tables).unwrap();
    for table in 0..tables {
        // The first four are around the robot however many there are.
        let (row, column) = (table / side - side / 2, table % side - side / 2);
        let (x, y) = (3.0 * f64::from(column) + 1.5, 3.0 * f64::from(row) + 1.5);
        add(format!("table_{row}_{column}"), "Place", [x, y, 0.35], EntityShape::Box([1.2, 0.8, 0.7]));
        for cup in 0..9 {
            let (dx, dy) = (0.4 * f64::from(cup % 3 - 1), 0.25 * f64::from(cup / 3 - 1));
            let shape = EntityShape::Cylinder { radius: 0.035, height: 0.1 };
            add(format!("cup_{row}_{column}_{cup}"), "Object", [x + dx, y + dy, 0.751], shape);
        }
    }
    scene
}

fn among(criterion: &mut Criterion) {
    let RobotWithBody { robot, urdf } = builtin::robot("hsr").unwrap();
    let machine = RobotModel::new(&robot, &urdf);
    let mut group = criterion.benchmark_group("hsr, objects");
    group.sample_size(20);
    for tables in [12, 1112] {
        let scene = depot(tables);
        let world = SceneState::new(&machine, &scene);
        let room = QueryContext::new(&machine, &scene, &world);
        let objects = tables * 9;
        group.bench_function(format!("room, {objects}"), |bencher| {
            bencher.iter(|| QueryContext::new(black_box(&machine), &scene, &world));
        });
        let calls =
            [("reach", "cup_0_0_4"), ("reach", "cup_0_0_0"), ("go_to", "cup_0_0_0"), ("look", "cup_0_0_4")];
        for query in calls.map(|(name, id)| MotionQuery::from_call(name, [id], None).unwrap()) {
            assert!(
                matches!(room.answer(&query, SearchBudget::default()), MotionAnswer::Feasible(_)),
                "{query}"
            );
            group.bench_function(format!("{query}, {objects}"), |bencher| {
                bencher.iter(|| room.answer(black_box(&query), SearchBudget::default()));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, query, among);
criterion_main!(benches);
