//! Tasks that change while they are carried out: a few trials of each, as `eval dynamic` runs more.

use motet_eval::dynamic;

#[test]
fn dynamic_trials_reach_their_goals() {
    for trial in dynamic::trials(7, 2) {
        assert!(trial.is_good(), "{trial:?}");
    }
}
