//! The whole family of solutions of a [`LiftArm`] on a grid of yaws and shoulder angles, eight yaws at a time in `f32`:
//! the hot path of a query, which looks for a member of the family that is free. What it finds is a candidate, and
//! [`LiftArm::solve`] at the same yaw and shoulder angle gives it in `f64`, confirmed.
//!
//! With the wrist's axes n₁ ⊥ n₂ ⊥ n₃ and the rotation M that they have to make up, the vector M n₃ in the frame
//! (n₁, n₂, n₂ × n₁) has the middle angle's cosine as its first component and the first angle's sine and cosine, times
//! the middle one's sine, as the others; Mᵀ n₁ shows the last angle likewise. The two branches are the signs of that sine.

use nalgebra::{Isometry3, Vector3};
use wide::f32x8;

use super::lanes::{above, atan2};
use super::lift_arm::LiftArm;
use super::subproblem::turned;
use crate::trigonometry::{atan2 as atan2_of_one, sin_cos};

/// Yaws that are tried at once.
pub const LANES: usize = 8;

/// A grid of yaws and shoulder angles for one arm; made once for a robot.
#[derive(Clone, Debug)]
pub struct Manifold {
    arm: LiftArm,
    yaws: Vec<Yaws>,
    shoulders: Vec<Shoulder>,
    /// From the third axis back to the first, about the second.
    bend: f32,
    /// Vectors whose images show the angles: n₃, n₂ and n₂ × n₃.
    shown: [Vector3<f64>; 3],
    wrist: [Limits; 3],
}

/// Eight yaws.
#[derive(Clone, Debug)]
struct Yaws {
    angles: [f64; LANES],
    sin: f32x8,
    cos: f32x8,
}

/// A value of the shoulder.
#[derive(Clone, Debug)]
struct Shoulder {
    value: f64,
    /// From the base to the wrist's centre with the lift at position 0.
    wrist: Vector3<f64>,
    /// n₁, n₂ and n₂ × n₁, as the shoulder turns them.
    frame: [Vector3<f32>; 3],
}

/// How a joint's value follows from its angle, and where it has to be.
#[derive(Clone, Copy, Debug)]
struct Limits {
    scale: f32,
    offset: f32,
    lower: f32,
    upper: f32,
}

/// Candidates at one shoulder value and eight yaws.
#[derive(Clone, Copy, Debug)]
pub struct Block {
    /// Value of the shoulder's variable.
    pub shoulder: f64,
    /// Value of the lift's variable, within its limits.
    pub lift: f64,
    /// The base's yaws in rad.
    pub yaws: [f64; LANES],
    /// From the wrist's centre to the base in the map, x then y, in m.
    pub base: [f32x8; 2],
    /// The two ways to hold the wrist.
    pub branches: [Branch; 2],
}

/// One way to hold the wrist.
#[derive(Clone, Copy, Debug)]
pub struct Branch {
    /// Values of the wrist's variables.
    pub values: [f32x8; 3],
    /// A bit for each lane, the first lowest: whether the values are within the limits, to about 1e-6 rad.
    pub allowed: u8,
}

impl Manifold {
    /// A grid of `8 * blocks` yaws around the circle and `shoulders` values between the shoulder's limits, the ends
    /// included where there are two or more.
    #[must_use]
    pub fn new(arm: LiftArm, blocks: usize, shoulders: usize) -> Self {
        let count = (blocks * LANES) as f64;
        let yaws = (0..blocks).map(|block| {
            // Lanes are spread over the circle, so that the first block alone sees every side.
            let angle = |lane: usize| ((lane * blocks + block) as f64 / count - 0.5) * std::f64::consts::TAU;
            Yaws::new(std::array::from_fn(angle))
        });
        let (lower, upper) = arm
            .chain
            .variables
            .get(1)
            .and_then(|variable| variable.limits)
            .unwrap_or((-std::f64::consts::PI, std::f64::consts::PI));
        let shoulders = (0..shoulders).map(|at| {
            let part = if shoulders > 1 { at as f64 / (shoulders - 1) as f64 } else { 0.5 };
            Shoulder::new(&arm, lower + part * (upper - lower))
        });
        let [one, two, three] = arm.wrist;
        let bend = atan2_of_one(three.dot(&two.cross(&one)), three.dot(&one));
        Self {
            yaws: yaws.collect(),
            shoulders: shoulders.collect(),
            bend: bend as f32,
            shown: [three, two, two.cross(&three)],
            wrist: std::array::from_fn(|at| Limits::new(&arm, at + 2)),
            arm,
        }
    }

    /// The arm, to confirm candidates with.
    #[must_use]
    pub fn arm(&self) -> &LiftArm {
        &self.arm
    }

    /// Hands over the candidates for a pose of the tip, block by block, shoulder values outermost; those which the
    /// lift cannot serve are left out. `each` returns whether to go on. O(grid).
    pub fn sweep(&self, map_from_tip: &Isometry3<f64>, mut each: impl FnMut(&Block) -> bool) {
        let centre = map_from_tip * nalgebra::Point3::from(self.arm.centre_in_tip);
        let rotation = map_from_tip.rotation * self.arm.base_from_tip.inverse();
        let shown = self.shown.map(|vector| (rotation * vector).cast::<f32>());
        let Some((lift_joint, lift)) = self.arm.chain.joints.first().zip(self.arm.chain.variables.first())
        else {
            return;
        };
        for shoulder in &self.shoulders {
            let position = (centre.z - shoulder.wrist.z) * self.arm.up;
            let value = (position - lift_joint.driver.offset) / lift_joint.driver.multiplier;
            if !lift.allows(value) {
                continue;
            }
            for yaws in &self.yaws {
                if !each(&self.block(yaws, shoulder, value, &shown)) {
                    return;
                }
            }
        }
    }

    #[inline]
    fn block(&self, yaws: &Yaws, shoulder: &Shoulder, lift: f64, shown: &[Vector3<f32>; 3]) -> Block {
        let splat = f32x8::splat;
        let (px, py) = (splat(shoulder.wrist.x as f32), splat(shoulder.wrist.y as f32));
        let base = [yaws.sin * py - yaws.cos * px, splat(0.0) - (yaws.sin * px + yaws.cos * py)];
        // The base turns by the yaw; seen from it, what is shown turns back.
        let [three, two, side] = shown.map(|v| {
            let (x, y) = (splat(v.x), splat(v.y));
            [yaws.cos * x + yaws.sin * y, yaws.cos * y - yaws.sin * x, splat(v.z)]
        });
        let dot = |axis: &Vector3<f32>, [x, y, z]: [f32x8; 3]| {
            splat(axis.x) * x + splat(axis.y) * y + splat(axis.z) * z
        };
        let [one, second, third] = &shoulder.frame;
        let (p1, p2, p3) = (dot(one, three), dot(second, three), dot(third, three));
        let (r2, r3) = (dot(one, two), dot(one, side));
        let zero = splat(0.0);
        let (middle, bend) = (atan2((p2 * p2 + p3 * p3).sqrt(), p1), splat(self.bend));
        let (first, last) = (atan2(p2, p3), atan2(r2, zero - r3));
        let half = splat(std::f32::consts::PI);
        Block {
            shoulder: shoulder.value,
            lift,
            yaws: yaws.angles,
            base,
            branches: [
                self.branch([first, middle - bend, last]),
                self.branch([first + half, zero - middle - bend, last + half]),
            ],
        }
    }

    #[inline]
    fn branch(&self, angles: [f32x8; 3]) -> Branch {
        let mut values = angles;
        let mut allowed = 0xff;
        for (value, limits) in values.iter_mut().zip(&self.wrist) {
            let found =
                above((*value - f32x8::splat(limits.offset)) * f32x8::splat(limits.scale), limits.lower);
            allowed &= found.simd_le(f32x8::splat(limits.upper)).to_bitmask() as u8;
            *value = found;
        }
        Branch { values, allowed }
    }
}

impl Yaws {
    fn new(angles: [f64; LANES]) -> Self {
        let waves = angles.map(sin_cos);
        let sin = f32x8::new(waves.map(|(sin, _)| sin as f32));
        let cos = f32x8::new(waves.map(|(_, cos)| cos as f32));
        Self { angles, sin, cos }
    }
}

impl Shoulder {
    fn new(arm: &LiftArm, value: f64) -> Self {
        let angle = arm.chain.joints.get(1).map_or(0.0, |joint| joint.driver.position(&[0.0, value]));
        let turn = |vector: &Vector3<f64>| turned(&arm.shoulder.axis, angle, vector);
        let [one, two, _] = &arm.wrist;
        Self {
            value,
            wrist: arm.shoulder.point + turn(&arm.shoulder.to_wrist),
            frame: [turn(one), turn(two), turn(&two.cross(one))].map(|vector| vector.cast::<f32>()),
        }
    }
}

impl Limits {
    fn new(arm: &LiftArm, at: usize) -> Self {
        let (scale, offset) = arm
            .chain
            .joints
            .get(at)
            .map_or((1.0, 0.0), |joint| (1.0 / joint.driver.multiplier, joint.driver.offset));
        let pi = std::f64::consts::PI;
        let limits = arm.chain.variables.get(at).and_then(|variable| variable.limits);
        let (lower, upper) = limits.filter(|(l, u)| l.abs().max(u.abs()) < 1e4).unwrap_or((-pi, pi));
        Self { scale: scale as f32, offset: offset as f32, lower: lower as f32, upper: upper as f32 }
    }
}
