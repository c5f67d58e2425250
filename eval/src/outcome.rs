//! Ends of trials: the sort of a failure, as VLP's figures tell them apart, and rates with intervals.

use std::collections::BTreeMap;

use motet_planner::dialogue::Kind;
use motet_runtime::{DriverEvent, Event, Outcome};
use motet_stdlib::lang::failures;
use serde::{Deserialize, Serialize};

/// Sort of a failure.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FailureSort {
    /// A thing was not found, or not told apart.
    Perception,
    /// No way, no reach, or something in the way; or no plan.
    Planning,
    /// A hand, a door or a person did not do its part.
    Execution,
}

impl FailureSort {
    /// All of them, in the order of the figures.
    pub const ALL: [Self; 3] = [Self::Perception, Self::Planning, Self::Execution];

    /// Sort of a failure kind.
    #[must_use]
    pub fn of(kind: &str) -> Self {
        match kind {
            failures::NOT_FOUND | failures::AMBIGUOUS => Self::Perception,
            failures::UNREACHABLE | failures::BLOCKED => Self::Planning,
            _ => Self::Execution,
        }
    }

    /// Sort of a problem that a request ended with.
    #[must_use]
    pub const fn of_problem(kind: Kind) -> Self {
        match kind {
            Kind::NotFound => Self::Perception,
            Kind::NotReachable | Kind::AmbiguousReference | Kind::AmbiguousTask => Self::Planning,
            Kind::ActionFailed => Self::Execution,
        }
    }
}

/// The failures of steps that a driver reports, in order.
#[derive(Clone, Debug, Default)]
pub struct StepFailures(pub Vec<FailureSort>);

impl StepFailures {
    /// Takes an event in.
    pub fn take(&mut self, event: &Event) {
        if let Event::Driver(DriverEvent::Ended { outcome: Outcome::Failure(failure), .. }) = event {
            self.0.push(FailureSort::of(&failure.kind));
        }
    }

    /// Number of failures of each sort.
    #[must_use]
    pub fn counts(&self) -> BTreeMap<FailureSort, usize> {
        let mut counts = BTreeMap::new();
        for sort in &self.0 {
            *counts.entry(*sort).or_insert(0) += 1;
        }
        counts
    }
}

/// A part of some trials.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize)]
pub struct Rate {
    pub part: usize,
    pub of: usize,
}

impl Rate {
    /// Share from 0 to 1; 0 of nothing.
    #[must_use]
    pub fn share(self) -> f64 {
        if self.of == 0 { 0.0 } else { self.part as f64 / self.of as f64 }
    }

    /// Wilson's interval of 95 %, each bound from 0 to 1.
    #[must_use]
    pub fn interval(self) -> [f64; 2] {
        const Z: f64 = 1.959_964;
        if self.of == 0 {
            return [0.0, 1.0];
        }
        let (share, count) = (self.share(), self.of as f64);
        let middle = share + Z * Z / (2.0 * count);
        let half = Z * (share * (1.0 - share) / count + Z * Z / (4.0 * count * count)).sqrt();
        let scale = 1.0 + Z * Z / count;
        [((middle - half) / scale).max(0.0), ((middle + half) / scale).min(1.0)]
    }

    /// The rate in words: `95.0 % [76.4, 99.1]`.
    #[must_use]
    pub fn text(self) -> String {
        if self.of == 0 {
            return "–".to_owned();
        }
        let [low, high] = self.interval().map(|bound| 100.0 * bound);
        format!("{:.1} % [{low:.1}, {high:.1}]", 100.0 * self.share())
    }
}

#[cfg(test)]
mod tests {
    use super::Rate;

    #[test]
    fn rate_has_an_interval_of_wilson() {
        let text = |part, of| Rate { part, of }.text();
        assert_eq!(text(20, 20), "100.0 % [83.9, 100.0]");
        assert_eq!(text(19, 20), "95.0 % [76.4, 99.1]");
        assert_eq!(text(0, 20), "0.0 % [0.0, 16.1]");
        assert_eq!(text(0, 0), "–");
    }
}
