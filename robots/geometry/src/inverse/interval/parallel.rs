//! Cells of a [`ParallelArm`] that stands upright on a base that drives: by the direction in the map in which the plane of the arm's
//! parallel joints heads, the angle of the forearm in that plane, and the base's yaw, for each way to hold the wrist and the elbow.
//!
//! The heading leaves a rotation that the sum of the parallel joints and the last two make up, as a wrist does. With the forearm's angle
//! the elbow has a place, and its height, against that of the shoulder, the angle of the upper arm. The base then stands somewhere on
//! the circle about the first axis.

use std::f64::consts::PI;

use nalgebra::Vector3;

use super::{
    CellEnclosure, DisplacementBound, IkCell, IntervalSolution, PoseSet, based, carried_wrist_interval,
    dof_intervals, frames, wave,
};
use crate::inverse::ParallelArm;
use crate::inverse::screw::ROUNDED;
use crate::inverse::subproblem::turned;
use crate::trigonometry::{acos, atan2};

impl ParallelArm {
    /// Cells that hold all solutions with the base anywhere; none where the arm does not stand upright, or where the axes are not square.
    pub(crate) fn cells(&self) -> Vec<IkCell> {
        let [up, across, _, _, five, six] = &self.axes;
        let is_square = up.z > 1.0 - ROUNDED * ROUNDED
            && [(up, across), (across, five), (five, six)].iter().all(|(a, b)| a.dot(b).abs() < ROUNDED);
        let ways = if is_square { 0..4 } else { 0..0 };
        ways.map(|branch| IkCell { branch, middle: [0.0; 3], half: [PI; 3] }).collect()
    }

    /// How far something goes for a change of each parameter of a cell, about, in m; that of the base counts less, because it is
    /// not asked for where the arm alone is in the way.
    pub(crate) fn weights(&self) -> [f64; 3] {
        let [_, upper, fore, _] = self.offsets.map(|offset| offset.norm());
        [upper + fore, upper, 0.25 * upper]
    }

    /// What is known of a cell, with the base so high above the floor.
    pub(crate) fn enclose(&self, tips: &PoseSet, height: f64, cell: &IkCell) -> IntervalSolution {
        let map_from_tip = &tips.map_from_tip;
        let ([heading, lean, yaw], [headings, leans, yaws]) = (cell.middle, cell.half);
        let [_, across, _, _, five, six] = self.axes;
        let [to_two, to_three, to_four, to_centre] = self.offsets;
        let centre = (map_from_tip * nalgebra::Point3::from(self.centre_in_tip)).coords;
        // The wrist's centre may be off as well, and the hand turned.
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
        // What leads from the elbow and from the fourth axis on, and the upper arm as it would be at 0.
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
        // Back from the wrist's centre to the first axis.
        let four = centre - facing * end;
        let elbow = four - facing * fore;
        let first = elbow - facing * (upper + to_two);
        let from_base = turned(&Vector3::z(), yaw, &self.first);
        let base = [first.x - from_base.x, first.y - from_base.y, yaw];
        let mut placed = frames(&self.chain, based(base, first.z - from_base.z), &values);
        // The shoulder is as high as it is, whatever the middle of the upper arm's angles says.
        if let Some(pose) = placed.first_mut() {
            pose.translation.z += height + from_base.z - first.z;
        }
        let roll = self.chain.joints.get(5).zip(placed.get(5));
        let axis = roll.map_or(Vector3::z(), |(joint, pose)| pose * joint.axis.into_inner());
        let [_, rolls] = sixth;
        // All in the plane of the arm turns about one direction.
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
        // The base turns about the first axis, which goes about the wrist's centre.
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
