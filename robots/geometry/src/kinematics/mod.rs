//! Forward kinematics: the tree of a URDF, flattened, and the poses of its links.

mod ancestor_joint;
mod chain;
mod edge_poses;
mod forward;
mod quasi_random;
mod reduced_model;
mod tree;

pub use ancestor_joint::AncestorJoint;
pub use chain::{ChainJoint, KinematicChain};
pub use edge_poses::EdgePoses;
pub use quasi_random::quasi_random;
pub(crate) use quasi_random::quasi_random_in;
pub(crate) use reduced_model::{ReducedJoint, ReducedModel};
pub use tree::{Dof, KinematicTree, UnknownName};
pub(crate) use tree::{JointCoupling, isometry};

pub use crate::trigonometry::planar;
