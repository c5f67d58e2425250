//! Repairs of the faulty plans of the scenarios by the compiler.
//!
//! Each static row with a fault is mended as `motet check --fix` would mend it, by at most [`ROUNDS`] fixes,
//! and judged again by the table of the scenarios. A round is one fix that was made, of however many edits.

use std::fmt::Write as _;

use indexmap::IndexMap;
use serde::Serialize;

/// The most fixes that are made in a plan.
pub const ROUNDS: usize = 3;

/// Result for a faulty plan.
#[derive(Clone, Debug)]
pub struct Repair {
    /// The row's name.
    pub id: String,
    /// The class of its fault, as the row gives it.
    pub class: String,
    /// Titles of the fixes, in order.
    pub done: Vec<String>,
    /// Remaining fault in a few words; none where the plan is clean.
    pub left: Option<String>,
}

/// The sums over all plans.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Summary {
    /// Faulty plans.
    pub total: usize,
    /// Plans that were mended.
    pub repaired: usize,
    /// Plans that were mended, by the number of rounds.
    pub rounds: IndexMap<usize, usize>,
    /// By class of fault: plans, and plans that were mended.
    pub classes: IndexMap<String, Share>,
}

/// Number of plans, and of those that were mended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Share {
    /// Plans.
    pub total: usize,
    /// Plans that were mended.
    pub repaired: usize,
}

impl Repair {
    /// Describes the fixes and the remaining fault.
    #[must_use]
    pub fn line(&self) -> String {
        let mut line = format!("{}: {}: ", self.id, self.class);
        let _ = match &self.left {
            None => write!(line, "repaired"),
            Some(left) => write!(line, "left {left}"),
        };
        for done in &self.done {
            let _ = write!(line, "; {done}");
        }
        line
    }
}

/// Adds up repairs; classes and rounds in order.
#[must_use]
pub fn summary(repairs: &[Repair]) -> Summary {
    let mut sum = Summary::default();
    for repair in repairs {
        let share = sum.classes.entry(repair.class.clone()).or_default();
        sum.total += 1;
        share.total += 1;
        if repair.left.is_none() {
            sum.repaired += 1;
            share.repaired += 1;
            *sum.rounds.entry(repair.done.len()).or_default() += 1;
        }
    }
    sum.classes.sort_keys();
    sum.rounds.sort_keys();
    sum
}
