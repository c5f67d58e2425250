//! What stands in a `robot.toml`. Only [`super::read`] makes a [`super::Robot`] of it.
//!
//! A quantity is a number in the SI unit that its key names, or a text with a unit: `0.2` or `"20 cm"`.

use std::borrow::Cow;

use indexmap::IndexMap;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

/// The JSON Schema of a `robot.toml`, seen as the JSON of the same shape.
#[must_use]
pub fn schema() -> Schema {
    schemars::schema_for!(Card)
}

/// A value and its place in the document.
#[derive(Clone, Debug, Deserialize)]
#[serde(transparent)]
pub struct At<T>(pub toml::Spanned<T>);

impl<T> At<T> {
    /// The value.
    pub fn get(&self) -> &T {
        self.0.get_ref()
    }
}

impl<T: JsonSchema> JsonSchema for At<T> {
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
pub enum Quantity {
    /// In SI units.
    Number(f64),
    /// With a unit.
    Text(String),
}

/// A robot card.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Card {
    /// The robot's id in policies and on the command line, `hsr`.
    pub name: At<String>,
    /// What people call it.
    pub title: At<String>,
    /// The longest time that one observation takes, in s.
    pub observe_within: At<Quantity>,
    /// Fluents and measures that it can observe.
    pub observes: Vec<At<String>>,
    /// Facts that hold at the start unless a state says otherwise, as text conditions: `not standing(robot)`.
    #[serde(default)]
    pub initially: Vec<At<String>>,
    /// How it drives.
    pub base: Base,
    /// Its hands by the name of their resource; the first is the one meant where only one is.
    #[serde(default)]
    pub hands: IndexMap<String, At<Hand>>,
    /// Its cameras by the name of their resource.
    #[serde(default)]
    pub cameras: IndexMap<String, At<Camera>>,
    /// The robot's body: without it, no motion can be computed.
    #[serde(default)]
    #[schemars(with = "Model")]
    pub model: Option<Model>,
    /// Named postures: positions of joints, in rad or m. `home` and `start` are those of the standard primitives.
    #[serde(default)]
    pub postures: IndexMap<String, At<IndexMap<String, At<Quantity>>>>,
    /// Exclusive resources, each with what it contains: using one is using what it contains.
    pub resources: IndexMap<String, At<Vec<At<String>>>>,
    /// Other numbers that contracts may use as `robot.NAME`; a text with a unit gives the type of the quantity.
    #[serde(default)]
    pub numbers: IndexMap<String, At<Quantity>>,
    /// The primitives that it provides, each with bounds on its numeric parameters.
    pub primitives: IndexMap<String, At<IndexMap<String, At<Range>>>>,
}

/// How a robot drives.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Base {
    /// The kind of drive.
    pub drive: Drive,
    /// Nominal speed in m/s; 0 for a fixed base.
    pub speed: At<Quantity>,
    /// Nominal turning speed in rad/s.
    pub turn: At<f64>,
    /// Radius of the disc that encloses the footprint, in m.
    pub radius: At<Quantity>,
}

/// The kind of a base.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Drive {
    /// Bolted down.
    Fixed,
    /// Any direction at any time.
    Omnidirectional,
    /// Forward and turning.
    Differential,
    /// On legs.
    Legged,
}

/// The robot's body.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Model {
    /// The URDF, a file beside the card.
    pub urdf: At<String>,
    /// Its link whose pose is that of the base, x forward; its root where none is named.
    #[serde(default)]
    #[schemars(with = "String")]
    pub base: Option<At<String>>,
    /// How high above the floor that link is, in m.
    #[serde(default)]
    #[schemars(with = "Quantity")]
    pub height: Option<At<Quantity>>,
    /// Positions of joints where no posture says otherwise, in rad or m; 0 for the others.
    #[serde(default)]
    pub rest: IndexMap<String, At<Quantity>>,
    /// The SRDF, a file beside the card: which links may touch.
    #[serde(default)]
    #[schemars(with = "String")]
    pub srdf: Option<At<String>>,
    /// Folders, as seen from the card's, that hold ROS packages: where `package://` is looked for.
    #[serde(default)]
    pub packages: Vec<At<String>>,
}

/// A direction along an axis of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
pub enum Direction {
    /// Along x.
    #[serde(rename = "x")]
    X,
    /// Against x.
    #[serde(rename = "-x")]
    MinusX,
    /// Along y.
    #[serde(rename = "y")]
    Y,
    /// Against y.
    #[serde(rename = "-y")]
    MinusY,
    /// Along z.
    #[serde(rename = "z")]
    Z,
    /// Against z.
    #[serde(rename = "-z")]
    MinusZ,
}

/// A hand.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Hand {
    /// The heaviest object in kg.
    pub payload: At<Quantity>,
    /// The widest object in m.
    pub opening: At<Quantity>,
    /// The greatest distance in m, in the plane, from where the base stands.
    pub reach: At<Quantity>,
    /// Heights above the floor in m at which it serves a thing.
    pub heights: At<Range>,
    /// Its link in the URDF: what it holds is where the link's origin is.
    #[serde(default)]
    #[schemars(with = "String")]
    pub tip: Option<At<String>>,
    /// The direction of that link in which the fingers point; z where none is given.
    #[serde(default)]
    #[schemars(with = "Direction")]
    pub points: Option<At<Direction>>,
    /// The direction of that link along which they close; y where none is given.
    #[serde(default)]
    #[schemars(with = "Direction")]
    pub closes: Option<At<Direction>>,
    /// Positions of its own joints when it is open, in rad or m; every joint that is not named stays at rest.
    #[serde(default)]
    pub open: IndexMap<String, At<Quantity>>,
}

/// A camera.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Camera {
    /// How far it sees, in m.
    pub range: At<Quantity>,
    /// Full horizontal angle of view in rad; what a head that turns sees without moving the base counts.
    pub view: At<Quantity>,
    /// Its link in the URDF, which looks along z with y down.
    #[serde(default)]
    #[schemars(with = "String")]
    pub frame: Option<At<String>>,
}

/// A closed interval.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Range {
    /// Least, in SI units or as a text with a unit.
    pub least: At<Quantity>,
    /// Greatest, likewise.
    pub greatest: At<Quantity>,
}
