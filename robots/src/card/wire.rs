//! TOML form of a `robot.toml`. Only [`super::read`] makes a [`super::Robot`] of it.
//!
//! A quantity is a number in the SI unit that its key names, or a text with a unit: `0.2` or `"20 cm"`.

use std::borrow::Cow;

use indexmap::IndexMap;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

/// JSON Schema of a `robot.toml`, as the JSON of the same shape.
#[must_use]
pub fn schema() -> Schema {
    schemars::schema_for!(CardTable)
}

/// Value with its span in the document.
#[derive(Clone, Debug, Deserialize)]
#[serde(transparent)]
pub struct TomlSpanned<T>(pub toml::Spanned<T>);

impl<T> TomlSpanned<T> {
    /// Value without the span.
    pub fn get(&self) -> &T {
        self.0.get_ref()
    }
}

impl<T: JsonSchema> JsonSchema for TomlSpanned<T> {
    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }
    fn schema_id() -> Cow<'static, str> {
        T::schema_id()
    }
    fn inline_schema() -> bool {
        T::inline_schema()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}

/// A number in SI units, or a text with a unit such as `"20 cm"`.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(untagged)]
#[schemars(rename = "Quantity")]
pub enum WrittenQuantity {
    /// In SI units.
    Number(f64),
    /// With a unit.
    Text(String),
}

/// A robot card.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Card")]
pub struct CardTable {
    /// The robot's id in policies and on the command line, `hsr`.
    pub name: TomlSpanned<String>,
    /// Title for people.
    pub title: TomlSpanned<String>,
    /// The longest time that one observation takes, in s.
    pub observe_within: TomlSpanned<WrittenQuantity>,
    /// What `slowly` and `gently` mean for it.
    #[serde(default)]
    pub manners: MannersTable,
    /// Clearance that its motions keep from obstacles.
    #[serde(default)]
    pub clearance: ClearanceTable,
    /// Greatest errors of its motions, from which the clearance follows where none is given.
    #[serde(default)]
    pub errors: ErrorsTable,
    /// Fluents and measures that it can observe.
    pub observes: Vec<TomlSpanned<String>>,
    /// Facts that hold at the start unless a state says otherwise, as text conditions: `not standing(robot)`.
    #[serde(default)]
    pub initially: Vec<TomlSpanned<String>>,
    /// Drive, speeds and size of the base.
    pub base: BaseTable,
    /// Its hands by the name of their resource; the first is the one meant where only one is.
    #[serde(default)]
    pub hands: IndexMap<String, TomlSpanned<HandTable>>,
    /// Its cameras by the name of their resource.
    #[serde(default)]
    pub cameras: IndexMap<String, TomlSpanned<CameraTable>>,
    /// The robot's body: without it, no motion can be computed.
    #[serde(default)]
    #[schemars(with = "ModelTable")]
    pub model: Option<ModelTable>,
    /// Named postures: positions of joints, in rad or m. `home` and `start` are those of the standard
    /// primitives.
    #[serde(default)]
    pub postures: IndexMap<String, TomlSpanned<IndexMap<String, TomlSpanned<WrittenQuantity>>>>,
    /// Exclusive resources, each with what it contains: using one is using what it contains.
    pub resources: IndexMap<String, TomlSpanned<Vec<TomlSpanned<String>>>>,
    /// Other numbers that contracts may use as `robot.NAME`; a text with a unit gives the type of the
    /// quantity.
    #[serde(default)]
    pub numbers: IndexMap<String, TomlSpanned<WrittenQuantity>>,
    /// The primitives that it provides, each with bounds on its numeric parameters.
    pub primitives: IndexMap<String, TomlSpanned<IndexMap<String, TomlSpanned<RangeTable>>>>,
}

/// Meanings of the words for manners.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Manners")]
pub struct MannersTable {
    /// The manner of `slowly`; half the speed and acceleration where none is given.
    #[serde(default)]
    #[schemars(with = "MannerTable")]
    pub slowly: Option<MannerTable>,
    /// The manner of `gently`; 30 % of the speed and 25 % of the acceleration where none is given.
    #[serde(default)]
    #[schemars(with = "MannerTable")]
    pub gently: Option<MannerTable>,
}

/// A part of the greatest speed and acceleration.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Manner")]
pub struct MannerTable {
    /// Part of the speed, above 0 and at most 1, or a text such as `"50 %"`.
    pub speed: TomlSpanned<WrittenQuantity>,
    /// Part of the acceleration, likewise.
    pub acceleration: TomlSpanned<WrittenQuantity>,
}

/// Distances that motions keep from obstacles, at most 0.5 m.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Clearance")]
pub struct ClearanceTable {
    /// Distance in m of every part that the arm does not move; the errors of localisation and tracking
    /// together where none is given.
    #[serde(default)]
    #[schemars(with = "WrittenQuantity")]
    pub base: Option<TomlSpanned<WrittenQuantity>>,
    /// Distance in m of the arm, the hand and the held object; the error of tracking where none is given.
    #[serde(default)]
    #[schemars(with = "WrittenQuantity")]
    pub arm: Option<TomlSpanned<WrittenQuantity>>,
}

/// Greatest errors of the robot's motions, at most 0.25 m each; 0 where none is given.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Errors")]
pub struct ErrorsTable {
    /// Error in m of the base's position in the map.
    #[serde(default)]
    #[schemars(with = "WrittenQuantity")]
    pub localisation: Option<TomlSpanned<WrittenQuantity>>,
    /// Distance in m of any point of the robot from the path that it follows.
    #[serde(default)]
    #[schemars(with = "WrittenQuantity")]
    pub tracking: Option<TomlSpanned<WrittenQuantity>>,
}

/// Mobile or fixed base.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Base")]
pub struct BaseTable {
    /// The kind of drive.
    pub drive: DriveWord,
    /// Nominal speed in m/s; 0 for a fixed base.
    pub speed: TomlSpanned<WrittenQuantity>,
    /// Nominal turning speed in rad/s.
    pub turn: TomlSpanned<f64>,
    /// Greatest acceleration and deceleration in m/s²; the speed within a second where none is given.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub acceleration: Option<TomlSpanned<f64>>,
    /// Greatest angular acceleration and deceleration in rad/s²; the turning speed within a second where none
    /// is given.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub turn_acceleration: Option<TomlSpanned<f64>>,
    /// Radius of the disc that encloses the footprint, in m.
    pub radius: TomlSpanned<WrittenQuantity>,
}

/// The kind of a base.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "Drive")]
pub enum DriveWord {
    /// Fixed to the floor or a table.
    Fixed,
    /// Any direction at any time.
    Omnidirectional,
    /// Forward and turning.
    Differential,
    /// Drives on legs.
    Legged,
}

/// The robot's body.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Model")]
pub struct ModelTable {
    /// The URDF, a file beside the card.
    pub urdf: TomlSpanned<String>,
    /// Its link whose pose is that of the base, x forward; its root where none is named.
    #[serde(default)]
    #[schemars(with = "String")]
    pub base: Option<TomlSpanned<String>>,
    /// Height of that link above the floor, in m.
    #[serde(default)]
    #[schemars(with = "WrittenQuantity")]
    pub height: Option<TomlSpanned<WrittenQuantity>>,
    /// Positions of joints where no posture says otherwise, in rad or m; 0 for the others.
    #[serde(default)]
    pub rest: IndexMap<String, TomlSpanned<WrittenQuantity>>,
    /// Greatest accelerations of joints in rad/s² or m/s²; the greatest speed within half a second for the
    /// others.
    #[serde(default)]
    pub accelerations: IndexMap<String, TomlSpanned<f64>>,
    /// The SRDF, a file beside the card: which links may touch.
    #[serde(default)]
    #[schemars(with = "String")]
    pub srdf: Option<TomlSpanned<String>>,
    /// Folders, as seen from the card's, that hold ROS packages: where `package://` is looked for.
    #[serde(default)]
    pub packages: Vec<TomlSpanned<String>>,
}

/// A direction along an axis of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
pub enum Direction {
    /// The x axis.
    #[serde(rename = "x")]
    X,
    /// Opposite to the x axis.
    #[serde(rename = "-x")]
    MinusX,
    /// The y axis.
    #[serde(rename = "y")]
    Y,
    /// Opposite to the y axis.
    #[serde(rename = "-y")]
    MinusY,
    /// The z axis.
    #[serde(rename = "z")]
    Z,
    /// Opposite to the z axis.
    #[serde(rename = "-z")]
    MinusZ,
}

/// Hand with its capacity and its place in the URDF.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Hand")]
pub struct HandTable {
    /// The heaviest object in kg.
    pub payload: TomlSpanned<WrittenQuantity>,
    /// The widest object in m.
    pub opening: TomlSpanned<WrittenQuantity>,
    /// The greatest distance in m, in the plane, from where the base stands.
    pub reach: TomlSpanned<WrittenQuantity>,
    /// Heights above the floor in m at which it serves a thing.
    pub heights: TomlSpanned<RangeTable>,
    /// Its link in the URDF: what it holds is where the link's origin is.
    #[serde(default)]
    #[schemars(with = "String")]
    pub tip: Option<TomlSpanned<String>>,
    /// The direction of that link in which the fingers point; z where none is given.
    #[serde(default)]
    #[schemars(with = "Direction")]
    pub points: Option<TomlSpanned<Direction>>,
    /// The direction of that link along which they close; y where none is given.
    #[serde(default)]
    #[schemars(with = "Direction")]
    pub closes: Option<TomlSpanned<Direction>>,
    /// Positions of its own joints when it is open, in rad or m; every joint that is not named stays at rest.
    #[serde(default)]
    pub open: IndexMap<String, TomlSpanned<WrittenQuantity>>,
}

/// Camera with its range and its place in the URDF.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Camera")]
pub struct CameraTable {
    /// Range of sight, in m.
    pub range: TomlSpanned<WrittenQuantity>,
    /// Full horizontal angle of view in rad; what a head that turns sees without moving the base counts.
    pub view: TomlSpanned<WrittenQuantity>,
    /// Its link in the URDF, which looks along z with y down.
    #[serde(default)]
    #[schemars(with = "String")]
    pub frame: Option<TomlSpanned<String>>,
}

/// A closed interval.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Range")]
pub struct RangeTable {
    /// Least, in SI units or as a text with a unit.
    pub least: TomlSpanned<WrittenQuantity>,
    /// Greatest, in SI units or as a text with a unit.
    pub greatest: TomlSpanned<WrittenQuantity>,
}
