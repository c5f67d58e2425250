//! Closed form for an arm on a lift with a spherical wrist, on a base that drives in any direction.
//!
//! The chain slides along the vertical, turns about a shoulder, then about three axes that meet in the wrist's centre.
//! A pose of the tip fixes the wrist's centre. With the base's yaw and the shoulder's angle as free parameters, the
//! centre's height gives the lift, its place in the plane gives the base, and the orientation that is left gives the
//! three angles of the wrist, in two ways. So a pose has a family of solutions with two parameters, and two branches.

use nalgebra::{Isometry3, Translation3, Unit, UnitQuaternion, Vector3};

use super::Tolerance;
use super::screw::{ROUNDED, Screw, drives_each, screws};
use super::subproblem::{angle_between, component, turned, within};
use crate::kinematics::{Dof, KinematicChain, planar};
use crate::trigonometry::{turn, wrapped};

/// The solver of one arm. The base's frame stands on the floor, z up.
#[derive(Clone, PartialEq, Debug)]
pub struct LiftArm {
    pub(crate) chain: KinematicChain,
    /// 1 where the lift's positive direction is up, −1 where it is down.
    pub(crate) up: f64,
    pub(crate) shoulder: Shoulder,
    /// Axes of the wrist at positions 0, in the base's frame.
    pub(crate) wrist: [Vector3<f64>; 3],
    /// The wrist's centre in the tip's frame.
    pub(crate) centre_in_tip: Vector3<f64>,
    /// The tip's rotation at positions 0, in the base's frame.
    pub(crate) base_from_tip: UnitQuaternion<f64>,
}

/// The shoulder at positions 0, in the base's frame.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Shoulder {
    pub(crate) axis: Vector3<f64>,
    pub(crate) point: Vector3<f64>,
    /// From that point to the wrist's centre.
    pub(crate) to_wrist: Vector3<f64>,
}

/// A base pose on the floor with the positions of the arm.
#[derive(Clone, PartialEq, Debug)]
pub struct MobileSolution {
    /// x and y in m and yaw in (−π, π], of the base in the map.
    pub base: [f64; 3],
    /// Values of the chain's variables: lift, shoulder, three of the wrist.
    pub values: [f64; 5],
}

impl LiftArm {
    /// The solver, where the chain is of this kind.
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
        // Axes that are square to the next reach every orientation, so that the two branches are all there are.
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

    /// The chain that it solves.
    #[must_use]
    pub fn chain(&self) -> &KinematicChain {
        &self.chain
    }

    /// Every solution with the given yaw of the base and value of the shoulder's variable, within the limits; the
    /// branches in a fixed order: at most two. Of values that differ by full turns it has the nearest to 0.
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

    /// Where the tip is.
    #[must_use]
    pub fn map_from_tip(&self, placed: &MobileSolution) -> Isometry3<f64> {
        let [x, y, yaw] = placed.base;
        planar(x, y, yaw) * self.chain.base_from_tip(&placed.values)
    }

    /// The wrist's centre for a pose of the tip.
    #[must_use]
    pub fn centre(&self, map_from_tip: &Isometry3<f64>) -> nalgebra::Point3<f64> {
        map_from_tip * nalgebra::Point3::from(self.centre_in_tip)
    }

    /// The heights, in m, between which the wrist's centre can be, with every value of the shoulder within the limits.
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
        // As the shoulder turns the height is a wave: its ends, and its crests where they are within.
        let across = axis.cross(&to_wrist);
        let crest = crate::trigonometry::atan2(across.z, (to_wrist - axis * axis.dot(&to_wrist)).z);
        let (from, to) = (first.min(last), first.max(last));
        // Of all crests the first two within show both heights.
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

    /// Values of the shoulder's variable that stand for all others.
    pub(crate) fn shoulder_span(&self) -> (f64, f64) {
        self.chain.dofs.get(1).map_or((0.0, 0.0), Dof::sampling_range)
    }

    /// How far the tip can be from the vertical axis of the base, in m.
    #[must_use]
    pub fn reach(&self) -> f64 {
        let Shoulder { point, to_wrist, .. } = self.shoulder;
        libm::hypot(point.x, point.y) + to_wrist.norm() + self.centre_in_tip.norm()
    }

    /// The same family of solutions seen from a base that is raised: its frame is `height` above the floor.
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

/// The angles about three axes, each square to the next, that make up a rotation: two ways, in a fixed order. Where the
/// outer axes coincide only their sum counts, and the first angle is 0.
pub(super) fn wrist(axes: &[Vector3<f64>; 3], rotation: &UnitQuaternion<f64>) -> Vec<[f64; 3]> {
    let [one, two, three] = axes;
    let pointing = rotation * three;
    let Some(middles) = component(two, three, one, one.dot(&pointing)) else { return vec![] };
    let ways = middles.into_iter().map(|middle| {
        let bent = turned(two, middle, three);
        let first = angle_between(one, &bent, &pointing);
        // Of what is left, a turn about the third axis, a vector square to it shows the angle.
        let rest =
            turn(&Unit::new_unchecked(*two), -middle) * turn(&Unit::new_unchecked(*one), -first) * rotation;
        let last = angle_between(three, two, &(rest * two));
        [first, middle, last]
    });
    ways.collect()
}
