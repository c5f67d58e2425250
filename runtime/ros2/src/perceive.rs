//! Pictures and detections for the host.

use crate::bind::{Binding, CameraTopics};
use crate::cdr::{Message, decode};
use crate::layout::Layouts;
use crate::picture::{Picture, millimetres, size};
use crate::tf::{Frames, Transform};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use bytes::Bytes;
use motet_host::remote::protocol::{Camera, DepthMap, DetectedThing, LookResult, PngImage};
use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// Messages of each topic of a camera that are kept.
const KEPT: usize = 6;
/// Greatest age of a picture.
const FRESH: Duration = Duration::from_secs(2);
/// Greatest difference of the times of a picture and its depth in s.
const APART: f64 = 0.1;
/// Greatest number of detections of a message.
const MAX_DETECTIONS: usize = 1_000;

/// Messages of a camera as they came.
#[derive(Default)]
pub(crate) struct CameraFeed {
    images: VecDeque<(Instant, Bytes)>,
    depths: VecDeque<(Instant, Bytes)>,
    info: Option<Bytes>,
}

/// Part of a camera.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Feed {
    Image,
    Depth,
    Info,
}

impl CameraFeed {
    /// Keeps a message. It is read when somebody looks.
    pub(crate) fn hear(&mut self, feed: Feed, bytes: Bytes, at: Instant) {
        let kept = match feed {
            Feed::Image => &mut self.images,
            Feed::Depth => &mut self.depths,
            Feed::Info => {
                self.info = Some(bytes);
                return;
            }
        };
        kept.push_back((at, bytes));
        if kept.len() > KEPT {
            kept.pop_front();
        }
    }

    /// The latest picture, with the depth nearest to it in time, and the pose of the camera at that time.
    ///
    /// # Errors
    ///
    /// What is missing, too old or wrong.
    pub(crate) fn look(
        &self,
        camera: &CameraTopics,
        binding: &Binding,
        layouts: &Layouts,
        frames: &Frames,
    ) -> Result<LookResult, String> {
        let name = &camera.name;
        let latest = self.images.back().filter(|(at, _)| at.elapsed() < FRESH);
        let (_, bytes) =
            latest.ok_or_else(|| format!("no picture of `{name}` within 2 s on {}", camera.image))?;
        let info = self.info.as_ref().ok_or_else(|| format!("no message on {}", camera.info))?;
        let image = decode(layouts, camera.image_type(), bytes)?;
        let info = decode(layouts, "sensor_msgs/CameraInfo", info)?;
        let picture = Picture::of(&image)?;
        let (width, height) = (picture.width, picture.height);
        let at = image.secs("header.stamp");
        let frame = image.text("header.frame_id");
        let pose = frames.look_up(&binding.frames.map, frame, Some(at), binding.frames.age_secs)?;
        let k = info.numbers("k");
        let [fx, cx, fy, cy] = [0, 2, 4, 5].map(|at| k.get(at).copied().unwrap_or_default());
        let depth = camera.depth.as_ref().and_then(|_| self.depth(layouts, at, width, height));
        let png = STANDARD.encode(picture.png()?);
        Ok(LookResult {
            image: PngImage { width, height, png },
            depth,
            camera: Camera { name: name.clone(), pose: pose.pose(), fx, fy, cx, cy },
        })
    }

    /// Depth of about the same time and of the same size.
    fn depth(&self, layouts: &Layouts, at: f64, width: u32, height: u32) -> Option<DepthMap> {
        let read =
            self.depths.iter().filter_map(|(_, bytes)| decode(layouts, "sensor_msgs/Image", bytes).ok());
        let apart = |image: &Message| (image.secs("header.stamp") - at).abs();
        let near = read.filter(|image| apart(image) <= APART && size(image) == Ok((width, height)));
        let image = near.min_by(|one, other| apart(one).total_cmp(&apart(other)))?;
        let mm = STANDARD.encode(millimetres(&image, width, height)?);
        Some(DepthMap { width, height, mm })
    }
}

/// Things of a `vision_msgs/Detection3DArray`, in the frame of the map. `known` says if an id is an entity.
/// Detections whose frame is unknown or too old are left out, with the reason.
pub(crate) fn detections(
    message: &Message,
    binding: &Binding,
    frames: &Frames,
    known: &dyn Fn(&str) -> bool,
) -> (Vec<DetectedThing>, Option<String>) {
    let (mut things, mut wrong) = (Vec::new(), None);
    for seen in message.list("detections").iter().take(MAX_DETECTIONS) {
        let of_array = message.text("header.frame_id");
        let own = seen.text("header.frame_id");
        let (frame, at) = if own.is_empty() {
            (of_array, message.secs("header.stamp"))
        } else {
            (own, seen.secs("header.stamp"))
        };
        let camera = match frames.look_up(&binding.frames.map, frame, Some(at), binding.frames.age_secs) {
            Ok(camera) => camera,
            Err(why) => {
                wrong = Some(why);
                continue;
            }
        };
        let best = seen
            .list("results")
            .iter()
            .max_by(|one, other| one.number("hypothesis.score").total_cmp(&other.number("hypothesis.score")));
        let Some(best) = best else { continue };
        let class = best.text("hypothesis.class_id");
        let words = binding.detections.as_ref().and_then(|topic| topic.labels.get(class));
        let pose = Transform::of(seen, "bbox.center.position", "bbox.center.orientation");
        let extent = ["x", "y", "z"].map(|axis| seen.number(&format!("bbox.size.{axis}")));
        let covariance = best.numbers("pose.covariance");
        let variance = [0, 7, 14].map(|at| covariance.get(at).copied().unwrap_or_default());
        let error = variance.into_iter().fold(0.0, f64::max).sqrt();
        let id = Some(seen.text("id")).filter(|id| known(id)).map(str::to_owned);
        things.push(DetectedThing {
            label: words.map_or(class, String::as_str).to_owned(),
            id,
            pose: pose.map(|pose| camera.then(pose).pose()),
            extent: extent.iter().all(|side| *side > 0.0).then_some(extent),
            error_m: (error > 0.0 && error.is_finite()).then_some(error),
            confidence: best.number("hypothesis.score").clamp(0.0, 1.0),
        });
    }
    (things, wrong)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cdr::encode;
    use crate::layout::Distribution;
    use serde_json::{Value, json};

    const BINDING: &str = "joints = { topic = \"j\" }\n\
        detections = { topic = \"t\", labels = { cup = \"red mug\" } }\n\
        [[cameras]]\nname = \"head\"\nimage = \"i\"\ndepth = \"d\"\ninfo = \"n\"";

    fn layouts() -> Layouts {
        Layouts::of(Distribution::Jazzy, None).unwrap()
    }

    fn bytes(name: &str, value: &Value) -> Bytes {
        encode(&layouts(), name, value).unwrap().into()
    }

    fn frames(sec: i32) -> Frames {
        let header = json!({"frame_id": "map", "stamp": {"sec": sec}});
        let value = json!({"transforms": [{"header": header, "child_frame_id": "eye",
            "transform": {"translation": {"x": 1.0}, "rotation": {"w": 1.0}}}]});
        let mut frames = Frames::default();
        frames.hear(
            &decode(&layouts(), "tf2_msgs/TFMessage", &bytes("tf2_msgs/TFMessage", &value)).unwrap(),
            false,
            Instant::now(),
            &crate::clock::Clock::default(),
        );
        frames
    }

    fn image(encoding: &str, step: u32, data: &[u8]) -> Bytes {
        bytes(
            "sensor_msgs/Image",
            &json!({"header": {"frame_id": "eye", "stamp": {"sec": 7}}, "width": 2, "height": 1,
            "encoding": encoding, "step": step, "data": data}),
        )
    }

    #[test]
    fn a_picture_has_depth_and_a_camera_in_the_map() {
        let binding = Binding::parse(BINDING, "own").unwrap();
        let mut feed = CameraFeed::default();
        feed.hear(Feed::Image, image("bgr8", 6, &[1, 2, 3, 4, 5, 6]), Instant::now());
        let metres: Vec<u8> = [1.5_f32, f32::NAN].iter().flat_map(|metre| metre.to_le_bytes()).collect();
        feed.hear(Feed::Depth, image("32FC1", 8, &metres), Instant::now());
        let look =
            |feed: &CameraFeed, sec| feed.look(&binding.cameras[0], &binding, &layouts(), &frames(sec));
        assert!(look(&feed, 7).unwrap_err().contains("no message on /n"));
        let k = [500.0, 0.0, 1.0, 0.0, 501.0, 0.5, 0.0, 0.0, 1.0];
        feed.hear(Feed::Info, bytes("sensor_msgs/CameraInfo", &json!({"k": k})), Instant::now());
        let picture = look(&feed, 7).unwrap();
        assert_eq!(STANDARD.decode(picture.depth.unwrap().mm).unwrap(), [220, 5, 0, 0]);
        assert_eq!((picture.camera.fx, picture.camera.cy, picture.camera.pose.xyz[0]), (500.0, 0.5, 1.0));
        assert!(look(&feed, 3).unwrap_err().contains("4.00 s old"));
        feed.hear(Feed::Image, image("bgr8", 6, &[1, 2]), Instant::now());
        assert_eq!(look(&feed, 7).unwrap_err(), "a picture has fewer bytes than its size says");
    }

    #[test]
    fn detections_come_into_the_map() {
        let binding = Binding::parse(BINDING, "own").unwrap();
        let value = json!({"header": {"frame_id": "eye", "stamp": {"sec": 7}}, "detections": [{
            "results": [{"hypothesis": {"class_id": "cup", "score": 0.8}}], "id": "mug_1",
            "bbox": {"center": {"position": {"x": 0.5}, "orientation": {"w": 1.0}},
                "size": {"x": 0.1, "y": 0.1, "z": 0.1}}}]});
        let name = "vision_msgs/Detection3DArray";
        let message = decode(&layouts(), name, &bytes(name, &value)).unwrap();
        let (things, wrong) = detections(&message, &binding, &frames(7), &|id| id == "mug_1");
        assert_eq!((things.len(), wrong), (1, None));
        assert_eq!((things[0].label.as_str(), things[0].id.as_deref()), ("red mug", Some("mug_1")));
        assert!((things[0].pose.unwrap().xyz[0] - 1.5).abs() < 1e-9);
        let (none, wrong) = detections(&message, &binding, &frames(3), &|_| true);
        assert!(none.is_empty() && wrong.unwrap().contains("4.00 s old"));
    }
}
