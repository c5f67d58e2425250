//! Perception for the planner: detections in the scene, and image points of a model lifted into it.

mod ground;
mod grounding_driver;

use motet_robots::scene::{Placement, Scene};
use motet_runtime::Detection;
use motet_stdlib::lang::kinds;

pub use ground::{NoPoint, Pointer, ground, lift, point};
pub use grounding_driver::{GroundedPoint, GroundingDriver};

/// Minimum confidence of a detection.
const SURE: f64 = 0.5;

/// The scene updated from detections. A detected object is visible and stands where it was detected; any
/// other object is not visible. A detection without an entity counts for the only object of its class, if
/// there is just one. Poses are taken as upright: roll and pitch keep their values. O(detections ·
/// entities).
///
/// ```
/// use motet_planner::vision::with_detections;
///
/// let kitchen = motet_robots::builtin::scene("kitchen").unwrap();
/// let seen = with_detections(&kitchen, &[]);
/// assert_eq!(seen.entities["mug_1"].visible, Some(false));
/// ```
#[must_use]
pub fn with_detections(scene: &Scene, detections: &[Detection]) -> Scene {
    let mut scene = scene.clone();
    for entity in scene.entities.values_mut().filter(|entity| entity.kind == kinds::OBJECT) {
        entity.visible = Some(false);
    }
    for seen in detections.iter().filter(|seen| seen.confidence >= SURE) {
        let id = seen.entity.clone().or_else(|| {
            let mut like = scene.entities.values().filter(|entity| {
                !seen.class.is_empty() && entity.class == seen.class && entity.kind == kinds::OBJECT
            });
            let only = like.next()?;
            like.next().is_none().then(|| only.id.clone())
        });
        let Some(entity) = id.and_then(|id| scene.entities.get_mut(&id)) else { continue };
        entity.visible = Some(true);
        if let Some(pose) = seen.pose {
            let [x, y, z, w] = pose.quaternion;
            let yaw = (2.0 * (w * z + x * y)).atan2(1.0 - 2.0 * (y * y + z * z));
            let [roll, pitch, _] = entity.pose.map_or([0.0; 3], |old| old.rpy);
            entity.pose = Some(Placement { xyz: pose.xyz, rpy: [roll, pitch, yaw] });
        }
    }
    scene
}
