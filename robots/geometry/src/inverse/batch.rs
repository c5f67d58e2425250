//! The family of solutions of a [`LiftArm`], for eight poses of the tip at a time in `f32`: the hot path of a query, which looks
//! for a member of the family that is free. What it finds is a candidate, and [`LiftArm::solve`] at the same yaw and
//! shoulder value gives it in `f64`, confirmed.
//!
//! With the wrist's axes n₁ ⊥ n₂ ⊥ n₃ and the rotation M that they have to make up, the vector M n₃ in the frame
//! (n₁, n₂, n₂ × n₁) has the middle angle's cosine as its first component and the first angle's sine and cosine, times
//! the middle one's sine, as the others; Mᵀ n₁ shows the last angle likewise. The two branches are the signs of that sine.

use nalgebra::{Isometry3, Vector3};
use wide::f32x8;

use super::lift_arm::LiftArm;
use super::subproblem::turned;
use super::wide_angles::{above, atan2};
use crate::kinematics::Dof;
use crate::trigonometry::{atan2 as atan2_of_one, sin_cos, wrapped};

/// Poses that are looked at at once.
pub const LANES: usize = 8;

/// What of an arm its candidates need; made once for a query.
#[derive(Clone, Debug)]
pub struct BatchSolver<'a> {
    arm: &'a LiftArm,
    /// From the third axis back to the first, about the second.
    bend: f32,
    /// Vectors whose images show the angles: n₃, n₂ and n₂ × n₃.
    shown: [Vector3<f64>; 3],
    /// Of the lift and of the wrist.
    lift: JointScale,
    wrist: [JointScale; 3],
}

/// Eight poses of the tip, each with a yaw of the base from which others are counted.
#[derive(Clone, Debug)]
pub struct TipBatch {
    /// The wrist's centre, in m.
    centre: [f32x8; 3],
    /// Where what shows the angles points.
    shown: [[f32x8; 3]; 3],
    yaws: [f64; LANES],
    sin: f32x8,
    cos: f32x8,
}

/// How a joint's value follows from its angle, and where it has to be.
#[derive(Clone, Copy, Debug)]
struct JointScale {
    scale: f32,
    offset: f32,
    lower: f32,
    upper: f32,
}

/// Candidates at one value of the shoulder, one for each of eight poses.
#[derive(Clone, Copy, Debug)]
pub struct CandidateBatch {
    /// Value of the shoulder's variable.
    pub shoulder: f64,
    /// Values of the lift's variable.
    pub lift: f32x8,
    /// The base's yaws in rad, in [−π, π].
    pub yaws: [f64; LANES],
    /// The base's places, x then y, in m from the origin of the poses.
    pub base: [f32x8; 2],
    /// The two ways to hold the wrist.
    pub branches: [WristBranch; 2],
}

/// One way to hold the wrist.
#[derive(Clone, Copy, Debug)]
pub struct WristBranch {
    /// Values of the wrist's variables.
    pub values: [f32x8; 3],
    /// A bit for each lane, the first lowest: whether all values are within the limits, to about 1e-6 rad.
    pub allowed: u8,
}

impl<'a> BatchSolver<'a> {
    /// What an arm's candidates need.
    #[must_use]
    pub fn new(arm: &'a LiftArm) -> Self {
        let [one, two, three] = arm.wrist;
        let bend = atan2_of_one(three.dot(&two.cross(&one)), three.dot(&one));
        Self {
            bend: bend as f32,
            shown: [three, two, two.cross(&three)],
            lift: JointScale::new(arm, 0),
            wrist: std::array::from_fn(|at| JointScale::new(arm, at + 2)),
            arm,
        }
    }

    /// Poses, seen from an origin on the floor, each with the yaw from which others are counted, in rad: at most eight, and of
    /// fewer the first stands in the lanes that are left.
    #[must_use]
    pub fn poses(&self, poses: &[(Isometry3<f64>, f64)], [x, y]: [f64; 2]) -> TipBatch {
        let lane = |lane: usize| poses.get(lane).or(poses.first()).copied().unwrap_or_default();
        let all: [(Isometry3<f64>, f64); LANES] = std::array::from_fn(lane);
        let lanes = |each: &dyn Fn(&Isometry3<f64>) -> Vector3<f64>| {
            let found = all.map(|(pose, _)| each(&pose));
            [
                f32x8::new(found.map(|it| it.x as f32)),
                f32x8::new(found.map(|it| it.y as f32)),
                f32x8::new(found.map(|it| it.z as f32)),
            ]
        };
        let back = self.arm.base_from_tip.inverse();
        let yaws = all.map(|(_, yaw)| yaw);
        let waves = yaws.map(sin_cos);
        TipBatch {
            centre: lanes(&|pose| self.arm.centre(pose).coords - Vector3::new(x, y, 0.0)),
            shown: self.shown.map(|vector| lanes(&|pose| pose.rotation * (back * vector))),
            yaws,
            sin: f32x8::new(waves.map(|(sin, _)| sin as f32)),
            cos: f32x8::new(waves.map(|(_, cos)| cos as f32)),
        }
    }

    /// The candidates with the base turned on by `further` rad from the yaw of each pose, at a value of the shoulder's variable.
    #[must_use]
    pub fn block(&self, poses: &TipBatch, further: f64, shoulder: f64) -> CandidateBatch {
        let splat = f32x8::splat;
        let (sin, cos) = sin_cos(further);
        let (sin, cos) = (splat(sin as f32), splat(cos as f32));
        let (sin, cos) = (poses.sin * cos + poses.cos * sin, poses.cos * cos - poses.sin * sin);
        let held = ShoulderPose::new(self.arm, shoulder);
        let (px, py, pz) = (splat(held.wrist.x), splat(held.wrist.y), splat(held.wrist.z));
        let [x, y, z] = poses.centre;
        let up = splat(self.arm.up as f32);
        let lift = ((z - pz) * up - splat(self.lift.offset)) * splat(self.lift.scale);
        let is_lifted = lift.simd_ge(splat(self.lift.lower)).to_bitmask()
            & lift.simd_le(splat(self.lift.upper)).to_bitmask();
        let base = [x - (cos * px - sin * py), y - (sin * px + cos * py)];
        // The base turns by the yaw; seen from it, what is shown turns back.
        let [three, two, side] = poses.shown.map(|[x, y, z]| [cos * x + sin * y, cos * y - sin * x, z]);
        let dot = |axis: &Vector3<f32>, [x, y, z]: [f32x8; 3]| {
            splat(axis.x) * x + splat(axis.y) * y + splat(axis.z) * z
        };
        let [one, second, third] = &held.frame;
        let (p1, p2, p3) = (dot(one, three), dot(second, three), dot(third, three));
        let (r2, r3) = (dot(one, two), dot(one, side));
        let zero = splat(0.0);
        let (middle, bend) = (atan2((p2 * p2 + p3 * p3).sqrt(), p1), splat(self.bend));
        let (first, last) = (atan2(p2, p3), atan2(r2, zero - r3));
        let half = splat(std::f32::consts::PI);
        let mut branches = [
            self.branch([first, middle - bend, last]),
            self.branch([first + half, zero - middle - bend, last + half]),
        ];
        branches.iter_mut().for_each(|branch| branch.allowed &= is_lifted as u8);
        let yaws = poses.yaws.map(|yaw| wrapped(yaw + further));
        CandidateBatch { shoulder, lift, yaws, base, branches }
    }

    #[inline]
    fn branch(&self, angles: [f32x8; 3]) -> WristBranch {
        let mut values = angles;
        let mut allowed = 0xff;
        for (value, limits) in values.iter_mut().zip(&self.wrist) {
            let found =
                above((*value - f32x8::splat(limits.offset)) * f32x8::splat(limits.scale), limits.lower);
            allowed &= found.simd_le(f32x8::splat(limits.upper)).to_bitmask() as u8;
            *value = found;
        }
        WristBranch { values, allowed }
    }
}

/// The arm at a value of the shoulder.
struct ShoulderPose {
    /// From the base to the wrist's centre with the lift at position 0.
    wrist: Vector3<f32>,
    /// n₁, n₂ and n₂ × n₁, as the shoulder turns them.
    frame: [Vector3<f32>; 3],
}

impl ShoulderPose {
    fn new(arm: &LiftArm, value: f64) -> Self {
        let angle = arm.chain.joints.get(1).map_or(0.0, |joint| joint.coupling.position(&[0.0, value]));
        let turn = |vector: &Vector3<f64>| turned(&arm.shoulder.axis, angle, vector);
        let [one, two, _] = &arm.wrist;
        Self {
            wrist: (arm.shoulder.point + turn(&arm.shoulder.to_wrist)).cast::<f32>(),
            frame: [turn(one), turn(two), turn(&two.cross(one))].map(|vector| vector.cast::<f32>()),
        }
    }
}

impl JointScale {
    fn new(arm: &LiftArm, at: usize) -> Self {
        let (scale, offset) = arm
            .chain
            .joints
            .get(at)
            .map_or((1.0, 0.0), |joint| (1.0 / joint.coupling.multiplier, joint.coupling.offset));
        // Of a wrist joint one turn, of the lift all.
        let range = |dof: &Dof| dof.limits.filter(|_| at == 0).unwrap_or(dof.sampling_range());
        let (lower, upper) = arm.chain.dofs.get(at).map_or((0.0, 0.0), range);
        Self { scale: scale as f32, offset: offset as f32, lower: lower as f32, upper: upper as f32 }
    }
}
