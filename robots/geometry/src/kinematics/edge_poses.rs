//! Poses of links along one edge: fixed segments are evaluated once.

use nalgebra::Isometry3;

use super::tree::{JointMotion, KinematicTree};

/// Poses of the links of a robot along the edge between two configurations.
#[derive(Clone, Debug)]
pub struct EdgePoses {
    /// For each segment its pose at the start of the edge, and whether it changes along the edge.
    segments: Vec<(Isometry3<f64>, bool)>,
    poses: Vec<Isometry3<f64>>,
}

impl EdgePoses {
    /// Poses of the links where they were last placed, in the order of the links.
    #[must_use]
    pub fn poses(&self) -> &[Isometry3<f64>] {
        &self.poses
    }
}

impl KinematicTree {
    /// Prepares an edge between two configurations. O(links).
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

    /// Places the links for a pose of the root and a configuration on the edge. O(links).
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
