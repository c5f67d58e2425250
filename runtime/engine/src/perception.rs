//! Perception for planners: detections and images. The engine itself asks by [`crate::Driver::observe`]; this
//! is for the prompt of the next plan.

use crate::time::Time;
use motet_graph::Pose;
use smol_str::SmolStr;
use std::cell::RefCell;
use std::rc::Rc;

/// One thing that was seen.
#[derive(Clone, PartialEq, Debug)]
pub struct Detection {
    /// The entity of the scene that it is, where it was recognised; or the driver's own name for a thing that
    /// the scene lacks.
    pub entity: Option<SmolStr>,
    /// Class name such as `mug`; empty if unknown.
    pub class: SmolStr,
    /// Position where it is, in the frame `map`, in m; nothing where only the image tells.
    pub pose: Option<Pose>,
    /// Lengths of its sides along the axes of its pose in m, where they are known.
    pub extent: Option<[f64; 3]>,
    /// Standard deviation of its position along each axis in m, where the detector knows it.
    pub error_m: Option<f64>,
    /// Confidence of the detector from 0 to 1.
    pub confidence: f64,
    /// Time at which it was seen.
    pub at: Time,
}

/// A picture, as it goes to a model.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct CameraImage {
    /// Name of the camera.
    pub camera: SmolStr,
    /// `image/png` or `image/jpeg`.
    pub media_type: SmolStr,
    /// The file's bytes.
    pub bytes: Vec<u8>,
    /// Time at which it was taken.
    pub at: Time,
}

/// A pinhole camera with its pose: x to the right, y down, z ahead, as images are.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct CameraModel {
    /// Its pose in the frame `map`.
    pub pose: Pose,
    /// fx, fy, cx, cy in pixels, counted from the centre of the pixel in the top left corner.
    pub intrinsics: [f64; 4],
}

/// A depth image, row by row.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct DepthImage {
    pub width: usize,
    pub height: usize,
    /// Along the camera's z axis, in mm; 0 where there is none.
    pub millimetres: Vec<u16>,
}

/// A picture with its depth and the camera that took both.
#[derive(Clone, PartialEq, Debug)]
pub struct RgbdView {
    pub image: CameraImage,
    /// Depth of the same view, pixel by pixel.
    pub depth: DepthImage,
    /// Its pose and its intrinsics.
    pub camera: CameraModel,
}

/// Pictures that a planner asks for: the camera turns to what is worth to be seen. A driver that can turn it
/// implements this beside [`crate::Driver`], whose `look` takes the camera as it is turned and whose
/// `detections` tell what is in view.
///
/// # Laws
///
/// They hold for [`crate::Driver::look`] and [`crate::Driver::detections`], too.
///
/// 1. Looking changes nothing: neither the world, nor what the driver reports.
/// 2. What is given is as of `now` or older, and says so in `at`; nothing is dated later than `now`.
/// 3. A confidence is between 0 and 1, and a pose finite.
/// 4. Looked at twice at the same time, it gives the same.
/// 5. The surest detection comes first.
///
/// [`crate::conformance::check_perception`] checks them.
pub trait Perception {
    /// A fresh picture; none where there is no camera or it has nothing to show.
    fn image(&mut self, now: Time) -> Option<CameraImage>;
    /// A fresh picture of an entity with depth, the camera turned towards it; none where no camera measures
    /// depth, or where none gets to see the entity from here.
    fn view(&mut self, _now: Time, _of: &str) -> Option<RgbdView> {
        None
    }
}

/// Eyes that are also somebody else's.
impl<P: Perception> Perception for Rc<RefCell<P>> {
    fn image(&mut self, now: Time) -> Option<CameraImage> {
        self.borrow_mut().image(now)
    }

    fn view(&mut self, now: Time, of: &str) -> Option<RgbdView> {
        self.borrow_mut().view(now, of)
    }
}
