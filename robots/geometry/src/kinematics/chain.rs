//! The joints between two links, with everything fixed folded into the poses between them: what inverse kinematics
//! works on.

use nalgebra::{Isometry3, Translation3, Unit, Vector3};

use super::tree::{Driver, Motion, Tree, Variable};
use crate::trigonometry::turn;

/// The moving joints from a base link to a tip link, of which the base is on the way from the root to the tip.
///
/// The pose of the tip is `joints[0].before * motion(0) * joints[1].before * … * motion(n-1) * last_from_tip`.
#[derive(Clone, PartialEq, Debug)]
pub struct Chain {
    /// The joints, base first.
    pub joints: Vec<ChainJoint>,
    /// From the frame after the last joint to the tip.
    pub last_from_tip: Isometry3<f64>,
    /// The variables that move the joints, each once, in the order in which they first move one.
    pub variables: Vec<Variable>,
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
    pub slides: bool,
    /// Its position in terms of the chain's variables.
    pub driver: Driver,
}

impl ChainJoint {
    /// The joint's motion at a position.
    #[must_use]
    pub fn motion(&self, position: f64) -> Isometry3<f64> {
        if self.slides {
            Translation3::from(self.axis.into_inner() * position).into()
        } else {
            Isometry3::from_parts(Translation3::identity(), turn(&self.axis, position))
        }
    }
}

impl Chain {
    /// The chain between two links by index; `None` where the base does not carry the tip. O(links).
    ///
    /// A planar joint becomes two that slide and one that turns.
    #[must_use]
    pub fn new(tree: &Tree, base: usize, tip: usize) -> Option<Self> {
        let (from_base, from_tip) = (tree.steps_to(base), tree.steps_to(tip));
        let steps = from_tip.strip_prefix(from_base.as_slice())?;
        let mut chain =
            Self { joints: vec![], last_from_tip: Isometry3::identity(), variables: vec![], in_tree: vec![] };
        for step in steps.iter().filter_map(|step| tree.steps.get(*step)) {
            chain.last_from_tip *= step.parent_from_joint;
            match &step.motion {
                Motion::Fixed => {}
                Motion::Turn(axis, driver) => chain.push(tree, *axis, false, *driver),
                Motion::Slide(axis, driver) => chain.push(tree, *axis, true, *driver),
                Motion::Planar { axes: [x, y, normal], first } => {
                    for (axis, slides, variable) in
                        [(x, true, *first), (y, true, first + 1), (normal, false, first + 2)]
                    {
                        chain.push(tree, *axis, slides, Driver { variable, multiplier: 1.0, offset: 0.0 });
                    }
                }
            }
        }
        Some(chain)
    }

    fn push(&mut self, tree: &Tree, axis: Unit<Vector3<f64>>, slides: bool, driver: Driver) {
        let known = self.in_tree.iter().position(|at| *at == driver.variable);
        let variable = known.unwrap_or(self.in_tree.len());
        if known.is_none() {
            self.in_tree.push(driver.variable);
            self.variables.extend(tree.variables().get(driver.variable).cloned());
        }
        let before = std::mem::replace(&mut self.last_from_tip, Isometry3::identity());
        self.joints.push(ChainJoint { before, axis, slides, driver: Driver { variable, ..driver } });
    }

    /// The pose of the tip in the base's frame; one value for each variable of the chain. O(joints).
    #[must_use]
    pub fn base_from_tip(&self, values: &[f64]) -> Isometry3<f64> {
        let moved = self.joints.iter().fold(Isometry3::identity(), |pose, joint| {
            pose * joint.before * joint.motion(joint.driver.position(values))
        });
        moved * self.last_from_tip
    }

    /// Whether values are within the limits of every variable.
    #[must_use]
    pub fn allows(&self, values: &[f64]) -> bool {
        values.len() == self.variables.len()
            && self.variables.iter().zip(values).all(|(known, value)| known.allows(*value))
    }
}
