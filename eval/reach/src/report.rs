//! The table of one robot.

use std::path::PathBuf;
use std::time::Duration;

use serde::Serialize;

use crate::judge::{AnswerKind, Case, Settings, run};
use crate::truth::Truth;

/// Shares are in percent, times in microseconds; a time of no case at all is missing.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Table {
    /// The robot.
    pub robot: String,
    /// Targets asked for.
    pub targets: usize,
    /// Of which the exhaustive search, or a witness that holds, shows that they are reachable.
    pub reachable: usize,
    /// Of which the search found states and no way.
    pub no_way: usize,
    /// Of which it found no state.
    pub no_state: usize,
    /// Answers with a witness.
    pub positives: usize,
    /// Witnesses that do not hold.
    pub uncertified_positives: usize,
    /// Of the reachable, answered with a witness that holds.
    pub recall: f64,
    /// The same within 100 µs, 1 ms and 10 ms.
    pub recall_at: [f64; 3],
    /// Of the targets without a state, proven so.
    pub certified: f64,
    /// Proven to have none, and the search found a state.
    pub contradicted: usize,
    /// Unknown, of all.
    pub unknown: f64,
    /// Time of a positive: median, 99th percentile.
    pub feasible_us: Option<[f64; 2]>,
    /// Time of a negative, likewise.
    pub infeasible_us: Option<[f64; 2]>,
    /// Time to make a room ready, likewise.
    pub set_up_us: Option<[f64; 2]>,
    /// Time of a positive with that, likewise.
    pub feasible_with_set_up_us: Option<[f64; 2]>,
}

impl Table {
    pub(crate) fn new(robot: &str, cases: &[Case]) -> Self {
        let holds = |case: &&Case| case.holds();
        let reachable: Vec<&Case> = cases.iter().filter(|case| case.is_reachable()).collect();
        let within = |limit: Duration| {
            let found = reachable.iter().filter(|case| holds(case) && case.took <= limit).count();
            percent(found, reachable.len())
        };
        let count = |truth: Truth| cases.iter().filter(|case| case.truth == truth && !holds(case)).count();
        let no_state = count(Truth::NoState);
        let certified = |case: &&Case| case.said == AnswerKind::Certified && case.truth == Truth::NoState;
        let times = |is: &dyn Fn(&&Case) -> bool, of: &dyn Fn(&Case) -> Duration| {
            spread(cases.iter().filter(is).map(of).collect())
        };
        let negative = |case: &&Case| matches!(case.said, AnswerKind::Certified | AnswerKind::Exhausted);
        Self {
            robot: robot.into(),
            targets: cases.len(),
            reachable: reachable.len(),
            no_way: count(Truth::NoWay),
            no_state,
            positives: cases.iter().filter(|case| case.said == AnswerKind::Feasible).count(),
            uncertified_positives: cases.iter().filter(|case| !case.faults.is_empty()).count(),
            recall: within(Duration::MAX),
            recall_at: [100, 1_000, 10_000].map(|micros| within(Duration::from_micros(micros))),
            certified: percent(cases.iter().filter(certified).count(), no_state),
            contradicted: cases.iter().filter(|case| case.is_contradicted()).count(),
            unknown: percent(
                cases.iter().filter(|case| case.said == AnswerKind::Unknown).count(),
                cases.len(),
            ),
            feasible_us: times(&holds, &|case| case.took),
            infeasible_us: times(&negative, &|case| case.took),
            set_up_us: times(&|_| true, &|case| case.set_up),
            feasible_with_set_up_us: times(&holds, &|case| case.took + case.set_up),
        }
    }
}

impl std::fmt::Display for Table {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let time = |spread: &Option<[f64; 2]>| match spread {
            Some([median, most]) => format!("median {median:.0} µs, 99 % within {most:.0} µs"),
            None => "none".into(),
        };
        let [first, second, third] = self.recall_at;
        writeln!(f, "{}: {} targets, {} reachable", self.robot, self.targets, self.reachable)?;
        writeln!(
            f,
            "  not reachable: {} with states and no way, {} without a state",
            self.no_way, self.no_state
        )?;
        writeln!(
            f,
            "  recall {:.1} %; within 100 µs {first:.1} %, 1 ms {second:.1} %, 10 ms {third:.1} %",
            self.recall
        )?;
        writeln!(f, "  positives {}, of which {} do not hold", self.positives, self.uncertified_positives)?;
        writeln!(
            f,
            "  negatives without a state certified: {:.1} %; wrongly: {}",
            self.certified, self.contradicted
        )?;
        writeln!(f, "  unknown {:.1} %", self.unknown)?;
        writeln!(f, "  feasible: {}", time(&self.feasible_us))?;
        writeln!(f, "  infeasible: {}", time(&self.infeasible_us))?;
        writeln!(f, "  a room made ready: {}", time(&self.set_up_us))?;
        write!(f, "  feasible, with that: {}", time(&self.feasible_with_set_up_us))
    }
}

fn percent(part: usize, whole: usize) -> f64 {
    if whole == 0 { 100.0 } else { 100.0 * part as f64 / whole as f64 }
}

fn spread(mut times: Vec<Duration>) -> Option<[f64; 2]> {
    times.sort_unstable();
    let at = |share: f64| {
        let index = ((times.len() as f64 * share).ceil() as usize).max(1) - 1;
        times.get(index).map(|time| time.as_secs_f64() * 1e6)
    };
    Some([at(0.5)?, at(0.99)?])
}

/// Text of `--help`.
const HELP: &str = "usage: reach [SCENE|--rooms N --seed S] [OPTIONS]

Asks `reach` in rooms at random, or for every object of a scene file, and judges the answers.

  --robot NAME      a robot, several times for more: hsr, anymal_z1, panda (all)
  --rooms N         rooms at random (10)
  --seed S          what they are drawn from (1)
  --cells N         cells that a proof may look at
  --quick           a shorter search for the truth
  --unjudged        no search for the truth: answers are counted and witnesses checked
  --witnesses FILE  writes the witnesses there
  --targets FILE    writes the targets there
  -j, --jobs N      threads (1)
  --shard K/N       each N-th room from the K-th
  --json            only the tables, as JSON";

/// Runs the evaluation: what to print, and whether every witness holds and nothing reachable is certified
/// not to be.
///
/// # Errors
///
/// An argument that is not known, or a file that cannot be read or written.
pub fn command(args: &[String]) -> Result<(String, bool), String> {
    let mut settings =
        Settings { rooms: 10, cache: Some(PathBuf::from("target/reach")), ..Settings::default() };
    let mut robots = Vec::new();
    if args.iter().any(|arg| arg == "--help" || arg == "-h") {
        return Ok((HELP.to_owned(), true));
    }
    let mut is_json = false;
    let mut args = args.iter();
    while let Some(arg) = args.next() {
        let mut value = || args.next().ok_or_else(|| format!("`{arg}` needs a value"));
        let number = |text: &String| text.parse().map_err(|_| format!("`{text}` is no number"));
        match arg.as_str() {
            "--robot" => robots.push(value()?.clone()),
            "--rooms" => settings.rooms = number(value()?)?,
            "--seed" => settings.seed = number(value()?)?,
            "--quick" => settings.is_quick = true,
            "--cells" => settings.budget.cells = number(value()?)? as usize,
            "--unjudged" => settings.is_unjudged = true,
            "--witnesses" => settings.witnesses = Some(value()?.into()),
            "--targets" => settings.targets = Some(value()?.into()),
            "-j" | "--jobs" => {
                let jobs = Some(number(value()?)?).filter(|jobs| (1..=1024).contains(jobs));
                settings.jobs = jobs.ok_or("the number of threads is from 1 to 1024")? as usize;
            }
            "--shard" => settings.shard = value()?.parse()?,
            "--json" => is_json = true,
            file if !file.starts_with('-') => {
                settings.scene =
                    Some(std::fs::read_to_string(file).map_err(|error| format!("{file}: {error}"))?);
            }
            other => return Err(format!("`{other}` is not known: see --help")),
        }
    }
    if !robots.is_empty() {
        settings.robots = robots;
    }
    let (mut lines, tables) = run(&settings)?;
    let is_good = tables.iter().all(|table| table.uncertified_positives == 0 && table.contradicted == 0);
    if is_json {
        lines = vec![serde_json::to_string_pretty(&tables).map_err(|error| error.to_string())?];
    } else {
        lines.extend(tables.iter().map(ToString::to_string));
    }
    Ok((lines.join("\n"), is_good))
}
