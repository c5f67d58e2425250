//! Closed form for six turning joints of which the second to fourth are parallel and the last two meet in a point, such
//! as the arms of Universal Robots and the Unitree Z1: at most eight solutions.
//!
//! Turning about the parallel axes leaves components along them alone. The place of the point where the last two axes
//! meet so gives the first joint, the orientation the fifth and then the sixth; what is left is a planar arm of two
//! links (after Hawkins 2013, and Elias and Wen 2022, without Denavit–Hartenberg parameters).

use nalgebra::{Isometry3, Unit, UnitQuaternion, Vector3};

use super::numeric::polished;
use super::screw::{Screw, drives_each, screws};
use super::subproblem::{angle_between, component, sum_of_waves, turned, within};
use crate::kinematics::KinematicChain;
use crate::trigonometry::turn;

/// The solver of one arm.
#[derive(Clone, PartialEq, Debug)]
pub struct ParallelArm {
    pub(super) chain: KinematicChain,
    /// Directions of the six axes at positions 0, in the base's frame.
    pub(super) axes: [Vector3<f64>; 6],
    /// For the parallel joints 1 where they turn with the second axis, −1 where against it.
    pub(super) signs: [f64; 3],
    /// A point on the first axis.
    pub(super) first: Vector3<f64>,
    /// From that point to the second axis, from axis to axis, and from the fourth to where the last two meet.
    pub(super) offsets: [Vector3<f64>; 4],
    /// That point, in the tip's frame.
    pub(super) centre_in_tip: Vector3<f64>,
    /// The tip's rotation at positions 0, in the base's frame.
    pub(super) base_from_tip: UnitQuaternion<f64>,
}

impl ParallelArm {
    /// The solver, where the chain is of this kind.
    #[must_use]
    pub fn detect(chain: &KinematicChain) -> Option<Self> {
        if chain.joints.iter().any(|joint| joint.is_prismatic) || !drives_each(chain) {
            return None;
        }
        let (axes, tip) = screws(chain);
        let axes = <[Screw; 6]>::try_from(axes).ok()?;
        let [one, two, three, four, five, six] = &axes;
        if !two.is_parallel(three) || !two.is_parallel(four) || one.is_parallel(two) || five.is_parallel(four)
        {
            return None;
        }
        let centre = five.meeting(six)?;
        let sign = |axis: &Screw| two.direction.dot(&axis.direction).signum();
        Some(Self {
            chain: chain.clone(),
            axes: [one, two, three, four, five, six].map(|axis| axis.direction),
            signs: [1.0, sign(three), sign(four)],
            first: one.point,
            offsets: [
                two.point - one.point,
                three.point - two.point,
                four.point - three.point,
                centre - four.point,
            ],
            centre_in_tip: tip.inverse_transform_vector(&(centre - tip.translation.vector)),
            base_from_tip: tip.rotation,
        })
    }

    /// The chain that it solves.
    #[must_use]
    pub fn chain(&self) -> &KinematicChain {
        &self.chain
    }

    /// Every solution within the limits, in a fixed order: values of the chain's variables, of those that differ by full turns the
    /// nearest to 0. Where the last axis is parallel to the inner three, a family of solutions is stood for by those with the last
    /// joint at 0.
    #[must_use]
    pub fn solve(&self, base_from_tip: &Isometry3<f64>) -> Vec<[f64; 6]> {
        let positions = self.positions(base_from_tip);
        let found = positions.iter().filter_map(|positions| self.values(positions, &[0.0; 6]));
        found.filter_map(|values| self.confirmed(values, base_from_tip)).collect()
    }

    /// The solution within the limits that is nearest to some values, by the largest difference of one.
    #[must_use]
    pub fn nearest(&self, base_from_tip: &Isometry3<f64>, to: &[f64; 6]) -> Option<[f64; 6]> {
        let mut best: Option<(f64, [f64; 6])> = None;
        for positions in self.positions(base_from_tip) {
            let Some(values) = self.values(&positions, to) else { continue };
            let far = values.iter().zip(to).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max);
            if best.is_none_or(|(known, _)| far < known) {
                best = Some((far, values));
            }
        }
        self.confirmed(best?.1, base_from_tip)
    }

    fn confirmed(&self, values: [f64; 6], base_from_tip: &Isometry3<f64>) -> Option<[f64; 6]> {
        polished(&self.chain, values, base_from_tip).filter(|values| self.chain.allows(values))
    }

    /// Whether a joint may be at a position, or at one that differs by full turns.
    fn may_be(&self, joint: usize, position: f64) -> bool {
        let known = self.chain.joints.get(joint).zip(self.chain.dofs.get(joint));
        known.is_some_and(|(joint, dof)| {
            within(dof, (position - joint.coupling.offset) / joint.coupling.multiplier, 0.0).is_some()
        })
    }

    /// Joint positions, up to full turns, with the first, the fifth and the sixth within their limits, on which the others turn.
    fn positions(&self, base_from_tip: &Isometry3<f64>) -> Vec<[f64; 6]> {
        let [h1, h, _, _, h5, h6] = &self.axes;
        let [to_two, to_three, to_four, to_centre] = &self.offsets;
        let centre = base_from_tip * nalgebra::Point3::from(self.centre_in_tip);
        let from_first = centre.coords - self.first;
        // Most of what is asked for is out of reach, and that is quickly seen.
        let reach: f64 = self.offsets.iter().map(Vector3::norm).sum();
        if from_first.norm() > reach + 1e-6 {
            return vec![];
        }
        let turned_by = base_from_tip.rotation * self.base_from_tip.inverse();
        let along = h.dot(&(to_two + to_three + to_four + to_centre));
        let mut found = Vec::new();
        // Turning the point back by the first joint is turning it by minus its angle.
        for q1 in component(h1, &from_first, h, along).into_iter().flatten().map(|angle| -angle) {
            if !self.may_be(0, q1) {
                continue;
            }
            let back = turn(&Unit::new_unchecked(*h1), -q1);
            let rotation = back * turned_by;
            let Some(fifths) = component(h5, h6, h, h.dot(&(rotation * h6))) else { continue };
            for q5 in fifths {
                if !self.may_be(4, q5) {
                    continue;
                }
                let q6 = angle_between(h6, &(rotation.inverse() * h), &turned(h5, -q5, h));
                if !self.may_be(5, q6) {
                    continue;
                }
                let rest =
                    rotation * turn(&Unit::new_unchecked(*h6), -q6) * turn(&Unit::new_unchecked(*h5), -q5);
                let side = h1.cross(h);
                let sum = angle_between(h, &side, &(rest * side));
                let planar = back * from_first - to_two - turned(h, sum, to_centre);
                let planar = planar - h * h.dot(&planar);
                let (upper, fore) = (to_three - h * h.dot(to_three), to_four - h * h.dot(to_four));
                // |planar|² = |upper + fore turned by q3|²
                let c = (planar.norm_squared() - upper.norm_squared() - fore.norm_squared()) / 2.0;
                let elbows = sum_of_waves(upper.dot(&fore), upper.dot(&h.cross(&fore)), c);
                for q3 in elbows.into_iter().flatten() {
                    let q2 = angle_between(h, &(upper + turned(h, q3, &fore)), &planar);
                    let [_, s3, s4] = self.signs;
                    found.push([q1, q2, s3 * q3, s4 * (sum - q2 - q3), q5, q6]);
                }
            }
        }
        found
    }

    /// Values within the limits that stand for positions, of those that differ by full turns the nearest to some.
    fn values(&self, positions: &[f64; 6], to: &[f64; 6]) -> Option<[f64; 6]> {
        let mut values = *to;
        let joints = self.chain.joints.iter().zip(&self.chain.dofs).zip(positions);
        for (slot, ((joint, dof), q)) in values.iter_mut().zip(joints) {
            *slot = within(dof, (q - joint.coupling.offset) / joint.coupling.multiplier, *slot)?;
        }
        Some(values)
    }
}
