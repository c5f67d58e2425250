//! Poses of links at states of one straight way: what does not move on it is worked out once.

use nalgebra::Isometry3;

use super::tree::{JointMotion, KinematicTree};

/// The links of a robot on its way between two configurations.
#[derive(Clone, Debug)]
pub struct EdgePoses {
    /// For each step from link to link its pose where the way begins, and whether that changes.
    segments: Vec<(Isometry3<f64>, bool)>,
    poses: Vec<Isometry3<f64>>,
}

impl EdgePoses {
    /// The poses of the links where they were last placed, in the order of the links.
    #[must_use]
    pub fn poses(&self) -> &[Isometry3<f64>] {
        &self.poses
    }
}

impl KinematicTree {
    /// A way between two configurations. O(links).
    #[must_use]
    pub fn edge_poses(&self, from: &[f64], to: &[f64]) -> EdgePoses {
        let changes = |at: usize| from.get(at) != to.get(at);
        let segments = self.segments.iter().map(|segment| {
            let is_moved = match &segment.motion {
                JointMotion::Fixed => false,
                JointMotion::Turn(_, coupling) | JointMotion::Slide(_, coupling) => changes(coupling.dof),
                JointMotion::Planar { first, .. } => (*first..first + 3).any(changes),
            };
            (segment.pose(from), is_moved)
        });
        EdgePoses { segments: segments.collect(), poses: vec![Isometry3::identity(); self.links().len()] }
    }

    /// Places the links where the root has a pose, at a configuration on the way. O(links).
    pub fn place_on_edge(&self, edge: &mut EdgePoses, root: &Isometry3<f64>, configuration: &[f64]) {
        if let Some(slot) = edge.poses.get_mut(self.root()) {
            *slot = *root;
        }
        for (segment, (still, is_moved)) in self.segments.iter().zip(&edge.segments) {
            let parent = edge.poses.get(segment.parent).copied().unwrap_or_default();
            let pose = if *is_moved { parent * segment.pose(configuration) } else { parent * still };
            if let Some(slot) = edge.poses.get_mut(segment.child) {
                *slot = pose;
            }
        }
    }
}
