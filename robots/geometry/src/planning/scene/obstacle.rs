//! What stands in the way: the solids of the entities of a scene, in the world as it is.

use motet_robots::scene::{Entity, EntityShape};
use nalgebra::Vector3;

use crate::collision::{Shape, Solid};
use crate::planning::scene::articulation::Articulation;
use crate::planning::scene::scene_state::SceneState;

/// The solids of an entity; none where it has no shape or its place is not known, or where it is in the hand.
///
/// A closed container is as solid as its shape. An open drawer is a box without a lid that stands out by its travel; what has
/// a door is a box without the face where the door was, and the door turned outwards.
pub(crate) fn solids(entity: &Entity, state: &SceneState) -> Vec<Solid> {
    let (Some(pose), Some(shape)) = (state.pose(entity), solid_shape(entity)) else { return vec![] };
    if state.holds(&entity.id) {
        return vec![];
    }
    let opening = state.is_open(entity).then(|| Articulation::new(entity, state)).flatten();
    opening.map_or_else(|| vec![Solid::new(&pose, shape)], |opening| opening.solids(1.0))
}

/// The shape of an entity as a solid; `None` for a mesh and where there is none.
pub(crate) fn solid_shape(entity: &Entity) -> Option<Shape> {
    Some(match entity.shape.as_ref()? {
        EntityShape::Box([x, y, z]) => Shape::Box(Vector3::new(x / 2.0, y / 2.0, z / 2.0)),
        EntityShape::Cylinder { radius, height } => Shape::Cylinder { radius: *radius, half: height / 2.0 },
        EntityShape::Sphere { radius } => Shape::Capsule { radius: *radius, half: 0.0 },
        EntityShape::Capsule { radius, height } => Shape::Capsule { radius: *radius, half: height / 2.0 },
        EntityShape::Mesh { .. } => return None,
    })
}
