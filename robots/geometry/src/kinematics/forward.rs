//! Poses of links from joint positions.

use nalgebra::{Isometry3, Translation3};

use super::tree::{Motion, Step, Tree};
use crate::trigonometry::turn;

impl Tree {
    /// The pose of every link in the root's frame, in the order of the links. Variables that `configuration` lacks are 0.
    /// O(links).
    #[must_use]
    pub fn root_from_links(&self, configuration: &[f64]) -> Vec<Isometry3<f64>> {
        let mut poses = vec![Isometry3::identity(); self.links.len()];
        for step in &self.steps {
            let parent = poses.get(step.parent).copied().unwrap_or_default();
            if let Some(slot) = poses.get_mut(step.child) {
                *slot = parent * step.pose(configuration);
            }
        }
        poses
    }

    /// The pose of one link in the root's frame. O(links between it and the root).
    #[must_use]
    pub fn root_from_link(&self, configuration: &[f64], link: usize) -> Isometry3<f64> {
        let mut pose = Isometry3::identity();
        let mut at = link;
        while let Some(step) = self.placed_by.get(at).copied().flatten().and_then(|step| self.steps.get(step))
        {
            pose = step.pose(configuration) * pose;
            at = step.parent;
        }
        pose
    }

    /// The pose of link `tip` in the frame of link `base`; both by index. O(links between them and the root).
    #[must_use]
    pub fn pose(&self, configuration: &[f64], base: usize, tip: usize) -> Isometry3<f64> {
        let (from_base, from_tip) = (self.steps_to(base), self.steps_to(tip));
        // What both have in common cancels out, so it is left out: no rounding comes from it.
        let common = from_base.iter().zip(&from_tip).take_while(|(one, other)| one == other).count();
        let along = |steps: &[usize]| {
            let steps = steps.iter().skip(common).filter_map(|step| self.steps.get(*step));
            steps.fold(Isometry3::identity(), |pose, step| pose * step.pose(configuration))
        };
        along(&from_base).inverse() * along(&from_tip)
    }

    /// The steps from the root to a link, in this order.
    pub(super) fn steps_to(&self, link: usize) -> Vec<usize> {
        let mut steps = Vec::new();
        let mut at = link;
        while let Some(step) = self.placed_by.get(at).copied().flatten() {
            steps.push(step);
            at = self.steps.get(step).map_or(self.root, |step| step.parent);
        }
        steps.reverse();
        steps
    }
}

impl Step {
    pub(super) fn pose(&self, configuration: &[f64]) -> Isometry3<f64> {
        let value = |at: usize| configuration.get(at).copied().unwrap_or(0.0);
        let moved = match &self.motion {
            Motion::Fixed => return self.parent_from_joint,
            Motion::Turn(axis, driver) => {
                Isometry3::from_parts(Translation3::identity(), turn(axis, driver.position(configuration)))
            }
            Motion::Slide(axis, driver) => {
                Translation3::from(axis.into_inner() * driver.position(configuration)).into()
            }
            Motion::Planar { axes: [x, y, normal], first } => Isometry3::from_parts(
                Translation3::from(x.into_inner() * value(*first) + y.into_inner() * value(first + 1)),
                turn(normal, value(first + 2)),
            ),
        };
        self.parent_from_joint * moved
    }
}
