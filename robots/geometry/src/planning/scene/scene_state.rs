//! What changes from step to step: where the robot and the things are, what it holds, what is open. A query is answered
//! in one of these.

use std::collections::BTreeMap;

use motet_robots::scene::{Entity, EntityShape, Placement, Scene};
use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};
use smol_str::SmolStr;

use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::robot_model::{HandModel, RobotModel};

/// The world after some steps.
#[derive(Clone, PartialEq, Debug)]
pub struct SceneState {
    /// Where the robot is.
    pub robot: Configuration,
    /// Where things are that have moved since the scene was made: the pose of their shape's centre.
    pub moved: BTreeMap<SmolStr, Isometry3<f64>>,
    /// What is in the hand, and where in the tip's frame.
    pub held: Option<(SmolStr, Isometry3<f64>)>,
    /// Which containers are open or closed, where that differs from the scene.
    pub open: BTreeMap<SmolStr, bool>,
}

/// A thing in the hand.
#[derive(Clone, Debug)]
pub(crate) struct HeldObject<'a> {
    pub(crate) id: SmolStr,
    pub(crate) tip_from_object: Isometry3<f64>,
    pub(crate) hand: &'a HandModel,
    pub(crate) shape: crate::collision::Shape,
    /// How wide it is between the fingers, in m.
    pub(crate) width: f64,
}

impl SceneState {
    /// The world as a scene gives it. Joints that it does not name are at rest; of a thing in the hand it is not known how it
    /// is held, so it is taken to stand upright where a grasp from the side would put it.
    #[must_use]
    pub fn new(model: &RobotModel, scene: &Scene) -> Self {
        let mut joints = model.rest().to_vec();
        for (name, value) in &scene.robot.joints {
            if let Some(slot) = model.tree().dof(name).ok().and_then(|at| joints.get_mut(at)) {
                *slot = *value;
            }
        }
        let held = scene.robot.holding.clone().flatten().and_then(|id| {
            let (hand, entity) = model.hand().zip(scene.entities.get(&id))?;
            let half = match entity.shape.as_ref()? {
                EntityShape::Box([x, ..]) => x / 2.0,
                EntityShape::Cylinder { radius, .. }
                | EntityShape::Sphere { radius }
                | EntityShape::Capsule { radius, .. } => *radius,
                EntityShape::Mesh { .. } => return None,
            };
            let points = Vector3::from(hand.card.points);
            let closes = Vector3::from(hand.card.closes);
            // Upright in the hand: its z is square to both directions of the hand.
            let axes = Matrix3::from_columns(&[points, closes, points.cross(&closes)]);
            let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
            let depth = (hand.palm + half).max(0.0);
            let middle = points * depth + closes * hand.middle(2.0 * half);
            Some((id, Isometry3::from_parts(Translation3::from(middle), rotation)))
        });
        Self {
            robot: Configuration { base: scene.robot.base, joints },
            moved: BTreeMap::new(),
            held,
            open: BTreeMap::new(),
        }
    }

    /// The pose of an entity's centre: of its shape, or of the entity where it has none. `None` where it is not known.
    #[must_use]
    pub fn pose(&self, entity: &Entity) -> Option<Isometry3<f64>> {
        if let Some(pose) = self.moved.get(&entity.id) {
            return Some(*pose);
        }
        let pose = isometry(entity.pose.as_ref()?);
        // The pose of a person is that of the feet.
        let lifted = match (&entity.shape, entity.kind.as_str()) {
            (Some(EntityShape::Cylinder { height, .. }), "Person") => height / 2.0,
            (Some(EntityShape::Capsule { radius, height }), "Person") => height / 2.0 + radius,
            (Some(EntityShape::Box([_, _, z])), "Person") => z / 2.0,
            _ => 0.0,
        };
        Some(pose * Translation3::new(0.0, 0.0, lifted))
    }

    /// All that tells this world from another of the same robot and scene, bit for bit.
    #[must_use]
    pub fn fingerprint(&self) -> Vec<u8> {
        let mut key = self.key_without_base();
        self.robot.base.iter().for_each(|value| key.extend_from_slice(&value.to_bits().to_le_bytes()));
        key
    }

    /// The same but for where the base is.
    pub(crate) fn key_without_base(&self) -> Vec<u8> {
        let mut key = Vec::with_capacity(256);
        let numbers = |key: &mut Vec<u8>, values: &[f64]| {
            values.iter().for_each(|value| key.extend_from_slice(&value.to_bits().to_le_bytes()));
        };
        let pose = |key: &mut Vec<u8>, id: &str, pose: &Isometry3<f64>| {
            key.extend_from_slice(id.as_bytes());
            key.push(0);
            let (xyz, quaternion) = components(pose);
            numbers(key, &xyz);
            numbers(key, &quaternion);
        };
        numbers(&mut key, &self.robot.joints);
        self.moved.iter().for_each(|(id, at)| pose(&mut key, id, at));
        key.push(1);
        self.held.iter().for_each(|(id, at)| pose(&mut key, id, at));
        key.push(2);
        for (id, open) in &self.open {
            key.extend_from_slice(id.as_bytes());
            key.push(if *open { 3 } else { 4 });
        }
        key
    }

    /// Whether a container is open.
    #[must_use]
    pub fn is_open(&self, entity: &Entity) -> bool {
        self.open.get(&entity.id).copied().or(entity.open).unwrap_or(false)
    }

    /// What is held.
    #[must_use]
    pub fn holds(&self, id: &str) -> bool {
        self.held.as_ref().is_some_and(|(held, _)| held == id)
    }
}

/// A pose as numbers: x, y and z in m, and the unit quaternion x, y, z, w.
#[must_use]
pub fn components(pose: &Isometry3<f64>) -> ([f64; 3], [f64; 4]) {
    (pose.translation.vector.into(), pose.rotation.coords.into())
}

/// A scene's placement: roll, pitch and yaw about fixed axes, with one sine for every machine.
pub(crate) fn isometry(placement: &Placement) -> Isometry3<f64> {
    use crate::trigonometry::turn;
    let [x, y, z] = placement.xyz;
    let [roll, pitch, yaw] = placement.rpy;
    let rotation =
        turn(&Vector3::z_axis(), yaw) * turn(&Vector3::y_axis(), pitch) * turn(&Vector3::x_axis(), roll);
    Isometry3::from_parts(Translation3::new(x, y, z), rotation)
}
