//! All grips that a search goes through are in some patch.

use nalgebra::{Isometry3, Vector3};

use crate::collision::{Shape, Solid};
use crate::inverse::interval::DisplacementBound;
use crate::planning::grasp::candidates::grasp_candidates;
use crate::planning::grasp::manifold::GraspManifold;
use crate::planning::query::answer::GraspSide;
use crate::planning::scene::robot_model::RobotModel;

/// Grips that a search goes through are where the patches say.
#[test]
fn a_grip_is_in_its_patch() {
    let model = RobotModel::embedded("hsr");
    let hand = model.hand().unwrap();
    let shapes = [
        Shape::Cylinder { radius: 0.03, half: 0.08 },
        Shape::Cylinder { radius: 0.05, half: 0.02 },
        Shape::Capsule { radius: 0.03, half: 0.06 },
        Shape::Capsule { radius: 0.04, half: 0.0 },
        Shape::Box(Vector3::new(0.02, 0.05, 0.09)),
    ];
    let lean = nalgebra::UnitQuaternion::from_euler_angles(0.4, 0.2, 1.0);
    let upright = nalgebra::UnitQuaternion::from_euler_angles(0.0, 0.0, 1.0);
    for (shape, rotation) in shapes.into_iter().flat_map(|shape| [(shape, upright), (shape, lean)]) {
        let pose = Isometry3::from_parts(nalgebra::Translation3::new(1.0, 0.3, 0.8), rotation);
        let object = Solid::new(&pose, shape);
        for side in [None, Some(GraspSide::Top), Some(GraspSide::Side), Some(GraspSide::Front)] {
            let manifold = GraspManifold::new(hand, &object, side, [0.0; 3]);
            let (holds, _) = grasp_candidates(hand, &object, side, [0.0; 3]);
            assert!(side.is_some() || !holds.is_empty(), "{shape:?}");
            // Small ones, so that how far they say they go is not more than a hand is long.
            let (mut open, mut patches) = (manifold.patches(), vec![]);
            while let Some(patch) = open.pop() {
                let (size, across) = manifold.widest(&patch);
                if size > 0.08 {
                    open.extend(patch.halves(across));
                } else {
                    patches.push(patch);
                }
            }
            let tips: Vec<_> = patches.iter().filter_map(|patch| manifold.over(patch)).collect();
            for hold in &holds {
                let is_in = |(tip, drift): &(Isometry3<f64>, DisplacementBound)| {
                    [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()].iter().all(|at| {
                        let at = nalgebra::Point3::from(at * 0.2);
                        let (one, other) = (hold.map_from_tip * at, tip * at);
                        let ball = Shape::Capsule { radius: 0.0, half: 0.0 };
                        let place = Isometry3::from_parts(other.coords.into(), upright);
                        (one - other).norm() <= drift.of(&Solid::new(&place, ball)) + 1e-6
                    })
                };
                assert!(tips.iter().any(is_in), "{shape:?}, {side:?}: {hold:?}");
            }
        }
    }
}

/// What is taken of a bar in steps is where the patches of all grips of it say.
#[test]
fn a_grip_of_a_bar_is_in_its_patch() {
    let model = RobotModel::embedded("anymal_z1");
    let hand = model.hand().unwrap();
    let (along, out) = (Vector3::new(0.0, 0.6, 0.8), Vector3::x());
    let centre = Vector3::new(1.0, 0.2, 0.7);
    let bar = Solid {
        centre,
        axes: [out, along.cross(&out), along],
        shape: Shape::Capsule { radius: 0.008, half: 0.2 },
    };
    let manifold = GraspManifold::of_bar(hand, &bar, out, 0.03, [1.05, 0.6]);
    for (tilt, place, sign) in [(0.0, 0.0, 1.0), (0.9, 0.6, -1.0), (-0.52, -0.6, 1.0), (-0.9, 0.3, -1.0)] {
        let turned = nalgebra::UnitQuaternion::from_scaled_axis(along * tilt);
        let approach = turned * -out;
        let closes = along.cross(&approach) * sign;
        let at = centre + along * (place * 0.2) - approach * 0.03 - closes * hand.middle(0.016);
        let tip = Isometry3::from_parts(at.into(), hand.turned(&approach, &closes));
        let mut open = manifold.patches();
        for _ in 0..12 {
            let halves = open.iter().flat_map(|patch| patch.halves(manifold.widest(patch).1));
            open = halves.collect();
            open.retain(|patch| {
                let Some((other, drift)) = manifold.over(patch) else { return false };
                [Vector3::zeros(), Vector3::x(), Vector3::y()].iter().all(|point| {
                    let point = nalgebra::Point3::from(point * 0.2);
                    let (one, other) = (tip * point, other * point);
                    (one - other).norm() <= drift.point(&other.coords, 0.0) + 1e-6
                })
            });
        }
        assert!(!open.is_empty(), "{tilt}, {place}, {sign}");
    }
}
