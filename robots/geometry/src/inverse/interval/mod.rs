//! Cells of the family of solutions of an arm whose tip is at a pose: over a box of the family's free parameters, between which
//! values each joint is, and how far each frame can be from where it is in the middle of the box.
//!
//! Nothing here looks at what stands around. What is said holds for every member of the family whose parameters are in the
//! box, so that a box in which a joint is beyond its limits throughout has no state, and what a frame carries can be looked at
//! in the middle, smaller by as much as it can be off. Which arms have such cells: [`LiftArm`](super::LiftArm), by the base's yaw and
//! the shoulder; [`ParallelArm`](super::ParallelArm) on a base that drives, by the heading of the arm, the lean of the forearm,
//! and the base's yaw; [`SevenArm`](super::SevenArm) on one that does not, by the last joint.

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

/// How far, in rad or m, a value may be beyond a limit and still be rounding.
const SLACK: f64 = 1e-5;

/// A box of free parameters, and one of the ways in which the rest follows from them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct IkCell {
    pub(crate) branch: u8,
    pub(crate) middle: [f64; 3],
    /// Half of each side; 0 for a parameter that the family does not have.
    pub(crate) half: [f64; 3],
}

/// Poses of the tip that are near to one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PoseSet {
    pub(crate) map_from_tip: Isometry3<f64>,
    pub(crate) displacement: DisplacementBound,
    /// Whether joints count that are beyond their limits, and an arm that is too short.
    pub(crate) is_any: bool,
}

impl PoseSet {
    pub(crate) fn new(map_from_tip: Isometry3<f64>, displacement: DisplacementBound) -> Self {
        Self { map_from_tip, displacement, is_any: false }
    }

    /// The same, whatever the limits of joints.
    pub(crate) fn any(self) -> Self {
        Self { is_any: true, ..self }
    }
}

/// What is known of a cell.
pub(crate) enum IntervalSolution {
    /// No member is within the limits.
    Empty,
    /// All members are as near to this as it says.
    Enclosed(Box<CellEnclosure>),
    /// Nothing is known.
    Unknown,
}

/// The middle of a cell, and how far its members can be from it.
pub(crate) struct CellEnclosure {
    /// x, y and yaw of the base.
    pub(crate) base: [f64; 3],
    pub(crate) base_displacement: DisplacementBound,
    /// The frame after each joint, in the map.
    pub(crate) frames: Vec<(Isometry3<f64>, DisplacementBound)>,
    /// Of each variable its value, and how far it can be from there.
    pub(crate) values: Vec<[f64; 2]>,
    /// By how much an arm is too short in the middle, in m, and how far that can be off.
    pub(crate) short: [f64; 2],
    /// Whether the frames are where the values put them, from the base on.
    pub(crate) is_joined: bool,
}

impl IkCell {
    /// The two halves of a cell, cut across a parameter.
    pub(crate) fn halves(&self, across: usize) -> [Self; 2] {
        let mut halves = [*self; 2];
        for (half, sign) in halves.iter_mut().zip([-0.5, 0.5]) {
            if let (Some(middle), Some(side)) = (half.middle.get_mut(across), half.half.get_mut(across)) {
                *middle += sign * *side;
                // The halves overlap by what rounding may take.
                *side = 0.5 * *side + 1e-12;
            }
        }
        halves
    }
}

/// The angles about three axes, each square to the next, that make up a rotation, in one of two ways, and how far each can be from
/// there where the rotation is off by some angle.
fn wrist_interval(
    axes: &[Vector3<f64>; 3],
    rotation: &UnitQuaternion<f64>,
    off: f64,
    branch: u8,
) -> Option<[[f64; 2]; 3]> {
    let [one, _, three] = axes;
    let [first, middle, last] = *wrist(axes, rotation).get(usize::from(branch))?;
    // The third axis is this far from the first, and that changes by no more than the rotation does; so does the middle angle.
    let polar = acos(one.dot(&(rotation * three)));
    let around = azimuth(polar, off);
    Some([[first, around], [middle, off], [last, around]])
}

/// The same of a wrist that something carries, which turns in the map by no more than `carrier`, while what it holds turns by no more than
/// `held`: by which way both turn. A hand that points straight down does so however the arm turns about the vertical.
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
    // How far a direction that goes along with one is off along another one that goes along with the other.
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

/// How far the direction in which a vector leans away from an axis can turn about it, where the vector is so far from the axis and
/// is turned by no more than `off`.
fn azimuth(polar: f64, off: f64) -> f64 {
    let room = polar.min(PI - polar) - 1e-6;
    if off >= room { PI } else { libm::asin((libm::sin(off) / libm::sin(polar)).min(1.0)) + 1e-9 }
}

/// How far the component of a vector can go in a direction while it turns about an axis to which both are square: the vector is so long,
/// and its component across the direction is `slope`.
fn wave(slope: f64, long: f64, off: f64) -> f64 {
    (slope.abs() * off + 0.5 * long * off * off).min(2.0 * long)
}

/// Values of a chain's variables for positions of its joints, each with how far it can be off; `None` where one is beyond its
/// limits throughout and that counts.
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

/// The frames after the joints, in the map, for values of the variables.
fn frames(chain: &KinematicChain, map_from_base: Isometry3<f64>, values: &[[f64; 2]]) -> Vec<Isometry3<f64>> {
    let values: Vec<f64> = values.iter().map(|[value, _]| *value).collect();
    let mut pose = map_from_base;
    let placed = chain.joints.iter().map(|joint| {
        pose = pose * joint.before * joint.motion(joint.coupling.position(&values));
        pose
    });
    placed.collect()
}

/// The pose of a base's link so high above the floor.
fn based([x, y, yaw]: [f64; 3], height: f64) -> Isometry3<f64> {
    let mut pose = planar(x, y, yaw);
    pose.translation.z = height;
    pose
}
