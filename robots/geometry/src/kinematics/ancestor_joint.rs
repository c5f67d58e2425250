//! Ancestor joints of a link: the joints that move it, for bounds on the motion of its points.

use nalgebra::{Unit, Vector3};

use super::tree::{JointCoupling, JointMotion, KinematicTree};

/// Joint between the root and a link.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct AncestorJoint {
    /// Index of the link whose frame is that of the joint.
    pub frame: usize,
    /// Axis of rotation or direction of travel, in that frame.
    pub axis: Unit<Vector3<f64>>,
    /// True for a prismatic joint, false for a revolute one.
    pub is_prismatic: bool,
    /// Coupling to a degree of freedom.
    pub coupling: JointCoupling,
}

impl KinematicTree {
    /// Joints that move a link, root first. For a planar joint the directions are those of its rotated frame,
    /// which keeps lengths. O(links).
    #[must_use]
    pub fn ancestor_joints(&self, link: usize) -> Vec<AncestorJoint> {
        let mut ancestors = Vec::new();
        for segment in self.segments_to(link).into_iter().filter_map(|segment| self.segments.get(segment)) {
            let mut add = |axis, is_prismatic, coupling| {
                ancestors.push(AncestorJoint { frame: segment.child, axis, is_prismatic, coupling });
            };
            match &segment.motion {
                JointMotion::Fixed => {}
                JointMotion::Turn(axis, coupling) => add(*axis, false, *coupling),
                JointMotion::Slide(axis, coupling) => add(*axis, true, *coupling),
                JointMotion::Planar { axes: [x, y, normal], first } => {
                    for (axis, is_prismatic, dof) in
                        [(x, true, *first), (y, true, first + 1), (normal, false, first + 2)]
                    {
                        add(*axis, is_prismatic, JointCoupling { dof, multiplier: 1.0, offset: 0.0 });
                    }
                }
            }
        }
        ancestors
    }
}
