//! What the robot's topics say of its body: joints, base, frames, and whether it stands still.

use crate::bind::{Binding, Standstill};
use crate::cdr::Message;
use crate::clock::Clock;
use crate::tf::{Frames, Planar};
use std::collections::{BTreeMap, BTreeSet};
use std::time::{Duration, Instant};

/// Age from which a state of the joints or of the base counts no more.
const FRESH: Duration = Duration::from_millis(500);
/// Greatest number of joints.
const MAX_JOINTS: usize = 1_000;

/// Position and speed of a joint.
#[derive(Clone, Copy, Debug)]
struct JointState {
    position: f64,
    speed: f64,
    at: Instant,
    /// The joint has been slow since; `None` while it moves.
    still: Option<Instant>,
}

/// Body of the robot as it is now.
#[derive(Default)]
pub(crate) struct Body {
    /// Joints by their names in ROS.
    joints: BTreeMap<String, JointState>,
    base: Option<BaseState>,
    /// Greatest standard deviation of the localisation in the plane in m; infinite if it says none.
    pub(crate) sigma: Option<f64>,
    pub(crate) frames: Frames,
    clock: Clock,
}

#[derive(Clone, Copy, Debug)]
struct BaseState {
    pose: Planar,
    at: Instant,
    still: Option<Instant>,
}

/// Parts of the robot that something moves.
#[derive(Clone, PartialEq, Debug, Default)]
pub(crate) struct Parts {
    /// Joints by their names in ROS.
    pub(crate) joints: BTreeSet<String>,
    /// True if the base moves, too.
    pub(crate) drives: bool,
    /// Whatever is heard of: nobody knows which parts.
    pub(crate) all: bool,
}

impl Parts {
    /// True if nothing moves.
    #[must_use]
    pub(crate) fn is_empty(&self) -> bool {
        self.joints.is_empty() && !self.drives && !self.all
    }
}

impl Body {
    /// Takes in a `tf2_msgs/TFMessage` that came at `now`.
    pub(crate) fn hear_frames(&mut self, message: &Message, is_static: bool, now: Instant) {
        self.frames.hear(message, is_static, now, &self.clock);
    }

    /// Takes in a `sensor_msgs/JointState` that came at `now`. It is as old as its stamp says.
    pub(crate) fn hear_joints(&mut self, message: &Message, limits: &Standstill, now: Instant) {
        let now = self.clock.hear(message.secs("header.stamp"), now);
        let (positions, speeds) = (message.numbers("position"), message.numbers("velocity"));
        for (at, name) in message.list("name").iter().enumerate() {
            let (Message::Text(name), Some(position)) = (name, positions.get(at)) else { continue };
            let before = self.joints.get(name).copied();
            if !position.is_finite() || (before.is_none() && self.joints.len() >= MAX_JOINTS) {
                continue;
            }
            // Without a speed it follows from the positions.
            let speed = speeds.get(at).copied().filter(|speed| speed.is_finite()).unwrap_or_else(|| {
                let since =
                    before.map_or(0.0, |before| now.saturating_duration_since(before.at).as_secs_f64());
                before.filter(|_| since > 1e-4).map_or(0.0, |before| (position - before.position) / since)
            });
            let still =
                still_since(speed.abs() < limits.joints, before.map(|before| (before.still, before.at)), now);
            self.joints.insert(name.clone(), JointState { position: *position, speed, at: now, still });
        }
    }

    /// Takes in a `nav_msgs/Odometry` that came at `now`. It is as old as its stamp says.
    pub(crate) fn hear_odometry(&mut self, message: &Message, limits: &Standstill, now: Instant) {
        let now = self.clock.hear(message.secs("header.stamp"), now);
        let speed = message.number("twist.twist.linear.x").hypot(message.number("twist.twist.linear.y"));
        let turn = message.number("twist.twist.angular.z").abs();
        let before = self.base.map(|before| (before.still, before.at));
        let still = still_since(speed < limits.base && turn < limits.turn, before, now);
        let pose = crate::tf::Transform::of(message, "pose.pose.position", "pose.pose.orientation");
        if let Some(pose) = pose {
            self.base = Some(BaseState { pose: pose.planar(), at: now, still });
        }
    }

    /// Takes in a `geometry_msgs/PoseWithCovarianceStamped`: how exactly the robot knows its place.
    pub(crate) fn hear_localization(&mut self, message: &Message) {
        let covariance = message.numbers("pose.covariance");
        let [xx, xy, yy] = [0, 1, 7].map(|at| covariance.get(at).copied().unwrap_or(f64::NAN));
        // The greater eigenvalue is the variance in the direction in which the place is least certain.
        let greatest = (xx + yy) / 2.0 + ((xx - yy) / 2.0).hypot(xy);
        let is_one = greatest.is_finite() && xx >= 0.0 && yy >= 0.0;
        self.sigma = Some(if is_one { greatest.sqrt() } else { f64::INFINITY });
    }

    /// Position of a joint by its name in ROS, if it is fresh.
    #[must_use]
    pub(crate) fn position(&self, joint: &str) -> Option<f64> {
        self.joints.get(joint).filter(|state| state.at.elapsed() < FRESH).map(|state| state.position)
    }

    /// Positions of all joints by their names in ROS, if they are fresh.
    #[must_use]
    pub(crate) fn positions(&self) -> BTreeMap<String, f64> {
        let fresh = self.joints.iter().filter(|(_, state)| state.at.elapsed() < FRESH);
        fresh.map(|(name, state)| (name.clone(), state.position)).collect()
    }

    /// Greatest speed of the joints of some parts, for a report.
    #[must_use]
    pub(crate) fn fastest(&self, parts: &Parts) -> Option<(&str, f64)> {
        let asked = self.joints.iter().filter(|(name, _)| parts.all || parts.joints.contains(*name));
        let speeds = asked.map(|(name, state)| (name.as_str(), state.speed.abs()));
        speeds.max_by(|one, other| one.1.total_cmp(&other.1))
    }

    /// True if the joints and the base of some parts have been slow for long enough, and are known to be.
    ///
    /// Of all parts, those that the binding names must be known; a joint that nobody reports any more is
    /// none.
    #[must_use]
    pub(crate) fn is_still(&self, parts: &Parts, binding: &Binding) -> bool {
        let secs = Duration::from_secs_f64(binding.standstill.secs.clamp(0.0, 10.0));
        let is_since = |still: Option<Instant>, at: Instant| {
            at.elapsed() < FRESH && still.is_some_and(|since| since.elapsed() >= secs)
        };
        let is_joint =
            |joint: &String| self.joints.get(joint).is_some_and(|state| is_since(state.still, state.at));
        let is_base =
            || binding.base.odometry.is_none() || self.base.is_some_and(|base| is_since(base.still, base.at));
        if !parts.all {
            return parts.joints.iter().all(is_joint) && (!parts.drives || is_base());
        }
        let heard = self.joints.iter().filter(|(_, state)| state.at.elapsed() < FRESH);
        let heard: Vec<&String> = heard.map(|(joint, _)| joint).collect();
        !heard.is_empty()
            && heard.into_iter().all(is_joint)
            && binding.joints_that_move().all(is_joint)
            && is_base()
    }

    /// Pose of the base in the frame of the map: by the frames, or by the odometry where they have no map.
    ///
    /// # Errors
    ///
    /// Why nobody knows it.
    pub(crate) fn base(&self, binding: &Binding) -> Result<Planar, String> {
        let names = &binding.frames;
        // The newest pose of the base, with the frames above it at its time, none of which may be silent.
        let newest = self.frames.newest(&names.base);
        let fresh = self.frames.look_up(&names.map, &names.base, None, names.age_secs);
        let told = fresh.and_then(|_| self.frames.look_up(&names.map, &names.base, newest, names.age_secs));
        match (told, self.base) {
            (Ok(transform), _) if newest.is_some() => Ok(transform.planar()),
            (_, Some(base)) if binding.base.localization.is_none() && base.at.elapsed() < FRESH => {
                Ok(base.pose)
            }
            (Err(why), _) => Err(why),
            (Ok(_), _) => Err(format!("no transform of `{}` yet", names.base)),
        }
    }
}

/// Since when something is slow. A gap in the reports begins anew.
fn still_since(is_slow: bool, before: Option<(Option<Instant>, Instant)>, now: Instant) -> Option<Instant> {
    if !is_slow {
        return None;
    }
    let before = before.filter(|(_, at)| now.saturating_duration_since(*at) < FRESH);
    before.and_then(|(still, _)| still).or(Some(now))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cdr::{decode, encode};
    use crate::layout::{Distribution, Layouts};
    use serde_json::json;

    fn heard(body: &mut Body, speed: Option<f64>, position: f64, now: Instant) {
        let layouts = Layouts::of(Distribution::Jazzy, None).unwrap();
        let speeds: Vec<f64> = speed.into_iter().collect();
        let value = json!({"name": ["a"], "position": [position], "velocity": speeds});
        let bytes = encode(&layouts, "sensor_msgs/JointState", &value).unwrap();
        let message = decode(&layouts, "sensor_msgs/JointState", &bytes).unwrap();
        body.hear_joints(&message, &Standstill::default(), now);
    }

    fn binding() -> Binding {
        Binding::parse("[joints]\ntopic = \"j\"", "own").unwrap()
    }

    #[test]
    fn standstill_takes_time_and_fresh_states() {
        let (mut body, binding, now) = (Body::default(), binding(), Instant::now());
        let of = |joint: &str| Parts { joints: [joint.to_owned()].into(), ..Parts::default() };
        let (parts, all) = (of("a"), Parts { all: true, ..Parts::default() });
        assert!(!body.is_still(&parts, &binding), "nothing is known");
        let ago = |millis| now.checked_sub(Duration::from_millis(millis)).unwrap();
        heard(&mut body, Some(0.5), 1.0, ago(400));
        heard(&mut body, Some(0.0), 1.0, ago(100));
        assert!(!body.is_still(&parts, &binding), "slow for 0.1 s only");
        heard(&mut body, Some(0.5), 1.0, ago(400));
        heard(&mut body, Some(0.0), 1.0, ago(300));
        heard(&mut body, Some(0.0), 1.0, now);
        assert!(body.is_still(&parts, &binding) && body.is_still(&all, &binding));
        assert!(!body.is_still(&of("b"), &binding), "a joint that nobody reports");
        let arm = "[joints]\ntopic = \"j\"\n[[controllers]]\naction = \"arm\"\njoints = [\"a\", \"b\"]";
        assert!(
            !body.is_still(&all, &Binding::parse(arm, "own").unwrap()),
            "a joint that moves and is silent"
        );
        body.joints
            .insert("old".to_owned(), JointState { position: 0.0, speed: 1.0, at: ago(900), still: None });
        assert!(body.is_still(&all, &binding), "nobody reports the joint any more");
        assert_eq!(body.positions().len(), 1);
    }

    #[test]
    fn state_that_comes_late_is_old_however_steadily_it_comes() {
        let layouts = Layouts::of(Distribution::Jazzy, None).unwrap();
        let (mut body, now) = (Body::default(), Instant::now());
        let message = |name: &str, value: &serde_json::Value| {
            decode(&layouts, name, &encode(&layouts, name, value).unwrap()).unwrap()
        };
        let joints = |sec: i32| {
            let value = json!({"header": {"stamp": {"sec": sec}}, "name": ["a"], "position": [1.0],
                "velocity": [0.0]});
            message("sensor_msgs/JointState", &value)
        };
        let transform = |sec: i32| {
            let value = json!({"transforms": [{"header": {"frame_id": "map", "stamp": {"sec": sec}},
                "child_frame_id": "base_footprint", "transform": {"rotation": {"w": 1.0}}}]});
            message("tf2_msgs/TFMessage", &value)
        };
        let binding = binding();
        body.hear_joints(&joints(2_000_000_000), &binding.standstill, now);
        body.hear_frames(&transform(1_999_999_998), false, now);
        assert!(body.base(&binding).unwrap_err().contains("`base_footprint` is 2.0"));
        body.hear_frames(&transform(2_000_000_001), false, now);
        assert!(body.base(&binding).is_ok(), "a localisation writes its stamps ahead");
        let later = now.checked_add(Duration::from_secs(2)).unwrap();
        body.hear_joints(&joints(2_000_000_000), &binding.standstill, later);
        assert_eq!(body.joints["a"].at, now, "as old as it was before");
    }

    #[test]
    fn speeds_follow_from_positions() {
        let (mut body, now) = (Body::default(), Instant::now());
        let ago = |millis| now.checked_sub(Duration::from_millis(millis)).unwrap();
        heard(&mut body, None, 1.0, ago(400));
        heard(&mut body, None, 1.2, ago(200));
        let all = Parts { all: true, ..Parts::default() };
        assert!(body.fastest(&all).unwrap().1 > 0.9);
        assert!(!body.is_still(&all, &binding()));
    }
}
