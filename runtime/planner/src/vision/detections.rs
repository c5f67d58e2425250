//! A scene brought up to date with what is seen.

use motet_robots::scene::{Placement, Scene};
use motet_runtime::Detection;

/// The least confidence that counts as seen.
const SURE: f64 = 0.5;

/// The scene with what is seen: a thing that was detected is visible and stands where it was detected, any
/// other object is
/// not visible. A detection without an entity counts for the one object of its class, where there is just
/// one. Poses are
/// taken as upright: roll and pitch stay as they were. O(detections · entities).
#[must_use]
pub fn with_detections(scene: &Scene, detections: &[Detection]) -> Scene {
    let mut scene = scene.clone();
    for entity in scene.entities.values_mut().filter(|entity| entity.kind == "Object") {
        entity.visible = Some(false);
    }
    for seen in detections.iter().filter(|seen| seen.confidence >= SURE) {
        let id = seen.entity.clone().or_else(|| {
            let mut like = scene.entities.values().filter(|entity| {
                !seen.class.is_empty() && entity.class == seen.class && entity.kind == "Object"
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
