//! Checks a scene against the URDF of its robot: the joints that it names.

use motet_syntax::Diagnostic;

use super::model::Scene;
use crate::card::JointPosition;
use crate::urdf::Urdf;

/// Checks that the joints of a scene are joints of the robot that move by themselves, within their limits.
/// Each diagnostic has the span in the scene. O(joints given × joints).
#[must_use]
pub fn fit(scene: &Scene, urdf: &Urdf) -> Vec<Diagnostic> {
    let place = |name: &str| scene.robot.spans.0.get(name).copied().unwrap_or_default();
    let told = scene.robot.joints.iter().filter_map(|(name, value)| {
        JointPosition { joint: name, value: *value, span: place(name) }.fault(urdf)
    });
    told.collect()
}
