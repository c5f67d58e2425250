//! Tasks that change while they are carried out: a few trials of each, as `eval dynamic` runs more.

use motet_tests::eval::dynamic;

#[test]
fn tasks_that_change_are_carried_out_without_a_slip() {
    for trial in dynamic::trials(7, 2) {
        assert!(trial.is_good(), "{trial:?}");
    }
}
