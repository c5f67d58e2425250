//! The joints between two links, with everything fixed folded into the poses between them: what inverse kinematics
//! works on.

use nalgebra::{Isometry3, Translation3, Unit, Vector3};

use super::tree::{Dof, JointCoupling, JointMotion, KinematicTree};
use crate::trigonometry::turn;

/// The moving joints from a base link to a tip link, of which the base is on the way from the root to the tip.
///
/// The pose of the tip is `joints[0].before * motion(0) * joints[1].before * … * motion(n-1) * last_from_tip`.
#[derive(Clone, PartialEq, Debug)]
pub struct KinematicChain {
    /// The joints, base first.
    pub joints: Vec<ChainJoint>,
    /// From the frame after the last joint to the tip.
    pub last_from_tip: Isometry3<f64>,
    /// The variables that move the joints, each once, in the order in which they first move one.
    pub dofs: Vec<Dof>,
    /// For each variable of the chain its index in the tree's configuration.
    pub in_tree: Vec<usize>,
}

/// One joint of a chain.
#[derive(Clone, PartialEq, Debug)]
pub struct ChainJoint {
    /// From the frame after the previous joint to this joint's own.
    pub before: Isometry3<f64>,
    /// Its axis or direction, in its own frame.
    pub axis: Unit<Vector3<f64>>,
    /// Whether it slides, and does not turn.
    pub is_prismatic: bool,
    /// Its position in terms of the chain's variables.
    pub coupling: JointCoupling,
}

impl ChainJoint {
    /// The joint's motion at a position.
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
    /// The chain between two links by index; `None` where the base does not carry the tip. O(links).
    ///
    /// A planar joint becomes two that slide and one that turns.
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

    /// The pose of the tip in the base's frame; one value for each variable of the chain. O(joints).
    #[must_use]
    pub fn base_from_tip(&self, values: &[f64]) -> Isometry3<f64> {
        let moved = self.joints.iter().fold(Isometry3::identity(), |pose, joint| {
            pose * joint.before * joint.motion(joint.coupling.position(values))
        });
        moved * self.last_from_tip
    }

    /// Whether values are within the limits of every variable.
    #[must_use]
    pub fn allows(&self, values: &[f64]) -> bool {
        values.len() == self.dofs.len()
            && self.dofs.iter().zip(values).all(|(known, value)| known.allows(*value))
    }
}
