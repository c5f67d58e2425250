//! How far the robot goes on a leg, bounded joint by joint from the link outwards: a joint that turns by `a` moves a point at
//! a distance `r` from its axis by at most `a r`.

use nalgebra::Isometry3;

use crate::collision::Solid;
use crate::kinematics::AncestorJoint;
use crate::planning::scene::configuration::Configuration;

/// A leg of the straight way between two states, seen from its middle.
#[derive(Clone, Copy)]
pub(crate) struct MotionBound<'a> {
    pub(crate) from: &'a Configuration,
    pub(crate) to: &'a Configuration,
    /// From the middle to either end, as a share of the whole way.
    pub(crate) half: f64,
}

impl MotionBound<'_> {
    /// How far any point of a solid goes at most while levers move it, until the ends of the leg. Links are where `poses` say,
    /// and a ball of the radius `reach` about its centre holds the solid.
    pub(crate) fn by(
        &self,
        ancestors: &[AncestorJoint],
        poses: &[Isometry3<f64>],
        solid: &Solid,
        reach: f64,
    ) -> f64 {
        let change = |at: usize| {
            let value = |joints: &[f64]| joints.get(at).copied().unwrap_or(0.0);
            (value(&self.to.joints) - value(&self.from.joints)).abs() * self.half
        };
        let mut goes = 0.0;
        for ancestor in ancestors.iter().rev() {
            let amount = change(ancestor.coupling.dof) * ancestor.coupling.multiplier.abs();
            if amount == 0.0 {
                continue;
            }
            goes += if ancestor.is_prismatic {
                amount
            } else {
                let pose = poses.get(ancestor.frame).copied().unwrap_or_default();
                let axis = pose.rotation * ancestor.axis.into_inner();
                let arm = (solid.centre - pose.translation.vector).cross(&axis).norm() + reach;
                amount * (arm + goes)
            };
        }
        goes
    }

    /// The same in the map, with the base in the middle of the leg at `base`.
    pub(crate) fn in_map(
        &self,
        base: [f64; 3],
        ancestors: &[AncestorJoint],
        poses: &[Isometry3<f64>],
        solid: &Solid,
        reach: f64,
    ) -> f64 {
        let goes = self.by(ancestors, poses, solid, reach);
        let ([x, y, yaw], [to_x, to_y, to_yaw]) = (self.from.base, self.to.base);
        let (dx, dy, turn) = (to_x - x, to_y - y, (to_yaw - yaw).abs() * self.half);
        let shift = (dx * dx + dy * dy).sqrt() * self.half;
        if turn == 0.0 {
            return goes + shift;
        }
        let [base_x, base_y, _] = base;
        let (dx, dy) = (solid.centre.x - base_x, solid.centre.y - base_y);
        let arm = (dx * dx + dy * dy).sqrt() + reach;
        goes + turn * (arm + goes) + shift
    }
}
