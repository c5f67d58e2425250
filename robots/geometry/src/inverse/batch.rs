//! Solution family of a [`LiftArm`] for eight poses of the tip at a time, in `f32`: the hot path of a query
//! that searches a collision-free member of the family. Its results are candidates; [`LiftArm::solve`] at the
//! same yaw and shoulder value confirms them in `f64`.
//!
//! Let the axes of the wrist be n₁ ⊥ n₂ ⊥ n₃, and M the rotation that they make up. In the frame (n₁, n₂, n₂
//! × n₁) the vector M n₃ has the cosine of the middle angle as its first component, and the sine and cosine
//! of the first angle, times the sine of the middle one, as the others. Mᵀ n₁ gives the last angle likewise.
//! The two branches are the signs of that sine.
//!
//! The angles of eight vectors take only sums, products, quotients, square roots and comparisons, unfused:
//! IEEE 754 fixes them to the last bit on every processor, where the arc tangent of a library may fuse
//! products with sums.

use nalgebra::{Isometry3, Vector3};
use wide::f32x8;

use super::lift_arm::LiftArm;
use super::screw::turned;
use crate::kinematics::Dof;
use crate::trigonometry::{atan2 as atan2_of_one, sin_cos, wrapped};

/// Number of poses in a batch.
pub const LANES: usize = 8;

/// Batch solver for one arm; built once for a query.
#[derive(Clone, Debug)]
pub struct BatchSolver<'a> {
    arm: &'a LiftArm,
    /// Angle from the third axis back to the first, about the second.
    bend: f32,
    /// Vectors whose images show the angles: n₃, n₂ and n₂ × n₃.
    shown: [Vector3<f64>; 3],
    /// Scales and limits of the lift and of the wrist joints.
    lift: JointScale,
    wrist: [JointScale; 3],
}

/// Eight poses of the tip, each with a reference yaw of the base.
#[derive(Clone, Debug)]
pub struct TipBatch {
    /// Centre of the wrist, in m.
    centre: [f32x8; 3],
    /// Images of the vectors that show the angles.
    shown: [[f32x8; 3]; 3],
    yaws: [f64; LANES],
    sin: f32x8,
    cos: f32x8,
}

/// Linear map from angles to values of a joint, and its limits.
#[derive(Clone, Copy, Debug)]
struct JointScale {
    scale: f32,
    offset: f32,
    lower: f32,
    upper: f32,
}

/// Candidates for one value of the shoulder, one for each of eight poses.
#[derive(Clone, Copy, Debug)]
pub struct CandidateBatch {
    /// Value of the shoulder joint.
    pub shoulder: f64,
    /// Values of the lift joint.
    pub lift: f32x8,
    /// Yaws of the base, in rad, in [−π, π].
    pub yaws: [f64; LANES],
    /// Positions of the base, x then y, in m from the origin of the poses.
    pub base: [f32x8; 2],
    /// The two branches of the wrist.
    pub branches: [WristBranch; 2],
}

/// One branch of the wrist.
#[derive(Clone, Copy, Debug)]
pub struct WristBranch {
    /// Values of the wrist joints.
    pub values: [f32x8; 3],
    /// Bit mask of the lanes, the first lowest, in which all values are within the limits to about 1e-6 rad.
    pub allowed: u8,
}

impl<'a> BatchSolver<'a> {
    /// Prepares the solver for an arm.
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

    /// Prepares at most eight poses with their reference yaws in rad, relative to an origin on the floor. The
    /// first pose fills the lanes that are left.
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

    /// Candidates with the base at `further` rad from the reference yaw of each pose, for one value of the
    /// shoulder.
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
        // Relative to the base, the vectors rotate by minus the yaw.
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

/// Arm at one value of the shoulder.
struct ShoulderPose {
    /// From the base to the centre of the wrist with the lift at position 0.
    wrist: Vector3<f32>,
    /// n₁, n₂ and n₂ × n₁, rotated by the shoulder.
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
        // One turn of a wrist joint, the whole range of the lift.
        let range = |dof: &Dof| dof.limits.filter(|_| at == 0).unwrap_or(dof.sampling_range());
        let (lower, upper) = arm.chain.dofs.get(at).map_or((0.0, 0.0), range);
        Self { scale: scale as f32, offset: offset as f32, lower: lower as f32, upper: upper as f32 }
    }
}

/// Coefficients of arctan(t) = t + t³ (c0 + c1 t² + …) for |t| ≤ 1, fitted at Chebyshev points; error at most
/// 1.2e-7.
const ARC: [f32; 8] = [
    -0.333_333_25,
    0.199_988_1,
    -0.142_590_37,
    0.108_774_08,
    -0.080_422_95,
    0.049_384_937,
    -0.020_364_47,
    0.003_962_159,
];

pub(super) const TURN: f32 = std::f32::consts::TAU;

/// Angles of the vectors (x, y), in [−π, π]; 0 for the zero vector.
pub(super) fn atan2(y: f32x8, x: f32x8) -> f32x8 {
    let (zero, one) = (f32x8::splat(0.0), f32x8::splat(1.0));
    let (ax, ay) = (x.abs(), y.abs());
    let steep = ax.simd_lt(ay);
    let (small, large) = (steep.select(ax, ay), steep.select(ay, ax));
    let ratio = small / large.simd_le(zero).select(one, large);
    let square = ratio * ratio;
    let mut sum = f32x8::splat(0.0);
    for coefficient in ARC.iter().rev() {
        sum = sum * square + f32x8::splat(*coefficient);
    }
    let angle = ratio + ratio * square * sum;
    let angle = steep.select(f32x8::splat(std::f32::consts::FRAC_PI_2) - angle, angle);
    let angle = x.simd_lt(zero).select(f32x8::splat(std::f32::consts::PI) - angle, angle);
    y.simd_lt(zero).select(zero - angle, angle)
}

/// Shifts angles by full turns into [`least`, `least` + 2π).
pub(super) fn above(angle: f32x8, least: f32) -> f32x8 {
    let least = f32x8::splat(least);
    angle - ((angle - least) * f32x8::splat(1.0 / TURN)).floor() * f32x8::splat(TURN)
}

#[cfg(test)]
mod tests {
    use super::{above, atan2};
    use wide::f32x8;

    #[test]
    fn atan2_is_accurate_all_around() {
        for step in 0..10_000_u16 {
            let angle = (f64::from(step) / 5000.0 - 1.0) * std::f64::consts::PI * 0.999_999;
            let (x, y) = ((angle.cos() * 0.3) as f32, (angle.sin() * 0.3) as f32);
            let found = f64::from(atan2(f32x8::splat(y), f32x8::splat(x)).to_array()[0]);
            assert!((found - f64::from(y).atan2(f64::from(x))).abs() < 5e-7, "{angle}: {found}");
        }
        assert_eq!(atan2(f32x8::splat(0.0), f32x8::splat(0.0)).to_array()[0], 0.0);
        let wrapped = above(f32x8::splat(-3.0), -2.0).to_array()[0];
        assert!((f64::from(wrapped) - (std::f64::consts::TAU - 3.0)).abs() < 1e-6);
    }
}
