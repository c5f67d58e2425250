//! Runs in a world that can fail: a few, as `eval world` carries out more.

use std::path::Path;

use motet_eval::bench::{Bench, DriverKind};
use motet_eval::world;

#[test]
fn world_run_that_is_done_has_its_goal() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    let runs = world::runs(&folder, 120).unwrap();
    let ends = world::carry_out(runs, &Bench::new("harsh", DriverKind::Kinematic).unwrap()).unwrap();
    let untrue: Vec<_> = ends.iter().filter(|end| end.is_done && end.is_true == Some(false)).collect();
    assert!(untrue.is_empty(), "{untrue:#?}");
    let sums = world::sums(&ends);
    assert!(sums.done * 3 >= sums.total && sums.done < sums.total, "{sums:?}");
    assert!(sums.failures.len() == 3, "{sums:?}");
    // Each example has a goal, of which the world can say if it holds.
    assert_eq!(sums.not_judged, 0, "{sums:?}");
    let ends: Vec<_> = ends.into_iter().map(|end| world::WorldEnd { is_true: None, ..end }).collect();
    let without = world::sums(&ends);
    assert_eq!((without.done, without.untrue, without.not_judged), (0, 0, sums.done));
}
