//! Cells of a [`LiftArm`]: by the base's yaw and the value of the shoulder's variable, for each way to hold the wrist.

use nalgebra::{Unit, Vector3};

use std::f64::consts::PI;

use super::{
    CellEnclosure, DisplacementBound, IkCell, IntervalSolution, PoseSet, based, carried_wrist_interval,
    dof_intervals, frames, wave,
};
use crate::inverse::LiftArm;
use crate::inverse::lift_arm::Shoulder;
use crate::inverse::subproblem::turned;
use crate::trigonometry::turn;

impl LiftArm {
    /// Cells that hold all solutions.
    pub(crate) fn cells(&self) -> Vec<IkCell> {
        let (lower, upper) = self.shoulder_span();
        let (middle, half) = ((lower + upper) / 2.0, (upper - lower) / 2.0);
        (0..2).map(|branch| IkCell { branch, middle: [0.0, middle, 0.0], half: [PI, half, 0.0] }).collect()
    }

    /// How far something goes for a change of each parameter of a cell, about, in m.
    pub(crate) fn weights(&self) -> [f64; 3] {
        let long = self.shoulder.to_wrist.norm();
        [libm::hypot(self.shoulder.point.x, self.shoulder.point.y) + long, long, 0.0]
    }

    /// What is known of a cell.
    pub(crate) fn enclose(&self, tips: &PoseSet, cell: &IkCell) -> IntervalSolution {
        let map_from_tip = &tips.map_from_tip;
        let ([yaw, value, _], [yaws, values, _]) = (cell.middle, cell.half);
        let Some(joint) = self.chain.joints.get(1) else { return IntervalSolution::Unknown };
        let (angle, bends) =
            (joint.coupling.position(&[0.0, value]), values * joint.coupling.multiplier.abs());
        let Shoulder { axis, point, to_wrist } = self.shoulder;
        let centre = self.centre(map_from_tip).coords;
        // The wrist's centre may be off as well, and the hand turned.
        let swings = turned(&Vector3::z(), yaw, &axis);
        let (moves, tilts) = (tips.displacement.along(&centre, &Vector3::z()), tips.displacement.angle());
        let arm = turned(&axis, angle, &to_wrist);
        let (across, long) = (axis.cross(&arm), axis.cross(&arm).norm());
        let lifts = wave(across.z, long, bends) + moves;
        let lift = (centre.z - point.z - arm.z) * self.up;
        let carried = turn(&Vector3::z_axis(), yaw) * turn(&Unit::new_unchecked(axis), angle);
        let left = carried.inverse() * map_from_tip.rotation * self.base_from_tip.inverse();
        let carrier = DisplacementBound::none().spun(swings, Vector3::zeros(), bends).spun(
            Vector3::z(),
            Vector3::zeros(),
            yaws,
        );
        let (turns, displacements) = ([&carried, &left], [&carrier, &tips.displacement.turning()]);
        let Some([first, middle, last]) =
            carried_wrist_interval(&self.wrist, turns, displacements, cell.branch)
        else {
            return IntervalSolution::Unknown;
        };
        let Some(values) =
            dof_intervals(&self.chain, &[[lift, lifts], [angle, bends], first, middle, last], tips.is_any)
        else {
            return IntervalSolution::Empty;
        };
        let in_map = turned(&Vector3::z(), yaw, &(point + arm));
        let base = [centre.x - in_map.x, centre.y - in_map.y, yaw];
        let placed = frames(&self.chain, based(base, 0.0), &values);
        // The shoulder moves opposite to the wrist's centre as the arm bends, and all but the hand turns with the base.
        let held = tips.displacement.carried(&centre);
        let back = turned(&Vector3::z(), yaw, &-arm);
        let carries = held.swung(&swings, &(back - swings * swings.dot(&back)), bends);
        let about = |at: usize, displacement: DisplacementBound, spin: f64| {
            let axis = self.chain.joints.get(at).zip(placed.get(at));
            let axis = axis.map_or(Vector3::z(), |(joint, pose)| pose * joint.axis.into_inner());
            displacement.spun(axis, centre, spin)
        };
        let upright = |displacement: DisplacementBound| displacement.spun(Vector3::z(), centre, yaws);
        let [_, roll] = first;
        let [_, end] = last;
        let displacements = [
            upright(carries),
            upright(held.spun(swings, centre, bends)),
            upright(about(2, held, roll).spun(swings, centre, bends)),
            about(4, held.turned(centre, tilts), end),
            tips.displacement,
        ];
        IntervalSolution::Enclosed(Box::new(CellEnclosure {
            base,
            // The base keeps its height, whatever the shoulder's.
            base_displacement: upright(carries.level()),
            frames: placed.into_iter().zip(displacements).collect(),
            values,
            short: [0.0; 2],
            is_joined: true,
        }))
    }
}
