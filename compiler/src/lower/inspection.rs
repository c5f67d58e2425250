//! Inspection of the steps of a checked program, for editors: durations, and the verdicts on needs and
//! motions.

use motet_syntax::Span;
use smol_str::SmolStr;

use super::deferred_notes::needs_left;
use crate::declare::Library;
use crate::environment::Environment;
use crate::feasibility::{MotionVerdict, MotionVerdicts};
use crate::ir::{Program, StepId, StepKind};
use crate::prove::{Proof, Prover};

/// Result of the stages for one step of a document.
#[derive(Clone, PartialEq, Debug)]
pub struct StepInspection {
    pub span: Span,
    /// Least duration, in seconds.
    pub least_secs: f64,
    /// Greatest duration, in seconds; failures, waits and retries included.
    pub greatest_secs: f64,
    /// Verdicts on a call; `None` for any other step, and for one that nothing leads to.
    pub call: Option<CallInspection>,
}

/// Verdicts on the needs and the motion of a call.
#[derive(Clone, PartialEq, Debug)]
pub struct CallInspection {
    /// Number of needs.
    pub needs: usize,
    /// Needs that are left to the run, as conditions in back-quotes.
    pub guards: Vec<String>,
    pub motion: MotionInspection,
}

/// Verdict on the motion of a call.
#[derive(Clone, PartialEq, Debug)]
pub enum MotionInspection {
    /// The call has no motion.
    Absent,
    /// Feasible in every possible world, with a witness.
    Feasible,
    /// Left to the run, for a reason if one is known.
    Deferred(Option<SmolStr>),
    /// Infeasible for this reason, and a handler catches that.
    Caught(SmolStr),
}

/// Inspects the steps that a document itself has, in its order.
pub(crate) fn inspect(
    program: &Program,
    proof: &Proof,
    placed: &MotionVerdicts,
    library: &Library,
    environment: &Environment,
) -> Vec<StepInspection> {
    let prover = Prover::new(program, library, environment);
    let mut steps = Vec::new();
    for (index, step) in program.steps.iter().enumerate() {
        let Ok(id) = u32::try_from(index).map(StepId) else { break };
        if step.span.file != program.span.file || matches!(step.kind, StepKind::Unknown) {
            continue;
        }
        let is_reached = proof.reached.get(index).copied().unwrap_or(false);
        let call = match &step.kind {
            StepKind::Call(call) if is_reached => library.primitive(call.primitive).map(|def| {
                let verdict = placed.get(index).and_then(Option::as_ref);
                CallInspection {
                    needs: def.needs.len(),
                    guards: needs_left(&prover, proof, verdict, id, (call, def)),
                    motion: match verdict {
                        // Without a geometry nothing was searched.
                        None if def.motion.is_some() => MotionInspection::Deferred(None),
                        None => MotionInspection::Absent,
                        Some(MotionVerdict::Feasible(..)) => MotionInspection::Feasible,
                        Some(MotionVerdict::Deferred(why)) => MotionInspection::Deferred(why.clone()),
                        Some(MotionVerdict::Caught(why)) => MotionInspection::Caught(why.clone()),
                    },
                }
            }),
            _ => None,
        };
        let (least_secs, greatest_secs) = step.bounds;
        steps.push(StepInspection { span: step.span, least_secs, greatest_secs, call });
    }
    steps
}
