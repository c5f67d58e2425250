//! MuJoCo model of a robot in a scene: the physics of what the planning scene checks, in the same shapes.
//!
//! The model has no meshes and refers to no files. The bodies of entities are named by their ids, the links
//! of the robot `robot/LINK`; [`write`] gives the other names.

mod element;
mod geom;
mod robot;
mod room;

use motet_robots::card::{Drive, Robot};
use motet_robots::scene::{self, EntityShape, Scene};
use motet_robots::urdf::Urdf;
use smol_str::SmolStr;

use self::element::{DEEPEST, XmlText, name, number, numbers};
use self::robot::RobotLayout;
use crate::planning::{RobotModel, SceneState};

/// Reason for which there is no model.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum MjcfError {
    /// A link whose mesh no solid encloses.
    LinkMesh(SmolStr),
    /// An entity whose shape is a mesh.
    EntityMesh(SmolStr),
    /// More links in one chain than the XML reader of MuJoCo accepts.
    LongChain(usize),
}

impl std::fmt::Display for MjcfError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::LinkMesh(link) => {
                write!(
                    f,
                    "the shape of the robot's link `{}` is a mesh, which is not read",
                    link.escape_debug()
                )
            }
            Self::EntityMesh(id) => {
                write!(f, "the shape of `{}` is a mesh, which is not read", id.escape_debug())
            }
            Self::LongChain(links) => {
                write!(f, "the robot has a chain of {links} links, and MuJoCo reads at most {DEEPEST}")
            }
        }
    }
}

impl std::error::Error for MjcfError {}

/// Classes of bodies that may touch each other, as bits of `contype` and `conaffinity`. A robot does not
/// touch itself: its paths are certified.
pub(super) mod touch {
    /// Links of the robot.
    pub(crate) const ROBOT: u32 = 1;
    /// Things that move freely.
    pub(crate) const THING: u32 = 2;
    /// Floor, on which the robot's base and legs do not stand: its base slides.
    pub(crate) const FLOOR: u32 = 4;
    /// Doors and drawers, which slide within furniture.
    pub(crate) const DOOR: u32 = 8;
    /// Furniture and people.
    pub(crate) const FIXED: u32 = 16;
}

/// Step of the simulation in s.
const STEP_SECS: f64 = 0.002;
/// Writes the MuJoCo model (MJCF) of a robot in a scene.
///
/// | name | meaning |
/// |---|---|
/// | body `ID` | an entity |
/// | body `ID/door` | its drawer or door, with the joint `ID/travel` and the geom `ID/handle` |
/// | bodies `robot`, `robot/LINK` | the robot; its base moves by `base/x`, `base/y` and `base/yaw` |
/// | joints and actuators `robot/JOINT` | a degree of freedom of the robot, held by position control |
/// | geoms `hand/N` | the parts of the hand |
/// | site `robot/hand` | the tip of the hand: z points along the fingers, y along their closing |
/// | camera `NAME` | a camera of the card |
/// | keys `start`, `posture/NAME` | the scene at its start, and with the robot in a posture |
/// | numbers `hand/JOINT` | open and closed position of a joint of the hand |
/// | numbers `speed/JOINT` | greatest speed of a joint; `speed/base` has that of the base and of its turns |
/// | number `card` | radius of the base, reach, payload and opening of the first hand |
/// | numbers `sight/CAMERA` | range in m and angle of view in rad of a camera |
/// | texts `robot`, `drive`, `scene` | name and drive of the robot, and the scene in its JSON format |
///
/// In ids and names, `/`, `%` and control characters are written as in a URL. The robot's weight is
/// compensated, and its links have the density of their shapes. O(parts + entities).
///
/// # Errors
///
/// The shape of a link or an entity is a mesh that is not read, or a chain of links is too long.
///
/// ```
/// use motet_geometry::mjcf;
/// use motet_geometry::planning::RobotModel;
/// use motet_robots::builtin::{self, RobotWithBody};
///
/// let RobotWithBody { robot, urdf } = builtin::robot("hsr").unwrap();
/// let scene = builtin::scene("kitchen").unwrap();
/// let model = mjcf::write(&RobotModel::new(&robot, &urdf), &urdf, &scene).unwrap();
/// assert!(model.contains("<body name=\"mug_1\""));
/// ```
pub fn write(model: &RobotModel, urdf: &Urdf, scene: &Scene) -> Result<String, MjcfError> {
    if let Some(link) = model.body().uncovered_links().first() {
        return Err(MjcfError::LinkMesh(model.tree().links().get(*link).cloned().unwrap_or_default()));
    }
    let is_mesh = |shape: &Option<EntityShape>| matches!(shape, Some(EntityShape::Mesh { .. }));
    if let Some(entity) = scene.entities.values().find(|entity| is_mesh(&entity.shape)) {
        return Err(MjcfError::EntityMesh(entity.id.clone()));
    }
    let state = SceneState::new(model, scene);
    let card = model.card();
    let mut xml = XmlText::default();
    xml.open("mujoco", &[("model", card.name.to_string())]);
    header(&mut xml, card, scene);
    xml.open("worldbody", &[]);
    xml.leaf(
        "light",
        &[("directional", "true".into()), ("pos", "0 0 4".into()), ("dir", "0.3 0.2 -1".into())],
    );
    xml.leaf(
        "geom",
        &[
            ("name", "floor".into()),
            ("type", "plane".into()),
            ("size", "0 0 0.05".into()),
            ("class", "floor".into()),
        ],
    );
    let layout = robot::body(&mut xml, model, urdf, scene.robot.base);
    if xml.deepest > DEEPEST {
        return Err(MjcfError::LongChain(xml.deepest));
    }
    let room = room::bodies(&mut xml, model, scene, &state);
    xml.close();
    layout.actuators(&mut xml, model, urdf);
    xml.open("equality", &[]);
    layout.couplings(&mut xml);
    room.locks(&mut xml);
    xml.close();
    xml.open("contact", &[]);
    room.exclusions(&mut xml);
    xml.close();
    keys(&mut xml, model, &layout, &room.positions, &state);
    Ok(xml.finish())
}

/// Options, defaults and what the model says in words and numbers.
fn header(xml: &mut XmlText, card: &Robot, scene: &Scene) {
    xml.leaf("compiler", &[("angle", "radian".into()), ("autolimits", "true".into())]);
    xml.open(
        "option",
        &[
            ("timestep", number(STEP_SECS)),
            ("integrator", "implicitfast".into()),
            ("cone", "elliptic".into()),
            ("impratio", "10".into()),
            // Soft contacts creep under the force of a hand.
            ("noslip_iterations", "8".into()),
        ],
    );
    // Things at rest cost nothing until something touches them.
    xml.leaf("flag", &[("sleep", "enable".into())]);
    xml.close();
    // Without these, near and far are shares of the size of the scene.
    xml.leaf("statistic", &[("extent", "1".into()), ("center", "0 0 1".into())]);
    xml.open("visual", &[]);
    xml.leaf("global", &[("offwidth", number(robot::PICTURE[0])), ("offheight", number(robot::PICTURE[1]))]);
    xml.leaf("map", &[("znear", "0.02".into()), ("zfar", "30".into())]);
    xml.leaf("headlight", &[("ambient", "0.35 0.35 0.35".into()), ("diffuse", "0.45 0.45 0.45".into())]);
    xml.close();
    defaults(xml);
    xml.open("custom", &[]);
    let BaseNumbers { drive, speeds } = BaseNumbers::of(card);
    xml.leaf("numeric", &[("name", "speed/base".into()), ("data", numbers(speeds))]);
    let hand = card.hands.values().next();
    let hand = hand.map_or([0.0; 3], |hand| [hand.reach_m, hand.payload_kg, hand.opening_m]);
    let card_numbers = numbers([card.base.radius_m].into_iter().chain(hand));
    xml.leaf("numeric", &[("name", "card".into()), ("data", card_numbers)]);
    for (called, camera) in &card.cameras {
        let sight = numbers([camera.range_m, camera.view_rad]);
        xml.leaf("numeric", &[("name", format!("sight/{}", name(called))), ("data", sight)]);
    }
    xml.leaf("text", &[("name", "robot".into()), ("data", card.name.to_string())]);
    xml.leaf("text", &[("name", "drive".into()), ("data", drive.into())]);
    xml.leaf("text", &[("name", "scene".into()), ("data", scene::write(scene))]);
    xml.close();
}

/// Drive of a base as the card calls it, and its greatest speeds in m/s and rad/s.
struct BaseNumbers {
    drive: &'static str,
    speeds: [f64; 2],
}

impl BaseNumbers {
    fn of(card: &Robot) -> Self {
        let drive = match card.base.drive {
            Drive::Fixed => "fixed",
            Drive::Omnidirectional => "omnidirectional",
            Drive::Differential => "differential",
            Drive::Legged => "legged",
        };
        Self { drive, speeds: [card.base.speed_m_per_s, card.base.turn_rad_per_s] }
    }
}

/// Default classes: friction 1 for all, and which classes touch each other.
fn defaults(xml: &mut XmlText) {
    use touch::{DOOR, FIXED, FLOOR, ROBOT, THING};
    let class = |xml: &mut XmlText, name: &str, own: u32, others: u32, more: &[(&str, String)]| {
        xml.open("default", &[("class", name.into())]);
        let mut attributes = vec![("contype", own.to_string()), ("conaffinity", others.to_string())];
        attributes.extend(more.iter().cloned());
        xml.leaf("geom", &attributes);
        xml.close();
    };
    let density = |value: f64| ("density", number(value));
    xml.open("default", &[]);
    xml.leaf("geom", &[("condim", "4".into()), ("friction", "1 0.005 0.0005".into())]);
    let things = THING | DOOR | FIXED;
    let grey = |value: &str| ("rgba", format!("{value} {value} {value} 1"));
    class(xml, "robot", ROBOT, things, &[density(robot::DENSITY), grey("0.8"), ("group", "2".into())]);
    let arm = [density(robot::DENSITY), grey("0.7"), ("group", "2".into())];
    class(xml, "arm", ROBOT, things | FLOOR, &arm);
    // Fingers are stiff: at MuJoCo's default the force of a hand would press them centimetres into a light
    // thing.
    let hand = [
        density(robot::DENSITY),
        grey("0.3"),
        ("group", "2".into()),
        ("friction", "1 0.01 0.001".into()),
        ("condim", "6".into()),
        ("priority", "1".into()),
        ("solref", "0.004 1".into()),
        ("solimp", "0.95 0.99 0.001".into()),
    ];
    class(xml, "hand", ROBOT, things | FLOOR, &hand);
    // Round things roll a little, and come to rest.
    class(xml, "thing", THING, things | FLOOR | ROBOT, &[("condim", "6".into())]);
    class(xml, "door", DOOR, ROBOT | THING, &[density(room::DOOR_DENSITY)]);
    class(xml, "fixed", FIXED, ROBOT | THING, &[]);
    class(xml, "floor", FLOOR, THING, &[grey("0.6")]);
    class(xml, "shown", 0, 0, &[density(0.0)]);
    xml.close();
}

/// Keys: the start, and the start in each posture.
fn keys(xml: &mut XmlText, model: &RobotModel, layout: &RobotLayout, room: &[f64], state: &SceneState) {
    xml.open("keyframe", &[]);
    let mut key = |called: String, joints: &[f64]| {
        let base = state.robot.base;
        let positions = layout.positions(base, joints);
        let positions = positions.into_iter().chain(room.iter().copied());
        let controls = layout.controls(base, joints);
        xml.leaf("key", &[("name", called), ("qpos", numbers(positions)), ("ctrl", numbers(controls))]);
    };
    key("start".into(), &state.robot.joints);
    for posture in model.card().postures.keys() {
        if let Some(joints) = model.posture(posture, &state.robot.joints) {
            key(format!("posture/{}", name(posture)), &joints);
        }
    }
    xml.close();
}
