//! Robot and room for the page: shapes once, then poses. All lengths in m, all poses in the map.

use std::collections::BTreeMap;
use std::sync::Arc;

use motet_compiler::Geometry;
use motet_geometry::collision::{Shape, Solid};
use motet_geometry::planning::{Articulation, Configuration, RobotModel, SceneState, components};
use motet_graph::Witness;
use motet_project::ProjectSession;
use motet_robots::scene::{Entity, EntityShape, PERSON_COLOUR, Palette, Scene, colour};
use motet_runtime::Moved;
use motet_stdlib::lang::kinds;
use serde_json::{Value, json};
use smol_str::SmolStr;

/// Radius and height in m of a person without a shape.
const PERSON: [f64; 2] = [0.25, 1.7];
/// Radius in m of the mark of a place.
const PLACE: f64 = 0.2;

/// Robot in its room.
#[derive(Debug)]
pub struct PageWorld {
    geometry: Arc<Geometry>,
    scene: Scene,
    /// Links with shapes.
    links: Vec<usize>,
    configuration: Configuration,
    /// Height of the middle of each person over the feet.
    lifts: BTreeMap<SmolStr, f64>,
    /// True once the driver has told where the base stands.
    tells_base: bool,
    /// True once the driver has told the positions of joints.
    tells_joints: bool,
}

impl PageWorld {
    /// World of a session; `None` without a body or a room.
    pub fn of(opened: &ProjectSession) -> Option<Self> {
        let (geometry, scene) = (opened.geometry.clone()?, opened.scene.clone()?);
        let state = SceneState::new(geometry.machine(), &scene);
        let mut links: Vec<usize> = geometry.machine().body().parts().iter().map(|part| part.link).collect();
        links.dedup();
        Some(Self {
            geometry,
            scene,
            links,
            configuration: state.robot,
            lifts: BTreeMap::new(),
            tells_base: false,
            tells_joints: false,
        })
    }

    fn model(&self) -> &RobotModel {
        self.geometry.machine()
    }

    /// Item with the shapes of the robot and of everything in the room, and the poses at the start.
    pub fn item(&mut self) -> Value {
        let state = SceneState::new(self.model(), &self.scene);
        let things: Vec<Value> =
            self.scene.entities.values().filter_map(|entity| thing(&self.scene, entity, &state)).collect();
        for person in self.scene.entities.values().filter(|entity| entity.kind == kinds::PERSON) {
            if let (Some(pose), Some(feet)) = (state.pose(person), person.pose) {
                let lift = pose.translation.vector.z - feet.xyz[2];
                let lift = if person.shape.is_none() { PERSON[1] / 2.0 } else { lift };
                self.lifts.insert(person.id.clone(), lift);
            }
        }
        let place = |link: usize| self.links.iter().position(|known| *known == link);
        let parts = self.model().body().parts().iter();
        let parts: Vec<Value> = parts.map(|part| json!([place(part.link), solid(&part.solid)])).collect();
        json!({
            "t": "world",
            "robot": {"name": self.model().card().name, "parts": parts},
            "pose": self.links_at(&self.configuration),
            "things": things,
        })
    }

    /// Poses of the links with shapes.
    fn links_at(&self, configuration: &Configuration) -> Value {
        let poses = self.model().map_from_links(configuration);
        let poses = self.links.iter().filter_map(|link| poses.get(*link));
        poses.map(|pose| numbers(&pose_of(components(pose)))).collect()
    }

    /// Item of a report of motion.
    pub fn moved(&mut self, moved: &Moved) -> Value {
        self.configuration.base = moved.base;
        self.tells_base = true;
        self.tells_joints |= !moved.joints.is_empty();
        for (name, position) in &moved.joints {
            self.set(name, *position);
        }
        let things: serde_json::Map<String, Value> = moved
            .things
            .iter()
            .map(|thing| {
                let [x, y, z] = thing.xyz;
                let lift = self.lifts.get(&thing.id).copied().unwrap_or_default();
                let pose: Vec<f64> = [x, y, z + lift].into_iter().chain(thing.quaternion).collect();
                (thing.id.to_string(), numbers(&pose))
            })
            .collect();
        json!({
            "t": "moved", "at": moved.at.secs(), "pose": self.links_at(&self.configuration),
            "things": things,
        })
    }

    /// Takes in the configuration in which a success leaves the robot, as far as the driver does not tell it.
    /// Returns the poses of the links where something follows from it.
    pub fn left(&mut self, leaves: &motet_graph::Configuration) -> Option<Value> {
        if self.tells_joints {
            return None;
        }
        for (name, position) in &leaves.joints {
            self.set(name, *position);
        }
        if !self.tells_base {
            self.configuration.base = leaves.base;
        }
        Some(self.links_at(&self.configuration))
    }

    fn set(&mut self, joint: &str, position: f64) {
        let dof = self.model().tree().dof(joint);
        if let Some(slot) = dof.ok().and_then(|dof| self.configuration.joints.get_mut(dof)) {
            *slot = position;
        }
    }

    /// Path of a motion: the way of the base, the way of the hand, and the robot at its end.
    pub fn path(&self, witness: &Witness) -> Value {
        let dofs: Vec<Option<usize>> =
            witness.joints.iter().map(|name| self.model().tree().dof(name).ok()).collect();
        let configurations: Vec<Configuration> = witness
            .path
            .iter()
            .map(|waypoint| {
                let mut joints = self.configuration.joints.clone();
                for (dof, position) in dofs.iter().zip(&waypoint.joints) {
                    if let Some(slot) = dof.and_then(|dof| joints.get_mut(dof)) {
                        *slot = *position;
                    }
                }
                Configuration { base: waypoint.base, joints }
            })
            .collect();
        let base: Value = configurations.iter().map(|at| numbers(&at.base)).collect();
        let tip = self.model().hand().map(|hand| hand.tip);
        let hand: Value = configurations
            .iter()
            .filter_map(|at| {
                let poses = self.model().map_from_links(at);
                Some(numbers(poses.get(tip?)?.translation.vector.as_slice()))
            })
            .collect();
        json!({"base": base, "hand": hand, "end": configurations.last().map(|end| self.links_at(end))})
    }

    /// Entities that a text names, such as the reason why a motion is infeasible.
    pub fn named(&self, text: &str) -> Vec<&str> {
        let words: Vec<&str> =
            text.split(|letter: char| !(letter.is_alphanumeric() || "_-".contains(letter))).collect();
        self.scene.entities.keys().map(SmolStr::as_str).filter(|id| words.contains(id)).collect()
    }
}

fn thing(scene: &Scene, entity: &Entity, state: &SceneState) -> Option<Value> {
    let pose = state.pose(entity)?;
    let palette = match entity.kind.as_str() {
        kinds::SURFACE | kinds::CONTAINER => Palette::Furniture,
        _ => Palette::Things,
    };
    let is_person = entity.kind == kinds::PERSON;
    let colour = if is_person { PERSON_COLOUR } else { colour(&entity.id, Some(entity), palette) };
    let shape = shape(entity);
    let mut at = pose_of(components(&pose));
    if let (true, None, Some(z)) = (is_person, &entity.shape, at.get_mut(2)) {
        *z += PERSON[1] / 2.0;
    }
    let mut item = json!({
        "id": entity.id, "kind": entity.kind, "name": scene.called(&entity.id), "colour": colour,
        "at": numbers(&at), "shape": shape,
    });
    if let (Some(opening), Some(item)) = (Articulation::new(entity, state), item.as_object_mut()) {
        // Both in the map.
        item.insert("still".to_owned(), opening.still().iter().map(solid).collect());
        item.insert("moving".to_owned(), opening.moving(0.0).iter().map(solid).collect());
        item.insert("opened".to_owned(), numbers(&pose_of(components(&opening.map_moved(1.0)))));
        item.insert("open".to_owned(), json!(state.is_open(entity)));
    }
    Some(item)
}

/// Shape of an entity as its kind and its sizes: half extents, or radius and half height.
fn shape(entity: &Entity) -> Value {
    match (&entity.shape, entity.kind.as_str()) {
        (Some(EntityShape::Box([x, y, z])), _) => json!(["box", numbers(&[x / 2.0, y / 2.0, z / 2.0])]),
        (Some(EntityShape::Cylinder { radius, height }), _) => {
            json!(["cylinder", numbers(&[*radius, height / 2.0])])
        }
        (Some(EntityShape::Capsule { radius, height }), _) => {
            json!(["capsule", numbers(&[*radius, height / 2.0])])
        }
        (Some(EntityShape::Sphere { radius }), _) => json!(["capsule", numbers(&[*radius, 0.0])]),
        (None, kinds::PERSON) => json!(["cylinder", [PERSON[0], PERSON[1] / 2.0]]),
        (None, kinds::PLACE) => json!(["cylinder", [PLACE, 0.005]]),
        (Some(EntityShape::Mesh { .. }) | None, _) => Value::Null,
    }
}

/// A solid: kind, sizes, centre and axes.
fn solid(solid: &Solid) -> Value {
    let (kind, sizes) = match solid.shape {
        Shape::Box(half) => ("box", vec![half.x, half.y, half.z]),
        Shape::Cylinder { radius, half } => ("cylinder", vec![radius, half]),
        Shape::Capsule { radius, half } => ("capsule", vec![radius, half]),
        // Neither a link nor an entity is one.
        Shape::HalfSpace => ("none", vec![]),
    };
    let axes: Vec<f64> = solid.axes.iter().flat_map(|axis| [axis.x, axis.y, axis.z]).collect();
    json!([kind, numbers(&sizes), numbers(solid.centre.as_slice()), numbers(&axes)])
}

/// Position and quaternion x, y, z, w.
fn pose_of((xyz, quaternion): ([f64; 3], [f64; 4])) -> Vec<f64> {
    xyz.into_iter().chain(quaternion).collect()
}

/// Numbers to a tenth of a millimetre.
fn numbers(values: &[f64]) -> Value {
    values.iter().map(|value| json!((value * 1e4).round() / 1e4)).collect()
}
