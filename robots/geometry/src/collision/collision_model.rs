//! The solids of a robot, and which pairs of them may not touch.

use std::ops::Range;

use motet_robots::urdf::{JointKind, Urdf};
use nalgebra::Isometry3;

use super::link_solid::{LinkSolid, parts};
use super::solid::Solid;
use crate::kinematics::{KinematicTree, quasi_random_in};

/// Configurations that are looked at to find links which always touch.
const SAMPLES: usize = 64;

/// What of a robot can touch something. Poses are those of [`KinematicTree::root_from_links`], in any frame.
#[derive(Clone, PartialEq, Debug)]
pub struct CollisionModel {
    parts: Vec<LinkSolid>,
    /// Pairs of parts, by index, that may not touch.
    pairs: Vec<[usize; 2]>,
    /// For each link the links that it is fixed to, by the first of them.
    groups: Vec<usize>,
    uncovered_links: Vec<usize>,
}

/// What is nearest.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct NearestPair {
    /// Distance in m; 0 or less where they overlap.
    pub metres: f64,
    /// Index of one part.
    pub part: usize,
    /// Index of the other part, or of the obstacle.
    pub other: usize,
}

impl CollisionModel {
    /// The body of a URDF; its shapes as they are, but for meshes.
    ///
    /// Parts of a link and of links that are fixed to each other never count, nor links next to each other at a joint, nor
    /// those which the SRDF allows to touch (`allowed`). Two links that touch in each of 64 configurations spread over
    /// the limits are built into each other, and do not count either. O(parts²) where most are apart in the first of these, else
    /// O(parts² × 64).
    #[must_use]
    pub fn new(urdf: &Urdf, tree: &KinematicTree, allowed: &[[usize; 2]]) -> Self {
        let (groups, next_to) = groups(urdf);
        let mut body = Self { parts: vec![], pairs: vec![], groups, uncovered_links: vec![] };
        for (link, at) in urdf.links.iter().zip(0..) {
            let (found, is_complete) = parts(link, at);
            body.parts.extend(found);
            body.uncovered_links.extend((!is_complete).then_some(at));
        }
        let sorted = |mut pairs: Vec<[usize; 2]>| {
            pairs.sort_unstable();
            pairs
        };
        let (next_to, allowed) = (sorted(next_to), sorted(allowed.to_vec()));
        let has = |pairs: &[[usize; 2]], one, other| {
            pairs.binary_search(&[one, other]).is_ok() || pairs.binary_search(&[other, one]).is_ok()
        };
        // All of the limits: what follows a joint may go on where that has turned once.
        let ranges = tree.dofs().iter().map(|known| known.limits.unwrap_or(known.sampling_range()));
        let samples = (0..SAMPLES).map(|sample| quasi_random_in(ranges.clone(), sample));
        let poses: Vec<_> = samples.map(|sample| tree.root_from_links(&sample)).collect();
        let placed: Vec<Vec<Solid>> = poses.iter().map(|poses| body.placed(poses)).collect();
        // Parts are in the order of their links.
        let of_links: Vec<&[LinkSolid]> = body.parts.chunk_by(|one, other| one.link == other.link).collect();
        let mut first = 0;
        let of_links: Vec<(usize, Range<usize>)> = of_links
            .into_iter()
            .filter_map(|parts| {
                let range = first..first + parts.len();
                first = range.end;
                Some((parts.first()?.link, range))
            })
            .collect();
        let mut pairs = Vec::new();
        for (at, (one, own)) in of_links.iter().enumerate() {
            for (other, beyond) in of_links.iter().skip(at + 1) {
                let (a, b) = (body.group(*one), body.group(*other));
                if a == b || has(&next_to, a, b) || has(&allowed, *one, *other) {
                    continue;
                }
                let all = || own.clone().flat_map(|at| beyond.clone().map(move |other| [at, other]));
                let touches = |solids: &Vec<Solid>| all().any(|pair| !is_clear(solids, &pair, 0.0));
                if !placed.iter().all(touches) {
                    pairs.extend(all());
                }
            }
        }
        // By the first part, then by the second.
        pairs.sort_unstable();
        body.pairs = pairs;
        body
    }

    /// The body with one more solid that a link carries. It may touch no link but those of `exempt`.
    #[must_use]
    pub fn with_attached(&self, part: LinkSolid, exempt: impl Fn(usize) -> bool) -> Self {
        let mut body = self.clone();
        let at = body.parts.len();
        let others = self.parts.iter().zip(0..).filter(|(other, _)| !exempt(other.link));
        body.pairs.extend(others.map(|(_, other)| [other, at]));
        body.parts.push(part);
        body
    }

    /// The parts.
    #[must_use]
    pub fn parts(&self) -> &[LinkSolid] {
        &self.parts
    }

    /// Pairs of parts, by index, that may not touch.
    #[must_use]
    pub fn pairs(&self) -> &[[usize; 2]] {
        &self.pairs
    }

    /// Whether two links are one, or fixed to each other.
    #[must_use]
    pub fn is_rigidly_attached(&self, one: usize, other: usize) -> bool {
        self.group(one) == self.group(other)
    }

    fn group(&self, link: usize) -> usize {
        self.groups.get(link).copied().unwrap_or(link)
    }

    /// Links with a mesh, which no solid stands for: what is said of the robot does not hold for them.
    #[must_use]
    pub fn uncovered_links(&self) -> &[usize] {
        &self.uncovered_links
    }

    /// The parts where the links are, in their order.
    #[must_use]
    pub fn placed(&self, poses: &[Isometry3<f64>]) -> Vec<Solid> {
        let pose = |link: usize| poses.get(link).copied().unwrap_or_default();
        self.parts.iter().map(|part| part.solid.moved(&pose(part.link))).collect()
    }

    /// The two parts that are nearest to each other, of those that may not touch. O(pairs).
    #[must_use]
    pub fn nearest_self_pair(&self, placed: &[Solid]) -> Option<NearestPair> {
        let near = self.pairs.iter().filter_map(|[part, other]| {
            let metres = placed.get(*part)?.distance(placed.get(*other)?);
            Some(NearestPair { metres, part: *part, other: *other })
        });
        near.reduce(|best, next| if next.metres < best.metres { next } else { best })
    }
}

/// Whether two parts are farther from each other than `metres`.
fn is_clear(placed: &[Solid], [one, other]: &[usize; 2], metres: f64) -> bool {
    placed.get(*one).zip(placed.get(*other)).is_none_or(|(one, other)| one.is_farther(other, metres))
}

/// For each link the first of those that it is fixed to, and which of these hang on which.
fn groups(urdf: &Urdf) -> (Vec<usize>, Vec<[usize; 2]>) {
    // Joints are ordered from the root, so a parent's group is known before its children's.
    let mut groups: Vec<usize> = (0..urdf.links.len()).collect();
    let mut next_to = Vec::new();
    for joint in &urdf.joints {
        let parent = groups.get(joint.parent).copied().unwrap_or(joint.parent);
        if matches!(joint.kind, JointKind::Fixed | JointKind::Floating) {
            if let Some(group) = groups.get_mut(joint.child) {
                *group = parent;
            }
        } else {
            next_to.push([parent, joint.child]);
        }
    }
    (groups, next_to)
}
