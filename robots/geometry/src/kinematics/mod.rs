//! Forward kinematics: the kinematic tree of a URDF, flattened, and the poses of its links.

mod chain;
mod forward;
mod tree;

pub use crate::trigonometry::planar;
pub use chain::{AncestorJoint, ChainJoint, KinematicChain};
pub(crate) use chain::{ReducedJoint, ReducedModel};
pub use forward::EdgePoses;
pub use tree::{Dof, KinematicTree, UnknownName, quasi_random};
pub(crate) use tree::{JointCoupling, isometry, quasi_random_in};
