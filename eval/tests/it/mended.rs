//! Mended mutants and policies, as `eval mutations --fix` judges them.

use std::path::Path;

use motet_compiler::fix::FixLimits;
use motet_eval::bench::Bench;
use motet_eval::mended::{self, MendedEnd, mend};
use motet_eval::mutations::{self, Mutant};

/// Mends policies as `motet check --fix` does.
fn mended(policies: Vec<Mutant>) -> Vec<mended::MendedMutant> {
    mend(&Bench::ideal(), policies, FixLimits::safe(100)).unwrap()
}

#[test]
fn mutants_that_are_mended_do_what_they_are_for() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    let all = mended(mutations::mutants(&folder).unwrap());
    let sums = mended::sums(&all);
    for mended in all.iter().filter(|mended| mended.end != MendedEnd::Refused) {
        println!("{}", mended.line());
    }
    println!("{sums:?}");
    assert!(sums.mended >= 87 && sums.done >= 78 && sums.untrue == 0, "{sums:?}");
}

/// Mends a policy for an HSR in the kitchen, which then is done with its goal.
fn check(goal: &str, steps: &str) {
    let text = format!("policy p for hsr achieves {goal} {{ {steps} }}");
    let (robot, scene) = ("hsr".to_owned(), "kitchen".to_owned());
    let all = mended(vec![Mutant { name: steps.to_owned(), text, robot, scene }]);
    assert!(matches!(all.as_slice(), [mended] if mended.end == MendedEnd::Done), "{all:#?}");
}

#[test]
fn policies_without_the_steps_between_are_mended() {
    check("on(mug_1, counter)", "go(counter) place(mug_1, counter)");
    check("on(mug_1, counter)", "go(kitchen_table) pick(mug_1) place(mug_1, counter)");
    check("on(mug_1, counter)", "go(kitchen_table) pick(mug_1)");
    check("at(mug_1, user)", "handover(mug_1, user)");
    check("holding(apple)", "pick(apple)");
}
