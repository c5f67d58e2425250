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
/// Greatest number of pixels of a row and of a column of a box that are looked at.
const SAMPLES: u32 = 32;
/// The fewest pixels with a depth that tell how far a thing is.
const ENOUGH: usize = 5;
/// Greatest slope of a view, as a sine, at which the sides of a box are those of the thing.
const STEEP: f64 = 0.7;
/// Standard deviation of a depth in m.
const ERROR_M: f64 = 0.01;

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
    /// The part that is missing, too old or wrong.
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
        let [fx, fy, cx, cy] = intrinsics(&info);
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
        let image = self.depth_image(layouts, at).filter(|image| size(image) == Ok((width, height)))?;
        let mm = STANDARD.encode(millimetres(&image, width, height)?);
        Some(DepthMap { width, height, mm })
    }

    /// Depth image of about a time in s.
    fn depth_image(&self, layouts: &Layouts, at: f64) -> Option<Message> {
        let apart = |bytes: &Bytes| Some((stamp(bytes)? - at).abs()).filter(|apart| *apart <= APART);
        let near = self.depths.iter().filter_map(|(_, bytes)| Some((apart(bytes)?, bytes)));
        let (_, bytes) = near.min_by(|one, other| one.0.total_cmp(&other.0))?;
        decode(layouts, "sensor_msgs/Image", bytes).ok()
    }

    /// Depths at a time in s, with the camera that took them.
    ///
    /// # Errors
    ///
    /// The part that is missing, too old or wrong.
    fn depth_view(
        &self,
        at: f64,
        binding: &Binding,
        layouts: &Layouts,
        frames: &Frames,
    ) -> Result<DepthView, String> {
        let image = self.depth_image(layouts, at).ok_or("no depth image of the time of a detection")?;
        let info = self.info.as_ref().ok_or("no CameraInfo for a detection")?;
        let info = decode(layouts, "sensor_msgs/CameraInfo", info)?;
        let (width, height) = size(&image)?;
        if size(&info) != Ok((width, height)) {
            return Err("the depth has another size than the pictures of its camera".to_owned());
        }
        let mm = millimetres(&image, width, height).ok_or("a depth image that cannot be read")?;
        let (frame, time) = (image.text("header.frame_id"), image.secs("header.stamp"));
        let map_from_camera =
            frames.look_up(&binding.frames.map, frame, Some(time), binding.frames.age_secs)?;
        Ok(DepthView { map_from_camera, width, height, mm, intrinsics: intrinsics(&info) })
    }
}

/// Focal lengths x and y and principal point of a `sensor_msgs/CameraInfo` in pixels.
fn intrinsics(info: &Message) -> [f64; 4] {
    let k = info.numbers("k");
    [0, 4, 2, 5].map(|at| k.get(at).copied().unwrap_or_default())
}

/// Stamp in s of the header with which a message begins.
fn stamp(bytes: &Bytes) -> Option<f64> {
    let [secs, nanos] = [0, 4].map(|at| <[u8; 4]>::try_from(bytes.get(at..at + 4)?).ok());
    Some(f64::from(i32::from_le_bytes(secs?)) + f64::from(u32::from_le_bytes(nanos?)) * 1e-9)
}

/// Things of a `vision_msgs/Detection2DArray`, in the frame of the map, by the depth of their camera. Where
/// the depth does not tell its place, a detection has none; `wrong` is the reason.
pub(crate) fn box_detections(
    message: &Message,
    feed: &CameraFeed,
    binding: &Binding,
    layouts: &Layouts,
    frames: &Frames,
    known: &dyn Fn(&str) -> bool,
) -> (Vec<DetectedThing>, Option<String>) {
    let view = feed.depth_view(message.secs("header.stamp"), binding, layouts, frames);
    let boxes = message.list("detections").iter().take(MAX_DETECTIONS);
    let things = boxes.filter_map(|seen| {
        let place = view.as_ref().ok().and_then(|view| view.place(seen));
        let thing = named(seen, binding, known)?;
        let pose = place.map(|place| place.map_from_thing.pose());
        let extent = place.and_then(|place| place.extent);
        Some(DetectedThing { pose, extent, error_m: place.map(|place| place.error_m), ..thing })
    });
    (things.collect(), view.err())
}

/// A detection without a place: the surest of its classes, in the words of the binding.
fn named(seen: &Message, binding: &Binding, known: &dyn Fn(&str) -> bool) -> Option<DetectedThing> {
    let best = surest(seen)?;
    let class = best.text("hypothesis.class_id");
    let words = binding.detections.as_ref().and_then(|topic| topic.labels.get(class));
    Some(DetectedThing {
        label: words.map_or(class, String::as_str).to_owned(),
        id: Some(seen.text("id")).filter(|id| known(id)).map(str::to_owned),
        pose: None,
        extent: None,
        error_m: None,
        confidence: best.number("hypothesis.score").clamp(0.0, 1.0),
    })
}

fn surest(seen: &Message) -> Option<&Message> {
    let score = |result: &Message| result.number("hypothesis.score");
    seen.list("results").iter().max_by(|one, other| score(one).total_cmp(&score(other)))
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
        let Some((thing, best)) = named(seen, binding, known).zip(surest(seen)) else { continue };
        let pose = Transform::of(seen, "bbox.center.position", "bbox.center.orientation");
        let extent = ["x", "y", "z"].map(|axis| seen.number(&format!("bbox.size.{axis}")));
        let covariance = best.numbers("pose.covariance");
        let variance = [0, 7, 14].map(|at| covariance.get(at).copied().unwrap_or_default());
        let error = variance.into_iter().fold(0.0, f64::max).sqrt();
        things.push(DetectedThing {
            pose: pose.map(|pose| camera.then(pose).pose()),
            extent: extent.iter().all(|side| *side > 0.0).then_some(extent),
            error_m: (error > 0.0 && error.is_finite()).then_some(error),
            ..thing
        });
    }
    (things, wrong)
}

/// Depth image with the camera that took it.
struct DepthView {
    map_from_camera: Transform,
    width: u32,
    height: u32,
    /// Depths in mm, row by row, as little-endian 16 bit numbers.
    mm: Vec<u8>,
    /// Focal lengths x and y and principal point in pixels.
    intrinsics: [f64; 4],
}

/// Place of a thing that a box shows.
#[derive(Clone, Copy, Debug)]
struct BoxPlace {
    map_from_thing: Transform,
    /// Sides in m ahead, across and up; `None` in a steep view.
    extent: Option<[f64; 3]>,
    error_m: f64,
}

impl DepthView {
    /// Place of what the box of a `vision_msgs/Detection2D` shows: the median of the depths in the middle of
    /// the box is its near side, and it is taken for as deep as it is narrow. `None` without enough depths.
    fn place(&self, seen: &Message) -> Option<BoxPlace> {
        let [u, v] = ["x", "y"].map(|axis| seen.number(&format!("bbox.center.position.{axis}")));
        let [size_x, size_y] = ["x", "y"].map(|axis| seen.number(&format!("bbox.size_{axis}")));
        let [fx, fy, cx, cy] = self.intrinsics;
        let is_box = [u, v].iter().all(|part| part.abs() < 1e5);
        if !is_box || ![size_x, size_y, fx, fy].iter().all(|part| (1.0..1e5).contains(part)) {
            return None;
        }
        let (columns, rows) = (within(u, size_x, self.width)?, within(v, size_y, self.height)?);
        let columns: Vec<u32> = columns.collect();
        let depth = |row: u32, column: u32| {
            let at = 2 * (row as usize * self.width as usize + column as usize);
            let bytes: [u8; 2] = self.mm.get(at..at + 2)?.try_into().ok()?;
            Some(u16::from_le_bytes(bytes)).filter(|mm| *mm > 0)
        };
        let pixels = rows.flat_map(|row| columns.iter().map(move |column| (row, *column)));
        let mut depths: Vec<u16> = pixels.filter_map(|(row, column)| depth(row, column)).collect();
        if depths.len() < ENOUGH {
            return None;
        }
        let half = depths.len() / 2;
        let near = f64::from(*depths.select_nth_unstable(half).1) / 1000.0;
        let [across, up] = [size_x * near / fx, size_y * near / fy];
        let deep = across.min(up);
        let middle = near + deep / 2.0;
        let xyz = [(u - cx) / fx * middle, (v - cy) / fy * middle, middle];
        let at = self.map_from_camera.then(Transform { xyz, ..Transform::IDENTITY }).xyz;
        let tip = self.map_from_camera.then(Transform { xyz: [0.0, 0.0, 1.0], ..Transform::IDENTITY }).xyz;
        let ahead = [0, 1, 2].map(|axis| tip[axis] - self.map_from_camera.xyz[axis]);
        let map_from_thing = Transform::from_rpy(at, [0.0, 0.0, ahead[1].atan2(ahead[0])]);
        let extent = (ahead[2].abs() < STEEP).then_some([deep, across, up]);
        Some(BoxPlace { map_from_thing, extent, error_m: ERROR_M.max(deep / 4.0) })
    }
}

/// Some pixels of the middle half of a box along an axis.
fn within(middle: f64, size: f64, side: u32) -> Option<impl Iterator<Item = u32>> {
    let pixel = |place: f64| {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is limited")]
        let pixel = place.round().clamp(0.0, f64::from(side)) as u32;
        pixel
    };
    let (first, end) = (pixel(middle - size / 4.0), pixel(middle + size / 4.0 + 1.0).min(side));
    let step = (end.checked_sub(first)? / SAMPLES).max(1) as usize;
    Some((first..end).step_by(step))
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
    fn picture_has_depth_and_a_camera_in_the_map() {
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

    #[test]
    fn box_in_a_picture_has_its_place_by_the_depth_within() {
        let text = BINDING.replace("topic = \"t\"", "topic = \"t\", camera = \"head\"");
        let binding = Binding::parse(&text, "own").unwrap();
        // A wall at 3 m, and before it a thing of 20 × 20 pixels at 2 m.
        let depth: Vec<u8> = (0..80 * 60)
            .flat_map(|at: u32| {
                let is_thing = (40..60).contains(&(at % 80)) && (20..40).contains(&(at / 80));
                if is_thing { 2_000_u16 } else { 3_000 }.to_le_bytes()
            })
            .collect();
        let header = json!({"frame_id": "eye", "stamp": {"sec": 7}});
        let image = json!({"header": header, "width": 80, "height": 60, "encoding": "16UC1", "step": 160,
            "data": depth});
        let info =
            json!({"width": 80, "height": 60, "k": [100.0, 0.0, 40.0, 0.0, 100.0, 30.0, 0.0, 0.0, 1.0]});
        let mut feed = CameraFeed::default();
        let seen = |frame: &Frames, feed: &CameraFeed, x: f64| {
            let value = json!({"header": header, "detections": [{
                "results": [{"hypothesis": {"class_id": "cup", "score": 0.8}}],
                "bbox": {"center": {"position": {"x": x, "y": 30.0}}, "size_x": 20.0, "size_y": 20.0}}]});
            let name = "vision_msgs/Detection2DArray";
            let message = decode(&layouts(), name, &bytes(name, &value)).unwrap();
            let (things, wrong) = box_detections(&message, feed, &binding, &layouts(), frame, &|_| false);
            (things.into_iter().next().unwrap(), wrong)
        };
        let (thing, wrong) = seen(&frames(7), &feed, 50.0);
        assert!(
            thing.pose.is_none() && thing.label == "red mug" && wrong.unwrap().contains("no depth image")
        );
        feed.hear(Feed::Depth, bytes("sensor_msgs/Image", &image), Instant::now());
        feed.hear(Feed::Info, bytes("sensor_msgs/CameraInfo", &info), Instant::now());
        let (thing, wrong) = seen(&frames(7), &feed, 50.0);
        assert_eq!(wrong, None);
        // 0.4 m wide, its near side at 2 m: its middle is at 2.2 m, and the eye 1 m along x.
        let [x, y, z] = thing.pose.unwrap().xyz;
        assert!((x - 1.22).abs() < 1e-9 && y.abs() < 1e-9 && (z - 2.2).abs() < 1e-9, "{x} {y} {z}");
        assert!(thing.extent.is_none(), "the camera looks along z, which is up");
        assert!(seen(&frames(7), &feed, 5_000.0).0.pose.is_none(), "a box beside the picture");
        let (thing, wrong) = seen(&frames(3), &feed, 50.0);
        assert!(thing.pose.is_none() && wrong.unwrap().contains("4.00 s old"));
    }
}
