//! JSON form of a scene. These types give its reader and its schema; [`super::read`] makes the model of them.

use indexmap::IndexMap;
use motet_syntax::json::{Fallible, Spanned};
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};
use smol_str::SmolStr;

/// JSON Schema of a scene.
#[must_use]
pub fn schema() -> schemars::Schema {
    schemars::schema_for!(Document)
}

/// Three numbers with their span.
pub(super) type Point = Spanned<[f64; 3]>;

/// A Motet scene: the room, its entities, and the robot at the start. Lengths in metres, angles in radians,
/// masses in kilograms, z up.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Motet scene", rename = "Scene")]
pub(super) struct Document {
    /// Version of the format: 1.
    #[schemars(extend("const" = 1))]
    pub(super) motet_scene: Spanned<u32>,
    /// The frame of all poses: `map`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("const" = "map"))]
    pub(super) frame: Option<Spanned<SmolStr>>,
    /// Distances from obstacles that motions keep in this room, in place of those of the robot's card.
    #[serde(default = "absent::<Clearance>", skip_serializing_if = "is_absent")]
    pub(super) clearance: Fallible<Clearance>,
    /// The robot at the start.
    #[serde(default = "absent::<Robot>", skip_serializing_if = "is_absent")]
    pub(super) robot: Fallible<Robot>,
    /// Things, places and people.
    #[serde(default)]
    pub(super) entities: Vec<Fallible<Spanned<Entity>>>,
    /// Images of cameras in the room.
    #[serde(default)]
    pub(super) views: Vec<Fallible<View>>,
}

/// Distances from obstacles in m, from 0 to 0.5.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Clearance {
    /// Distance of every part that the arm does not move.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) base: Option<Spanned<f64>>,
    /// Distance of the arm, the hand and the held object.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) arm: Option<Spanned<f64>>,
}

/// The robot at the start.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Robot {
    /// Position in m and heading in rad.
    #[serde(default = "absent::<Point>", skip_serializing_if = "is_absent")]
    pub(super) base: Fallible<Point>,
    /// Joint values by name, in m or rad.
    #[serde(default)]
    pub(super) joints: IndexMap<SmolStr, Spanned<f64>>,
    /// Held entity: `null` for an empty hand; without the key nothing is known.
    #[serde(default, deserialize_with = "present", skip_serializing_if = "Option::is_none")]
    pub(super) holding: Option<Option<Spanned<SmolStr>>>,
    /// The pose of the held entity in the frame of the hand's tip; without it a grasp that holds it upright.
    #[serde(default = "absent::<Pose>", skip_serializing_if = "is_absent")]
    pub(super) grip: Fallible<Pose>,
    /// Entity at which the robot is within its working area.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) at: Option<Spanned<SmolStr>>,
}

/// Entry of a state beside a scene: the truth value of a fact, `null` for unknown; or of `grip(THING)` the
/// pose of the held thing in the frame of the hand's tip.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected `true`, `false`, `null` or the pose of a grip")]
pub enum StateEntry {
    Truth(Option<bool>),
    Grip {
        /// Position in m.
        xyz: [f64; 3],
        /// Roll, pitch, yaw in rad, about the fixed axes x, y, z in that order.
        #[serde(default)]
        rpy: [f64; 3],
    },
}

/// Distinguishes a key that is `null` from a missing one.
fn present<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Option<Spanned<SmolStr>>>, D::Error> {
    Deserialize::deserialize(deserializer).map(Some)
}

fn absent<T>() -> Fallible<T> {
    Fallible(None)
}

fn is_absent<T>(value: &Fallible<T>) -> bool {
    value.0.is_none()
}

/// A thing, surface, container, place or person.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Entity {
    /// Its id, unique in the scene.
    pub(super) id: Spanned<SmolStr>,
    /// The name of its kind: `Object`, `Surface`, `Container`, `Place`, `Zone`, `Person`, or one that a
    /// robot declares.
    pub(super) kind: Spanned<SmolStr>,
    /// Class, such as `mug`.
    #[serde(default)]
    pub(super) class: SmolStr,
    /// Other names, such as `red mug`.
    #[serde(default)]
    pub(super) names: Vec<SmolStr>,
    /// Categories, such as `drinkware`.
    #[serde(default)]
    pub(super) categories: Vec<SmolStr>,
    /// The pose of its shape's centre, of the feet for a `Person`, a `Place` and a `Zone`; of what opens, the
    /// pose when closed.
    #[serde(default = "absent::<Pose>", skip_serializing_if = "is_absent")]
    pub(super) pose: Fallible<Pose>,
    /// Shape about its pose; of a `Zone`, its extent on the floor: a box or a cylinder of any height.
    #[serde(default = "absent::<Shape>", skip_serializing_if = "is_absent")]
    pub(super) shape: Fallible<Shape>,
    /// Its mass in kg.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) mass: Option<Spanned<f64>>,
    /// The width in m that a hand has to span; without it the smallest horizontal extent of the shape counts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) width: Option<Spanned<f64>>,
    /// True if it never moves.
    #[serde(default)]
    pub(super) fixed: bool,
    /// Entity at which the robot is within its working area.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) on: Option<Spanned<SmolStr>>,
    /// The container that it is in.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) r#in: Option<Spanned<SmolStr>>,
    /// Visibility to the camera of the robot at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) visible: Option<Spanned<bool>>,
    /// Open (true) or closed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) open: Option<bool>,
    /// Locked (true) or not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) locked: Option<bool>,
    /// Motion of its drawer or door; a container without one is always open.
    #[serde(default = "absent::<Travel>", skip_serializing_if = "is_absent")]
    pub(super) travel: Fallible<Travel>,
    /// Other numbers that its kind declares, in SI units.
    #[serde(default)]
    pub(super) fields: IndexMap<SmolStr, Spanned<f64>>,
}

/// A pose in the frame `map`, or in that of the key.
#[derive(Clone, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Pose {
    /// Position in m.
    pub(super) xyz: Point,
    /// Roll, pitch, yaw in rad, about the fixed axes x, y, z in that order.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) rpy: Option<Point>,
}

/// A shape about its own centre.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum Shape {
    /// Full extents along x, y, z in m.
    Box(Point),
    /// Cylinder along z.
    Cylinder(Rod),
    /// Sphere with its radius.
    Sphere(Ball),
    /// Along z; `height` without the caps.
    Capsule(Rod),
    /// Triangles in a file.
    Mesh(Mesh),
}

/// A round shape along z.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Rod {
    /// Radius in m.
    pub(super) radius: Spanned<f64>,
    /// Height in m.
    pub(super) height: Spanned<f64>,
}

/// Sphere with its radius.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Ball {
    /// Radius in m.
    pub(super) radius: Spanned<f64>,
}

/// Triangles in a file.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Mesh {
    /// The file's name.
    pub(super) file: String,
    /// Scale along x, y, z; 1 where it is missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) scale: Option<Point>,
}

/// Motion of the drawer or door of a container.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum Travel {
    /// Drawer that slides out.
    Slide(Slide),
    /// A door or a lid.
    Hinge(Hinge),
}

/// Motion of a drawer.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Slide {
    /// Direction of opening in the entity's frame.
    pub(super) axis: Point,
    /// Distance, in m.
    pub(super) distance: Spanned<f64>,
}

/// Motion of a door.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Hinge {
    /// Axis in the entity's frame; it opens counter-clockwise about it.
    pub(super) axis: Point,
    /// A point of the axis in the entity's frame, in m.
    pub(super) at: Point,
    /// Angle, in rad, at most a full turn.
    pub(super) angle: Spanned<f64>,
}

/// Images of a camera in the room.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct View {
    /// Name of the camera.
    pub(super) camera: SmolStr,
    /// The image's file.
    pub(super) image: String,
    /// The depth image's file: 16-bit PNG in mm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) depth: Option<String>,
    /// The camera's pose in the frame `map`.
    #[serde(default = "absent::<Pose>", skip_serializing_if = "is_absent")]
    pub(super) pose: Fallible<Pose>,
    /// Focal lengths and centre, in pixels.
    #[serde(default = "absent::<Intrinsics>", skip_serializing_if = "is_absent")]
    pub(super) intrinsics: Fallible<Intrinsics>,
}

/// Focal lengths and centre of a pinhole camera, in pixels.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct Intrinsics {
    /// Focal length along the rows.
    pub(super) fx: Spanned<f64>,
    /// Focal length along the columns.
    pub(super) fy: Spanned<f64>,
    /// Centre along the rows.
    pub(super) cx: Spanned<f64>,
    /// Centre along the columns.
    pub(super) cy: Spanned<f64>,
}
