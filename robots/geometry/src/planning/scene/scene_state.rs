//! Scene state: everything that changes between queries. Its scene and its robot model stay the same.

use std::collections::BTreeMap;

use motet_robots::scene::{Entity, EntityShape, Outline, Placement};
use motet_stdlib::lang::kinds;
use nalgebra::{Isometry3, Translation3, Vector3};
use smol_str::{SmolStr, format_smolstr};

use super::configuration::Configuration;
use super::robot_model::HandModel;
use crate::collision::{Shape, Solid};

/// Beginning of the names of kept regions in messages.
pub(crate) const KEPT: &str = "the region that `keep ";
/// Radius in m of a person without a shape.
const PERSON_RADIUS_M: f64 = 0.3;
/// Height of the column over a zone, in m.
const COLUMN: f64 = 4.0;

/// Scene state: robot configuration, moved objects, held object and open containers.
#[derive(Clone, PartialEq, Debug)]
pub struct SceneState {
    /// Configuration of the robot.
    pub robot: Configuration,
    /// Poses of the objects that moved since the scene was read: the centre of their shape, in the map.
    pub moved: BTreeMap<SmolStr, Isometry3<f64>>,
    /// Held object and its pose in the tip's frame.
    pub held: Option<(SmolStr, Isometry3<f64>)>,
    /// Containers whose state differs from the scene: `true` where open.
    pub open: BTreeMap<SmolStr, bool>,
    /// Regions that no part of the robot and of what it holds may enter.
    pub kept: Vec<KeptRegion>,
}

/// Region that no part of the robot and of what it holds may enter: columns over the floor.
#[derive(Clone, PartialEq, Debug)]
pub struct KeptRegion {
    /// Name in messages.
    pub(crate) name: SmolStr,
    pub(crate) columns: Vec<Solid>,
    /// Set where the columns are grown by a distance that a rule gives.
    pub(crate) is_distance: bool,
}

impl KeptRegion {
    /// The rule that forbids it, as it is written: `distance(user) >= 1.5 m`.
    #[must_use]
    pub fn rule(&self) -> &str {
        let rule = self.name.strip_prefix(KEPT).unwrap_or(&self.name);
        rule.split_once('`').map_or(rule, |(rule, _)| rule)
    }

    /// Least distance in m of solids to it; 0 where one is in it, infinite without solids.
    #[must_use]
    pub fn distance(&self, solids: &[Solid]) -> f64 {
        let pairs = solids.iter().flat_map(|solid| self.columns.iter().map(|column| column.distance(solid)));
        pairs.fold(f64::INFINITY, f64::min).max(0.0)
    }
}

/// Held object with its hand.
#[derive(Clone, Debug)]
pub(crate) struct HeldObject<'a> {
    pub(crate) id: SmolStr,
    pub(crate) tip_from_object: Isometry3<f64>,
    pub(crate) hand: &'a HandModel,
    pub(crate) shape: Shape,
    /// Width between the fingers, in m.
    pub(crate) width: f64,
}

impl SceneState {
    /// Pose of an entity's centre: of its shape, or of the entity itself without one. `None` where it is
    /// not known.
    #[must_use]
    pub fn pose(&self, entity: &Entity) -> Option<Isometry3<f64>> {
        if let Some(pose) = self.moved.get(&entity.id) {
            return Some(*pose);
        }
        let pose = isometry(entity.pose.as_ref()?);
        // The scene gives the pose of a person's feet.
        let lifted = match (&entity.shape, entity.kind.as_str()) {
            (Some(EntityShape::Cylinder { height, .. }), kinds::PERSON) => height / 2.0,
            (Some(EntityShape::Capsule { radius, height }), kinds::PERSON) => height / 2.0 + radius,
            (Some(EntityShape::Box([_, _, z])), kinds::PERSON) => z / 2.0,
            _ => 0.0,
        };
        Some(pose * Translation3::new(0.0, 0.0, lifted))
    }

    /// Column over a zone, from the floor to above every robot. `None` for any other entity, and without an
    /// extent.
    #[must_use]
    pub fn zone(&self, entity: &Entity) -> Option<Solid> {
        if entity.kind != kinds::ZONE {
            return None;
        }
        let shape = match entity.shape.as_ref()? {
            EntityShape::Box([x, y, _]) => Shape::Box(Vector3::new(x / 2.0, y / 2.0, COLUMN / 2.0)),
            EntityShape::Cylinder { radius, .. } => Shape::Cylinder { radius: *radius, half: COLUMN / 2.0 },
            EntityShape::Sphere { .. } | EntityShape::Capsule { .. } | EntityShape::Mesh { .. } => {
                return None;
            }
        };
        let floor = self.pose(entity)?;
        Some(Solid::new(&(floor * Translation3::new(0.0, 0.0, COLUMN / 2.0)), shape))
    }

    /// Region over a zone; `None` where its extent is not known.
    #[must_use]
    pub fn kept_out_of(&self, entity: &Entity) -> Option<KeptRegion> {
        let name = format_smolstr!("{KEPT}out of {}` forbids", entity.id);
        Some(KeptRegion { name, columns: vec![self.zone(entity)?], is_distance: false })
    }

    /// Region within a distance in m of an entity, measured in the plane from its outline. `None` where its
    /// pose or its outline is not known, or the hand holds it.
    #[must_use]
    pub fn kept_from(&self, entity: &Entity, at_least: f64) -> Option<KeptRegion> {
        if self.holds(&entity.id) {
            return None;
        }
        let outline = match (&entity.shape, entity.kind.as_str()) {
            (Some(shape), _) => Outline::of(shape)?,
            (None, kinds::PERSON) => Outline::Disc { radius: PERSON_RADIUS_M },
            (None, kinds::PLACE) => Outline::Disc { radius: 0.0 },
            (None, _) => return None,
        };
        let mut pose = self.pose(entity)?;
        if (pose.rotation * Vector3::z()).z < 1.0 - 1e-6 {
            return None;
        }
        pose.translation.vector.z = COLUMN / 2.0;
        let column = |x: f64, y: f64, shape: Shape| Solid::new(&(pose * Translation3::new(x, y, 0.0)), shape);
        let disc = |radius: f64| Shape::Cylinder { radius, half: COLUMN / 2.0 };
        let slab = |x: f64, y: f64| Shape::Box(Vector3::new(x, y, COLUMN / 2.0));
        let columns = match outline {
            Outline::Disc { radius } => vec![column(0.0, 0.0, disc(radius + at_least))],
            Outline::Rectangle { half: [x, y] } => {
                let corners = [(x, y), (x, -y), (-x, y), (-x, -y)];
                let corners = corners.map(|(x, y)| column(x, y, disc(at_least)));
                let slabs = [slab(x + at_least, y), slab(x, y + at_least)];
                slabs.map(|slab| column(0.0, 0.0, slab)).into_iter().chain(corners).collect()
            }
        };
        let name = format_smolstr!("{KEPT}distance({}) >= {at_least} m` forbids", entity.id);
        Some(KeptRegion { name, columns, is_distance: true })
    }

    /// Fingerprint of the state: equal, bit for bit, for equal states of one robot and scene.
    #[must_use]
    pub fn fingerprint(&self) -> Vec<u8> {
        let mut key = self.key_without_base();
        self.robot.base.iter().for_each(|value| key.extend_from_slice(&value.to_bits().to_le_bytes()));
        key
    }

    /// Fingerprint without the pose of the base.
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
        for region in &self.kept {
            key.push(5);
            key.extend_from_slice(region.name.as_bytes());
            for column in &region.columns {
                numbers(&mut key, column.centre.as_slice());
                column.axes.iter().for_each(|axis| numbers(&mut key, axis.as_slice()));
            }
        }
        key
    }

    /// Checks whether a container is open.
    #[must_use]
    pub fn is_open(&self, entity: &Entity) -> bool {
        self.open.get(&entity.id).copied().or(entity.open).unwrap_or(false)
    }

    /// Checks whether the hand holds an entity.
    #[must_use]
    pub fn holds(&self, id: &str) -> bool {
        self.held.as_ref().is_some_and(|(held, _)| held == id)
    }
}

/// Components of a pose: x, y and z in m, and the unit quaternion as x, y, z, w.
#[must_use]
pub fn components(pose: &Isometry3<f64>) -> ([f64; 3], [f64; 4]) {
    (pose.translation.vector.into(), pose.rotation.coords.into())
}

/// Pose of a scene's placement: roll, pitch and yaw about fixed axes, with a portable sine.
pub(crate) fn isometry(placement: &Placement) -> Isometry3<f64> {
    use crate::trigonometry::turn;
    let [x, y, z] = placement.xyz;
    let [roll, pitch, yaw] = placement.rpy;
    let rotation =
        turn(&Vector3::z_axis(), yaw) * turn(&Vector3::y_axis(), pitch) * turn(&Vector3::x_axis(), roll);
    Isometry3::from_parts(Translation3::new(x, y, z), rotation)
}

/// Solid shape of an entity; `None` for a mesh or without a shape.
pub(crate) fn solid_shape(entity: &Entity) -> Option<Shape> {
    Some(match entity.shape.as_ref()? {
        EntityShape::Box([x, y, z]) => Shape::Box(Vector3::new(x / 2.0, y / 2.0, z / 2.0)),
        EntityShape::Cylinder { radius, height } => Shape::Cylinder { radius: *radius, half: height / 2.0 },
        EntityShape::Sphere { radius } => Shape::Capsule { radius: *radius, half: 0.0 },
        EntityShape::Capsule { radius, height } => Shape::Capsule { radius: *radius, half: height / 2.0 },
        EntityShape::Mesh { .. } => return None,
    })
}
