//! Poses of links at states of one straight way: what does not move on it is worked out once.

use nalgebra::Isometry3;

use super::tree::{Motion, Tree};

/// The links of a robot on its way between two configurations.
#[derive(Clone, Debug)]
pub struct Along {
    /// For each step from link to link its pose where the way begins, and whether that changes.
    steps: Vec<(Isometry3<f64>, bool)>,
    poses: Vec<Isometry3<f64>>,
}

impl Along {
    /// The poses of the links where they were last placed, in the order of the links.
    #[must_use]
    pub fn poses(&self) -> &[Isometry3<f64>] {
        &self.poses
    }
}

impl Tree {
    /// A way between two configurations. O(links).
    #[must_use]
    pub fn along(&self, from: &[f64], to: &[f64]) -> Along {
        let changes = |at: usize| from.get(at) != to.get(at);
        let steps = self.steps.iter().map(|step| {
            let is_moved = match &step.motion {
                Motion::Fixed => false,
                Motion::Turn(_, driver) | Motion::Slide(_, driver) => changes(driver.variable),
                Motion::Planar { first, .. } => (*first..first + 3).any(changes),
            };
            (step.pose(from), is_moved)
        });
        Along { steps: steps.collect(), poses: vec![Isometry3::identity(); self.links().len()] }
    }

    /// Places the links where the root has a pose, at a configuration on the way. O(links).
    pub fn place(&self, along: &mut Along, root: &Isometry3<f64>, configuration: &[f64]) {
        if let Some(slot) = along.poses.get_mut(self.root()) {
            *slot = *root;
        }
        for (step, (still, is_moved)) in self.steps.iter().zip(&along.steps) {
            let parent = along.poses.get(step.parent).copied().unwrap_or_default();
            let pose = if *is_moved { parent * step.pose(configuration) } else { parent * still };
            if let Some(slot) = along.poses.get_mut(step.child) {
                *slot = pose;
            }
        }
    }
}
