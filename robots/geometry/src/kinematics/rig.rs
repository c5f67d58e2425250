//! The joints that some variables move, with all that others hold still folded into the poses between them.

use nalgebra::{Isometry3, Translation3, Unit, Vector3};

use super::tree::{Driver, Motion, Tree};
use crate::trigonometry::turn;

/// A robot of which only some joints move. Frame 0 is the root's, frame `n` + 1 that of joint `n`.
#[derive(Clone, Debug)]
pub(crate) struct Rig {
    /// Each after the one that carries it.
    pub(crate) joints: Vec<RigJoint>,
    /// For each link the frame that it does not move in, and its pose in it.
    pub(crate) links: Vec<(usize, Isometry3<f64>)>,
}

/// A joint of a [`Rig`].
#[derive(Clone, Debug)]
pub(crate) struct RigJoint {
    /// The frame that carries it.
    pub(crate) parent: usize,
    /// Its pose in that frame.
    pub(crate) before: Isometry3<f64>,
    /// Its axis or direction, in its own frame.
    pub(crate) axis: Unit<Vector3<f64>>,
    /// Whether it slides, and does not turn.
    pub(crate) slides: bool,
    /// Its position in terms of the tree's variables.
    pub(crate) driver: Driver,
}

impl RigJoint {
    /// The joint's motion at a position.
    pub(crate) fn motion(&self, position: f64) -> Isometry3<f64> {
        if self.slides {
            Translation3::from(self.axis.into_inner() * position).into()
        } else {
            Isometry3::from_parts(Translation3::identity(), turn(&self.axis, position))
        }
    }
}

impl Tree {
    /// The rig in which only these variables move and the others are as in a configuration; `None` where one of them moves a planar
    /// joint. O(links).
    pub(crate) fn rig(&self, configuration: &[f64], is_free: impl Fn(usize) -> bool) -> Option<Rig> {
        let mut rig = Rig { joints: vec![], links: vec![(0, Isometry3::identity()); self.links().len()] };
        for step in &self.steps {
            let (frame, pose) = rig.links.get(step.parent).copied()?;
            let moved = match &step.motion {
                Motion::Turn(axis, driver) if is_free(driver.variable) => Some((axis, false, driver)),
                Motion::Slide(axis, driver) if is_free(driver.variable) => Some((axis, true, driver)),
                Motion::Planar { first, .. } if (*first..first + 3).any(&is_free) => return None,
                Motion::Fixed | Motion::Turn(..) | Motion::Slide(..) | Motion::Planar { .. } => None,
            };
            let link = match moved {
                Some((axis, slides, driver)) => {
                    let before = pose * step.parent_from_joint;
                    rig.joints.push(RigJoint { parent: frame, before, axis: *axis, slides, driver: *driver });
                    (rig.joints.len(), Isometry3::identity())
                }
                None => (frame, pose * step.pose(configuration)),
            };
            *rig.links.get_mut(step.child)? = link;
        }
        Some(rig)
    }
}
