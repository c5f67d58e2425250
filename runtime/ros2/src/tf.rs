//! Frames of the robot over time.

use crate::cdr::Message;
use crate::clock::Clock;
use std::collections::{HashMap, VecDeque};
use std::time::Instant;

/// Transforms of each frame that are kept.
const KEPT: usize = 256;
/// Greatest number of frames, and of frames from one to the root.
const MAX_FRAMES: usize = 1_000;

/// Pose in the plane: m and rad.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(crate) struct Planar {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) yaw: f64,
}

impl Planar {
    /// A pose x, y, yaw as seen from this frame. Its yaw stays continuous.
    #[must_use]
    pub(crate) fn seen_from(self, [x, y, yaw]: [f64; 3]) -> [f64; 3] {
        let (sin, cos) = self.yaw.sin_cos();
        let (dx, dy) = (x - self.x, y - self.y);
        [cos * dx + sin * dy, cos * dy - sin * dx, yaw - self.yaw]
    }
}

/// Rigid transform: a position in m, and a rotation as a unit quaternion x, y, z, w.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Transform {
    pub(crate) xyz: [f64; 3],
    pub(crate) quaternion: [f64; 4],
}

impl From<motet_graph::Pose> for Transform {
    fn from(pose: motet_graph::Pose) -> Self {
        Self { xyz: pose.xyz, quaternion: pose.quaternion }
    }
}

impl Transform {
    /// The transform that changes nothing.
    pub(crate) const IDENTITY: Self = Self { xyz: [0.0; 3], quaternion: [0.0, 0.0, 0.0, 1.0] };

    /// Transform of a message with the fields of positions and rotations under these names. `None` if its
    /// rotation is none.
    #[must_use]
    pub(crate) fn of(message: &Message, position: &str, rotation: &str) -> Option<Self> {
        let number = |path: &str, axis: &str| message.number(&format!("{path}.{axis}"));
        let xyz = ["x", "y", "z"].map(|axis| number(position, axis));
        let quaternion = ["x", "y", "z", "w"].map(|axis| number(rotation, axis));
        let norm = quaternion.iter().map(|part| part * part).sum::<f64>().sqrt();
        let is_one = xyz.iter().all(|part| part.abs() < 1e6) && (0.5..2.0).contains(&norm);
        is_one.then(|| Self { xyz, quaternion: quaternion.map(|part| part / norm) })
    }

    /// This transform, and then another one in its frame.
    #[must_use]
    pub(crate) fn then(self, inner: Self) -> Self {
        let moved = rotate(self.quaternion, inner.xyz);
        let xyz = [0, 1, 2].map(|at| self.xyz[at] + moved[at]);
        Self { xyz, quaternion: multiply(self.quaternion, inner.quaternion) }
    }

    /// Transform with roll, pitch and yaw in rad, about the fixed axes x, y, z in that order.
    #[must_use]
    pub(crate) fn from_rpy(xyz: [f64; 3], rpy: [f64; 3]) -> Self {
        let about = |axis: usize| {
            let mut quaternion = [0.0, 0.0, 0.0, (rpy[axis] / 2.0).cos()];
            quaternion[axis] = (rpy[axis] / 2.0).sin();
            quaternion
        };
        Self { xyz, quaternion: multiply(multiply(about(2), about(1)), about(0)) }
    }

    /// Roll, pitch and yaw in rad, about the fixed axes x, y, z in that order.
    #[must_use]
    pub(crate) fn rpy(self) -> [f64; 3] {
        let [x, y, z, w] = self.quaternion;
        let roll = (2.0 * (w * x + y * z)).atan2(1.0 - 2.0 * (x * x + y * y));
        let pitch = (2.0 * (w * y - z * x)).clamp(-1.0, 1.0).asin();
        [roll, pitch, self.planar().yaw]
    }

    /// Pose of the language.
    #[must_use]
    pub(crate) const fn pose(self) -> motet_graph::Pose {
        motet_graph::Pose { xyz: self.xyz, quaternion: self.quaternion }
    }

    /// The pose in the plane.
    #[must_use]
    pub(crate) fn planar(self) -> Planar {
        Planar { x: self.xyz[0], y: self.xyz[1], yaw: self.pose().yaw() }
    }

    fn inverse(self) -> Self {
        let [x, y, z, w] = self.quaternion;
        let quaternion = [-x, -y, -z, w];
        Self { xyz: rotate(quaternion, self.xyz).map(|part| -part), quaternion }
    }

    /// The transform at a share of the way to another one.
    fn between(self, to: Self, share: f64) -> Self {
        let xyz = [0, 1, 2].map(|at| self.xyz[at] + share * (to.xyz[at] - self.xyz[at]));
        let dot: f64 = self.quaternion.iter().zip(to.quaternion).map(|(one, other)| one * other).sum();
        // Of the two quaternions of a rotation, the nearer one.
        let sign = if dot < 0.0 { -1.0 } else { 1.0 };
        let mixed =
            [0, 1, 2, 3].map(|at| (1.0 - share) * self.quaternion[at] + share * sign * to.quaternion[at]);
        let norm = mixed.iter().map(|part| part * part).sum::<f64>().sqrt();
        Self { xyz, quaternion: mixed.map(|part| part / norm) }
    }
}

fn multiply([ax, ay, az, aw]: [f64; 4], [bx, by, bz, bw]: [f64; 4]) -> [f64; 4] {
    [
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    ]
}

fn rotate(quaternion: [f64; 4], [x, y, z]: [f64; 3]) -> [f64; 3] {
    let [a, b, c, d] = quaternion;
    let rotated = multiply(multiply(quaternion, [x, y, z, 0.0]), [-a, -b, -c, d]);
    [rotated[0], rotated[1], rotated[2]]
}

struct Frame {
    parent: String,
    is_static: bool,
    /// Time of the last transform, by its stamp: at the latest its arrival.
    heard: Instant,
    /// Transforms with their times in s, the oldest first.
    history: VecDeque<(f64, Transform)>,
}

/// Frames as the topics `/tf` and `/tf_static` have told them.
#[derive(Default)]
pub(crate) struct Frames {
    frames: HashMap<String, Frame>,
}

impl Frames {
    /// Takes in a `tf2_msgs/TFMessage` that came at `now`. Transforms that are none are left out.
    pub(crate) fn hear(&mut self, message: &Message, is_static: bool, now: Instant, clock: &Clock) {
        for told in message.list("transforms") {
            let child = told.text("child_frame_id").trim_start_matches('/').to_owned();
            let parent = told.text("header.frame_id").trim_start_matches('/').to_owned();
            let transform = Transform::of(told, "transform.translation", "transform.rotation");
            let Some(transform) = transform.filter(|_| child != parent && !child.is_empty()) else {
                continue;
            };
            if self.frames.len() >= MAX_FRAMES && !self.frames.contains_key(&child) {
                continue;
            }
            let at = told.secs("header.stamp");
            let now = clock.written(at, now);
            let frame = self.frames.entry(child).or_insert_with(|| Frame {
                parent: parent.clone(),
                is_static,
                heard: now,
                history: VecDeque::new(),
            });
            if frame.parent != parent {
                frame.parent = parent;
                frame.history.clear();
            }
            (frame.is_static, frame.heard) = (is_static, now);
            // A clock that goes back is another one, such as that of a simulation that was started anew.
            if is_static || frame.history.back().is_some_and(|(last, _)| *last > at + 1.0) {
                frame.history.clear();
            }
            let place = frame.history.partition_point(|(other, _)| *other <= at);
            frame.history.insert(place, (at, transform));
            if frame.history.len() > KEPT {
                frame.history.pop_front();
            }
        }
    }

    /// Transform of a frame as seen from another one at a time in s; without a time the newest, as seen now.
    ///
    /// # Errors
    ///
    /// The frame that is unknown, or whose last transform is more than `age` seconds older than that time.
    pub(crate) fn look_up(
        &self,
        target: &str,
        source: &str,
        time: Option<f64>,
        age: f64,
    ) -> Result<Transform, String> {
        let (to_source, root) = self.to_root(source, time, age)?;
        let (to_target, other) = self.to_root(target, time, age)?;
        if root != other {
            return Err(format!("no transform leads from `{target}` to `{source}`"));
        }
        Ok(to_target.inverse().then(to_source))
    }

    /// Time in s of the newest transform of a frame.
    #[must_use]
    pub(crate) fn newest(&self, frame: &str) -> Option<f64> {
        self.frames.get(frame)?.history.back().map(|(at, _)| *at)
    }

    /// Transform of a frame as seen from its root, with the root's name.
    fn to_root<'a>(
        &'a self,
        frame: &'a str,
        time: Option<f64>,
        age: f64,
    ) -> Result<(Transform, &'a str), String> {
        let (mut total, mut at) = (Transform::IDENTITY, frame.trim_start_matches('/'));
        for _ in 0..MAX_FRAMES {
            let Some(known) = self.frames.get(at) else { return Ok((total, at)) };
            total = known.at(at, time, age)?.then(total);
            at = &known.parent;
        }
        Err(format!("the frames above `{frame}` go in a circle"))
    }
}

impl Frame {
    fn at(&self, name: &str, time: Option<f64>, age: f64) -> Result<Transform, String> {
        let Some((last, newest)) = self.history.back().copied() else {
            return Err(format!("no transform of `{name}` yet"));
        };
        if self.is_static {
            return Ok(newest);
        }
        let Some(time) = time else {
            let silent = self.heard.elapsed().as_secs_f64();
            if silent > age {
                return Err(format!("the last transform of `{name}` is {silent:.2} s old"));
            }
            return Ok(newest);
        };
        if time >= last {
            let late = time - last;
            return if late <= age {
                Ok(newest)
            } else {
                Err(format!("the last transform of `{name}` is {late:.2} s old"))
            };
        }
        let after = self.history.partition_point(|(at, _)| *at < time);
        let (next, to) = self.history[after];
        if after == 0 {
            let early = next - time;
            return if early <= age {
                Ok(to)
            } else {
                Err(format!("no transform of `{name}` {early:.2} s ago"))
            };
        }
        let (before, from) = self.history[after - 1];
        Ok(from.between(to, (time - before) / (next - before).max(1e-9)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cdr::{decode, encode};
    use crate::layout::{Distribution, Layouts};
    use serde_json::json;

    fn told(frames: &mut Frames, parent: &str, child: &str, sec: i32, x: f64, yaw: f64, is_static: bool) {
        let layouts = Layouts::of(Distribution::Jazzy, None).unwrap();
        let value = json!({"transforms": [{"header": {"frame_id": parent, "stamp": {"sec": sec}},
            "child_frame_id": child, "transform": {"translation": {"x": x},
            "rotation": {"z": (yaw / 2.0).sin(), "w": (yaw / 2.0).cos()}}}]});
        let bytes = encode(&layouts, "tf2_msgs/TFMessage", &value).unwrap();
        frames.hear(
            &decode(&layouts, "tf2_msgs/TFMessage", &bytes).unwrap(),
            is_static,
            Instant::now(),
            &Clock::default(),
        );
    }

    #[test]
    fn pose_is_looked_up_at_its_time() {
        let mut frames = Frames::default();
        told(&mut frames, "map", "odom", 10, 1.0, 0.0, true);
        told(&mut frames, "odom", "base", 10, 0.0, 0.0, false);
        told(&mut frames, "odom", "base", 12, 2.0, 1.0, false);
        let base = frames.look_up("map", "base", Some(11.0), 0.1).unwrap().planar();
        assert!((base.x - 2.0).abs() < 1e-9 && (base.yaw - 0.5).abs() < 1e-9, "{base:?}");
        let seen = frames.look_up("base", "map", None, 0.1).unwrap();
        let there_and_back = frames.look_up("map", "base", None, 0.1).unwrap().then(seen);
        assert!(there_and_back.xyz.iter().all(|part| part.abs() < 1e-9));
    }

    #[test]
    fn angles_come_back() {
        let rpy = [0.3, -0.8, 2.5];
        let back = Transform::from_rpy([0.0; 3], rpy).rpy();
        assert!(back.iter().zip(rpy).all(|(is, wanted)| (is - wanted).abs() < 1e-12), "{back:?}");
    }

    #[test]
    fn old_and_unknown_frames_are_refused() {
        let mut frames = Frames::default();
        told(&mut frames, "odom", "base", 10, 0.0, 0.0, false);
        let wrong = |target, time| frames.look_up(target, "base", time, 0.5).unwrap_err();
        assert_eq!(wrong("odom", Some(11.0)), "the last transform of `base` is 1.00 s old");
        assert_eq!(wrong("map", None), "no transform leads from `map` to `base`");
        frames.frames.get_mut("base").unwrap().heard -= std::time::Duration::from_secs(3);
        let silent = frames.look_up("odom", "base", None, 0.5).unwrap_err();
        assert_eq!(silent, "the last transform of `base` is 3.00 s old");
        let mut circle = Frames::default();
        told(&mut circle, "a", "b", 1, 0.0, 0.0, false);
        told(&mut circle, "b", "a", 1, 0.0, 0.0, false);
        assert_eq!(circle.look_up("a", "b", None, 0.5).unwrap_err(), "the frames above `b` go in a circle");
    }
}
