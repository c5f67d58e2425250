//! Robots and scenes that are embedded in this crate, under `models/` and `scenes/`.
//!
//! [`ROBOTS`] and [`SCENES`] are their texts, as a host lists or copies them; [`robot`] and [`scene`] read
//! them. Robots and
//! scenes from a user's folder come from the host, which owns the files: `motet-project` opens both.
//!
//! ```
//! use motet_robots::builtin;
//!
//! let hsr = builtin::robot("hsr").unwrap();
//! assert_eq!(hsr.robot.title, "Toyota HSR");
//! assert!(hsr.urdf.link("hand_palm_link").is_some());
//! let kitchen = builtin::scene("kitchen").unwrap();
//! assert_eq!(kitchen.matches("the red mug")[0].id, "mug_1");
//! ```

use motet_syntax::{FileId, Source};

use crate::card::Robot;
use crate::scene::Scene;
use crate::urdf::Urdf;
use crate::{card, scene, urdf};

/// Texts of a built-in robot.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct BuiltinRobot {
    /// Name on the command line and in policies, such as `hsr`.
    pub name: &'static str,
    /// Text of `robot.toml`.
    pub card: &'static str,
    /// Text of `primitives.motet`; `None` where the robot has the standard primitives only.
    pub declarations: Option<&'static str>,
    /// Text of `robot.urdf`.
    pub urdf: &'static str,
}

/// Text of a built-in scene.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct BuiltinScene {
    /// Name on the command line, such as `kitchen`.
    pub name: &'static str,
    /// JSON text of the scene.
    pub json: &'static str,
}

/// A robot card together with the body that it describes.
#[derive(Clone, PartialEq, Debug)]
pub struct RobotWithBody {
    /// Robot as its card describes it.
    pub robot: Robot,
    /// The URDF after reading. The built-in robots have neither meshes nor an SRDF: their shapes are boxes,
    /// cylinders and capsules.
    pub urdf: Urdf,
}

/// Robots that come with the crate.
pub const ROBOTS: [BuiltinRobot; 3] = [
    BuiltinRobot {
        name: "hsr",
        card: include_str!("../models/hsr/robot.toml"),
        declarations: None,
        urdf: include_str!("../models/hsr/robot.urdf"),
    },
    BuiltinRobot {
        name: "anymal_z1",
        card: include_str!("../models/anymal_z1/robot.toml"),
        declarations: Some(include_str!("../models/anymal_z1/primitives.motet")),
        urdf: include_str!("../models/anymal_z1/robot.urdf"),
    },
    BuiltinRobot {
        name: "panda",
        card: include_str!("../models/panda/robot.toml"),
        declarations: Some(include_str!("../models/panda/primitives.motet")),
        urdf: include_str!("../models/panda/robot.urdf"),
    },
];

/// Scenes that come with the crate.
pub const SCENES: [BuiltinScene; 3] = [
    BuiltinScene { name: "kitchen", json: include_str!("../scenes/kitchen.json") },
    BuiltinScene { name: "living_room", json: include_str!("../scenes/living_room.json") },
    BuiltinScene { name: "lab", json: include_str!("../scenes/lab.json") },
];

/// Reads a built-in robot with its body. `None` if no built-in robot has this name. O(bytes).
#[must_use]
pub fn robot(name: &str) -> Option<RobotWithBody> {
    let texts = robot_texts(name)?;
    Some(RobotWithBody { robot: texts.card()?, urdf: texts.urdf()? })
}

/// Reads a built-in scene. `None` if no built-in scene has this name. O(bytes).
#[must_use]
pub fn scene(name: &str) -> Option<Scene> {
    let BuiltinScene { name, json } = scene_text(name)?;
    scene::read(&Source::new(format!("{name}.json"), json), FileId(0)).0
}

/// Finds the texts of a built-in robot by its name.
#[must_use]
pub fn robot_texts(name: &str) -> Option<BuiltinRobot> {
    ROBOTS.into_iter().find(|robot| robot.name == name)
}

/// Finds the text of a built-in scene by its name.
#[must_use]
pub fn scene_text(name: &str) -> Option<BuiltinScene> {
    SCENES.into_iter().find(|scene| scene.name == name)
}

impl BuiltinRobot {
    /// Reads the card. `None` if it has an error, which the tests of this crate exclude.
    #[must_use]
    pub fn card(&self) -> Option<Robot> {
        let source = Source::new(format!("{}/robot.toml", self.name), self.card);
        card::read(&source, FileId(0), self.declarations).0
    }

    /// Reads the URDF. `None` if it has an error, which the tests of this crate exclude.
    #[must_use]
    pub fn urdf(&self) -> Option<Urdf> {
        urdf::read(&Source::new(format!("{}/robot.urdf", self.name), self.urdf), FileId(0)).0
    }
}
