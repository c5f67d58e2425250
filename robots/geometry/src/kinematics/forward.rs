//! Poses of links from joint positions.

use nalgebra::{Isometry3, Translation3};

use super::tree::{JointMotion, KinematicTree, Segment};
use crate::trigonometry::turn;

impl KinematicTree {
    /// The pose of every link in the root's frame, in the order of the links. Variables that `configuration` lacks are 0.
    /// O(links).
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

    /// The pose of one link in the root's frame. O(links between it and the root).
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

    /// The pose of link `tip` in the frame of link `base`; both by index. O(links between them and the root).
    #[must_use]
    pub fn pose(&self, configuration: &[f64], base: usize, tip: usize) -> Isometry3<f64> {
        let (from_base, from_tip) = (self.segments_to(base), self.segments_to(tip));
        // What both have in common cancels out, so it is left out: no rounding comes from it.
        let common = from_base.iter().zip(&from_tip).take_while(|(one, other)| one == other).count();
        let along = |segments: &[usize]| {
            let segments = segments.iter().skip(common).filter_map(|segment| self.segments.get(*segment));
            segments.fold(Isometry3::identity(), |pose, segment| pose * segment.pose(configuration))
        };
        along(&from_base).inverse() * along(&from_tip)
    }

    /// The steps from the root to a link, in this order.
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
