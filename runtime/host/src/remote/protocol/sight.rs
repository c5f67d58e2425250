//! Messages of the driver protocol about what a robot sees, hears and how it moves, with their bounds. A
//! value out of bounds is left out, so that nothing that a driver says can fill the host.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use motet_graph::Pose;
use motet_runtime::{
    CameraImage, CameraModel, DepthImage, Detection, Heard, Moved, MovedThing, RgbdView, Time,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;
use std::collections::BTreeMap;

/// The greatest width and height of a picture in pixels.
const MAX_SIDE: u32 = 4_096;
/// The most detections in a message, and the most joints or things in telemetry; further ones are left out.
const MAX_PARTS: usize = 1_000;
/// The longest name of a joint, or id or label of a thing, in bytes.
const MAX_NAME_BYTES: usize = 128;
/// The most characters of an utterance that are kept.
const MAX_UTTERANCE: usize = 1_000;
/// Greatest length of a position or a side in m, and greatest position of a joint.
const FARTHEST: f64 = 1e6;

/// Parameters of `look`.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct LookParams {
    /// The camera; the first one where none is named.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<String>,
}

/// The answer to `look`: a picture, its depth, and the camera that took both.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct LookResult {
    pub image: PngImage,
    /// Depth of the same view, pixel by pixel; absent for a camera that measures none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth: Option<DepthMap>,
    pub camera: Camera,
}

/// A picture as a PNG file.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct PngImage {
    /// Pixels, at most 4,096.
    pub width: u32,
    /// Pixels, at most 4,096.
    pub height: u32,
    /// The PNG file in base64.
    pub png: String,
}

/// A depth image.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct DepthMap {
    /// Pixels, as the picture has.
    pub width: u32,
    /// Pixels, as the picture has.
    pub height: u32,
    /// Depths along the camera's z axis in mm, row by row, as little-endian 16 bit numbers in base64; 0 where
    /// there is none.
    pub mm: String,
}

/// A pinhole camera.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Camera {
    pub name: String,
    /// Its pose in the frame `map`: z forward, x right, y down.
    pub pose: Pose,
    /// Focal length along x in pixels.
    pub fx: f64,
    /// Focal length along y in pixels.
    pub fy: f64,
    /// Principal point in pixels, counted from the centre of the pixel in the top left corner.
    pub cx: f64,
    /// Principal point in pixels, likewise.
    pub cy: f64,
}

/// Parameters of the report `detected`, and the answer to `detections`.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Detections {
    pub detections: Vec<DetectedThing>,
}

/// A thing that was seen.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct DetectedThing {
    /// Name for what it is, such as `mug`.
    pub label: String,
    /// The entity of the scene that it is, where it was recognised; or the driver's own name for a thing that
    /// the scene lacks, if the driver can act on it by this name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub id: Option<String>,
    /// Pose of its middle in the frame `map`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pose: Option<Pose>,
    /// Lengths of its sides along the axes of its pose, in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub extent: Option<[f64; 3]>,
    /// Standard deviation of its position along each axis in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error_m: Option<f64>,
    /// Confidence of the detector from 0 to 1.
    pub confidence: f64,
}

/// Parameters of `moved`, at most 50 of which are kept for a second.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct MovedParams {
    /// Seconds of the run. Of a driver without its own clock the time of arrival counts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<f64>,
    /// Base pose x, y, yaw in m and rad in the frame `map`.
    pub base: [f64; 3],
    /// Positions of joints by name in rad or m; those that have not changed may be left out.
    #[serde(default)]
    pub joints: BTreeMap<SmolStr, f64>,
    /// Poses of things in the frame `map`; those that have not moved may be left out.
    #[serde(default)]
    pub things: Vec<MovedThing>,
}

impl LookResult {
    /// The picture with its depth, as of a time.
    ///
    /// # Errors
    ///
    /// Why it is none.
    pub(crate) fn view(self, at: Time) -> Result<RgbdView, String> {
        let Self { image, depth, camera } = self;
        let (width, height) = (image.width, image.height);
        if !(1..=MAX_SIDE).contains(&width) || !(1..=MAX_SIDE).contains(&height) {
            return Err(format!("a picture of {width} × {height} pixels; at most {MAX_SIDE} × {MAX_SIDE}"));
        }
        let bytes = STANDARD.decode(&image.png).map_err(|error| format!("its PNG is not base64: {error}"))?;
        if png_size(&bytes) != Some([width, height]) {
            return Err(format!("its picture is no PNG of {width} × {height} pixels"));
        }
        let pixels = (width as usize) * (height as usize);
        let millimetres = match depth {
            // No depth anywhere: 0 says so.
            None => vec![0; pixels],
            Some(depth) => {
                let bytes = STANDARD.decode(&depth.mm);
                let bytes = bytes.map_err(|error| format!("its depth is not base64: {error}"))?;
                if [depth.width, depth.height] != [width, height] || bytes.len() != 2 * pixels {
                    return Err(
                        "its depth has not one 16 bit number for each pixel of the picture".to_owned()
                    );
                }
                bytes
                    .chunks_exact(2)
                    .filter_map(|pair| Some(u16::from_le_bytes(pair.try_into().ok()?)))
                    .collect()
            }
        };
        let Camera { name, pose, fx, fy, cx, cy } = camera;
        let intrinsics = [fx, fy, cx, cy];
        let pose = pose_within(&pose).ok_or("the pose of its camera is none")?;
        if !intrinsics.iter().all(|number| number.abs() <= FARTHEST) || fx <= 0.0 || fy <= 0.0 {
            return Err("its camera has no focal length".to_owned());
        }
        let image =
            CameraImage { camera: cut(&name), media_type: SmolStr::new_static("image/png"), bytes, at };
        let depth = DepthImage { width: width as usize, height: height as usize, millimetres };
        Ok(RgbdView { image, depth, camera: CameraModel { pose, intrinsics } })
    }
}

/// Width and height that the header of a PNG file states.
fn png_size(bytes: &[u8]) -> Option<[u32; 2]> {
    let header = bytes.strip_prefix(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR")?;
    let number = |at: usize| Some(u32::from_be_bytes(header.get(at..at + 4)?.try_into().ok()?));
    Some([number(0)?, number(4)?])
}

impl Detections {
    /// Detections within bounds, the surest first.
    pub(crate) fn seen(self, at: Time) -> Vec<Detection> {
        let within = self.detections.into_iter().take(MAX_PARTS).filter_map(|seen| seen.within(at));
        let mut seen: Vec<Detection> = within.collect();
        seen.sort_by(|one, other| other.confidence.total_cmp(&one.confidence));
        seen
    }
}

impl DetectedThing {
    fn within(self, at: Time) -> Option<Detection> {
        let pose = match &self.pose {
            Some(pose) => Some(pose_within(pose)?),
            None => None,
        };
        if !(0.0..=1.0).contains(&self.confidence) {
            return None;
        }
        let extent = self.extent.filter(|sides| sides.iter().all(|side| (0.0..=FARTHEST).contains(side)));
        let error_m = self.error_m.filter(|error| (0.0..=FARTHEST).contains(error));
        let entity = self.id.filter(|id| fits(id)).map(SmolStr::from);
        let (class, confidence) = (cut(&self.label), self.confidence);
        Some(Detection { entity, class, pose, extent, error_m, confidence, at })
    }
}

impl MovedParams {
    /// Message of telemetry, with its time.
    pub(crate) fn of(Moved { at, base, joints, things }: Moved) -> Self {
        Self { at: Some(at.secs()), base, joints, things }
    }

    /// Telemetry within bounds; `None` where the base is nowhere.
    pub(crate) fn moved(self, now: Time, owns_clock: bool) -> Option<Moved> {
        let Self { at, base, joints, things } = self;
        base.iter().all(|number| number.abs() <= FARTHEST).then(|| {
            let at = at.filter(|at| owns_clock && *at >= 0.0).map_or(now, Time::from_secs);
            let joints = joints.into_iter().filter(|(name, value)| fits(name) && value.abs() <= FARTHEST);
            let things = things.into_iter().filter_map(|thing| {
                let MovedThing { id, xyz, quaternion } = thing;
                let Pose { xyz, quaternion } = pose_within(&Pose { xyz, quaternion })?;
                fits(&id).then_some(MovedThing { id, xyz, quaternion })
            });
            let (joints, things) = (joints.take(MAX_PARTS).collect(), things.take(MAX_PARTS).collect());
            Moved { at, base, joints, things }
        })
    }
}

/// Words of at most [`MAX_UTTERANCE`] characters; `None` where there are none.
pub(crate) fn heard(Heard { text, from }: &Heard) -> Option<Heard> {
    let text: SmolStr = text.trim().chars().take(MAX_UTTERANCE).collect();
    let from = from.clone().filter(|from| fits(from));
    (!text.is_empty()).then_some(Heard { text, from })
}

/// A pose with a unit quaternion; `None` where it is none.
fn pose_within(pose: &Pose) -> Option<Pose> {
    let Pose { xyz, quaternion } = *pose;
    let norm = quaternion.iter().map(|part| part * part).sum::<f64>().sqrt();
    let is_within = xyz.iter().all(|number| number.abs() <= FARTHEST) && (1e-3..=1e3).contains(&norm);
    is_within.then(|| Pose { xyz, quaternion: quaternion.map(|part| part / norm) })
}

/// True for a name or an id of a length that is kept.
fn fits(name: &str) -> bool {
    (1..=MAX_NAME_BYTES).contains(&name.len())
}

fn cut(name: &str) -> SmolStr {
    name.chars().take(MAX_NAME_BYTES).collect()
}
