//! Whether a witness holds: limits, the grasp, and that nothing touches at samples no farther than 5 mm and
//! 0.6° apart.

use motet_geometry::planning::{Configuration, MotionWitness, SceneState};
use motet_robots::scene::Scene;

use crate::model::Model;
use crate::scenery::{Scenery, Touched};

/// Nearer than this counts as a touch, in m: half of what the query keeps.
const GAP: f64 = 0.001;

/// Faults of the witness of a `reach`, at most eight; none where it holds. Things that hang on hinges have to
/// be closed.
#[must_use]
pub fn faults(model: &Model, scene: &Scene, world: &SceneState, witness: &MotionWitness) -> Vec<String> {
    let mut faults = Vec::new();
    let Some((hand, scenery)) = model.machine.hand().zip(Scenery::new(scene, world)) else {
        return vec!["there is no hand, a mesh, or an open door".into()];
    };
    if witness.path.first() != Some(&world.robot) {
        faults.push("it does not begin where the robot is".into());
    }
    let name = |link: usize| model.urdf.links[link].name.clone();
    let grasped = witness.grasp.as_ref().and_then(|grasp| scene.entities.get_index_of(&grasp.object));
    // Where the hand is in front of the thing: from there on it may touch it.
    let near = witness.grasp.as_ref().map_or(usize::MAX, |grasp| {
        let at = grasp.map_from_tip.translation.vector;
        let far = |state| (model.links(state)[hand.tip].translation.vector - at).norm();
        witness.path.iter().position(|state| far(state) < 0.11).unwrap_or(usize::MAX)
    });
    for (leg, pair) in witness.path.windows(2).enumerate() {
        let [from, to] = pair else { continue };
        let turn = (to.base[2] - from.base[2]).abs();
        let drive = (to.base[0] - from.base[0]).hypot(to.base[1] - from.base[1]);
        let joints = from.joints.iter().zip(&to.joints).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let steps = (drive / 0.005).max(turn / 0.01).max(joints / 0.01).ceil().max(1.0) as usize;
        for step in 0..=steps {
            let state = from.towards(to, step as f64 / steps as f64);
            if !model.machine.tree().allows(&state.joints) {
                faults.push(format!("leg {leg}, step {step}: beyond the limits"));
            }
            let exempt = grasped.filter(|_| leg >= near);
            if let Some((link, other)) = scenery.touch(model, &state, exempt, GAP) {
                let other = match other {
                    Touched::Entity(at) => scene.entities.get_index(at).map_or("", |(id, _)| id).into(),
                    Touched::Link(link) => name(link),
                    Touched::Floor => "the floor".into(),
                };
                faults.push(format!("leg {leg}, step {step}: {} and {other}", name(link)));
            }
            if faults.len() >= 8 {
                return faults;
            }
        }
    }
    if let (Some(grasp), Some(last)) = (&witness.grasp, witness.path.last()) {
        let off = model.links(last)[hand.tip].inverse() * grasp.map_from_tip;
        if off.translation.vector.norm() > 1e-6 || off.rotation.angle() > 1e-6 {
            faults.push("the hand does not end at the grasp".into());
        }
        if grasp.width > hand.card.opening_m {
            faults.push("the hand does not open so wide".into());
        }
    }
    faults
}

/// True if a state is within the limits and touches nothing, the hand at a thing, which it may touch.
#[must_use]
pub(crate) fn is_free_at(
    model: &Model,
    scene: &Scene,
    world: &SceneState,
    state: &Configuration,
    target: &str,
) -> bool {
    let known = model.machine.hand().zip(Scenery::new(scene, world)).zip(scene.entities.get_full(target));
    let Some(((hand, scenery), (index, _, entity))) = known else { return false };
    let Some(at) = world.pose(entity) else { return false };
    let far = (model.links(state)[hand.tip].translation.vector - at.translation.vector).norm();
    far < 0.3
        && model.machine.tree().allows(&state.joints)
        && scenery.touch(model, state, Some(index), GAP).is_none()
}
