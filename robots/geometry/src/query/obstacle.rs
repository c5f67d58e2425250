//! What stands in the way: the solids of the entities of a scene, in the world as it is.

use motet_robots::scene::{Entity, Shape as Listed, Travel};
use nalgebra::{Isometry3, Translation3, Unit, Vector3};

use super::world::World;
use crate::collision::{Shape, Solid};
use crate::trigonometry::turn;

/// How thick the walls of an open container are taken to be, in m.
pub(super) const WALL: f64 = 0.01;

/// The solids of an entity; none where it has no shape or its place is not known, or where it is in the hand.
///
/// A closed container is as solid as its shape. An open drawer is a box without a lid that stands out by its travel; what has
/// a door is a box without the face where the door was, and the door turned outwards.
pub(super) fn solids(entity: &Entity, world: &World) -> Vec<Solid> {
    let (Some(pose), Some(shape)) = (world.pose(entity), solid_shape(entity)) else { return vec![] };
    if world.holds(&entity.id) {
        return vec![];
    }
    match (&entity.travel, shape) {
        (Some(travel), Shape::Box(half)) if world.is_open(entity) => opened(&pose, &half, travel),
        _ => vec![Solid::new(&pose, shape)],
    }
}

/// The shape of an entity as a solid; `None` for a mesh and where there is none.
pub(super) fn solid_shape(entity: &Entity) -> Option<Shape> {
    Some(match entity.shape.as_ref()? {
        Listed::Box([x, y, z]) => Shape::Box(Vector3::new(x / 2.0, y / 2.0, z / 2.0)),
        Listed::Cylinder { radius, height } => Shape::Cylinder { radius: *radius, half: height / 2.0 },
        Listed::Sphere { radius } => Shape::Capsule { radius: *radius, half: 0.0 },
        Listed::Capsule { radius, height } => Shape::Capsule { radius: *radius, half: height / 2.0 },
        Listed::Mesh { .. } => return None,
    })
}

fn opened(pose: &Isometry3<f64>, half: &Vector3<f64>, travel: &Travel) -> Vec<Solid> {
    match travel {
        Travel::Slide { axis, distance } => {
            let out = *pose * Translation3::from(Vector3::from(*axis) * *distance);
            // Without its upper face, wherever the entity's axes have that.
            let up = pose.rotation.inverse() * Vector3::z();
            walls(&out, half, &face_towards(&up))
        }
        Travel::Hinge { axis, at, angle } => {
            let (axis, at) = (Vector3::from(*axis), Vector3::from(*at));
            let Some((face, swung)) = door(half, &axis, &at, *angle) else {
                return vec![Solid::new(pose, Shape::Box(*half))];
            };
            let mut solids = walls(pose, half, &face);
            solids.push(swung.moved(pose));
            solids
        }
    }
}

/// The direction of the box's face that looks most along a direction.
fn face_towards(direction: &Vector3<f64>) -> Vector3<f64> {
    let axis = direction.iamax();
    Vector3::from_fn(|row, _| if row == axis { direction.get(row).map_or(0.0, |v| v.signum()) } else { 0.0 })
}

/// Five walls of a box, in the frame of its pose, without the face in a direction.
fn walls(pose: &Isometry3<f64>, half: &Vector3<f64>, missing: &Vector3<f64>) -> Vec<Solid> {
    faces().filter(|face| face != missing).map(|face| wall(half, &face).moved(pose)).collect()
}

fn faces() -> impl Iterator<Item = Vector3<f64>> {
    [Vector3::x(), Vector3::y(), Vector3::z()].into_iter().flat_map(|axis| [axis, -axis])
}

/// A face of a box as a slab within it.
fn wall(half: &Vector3<f64>, face: &Vector3<f64>) -> Solid {
    let thin = half.zip_map(face, |half, part| if part == 0.0 { half } else { (WALL / 2.0).min(half) });
    let centre = face.component_mul(&(half - thin));
    Solid::new(&Translation3::from(centre).into(), Shape::Box(thin))
}

/// The face that the door closes, and the door turned about its hinge: of the faces next to the hinge that whose door comes to
/// lie farthest outside of the box.
fn door(
    half: &Vector3<f64>,
    axis: &Vector3<f64>,
    at: &Vector3<f64>,
    angle: f64,
) -> Option<(Vector3<f64>, Solid)> {
    let axis = Unit::try_new(*axis, 1e-9)?;
    let swing = Translation3::from(*at)
        * Isometry3::from_parts(Translation3::identity(), turn(&axis, angle))
        * Translation3::from(-at);
    let outside = |solid: &Solid| {
        solid
            .centre
            .iter()
            .zip(half.iter())
            .map(|(at, half)| at.abs() - half)
            .fold(f64::NEG_INFINITY, f64::max)
    };
    let along_hinge = |face: &Vector3<f64>| face.dot(&axis).abs() > 0.5;
    let next_to_hinge = |face: &Vector3<f64>| (face.dot(at) - face.abs().dot(half)).abs() < 0.02;
    let doors = faces().filter(|face| !along_hinge(face) && next_to_hinge(face));
    let doors = doors.map(|face| (face, wall(half, &face).moved(&swing)));
    doors.reduce(|best, next| if outside(&next.1) > outside(&best.1) + 1e-9 { next } else { best })
}
