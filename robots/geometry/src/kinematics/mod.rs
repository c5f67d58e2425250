//! Forward kinematics: the tree of a URDF, flattened, and the poses of its links.

mod along;
mod chain;
mod forward;
mod lever;
mod spread;
mod tree;

pub use along::Along;
pub use chain::{Chain, ChainJoint};
pub use lever::Lever;
pub use spread::spread;
pub(crate) use tree::isometry;
pub use tree::{Tree, UnknownName, Variable};

pub use crate::trigonometry::planar;
