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
}

/// A camera.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Camera {
    /// How far it sees, in m.
    pub range: At<Quantity>,
    /// Full horizontal angle of view in rad; what a head that turns sees without moving the base counts.
    pub view: At<Quantity>,
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
