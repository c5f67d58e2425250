//! Closed form for seven turning joints: three that meet in a shoulder, an elbow, two that meet in a wrist, and a last one that may
//! stand off from them, as the Franka arms have it. The last joint is the free parameter; there are at most eight solutions for
//! each of its values.
//!
//! With the last joint known the place of the wrist is, and its distance from the shoulder gives the elbow. The fifth axis is square to
//! the sixth, which is known, and leans against the line from the shoulder to the wrist as the elbow says, which gives the sixth
//! joint. Both directions then give the orientation of the shoulder (after He and Liu 2021, without Denavit–Hartenberg
//! parameters).

use nalgebra::{Isometry3, Matrix3, Rotation3, Unit, UnitQuaternion, Vector3};

use super::lift_arm::wrist;
use super::numeric::polished;
use super::screw::{ROUNDED, Screw, drives_each, screws};
use super::subproblem::{angle_between, component, sum_of_waves, turned, within};
use crate::kinematics::{Dof, KinematicChain};
use crate::trigonometry::turn;

/// The solver of one arm.
#[derive(Clone, PartialEq, Debug)]
pub struct SevenArm {
    pub(super) chain: KinematicChain,
    /// Directions of the axes at positions 0, in the base's frame.
    pub(super) axes: [Vector3<f64>; 7],
    /// Where the first three axes meet.
    pub(super) shoulder: Vector3<f64>,
    /// A point on the fourth axis, as far along it as the shoulder.
    pub(super) elbow: Vector3<f64>,
    /// Where the fifth and the sixth axis meet.
    pub(super) wrist: Vector3<f64>,
    /// A point on the seventh axis.
    pub(super) last: Vector3<f64>,
    /// The tip at positions 0, in the base's frame.
    pub(super) base_from_tip: Isometry3<f64>,
}

impl SevenArm {
    /// The solver, where the chain is of this kind.
    #[must_use]
    pub fn detect(chain: &KinematicChain) -> Option<Self> {
        if chain.joints.iter().any(|joint| joint.is_prismatic) || !drives_each(chain) {
            return None;
        }
        let (axes, base_from_tip) = screws(chain);
        let axes = <[Screw; 7]>::try_from(axes).ok()?;
        let [one, two, three, four, five, six, seven] = &axes;
        let shoulder = one.meeting(two).filter(|place| three.contains(place))?;
        let wrist = five.meeting(six)?;
        let square = |a: &Vector3<f64>, b: &Vector3<f64>| a.dot(b).abs() < ROUNDED;
        let bends = four.direction;
        let is_square = square(&one.direction, &two.direction)
            && square(&two.direction, &three.direction)
            && square(&five.direction, &six.direction)
            && square(&bends, &five.direction)
            && square(&bends, &(wrist - shoulder));
        let elbow = four.point + bends * bends.dot(&(shoulder - four.point));
        let is_arm = (elbow - shoulder).norm() > 0.01 && (elbow - wrist).norm() > 0.01;
        (is_square && is_arm).then(|| Self {
            chain: chain.clone(),
            axes: axes.map(|axis| axis.direction),
            shoulder,
            elbow,
            wrist,
            last: seven.point,
            base_from_tip,
        })
    }

    /// The chain that it solves.
    #[must_use]
    pub fn chain(&self) -> &KinematicChain {
        &self.chain
    }

    /// Values of the last joint's variable that stand for all others.
    pub(crate) fn last_span(&self) -> (f64, f64) {
        self.chain.dofs.last().map_or((0.0, 0.0), Dof::sampling_range)
    }

    /// Every solution within the limits with the given value of the last joint's variable, in a fixed order: values of the chain's
    /// variables. Where the arm is stretched out or an axis does not matter, a family is stood for by some of it.
    #[must_use]
    pub fn solve(&self, base_from_tip: &Isometry3<f64>, last: f64) -> Vec<[f64; 7]> {
        let found = self.unconfirmed(base_from_tip, last);
        found.into_iter().filter_map(|values| self.confirmed(values, base_from_tip)).collect()
    }

    /// Solutions with the last joint's variable at any of some values, the nearest to other values of all variables first, by the
    /// squares of their differences: at most `most`.
    #[must_use]
    pub fn nearest(
        &self,
        base_from_tip: &Isometry3<f64>,
        lasts: &[f64],
        to: &[f64],
        most: usize,
    ) -> Vec<[f64; 7]> {
        let far = |values: &[f64; 7]| {
            values.iter().zip(to).map(|(one, other)| (one - other) * (one - other)).sum::<f64>()
        };
        let found = lasts.iter().flat_map(|last| self.unconfirmed(base_from_tip, *last));
        let mut found: Vec<(f64, [f64; 7])> = found.map(|values| (far(&values), values)).collect();
        found.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        let confirmed = found.into_iter().filter_map(|(_, values)| self.confirmed(values, base_from_tip));
        confirmed.take(most).collect()
    }

    /// Values within the limits that forward kinematics has yet to confirm.
    fn unconfirmed(&self, base_from_tip: &Isometry3<f64>, last: f64) -> Vec<[f64; 7]> {
        let Some((joint, dof)) = self.chain.joints.last().zip(self.chain.dofs.last()) else {
            return vec![];
        };
        if !dof.allows(last) {
            return vec![];
        }
        let angle = joint.coupling.multiplier * last + joint.coupling.offset;
        let positions = self.positions(base_from_tip, angle);
        positions.iter().filter_map(|angles| self.values(angles, last)).collect()
    }

    fn confirmed(&self, values: [f64; 7], base_from_tip: &Isometry3<f64>) -> Option<[f64; 7]> {
        polished(&self.chain, values, base_from_tip).filter(|values| self.chain.allows(values))
    }

    /// Positions of the first six joints, up to full turns, regardless of limits.
    fn positions(&self, base_from_tip: &Isometry3<f64>, last: f64) -> Vec<[f64; 6]> {
        let [h1, h2, h3, h4, h5, h6, h7] = &self.axes;
        // The motion that the first six joints make together.
        let moved = base_from_tip * self.base_from_tip.inverse();
        let back = turn(&Unit::new_unchecked(*h7), -last);
        let rotation = moved.rotation * back;
        let place = |point: &Vector3<f64>| {
            moved.rotation * (self.last + back * (point - self.last)) + moved.translation.vector
        };
        let reached = place(&self.wrist) - self.shoulder;
        let (upper, fore) = (self.shoulder - self.elbow, self.wrist - self.elbow);
        let c = (upper.norm_squared() + fore.norm_squared() - reached.norm_squared()) / 2.0;
        let elbows = sum_of_waves(upper.dot(&fore), upper.dot(&h4.cross(&fore)), c);
        let mut found = Vec::new();
        for q4 in elbows.into_iter().flatten() {
            let to_wrist = turned(h4, q4, &fore) - upper;
            let leaning = turned(h4, q4, h5);
            let seen = rotation.inverse() * reached;
            let Some(sixths) = component(h6, h5, &seen, leaning.dot(&to_wrist)) else { continue };
            for q6 in sixths.map(|angle| -angle) {
                let fifth = rotation * turned(h6, -q6, h5);
                let Some(shoulder) = between([&to_wrist, &leaning], [&reached, &fifth]) else { continue };
                let rest = (shoulder * turn(&Unit::new_unchecked(*h4), q4)).inverse()
                    * rotation
                    * turn(&Unit::new_unchecked(*h6), -q6);
                let q5 = angle_between(h5, h6, &(rest * h6));
                for [q1, q2, q3] in wrist(&[*h1, *h2, *h3], &shoulder) {
                    found.push([q1, q2, q3, q4, q5, q6]);
                }
            }
        }
        found
    }

    /// Values within the limits that stand for the positions, of those that differ by full turns the nearest to 0.
    fn values(&self, angles: &[f64; 6], last: f64) -> Option<[f64; 7]> {
        let mut values = [last; 7];
        let joints = self.chain.joints.iter().zip(&self.chain.dofs);
        for ((slot, angle), (joint, dof)) in values.iter_mut().zip(angles).zip(joints) {
            let value = (angle - joint.coupling.offset) / joint.coupling.multiplier;
            *slot = within(dof, value, 0.0)?;
        }
        Some(values)
    }
}

/// The rotation that takes a direction to another, and a second one with it; `None` where they are along each other.
pub(super) fn between(from: [&Vector3<f64>; 2], to: [&Vector3<f64>; 2]) -> Option<UnitQuaternion<f64>> {
    let frame = |[along, beside]: [&Vector3<f64>; 2]| {
        let first = along / along.norm();
        let third = first.cross(beside);
        let long = third.norm();
        (long > 1e-9).then(|| {
            let third = third / long;
            Matrix3::from_columns(&[first, third.cross(&first), third])
        })
    };
    let turned = frame(to)? * frame(from)?.transpose();
    Some(UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(turned)))
}
