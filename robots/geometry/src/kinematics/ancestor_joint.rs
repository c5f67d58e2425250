//! Which joints move a link, to bound how far any of its points can go.

use nalgebra::{Unit, Vector3};

use super::tree::{JointCoupling, JointMotion, KinematicTree};

/// A joint on the way from the root to a link.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct AncestorJoint {
    /// Index of the link whose frame sits in the joint.
    pub frame: usize,
    /// Its axis or direction, in that frame.
    pub axis: Unit<Vector3<f64>>,
    /// Whether it slides, and does not turn.
    pub is_prismatic: bool,
    /// Its position in terms of a configuration.
    pub coupling: JointCoupling,
}

impl KinematicTree {
    /// The joints that move a link, by index, root first. Of a planar joint the directions are those of its frame as
    /// turned, which leaves their lengths as they are. O(links).
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
