//! Runs in a world that can fail: a few, as `eval world` carries out more.

use std::path::Path;

use motet_eval::{Workers, world};
use motet_sim::Profile;

#[test]
fn world_run_that_is_done_has_its_goal() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    let runs = world::runs(&folder, 120).unwrap();
    let ends = world::carry_out(Workers::default(), runs, &Profile::builtin("harsh").unwrap());
    let untrue: Vec<_> = ends.iter().filter(|end| end.is_done && !end.is_true).collect();
    assert!(untrue.is_empty(), "{untrue:#?}");
    let sums = world::sums(&ends);
    assert!(sums.done * 3 >= sums.total && sums.done < sums.total, "{sums:?}");
    assert!(sums.failures.len() == 3, "{sums:?}");
}
