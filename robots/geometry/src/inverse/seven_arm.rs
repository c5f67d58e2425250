//! Closed form for seven revolute joints: three that meet in a shoulder, an elbow, two that meet in a wrist,
//! and a last one that may be offset, as in the Franka arms. The last joint is the free parameter; there are
//! at most eight solutions for each of its values.
//!
//! The last joint fixes the place of the wrist, whose distance from the shoulder gives the elbow. The fifth
//! axis is perpendicular to the known sixth axis and at an angle to the line from shoulder to wrist that the
//! elbow fixes; this gives the sixth joint. Both directions then give the rotation of the shoulder (after He
//! and Liu 2021, without Denavit–Hartenberg parameters).
//!
//! Cells exist on a fixed base, with the position of the last joint as the parameter, for each branch of
//! elbow, wrist and shoulder.
//!
//! The last joint leaves the centre of the wrist and the side of the hand. The distance of the centre from
//! the shoulder gives the elbow, and so the angle of the fifth axis to the line between both; its place on
//! the circle perpendicular to the sixth axis gives the sixth joint. Both directions give the rotation of the
//! shoulder. Each interval follows from those before it, by the law of cosines and by the change of azimuth
//! of a direction about an axis.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, Unit, UnitQuaternion, Vector3};

use super::interval::{
    CellEnclosure, DisplacementBound, IkCell, IntervalSolution, PoseSet, azimuth, dof_intervals, frames,
    wrist_interval,
};
use super::numeric::polished;
use super::screw::{
    ROUNDED, Screw, angle_between, component, drives_each, screws, sum_of_waves, turned, within, wrist,
};
use crate::kinematics::{Dof, KinematicChain};
use crate::trigonometry::{acos, atan2, turn};

/// Solver for one arm.
#[derive(Clone, PartialEq, Debug)]
pub struct SevenArm {
    pub(super) chain: KinematicChain,
    /// Directions of the axes at positions 0, in the frame of the base.
    pub(super) axes: [Vector3<f64>; 7],
    /// Intersection of the first three axes.
    pub(super) shoulder: Vector3<f64>,
    /// Point on the fourth axis, at the height of the shoulder along it.
    pub(super) elbow: Vector3<f64>,
    /// Intersection of the fifth and the sixth axis.
    pub(super) wrist: Vector3<f64>,
    /// Point on the seventh axis.
    pub(super) last: Vector3<f64>,
    /// Pose of the tip at positions 0, in the frame of the base.
    pub(super) base_from_tip: Isometry3<f64>,
}

impl SevenArm {
    /// Solver for the chain; `None` if its axes do not have this arrangement.
    ///
    /// ```
    /// use motet_geometry::KinematicTree;
    /// use motet_geometry::inverse::SevenArm;
    /// use motet_geometry::kinematics::KinematicChain;
    /// use motet_robots::builtin;
    ///
    /// let tree = KinematicTree::new(&builtin::robot("panda").unwrap().urdf);
    /// let (base, tip) = (tree.link("panda_link0").unwrap(), tree.link("panda_hand").unwrap());
    /// let chain = KinematicChain::new(&tree, base, tip).unwrap();
    /// let arm = SevenArm::detect(&chain).unwrap();
    ///
    /// let values = [0.1, -0.5, 0.2, -2.0, 0.3, 1.8, 0.4];
    /// let solutions = arm.solve(&chain.base_from_tip(&values), 0.4);
    /// let is_near = |(one, other): (&f64, f64)| (one - other).abs() < 1e-6;
    /// assert!(solutions.iter().any(|found| found.iter().zip(values).all(is_near)));
    /// ```
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

    /// Kinematic chain of the arm.
    #[must_use]
    pub fn chain(&self) -> &KinematicChain {
        &self.chain
    }

    /// Range of values of the last joint that represents all others.
    pub(crate) fn last_span(&self) -> (f64, f64) {
        self.chain.dofs.last().map_or((0.0, 0.0), Dof::sampling_range)
    }

    /// Solves for a given value of the last joint: all solutions within the limits, in a fixed order, as
    /// values of the degrees of freedom. A family of solutions, as of a stretched arm, is represented by some
    /// of its members.
    #[must_use]
    pub fn solve(&self, base_from_tip: &Isometry3<f64>, last: f64) -> Vec<[f64; 7]> {
        let found = self.unconfirmed(base_from_tip, last);
        found.into_iter().filter_map(|values| self.confirmed(values, base_from_tip)).collect()
    }

    /// Solutions for several values of the last joint, nearest to `to` first (sum of squared differences), at
    /// most `most`.
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

    /// Values within the limits that forward kinematics has not confirmed yet.
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
        // Combined motion of the first six joints.
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

    /// Values within the limits for joint positions; of those that differ by full turns the nearest to 0.
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

/// Rotation that takes one direction to another, and a second direction along with it; `None` if they are
/// parallel.
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

/// Tolerance for rounding of a length or a cosine.
const ROUNDING: f64 = 1e-7;

impl SevenArm {
    /// Cells that contain all solutions.
    pub(crate) fn cells(&self) -> Vec<IkCell> {
        let (lower, upper) = self.last_span();
        let (middle, half) = ((lower + upper) / 2.0, (upper - lower) / 2.0);
        (0..8).map(|branch| IkCell { branch, middle: [middle, 0.0, 0.0], half: [half, 0.0, 0.0] }).collect()
    }

    /// Approximate displacement, in m, per unit of each parameter of a cell.
    pub(crate) fn weights(&self) -> [f64; 3] {
        [0.5 * (self.wrist - self.shoulder).norm(), 0.0, 0.0]
    }

    /// Encloses all solutions of a cell, with the base at a pose.
    pub(crate) fn enclose(
        &self,
        tips: &PoseSet,
        map_from_base: &Isometry3<f64>,
        base: [f64; 3],
        cell: &IkCell,
    ) -> IntervalSolution {
        let [h1, h2, h3, h4, h5, h6, h7] = &self.axes;
        let ([value, ..], [values, ..]) = (cell.middle, cell.half);
        let Some(joint) = self.chain.joints.last() else { return IntervalSolution::Unknown };
        let last = joint.coupling.multiplier * value + joint.coupling.offset;
        let lasts = values * joint.coupling.multiplier.abs();
        let base_from_tip = map_from_base.inverse() * tips.map_from_tip;
        let moved = base_from_tip * self.base_from_tip.inverse();
        let back = turn(&Unit::new_unchecked(*h7), -last);
        let rotation = moved.rotation * back;
        let reached_at =
            moved.rotation * (self.last + back * (self.wrist - self.last)) + moved.translation.vector;
        let wrist_in_map = (map_from_base * Point3::from(reached_at)).coords;
        // The wrist rotates about the last axis, and follows the tip.
        let swing = h7.cross(&(self.wrist - self.last)).norm() * lasts.min(2.0);
        let moves = swing + tips.displacement.point(&wrist_in_map, swing) + ROUNDING;
        let tilts = lasts + tips.displacement.angle();

        // The elbow.
        let reached = reached_at - self.shoulder;
        let (upper, fore) = (self.shoulder - self.elbow, self.wrist - self.elbow);
        let (long, one, two) = (reached.norm(), upper.norm(), fore.norm());
        let (near, far) = ((long - moves).max(0.0), long + moves);
        if near > one + two + ROUNDING || far < (one - two).abs() - ROUNDING {
            return IntervalSolution::Empty;
        }
        let bent =
            |long: f64| acos(((one * one + two * two - long * long) / (2.0 * one * two)).clamp(-1.0, 1.0));
        let (least, greatest) = (bent(near), bent(far));
        let straight = atan2(upper.dot(&h4.cross(&fore)), upper.dot(&fore));
        let sign = if cell.branch & 1 == 0 { 1.0 } else { -1.0 };
        let (q4, fourth) = (straight + sign * (least + greatest) / 2.0, (greatest - least) / 2.0 + ROUNDING);
        let to_wrist = turned(h4, q4, &fore) - upper;
        let leaning = turned(h4, q4, h5);
        // Greatest rates, per angle of the elbow, of the lean of the fifth axis from the line to the wrist
        // and of that line itself.
        let rates = [near, far].map(|long| {
            let share = (two * two - one * one) / (2.0 * long * long);
            [(0.5 - share).abs(), (0.5 + share).abs()]
        });
        let [lean_rate, line_rate] = [0, 1].map(|at: usize| {
            let all = rates.iter().filter_map(|rates| rates.get(at));
            all.copied().fold(0.0, f64::max)
        });
        let lean = atan2(h4.dot(&to_wrist.cross(&leaning)), to_wrist.dot(&leaning)).abs();
        let leans = if near < 1e-3 { PI } else { lean_rate * fourth + ROUNDING };
        let is_to_one_side = lean - leans > 0.0 && lean + leans < PI;

        // The sixth joint.
        let points = if moves < long { libm::asin(moves / long) } else { PI };
        let seen = rotation.inverse() * reached / long;
        let polar = acos(h6.dot(&seen));
        let off = points + tilts;
        let [low, high] = [polar - off, polar + off].map(|angle| angle.clamp(0.0, PI));
        let sines = [low, high].map(libm::sin);
        let sin_low = sines.into_iter().fold(1.0, f64::min);
        let is_across = low <= FRAC_PI_2 && high >= FRAC_PI_2;
        let sin_high = if is_across { 1.0 } else { sines.into_iter().fold(0.0, f64::max) };
        let cosines = [(lean + leans).min(PI), (lean - leans).max(0.0)].map(libm::cos);
        let (mut alo, mut ahi) = (0.0, PI);
        if sin_low > 1e-6 {
            let all = cosines.iter().flat_map(|cos| [cos / sin_low, cos / sin_high]);
            let (least, most) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), next| {
                (f64::min(least, next), f64::max(most, next))
            });
            if least > 1.0 + ROUNDING || most < -1.0 - ROUNDING {
                return IntervalSolution::Empty;
            }
            (alo, ahi) = (acos(most.clamp(-1.0, 1.0)), acos(least.clamp(-1.0, 1.0)));
        }
        let ahead = atan2(seen.dot(&h6.cross(h5)), seen.dot(h5));
        let sign = if cell.branch & 2 == 0 { 1.0 } else { -1.0 };
        let q6 = -(ahead + sign * (alo + ahi) / 2.0);
        let sixth = ((ahi - alo) / 2.0 + azimuth(polar, off) + ROUNDING).min(PI);

        // The shoulder, and the fifth joint between.
        let fifth = rotation * turned(h6, -q6, h5);
        let shoulder = between([&to_wrist, &leaning], [&reached, &fifth]);
        let is_to_one_side = is_to_one_side && shoulder.is_some();
        let shoulder = shoulder.unwrap_or_default();
        let aside = acos(reached.dot(&fifth) / long);
        let about = azimuth(aside, (points + tilts + sixth).min(PI));
        let turns = if is_to_one_side { points + about + line_rate * fourth } else { PI };
        let turns = (turns + ROUNDING).min(PI);
        let upper_end = shoulder * turn(&Unit::new_unchecked(*h4), q4);
        let rest = upper_end.inverse() * rotation * turn(&Unit::new_unchecked(*h6), -q6);
        let square = rest * h6;
        let q5 = angle_between(h5, h6, &square);
        let fifths = azimuth(acos(h5.dot(&square)), (turns + fourth + tilts + sixth).min(PI));
        let Some([first, second, third]) =
            wrist_interval(&[*h1, *h2, *h3], &shoulder, turns, cell.branch >> 2)
        else {
            return IntervalSolution::Unknown;
        };
        let positions = [first, second, third, [q4, fourth], [q5, fifths], [q6, sixth], [last, lasts]];
        let Some(known) = dof_intervals(&self.chain, &positions, tips.is_any) else {
            return IntervalSolution::Empty;
        };

        // From the base up to the forearm, from the tip down to the wrist.
        let mut placed = frames(&self.chain, *map_from_base, &known);
        let mut end = tips.map_from_tip * self.chain.last_from_tip.inverse();
        for ((slot, joint), [position, _]) in
            placed.iter_mut().zip(&self.chain.joints).zip(positions).rev().take(3)
        {
            *slot = end;
            end *= (joint.before * joint.motion(position)).inverse();
        }
        let in_map = |point: &Vector3<f64>| (map_from_base * Point3::from(*point)).coords;
        let at = in_map(&self.shoulder);
        let elbow = in_map(&(self.shoulder + shoulder * (self.elbow - self.shoulder)));
        let axis = |at: usize| {
            let found = self.chain.joints.get(at).zip(placed.get(at));
            found.map_or(Vector3::z(), |(joint, pose)| pose * joint.axis.into_inner())
        };
        let displacements = [
            DisplacementBound::none().spun(axis(0), at, first[1]),
            DisplacementBound::none().spun(axis(1), at, second[1]).spun(axis(0), at, first[1]),
            DisplacementBound::none().turned(at, turns),
            DisplacementBound::none().turned(elbow, turns + fourth).shifted(turns.min(2.0) * one),
            DisplacementBound::none()
                .turned(wrist_in_map, tilts)
                .spun(axis(5), wrist_in_map, sixth)
                .shifted(moves),
            DisplacementBound::none().turned(wrist_in_map, tilts).shifted(moves),
            tips.displacement,
        ];
        IntervalSolution::Enclosed(Box::new(CellEnclosure {
            base,
            base_displacement: DisplacementBound::none(),
            frames: placed.into_iter().zip(displacements).collect(),
            values: known,
            short: [0.0; 2],
            is_joined: false,
        }))
    }
}
