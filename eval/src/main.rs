//! Compares the compiler's verdicts with other people's: `eval SUITE FILE [--json] [--planned]`.
//!
//! A suite prints a line for each disagreement and a summary object at the end. The exit code is 0 if every
//! verdict agrees, and 1 if one does not.
//!
//! - `saycan --planned` plans the instructions from their text instead, and exits with 0 if at least 60 % of
//!   them are carried out.
//! - `dialogue` takes a file of wordings, `dynamic` the number of trials for each task and robot. Both take
//!   `--world ideal|typical|harsh|FILE`, `--driver kinematic|mujoco`, and `--planner builtin|tree|one-shot|
//!   forgetful|[few-shot:]URL|[few-shot:]file:REPLIES` with `--model M`.
//!   `--pictures` gives the planner a picture of the camera with every request.
//! - `tasks [FILE…] [--trials N]` plays the tasks of the papers, with the same flags. `--jobs N` plays so
//!   many trials at once, `--only WORD` those with a word in their name, robot, request or kinds of failure
//!   (`WORD+WORD` with all of them), `dialogue --every N` each Nth case, and `dialogue --objects unseen`
//!   those with things that no word list knows.
//! - `world` takes the number of runs in a world that can fail (`harsh`, unless `--world` names another),
//!   with `--driver`, `--jobs` and `--only` as above. It exits with 0 if no run ends as done without its
//!   goal.
//! - `mutations` takes no file: it changes the examples, and exits with 0 if at most 2 % of what the check
//!   passes without a word fails by a need that was not listed. With `--fix` or `--unsafe-fixes` it mends
//!   what the check refuses, as `motet check` does, and exits with 0 if at least 85 % of what is mended ends
//!   as done with its goal.
//! - `soundness N|FILE… [--seed S]` makes N random policies, or takes those of documents that declare a
//!   domain, runs what the check accepts in random worlds, and exits with 0 if every need that is proven, or
//!   that a guard has passed, holds.
//! - `repairs` repairs the faulty plans of the scenarios, and exits with 0 if at least half of them are
//!   repaired.
//! - `reach [SCENE|--rooms N --seed S]` asks motion queries.
//! - `physics --robot NAME [--seeds N]` carries every feasible verdict out in MuJoCo, and exits with 0 if the
//!   shares that it bears out reach the aims.
//!
//! All suites take `-j N`, a number of threads, and `--shard K/N`, which takes each N-th item from the K-th
//! on. `reach` and `physics` use one thread unless told, since their figures are times. `dialogue`,
//! `dynamic`, `tasks` and `world` take `--continue FILE`, which keeps the results: a later call with the same
//! words goes on where an earlier one was stopped.

use std::io::Write as _;
use std::path::Path;
use std::process::ExitCode;

use motet::document::MAX_FIXES;
use motet_compiler::fix::FixLimits;
use motet_eval::bench::{Bench, DriverKind};
use motet_eval::mended::MendedMutant;
use motet_eval::planners::PlannerKind;
use motet_eval::saycan::planned;
use motet_eval::{
    Judged, KeptResults, Workers, dialogue, dynamic, mended, mutations, physics, planbench, repairs, saycan,
    scenarios, soundness, summary, tasks, world,
};

/// Suite over the lines of a file.
type Suite = fn(Workers, &[(usize, &str)]) -> Result<Report, String>;

const SUITES: &[(&str, Suite)] = &[
    ("planbench", |workers, lines| judged(workers, lines, planbench::judge)),
    ("scenarios", |workers, lines| judged(workers, lines, scenarios::judge)),
    ("saycan", |workers, lines| judged(workers, lines, saycan::judge)),
    ("repairs", repaired),
];

/// Suites whose results can be kept in a file.
const KEPT: [&str; 4] = ["dialogue", "dynamic", "tasks", "world"];

/// Words of a command line without those that do not change the results.
fn deciding(args: &[String]) -> String {
    let (mut words, mut args) = (Vec::new(), args.iter());
    while let Some(arg) = args.next() {
        match arg.as_str() {
            "-j" | "--jobs" | "--continue" => {
                let _ = args.next();
            }
            "--json" => {}
            word => words.push(word.to_owned()),
        }
    }
    words.join(" ")
}

/// Flags and words of the command line.
#[derive(Default)]
struct Flags {
    only_json: bool,
    is_planned: bool,
    world: Option<String>,
    driver: Option<DriverKind>,
    planner: Option<String>,
    model: Option<String>,
    trials: Option<usize>,
    objects: Option<dialogue::Objects>,
    workers: Workers,
    every: Option<usize>,
    seed: Option<u64>,
    shows_refusals: bool,
    fixes: Option<FixLimits>,
    has_pictures: bool,
    only: Vec<String>,
    words: Vec<String>,
}

impl Flags {
    fn read(all: &[String]) -> Result<Self, String> {
        let (mut flags, mut kept, mut args) = (Self::default(), None, all.iter());
        while let Some(arg) = args.next() {
            let mut value = || args.next().cloned().ok_or_else(|| format!("`{arg}` needs a value"));
            match arg.as_str() {
                "--json" => flags.only_json = true,
                "--refusals" => flags.shows_refusals = true,
                "--fix" => flags.fixes = Some(FixLimits::safe(MAX_FIXES)),
                "--unsafe-fixes" => flags.fixes = Some(FixLimits::all(MAX_FIXES)),
                "--planned" => flags.is_planned = true,
                "--pictures" => flags.has_pictures = true,
                "--world" => flags.world = Some(value()?),
                "--driver" => flags.driver = Some(value()?.parse()?),
                "--planner" => flags.planner = Some(value()?),
                "--model" => flags.model = Some(value()?),
                "--objects" => flags.objects = Some(value()?.parse()?),
                "--seed" => {
                    let text = value()?;
                    flags.seed = Some(text.parse().map_err(|_| format!("`{text}` is no seed"))?);
                }
                "--only" => flags.only.push(value()?),
                "--trials" => flags.trials = Some(number(&value()?)?),
                "--every" => flags.every = Some(number(&value()?)?),
                "-j" | "--jobs" => {
                    let jobs = Some(number(&value()?)?).filter(|jobs| (1..=1024).contains(jobs));
                    flags.workers.jobs = jobs.ok_or("the number of threads is from 1 to 1024")?;
                }
                "--shard" => flags.workers.shard = value()?.parse()?,
                "--continue" => kept = Some(value()?),
                flag if flag.starts_with('-') => return Err(format!("there is no flag `{flag}`")),
                word => flags.words.push(word.to_owned()),
            }
        }
        if let Some(path) = kept {
            if !flags.words.first().is_some_and(|suite| KEPT.contains(&suite.as_str())) {
                return Err(format!("`--continue` is for {}", KEPT.join(", ")));
            }
            // They last as long as the process does.
            let path = Path::new(Box::leak(path.into_boxed_str()));
            flags.workers.kept = Some(KeptResults { path, words: Box::leak(deciding(all).into_boxed_str()) });
        }
        Ok(flags)
    }

    /// World of the trials: `typical` unless another is asked for.
    fn bench(&self) -> Result<Bench, String> {
        self.bench_in("typical")
    }

    /// World of the trials: the one given unless another is asked for.
    fn bench_in(&self, usual: &str) -> Result<Bench, String> {
        let planner = self.planner.as_deref().unwrap_or("builtin");
        let planner = PlannerKind::read(planner, self.model.as_deref())?;
        let world = self.world.as_deref().unwrap_or(usual);
        let bench = Bench::new(world, self.driver.unwrap_or_default())?;
        let (workers, every) = (self.workers, self.every.unwrap_or(bench.every));
        let (only, has_pictures) = (self.only.clone(), self.has_pictures);
        Ok(Bench { planner, workers, every, only, has_pictures, ..bench })
    }

    /// True if a world, a driver, a planner or a part of the trials is asked for.
    const fn is_benched(&self) -> bool {
        self.world.is_some()
            || self.driver.is_some()
            || self.planner.is_some()
            || self.trials.is_some()
            || self.every.is_some()
            || self.objects.is_some()
            || self.has_pictures
            || !self.only.is_empty()
    }
}

/// Reads a number from 1.
fn number(text: &str) -> Result<usize, String> {
    let number = text.parse().ok().filter(|number| *number > 0);
    number.ok_or_else(|| format!("`{text}` is no whole number from 1"))
}

/// Lines for people, and the summary.
struct Report {
    lines: Vec<String>,
    summary: serde_json::Value,
    is_good: bool,
}

fn main() -> ExitCode {
    match run() {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(problem) => {
            let _ = writeln!(std::io::stderr(), "eval: {problem}");
            ExitCode::from(2)
        }
    }
}

/// Command lines of all suites.
fn usage() -> String {
    let names: Vec<_> = SUITES.iter().map(|(name, _)| *name).collect();
    format!(
        "usage: eval SUITE … [-j N] [--shard K/N] [--json]\n\n  \
         {} FILE   (saycan also with --planned)\n  \
         dialogue FILE [--objects seen|unseen] [--every N] [TRIALS]\n  \
         dynamic NUMBER [TRIALS]\n  \
         tasks [FILE…] [--trials N] [TRIALS]\n  \
         world NUMBER [TRIALS]\n  \
         mutations [--fix|--unsafe-fixes]\n  \
         soundness NUMBER|FILE… [--seed S] [--refusals]\n  \
         physics --robot NAME [--scene S] [--kind K] [--profile P] [--seeds N]\n  \
         reach [SCENE|--rooms N --seed S]   (`eval reach --help`)\n\n\
         TRIALS: [--world PROFILE] [--driver kinematic|mujoco] [--planner PLANNER] [--model M]\n        \
         [--pictures] [--only WORD]… [--continue FILE]",
        names.join("|")
    )
}

fn run() -> Result<bool, String> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    if let Some((_, rest)) = args.split_first().filter(|(suite, _)| *suite == "reach") {
        let (text, is_good) = motet_reach::command(rest)?;
        writeln!(std::io::stdout(), "{text}").map_err(|error| error.to_string())?;
        return Ok(is_good);
    }
    if args.iter().any(|arg| arg == "--help" || arg == "-h") {
        writeln!(std::io::stdout(), "{}", usage()).map_err(|error| error.to_string())?;
        return Ok(true);
    }
    if let Some((_, flags)) = args.split_first().filter(|(suite, _)| *suite == "physics") {
        let flags: Vec<String> = flags.iter().filter(|flag| *flag != "--json").cloned().collect();
        let found = physics::run(&flags)?;
        let sums = serde_json::from_str(&found.line).map_err(|error| error.to_string())?;
        let report = Report {
            lines: found.refuted().chain(found.table()).collect(),
            is_good: found.is_good(),
            summary: sums,
        };
        return shown(&report, args.iter().any(|arg| arg == "--json"));
    }
    let flags = Flags::read(&args)?;
    let (only_json, is_planned) = (flags.only_json, flags.is_planned);
    let words: Vec<&str> = flags.words.iter().map(String::as_str).collect();
    match words.as_slice() {
        ["dynamic", count] => {
            let count = count.parse().map_err(|_| usage())?;
            return shown(&changed(&flags.bench()?, count)?, only_json);
        }
        ["dialogue", file] => {
            let text = std::fs::read_to_string(file).map_err(|error| format!("{file}: {error}"))?;
            let objects = flags.objects.unwrap_or_default();
            return shown(&spoken(&flags.bench()?, &text, objects)?, only_json);
        }
        ["tasks", files @ ..] => return shown(&tasked(&flags, files)?, only_json),
        ["world", count] => {
            let count = count.parse().map_err(|_| usage())?;
            return shown(&failing(&flags.bench_in("harsh")?, count)?, only_json);
        }
        _ if flags.is_benched() => return Err(usage()),
        ["soundness", _, ..] => return shown(&sound(&flags, words.get(1..).unwrap_or_default())?, only_json),
        _ if flags.seed.is_some() || flags.shows_refusals => return Err(usage()),
        _ => {}
    }
    if words == ["mutations"] {
        let report = match flags.fixes {
            Some(limits) => mended(flags.workers, limits)?,
            None => mutated(flags.workers)?,
        };
        return shown(&report, only_json);
    }
    let [name, file] = words.as_slice() else { return Err(usage()) };
    if flags.fixes.is_some() {
        return Err(usage());
    }
    let known = SUITES.iter().find(|(known, _)| known == name);
    let suite = match (known, is_planned) {
        (Some(("saycan", _)), true) => planned_from_text,
        (Some((_, suite)), false) => *suite,
        (Some(_), true) | (None, _) => return Err(usage()),
    };
    let text = std::fs::read_to_string(file).map_err(|error| format!("{file}: {error}"))?;
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let lines: Vec<_> = lines.map(|(index, line)| (index + 1, line)).collect();
    let report = suite(flags.workers, &lines).map_err(|problem| format!("{file}:{problem}"))?;
    shown(&report, only_json)
}

/// Prints a report.
fn shown(report: &Report, only_json: bool) -> Result<bool, String> {
    let mut out = std::io::stdout().lock();
    let summary = report.summary.to_string();
    let shown = report.lines.iter().filter(|_| !only_json).chain([&summary]);
    for line in shown {
        writeln!(out, "{line}").map_err(|error| error.to_string())?;
    }
    Ok(report.is_good)
}

/// Runs over every line of the share; a problem is named by its line.
fn each<T: Send>(
    workers: Workers,
    lines: &[(usize, &str)],
    run: impl Fn(&str) -> Result<T, String> + Sync,
) -> Result<Vec<T>, String> {
    let run = |(number, line): (usize, &str)| run(line).map_err(|problem| format!("{number}: {problem}"));
    workers.spread(lines.to_vec(), run).into_iter().collect()
}

fn judged(
    workers: Workers,
    lines: &[(usize, &str)],
    judge: fn(&str) -> Result<Judged, String>,
) -> Result<Report, String> {
    let rows = each(workers, lines, judge)?;
    let sums = summary(&rows);
    Ok(Report {
        lines: rows.iter().filter_map(Judged::disagreement).collect(),
        is_good: sums.agree == sums.total,
        summary: serde_json::to_value(sums).map_err(|error| error.to_string())?,
    })
}

fn spoken(bench: &Bench, wordings: &str, objects: dialogue::Objects) -> Result<Report, String> {
    let trials = dialogue::trials(bench, wordings, objects)?;
    let notes = trials.iter().filter_map(|trial| {
        let case = &trial.case;
        let kinds: Vec<_> = case.failures.iter().map(|kind| kind.name()).collect();
        let note = trial.note.as_ref()?;
        Some(format!("{} {} [{}] {}: {note}", case.robot, case.scene, kinds.join(", "), case.request))
    });
    let (smooth, troubled): (Vec<_>, Vec<_>) =
        trials.iter().partition(|trial| trial.case.failures.is_empty());
    let (smooth, troubled) = (dialogue::sums(smooth.into_iter()), dialogue::sums(troubled.into_iter()));
    let is_clean = trials.iter().all(|trial| trial.faults.is_empty());
    Ok(Report {
        lines: notes.chain(dialogue::table(bench, &trials)).collect(),
        is_good: is_clean
            && smooth.success * 100 >= smooth.total * 95
            && troubled.success * 100 >= troubled.total * 90,
        summary: serde_json::json!({"without_failure": smooth, "with_failure": troubled}),
    })
}

/// The seed of the trials whose world changes.
const SEED: u64 = 7;

fn changed(bench: &Bench, count: usize) -> Result<Report, String> {
    let trials = dynamic::trials(bench, SEED, count)?;
    let good = trials.iter().filter(|trial| trial.is_good()).count();
    let is_clean = trials.iter().all(|trial| trial.faults.is_empty() && trial.fallen.is_empty());
    let notes = trials.iter().filter(|trial| !trial.is_good()).map(serde_json::to_string);
    let notes = notes.collect::<Result<Vec<_>, _>>().map_err(|error| error.to_string())?;
    Ok(Report {
        lines: notes.into_iter().chain(dynamic::table(bench, &trials)).collect(),
        is_good: is_clean && good * 100 >= trials.len() * 95,
        summary: serde_json::json!({"total": trials.len(), "good": good}),
    })
}

/// Tasks of the papers, where no other files are given.
const TASKS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tasks/papers.jsonl");
/// Trials of a task on a robot, where no other number is given.
const TRIALS: usize = 20;

fn tasked(flags: &Flags, files: &[&str]) -> Result<Report, String> {
    let (bench, files) = (flags.bench()?, if files.is_empty() { &[TASKS][..] } else { files });
    let mut tasks = Vec::new();
    for file in files {
        let text = std::fs::read_to_string(file).map_err(|error| format!("{file}: {error}"))?;
        let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
        let lines: Vec<_> = lines.map(|(index, line)| (index + 1, line)).collect();
        tasks.extend(tasks::read(&lines).map_err(|problem| format!("{file}:{problem}"))?);
    }
    let trials = tasks::trials(&bench, &tasks, flags.trials.unwrap_or(TRIALS))?;
    let notes = trials.iter().filter(|trial| !trial.is_reached);
    let notes = notes.map(|trial| format!("{} {}: {}", trial.robot, trial.request, trial.end));
    let good = trials.iter().filter(|trial| trial.is_reached).count();
    let is_clean = trials.iter().all(|trial| trial.faults.is_empty());
    Ok(Report {
        lines: notes.chain(tasks::table(&bench, &trials)).collect(),
        is_good: is_clean && good * 100 >= trials.len() * 90,
        summary: serde_json::json!({"total": trials.len(), "success": good}),
    })
}

/// The folder of the examples.
const EXAMPLES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples");

fn mutated(workers: Workers) -> Result<Report, String> {
    let ends = mutations::judge(workers, mutations::mutants(Path::new(EXAMPLES))?, 0)?;
    let notes = ends.iter().filter_map(|(mutant, end)| match end {
        mutations::MutantEnd::Unlisted(why) => Some(format!("{}: {why}", mutant.name)),
        _ => None,
    });
    let sums = mutations::summary(&ends);
    Ok(Report {
        lines: notes.collect(),
        is_good: sums.unlisted * 50 <= sums.silent,
        summary: serde_json::to_value(sums).map_err(|error| error.to_string())?,
    })
}

fn mended(workers: Workers, limits: FixLimits) -> Result<Report, String> {
    let bench = Bench { workers, ..Bench::ideal() };
    let all = mended::mend(&bench, mutations::mutants(Path::new(EXAMPLES))?, limits)?;
    let sums = mended::sums(&all);
    Ok(Report {
        lines: all.iter().map(MendedMutant::line).collect(),
        is_good: sums.done * 100 >= sums.mended * 85,
        summary: serde_json::to_value(sums).map_err(|error| error.to_string())?,
    })
}

/// Random policies, if a number is given, or those of files.
fn sound(flags: &Flags, given: &[&str]) -> Result<Report, String> {
    let seed = flags.seed.unwrap_or(1);
    let found = match given {
        [count] if count.parse::<usize>().is_ok() => soundness::fuzz(flags.workers, number(count)?, seed)?,
        files => {
            let text =
                |file: &&str| std::fs::read_to_string(file).map_err(|error| format!("{file}: {error}"));
            let read = |file: &&str| text(file).map(|text| ((*file).to_owned(), text));
            soundness::play(&files.iter().map(read).collect::<Result<Vec<_>, _>>()?, seed, None)?
        }
    };
    let in_vain = found.refused_in_vain.into_iter().filter(|_| flags.shows_refusals);
    Ok(Report {
        is_good: found.sums.findings.is_empty(),
        lines: in_vain.chain(found.findings).collect(),
        summary: serde_json::to_value(found.sums).map_err(|error| error.to_string())?,
    })
}

fn failing(bench: &Bench, count: usize) -> Result<Report, String> {
    let ends = world::carry_out(world::runs(Path::new(EXAMPLES), count)?, bench)?;
    let untrue =
        ends.iter().filter(|end| end.is_done && end.is_true == Some(false)).map(serde_json::to_string);
    let sums = world::sums(&ends);
    Ok(Report {
        lines: untrue.collect::<Result<Vec<_>, _>>().map_err(|error| error.to_string())?,
        is_good: sums.untrue == 0,
        summary: serde_json::to_value(sums).map_err(|error| error.to_string())?,
    })
}

fn planned_from_text(workers: Workers, lines: &[(usize, &str)]) -> Result<Report, String> {
    let rows = each(workers, lines, planned::attempt)?;
    let sums = planned::sums(rows.iter());
    let notes = rows
        .iter()
        .filter_map(|row| Some(format!("{}: {}: {}", row.id, row.instruction, row.note.as_ref()?)));
    Ok(Report {
        lines: notes.chain(planned::table(&rows)).collect(),
        is_good: sums.execution * 10 >= sums.total * 6,
        summary: serde_json::to_value(sums).map_err(|error| error.to_string())?,
    })
}

fn repaired(workers: Workers, lines: &[(usize, &str)]) -> Result<Report, String> {
    let rows: Vec<_> = each(workers, lines, scenarios::repair)?.into_iter().flatten().collect();
    let sums = repairs::summary(&rows);
    Ok(Report {
        lines: rows.iter().map(repairs::Repair::line).collect(),
        is_good: sums.repaired * 2 >= sums.total,
        summary: serde_json::to_value(sums).map_err(|error| error.to_string())?,
    })
}
