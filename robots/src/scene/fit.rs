//! Whether a scene fits the robot that is in it: what it says of joints, beside the URDF.

use motet_syntax::Diagnostic;

use super::model::Scene;
use crate::card::JointPosition;
use crate::urdf::Urdf;

/// Whether the joints that a scene gives are joints of the robot that move by themselves, within their limits; each mistake is told
/// at its place in the scene. O(joints given × joints).
#[must_use]
pub fn fit(scene: &Scene, urdf: &Urdf) -> Vec<Diagnostic> {
    let place = |name: &str| scene.robot.spans.0.get(name).copied().unwrap_or_default();
    let told = scene.robot.joints.iter().filter_map(|(name, value)| {
        JointPosition { joint: name, value: *value, span: place(name) }.fault(urdf)
    });
    told.collect()
}
