//! Distances against parry3d, and what touches what on the built-in robots.

use glamx::{DPose3, DVec3};
use motet_geometry::KinematicTree;
use motet_geometry::collision::{CollisionModel, Shape, Solid};
use motet_robots::builtin;
use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use parry3d_f64::query;
use parry3d_f64::shape;
use proptest::prelude::*;

fn pose() -> impl Strategy<Value = Isometry3<f64>> {
    (prop::array::uniform3(-1.5..1.5_f64), prop::array::uniform3(-3.0..3.0_f64), 0..4_u8).prop_map(
        |(at, turn, kind)| {
            // Now and then parallel to the axes.
            let turn = if kind == 0 { [0.0; 3] } else { turn };
            Isometry3::from_parts(
                Translation3::from(Vector3::from(at)),
                UnitQuaternion::from_scaled_axis(Vector3::from(turn)),
            )
        },
    )
}

fn any_shape() -> impl Strategy<Value = Shape> {
    let size = 0.02..0.8_f64;
    prop_oneof![
        (size.clone(), size.clone(), size.clone()).prop_map(|(x, y, z)| Shape::Box(Vector3::new(x, y, z))),
        (size.clone(), size.clone()).prop_map(|(radius, half)| Shape::Cylinder { radius, half }),
        (size.clone(), size.clone()).prop_map(|(radius, half)| Shape::Capsule { radius, half }),
        size.prop_map(|radius| Shape::Capsule { radius, half: 0.0 }),
        Just(Shape::HalfSpace),
    ]
}

/// parry's own form of a shape.
fn theirs(shape: Shape, pose: &Isometry3<f64>) -> (DPose3, Box<dyn shape::Shape>) {
    let mut pose = *pose;
    let shape: Box<dyn shape::Shape> = match shape {
        Shape::Box(half) => Box::new(shape::Cuboid::new(DVec3::new(half.x, half.y, half.z))),
        Shape::Cylinder { radius, half } => {
            // parry's cylinder lies along y.
            pose *= UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::FRAC_PI_2);
            Box::new(shape::Cylinder::new(half, radius))
        }
        Shape::Capsule { radius, half: 0.0 } => Box::new(shape::Ball::new(radius)),
        Shape::Capsule { radius, half } => Box::new(shape::Capsule::new_z(half, radius)),
        Shape::HalfSpace => Box::new(shape::HalfSpace::new(DVec3::Z)),
    };
    (DPose3::from(pose), shape)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn distance_agrees_with_parry3d(
        (one, other) in (any_shape(), any_shape()), (here, there) in (pose(), pose()),
    ) {
        prop_assume!(one != Shape::HalfSpace || other != Shape::HalfSpace);
        let (a, b) = (Solid::new(&here, one), Solid::new(&there, other));
        let (ours, back) = (a.distance(&b), b.distance(&a));
        let (here, own) = theirs(one, &here);
        let (there, their) = theirs(other, &there);
        let oracle = query::distance(&here, own.as_ref(), &there, their.as_ref()).unwrap().distance;
        // Its search for curved shapes ends at about 1e-5 m.
        prop_assert!((ours.max(0.0) - oracle).abs() < 2e-4, "{ours} and {oracle}");
        prop_assert!((ours.max(0.0) - back.max(0.0)).abs() < 1e-6, "{ours} and {back}");
        for metres in [0.0, ours / 2.0, ours + 1e-6, 0.1] {
            prop_assert_eq!(a.is_farther(&b, metres), ours > metres);
        }
    }
}

fn robot(name: &str) -> (KinematicTree, CollisionModel) {
    let urdf = builtin::robot(name).unwrap().urdf;
    let tree = KinematicTree::new(&urdf);
    let body = CollisionModel::new(&urdf, &tree, &[]);
    (tree, body)
}

#[test]
fn collision_model_finds_self_collision() {
    let (tree, body) = robot("hsr");
    let mut configuration = tree.neutral();
    // The arm hangs straight down with its hand turned back against the base.
    for (joint, position) in [("arm_flex_joint", -2.6), ("arm_lift_joint", 0.1), ("wrist_flex_joint", -1.9)] {
        configuration[tree.dof(joint).unwrap()] = position;
    }
    let near = body.nearest_self_pair(&body.placed(&tree.root_from_links(&configuration))).unwrap();
    assert!(near.metres <= 0.0, "{near:?}");
}

/// The bounding boxes of the meshes of the Z1 gripper are published.
#[test]
#[ignore = "needs the reference data in ../shared/data"]
fn z1_jaw_solids_enclose_their_meshes() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data/robots/mesh_aabb.csv");
    let text = std::fs::read_to_string(path).unwrap();
    let urdf = builtin::robot("anymal_z1").unwrap().urdf;
    let tree = KinematicTree::new(&urdf);
    let body = CollisionModel::new(&urdf, &tree, &[]);
    let mut seen = 0;
    for row in text.lines().filter(|row| row.starts_with("z1,")) {
        let fields: Vec<&str> = row.split(',').collect();
        let Ok(link) = tree.link(fields[1]) else { continue };
        let number = |at: usize| fields[at].parse::<f64>().unwrap();
        for (axis, at) in [Vector3::x(), Vector3::y(), Vector3::z()].into_iter().zip(0..) {
            let parts = body.parts().iter().filter(|part| part.link == link).map(|part| &part.solid);
            let (low, high) = parts.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), solid| {
                let (middle, extent) = (solid.centre.dot(&axis), solid.extent(&axis));
                (low.min(middle - extent), high.max(middle + extent))
            });
            assert!(low <= number(4 + at) && number(7 + at) <= high, "{}: {low} to {high}", fields[1]);
            // And are no wider than they have to be.
            assert!(
                number(4 + at) - low < 0.003 && high - number(7 + at) < 0.003,
                "{}: {low} to {high}",
                fields[1]
            );
        }
        seen += 1;
    }
    assert_eq!(seen, 2);
}
