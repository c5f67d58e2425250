//! The joints that some variables move, with all that others hold still folded into the poses between them.

use nalgebra::{Isometry3, Translation3, Unit, Vector3};

use super::tree::{JointCoupling, JointMotion, KinematicTree};
use crate::trigonometry::turn;

/// A robot of which only some joints move. Frame 0 is the root's, frame `n` + 1 that of joint `n`.
#[derive(Clone, Debug)]
pub(crate) struct ReducedModel {
    /// Each after the one that carries it.
    pub(crate) joints: Vec<ReducedJoint>,
    /// For each link the frame that it does not move in, and its pose in it.
    pub(crate) links: Vec<(usize, Isometry3<f64>)>,
}

/// A joint of a [`ReducedModel`].
#[derive(Clone, Debug)]
pub(crate) struct ReducedJoint {
    /// The frame that carries it.
    pub(crate) parent: usize,
    /// Its pose in that frame.
    pub(crate) before: Isometry3<f64>,
    /// Its axis or direction, in its own frame.
    pub(crate) axis: Unit<Vector3<f64>>,
    /// Whether it slides, and does not turn.
    pub(crate) is_prismatic: bool,
    /// Its position in terms of the tree's variables.
    pub(crate) coupling: JointCoupling,
}

impl ReducedJoint {
    /// The joint's motion at a position.
    pub(crate) fn motion(&self, position: f64) -> Isometry3<f64> {
        if self.is_prismatic {
            Translation3::from(self.axis.into_inner() * position).into()
        } else {
            Isometry3::from_parts(Translation3::identity(), turn(&self.axis, position))
        }
    }
}

impl KinematicTree {
    /// The rig in which only these variables move and the others are as in a configuration; `None` where one of them moves a planar
    /// joint. O(links).
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
