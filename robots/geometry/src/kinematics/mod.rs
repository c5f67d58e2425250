//! Forward kinematics: the tree of a URDF, flattened, and the poses of its links.

mod along;
mod chain;
mod forward;
mod lever;
mod rig;
mod spread;
mod tree;

pub use along::Along;
pub use chain::{Chain, ChainJoint};
pub use lever::Lever;
pub(crate) use rig::{Rig, RigJoint};
pub use spread::spread;
pub(crate) use spread::spread_over;
pub(crate) use tree::{Driver, isometry};
pub use tree::{Tree, UnknownName, Variable};

pub use crate::trigonometry::planar;
