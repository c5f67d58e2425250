//! Closed form for an arm on a lift with a spherical wrist, on a base that drives in any direction.
//!
//! The chain has a vertical prismatic joint, a shoulder, and three axes that meet in the centre of the wrist.
//! A pose of the tip fixes that centre. With the yaw of the base and the angle of the shoulder as free
//! parameters, the height of the centre gives the lift, its horizontal place gives the base, and the
//! remaining rotation gives the three wrist angles, in two branches. So each pose has a two-parameter family
//! of solutions with two branches.
//!
//! The parameters of its cells for branch and bound are the yaw of the base and the value of the shoulder,
//! for each branch of the wrist.

use std::f64::consts::PI;

use nalgebra::{Isometry3, Translation3, Unit, UnitQuaternion, Vector3};

use super::Tolerance;
use super::interval::{
    CellEnclosure, DisplacementBound, IkCell, IntervalSolution, PoseSet, based, carried_wrist_interval,
    dof_intervals, frames, wave,
};
use super::screw::{ROUNDED, Screw, drives_each, screws, turned, within, wrist};
use crate::kinematics::{Dof, KinematicChain, planar};
use crate::trigonometry::{turn, wrapped};

/// Solver for one arm. The frame of the base is on the floor, z up.
#[derive(Clone, PartialEq, Debug)]
pub struct LiftArm {
    pub(crate) chain: KinematicChain,
    /// 1 if the positive direction of the lift is up, −1 if it is down.
    pub(crate) up: f64,
    pub(crate) shoulder: Shoulder,
    /// Axes of the wrist at positions 0, in the frame of the base.
    pub(crate) wrist: [Vector3<f64>; 3],
    /// Centre of the wrist in the frame of the tip.
    pub(crate) centre_in_tip: Vector3<f64>,
    /// Rotation of the tip at positions 0, in the frame of the base.
    pub(crate) base_from_tip: UnitQuaternion<f64>,
}

/// Shoulder at positions 0, in the frame of the base.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Shoulder {
    pub(crate) axis: Vector3<f64>,
    pub(crate) point: Vector3<f64>,
    /// From that point to the centre of the wrist.
    pub(crate) to_wrist: Vector3<f64>,
}

/// Solution for a mobile arm: base pose on the floor and joint values.
#[derive(Clone, PartialEq, Debug)]
pub struct MobileSolution {
    /// x and y in m and yaw in (−π, π], of the base in the map frame.
    pub base: [f64; 3],
    /// Values of the degrees of freedom: lift, shoulder, three of the wrist.
    pub values: [f64; 5],
}

impl LiftArm {
    /// Solver for the chain; `None` if its axes do not have this arrangement.
    #[must_use]
    pub fn detect(chain: &KinematicChain) -> Option<Self> {
        let kinds: Vec<bool> = chain.joints.iter().map(|joint| joint.is_prismatic).collect();
        if kinds != [true, false, false, false, false] || !drives_each(chain) {
            return None;
        }
        let (axes, tip) = screws(chain);
        let [lift, shoulder, one, two, three] = <[Screw; 5]>::try_from(axes).ok()?;
        let up = lift.direction.z;
        if (up.abs() - 1.0).abs() > ROUNDED {
            return None;
        }
        let centre = one.meeting(&two).filter(|centre| three.contains(centre))?;
        // Consecutive perpendicular axes reach every orientation, so there are exactly two branches.
        let square = |a: &Screw, b: &Screw| a.direction.dot(&b.direction).abs() < ROUNDED;
        if !square(&one, &two) || !square(&two, &three) {
            return None;
        }
        Some(Self {
            chain: chain.clone(),
            up: up.signum(),
            shoulder: Shoulder {
                axis: shoulder.direction,
                point: shoulder.point,
                to_wrist: centre - shoulder.point,
            },
            wrist: [one.direction, two.direction, three.direction],
            centre_in_tip: tip.inverse_transform_vector(&(centre - tip.translation.vector)),
            base_from_tip: tip.rotation,
        })
    }

    /// Kinematic chain of the arm.
    #[must_use]
    pub fn chain(&self) -> &KinematicChain {
        &self.chain
    }

    /// Solves for a given yaw of the base and value of the shoulder: at most two solutions within the limits,
    /// in a fixed order of branches. Of values that differ by full turns it takes the one nearest to 0.
    #[must_use]
    pub fn solve(&self, map_from_tip: &Isometry3<f64>, yaw: f64, shoulder: f64) -> Vec<MobileSolution> {
        let [lift_joint, shoulder_joint, wrist_joints @ ..] = self.chain.joints.as_slice() else {
            return vec![];
        };
        let [lift_variable, shoulder_variable, wrist_variables @ ..] = self.chain.dofs.as_slice() else {
            return vec![];
        };
        if !shoulder_variable.allows(shoulder) {
            return vec![];
        }
        let Shoulder { axis, point, to_wrist } = self.shoulder;
        let angle = shoulder_joint.coupling.position(&[0.0, shoulder]);
        let centre = map_from_tip * nalgebra::Point3::from(self.centre_in_tip);
        let from_shoulder = point + turned(&axis, angle, &to_wrist);
        let lift = (centre.z - from_shoulder.z) * self.up;
        let lift = (lift - lift_joint.coupling.offset) / lift_joint.coupling.multiplier;
        if !lift_variable.allows(lift) {
            return vec![];
        }
        let in_map = turned(&Vector3::z(), yaw, &from_shoulder);
        let base = [centre.x - in_map.x, centre.y - in_map.y, wrapped(yaw)];
        let carried = turn(&Vector3::z_axis(), yaw) * turn(&Unit::new_unchecked(axis), angle);
        let left = carried.inverse() * map_from_tip.rotation * self.base_from_tip.inverse();
        let mut found = Vec::new();
        for angles in wrist(&self.wrist, &left) {
            let mut values = [lift, shoulder, 0.0, 0.0, 0.0];
            let joints = wrist_joints.iter().zip(wrist_variables).zip(angles);
            let is_within = values.iter_mut().skip(2).zip(joints).all(|(slot, ((joint, dof), q))| {
                let value = within(dof, (q - joint.coupling.offset) / joint.coupling.multiplier, 0.0);
                value.is_some_and(|value| {
                    *slot = value;
                    true
                })
            });
            if is_within {
                found.push(MobileSolution { base, values });
            }
        }
        found.retain(|placed| Tolerance::EXACT.covers(&self.map_from_tip(placed), map_from_tip));
        found
    }

    /// Pose of the tip in the map frame, by forward kinematics.
    #[must_use]
    pub fn map_from_tip(&self, placed: &MobileSolution) -> Isometry3<f64> {
        let [x, y, yaw] = placed.base;
        planar(x, y, yaw) * self.chain.base_from_tip(&placed.values)
    }

    /// Centre of the wrist for a pose of the tip.
    #[must_use]
    pub fn centre(&self, map_from_tip: &Isometry3<f64>) -> nalgebra::Point3<f64> {
        map_from_tip * nalgebra::Point3::from(self.centre_in_tip)
    }

    /// Least and greatest height of the centre of the wrist, in m, over all values of the shoulder within the
    /// limits.
    #[must_use]
    pub fn heights(&self) -> [f64; 2] {
        let range = |at: usize| self.chain.dofs.get(at).and_then(|dof| dof.limits);
        let place = |at: usize, value: f64| {
            let mut values = [0.0; 2];
            if let Some(slot) = values.get_mut(at) {
                *slot = value;
            }
            self.chain.joints.get(at).map_or(0.0, |joint| joint.coupling.position(&values))
        };
        let (lower, upper) = range(0).unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        let lifts = [place(0, lower) * self.up, place(0, upper) * self.up];
        let Shoulder { axis, point, to_wrist } = self.shoulder;
        let height = |angle: f64| point.z + turned(&axis, angle, &to_wrist).z;
        let (lower, upper) = self.shoulder_span();
        let (first, last) = (place(1, lower), place(1, upper));
        // The height is a sine of the shoulder angle: its extrema are at the ends and at the crests within
        // the limits.
        let across = axis.cross(&to_wrist);
        let crest = crate::trigonometry::atan2(across.z, (to_wrist - axis * axis.dot(&to_wrist)).z);
        let (from, to) = (first.min(last), first.max(last));
        // The first two crests within the limits have both extreme heights.
        let pi = std::f64::consts::PI;
        let nearest = libm::ceil((from - crest) / pi);
        let crests = [-1.0, 0.0, 1.0, 2.0].into_iter().map(|half| crest + pi * (nearest + half));
        let angles = crests.filter(|angle| (from..=to).contains(angle)).chain([from, to]);
        let (low, high) = angles
            .map(height)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| (low.min(z), high.max(z)));
        let [one, other] = lifts;
        [low + one.min(other), high + one.max(other)]
    }

    /// Range of shoulder values that represents all others.
    pub(crate) fn shoulder_span(&self) -> (f64, f64) {
        self.chain.dofs.get(1).map_or((0.0, 0.0), Dof::sampling_range)
    }

    /// Greatest distance of the tip from the vertical axis of the base, in m.
    #[must_use]
    pub fn reach(&self) -> f64 {
        let Shoulder { point, to_wrist, .. } = self.shoulder;
        libm::hypot(point.x, point.y) + to_wrist.norm() + self.centre_in_tip.norm()
    }

    /// The same solver for a base whose frame is `height` m above the floor.
    #[must_use]
    pub fn raised(mut self, height: f64) -> Self {
        let lift = Translation3::new(0.0, 0.0, height);
        self.shoulder.point.z += height;
        if let Some(first) = self.chain.joints.first_mut() {
            first.before = lift * first.before;
        }
        self
    }
}

impl LiftArm {
    /// Cells that contain all solutions.
    pub(crate) fn cells(&self) -> Vec<IkCell> {
        let (lower, upper) = self.shoulder_span();
        let (middle, half) = ((lower + upper) / 2.0, (upper - lower) / 2.0);
        (0..2).map(|branch| IkCell { branch, middle: [0.0, middle, 0.0], half: [PI, half, 0.0] }).collect()
    }

    /// Approximate displacement, in m, per unit of each parameter of a cell.
    pub(crate) fn weights(&self) -> [f64; 3] {
        let long = self.shoulder.to_wrist.norm();
        [libm::hypot(self.shoulder.point.x, self.shoulder.point.y) + long, long, 0.0]
    }

    /// Encloses all solutions of a cell.
    pub(crate) fn enclose(&self, tips: &PoseSet, cell: &IkCell) -> IntervalSolution {
        let map_from_tip = &tips.map_from_tip;
        let ([yaw, value, _], [yaws, values, _]) = (cell.middle, cell.half);
        let Some(joint) = self.chain.joints.get(1) else { return IntervalSolution::Unknown };
        let (angle, bends) =
            (joint.coupling.position(&[0.0, value]), values * joint.coupling.multiplier.abs());
        let Shoulder { axis, point, to_wrist } = self.shoulder;
        let centre = self.centre(map_from_tip).coords;
        // The centre of the wrist is uncertain as well, and so is the rotation of the hand.
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
        // The shoulder moves opposite to the centre of the wrist as the arm bends, and all but the hand
        // rotates with the base.
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
            // The base keeps its height, whatever the height of the shoulder.
            base_displacement: upright(carries.level()),
            frames: placed.into_iter().zip(displacements).collect(),
            values,
            short: [0.0; 2],
            is_joined: true,
        }))
    }
}
