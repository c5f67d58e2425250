//! Tasks that change while they are carried out: a few trials of each, as `eval dynamic` runs more.

use motet_eval::bench::Bench;
use motet_eval::dynamic;

#[test]
fn dynamic_trials_reach_their_goals() {
    for trial in dynamic::trials(&Bench::ideal(), 7, 2).unwrap() {
        assert!(trial.is_good(), "{trial:?}");
    }
}
