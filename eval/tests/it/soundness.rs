//! Random policies in random worlds: no need that is proven, or that a guard has passed, is false when its
//! step begins.

use motet_eval::Workers;
use motet_eval::soundness::fuzz;

#[test]
fn soundness_no_need_of_a_random_policy_is_broken() {
    let found = fuzz(Workers::default(), 300, 7).unwrap();
    assert!(found.sums.findings.is_empty(), "{}", found.findings.join("\n\n"));
    // The policies are worth it: many are accepted, and of those that are refused most break a need.
    let sums = &found.sums;
    assert!(sums.accepted * 5 >= sums.policies, "{sums:?}");
    assert!(sums.refuted * 10 >= sums.policies, "{sums:?}");
    assert!(sums.refuted_in_vain * 2 <= sums.refuted, "{sums:?}");
}

#[test]
fn soundness_the_same_seed_gives_the_same() {
    let sums = || fuzz(Workers::default(), 40, 3).unwrap().sums;
    assert_eq!(sums(), sums());
}
