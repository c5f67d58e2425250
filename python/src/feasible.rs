//! Verdicts on motions.

use std::path::PathBuf;

use motet::feasible::{FeasibilityQuestion, Motions, decide};
use motet::robots::clearance::ClearanceOverride;
use pyo3::prelude::*;

use crate::errors::input_error;
use crate::findings::Findings;

/// Verdicts as pairs of text and JSON, a drawing as SVG, and the findings on the inputs.
type Verdicts = (Vec<(String, String)>, String, Findings);

/// The verdicts on motions, or on all motions of a scene, as pairs of text and JSON; a drawing as SVG; and
/// the findings on the inputs.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "they are keywords")]
#[pyo3(signature = (robot, scene, motions, *, state, effort, base_m, arm_m))]
pub(crate) fn feasible(
    py: Python<'_>,
    robot: &str,
    scene: &str,
    motions: Option<Vec<String>>,
    state: Option<PathBuf>,
    effort: u16,
    base_m: Option<f64>,
    arm_m: Option<f64>,
) -> PyResult<Verdicts> {
    let question = FeasibilityQuestion {
        robot,
        scene,
        state: state.as_deref(),
        motions: motions.as_deref().map_or(Motions::All, Motions::These),
        effort,
        clearance: ClearanceOverride { base_m, arm_m },
    };
    let (mut verdicts, mut findings) = (Vec::new(), Findings::default());
    let svg = py.detach(|| {
        decide(&question, &mut findings, &mut |_, verdict| verdicts.push((verdict.text, verdict.json)))
    });
    Ok((verdicts, svg.map_err(|error| input_error(py, &error))?, findings))
}
