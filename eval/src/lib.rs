//! Verdicts of the compiler beside verdicts that are not ours, row by row.

pub mod actions;
pub mod bench;
pub mod dialogue;
pub mod dynamic;
pub mod few_shot;
pub mod mended;
pub mod mutations;
pub mod outcome;
pub mod physics;
pub mod planbench;
pub mod planners;
pub mod repairs;
pub mod saycan;
pub mod scenarios;
pub mod setup;
pub mod soundness;
pub mod tasks;
pub mod world;

use std::io;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Duration;

use indexmap::IndexMap;
use indicatif::{ProgressBar, ProgressStyle};
use motet::batch::{self, Shard};
use motet::line_file::LineFile;
use motet_compiler::Session;
use motet_syntax::{Diagnostic, Severity, Source, Sources};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Verdict of a row beside that of the compiler.
#[derive(Clone, Debug)]
pub struct Judged {
    /// The row's name.
    pub id: String,
    /// True if the row calls the plan wrong.
    pub expected_error: bool,
    /// True if the compiler does.
    pub found_error: bool,
    /// The class that the row gives, and the compiler's.
    pub class: Option<(String, String)>,
    /// The step that the row gives, and the compiler's.
    pub step: Option<(String, String)>,
    /// Time to read, check and prove.
    pub took: Duration,
    /// Under which name the row is added up once more, with others of its kind.
    pub group: Option<String>,
    /// Finding of the compiler in a few words.
    pub note: Option<String>,
}

/// The sums over all rows.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Summary {
    /// Rows judged.
    pub total: usize,
    /// Rows with the same verdict.
    pub agree: usize,
    /// Wrong plans that were accepted.
    pub missed: usize,
    /// Right plans that were refused.
    pub false_alarms: usize,
    /// Of the rows refused by both that give a class: the same class.
    pub class_agree: usize,
    /// Rows refused by both that give a class.
    pub class_total: usize,
    /// Of the rows refused by both that give a step: the same step.
    pub step_agree: usize,
    /// Rows refused by both that give a step.
    pub step_total: usize,
    /// Median time of a row in microseconds.
    pub median_us: f64,
    /// Of all these the sums of rows of one kind.
    #[serde(skip_serializing_if = "IndexMap::is_empty")]
    pub groups: IndexMap<String, Summary>,
}

impl Judged {
    /// Describes the difference in a line; none where there is none.
    #[must_use]
    pub fn disagreement(&self) -> Option<String> {
        let word = |error: bool| if error { "error" } else { "ok" };
        let note = self.note.as_ref().map(|note| format!(": {note}")).unwrap_or_default();
        if self.expected_error != self.found_error {
            let (expected, found) = (word(self.expected_error), word(self.found_error));
            return Some(format!("{}: expected {expected}, found {found}{note}", self.id));
        }
        let differs = |name: &str, pair: &Option<(String, String)>| {
            let (expected, found) = pair.as_ref().filter(|(expected, found)| expected != found)?;
            Some(format!("{}: {name} expected {expected}, found {found}{note}", self.id))
        };
        differs("class", &self.class).or_else(|| differs("step", &self.step))
    }
}

/// Adds up judged rows.
#[must_use]
pub fn summary(rows: &[Judged]) -> Summary {
    let mut groups: IndexMap<String, Vec<&Judged>> = IndexMap::new();
    for row in rows {
        if let Some(name) = &row.group {
            groups.entry(name.clone()).or_default().push(row);
        }
    }
    let groups = groups.iter().map(|(name, rows)| (name.clone(), sums(rows))).collect();
    Summary { groups, ..sums(&rows.iter().collect::<Vec<_>>()) }
}

fn sums(rows: &[&Judged]) -> Summary {
    let both: Vec<_> = rows.iter().filter(|row| row.expected_error && row.found_error).collect();
    let classes: Vec<_> = both.iter().filter_map(|row| row.class.as_ref()).collect();
    let steps: Vec<_> = both.iter().filter_map(|row| row.step.as_ref()).collect();
    let mut times: Vec<_> = rows.iter().map(|row| row.took).collect();
    times.sort_unstable();
    let median = times.get(times.len() / 2).copied().unwrap_or_default();
    Summary {
        total: rows.len(),
        agree: rows.iter().filter(|row| row.expected_error == row.found_error).count(),
        missed: rows.iter().filter(|row| row.expected_error && !row.found_error).count(),
        false_alarms: rows.iter().filter(|row| !row.expected_error && row.found_error).count(),
        class_agree: classes.iter().filter(|(expected, found)| expected == found).count(),
        class_total: classes.len(),
        step_agree: steps.iter().filter(|(expected, found)| expected == found).count(),
        step_total: steps.len(),
        median_us: median.as_secs_f64() * 1e6,
        groups: IndexMap::new(),
    }
}

/// Threads of a suite, and the share of its items that this process takes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Workers {
    /// Number of threads.
    pub jobs: usize,
    /// Share of the items.
    pub shard: Shard,
    /// File that keeps the results, so that a later call continues.
    pub kept: Option<KeptResults>,
}

/// File of results, and the words of the command line that decide them.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct KeptResults {
    pub path: &'static Path,
    pub words: &'static str,
}

impl KeptResults {
    /// Opens the file at its end, with the results that it has.
    fn open<R: DeserializeOwned>(self) -> Result<(LineFile, Vec<R>), String> {
        let path = self.path.display();
        let head = serde_json::json!({ "eval": self.words }).to_string();
        let (file, lines) =
            LineFile::headed(self.path, &head)
                .map_err(|error| format!("{path}: {error}"))?
                .ok_or_else(|| format!("{path}: not of `eval {}`: give another file", self.words))?;
        let read = |(index, line): (usize, &Vec<u8>)| {
            serde_json::from_slice(line).map_err(|error| format!("{path}:{}: {error}", index + 2))
        };
        Ok((file, lines.iter().enumerate().map(read).collect::<Result<_, _>>()?))
    }
}

impl Default for Workers {
    /// A thread for each core, and all items.
    fn default() -> Self {
        let jobs = std::thread::available_parallelism().map_or(1, usize::from);
        Self { jobs, shard: Shard::default(), kept: None }
    }
}

/// Bar with the rate and the time that is left, on a terminal.
fn progress(items: u64) -> ProgressBar {
    let bar = ProgressBar::new(items);
    match ProgressStyle::with_template("{wide_bar} {pos}/{len} {per_sec} {eta}") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

impl Workers {
    /// Runs something on each item of the share; the results are in the order of the items.
    pub fn spread<T: Send, R: Send>(self, items: Vec<T>, run: impl Fn(T) -> R + Sync) -> Vec<R> {
        let items = items.into_iter().enumerate().filter(|(index, _)| self.shard.has(*index));
        let items: Vec<T> = items.map(|(_, item)| item).collect();
        let (bar, mut done) = (progress(items.len() as u64), Vec::new());
        let _ = batch::in_order(self.jobs, 1, items, run, |result| {
            done.push(result);
            bar.inc(1);
            ControlFlow::<()>::Continue(())
        });
        bar.finish_and_clear();
        done
    }

    /// Runs something on each item of the share, as [`Workers::spread`] does; results that the file of
    /// `kept` has already are read from it.
    ///
    /// # Errors
    ///
    /// The first error of `run`, or the file is of another command, or cannot be read or written.
    pub fn spread_kept<T, R>(
        self,
        items: Vec<T>,
        run: impl Fn(T) -> Result<R, String> + Sync,
    ) -> Result<Vec<R>, String>
    where
        T: Send,
        R: Send + Serialize + DeserializeOwned,
    {
        let Some(kept) = self.kept else { return self.spread(items, run).into_iter().collect() };
        let items = items.into_iter().enumerate().filter(|(index, _)| self.shard.has(*index));
        let (mut file, mut done) = kept.open::<R>()?;
        let items: Vec<T> = items.map(|(_, item)| item).skip(done.len()).collect();
        let bar = progress(items.len() as u64);
        let ended = batch::in_order(self.jobs, 1, items, run, |result| {
            bar.inc(1);
            let result = match result {
                Ok(result) => result,
                Err(why) => return ControlFlow::Break(why),
            };
            let line = serde_json::to_string(&result).map_err(io::Error::from);
            if let Err(error) = line.and_then(|line| file.add(&line)) {
                return ControlFlow::Break(format!("{}: {error}", kept.path.display()));
            }
            done.push(result);
            ControlFlow::Continue(())
        });
        bar.finish_and_clear();
        match ended {
            ControlFlow::Break(why) => Err(why),
            ControlFlow::Continue(()) => Ok(done),
        }
    }
}

/// Checks a policy document under a domain of declarations, without robot and scene.
#[must_use]
pub fn check_in_domain(domain: &str, policy: &str) -> (Vec<Diagnostic>, Duration) {
    let mut sources = Sources::default();
    let source = Source::new("domain.motet", domain);
    let id = sources.add(source.clone());
    let parsed = motet_syntax::read(&source, id);
    let mut said = parsed.diagnostics;
    let session = Session::builder().domains(&[parsed.file]).build(&mut sources);
    let wrong = session.input_diagnostics().to_vec();
    said.extend(wrong);
    let source = Source::new("policy.json", policy);
    let id = sources.add(source.clone());
    let begin = std::time::Instant::now();
    said.extend(session.check(&motet_syntax::read(&source, id)));
    (said, begin.elapsed())
}

/// The first error in the order of the steps; that the goal is missed comes after all of them.
#[must_use]
pub fn first_error(said: &[Diagnostic]) -> Option<&Diagnostic> {
    let errors = said.iter().filter(|said| said.severity == Severity::Error);
    errors.min_by_key(|said| said.code.0 == "M0503")
}

#[cfg(test)]
mod tests {
    use std::io::Write as _;
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    #[test]
    fn spread_kept_goes_on_where_it_was_stopped() {
        let path = std::env::temp_dir().join(format!("motet-eval-kept-{}", std::process::id()));
        let _ = std::fs::remove_file(&path);
        let kept = KeptResults { path: Box::leak(path.clone().into_boxed_path()), words: "dynamic 3" };
        let workers = Workers { jobs: 2, kept: Some(kept), ..Workers::default() };
        let items = || (0..10).collect::<Vec<u32>>();
        let fails = |item: u32| if item < 6 { Ok(item * item) } else { Err(format!("no power for {item}")) };
        assert_eq!(workers.spread_kept(items(), fails), Err("no power for 6".to_owned()));
        // A line that was being written when the call was stopped.
        std::fs::OpenOptions::new().append(true).open(&path).unwrap().write_all(b"3").unwrap();
        let calls = AtomicUsize::new(0);
        let goes_on = |item: u32| {
            calls.fetch_add(1, Ordering::Relaxed);
            Ok(item * item)
        };
        let all: Vec<u32> = (0..10).map(|item| item * item).collect();
        assert_eq!(workers.spread_kept(items(), goes_on), Ok(all));
        assert_eq!(calls.into_inner(), 4);
        let other = Workers { kept: Some(KeptResults { words: "dynamic 4", ..kept }), ..workers };
        let refused = other.spread_kept(items(), |item: u32| Ok(item)).unwrap_err();
        assert!(refused.contains("not of `eval dynamic 4`"), "{refused}");
        std::fs::remove_file(path).unwrap();
    }
}
