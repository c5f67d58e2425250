//! Collision model of a robot: the solids of its links, without duplicates, and the pairs of them that must
//! not touch.

use std::ops::Range;

use motet_robots::urdf::{JointKind, Link, Urdf, UrdfShape};
use nalgebra::Isometry3;

use super::solid::{Shape, Solid};
use crate::kinematics::{KinematicTree, isometry, quasi_random_in};

/// Number of sampled configurations by which links that always touch are found.
const SAMPLES: usize = 64;

/// Collision model of a robot: solids on its links. Link poses are those of
/// [`KinematicTree::root_from_links`], in any common frame.
#[derive(Clone, PartialEq, Debug)]
pub struct CollisionModel {
    parts: Vec<LinkSolid>,
    /// Pairs of solids, by index, that must not touch.
    pairs: Vec<[usize; 2]>,
    /// For each link, the first link of the group that fixed joints make of it.
    groups: Vec<usize>,
    uncovered_links: Vec<usize>,
}

/// Pair of solids with the smallest distance.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct NearestPair {
    /// Distance in m; 0 or less if they overlap.
    pub metres: f64,
    /// Index of one solid.
    pub part: usize,
    /// Index of the other solid, or of the obstacle.
    pub other: usize,
}

impl CollisionModel {
    /// Builds the collision model of a URDF from its shapes; meshes are left out (see
    /// [`Self::uncovered_links`]).
    ///
    /// These pairs are never checked: solids of one link or of links fixed to each other, links next to each
    /// other at a joint, pairs that the SRDF disables (`allowed`), and pairs of links that touch in each of
    /// 64 sampled configurations. O(solids²) if most pairs are apart in the first sample, else O(solids² ×
    /// 64).
    ///
    /// ```
    /// use motet_geometry::KinematicTree;
    /// use motet_geometry::collision::CollisionModel;
    /// use motet_robots::builtin;
    ///
    /// let urdf = builtin::robot("panda").unwrap().urdf;
    /// let tree = KinematicTree::new(&urdf);
    /// let model = CollisionModel::new(&urdf, &tree, &[]);
    /// let solids = model.placed(&tree.root_from_links(&tree.neutral()));
    /// assert_eq!(solids.len(), model.parts().len());
    /// ```
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
        // The whole range of limits counts: a mimic joint may go on where its leader has made a full turn.
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

    /// Adds a solid that a link carries, such as a held object. It must touch no link except those for which
    /// `exempt` is true.
    #[must_use]
    pub fn with_attached(&self, part: LinkSolid, exempt: impl Fn(usize) -> bool) -> Self {
        let mut body = self.clone();
        let at = body.parts.len();
        let others = self.parts.iter().zip(0..).filter(|(other, _)| !exempt(other.link));
        body.pairs.extend(others.map(|(_, other)| [other, at]));
        body.parts.push(part);
        body
    }

    /// Solids of all links, in the order of the links.
    #[must_use]
    pub fn parts(&self) -> &[LinkSolid] {
        &self.parts
    }

    /// Pairs of solids, by index, that must not touch.
    #[must_use]
    pub fn pairs(&self) -> &[[usize; 2]] {
        &self.pairs
    }

    /// Checks whether two links are the same or joined by fixed joints only.
    #[must_use]
    pub fn is_rigidly_attached(&self, one: usize, other: usize) -> bool {
        self.group(one) == self.group(other)
    }

    fn group(&self, link: usize) -> usize {
        self.groups.get(link).copied().unwrap_or(link)
    }

    /// Links with a mesh that no solid encloses: a verdict about the robot does not cover them.
    #[must_use]
    pub fn uncovered_links(&self) -> &[usize] {
        &self.uncovered_links
    }

    /// Moves the solids to where the links are, in the order of [`Self::parts`].
    #[must_use]
    pub fn placed(&self, poses: &[Isometry3<f64>]) -> Vec<Solid> {
        let pose = |link: usize| poses.get(link).copied().unwrap_or_default();
        self.parts.iter().map(|part| part.solid.moved(&pose(part.link))).collect()
    }

    /// Finds the two solids nearest to each other, of those that must not touch. O(pairs).
    #[must_use]
    pub fn nearest_self_pair(&self, placed: &[Solid]) -> Option<NearestPair> {
        let near = self.pairs.iter().filter_map(|[part, other]| {
            let metres = placed.get(*part)?.distance(placed.get(*other)?);
            Some(NearestPair { metres, part: *part, other: *other })
        });
        near.reduce(|best, next| if next.metres < best.metres { next } else { best })
    }
}

/// Checks whether two solids are farther apart than `metres`.
fn is_clear(placed: &[Solid], [one, other]: &[usize; 2], metres: f64) -> bool {
    placed.get(*one).zip(placed.get(*other)).is_none_or(|(one, other)| one.is_farther(other, metres))
}

/// Rigid groups: for each link the first link that it is fixed to, and the pairs of groups that a joint
/// connects.
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

/// Solid that a link carries.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LinkSolid {
    /// Index of the link in the kinematic tree.
    pub link: usize,
    /// The solid, in the link's frame.
    pub solid: Solid,
}

/// Solids of a link, and whether they cover all its shapes (a mesh is left out).
///
/// URDFs write a capsule as a cylinder with a ball at each end; it becomes a capsule again. A ball within
/// another solid is dropped.
pub(super) fn parts(link: &Link, at: usize) -> (Vec<LinkSolid>, bool) {
    let mut solids: Vec<Solid> = Vec::new();
    let mut is_complete = true;
    for listed in &link.collisions {
        let shape = match listed.shape {
            UrdfShape::Box([x, y, z]) => Shape::Box([x / 2.0, y / 2.0, z / 2.0].into()),
            UrdfShape::Cylinder { radius, length } => Shape::Cylinder { radius, half: length / 2.0 },
            UrdfShape::Capsule { radius, length } => Shape::Capsule { radius, half: length / 2.0 },
            UrdfShape::Sphere { radius } => Shape::Capsule { radius, half: 0.0 },
            UrdfShape::Mesh { .. } => {
                is_complete = false;
                continue;
            }
        };
        solids.push(Solid::new(&isometry(&listed.link_from_shape), shape));
    }
    let rounded = solids.iter().map(|solid| with_round_ends(solid, &solids)).collect::<Vec<_>>();
    let is_needed = |(index, solid): &(usize, &Solid)| {
        let hides = |(other, larger): (usize, &Solid)| {
            other != *index
                && is_ball_within(solid, larger)
                && (other < *index || !is_ball_within(larger, solid))
        };
        !rounded.iter().enumerate().any(hides)
    };
    let kept =
        rounded.iter().enumerate().filter(is_needed).map(|(_, solid)| LinkSolid { link: at, solid: *solid });
    (kept.collect(), is_complete)
}

/// The capsule made of a cylinder with balls at both ends; any other solid unchanged.
fn with_round_ends(solid: &Solid, all: &[Solid]) -> Solid {
    let Shape::Cylinder { radius, half } = solid.shape else { return *solid };
    let [_, _, z] = &solid.axes;
    let has_ball = |sign: f64| {
        let end = solid.centre + z * (half * sign);
        all.iter().any(|ball| match ball.shape {
            Shape::Capsule { radius: wide, half: 0.0 } => {
                wide + 1e-6 >= radius && (ball.centre - end).norm() <= wide - radius + 1e-6
            }
            Shape::Capsule { .. } | Shape::Box(_) | Shape::Cylinder { .. } | Shape::HalfSpace => false,
        })
    };
    // Makes up for the tolerance of a millionth of a metre above.
    let shape = Shape::Capsule { radius: radius + 2e-6, half };
    if has_ball(-1.0) && has_ball(1.0) { Solid { shape, ..*solid } } else { *solid }
}

fn is_ball_within(solid: &Solid, larger: &Solid) -> bool {
    let Shape::Capsule { radius, half: 0.0 } = solid.shape else { return false };
    let Shape::Capsule { radius: wide, half } = larger.shape else { return false };
    let [_, _, z] = &larger.axes;
    let between = solid.centre - larger.centre;
    let along = between.dot(z).clamp(-half, half);
    (between - z * along).norm() + radius <= wide
}
