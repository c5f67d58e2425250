//! The trials added up, in the layout of InteLiPlan's tables.

use motet_planner::dialogue::Kind;
use serde::Serialize;

use super::Trial;
use crate::bench::{Bench, action_line};
use crate::outcome::{FailureSort, Rate};

/// The sums of some trials.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Sums {
    /// Trials.
    pub total: usize,
    /// Those that reached what was asked for.
    pub success: usize,
    /// Failures that occurred.
    pub failures: usize,
    /// Trials with failures in which each was explained to the person as what it is.
    pub explained: usize,
    /// Trials with failures that reached their goal.
    pub recovered: usize,
    /// Median milliseconds for the words, the check and the plan.
    pub median_ms: [f64; 3],
}

/// Adds up trials.
#[must_use]
pub fn sums<'t>(trials: impl Iterator<Item = &'t Trial>) -> Sums {
    let trials: Vec<&Trial> = trials.collect();
    let troubled = || trials.iter().filter(|trial| !trial.case.failures.is_empty());
    let median = |of: fn(&Trial) -> std::time::Duration| {
        let mut times: Vec<_> = trials.iter().map(|trial| of(trial).as_secs_f64() * 1e3).collect();
        times.sort_by(f64::total_cmp);
        times.get(times.len() / 2).copied().unwrap_or_default()
    };
    Sums {
        total: trials.len(),
        success: trials.iter().filter(|trial| trial.is_reached).count(),
        failures: troubled().count(),
        explained: troubled().filter(|trial| trial.is_explained).count(),
        recovered: troubled().filter(|trial| trial.is_reached).count(),
        median_ms: [
            median(|trial| trial.vision),
            median(|trial| trial.feasibility),
            median(|trial| trial.planner),
        ],
    }
}

/// The tables: success, explanation and recovery as in InteLiPlan's table II and figures 4 and 5, the robots
/// as in its table V, the shares of failures, the actions by the journals, and times as in its table VI.
#[must_use]
pub fn table(bench: &Bench, trials: &[Trial]) -> Vec<String> {
    let mut lines = vec![
        format!("world {}, driver {:?}", bench.world, bench.driver),
        format!(
            "{:<34} {:>5} {:>24} {:>10} {:>9} {:>10} {:>8} {:>9}",
            "InteLiPlan, table II, figures 4, 5",
            "n",
            "success",
            "explained",
            "recovered",
            "perception",
            "planning",
            "execution"
        ),
    ];
    let mut row = |name: &str, take: &dyn Fn(&Trial) -> bool| {
        let own: Vec<&Trial> = trials.iter().filter(|trial| take(trial)).collect();
        let sums = sums(own.iter().copied());
        if sums.total == 0 {
            return;
        }
        let percent = |part: usize, of: usize| {
            if of == 0 { "-".to_owned() } else { format!("{:.1} %", 100.0 * part as f64 / of as f64) }
        };
        let [seen, planned, done] = FailureSort::ALL.map(|sort| {
            percent(own.iter().filter(|trial| trial.failed_by == Some(sort)).count(), sums.total)
        });
        lines.push(format!(
            "{name:<34} {:>5} {:>24} {:>10} {:>9} {seen:>10} {planned:>8} {done:>9}",
            sums.total,
            Rate { part: sums.success, of: sums.total }.text(),
            percent(sums.explained, sums.failures),
            percent(sums.recovered, sums.failures)
        ));
    };
    row("without failure", &|trial| trial.case.failures.is_empty());
    row("with failure", &|trial| !trial.case.failures.is_empty());
    row("  one round", &|trial| trial.case.failures.len() == 1);
    row("  two rounds", &|trial| trial.case.failures.len() == 2);
    let kinds = [
        Kind::NotFound,
        Kind::NotReachable,
        Kind::AmbiguousReference,
        Kind::AmbiguousTask,
        Kind::ActionFailed,
    ];
    for kind in kinds {
        row(&format!("  {}", kind.name()), &|trial| trial.case.failures.contains(&kind));
    }
    for robot in ["hsr", "anymal_z1"] {
        for (rounds, name) in ["without failure", "one round", "two rounds"].into_iter().enumerate() {
            let is_own = |trial: &Trial| trial.case.robot == robot && trial.case.failures.len() == rounds;
            row(&format!("{robot}, {name} (table V)"), &is_own);
        }
    }
    for task in ["bring", "put", "stow", "throw", "pick", "go", "open", "close"] {
        row(task, &|trial| trial.case.task == task);
    }
    lines.push(action_line(trials.iter().map(|trial| &trial.faults)));
    let [vision, feasibility, planner] = sums(trials.iter()).median_ms;
    lines.push(format!(
        "median time (table VI): words {vision:.2} ms, check {feasibility:.2} ms, plan {planner:.2} ms"
    ));
    lines
}
