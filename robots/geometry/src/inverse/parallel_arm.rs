//! Closed form for six revolute joints of which the second to fourth are parallel and the last two meet in a
//! point, such as the arms of Universal Robots and the Unitree Z1: at most eight solutions.
//!
//! Rotations about the parallel axes leave components along them unchanged. So the intersection of the last
//! two axes gives the first joint, and the orientation gives the fifth and then the sixth; the rest is a
//! planar arm of two links (after Hawkins 2013, and Elias and Wen 2022, without Denavit–Hartenberg
//! parameters).
//!
//! Cells exist for an arm that is upright on a mobile base, with the parameters heading of the plane of the
//! parallel joints in the map frame, angle of the forearm in that plane, and yaw of the base, for each branch
//! of wrist and elbow.
//!
//! The heading leaves a rotation that the sum of the parallel joints and the last two joints make up, as a
//! wrist does. The angle of the forearm fixes the elbow; its height relative to the shoulder gives the angle
//! of the upper arm. The base is then on the circle about the first axis.

use std::f64::consts::PI;

use nalgebra::{Isometry3, Unit, UnitQuaternion, Vector3};

use super::interval::{
    CellEnclosure, DisplacementBound, IkCell, IntervalSolution, PoseSet, based, carried_wrist_interval,
    dof_intervals, frames, wave,
};
use super::numeric::polished;
use super::screw::{
    ROUNDED, Screw, angle_between, component, drives_each, screws, sum_of_waves, turned, within,
};
use crate::kinematics::KinematicChain;
use crate::trigonometry::{acos, atan2, turn};

/// Solver for one arm.
#[derive(Clone, PartialEq, Debug)]
pub struct ParallelArm {
    pub(super) chain: KinematicChain,
    /// Directions of the six axes at positions 0, in the frame of the base.
    pub(super) axes: [Vector3<f64>; 6],
    /// Sign of each parallel joint: 1 if it turns with the second axis, −1 if against it.
    pub(super) signs: [f64; 3],
    /// Point on the first axis.
    pub(super) first: Vector3<f64>,
    /// From that point to the second axis, from axis to axis, and from the fourth axis to the intersection of
    /// the last two.
    pub(super) offsets: [Vector3<f64>; 4],
    /// Intersection of the last two axes, in the frame of the tip.
    pub(super) centre_in_tip: Vector3<f64>,
    /// Rotation of the tip at positions 0, in the frame of the base.
    pub(super) base_from_tip: UnitQuaternion<f64>,
}

impl ParallelArm {
    /// Solver for the chain; `None` if its axes do not have this arrangement.
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

    /// Kinematic chain of the arm.
    #[must_use]
    pub fn chain(&self) -> &KinematicChain {
        &self.chain
    }

    /// All solutions within the limits, in a fixed order, as values of the degrees of freedom; of those that
    /// differ by full turns the nearest to 0. If the last axis is parallel to the inner three, the members
    /// with the last joint at 0 represent the family.
    #[must_use]
    pub fn solve(&self, base_from_tip: &Isometry3<f64>) -> Vec<[f64; 6]> {
        let positions = self.positions(base_from_tip);
        let found = positions.iter().filter_map(|positions| self.values(positions, &[0.0; 6]));
        found.filter_map(|values| self.confirmed(values, base_from_tip)).collect()
    }

    /// Solution within the limits that is nearest to `to`, by the largest difference of one value.
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

    /// Checks whether a joint allows a position, or one that differs by full turns.
    fn may_be(&self, joint: usize, position: f64) -> bool {
        let known = self.chain.joints.get(joint).zip(self.chain.dofs.get(joint));
        known.is_some_and(|(joint, dof)| {
            within(dof, (position - joint.coupling.offset) / joint.coupling.multiplier, 0.0).is_some()
        })
    }

    /// Joint positions up to full turns; the first, the fifth and the sixth, on which the others depend, are
    /// within their limits.
    fn positions(&self, base_from_tip: &Isometry3<f64>) -> Vec<[f64; 6]> {
        let [h1, h, _, _, h5, h6] = &self.axes;
        let [to_two, to_three, to_four, to_centre] = &self.offsets;
        let centre = base_from_tip * nalgebra::Point3::from(self.centre_in_tip);
        let from_first = centre.coords - self.first;
        // Most requests are out of reach, which this test shows quickly.
        let reach: f64 = self.offsets.iter().map(Vector3::norm).sum();
        if from_first.norm() > reach + 1e-6 {
            return vec![];
        }
        let turned_by = base_from_tip.rotation * self.base_from_tip.inverse();
        let along = h.dot(&(to_two + to_three + to_four + to_centre));
        let mut found = Vec::new();
        // Rotating the point back by the first joint is rotating it by minus its angle.
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

    /// Values within the limits for joint positions; of those that differ by full turns the nearest to `to`.
    fn values(&self, positions: &[f64; 6], to: &[f64; 6]) -> Option<[f64; 6]> {
        let mut values = *to;
        let joints = self.chain.joints.iter().zip(&self.chain.dofs).zip(positions);
        for (slot, ((joint, dof), q)) in values.iter_mut().zip(joints) {
            *slot = within(dof, (q - joint.coupling.offset) / joint.coupling.multiplier, *slot)?;
        }
        Some(values)
    }
}

impl ParallelArm {
    /// Cells that contain all solutions for any place of the base; none if the arm is not upright or its axes
    /// are not perpendicular.
    pub(crate) fn cells(&self) -> Vec<IkCell> {
        let [up, across, _, _, five, six] = &self.axes;
        let is_square = up.z > 1.0 - ROUNDED * ROUNDED
            && [(up, across), (across, five), (five, six)].iter().all(|(a, b)| a.dot(b).abs() < ROUNDED);
        let ways = if is_square { 0..4 } else { 0..0 };
        ways.map(|branch| IkCell { branch, middle: [0.0; 3], half: [PI; 3] }).collect()
    }

    /// Approximate displacement, in m, per unit of each parameter of a cell.
    pub(crate) fn weights(&self) -> [f64; 3] {
        let [_, upper, fore, _] = self.offsets.map(|offset| offset.norm());
        [upper + fore, upper, 0.25 * upper]
    }

    /// Encloses all solutions of a cell, with the base at a height above the floor.
    pub(crate) fn enclose(&self, tips: &PoseSet, height: f64, cell: &IkCell) -> IntervalSolution {
        let map_from_tip = &tips.map_from_tip;
        let ([heading, lean, yaw], [headings, leans, yaws]) = (cell.middle, cell.half);
        let [_, across, _, _, five, six] = self.axes;
        let [to_two, to_three, to_four, to_centre] = self.offsets;
        let centre = (map_from_tip * nalgebra::Point3::from(self.centre_in_tip)).coords;
        // The centre of the wrist is uncertain as well, and so is the rotation of the hand.
        let (moves, tilts) = (tips.displacement.along(&centre, &Vector3::z()), tips.displacement.angle());
        let facing = crate::trigonometry::turn(&Vector3::z_axis(), heading);
        let left = facing.inverse() * map_from_tip.rotation * self.base_from_tip.inverse();
        let carrier = DisplacementBound::none().spun(Vector3::z(), Vector3::zeros(), headings);
        let (turns, displacements) = ([&facing, &left], [&carrier, &tips.displacement.turning()]);
        let Some([[sum, sums], fifth, sixth]) =
            carried_wrist_interval(&[across, five, six], turns, displacements, cell.branch & 1)
        else {
            return IntervalSolution::Unknown;
        };
        // Vectors from the elbow and from the fourth axis on, and the upper arm at position 0.
        let (end, fore) = (turned(&across, sum, &to_centre), turned(&across, lean, &to_four));
        let [end_long, fore_long, long] =
            [&to_centre, &to_four, &to_three].map(|vector| across.cross(vector).norm());
        let rises = wave(across.cross(&end).z, end_long, sums)
            + wave(across.cross(&fore).z, fore_long, leans)
            + moves;
        let rise = centre.z - height - self.first.z - to_two.z - end.z - fore.z;
        let (low, high) = ((rise - rises) / long, (rise + rises) / long);
        if !tips.is_any && (low > 1.0 + ROUNDED || high < -1.0 - ROUNDED) {
            return IntervalSolution::Empty;
        }
        let (least, greatest) = (acos(high), acos(low));
        let ahead = across.cross(&Vector3::z());
        let upright = atan2(to_three.dot(&ahead), to_three.z);
        let sign = if cell.branch & 2 == 0 { 1.0 } else { -1.0 };
        let (raise, raises) = (sign * (least + greatest) / 2.0 - upright, (greatest - least) / 2.0 + 1e-7);
        let upper = turned(&across, raise, &to_three);
        let [_, third, fourth] = self.signs;
        let positions = [
            [heading - yaw, headings + yaws],
            [raise, raises],
            [third * (lean - raise), leans + raises],
            [fourth * (sum - lean), sums + leans],
            fifth,
            sixth,
        ];
        let Some(values) = dof_intervals(&self.chain, &positions, tips.is_any) else {
            return IntervalSolution::Empty;
        };
        // Back from the centre of the wrist to the first axis.
        let four = centre - facing * end;
        let elbow = four - facing * fore;
        let first = elbow - facing * (upper + to_two);
        let from_base = turned(&Vector3::z(), yaw, &self.first);
        let base = [first.x - from_base.x, first.y - from_base.y, yaw];
        let mut placed = frames(&self.chain, based(base, first.z - from_base.z), &values);
        // The height of the shoulder is fixed, whatever the middle of the angles of the upper arm.
        if let Some(pose) = placed.first_mut() {
            pose.translation.z += height + from_base.z - first.z;
        }
        let roll = self.chain.joints.get(5).zip(placed.get(5));
        let axis = roll.map_or(Vector3::z(), |(joint, pose)| pose * joint.axis.into_inner());
        let [_, rolls] = sixth;
        // Everything in the plane of the arm rotates about one direction.
        let aside = facing * across;
        let square = |vector: &Vector3<f64>| facing * (vector - across * across.dot(vector));
        let held = tips.displacement.carried(&centre);
        let heads = |displacement: DisplacementBound| displacement.spun(Vector3::z(), centre, headings);
        let wrist = held.swung(&aside, &square(&end), sums);
        let forearm = wrist.swung(&aside, &square(&fore), leans);
        let shoulder = forearm.swung(&aside, &square(&upper), raises).level();
        let displacements = [
            heads(shoulder),
            heads(forearm.spun(aside, elbow, raises)),
            heads(wrist.spun(aside, four, leans)),
            heads(held.spun(aside, centre, sums)),
            held.turned(centre, tilts).spun(axis, centre, rolls),
            tips.displacement,
        ];
        // The base rotates about the first axis, which moves about the centre of the wrist.
        let out = first - centre;
        let out = Vector3::new(out.x, out.y, 0.0);
        let more = headings.min(2.0) * shoulder.point(&first, 0.0);
        let base_displacement = shoulder.swung(&Vector3::z(), &out, headings).shifted(more).level();
        IntervalSolution::Enclosed(Box::new(CellEnclosure {
            base,
            base_displacement: base_displacement.spun(Vector3::z(), first, yaws),
            frames: placed.into_iter().zip(displacements).collect(),
            values,
            short: [rise.abs() - long, rises],
            is_joined: false,
        }))
    }
}
