//! Distances against parry3d.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use glamx::{DPose3, DVec3};
use motet_geometry::collision::{Capsule, Obstacle, ObstacleShape};
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use parry3d_f64::query;
use parry3d_f64::shape::{self, Shape};
use proptest::prelude::*;

fn point() -> impl Strategy<Value = Point3<f64>> {
    prop::array::uniform3(-2.0..2.0_f64).prop_map(|[x, y, z]| Point3::new(x, y, z))
}

fn pose() -> impl Strategy<Value = Isometry3<f64>> {
    (point(), prop::array::uniform3(-3.0..3.0_f64)).prop_map(|(at, turn)| {
        Isometry3::from_parts(
            Translation3::from(at.coords),
            UnitQuaternion::from_scaled_axis(Vector3::from(turn)),
        )
    })
}

fn capsule() -> impl Strategy<Value = Capsule> {
    (point(), point(), 0.01..0.4_f64, 0..4_u8).prop_map(|(one, other, radius, kind)| Capsule {
        // Now and then a sphere, or parallel to an axis.
        ends: match kind {
            0 => [one, one],
            1 => [one, Point3::new(one.x, one.y, other.z)],
            _ => [one, other],
        },
        radius,
    })
}

fn shape() -> impl Strategy<Value = ObstacleShape> {
    let size = 0.02..1.0_f64;
    prop_oneof![
        (size.clone(), size.clone(), size.clone())
            .prop_map(|(x, y, z)| ObstacleShape::Box(Vector3::new(x, y, z))),
        (size.clone(), size.clone()).prop_map(|(radius, half)| ObstacleShape::Cylinder { radius, half }),
        (size.clone(), size).prop_map(|(radius, half)| ObstacleShape::Capsule { radius, half }),
    ]
}

fn vector(point: &Point3<f64>) -> DVec3 {
    DVec3::new(point.x, point.y, point.z)
}

/// parry's distance; 0 where they overlap.
fn oracle(capsule: &Capsule, obstacle: &Obstacle) -> f64 {
    let [one, other] = &capsule.ends;
    let own: Box<dyn Shape> = if one == other {
        Box::new(shape::Ball::new(capsule.radius))
    } else {
        Box::new(shape::Capsule::new(vector(one), vector(other), capsule.radius))
    };
    let at =
        if one == other { Isometry3::from(Translation3::from(one.coords)) } else { Isometry3::identity() };
    let mut pose = obstacle.map_from_shape;
    let theirs: Box<dyn Shape> = match obstacle.shape {
        ObstacleShape::Box(half) => Box::new(shape::Cuboid::new(DVec3::new(half.x, half.y, half.z))),
        ObstacleShape::Cylinder { radius, half } => {
            // parry's cylinder lies along y.
            pose *= UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::FRAC_PI_2);
            Box::new(shape::Cylinder::new(half, radius))
        }
        ObstacleShape::Capsule { radius, half } => Box::new(shape::Capsule::new_z(half, radius)),
        ObstacleShape::HalfSpace => Box::new(shape::HalfSpace::new(DVec3::Z)),
    };
    query::distance(&DPose3::from(at), own.as_ref(), &DPose3::from(pose), theirs.as_ref()).unwrap().distance
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn distances_are_those_of_the_oracle(capsule in capsule(), shape in shape(), map_from_shape in pose()) {
        let obstacle = Obstacle { map_from_shape, shape };
        let (ours, theirs) = (capsule.to_obstacle(&obstacle), oracle(&capsule, &obstacle));
        // Its search for curved shapes ends at about 1e-5 m.
        prop_assert!((ours.max(0.0) - theirs).abs() < 1e-4, "{ours} and {theirs}");
    }

    #[test]
    fn two_capsules_are_as_far_either_way(one in capsule(), other in capsule(), by in pose()) {
        let distance = one.to_capsule(&other);
        prop_assert!((distance - other.to_capsule(&one)).abs() < 1e-9);
        prop_assert!((distance - one.moved(&by).to_capsule(&other.moved(&by))).abs() < 1e-9);
    }
}
