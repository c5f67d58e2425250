//! The binding of a robot: a TOML file that says which actions, services and topics carry out its primitives.

mod lines;
mod step;

pub(crate) use step::{Call, CallKind, Direction, Opening, Primitive, Step, StepKind};

use crate::group::MoveGroup;
use crate::layout::{Distribution, Layouts};
use crate::service::Middleware;
use serde::Deserialize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::net::IpAddr;
use std::path::{Component, Path, PathBuf};

/// Greatest size of a binding in bytes.
const MAX_BYTES: u64 = 1024 * 1024;

/// Bindings that come with the program: name and text.
pub(crate) const BUILT_IN: [(&str, &str); 4] = [
    ("hsr", include_str!("../bindings/hsr.toml")),
    ("nav2_arm", include_str!("../bindings/nav2_arm.toml")),
    ("anymal_z1", include_str!("../bindings/anymal_z1.toml")),
    ("tiago", include_str!("../bindings/tiago.toml")),
];

/// Binding of a robot.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Binding {
    /// Robot that it is for, as the command line names it.
    #[serde(default)]
    pub(crate) robot: Option<String>,
    #[serde(default)]
    pub(crate) ros: Ros,
    #[serde(default)]
    pub(crate) frames: FrameNames,
    pub(crate) joints: Joints,
    #[serde(default)]
    pub(crate) base: Base,
    #[serde(default)]
    pub(crate) standstill: Standstill,
    #[serde(default)]
    pub(crate) start: StartTolerance,
    #[serde(default)]
    pub(crate) controllers: Vec<Controller>,
    #[serde(default)]
    pub(crate) navigation: Option<Navigation>,
    #[serde(default)]
    pub(crate) move_group: Option<MoveGroup>,
    #[serde(default)]
    pub(crate) gripper: Option<Gripper>,
    #[serde(default)]
    pub(crate) primitives: BTreeMap<String, Primitive>,
    #[serde(default)]
    pub(crate) facts: BTreeMap<String, Observation>,
    #[serde(default)]
    pub(crate) measures: BTreeMap<String, Observation>,
    #[serde(default)]
    pub(crate) cameras: Vec<CameraTopics>,
    #[serde(default)]
    pub(crate) detections: Option<DetectionTopic>,
    /// Services and topics that stop the robot at a safe stop, beside the trajectories that stand still.
    #[serde(default)]
    pub(crate) stop: Vec<Call>,
    /// Lines of the steps of each primitive in the file.
    #[serde(skip)]
    pub(crate) lines: BTreeMap<String, Vec<usize>>,
    /// Folder of the file; none of a built-in binding.
    #[serde(skip)]
    folder: Option<PathBuf>,
}

/// How the robot's nodes are reached.
#[derive(Clone, PartialEq, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct Ros {
    pub(crate) distribution: Distribution,
    pub(crate) middleware: Middleware,
    /// `ROS_DOMAIN_ID`. The variable of the environment counts where the binding has none.
    pub(crate) domain: Option<u16>,
    /// Addresses of the networks to use; all without one.
    pub(crate) networks: Vec<IpAddr>,
    /// Namespace before names that do not begin with `/`.
    pub(crate) namespace: String,
    /// Seconds to wait for the robot's nodes at the start.
    pub(crate) discovery_secs: Option<f64>,
    /// Folder with further layouts, below that of the binding.
    pub(crate) layouts: Option<PathBuf>,
}

/// Names of frames.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct FrameNames {
    /// Frame of the scene.
    pub(crate) map: String,
    /// Frame of the base on the floor.
    pub(crate) base: String,
    /// Greatest age of a transform in s.
    pub(crate) age_secs: f64,
    /// Topics of the transforms. Robots share them, so the namespace counts only without `/`.
    pub(crate) tf: String,
    pub(crate) tf_static: String,
}

impl Default for FrameNames {
    fn default() -> Self {
        Self {
            map: "map".to_owned(),
            base: "base_footprint".to_owned(),
            age_secs: 0.5,
            tf: "/tf".to_owned(),
            tf_static: "/tf_static".to_owned(),
        }
    }
}

/// States of the joints.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Joints {
    /// Topic of `sensor_msgs/JointState`.
    pub(crate) topic: String,
    /// Joints whose name in ROS differs from that in the URDF of the card: `card = "ros"`.
    #[serde(default)]
    pub(crate) names: BTreeMap<String, String>,
}

/// Pose and speed of the base.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct Base {
    /// Topic of `nav_msgs/Odometry`; a robot without one does not drive.
    pub(crate) odometry: Option<String>,
    /// Topic of `geometry_msgs/PoseWithCovarianceStamped` of the localisation.
    pub(crate) localization: Option<String>,
    /// Number of standard deviations of the localisation that the clearance of a path must have.
    pub(crate) sigmas: f64,
}

impl Default for Base {
    fn default() -> Self {
        Self { odometry: None, localization: None, sigmas: 2.0 }
    }
}

/// When the robot stands still.
#[derive(Clone, Copy, PartialEq, Debug, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct Standstill {
    /// Greatest speed of a joint in rad/s or m/s.
    pub(crate) joints: f64,
    /// Greatest speed of the base in m/s, and of its turning in rad/s.
    pub(crate) base: f64,
    pub(crate) turn: f64,
    /// Seconds for which all speeds are below.
    pub(crate) secs: f64,
}

impl Default for Standstill {
    fn default() -> Self {
        Self { joints: 0.02, base: 0.01, turn: 0.02, secs: 0.2 }
    }
}

/// Distances from the start of a path up to which the robot may follow it.
#[derive(Clone, Copy, PartialEq, Debug, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct StartTolerance {
    /// Distance of the base in m.
    pub(crate) base: f64,
    /// Turn of the base in rad.
    pub(crate) turn: f64,
    /// Difference of a joint in rad or m.
    pub(crate) joints: f64,
}

impl Default for StartTolerance {
    fn default() -> Self {
        Self { base: 0.03, turn: 0.05, joints: 0.05 }
    }
}

/// Controller that follows trajectories.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Controller {
    /// Action of `control_msgs/FollowJointTrajectory`.
    pub(crate) action: String,
    /// Its joints as ROS names them.
    #[serde(default)]
    pub(crate) joints: Vec<String>,
    /// Names of its axes x, y and yaw, if it drives the base.
    #[serde(default)]
    pub(crate) base: Vec<String>,
    /// Frame of these axes.
    #[serde(default = "odom")]
    pub(crate) frame: String,
    /// Seconds that a trajectory may take longer than it says.
    #[serde(default = "late")]
    pub(crate) late_secs: f64,
}

fn odom() -> String {
    "odom".to_owned()
}

const fn late() -> f64 {
    10.0
}

/// Navigation of the base.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Navigation {
    /// Action of `nav2_msgs/NavigateToPose`.
    pub(crate) action: String,
    #[serde(default)]
    pub(crate) behavior_tree: String,
    /// Topic that a stop sends zero speeds to.
    #[serde(default)]
    pub(crate) stop: Option<String>,
    /// `geometry_msgs/Twist` or `geometry_msgs/TwistStamped`.
    #[serde(default = "twist")]
    pub(crate) stop_type: String,
}

fn twist() -> String {
    "geometry_msgs/Twist".to_owned()
}

/// The hand. `{width}` in a message stands for the opening in m times `scale` plus `offset`.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Gripper {
    pub(crate) action: String,
    #[serde(rename = "type")]
    pub(crate) type_name: String,
    pub(crate) open: Value,
    pub(crate) close: Value,
    /// Goal for the opening that a grasp asks for; `open` without one.
    #[serde(default)]
    pub(crate) width: Option<Value>,
    #[serde(default = "one")]
    pub(crate) scale: f64,
    #[serde(default)]
    pub(crate) offset: f64,
    #[serde(default = "late")]
    pub(crate) timeout_secs: f64,
    /// Joints of the hand by their names in ROS. Without them an interrupted goal of the hand waits for the
    /// whole robot to stand still.
    #[serde(default)]
    pub(crate) joints: Vec<String>,
}

const fn one() -> f64 {
    1.0
}

/// Fact or measure from the messages of a topic.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Observation {
    pub(crate) topic: String,
    #[serde(rename = "type")]
    pub(crate) type_name: String,
    /// Expression over the fields of the message, `args` and `joints`.
    pub(crate) value: String,
    /// Greatest age of the message in s.
    #[serde(default = "one")]
    pub(crate) age_secs: f64,
}

/// Topics of a camera.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CameraTopics {
    pub(crate) name: String,
    pub(crate) image: String,
    #[serde(default)]
    pub(crate) depth: Option<String>,
    pub(crate) info: String,
}

impl CameraTopics {
    /// Type of the pictures: those of `image_transport` are compressed if the name of the topic says so.
    #[must_use]
    pub(crate) fn image_type(&self) -> &'static str {
        if self.image.ends_with("/compressed") { "sensor_msgs/CompressedImage" } else { "sensor_msgs/Image" }
    }
}

/// Topic of `vision_msgs/Detection3DArray`, or of `Detection2DArray` for the pictures of a camera.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DetectionTopic {
    pub(crate) topic: String,
    /// Camera with depth in whose pictures the boxes are.
    #[serde(default)]
    pub(crate) camera: Option<String>,
    /// Words for the classes of the detector: `class = "red mug"`.
    #[serde(default)]
    pub(crate) labels: BTreeMap<String, String>,
    /// Seconds that `detect` waits for a detection.
    #[serde(default = "patience")]
    pub(crate) timeout_secs: f64,
}

const fn patience() -> f64 {
    5.0
}

impl Binding {
    /// Reads a binding: a built-in name, or a TOML file.
    ///
    /// # Errors
    ///
    /// Why the file cannot be read, or the place that is wrong.
    pub(crate) fn read(name: &str) -> Result<Self, String> {
        if let Some((_, text)) = BUILT_IN.iter().find(|(own, _)| *own == name) {
            return Self::parse(text, name);
        }
        let path = Path::new(name);
        let size = std::fs::metadata(path).map(|data| data.len()).map_err(|error| {
            let own: Vec<&str> = BUILT_IN.iter().map(|(own, _)| *own).collect();
            format!("cannot read the binding `{name}`: {error}; built in are {}", own.join(", "))
        })?;
        if size > MAX_BYTES {
            return Err(format!("the binding `{name}` has more than {MAX_BYTES} bytes"));
        }
        let text = std::fs::read_to_string(path).map_err(|error| format!("cannot read `{name}`: {error}"))?;
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Ok(Self { folder: Some(folder.to_owned()), ..Self::parse(&text, name)? })
    }

    /// Layouts of its distribution, with those of the folder that it names, and of another folder.
    ///
    /// # Errors
    ///
    /// The folder is none below that of the binding, or what is wrong in a layout.
    pub(crate) fn layouts(&self, more: Option<&Path>) -> Result<Layouts, String> {
        let mut layouts = Layouts::of(self.ros.distribution, self.layouts_folder()?.as_deref())?;
        more.map_or(Ok(()), |folder| layouts.add(folder))?;
        Ok(layouts)
    }

    /// Folder of layouts that the binding names. Who shares a binding shares its layouts with it: it reads
    /// nothing else of the machine.
    fn layouts_folder(&self) -> Result<Option<PathBuf>, String> {
        let Some(own) = &self.ros.layouts else { return Ok(None) };
        let named = own.display();
        let above = self.folder.as_ref().ok_or("a built-in binding has no folder of layouts")?;
        let is_below = own.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
        let real = |path: &Path| path.canonicalize().map_err(|error| format!("`layouts = {named}`: {error}"));
        let folder = real(&above.join(own))?;
        if !is_below || !folder.starts_with(real(above)?) {
            return Err(format!("`layouts = {named}` is no folder below that of the binding"));
        }
        Ok(Some(folder))
    }

    /// Reads the text of a binding.
    ///
    /// # Errors
    ///
    /// The place that is wrong.
    pub(crate) fn parse(text: &str, name: &str) -> Result<Self, String> {
        let table: toml::Value = toml::from_str(text).map_err(|error| format!("{name}: {error}"))?;
        if let Some(place) = not_finite(&table) {
            return Err(format!("{name}: `{place}` is no finite number"));
        }
        let mut binding: Self = toml::from_str(text).map_err(|error| format!("{name}: {error}"))?;
        for (primitive, steps) in &binding.primitives {
            for (at, step) in steps.steps.iter().enumerate() {
                let step = step
                    .step()
                    .map_err(|wrong| format!("{name}: step {} of {primitive}: {wrong}", at + 1))?;
                if matches!(step.kind, StepKind::Gripper(_)) && binding.gripper.is_none() {
                    return Err(format!("{name}: step {} of {primitive} needs a table [gripper]", at + 1));
                }
                if step.kind == StepKind::Detect && binding.detections.is_none() {
                    return Err(format!("{name}: step {} of {primitive} needs a table [detections]", at + 1));
                }
            }
        }
        let boxed = binding.detections.as_ref().and_then(|topic| topic.camera.as_ref());
        let has_depth =
            |name: &String| binding.cameras.iter().any(|one| one.name == *name && one.depth.is_some());
        if let Some(camera) = boxed.filter(|camera| !has_depth(camera)) {
            return Err(format!("{name}: [detections] needs a camera `{camera}` with depth"));
        }
        for controller in &binding.controllers {
            let is_base = controller.base.len() == 3 && controller.joints.is_empty();
            let is_arm = controller.base.is_empty() && !controller.joints.is_empty();
            if !is_base && !is_arm {
                let action = &controller.action;
                return Err(format!(
                    "{name}: the controller `{action}` has either joints or a base of three axes"
                ));
            }
        }
        if binding.move_group.as_ref().is_some_and(|bound| bound.link.is_none() && !bound.grasps.is_empty()) {
            return Err(format!("{name}: the grasps of [move_group] need a `link`"));
        }
        binding.resolve_names();
        binding.lines = lines::of_steps(text);
        Ok(binding)
    }

    /// Puts the namespace before relative names.
    fn resolve_names(&mut self) {
        let namespace = self.ros.namespace.trim_matches('/').to_owned();
        let full = |name: &mut String| {
            if !name.starts_with('/') {
                *name =
                    if namespace.is_empty() { format!("/{name}") } else { format!("/{namespace}/{name}") };
            }
        };
        full(&mut self.joints.topic);
        full(&mut self.frames.tf);
        full(&mut self.frames.tf_static);
        self.base.odometry.iter_mut().for_each(full);
        self.base.localization.iter_mut().for_each(full);
        self.controllers.iter_mut().for_each(|one| full(&mut one.action));
        if let Some(navigation) = &mut self.navigation {
            full(&mut navigation.action);
            navigation.stop.iter_mut().for_each(full);
        }
        self.move_group.iter_mut().for_each(|one| full(&mut one.action));
        self.gripper.iter_mut().for_each(|one| full(&mut one.action));
        for step in self.primitives.values_mut().flat_map(|one| &mut one.steps) {
            step.names().for_each(full);
        }
        self.facts.values_mut().chain(self.measures.values_mut()).for_each(|one| full(&mut one.topic));
        for camera in &mut self.cameras {
            full(&mut camera.image);
            full(&mut camera.info);
            camera.depth.iter_mut().for_each(full);
        }
        self.detections.iter_mut().for_each(|one| full(&mut one.topic));
        self.stop.iter_mut().for_each(|one| full(&mut one.name));
    }

    /// Name of a joint in ROS.
    #[must_use]
    pub(crate) fn ros_joint<'a>(&'a self, joint: &'a str) -> &'a str {
        self.joints.names.get(joint).map_or(joint, String::as_str)
    }

    /// Name of a joint in the card.
    #[must_use]
    pub(crate) fn card_joint<'a>(&'a self, joint: &'a str) -> &'a str {
        self.joints.names.iter().find(|(_, ros)| *ros == joint).map_or(joint, |(card, _)| card)
    }

    /// True if a controller moves a joint, by its name in ROS.
    #[must_use]
    pub(crate) fn controls(&self, joint: &str) -> bool {
        self.controllers.iter().any(|controller| controller.joints.iter().any(|own| own == joint))
    }

    /// Joints by their names in ROS that controllers and the hand move.
    pub(crate) fn joints_that_move(&self) -> impl Iterator<Item = &String> {
        let controlled = self.controllers.iter().flat_map(|controller| &controller.joints);
        controlled.chain(self.gripper.iter().flat_map(|gripper| &gripper.joints))
    }

    /// True if a primitive can be held: what moves it are motions and the hand, which go on from where they
    /// were.
    #[must_use]
    pub(crate) fn holds(&self, primitive: &str) -> bool {
        let is_free = |step: &Step| !matches!(&step.kind, StepKind::Call(call) if call.moves);
        self.steps(primitive).is_some_and(|steps| steps.iter().all(is_free))
    }

    /// Steps of a primitive; `None` if it is not bound.
    #[must_use]
    pub(crate) fn steps(&self, primitive: &str) -> Option<Vec<Step>> {
        let steps = &self.primitives.get(primitive)?.steps;
        steps.iter().map(|step| step.step().ok()).collect()
    }

    /// Domain of DDS.
    #[must_use]
    pub(crate) fn domain(&self) -> u16 {
        let of_environment = || std::env::var("ROS_DOMAIN_ID").ok()?.trim().parse().ok();
        self.ros.domain.or_else(of_environment).unwrap_or(0)
    }
}

/// Place of the first number that is infinite or none.
fn not_finite(value: &toml::Value) -> Option<String> {
    let below = |key: String, value: &toml::Value| {
        not_finite(value).map(|rest| if rest.is_empty() { key.clone() } else { format!("{key}.{rest}") })
    };
    match value {
        toml::Value::Float(number) => (!number.is_finite()).then(String::new),
        toml::Value::Array(values) => {
            values.iter().enumerate().find_map(|(at, value)| below((at + 1).to_string(), value))
        }
        toml::Value::Table(table) => table.iter().find_map(|(key, value)| below(key.clone(), value)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn built_in_bindings_are_whole() {
        for (name, _) in BUILT_IN {
            let binding = Binding::read(name).unwrap();
            assert!(binding.primitives.contains_key("go"), "{name}");
        }
    }

    #[test]
    fn wrong_bindings_name_their_place() {
        let wrong = |text: &str| Binding::parse(text, "own").unwrap_err();
        assert!(wrong("speed = 3").contains("unknown field `speed`"));
        let joints = "[joints]\ntopic = \"joint_states\"\n";
        let steps =
            wrong(&format!("{joints}[primitives.go]\nsteps = [{{ motion = \"there\", wait_secs = 1.0 }}]"));
        assert!(steps.starts_with("own: step 1 of go: a step has exactly one of"), "{steps}");
        let hand = wrong(&format!("{joints}[primitives.pick]\nsteps = [{{ gripper = \"open\" }}]"));
        assert_eq!(hand, "own: step 1 of pick needs a table [gripper]");
        let none = wrong(&format!("{joints}[primitives.say]\nsteps = [{{ wait_secs = nan }}]"));
        assert_eq!(none, "own: `primitives.say.steps.1.wait_secs` is no finite number");
        let arm = wrong(&format!("{joints}[[controllers]]\naction = \"arm\""));
        assert_eq!(arm, "own: the controller `arm` has either joints or a base of three axes");
    }

    #[test]
    fn names_get_the_namespace() {
        let text = "ros = { namespace = \"robot_1\" }\njoints = { topic = \"joint_states\" }\n\
                    base = { odometry = \"/odom\" }";
        let binding = Binding::parse(text, "own").unwrap();
        assert_eq!(binding.joints.topic, "/robot_1/joint_states");
        assert_eq!(binding.base.odometry.as_deref(), Some("/odom"));
    }

    #[test]
    fn transforms_have_the_topics_of_the_binding() {
        let text = "ros = { namespace = \"r1\" }\njoints = { topic = \"joint_states\" }\n\
                    frames = { tf = \"tf\" }";
        let frames = Binding::parse(text, "own").unwrap().frames;
        assert_eq!((frames.tf.as_str(), frames.tf_static.as_str()), ("/r1/tf", "/tf_static"));
    }

    #[test]
    fn layouts_are_in_a_folder_below_that_of_the_binding() {
        let root = std::env::temp_dir().join(format!("motet-ros2-layouts-{}", std::process::id()));
        std::fs::create_dir_all(root.join("own/layouts")).unwrap();
        std::fs::create_dir_all(root.join("other")).unwrap();
        let layout = "MSG my_msgs/Grip\nfloat64 force\n";
        std::fs::write(root.join("own/layouts/my.layouts"), layout).unwrap();
        std::os::unix::fs::symlink(root.join("other"), root.join("own/link")).unwrap();
        let file = root.join("own/robot.toml");
        let layouts = |folder: &str| {
            let text = format!("ros = {{ layouts = \"{folder}\" }}\njoints = {{ topic = \"joint_states\" }}");
            std::fs::write(&file, text).unwrap();
            Binding::read(file.to_str().unwrap()).unwrap().layouts(None)
        };
        assert!(layouts("layouts").unwrap().message("my_msgs/Grip").is_some());
        let other = root.join("other");
        for outside in ["../other", "link", other.to_str().unwrap()] {
            let wrong = layouts(outside).unwrap_err();
            assert!(wrong.ends_with("is no folder below that of the binding"), "{wrong}");
        }
        assert!(layouts("none").unwrap_err().starts_with("`layouts = none`: "));
        std::fs::remove_dir_all(&root).unwrap();
        let built_in = "ros = { layouts = \"layouts\" }\njoints = { topic = \"joint_states\" }";
        let wrong = Binding::parse(built_in, "own").unwrap().layouts(None).unwrap_err();
        assert_eq!(wrong, "a built-in binding has no folder of layouts");
    }

    #[test]
    fn steps_know_their_lines() {
        let text = "joints = { topic = \"j\" }\n[primitives.go]\nsteps = [{ wait_secs = 1.0 }]\n\
                    [primitives.say]\nsteps = [\n    { wait_secs = 1.0 },\n    { wait_secs = 2.0 },\n]\n";
        let lines = Binding::parse(text, "own").unwrap().lines;
        assert_eq!((lines["go"].as_slice(), lines["say"].as_slice()), (&[3][..], &[6, 7][..]));
    }
}
