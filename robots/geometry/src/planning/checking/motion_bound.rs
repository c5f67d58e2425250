//! Motion bound: an upper bound for the distance that a part moves along a segment of an edge (Schwarzer,
//! Saha and Latombe 2005).
//!
//! The bound adds up joint by joint from the link outwards: a joint that turns by `a` moves a point at a
//! distance `r` from its axis by at most `a r`.

use nalgebra::Isometry3;

use crate::collision::Solid;
use crate::kinematics::AncestorJoint;
use crate::planning::scene::configuration::Configuration;

/// Motion bounds on one segment of an edge, from its middle to either end.
#[derive(Clone, Copy)]
pub(crate) struct MotionBound<'a> {
    pub(crate) from: &'a Configuration,
    pub(crate) to: &'a Configuration,
    /// Half of the segment's length as a share of the edge.
    pub(crate) half: f64,
}

impl MotionBound<'_> {
    /// Greatest distance in m that a point of a solid moves by some joints. `poses` are the link poses at
    /// the middle; a ball of radius `reach` about its centre holds the solid.
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

    /// Greatest distance in the map, which adds the motion of the base.
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
