//! The solids of one link: what its URDF lists, without what is listed twice.

use motet_robots::urdf::{Link, UrdfShape};

use super::solid::{Shape, Solid};
use crate::kinematics::isometry;

/// A solid that a link carries.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LinkSolid {
    /// Index of the link.
    pub link: usize,
    /// The solid, in the link's frame.
    pub solid: Solid,
}

/// The parts of a link, and whether a mesh is left out.
///
/// URDFs write a capsule as a cylinder with a ball at each end, and so it becomes one again. A ball within another part
/// goes.
pub(super) fn parts(link: &Link, at: usize) -> (Vec<LinkSolid>, bool) {
    let mut solids: Vec<Solid> = Vec::new();
    let mut is_complete = true;
    for listed in &link.collisions {
        let shape = match listed.shape {
            UrdfShape::Box([x, y, z]) => Shape::Box([x / 2.0, y / 2.0, z / 2.0].into()),
            UrdfShape::Cylinder { radius, length } => Shape::Cylinder { radius, half: length / 2.0 },
            UrdfShape::Capsule { radius, length } => Shape::Capsule { radius, half: length / 2.0 },
            UrdfShape::Sphere { radius } => Shape::Capsule { radius, half: 0.0 },
            UrdfShape::Mesh { .. } => {
                is_complete = false;
                continue;
            }
        };
        solids.push(Solid::new(&isometry(&listed.link_from_shape), shape));
    }
    let rounded = solids.iter().map(|solid| with_round_ends(solid, &solids)).collect::<Vec<_>>();
    let is_needed = |(index, solid): &(usize, &Solid)| {
        let hides = |(other, larger): (usize, &Solid)| {
            other != *index
                && is_ball_within(solid, larger)
                && (other < *index || !is_ball_within(larger, solid))
        };
        !rounded.iter().enumerate().any(hides)
    };
    let kept =
        rounded.iter().enumerate().filter(is_needed).map(|(_, solid)| LinkSolid { link: at, solid: *solid });
    (kept.collect(), is_complete)
}

/// The capsule that a cylinder is together with the balls at its ends; else the solid as it is.
fn with_round_ends(solid: &Solid, all: &[Solid]) -> Solid {
    let Shape::Cylinder { radius, half } = solid.shape else { return *solid };
    let [_, _, z] = &solid.axes;
    let has_ball = |sign: f64| {
        let end = solid.centre + z * (half * sign);
        all.iter().any(|ball| match ball.shape {
            Shape::Capsule { radius: wide, half: 0.0 } => {
                wide + 1e-6 >= radius && (ball.centre - end).norm() <= wide - radius + 1e-6
            }
            Shape::Capsule { .. } | Shape::Box(_) | Shape::Cylinder { .. } | Shape::HalfSpace => false,
        })
    };
    // The millionth of a metre above is made up for.
    let shape = Shape::Capsule { radius: radius + 2e-6, half };
    if has_ball(-1.0) && has_ball(1.0) { Solid { shape, ..*solid } } else { *solid }
}

fn is_ball_within(solid: &Solid, larger: &Solid) -> bool {
    let Shape::Capsule { radius, half: 0.0 } = solid.shape else { return false };
    let Shape::Capsule { radius: wide, half } = larger.shape else { return false };
    let [_, _, z] = &larger.axes;
    let between = solid.centre - larger.centre;
    let along = between.dot(z).clamp(-half, half);
    (between - z * along).norm() + radius <= wide
}
