//! Random policies in random worlds: no need that is proven, or that a guard has passed, is false when its
//! step begins.

use motet_eval::Workers;
use motet_eval::soundness::{SeededFault, fuzz, fuzz_with};

#[test]
fn soundness_no_need_of_a_random_policy_is_broken() {
    let found = fuzz(Workers::default(), 5_000, 7).unwrap();
    assert!(found.sums.findings.is_empty(), "{}", found.findings.join("\n\n"));
    // The policies are worth it: many are accepted, and of those that are refused most break a need.
    let sums = &found.sums;
    assert!(sums.accepted * 5 >= sums.policies, "{sums:?}");
    assert!(sums.refuted * 10 >= sums.policies, "{sums:?}");
    assert!(sums.refuted_in_vain * 2 <= sums.refuted, "{sums:?}");
}

#[test]
fn soundness_finds_a_seeded_fault() {
    for fault in [SeededFault::ProvesTooMuch, SeededFault::ForgetsUnsettled] {
        let found = fuzz_with(Workers::default(), 400, 7, Some(fault)).unwrap();
        assert!(!found.sums.findings.is_empty(), "{fault:?}");
        assert!(!found.findings.is_empty(), "{fault:?}");
    }
}

#[test]
fn soundness_the_same_seed_gives_the_same() {
    let sums = || fuzz(Workers::default(), 40, 3).unwrap().sums;
    assert_eq!(sums(), sums());
}
