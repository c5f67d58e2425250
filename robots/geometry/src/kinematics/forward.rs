//! Forward kinematics: poses of links from a configuration, and along one edge, where fixed segments are
//! evaluated once.

use nalgebra::{Isometry3, Translation3};

use super::tree::{JointMotion, KinematicTree, Segment};
use crate::trigonometry::turn;

impl KinematicTree {
    /// Poses of all links in the frame of the root, in the order of the links. Degrees of freedom that
    /// `configuration` lacks are 0. O(links).
    #[must_use]
    pub fn root_from_links(&self, configuration: &[f64]) -> Vec<Isometry3<f64>> {
        let mut poses = vec![Isometry3::identity(); self.links.len()];
        for segment in &self.segments {
            let parent = poses.get(segment.parent).copied().unwrap_or_default();
            if let Some(slot) = poses.get_mut(segment.child) {
                *slot = parent * segment.pose(configuration);
            }
        }
        poses
    }

    /// Pose of one link in the frame of the root. O(links between it and the root).
    #[must_use]
    pub fn root_from_link(&self, configuration: &[f64], link: usize) -> Isometry3<f64> {
        let mut pose = Isometry3::identity();
        let mut at = link;
        while let Some(segment) =
            self.placed_by.get(at).copied().flatten().and_then(|segment| self.segments.get(segment))
        {
            pose = segment.pose(configuration) * pose;
            at = segment.parent;
        }
        pose
    }

    /// Pose of link `tip` in the frame of link `base`, both by index. O(links between them and the root).
    #[must_use]
    pub fn pose(&self, configuration: &[f64], base: usize, tip: usize) -> Isometry3<f64> {
        let (from_base, from_tip) = (self.segments_to(base), self.segments_to(tip));
        // The common part cancels out, so it is skipped: it adds no rounding.
        let common = from_base.iter().zip(&from_tip).take_while(|(one, other)| one == other).count();
        let along = |segments: &[usize]| {
            let segments = segments.iter().skip(common).filter_map(|segment| self.segments.get(*segment));
            segments.fold(Isometry3::identity(), |pose, segment| pose * segment.pose(configuration))
        };
        along(&from_base).inverse() * along(&from_tip)
    }

    /// Segments from the root to a link, in this order.
    pub(super) fn segments_to(&self, link: usize) -> Vec<usize> {
        let mut segments = Vec::new();
        let mut at = link;
        while let Some(segment) = self.placed_by.get(at).copied().flatten() {
            segments.push(segment);
            at = self.segments.get(segment).map_or(self.root, |segment| segment.parent);
        }
        segments.reverse();
        segments
    }
}

impl Segment {
    pub(super) fn pose(&self, configuration: &[f64]) -> Isometry3<f64> {
        let value = |at: usize| configuration.get(at).copied().unwrap_or(0.0);
        let moved = match &self.motion {
            JointMotion::Fixed => return self.parent_from_joint,
            JointMotion::Turn(axis, coupling) => {
                Isometry3::from_parts(Translation3::identity(), turn(axis, coupling.position(configuration)))
            }
            JointMotion::Slide(axis, coupling) => {
                Translation3::from(axis.into_inner() * coupling.position(configuration)).into()
            }
            JointMotion::Planar { axes: [x, y, normal], first } => Isometry3::from_parts(
                Translation3::from(x.into_inner() * value(*first) + y.into_inner() * value(first + 1)),
                turn(normal, value(first + 2)),
            ),
        };
        self.parent_from_joint * moved
    }
}

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
