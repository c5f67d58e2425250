//! Mutations of the examples, as `eval mutations` judges them.

use std::path::Path;

use motet_eval::Workers;
use motet_eval::mutations::{self, MutantEnd};

#[test]
fn mutations_that_pass_without_a_word_seldom_fail() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    let ends = mutations::judge(Workers::default(), mutations::mutants(&folder).unwrap(), 0).unwrap();
    for (mutant, end) in &ends {
        if let MutantEnd::Unlisted(why) = end {
            println!("{}: {why}", mutant.name);
        }
    }
    let sums = mutations::summary(&ends);
    println!("{sums:?}");
    assert!(sums.total > 100 && sums.refused > 20, "{sums:?}");
    assert!(sums.unlisted * 50 <= sums.silent, "{sums:?}");
}
