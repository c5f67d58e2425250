//! Verdicts on the motions of a program.

use motet_graph::{Configuration, Witness};
use smol_str::SmolStr;

/// Verdict on a motion that is not refused.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum MotionVerdict {
    /// Feasible in every possible world; the witness is from one of them, and so is the configuration in
    /// which a success leaves the robot, where it is known.
    Feasible(Box<Witness>, Option<Box<Configuration>>),
    /// Left to the run, for this reason if one is known.
    Deferred(Option<SmolStr>),
    /// Infeasible, for this reason: the step fails, and a handler catches that.
    Caught(SmolStr),
}

/// Verdicts by step: `None` for a step without motion, or without geometry.
pub(crate) type MotionVerdicts = Vec<Option<MotionVerdict>>;
