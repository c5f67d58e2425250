//! Reduced model: the joints that some degrees of freedom move, with all others fixed and folded into the
//! poses between.

use nalgebra::{Isometry3, Translation3, Unit, Vector3};

use super::tree::{JointCoupling, JointMotion, KinematicTree};
use crate::trigonometry::turn;

/// Robot with only some joints free. Frame 0 is that of the root, frame `n` + 1 that of joint `n`.
#[derive(Clone, Debug)]
pub(crate) struct ReducedModel {
    /// Joints, each after the one that carries it.
    pub(crate) joints: Vec<ReducedJoint>,
    /// For each link the frame to which it is fixed, and its pose in that frame.
    pub(crate) links: Vec<(usize, Isometry3<f64>)>,
}

/// Joint of a [`ReducedModel`].
#[derive(Clone, Debug)]
pub(crate) struct ReducedJoint {
    /// Index of the parent frame.
    pub(crate) parent: usize,
    /// Pose of the joint in the parent frame.
    pub(crate) before: Isometry3<f64>,
    /// Axis of rotation or direction of travel, in the frame of the joint.
    pub(crate) axis: Unit<Vector3<f64>>,
    /// True for a prismatic joint, false for a revolute one.
    pub(crate) is_prismatic: bool,
    /// Coupling to a degree of freedom of the tree.
    pub(crate) coupling: JointCoupling,
}

impl ReducedJoint {
    /// Rigid motion of the joint at a position.
    pub(crate) fn motion(&self, position: f64) -> Isometry3<f64> {
        if self.is_prismatic {
            Translation3::from(self.axis.into_inner() * position).into()
        } else {
            Isometry3::from_parts(Translation3::identity(), turn(&self.axis, position))
        }
    }
}

impl KinematicTree {
    /// Reduced model in which only the selected degrees of freedom move and the others are as in a
    /// configuration; `None` if one of them moves a planar joint. O(links).
    pub(crate) fn reduced(
        &self,
        configuration: &[f64],
        is_free: impl Fn(usize) -> bool,
    ) -> Option<ReducedModel> {
        let mut reduced =
            ReducedModel { joints: vec![], links: vec![(0, Isometry3::identity()); self.links().len()] };
        for segment in &self.segments {
            let (frame, pose) = reduced.links.get(segment.parent).copied()?;
            let moved = match &segment.motion {
                JointMotion::Turn(axis, coupling) if is_free(coupling.dof) => Some((axis, false, coupling)),
                JointMotion::Slide(axis, coupling) if is_free(coupling.dof) => Some((axis, true, coupling)),
                JointMotion::Planar { first, .. } if (*first..first + 3).any(&is_free) => return None,
                JointMotion::Fixed
                | JointMotion::Turn(..)
                | JointMotion::Slide(..)
                | JointMotion::Planar { .. } => None,
            };
            let link = match moved {
                Some((axis, is_prismatic, coupling)) => {
                    let before = pose * segment.parent_from_joint;
                    reduced.joints.push(ReducedJoint {
                        parent: frame,
                        before,
                        axis: *axis,
                        is_prismatic,
                        coupling: *coupling,
                    });
                    (reduced.joints.len(), Isometry3::identity())
                }
                None => (frame, pose * segment.pose(configuration)),
            };
            *reduced.links.get_mut(segment.child)? = link;
        }
        Some(reduced)
    }
}
