//! What is seen, for who plans: detections and images. The engine itself asks by [`crate::Driver::observe`]; this is for the
//! prompt of the next plan.

use crate::time::Time;
use motet_graph::Pose;
use smol_str::SmolStr;

/// One thing that was seen.
#[derive(Clone, PartialEq, Debug)]
pub struct Detection {
    /// The entity of the scene that it is, where it was recognised.
    pub entity: Option<SmolStr>,
    /// What it is, `mug`; empty where that is not known.
    pub class: SmolStr,
    /// Where it is, in the frame `map`, in m; nothing where only the image tells.
    pub pose: Option<Pose>,
    /// How sure the detector is, from 0 to 1.
    pub confidence: f64,
    /// When it was seen.
    pub at: Time,
}

/// A picture, as it goes to a model.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Image {
    /// Which camera took it.
    pub camera: SmolStr,
    /// `image/png` or `image/jpeg`.
    pub media_type: SmolStr,
    /// The file's bytes.
    pub bytes: Vec<u8>,
    /// When it was taken.
    pub at: Time,
}

/// The eyes of a robot. A driver that has any implements it beside [`crate::Driver`].
///
/// # Laws
///
/// 1. Looking changes nothing: neither the world, nor what the driver reports.
/// 2. What is given is as of `now` or older, and says so in `at`; nothing is dated later than `now`.
/// 3. A confidence is between 0 and 1, and a pose finite.
/// 4. Looked at twice at the same time, it gives the same.
///
/// [`crate::conformance::perception`] checks them.
pub trait Perception {
    /// What is in view now, or was at the last look, the surest first.
    fn detections(&mut self, now: Time) -> Vec<Detection>;
    /// A fresh picture; none where there is no camera or it has nothing to show.
    fn image(&mut self, now: Time) -> Option<Image>;
}
