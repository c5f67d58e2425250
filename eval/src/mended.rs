//! Mended mutants: those that the check refuses, after the fixes of `motet check --fix`, run in simulation.
//!
//! A fix removes an error by the word of the check. The run shows if the policy then does what it is for. It
//! counts only if it ends as done, and its goal holds by the truth of the world.

use motet_compiler::Session;
use motet_compiler::fix::{FixLimits, fix};
use motet_syntax::{FileId, Severity, Source};
use serde::Serialize;

use crate::bench::Bench;
use crate::mutations::{Mutant, settings};
use crate::world::WorldRun;

/// Seed of the runs.
const SEED: u64 = 0;

/// Result for a mutant that the check refuses.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum MendedEnd {
    /// Errors are left after the fixes.
    Refused,
    /// It ends as done, with its goal.
    Done,
    /// It ends as done, but its goal does not hold.
    Untrue,
    /// It does not end as done.
    Failed,
}

/// Refused mutant after its fixes.
#[derive(Clone, Debug)]
pub struct MendedMutant {
    /// The mutant, with the text after its fixes.
    pub mutant: Mutant,
    /// Titles of the fixes, in order.
    pub fixes: Vec<String>,
    /// Result of the check and of the run after the fixes.
    pub end: MendedEnd,
}

/// Sums over the refused mutants.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct MendedSums {
    /// Mutants that the check refuses.
    pub refused: usize,
    /// Mutants without an error after their fixes.
    pub mended: usize,
    /// Mended mutants that end as done, with their goal.
    pub done: usize,
    /// Mended mutants that end as done without it.
    pub untrue: usize,
}

impl MendedMutant {
    /// Describes the fixes and the end.
    #[must_use]
    pub fn line(&self) -> String {
        format!("{}: {}: {:?}", self.mutant.name, self.fixes.join("; "), self.end)
    }
}

/// Applies fixes to each mutant that the check refuses, and runs those that then have no error.
///
/// # Errors
///
/// A mutant names a robot or a scene that is not built in, or the driver does not start.
pub fn mend(bench: &Bench, mutants: Vec<Mutant>, limits: FixLimits) -> Result<Vec<MendedMutant>, String> {
    let settings = settings(&mutants)?;
    let mended = bench.workers.spread(mutants, |mutant| {
        let setting = settings.get(&(mutant.robot.clone(), mutant.scene.clone()));
        setting.map_or(Ok(None), |setting| mend_one(bench, &setting.session, mutant, limits))
    });
    mended.into_iter().filter_map(Result::transpose).collect()
}

/// Mends a mutant and runs it; none if the check does not refuse it.
fn mend_one(
    bench: &Bench,
    session: &Session,
    mut mutant: Mutant,
    limits: FixLimits,
) -> Result<Option<MendedMutant>, String> {
    let file = FileId(99);
    let source = |mutant: &Mutant| Source::new("mutant.json", mutant.text.as_str());
    let is_refused = |mutant: &Mutant| {
        let said = session.check(&motet_syntax::read(&source(mutant), file));
        said.iter().any(|said| said.severity == Severity::Error)
    };
    if !is_refused(&mutant) {
        return Ok(None);
    }
    let fixed = fix(session, &source(&mutant), file, limits);
    let fixes = fixed.applied.into_iter().map(|applied| applied.title).collect();
    mutant.text = fixed.text;
    let end = if is_refused(&mutant) {
        MendedEnd::Refused
    } else {
        let run = WorldRun::of_mutant(&mutant, SEED).carry_out(bench)?;
        match (run.is_done, run.is_true) {
            (true, Some(false)) => MendedEnd::Untrue,
            (true, Some(true) | None) => MendedEnd::Done,
            (false, _) => MendedEnd::Failed,
        }
    };
    Ok(Some(MendedMutant { mutant, fixes, end }))
}

/// Adds up mended mutants.
#[must_use]
pub fn sums(all: &[MendedMutant]) -> MendedSums {
    let count = |end: MendedEnd| all.iter().filter(|mended| mended.end == end).count();
    MendedSums {
        refused: all.len(),
        mended: all.len() - count(MendedEnd::Refused),
        done: count(MendedEnd::Done),
        untrue: count(MendedEnd::Untrue),
    }
}
