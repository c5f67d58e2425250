//! A motion that was found, as the graph keeps it.

use motet_geometry::planning::{MotionWitness, RobotModel, components};
use motet_graph as graph;

/// The witness of a motion. Of the joints only those that move.
pub(super) fn kept(machine: &RobotModel, witness: &MotionWitness) -> graph::Witness {
    let first = witness.path.first();
    let moves = |at: &usize| {
        let value = |joints: &[f64]| joints.get(*at).copied();
        let begin = first.and_then(|state| value(&state.joints));
        witness.path.iter().any(|state| value(&state.joints) != begin)
    };
    let dofs = machine.tree().dofs();
    let moving: Vec<usize> = (0..dofs.len()).filter(moves).collect();
    let path = witness.path.iter().map(|state| graph::Waypoint {
        base: state.base,
        joints: moving.iter().map(|at| state.joints.get(*at).copied().unwrap_or(0.0)).collect(),
    });
    graph::Witness {
        joints: moving.iter().filter_map(|at| Some(dofs.get(*at)?.name.clone())).collect(),
        path: path.collect(),
        grasp: witness.grasp.as_ref().map(|grasp| {
            let (xyz, quaternion) = components(&grasp.map_from_tip);
            graph::Grasp { xyz, quaternion, width: grasp.width }
        }),
        clearance: witness.margins.clearance,
        limit: witness.margins.limit,
        payload: witness.margins.payload,
    }
}
