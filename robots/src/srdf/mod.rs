//! SRDF: groups of links and joints, end effectors, and pairs of links that may touch. It is read against the
//! URDF, so every name in it refers to a link or joint. Virtual and passive joints, spheres and states are
//! skipped.

mod errors;
mod read;

use indexmap::IndexMap;
use smol_str::SmolStr;

pub use errors::CODES;
pub use read::read;

/// SRDF after reading; links and joints are indices into the URDF.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Srdf {
    /// Groups by name.
    pub groups: IndexMap<SmolStr, JointGroup>,
    /// End effectors by name.
    pub end_effectors: IndexMap<SmolStr, EndEffector>,
    /// Pairs of links that may touch, the lower index first, sorted, each once.
    pub disabled: Vec<[usize; 2]>,
}

/// Links and joints that are planned together.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct JointGroup {
    pub links: Vec<usize>,
    pub joints: Vec<usize>,
    /// Chains, from base link to tip link.
    pub chains: Vec<[usize; 2]>,
    /// Other groups that belong to it.
    pub groups: Vec<SmolStr>,
}

/// End effector: a hand on an arm.
#[derive(Clone, PartialEq, Debug)]
pub struct EndEffector {
    /// Group of its own links and joints.
    pub group: SmolStr,
    /// Link on which it is mounted.
    pub parent: usize,
}
