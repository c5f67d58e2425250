//! Times of kinematics: the family of solutions of the HSR on a grid, a candidate confirmed, and
//! other arms.

#![allow(missing_docs, clippy::unwrap_used, reason = "a benchmark fails by panicking")]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use motet_geometry::inverse::batch::BatchSolver;
use motet_geometry::inverse::{LiftArm, ParallelArm, numeric};
use motet_geometry::kinematics::{KinematicChain, KinematicTree, planar};
use motet_robots::builtin;

fn tree(robot: &str) -> KinematicTree {
    KinematicTree::new(&builtin::robot(robot).unwrap().urdf)
}

fn chain(robot: &str, base: &str, tip: &str) -> KinematicChain {
    let tree = tree(robot);
    KinematicChain::new(&tree, tree.link(base).unwrap(), tree.link(tip).unwrap()).unwrap()
}

fn inverse(criterion: &mut Criterion) {
    let arm = LiftArm::detect(&chain("hsr", "base_footprint", "hand_palm_link")).unwrap();
    let values = [0.35, -1.2, 0.4, -0.9, 0.3];
    let wanted = planar(2.0, -1.0, 0.7) * arm.chain().base_from_tip(&values);
    let manifold = BatchSolver::new(&arm);
    let poses = manifold.poses(&[(wanted, 0.7); 8], [2.0, -1.0]);
    criterion.bench_function("hsr: 16 candidates in f32", |bencher| {
        bencher.iter(|| manifold.block(black_box(&poses), 0.3, -1.2));
    });
    criterion.bench_function("hsr: one yaw and shoulder in f64, confirmed", |bencher| {
        bencher.iter(|| arm.solve(black_box(&wanted), 0.7, -1.2));
    });
    let z1 = ParallelArm::detect(&chain("anymal_z1", "link00", "hand_tip")).unwrap();
    let wanted = z1.chain().base_from_tip(&[0.3, 1.5, -1.0, -0.5, 0.4, 0.2]);
    criterion.bench_function("z1: all solutions", |bencher| bencher.iter(|| z1.solve(black_box(&wanted))));
    let panda = chain("panda", "panda_link0", "panda_hand_tcp");
    let wanted = panda.base_from_tip(&[0.3, -0.5, 0.2, -2.0, 0.1, 1.8, 0.5]);
    let from = [0.0, -0.8, 0.0, -2.4, 0.0, 1.6, 0.8];
    criterion.bench_function("panda: one solution by steps", |bencher| {
        bencher
            .iter(|| numeric::solve(&panda, black_box(&wanted), &from, numeric::NumericSettings::default()));
    });
    let hsr = tree("hsr");
    let configuration = hsr.neutral();
    criterion.bench_function("hsr: poses of all links", |bencher| {
        bencher.iter(|| hsr.root_from_links(black_box(&configuration)));
    });
}

criterion_group!(benches, inverse);
criterion_main!(benches);
