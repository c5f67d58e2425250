//! Conformance suite for the laws of [`Perception`].

use crate::perception::Perception;
use crate::time::Time;

/// Looks twice at each of some times, given in order, and tells what breaks a law; nothing where none is
/// broken. What is detected is looked at more closely, too.
pub fn check_perception(eyes: &mut dyn Perception, times: &[Time]) -> Vec<String> {
    let mut broken = Vec::new();
    let finite =
        |pose: &motet_graph::Pose| pose.xyz.iter().chain(&pose.quaternion).all(|number| number.is_finite());
    for now in times {
        let seen = eyes.detections(*now);
        let again = eyes.detections(*now);
        let image = eyes.image(*now);
        if seen != again || image != eyes.image(*now) {
            broken.push(format!("{} s: a second look at the same time gives something else", now.secs()));
        }
        for one in &seen {
            let name = one.entity.as_ref().unwrap_or(&one.class);
            if one.at > *now {
                broken.push(format!("{} s: `{name}` is dated {} s", now.secs(), one.at.secs()));
            }
            if !(0.0..=1.0).contains(&one.confidence) {
                broken.push(format!("{} s: `{name}` has a confidence of {}", now.secs(), one.confidence));
            }
            if one.pose.as_ref().is_some_and(|pose| !finite(pose)) {
                broken.push(format!("{} s: the pose of `{name}` is not finite", now.secs()));
            }
        }
        if seen.windows(2).any(|pair| matches!(pair, [one, next] if one.confidence < next.confidence)) {
            broken.push(format!("{} s: the surest does not come first", now.secs()));
        }
        if image.is_some_and(|image| image.at > *now) {
            broken.push(format!("{} s: the image is dated later", now.secs()));
        }
        for entity in seen.iter().filter_map(|one| one.entity.as_ref()) {
            let Some(view) = eyes.view(*now, entity) else { continue };
            if eyes.view(*now, entity).as_ref() != Some(&view) {
                broken.push(format!("{} s: a second view of `{entity}` is another", now.secs()));
            }
            if view.image.at > *now {
                broken.push(format!("{} s: the view of `{entity}` is dated later", now.secs()));
            }
            if view.depth.width.checked_mul(view.depth.height) != Some(view.depth.millimetres.len()) {
                broken.push(format!("{} s: the depth of `{entity}` is no image", now.secs()));
            }
            if !finite(&view.camera.pose) || !view.camera.intrinsics.iter().all(|number| number.is_finite()) {
                broken.push(format!("{} s: the camera that sees `{entity}` is not finite", now.secs()));
            }
        }
    }
    broken
}
