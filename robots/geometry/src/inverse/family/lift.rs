//! Cells of a [`LiftArm`]: by the base's yaw and the value of the shoulder's variable, for each way to hold the wrist.

use nalgebra::{Unit, Vector3};

use std::f64::consts::PI;

use super::{Cell, Drift, Over, Stretch, Tips, based, frames, values_over, wave, wrist_held};
use crate::inverse::LiftArm;
use crate::inverse::lift_arm::Shoulder;
use crate::inverse::subproblem::turned;
use crate::trigonometry::turn;

impl LiftArm {
    /// Cells that hold all solutions.
    pub(crate) fn cells(&self) -> Vec<Cell> {
        let (lower, upper) = self.shoulder_span();
        let (middle, half) = ((lower + upper) / 2.0, (upper - lower) / 2.0);
        (0..2).map(|way| Cell { way, middle: [0.0, middle, 0.0], half: [PI, half, 0.0] }).collect()
    }

    /// How far something goes for a change of each parameter of a cell, about, in m.
    pub(crate) fn weights(&self) -> [f64; 3] {
        let long = self.shoulder.to_wrist.norm();
        [libm::hypot(self.shoulder.point.x, self.shoulder.point.y) + long, long, 0.0]
    }

    /// What is known of a cell.
    pub(crate) fn over(&self, tips: &Tips, cell: &Cell) -> Over {
        let map_from_tip = &tips.map_from_tip;
        let ([yaw, value, _], [yaws, values, _]) = (cell.middle, cell.half);
        let Some(joint) = self.chain.joints.get(1) else { return Over::Unclear };
        let (angle, bends) = (joint.driver.position(&[0.0, value]), values * joint.driver.multiplier.abs());
        let Shoulder { axis, point, to_wrist } = self.shoulder;
        let centre = self.centre(map_from_tip).coords;
        // The wrist's centre may be off as well, and the hand turned.
        let swings = turned(&Vector3::z(), yaw, &axis);
        let (moves, tilts) = (tips.drift.along(&centre, &Vector3::z()), tips.drift.angle());
        let arm = turned(&axis, angle, &to_wrist);
        let (across, long) = (axis.cross(&arm), axis.cross(&arm).norm());
        let lifts = wave(across.z, long, bends) + moves;
        let lift = (centre.z - point.z - arm.z) * self.up;
        let carried = turn(&Vector3::z_axis(), yaw) * turn(&Unit::new_unchecked(axis), angle);
        let left = carried.inverse() * map_from_tip.rotation * self.base_from_tip.inverse();
        let carrier =
            Drift::none().spun(swings, Vector3::zeros(), bends).spun(Vector3::z(), Vector3::zeros(), yaws);
        let (turns, drifts) = ([&carried, &left], [&carrier, &tips.drift.turning()]);
        let Some([first, middle, last]) = wrist_held(&self.wrist, turns, drifts, cell.way) else {
            return Over::Unclear;
        };
        let Some(values) =
            values_over(&self.chain, &[[lift, lifts], [angle, bends], first, middle, last], tips.is_any)
        else {
            return Over::Nothing;
        };
        let in_map = turned(&Vector3::z(), yaw, &(point + arm));
        let base = [centre.x - in_map.x, centre.y - in_map.y, yaw];
        let placed = frames(&self.chain, based(base, 0.0), &values);
        // The shoulder moves opposite to the wrist's centre as the arm bends, and all but the hand turns with the base.
        let held = tips.drift.carried(&centre);
        let back = turned(&Vector3::z(), yaw, &-arm);
        let carries = held.swung(&swings, &(back - swings * swings.dot(&back)), bends);
        let about = |at: usize, drift: Drift, spin: f64| {
            let axis = self.chain.joints.get(at).zip(placed.get(at));
            let axis = axis.map_or(Vector3::z(), |(joint, pose)| pose * joint.axis.into_inner());
            drift.spun(axis, centre, spin)
        };
        let upright = |drift: Drift| drift.spun(Vector3::z(), centre, yaws);
        let [_, roll] = first;
        let [_, end] = last;
        let drifts = [
            upright(carries),
            upright(held.spun(swings, centre, bends)),
            upright(about(2, held, roll).spun(swings, centre, bends)),
            about(4, held.turned(centre, tilts), end),
            tips.drift,
        ];
        Over::Near(Box::new(Stretch {
            base,
            // The base keeps its height, whatever the shoulder's.
            base_drift: upright(carries.level()),
            frames: placed.into_iter().zip(drifts).collect(),
            values,
            short: [0.0; 2],
            is_joined: true,
        }))
    }
}
