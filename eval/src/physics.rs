//! Verdicts beside physics: `eval physics --robot NAME` carries every feasible verdict out in MuJoCo.
//!
//! The judge is the Python package `runtime/mujoco`. This suite starts it, adds its trials up by kind of
//! motion, and compares the shares with the aims.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use indexmap::IndexMap;
use serde::Deserialize;

/// Folder of the package.
const PACKAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../runtime/mujoco");

/// Flags that are passed on to the judge, each with a value.
const FLAGS: [&str; 9] =
    ["--robot", "--scene", "--kind", "--profile", "--seeds", "--motet", "-j", "--jobs", "--shard"];

/// One verdict carried out once.
#[derive(Clone, PartialEq, Debug, Deserialize)]
pub struct Trial {
    /// Scene, a built-in name or the name of a file.
    pub scene: String,
    /// Motion, such as `reach(mug_1)`.
    pub query: String,
    /// Seed of what is drawn.
    pub seed: u64,
    /// True if physics bears the verdict out.
    pub holds: bool,
    /// Reason, in words.
    pub why: String,
}

/// Trials of one kind.
#[derive(Clone, PartialEq, Debug, Deserialize)]
pub struct Share {
    /// Trials that physics bears out.
    pub held: usize,
    /// All trials.
    pub of: usize,
    /// Interval of the share at 95 %.
    pub interval: [f64; 2],
    /// Share that is the aim.
    pub aim: f64,
}

/// End of what the judge prints.
#[derive(Clone, PartialEq, Debug, Deserialize)]
pub struct Sums {
    /// Shares by kind of motion.
    pub shares: IndexMap<String, Share>,
    /// Greatest error of a hand without load along its path: m and rad.
    pub error: [f64; 2],
    /// Simulated seconds.
    pub simulated_secs: f64,
    /// Seconds of the processor for them.
    pub processor_secs: f64,
}

/// Verdicts of the judge.
#[derive(Clone, PartialEq, Debug)]
pub struct Judgement {
    /// Trials in order.
    pub trials: Vec<Trial>,
    /// Their sums.
    pub sums: Sums,
    /// The line of the sums, as it was printed.
    pub line: String,
}

/// Starts the judge with the flags of the suite.
///
/// # Errors
///
/// A flag is unknown, the judge cannot be started, or it fails; its own words say why.
pub fn run(flags: &[String]) -> Result<Judgement, String> {
    if let Some(pair) = flags.chunks(2).find(|pair| {
        let is_known = pair.first().is_some_and(|flag| FLAGS.contains(&flag.as_str()));
        !is_known || pair.len() < 2
    }) {
        let flag = pair.first().cloned().unwrap_or_default();
        return Err(format!("`{flag}` is no flag of `eval physics`, or has no value: {}", FLAGS.join(", ")));
    }
    let mut command = Command::new("python3");
    command.args(["-m", "motet_mujoco.judge", "--format", "json"]).args(flags);
    if let Some(motet) = beside().filter(|_| !flags.iter().any(|flag| flag == "--motet")) {
        command.arg("--motet").arg(motet);
    }
    let paths = std::env::var_os("PYTHONPATH").unwrap_or_default();
    let paths = [PathBuf::from(PACKAGE)].into_iter().chain(std::env::split_paths(&paths));
    command.env("PYTHONPATH", std::env::join_paths(paths).map_err(|error| error.to_string())?);
    let done = command.stdin(Stdio::null()).output();
    let done = done.map_err(|error| format!("`python3` cannot be started: {error}"))?;
    if !done.status.success() {
        let said = String::from_utf8_lossy(&done.stderr);
        return Err(format!(
            "the judge failed: {}",
            said.trim_end().lines().last().unwrap_or("it said nothing")
        ));
    }
    read(&String::from_utf8_lossy(&done.stdout))
}

/// The command `motet` that was built with this program.
fn beside() -> Option<PathBuf> {
    let own = std::env::current_exe().ok()?;
    let motet = own.parent()?.join(format!("motet{}", std::env::consts::EXE_SUFFIX));
    Path::is_file(&motet).then_some(motet)
}

/// Reads what the judge prints: a line for each trial, and their sums.
///
/// # Errors
///
/// A line is of another form, or there is none with sums.
pub fn read(text: &str) -> Result<Judgement, String> {
    let mut lines: Vec<&str> = text.lines().filter(|line| !line.trim().is_empty()).collect();
    let line = lines.pop().ok_or("the judge printed nothing")?.to_owned();
    let wrong = |error: serde_json::Error| format!("the judge printed something else: {error}");
    let sums = serde_json::from_str(&line).map_err(wrong)?;
    let trials = lines.into_iter().map(|line| serde_json::from_str(line).map_err(wrong));
    Ok(Judgement { trials: trials.collect::<Result<_, _>>()?, sums, line })
}

impl Judgement {
    /// True if each kind of motion reaches its aim.
    #[must_use]
    pub fn is_good(&self) -> bool {
        let mut shares = self.sums.shares.values();
        shares.all(|share| share.held as f64 >= share.aim * share.of as f64 - 1e-9)
    }

    /// Trials that physics refutes, a line each.
    pub fn refuted(&self) -> impl Iterator<Item = String> {
        let refuted = self.trials.iter().filter(|trial| !trial.holds);
        refuted.map(|trial| format!("{} {} seed {}: {}", trial.scene, trial.query, trial.seed, trial.why))
    }

    /// Table of the shares by kind, and how the hand follows its paths.
    #[must_use]
    pub fn table(&self) -> Vec<String> {
        let mut rows = vec![
            "| motion | borne out | share | interval at 95 % | aim |".to_owned(),
            "|---|---|---|---|---|".to_owned(),
        ];
        let percent = |share: f64| 100.0 * share;
        rows.extend(self.sums.shares.iter().map(|(kind, share)| {
            let [low, high] = share.interval.map(percent);
            format!(
                "| `{kind}` | {} of {} | {:.1} % | {low:.1} to {high:.1} % | {:.0} % |",
                share.held,
                share.of,
                percent(share.held as f64 / (share.of as f64).max(1.0)),
                percent(share.aim)
            )
        }));
        let [off, turned] = self.sums.error;
        rows.push(format!(
            "off the witness by at most {:.2} mm and {:.2} mrad; {:.0} times real time",
            off * 1e3,
            turned * 1e3,
            self.sums.simulated_secs / self.sums.processor_secs.max(1e-9)
        ));
        rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PRINTED: &str = concat!(
        r#"{"scene": "kitchen", "query": "reach(mug_1)", "seed": 0, "holds": true, "#,
        r#""why": "slips by 0.1 mm", "error": [0, 0]}"#,
        "\n",
        r#"{"scene": "kitchen", "query": "reach(pan)", "seed": 0, "holds": false, "#,
        r#""why": "falls", "error": [0.0, 0.0]}"#,
        "\n",
        r#"{"robot": "hsr", "shares": {"reach": {"held": 1, "of": 2, "interval": [0.09, 0.91], "#,
        r#""aim": 0.95}}, "#,
        r#""error": [0.001, 0.0005], "simulated_secs": 30.0, "processor_secs": 1.0}"#,
        "\n",
    );

    #[test]
    fn physics_adds_up_what_the_judge_prints() {
        let found = read(PRINTED).unwrap();
        assert!(!found.is_good());
        assert_eq!(found.refuted().collect::<Vec<_>>(), ["kitchen reach(pan) seed 0: falls"]);
        let table = found.table().join("\n");
        assert!(table.contains("| `reach` | 1 of 2 | 50.0 % | 9.0 to 91.0 % | 95 % |"), "{table}");
        assert!(table.contains("1.00 mm and 0.50 mrad; 30 times real time"), "{table}");
    }

    #[test]
    fn physics_refuses_what_it_does_not_know() {
        assert!(read("").is_err());
        assert!(read("{}").is_err());
        let flags = |flags: &[&str]| run(&flags.iter().map(|flag| (*flag).to_owned()).collect::<Vec<_>>());
        assert!(flags(&["--speed", "3"]).unwrap_err().contains("`--speed`"));
        assert!(flags(&["--robot"]).unwrap_err().contains("no value"));
    }
}
