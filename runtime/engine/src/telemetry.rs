//! Reports of a driver that are no events of the engine: where everything is while it moves, and words that
//! nobody asked for. They go to the observer of a run and are kept in no journal.

use crate::time::Time;
use motet_graph::Pose;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;
use std::collections::{BTreeMap, HashMap};

/// Telemetry: configuration of the robot and poses of things at a time. Lengths in m, angles in rad, poses in
/// the frame `map`.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Moved {
    /// Time of the run.
    pub at: Time,
    /// Base pose x, y, yaw.
    pub base: [f64; 3],
    /// Positions of joints by name; those that have not changed may be left out.
    pub joints: BTreeMap<SmolStr, f64>,
    /// Poses of things; those that have not moved may be left out.
    pub things: Vec<MovedThing>,
}

impl Moved {
    /// Takes in later telemetry, of which what has not changed may be left out. O(joints + things).
    pub fn merge(&mut self, later: &Self) {
        (self.at, self.base) = (later.at, later.base);
        self.joints.extend(later.joints.clone());
        let known = self.things.iter().map(|thing| thing.id.clone()).zip(0..);
        let mut places: HashMap<SmolStr, usize> = known.collect();
        for thing in &later.things {
            let place = *places.entry(thing.id.clone()).or_insert(self.things.len());
            match self.things.get_mut(place) {
                Some(known) => *known = thing.clone(),
                None => self.things.push(thing.clone()),
            }
        }
    }
}

/// Pose of a thing.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct MovedThing {
    /// Entity of the scene, or an id of the driver.
    pub id: SmolStr,
    pub xyz: [f64; 3],
    /// Unit quaternion in the order x, y, z, w.
    pub quaternion: [f64; 4],
}

/// A thing as the driver is told of it: somebody said where it is, or the host gave a thing a name that the
/// driver had detected without one.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct ToldThing {
    /// Entity of the scene, or the name that the host gave.
    pub id: SmolStr,
    /// Name for what it is, of a thing that is not in the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<SmolStr>,
    /// Pose of its middle in the frame `map`, where it is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pose: Option<Pose>,
    /// Its support or container, if it is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub support: Option<ToldSupport>,
}

/// Support of a thing.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ToldSupport {
    On(SmolStr),
    In(SmolStr),
    /// With a person, or at a place.
    At(SmolStr),
}

/// Words that a person said without being asked.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Heard {
    pub text: SmolStr,
    /// The person, as an entity of the scene, where it is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<SmolStr>,
}
