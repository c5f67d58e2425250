//! Grounding of a point on an object by a vision-language model: its answer `{"point": [u, v]}` in pixels,
//! lifted by the depth image and the camera's pose to a pose in the frame `map`.

use motet_graph::Pose;
use motet_runtime::{CameraImage, CameraModel, DepthImage, RgbdView};
use motet_stdlib::lang::failures;
use thiserror::Error;

/// Maximum length of an answer, in bytes: a point takes twenty.
const MAX_REPLY: usize = 4_096;
/// Characters of an answer that are quoted to the model.
const QUOTED: usize = 200;
/// Radius in pixels of the search for a depth value, since depth cameras leave holes along edges.
const NEIGHBOURHOOD: i64 = 3;
/// Range of depth that a robot's camera can measure, in m.
const RANGE_M: std::ops::RangeInclusive<f64> = 0.05..=20.0;

/// Source of image points: a model, or a person with a mouse.
pub trait Pointer {
    /// The answer as written, however wrong.
    ///
    /// # Errors
    ///
    /// The reason why there is none.
    fn ask(&mut self, image: &CameraImage, question: &str) -> Result<String, String>;
}

/// Reasons why there is no point.
#[derive(Error, Clone, PartialEq, Debug)]
pub enum NoPoint {
    /// No camera sees the object.
    #[error("no camera sees it")]
    Unseen,
    /// The model gave no answer.
    #[error("no answer: {0}")]
    Silent(String),
    /// The answer is not a point.
    #[error("the answer is no point: {0}")]
    Unreadable(&'static str),
    /// The answer names several points.
    #[error("the answer has several points")]
    Several,
    /// The point is not in the image.
    #[error("the point ({u:.1}, {v:.1}) is outside of the image of {width} x {height} pixels")]
    Outside { u: f64, v: f64, width: usize, height: usize },
    /// The depth image has nothing there.
    #[error("there is no depth within {NEIGHBOURHOOD} pixels of ({u:.1}, {v:.1})")]
    NoDepth { u: f64, v: f64 },
    /// The camera cannot be used.
    #[error("the camera cannot be used: {0}")]
    Camera(&'static str),
}

impl NoPoint {
    /// Failure of `ground` for this reason.
    #[must_use]
    pub const fn failure(&self) -> &'static str {
        match self {
            Self::Several => failures::AMBIGUOUS,
            Self::Unseen | Self::Silent(_) | Self::Unreadable(_) => failures::NOT_FOUND,
            Self::Outside { .. } | Self::NoDepth { .. } | Self::Camera(_) => failures::NOT_FOUND,
        }
    }
}

/// Purpose of a point.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Purpose {
    /// Name of the object.
    pub object: String,
    /// Part or use of the object, such as `grasping`.
    pub used_for: String,
    /// The request that the robot carries out; empty if it is not known.
    pub instruction: String,
    /// The step behind the question; empty if it is not known.
    pub next: String,
}

impl Purpose {
    fn question(&self, view: &RgbdView) -> String {
        let Self { object, used_for, instruction, next } = self;
        let mut text = format!("The image has {} x {} pixels.", view.depth.width, view.depth.height);
        if !instruction.is_empty() {
            text.push_str(&format!(" The robot was asked: \"{instruction}\"."));
        }
        if !next.is_empty() {
            text.push_str(&format!(" Its next action is {next}."));
        }
        text.push_str(&format!(
            " Point at the place on the {object} for: {used_for}. Answer with one point in pixels from the \
             top left corner, as JSON and nothing else: {{\"point\": [u, v]}}"
        ));
        text
    }
}

/// Asks where to act on an object for a purpose. A point that cannot be used is asked for once more, with the
/// reason. Returns the pose at the point, with the camera's orientation.
///
/// # Errors
///
/// The mistake in the second answer, the depth image or the camera.
pub fn ground(pointer: &mut dyn Pointer, view: &RgbdView, purpose: &Purpose) -> Result<Pose, NoPoint> {
    let question = purpose.question(view);
    let mut ask = |question: &str| {
        let reply =
            pointer.ask(&view.image, question).map_err(|why| RejectedAnswer::from(NoPoint::Silent(why)))?;
        let found = point(&reply).and_then(|point| lift(point, &view.depth, &view.camera));
        found.map_err(|why| why.of(&reply))
    };
    match ask(&question) {
        Err(RejectedAnswer { why, reply: Some(reply) }) if why.is_of_answer() => {
            let again =
                format!("{question}\nYou answered `{reply}`, which cannot be used: {why}. Answer again.");
            ask(&again).map_err(|told| told.why)
        }
        found => found.map_err(|told| told.why),
    }
}

/// A mistake with the answer that has it.
struct RejectedAnswer {
    why: NoPoint,
    reply: Option<String>,
}

impl From<NoPoint> for RejectedAnswer {
    fn from(why: NoPoint) -> Self {
        Self { why, reply: None }
    }
}

impl NoPoint {
    fn of(self, reply: &str) -> RejectedAnswer {
        RejectedAnswer { why: self, reply: Some(reply.trim().chars().take(QUOTED).collect()) }
    }

    /// True if another answer may be better.
    const fn is_of_answer(&self) -> bool {
        match self {
            Self::Unreadable(_) | Self::Several | Self::Outside { .. } | Self::NoDepth { .. } => true,
            Self::Unseen | Self::Silent(_) | Self::Camera(_) => false,
        }
    }
}

/// Reads `{"point": [u, v]}`, with any sentence or fence around it.
///
/// ```
/// use motet_planner::vision::point;
///
/// assert_eq!(point("The handle: {\"point\": [310, 95]}"), Ok([310.0, 95.0]));
/// ```
///
/// # Errors
///
/// The answer has no such object, has more or fewer than two numbers, an infinite number, or two different
/// points.
pub fn point(reply: &str) -> Result<[f64; 2], NoPoint> {
    if reply.len() > MAX_REPLY {
        return Err(NoPoint::Unreadable("it is too long"));
    }
    let mut found: Option<[f64; 2]> = None;
    for (start, _) in reply.match_indices('{') {
        let Some((_, object)) = reply.split_at_checked(start) else { continue };
        let mut values = serde_json::Deserializer::from_str(object).into_iter::<serde_json::Value>();
        let Some(Ok(value)) = values.next() else { continue };
        let Some(point) = value.get("point") else { continue };
        let numbers = point.as_array().ok_or(NoPoint::Unreadable("`point` is no list"))?;
        let [u, v] = numbers.as_slice() else {
            return Err(NoPoint::Unreadable("`point` has not two numbers"));
        };
        let (Some(u), Some(v)) = (u.as_f64(), v.as_f64()) else {
            return Err(NoPoint::Unreadable("`point` has something other than numbers"));
        };
        if !(u.is_finite() && v.is_finite()) {
            return Err(NoPoint::Unreadable("`point` is not finite"));
        }
        if found.is_some_and(|known| known != [u, v]) {
            return Err(NoPoint::Several);
        }
        found = Some([u, v]);
    }
    found.ok_or(NoPoint::Unreadable("there is no object with `point` in it"))
}

/// Lifts a point of an image to a pose in the frame `map`: `map_from_point = map_from_camera *
/// camera_from_point`, with the point at `((u - cx) / fx, (v - cy) / fy, 1) * depth` in front of the camera.
/// If the pixel has no depth, the median of its neighbourhood counts.
///
/// # Errors
///
/// A point outside of the image, no depth near it, or an invalid camera.
pub fn lift([u, v]: [f64; 2], depth: &DepthImage, camera: &CameraModel) -> Result<Pose, NoPoint> {
    let (width, height) = (depth.width, depth.height);
    if depth.millimetres.len() != width.saturating_mul(height) {
        return Err(NoPoint::Camera("the depth image has not width x height values"));
    }
    let [fx, fy, cx, cy] = camera.intrinsics;
    if !([fx, fy, cx, cy].iter().all(|number| number.is_finite()) && fx > 0.0 && fy > 0.0) {
        return Err(NoPoint::Camera("its intrinsics are no positive numbers"));
    }
    let Pose { xyz, quaternion } = camera.pose;
    let norm = quaternion.iter().map(|part| part * part).sum::<f64>().sqrt();
    if !(xyz.iter().all(|number| number.is_finite()) && norm.is_finite() && (norm - 1.0).abs() < 1e-3) {
        return Err(NoPoint::Camera("its pose is not finite, or turned by no unit quaternion"));
    }
    let quaternion = quaternion.map(|part| part / norm);
    let is_inside = u >= 0.0 && v >= 0.0 && u < width as f64 && v < height as f64;
    if !is_inside {
        return Err(NoPoint::Outside { u, v, width, height });
    }
    let far = depth_at(depth, u as i64, v as i64).ok_or(NoPoint::NoDepth { u, v })?;
    // A pixel's centre is half a pixel from its corner on both sides of the division: intrinsics count from
    // centres.
    let (u, v) = (u.floor(), v.floor());
    let in_camera = [(u - cx) / fx * far, (v - cy) / fy * far, far];
    let mut lifted = xyz;
    for (out, row) in lifted.iter_mut().zip(rotation(quaternion)) {
        *out += row.iter().zip(in_camera).map(|(turn, part)| turn * part).sum::<f64>();
    }
    Ok(Pose { xyz: lifted, quaternion })
}

/// Depth at a pixel in m, or the median of its neighbourhood.
fn depth_at(depth: &DepthImage, u: i64, v: i64) -> Option<f64> {
    let at = |u: i64, v: i64| {
        let (column, row) = (usize::try_from(u).ok()?, usize::try_from(v).ok()?);
        if column >= depth.width {
            return None;
        }
        let millimetres = depth.millimetres.get(row.checked_mul(depth.width)?.checked_add(column)?)?;
        let metres = f64::from(*millimetres) / 1_000.0;
        RANGE_M.contains(&metres).then_some(metres)
    };
    if let Some(exact) = at(u, v) {
        return Some(exact);
    }
    let around = -NEIGHBOURHOOD..=NEIGHBOURHOOD;
    let mut near: Vec<f64> =
        around.clone().flat_map(|dv| around.clone().filter_map(move |du| at(u + du, v + dv))).collect();
    near.sort_by(f64::total_cmp);
    near.get(near.len() / 2).copied()
}

/// The rotation of a unit quaternion, order x, y, z, w, by rows.
fn rotation([x, y, z, w]: [f64; 4]) -> [[f64; 3]; 3] {
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)],
        [2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)],
        [2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)],
    ]
}
