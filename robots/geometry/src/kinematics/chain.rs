//! Parts of a kinematic tree: the chain between two links, on which inverse kinematics works; the joints that
//! move a link; and the tree reduced to some free joints. Fixed parts are folded into the poses between.

use nalgebra::{Isometry3, Translation3, Unit, Vector3};

use super::tree::{Dof, JointCoupling, JointMotion, KinematicTree};
use crate::trigonometry::turn;

/// Kinematic chain from a base link to a tip link, where the base carries the tip.
///
/// The pose of the tip is `joints[0].before * motion(0) * joints[1].before * … * motion(n-1) *
/// last_from_tip`.
///
/// ```
/// use motet_geometry::KinematicTree;
/// use motet_geometry::kinematics::KinematicChain;
/// use motet_robots::builtin;
///
/// let tree = KinematicTree::new(&builtin::robot("panda").unwrap().urdf);
/// let chain = KinematicChain::new(&tree, tree.root(), tree.link("panda_hand").unwrap()).unwrap();
/// assert_eq!(chain.dofs.len(), 7);
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct KinematicChain {
    /// Joints, base first.
    pub joints: Vec<ChainJoint>,
    /// Pose of the tip in the frame after the last joint.
    pub last_from_tip: Isometry3<f64>,
    /// Degrees of freedom of the chain, each once, in the order of the first joint that each moves.
    pub dofs: Vec<Dof>,
    /// For each degree of freedom of the chain, its index in a configuration of the tree.
    pub in_tree: Vec<usize>,
}

/// Joint of a chain.
#[derive(Clone, PartialEq, Debug)]
pub struct ChainJoint {
    /// Pose of the joint in the frame after the previous one.
    pub before: Isometry3<f64>,
    /// Axis of rotation or direction of travel, in the frame of the joint.
    pub axis: Unit<Vector3<f64>>,
    /// True for a prismatic joint, false for a revolute one.
    pub is_prismatic: bool,
    /// Coupling to a degree of freedom of the chain.
    pub coupling: JointCoupling,
}

impl ChainJoint {
    /// Rigid motion of the joint at a position.
    #[must_use]
    pub fn motion(&self, position: f64) -> Isometry3<f64> {
        if self.is_prismatic {
            Translation3::from(self.axis.into_inner() * position).into()
        } else {
            Isometry3::from_parts(Translation3::identity(), turn(&self.axis, position))
        }
    }
}

impl KinematicChain {
    /// Builds the chain between two links by index; `None` if the base does not carry the tip. O(links).
    ///
    /// A planar joint becomes two prismatic joints and a revolute one.
    #[must_use]
    pub fn new(tree: &KinematicTree, base: usize, tip: usize) -> Option<Self> {
        let (from_base, from_tip) = (tree.segments_to(base), tree.segments_to(tip));
        let segments = from_tip.strip_prefix(from_base.as_slice())?;
        let mut chain =
            Self { joints: vec![], last_from_tip: Isometry3::identity(), dofs: vec![], in_tree: vec![] };
        for segment in segments.iter().filter_map(|segment| tree.segments.get(*segment)) {
            chain.last_from_tip *= segment.parent_from_joint;
            match &segment.motion {
                JointMotion::Fixed => {}
                JointMotion::Turn(axis, coupling) => chain.push(tree, *axis, false, *coupling),
                JointMotion::Slide(axis, coupling) => chain.push(tree, *axis, true, *coupling),
                JointMotion::Planar { axes: [x, y, normal], first } => {
                    for (axis, is_prismatic, dof) in
                        [(x, true, *first), (y, true, first + 1), (normal, false, first + 2)]
                    {
                        chain.push(
                            tree,
                            *axis,
                            is_prismatic,
                            JointCoupling { dof, multiplier: 1.0, offset: 0.0 },
                        );
                    }
                }
            }
        }
        Some(chain)
    }

    fn push(
        &mut self,
        tree: &KinematicTree,
        axis: Unit<Vector3<f64>>,
        is_prismatic: bool,
        coupling: JointCoupling,
    ) {
        let known = self.in_tree.iter().position(|at| *at == coupling.dof);
        let dof = known.unwrap_or(self.in_tree.len());
        if known.is_none() {
            self.in_tree.push(coupling.dof);
            self.dofs.extend(tree.dofs().get(coupling.dof).cloned());
        }
        let before = std::mem::replace(&mut self.last_from_tip, Isometry3::identity());
        self.joints.push(ChainJoint {
            before,
            axis,
            is_prismatic,
            coupling: JointCoupling { dof, ..coupling },
        });
    }

    /// Pose of the tip in the frame of the base, for one value per degree of freedom. O(joints).
    #[must_use]
    pub fn base_from_tip(&self, values: &[f64]) -> Isometry3<f64> {
        let moved = self.joints.iter().fold(Isometry3::identity(), |pose, joint| {
            pose * joint.before * joint.motion(joint.coupling.position(values))
        });
        moved * self.last_from_tip
    }

    /// Checks whether values are within the limits of every degree of freedom.
    #[must_use]
    pub fn allows(&self, values: &[f64]) -> bool {
        values.len() == self.dofs.len()
            && self.dofs.iter().zip(values).all(|(known, value)| known.allows(*value))
    }
}

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
