//! Finer poses lie close to every other.

use nalgebra::{Isometry3, Vector3};

use super::{FINE, POSES, finer};
use crate::collision::{Shape, Solid};
use crate::query::grasp::holds;
use crate::query::grip::Grips;
use crate::query::machine::Machine;

#[test]
fn every_hold_has_finer_ones_nearby() {
    let machine = Machine::embedded("hsr");
    let hand = machine.hand().unwrap();
    let shapes = [
        Shape::Capsule { radius: 0.03, half: 0.0 },
        Shape::Cylinder { radius: 0.03, half: 0.05 },
        Shape::Box(Vector3::new(0.03, 0.05, 0.08)),
    ];
    for shape in shapes {
        let thing = Solid::new(&Isometry3::translation(1.0, 0.2, 0.6), shape);
        let base = [0.0; 3];
        let fine = finer(&Grips::new(hand, &thing, None, base));
        let (coarse, _) = holds(hand, &thing, None, base);
        assert!(fine.len() >= 64 && fine.len() <= 2 * POSES[1], "{shape:?}: {}", fine.len());
        for hold in &coarse {
            // A point of the hand as far from the thing as the wrist is.
            let wrist =
                |pose: &Isometry3<f64>| pose * nalgebra::Point3::from(Vector3::from(hand.card.points) * -0.2);
            let far = |other: &Isometry3<f64>| {
                let tip = (hold.map_from_tip.translation.vector - other.translation.vector).norm();
                tip.max((wrist(&hold.map_from_tip) - wrist(other)).norm())
            };
            let least = fine.iter().map(|other| far(&other.map_from_tip)).fold(f64::INFINITY, f64::min);
            assert!(least < 4.0 * FINE[0], "{shape:?}: {least}");
        }
    }
}
