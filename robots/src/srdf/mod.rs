//! What a SRDF adds to a URDF: groups of links and joints, end effectors, and pairs of links that may touch. Read against
//! the URDF, so that every name in it stands for something. Virtual and passive joints, spheres and states are passed over.

mod errors;
mod read;

use indexmap::IndexMap;
use smol_str::SmolStr;

pub use errors::CODES;
pub use read::read;

/// A SRDF after reading; links and joints are indices into the URDF.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Srdf {
    /// Groups by name.
    pub groups: IndexMap<SmolStr, JointGroup>,
    /// End effectors by name.
    pub end_effectors: IndexMap<SmolStr, EndEffector>,
    /// Pairs of links whose collision does not count, the lower index first, sorted, each once.
    pub disabled: Vec<[usize; 2]>,
}

/// Parts that are planned for together.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct JointGroup {
    /// Links.
    pub links: Vec<usize>,
    /// Joints.
    pub joints: Vec<usize>,
    /// Chains, from base link to tip link.
    pub chains: Vec<[usize; 2]>,
    /// Other groups that belong to it.
    pub groups: Vec<SmolStr>,
}

/// A hand.
#[derive(Clone, PartialEq, Debug)]
pub struct EndEffector {
    /// The group of its own links and joints.
    pub group: SmolStr,
    /// The link that it is mounted on.
    pub parent: usize,
}
