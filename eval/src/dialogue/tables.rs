//! The trials added up, in the layout of InteLiPlan's tables.

use motet_planner::dialogue::Kind;
use serde::Serialize;

use super::Trial;

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

/// The table.
#[must_use]
pub fn table(trials: &[Trial]) -> Vec<String> {
    let mut lines =
        vec![format!("{:<34} {:>5} {:>8} {:>10} {:>9}", "", "n", "success", "explained", "recovered")];
    let mut row = |name: &str, take: &dyn Fn(&Trial) -> bool| {
        let sums = sums(trials.iter().filter(|trial| take(trial)));
        if sums.total == 0 {
            return;
        }
        let rate = |part: usize, of: usize| {
            if of == 0 { "-".to_owned() } else { format!("{:.1} %", 100.0 * part as f64 / of as f64) }
        };
        lines.push(format!(
            "{name:<34} {:>5} {:>8} {:>10} {:>9}",
            sums.total,
            rate(sums.success, sums.total),
            rate(sums.explained, sums.failures),
            rate(sums.recovered, sums.failures)
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
        row(robot, &|trial| trial.case.robot == robot);
    }
    for task in ["bring", "put", "stow", "throw", "pick", "go", "open", "close"] {
        row(task, &|trial| trial.case.task == task);
    }
    let [vision, feasibility, planner] = sums(trials.iter()).median_ms;
    lines.push(format!(
        "median time of a trial: words {vision:.2} ms, check {feasibility:.2} ms, plan {planner:.2} ms"
    ));
    lines
}
