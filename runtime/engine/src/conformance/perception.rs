//! Whether eyes keep the laws of [`Perception`].

use crate::perception::Perception;
use crate::time::Time;

/// Looks twice at each of some times, given in order, and tells what breaks a law; nothing where none is broken.
pub fn perception(eyes: &mut dyn Perception, times: &[Time]) -> Vec<String> {
    let mut broken = Vec::new();
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
            let finite = |pose: &motet_graph::Pose| {
                pose.xyz.iter().chain(&pose.quaternion).all(|number| number.is_finite())
            };
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
    }
    broken
}
