//! Interval inverse kinematics: enclosures of all solutions over a cell, for branch and bound.
//!
//! A cell is a box of free parameters of the solution family of an arm whose tip is at a pose. Its enclosure
//! gives an interval for each joint value, and a bound for the displacement of each frame from its pose in
//! the middle of the cell. It knows no obstacles. It holds for every member of the cell: if a joint is beyond
//! its limits throughout, the cell has no solution; and a solid on a frame can be checked at the middle,
//! deflated by the displacement bound.
//!
//! Cells exist for [`LiftArm`](super::LiftArm) (yaw of the base and shoulder), for
//! [`ParallelArm`](super::ParallelArm) on a mobile base (heading of the arm, lean of the forearm, yaw of the
//! base), and for [`SevenArm`](super::SevenArm) on a fixed base (last joint).

mod displacement;
mod lift;
mod parallel;
mod seven;

use std::f64::consts::{PI, TAU};

use nalgebra::{Isometry3, UnitQuaternion, Vector3};

pub(crate) use displacement::{DisplacementBound, RotationBound, farthest};

use super::lift_arm::wrist;
use crate::kinematics::{KinematicChain, planar};
use crate::trigonometry::acos;

/// Tolerance, in rad or m, for a value beyond a limit.
const SLACK: f64 = 1e-5;

/// Box of free parameters of a solution family, for one branch of the closed form.
#[derive(Clone, Copy, Debug)]
pub(crate) struct IkCell {
    pub(crate) branch: u8,
    pub(crate) middle: [f64; 3],
    /// Half of each side; 0 for a parameter that the family does not have.
    pub(crate) half: [f64; 3],
}

/// Set of tip poses: one pose and a bound for the displacement from it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PoseSet {
    pub(crate) map_from_tip: Isometry3<f64>,
    pub(crate) displacement: DisplacementBound,
    /// If true, joint limits and the reach of the arm are ignored.
    pub(crate) is_any: bool,
}

impl PoseSet {
    pub(crate) fn new(map_from_tip: Isometry3<f64>, displacement: DisplacementBound) -> Self {
        Self { map_from_tip, displacement, is_any: false }
    }

    /// The same set with joint limits and reach ignored.
    pub(crate) fn any(self) -> Self {
        Self { is_any: true, ..self }
    }
}

/// Enclosure of the solutions over a cell.
pub(crate) enum IntervalSolution {
    /// No member is within the limits.
    Empty,
    /// All members are in this enclosure.
    Enclosed(Box<CellEnclosure>),
    /// No statement is possible.
    Unknown,
}

/// Middle of a cell, with bounds for the difference of its members from it.
pub(crate) struct CellEnclosure {
    /// x, y and yaw of the base in the map frame.
    pub(crate) base: [f64; 3],
    pub(crate) base_displacement: DisplacementBound,
    /// Frame after each joint, in the map frame, with its displacement bound.
    pub(crate) frames: Vec<(Isometry3<f64>, DisplacementBound)>,
    /// Value of each degree of freedom, and the radius of its interval.
    pub(crate) values: Vec<[f64; 2]>,
    /// Missing length of the arm in the middle, in m, and the radius of its interval.
    pub(crate) short: [f64; 2],
    /// True if the frames are the forward kinematics of the values, from the base on.
    pub(crate) is_joined: bool,
}

impl IkCell {
    /// Splits a cell into halves across a parameter.
    pub(crate) fn halves(&self, across: usize) -> [Self; 2] {
        let mut halves = [*self; 2];
        for (half, sign) in halves.iter_mut().zip([-0.5, 0.5]) {
            if let (Some(middle), Some(side)) = (half.middle.get_mut(across), half.half.get_mut(across)) {
                *middle += sign * *side;
                // The halves overlap by more than rounding.
                *side = 0.5 * *side + 1e-12;
            }
        }
        halves
    }
}

/// Interval of the angles about three axes, each perpendicular to the next, that make up a rotation that is
/// uncertain by the angle `off`, for one branch: values and radii.
fn wrist_interval(
    axes: &[Vector3<f64>; 3],
    rotation: &UnitQuaternion<f64>,
    off: f64,
    branch: u8,
) -> Option<[[f64; 2]; 3]> {
    let [one, _, three] = axes;
    let [first, middle, last] = *wrist(axes, rotation).get(usize::from(branch))?;
    // The angle between the third and the first axis changes by no more than the rotation does; so does the
    // middle angle.
    let polar = acos(one.dot(&(rotation * three)));
    let around = azimuth(polar, off);
    Some([[first, around], [middle, off], [last, around]])
}

/// Interval of the angles of a wrist whose carrier rotates in the map frame within `carrier` while the held
/// body rotates within `held`. It depends on the axes of both rotations: a hand that points straight down
/// stays so however the arm rotates about the vertical.
fn carried_wrist_interval(
    axes: &[Vector3<f64>; 3],
    [map_from_carrier, rotation]: [&UnitQuaternion<f64>; 2],
    [carrier, held]: [&DisplacementBound; 2],
    branch: u8,
) -> Option<[[f64; 2]; 3]> {
    let [one, _, three] = axes;
    let [first, middle, last] = wrist_interval(axes, rotation, carrier.angle() + held.angle(), branch)?;
    let (u, w) = (map_from_carrier * one, map_from_carrier * (rotation * three));
    let (cos, aside) = (u.dot(&w), u.cross(&w));
    let sin = aside.norm();
    if sin < 1e-3 {
        return Some([first, middle, last]);
    }
    let aside = aside / sin;
    // Displacement of one direction along another, each displaced on its own.
    let off = |[displacement, beyond]: [&DisplacementBound; 2], from: &Vector3<f64>, to: &Vector3<f64>| {
        displacement.along(from, to)
            + beyond.along(to, from)
            + displacement.point(from, 0.0) * beyond.point(to, 0.0)
    };
    let around = |displacements: [&DisplacementBound; 2], from: &Vector3<f64>, to: &Vector3<f64>| {
        let out = (from - to * cos) / sin;
        let room = sin - off(displacements, from, &out);
        if room > 1e-6 { libm::atan(off(displacements, from, &aside) / room) + 1e-9 } else { PI }
    };
    let along = off([held, carrier], &w, &u);
    let polar = acos(cos);
    let leans = (acos(cos - along) - polar).max(polar - acos(cos + along)) + 1e-9;
    let least = |[angle, off]: [f64; 2], other: f64| [angle, off.min(other)];
    Some([
        least(first, around([held, carrier], &w, &u)),
        least(middle, leans),
        least(last, around([carrier, held], &u, &w)),
    ])
}

/// Greatest change of azimuth about an axis of a vector at the angle `polar` to the axis, under a rotation by
/// at most `off`.
fn azimuth(polar: f64, off: f64) -> f64 {
    let room = polar.min(PI - polar) - 1e-6;
    if off >= room { PI } else { libm::asin((libm::sin(off) / libm::sin(polar)).min(1.0)) + 1e-9 }
}

/// Greatest change of a component of a vector of length `long` that rotates by at most `off` about an axis
/// perpendicular to both; `slope` is the component perpendicular to the measured direction.
fn wave(slope: f64, long: f64, off: f64) -> f64 {
    (slope.abs() * off + 0.5 * long * off * off).min(2.0 * long)
}

/// Intervals of the degrees of freedom for intervals of joint positions; `None` if one is beyond its limits
/// throughout and limits count.
fn dof_intervals(chain: &KinematicChain, positions: &[[f64; 2]], is_any: bool) -> Option<Vec<[f64; 2]>> {
    let joints = chain.joints.iter().zip(&chain.dofs).zip(positions);
    let values = joints.map(|((joint, dof), [position, off])| {
        let size = joint.coupling.multiplier.abs();
        let (mut value, off) = ((position - joint.coupling.offset) / joint.coupling.multiplier, off / size);
        let Some((lower, upper)) = dof.limits else { return Some([value, off]) };
        let (least, greatest) = (lower - off - SLACK, upper + off + SLACK);
        if !joint.is_prismatic {
            // The first of the values that differ by full turns and are not too small.
            let turn = TAU / size;
            value += turn * libm::ceil((least - value) / turn);
        }
        (is_any || (least <= value && value <= greatest)).then_some([value, off])
    });
    values.collect()
}

/// Frames after the joints, in the map frame, at the middle values.
fn frames(chain: &KinematicChain, map_from_base: Isometry3<f64>, values: &[[f64; 2]]) -> Vec<Isometry3<f64>> {
    let values: Vec<f64> = values.iter().map(|[value, _]| *value).collect();
    let mut pose = map_from_base;
    let placed = chain.joints.iter().map(|joint| {
        pose = pose * joint.before * joint.motion(joint.coupling.position(&values));
        pose
    });
    placed.collect()
}

/// Pose of the link of a base at a height above the floor.
fn based([x, y, yaw]: [f64; 3], height: f64) -> Isometry3<f64> {
    let mut pose = planar(x, y, yaw);
    pose.translation.z = height;
    pose
}
