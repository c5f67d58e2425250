//! The laws of [`crate::Driver`] and of [`crate::Perception`], and the violations of them.

use crate::driver::Driver;
use crate::perception::Perception;
use crate::time::Time;
use std::fmt;

/// A law of [`crate::Driver`].
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Law {
    /// Every start is acknowledged or refused, once.
    Answered,
    /// An acknowledged goal ends, and once only.
    EndsOnce,
    /// After its end nothing is said of a goal.
    SilentAfterEnd,
    /// A cancelled goal ends soon.
    Cancelled,
    /// A safe stop is answered, also of a goal that has ended, is held, or was never heard of.
    SafeStop,
    /// A held goal does not end, and goes on when it is told to; or it is said that it cannot be held.
    Held,
    /// An updated goal goes on under its number, and ends by itself.
    Updated,
    /// A start of a primitive that the driver says it does not have is refused.
    Lacking,
    /// An observation is answered once.
    Observed,
    /// A watch is answered at once, and watching twice is watching once.
    Watched,
    /// A new run has no goal of the run before.
    Anew,
    /// Time never runs backwards, nor past what was asked for.
    Time,
    /// The same calls at the same times give the same reports.
    Repeatable,
}

/// A law that was broken.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct LawViolation {
    pub law: Law,
    /// Description of the violation.
    pub told: String,
}

impl Law {
    /// The law in words.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Self::Answered => "every start is acknowledged or refused, once",
            Self::EndsOnce => "an acknowledged goal ends exactly once",
            Self::SilentAfterEnd => "a goal is not reported again after its end",
            Self::Cancelled => "a cancelled goal ends soon",
            Self::SafeStop => "a safe stop is always answered",
            Self::Held => "a held goal keeps still until it is told to go on",
            Self::Updated => "an updated goal goes on under its number, and ends by itself",
            Self::Lacking => "a primitive that the driver does not have is refused",
            Self::Observed => "an observation is answered once",
            Self::Watched => "a watch is answered at once, and watching twice is watching once",
            Self::Anew => "a new run has no goal of the run before",
            Self::Time => "time never runs backwards, nor past the requested time",
            Self::Repeatable => "the same calls at the same times give the same reports",
        }
    }
}

impl fmt::Display for LawViolation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.law.text(), self.told)
    }
}

/// Looks twice at each of some times, given in order, and tells what breaks a law of [`Perception`]; nothing
/// where none is broken. What is detected is looked at more closely, too.
pub fn check_perception<D: Driver + Perception>(eyes: &mut D, times: &[Time]) -> Vec<String> {
    let mut broken = Vec::new();
    let finite =
        |pose: &motet_graph::Pose| pose.xyz.iter().chain(&pose.quaternion).all(|number| number.is_finite());
    for now in times {
        let seen = eyes.detections(*now);
        let again = eyes.detections(*now);
        let image = eyes.image(*now);
        let picture = eyes.look(*now, None);
        if seen != again || image != eyes.image(*now) || picture != eyes.look(*now, None) {
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
        if image.into_iter().chain(picture.map(|view| view.image)).any(|image| image.at > *now) {
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
