//! Relative motion of two parts over a cell: bounded by the joints between them alone, wherever both are.

use std::rc::Rc;

use nalgebra::{Isometry3, Vector3};

use super::bound_obstacle::MotionExtent;
use crate::collision::Solid;
use crate::inverse::interval::{RotationBound, farthest};
use crate::kinematics::ReducedModel;

/// Joint chains between all pairs of frames of a reduced model.
pub(super) struct RelativeChains {
    /// Chain from the second frame to the first, by the first and then the second.
    between: Vec<Vec<Rc<[ChainJoint]>>>,
}

/// Joint of a chain.
#[derive(Clone, Copy, Debug)]
struct ChainJoint {
    /// Index in the reduced model.
    joint: usize,
    /// −1 where it carries the first frame, else 1.
    sign: f64,
}

/// Joint axis in the middle of a cell.
#[derive(Clone, Copy)]
pub(super) struct RelativeAxis {
    slides: bool,
    /// Driving variable, with the joint's motion per unit of it.
    dof: usize,
    scale: f64,
    /// Drift of the variable.
    off: f64,
    direction: Vector3<f64>,
    at: Vector3<f64>,
}

impl RelativeChains {
    pub(super) fn new(reduced: &ReducedModel) -> Self {
        let up = |mut frame: usize| {
            let mut all = vec![];
            while let Some(joint) = frame.checked_sub(1) {
                all.push(joint);
                frame = reduced.joints.get(joint).map_or(0, |joint| joint.parent);
            }
            all
        };
        let ways: Vec<Vec<usize>> = (0..=reduced.joints.len()).map(up).collect();
        let path = |one: &Vec<usize>, other: &Vec<usize>| {
            let only = |all: &[usize], others: &[usize], sign: f64| {
                let only = all.iter().filter(|joint| !others.contains(joint));
                only.map(|joint| ChainJoint { joint: *joint, sign }).collect::<Vec<_>>()
            };
            let mut path = only(other, one, 1.0);
            path.extend(only(one, other, -1.0).into_iter().rev());
            path.into()
        };
        let between = ways.iter().map(|one| ways.iter().map(|other| path(one, other)).collect());
        Self { between: between.collect() }
    }

    /// Axes of the joints at given frames, with the drifts of their variables.
    pub(super) fn axes(reduced: &ReducedModel, frames: &[Isometry3<f64>], offs: &[f64]) -> Vec<RelativeAxis> {
        let joints = reduced.joints.iter().zip(frames.iter().skip(1)).zip(offs);
        let axes = joints.map(|((joint, frame), off)| RelativeAxis {
            slides: joint.is_prismatic,
            dof: joint.coupling.dof,
            scale: joint.coupling.multiplier,
            off: *off,
            direction: frame.rotation * joint.axis.into_inner(),
            at: frame.translation.vector,
        });
        axes.collect()
    }

    /// Relative motion of a part of one frame, seen from another.
    pub(super) fn relative<'t>(
        &'t self,
        from: usize,
        to: usize,
        axes: &'t [RelativeAxis],
    ) -> Option<RelativeChain<'t>> {
        Some(RelativeChain { path: self.between.get(from)?.get(to)?, axes })
    }
}

/// Relative motion along a chain. Outer joints move first, so that inner ones act on a part that is off by
/// no more than the outer motion.
pub(super) struct RelativeChain<'t> {
    path: &'t [ChainJoint],
    axes: &'t [RelativeAxis],
}

/// Motion of one joint, or of several that slide by one variable.
enum AxisMotion {
    Turns(RotationBound),
    /// Slide of at most this vector, in either direction.
    Slides(Vector3<f64>),
}

impl RelativeChain<'_> {
    fn moves(&self) -> impl Iterator<Item = AxisMotion> + '_ {
        let mut rest = self.path;
        std::iter::from_fn(move || {
            let (first, more) = rest.split_first()?;
            rest = more;
            let Some(axis) = self.axes.get(first.joint) else {
                return Some(AxisMotion::Slides(Vector3::repeat(f64::INFINITY)));
            };
            if !axis.slides {
                let angle = axis.off * axis.scale.abs();
                return Some(AxisMotion::Turns(RotationBound { angle, axis: axis.direction, at: axis.at }));
            }
            // Slides by one variable on both sides cancel.
            let mut step = axis.direction * (axis.scale * first.sign);
            while let Some((next, more)) = rest.split_first()
                && let Some(other) = self.axes.get(next.joint)
                && other.slides
                && other.dof == axis.dof
            {
                step += other.direction * (other.scale * next.sign);
                rest = more;
            }
            Some(AxisMotion::Slides(step * axis.off))
        })
    }

    /// Greatest motion of a solid in m: of a capsule's axis, and of every point of another shape.
    pub(super) fn drift(&self, solid: &Solid) -> f64 {
        farthest(solid, None, |point, rim| self.point(point, rim))
    }

    /// Greatest motion of the ball of radius `rim` around a point, in m.
    pub(super) fn point(&self, point: &Vector3<f64>, rim: f64) -> f64 {
        self.moves().fold(0.0, |gone, step| match step {
            AxisMotion::Turns(spin) => gone + spin.far(point, rim, gone),
            AxisMotion::Slides(step) => gone + step.norm(),
        })
    }

    /// Slide of the chain, where it only slides by one variable.
    pub(super) fn slide(&self) -> Option<Vector3<f64>> {
        let mut moves = self.moves();
        match (moves.next(), moves.next()) {
            (Some(AxisMotion::Slides(step)), None) => Some(step),
            _ => None,
        }
    }
}

impl MotionExtent for RelativeChain<'_> {
    fn along(&self, point: &Vector3<f64>, direction: &Vector3<f64>) -> f64 {
        let mut far = 0.0;
        self.moves().fold(0.0, |gone, step| match step {
            AxisMotion::Turns(spin) => {
                let along = spin.along(point, direction, far);
                far += spin.far(point, 0.0, far);
                gone + along
            }
            AxisMotion::Slides(step) => {
                far += step.norm();
                gone + step.dot(direction).abs()
            }
        })
    }

    fn stays_upright(&self) -> bool {
        false
    }
}

/// Pairs of parts of two frames that may be in contact.
#[derive(Clone)]
pub(super) struct PairGroup {
    /// Both frames; the second moves, seen from the first.
    pub(super) frames: [usize; 2],
    /// Radius of a ball about its origin that holds the second frame's parts, in m.
    pub(super) reach: f64,
    /// Drift at the last reduction of the list.
    pub(super) drift: f64,
    pub(super) pairs: Rc<[[u16; 2]]>,
}

impl PairGroup {
    /// Iterates over the pairs in order.
    pub(super) fn pairs(&self) -> impl Iterator<Item = BodyPair> + '_ {
        self.pairs.iter().map(|[part, at]| BodyPair::RelativePlacement(*part, *at))
    }
}

/// Pair of bodies that may not be in contact: a part, and an obstacle, the floor or another part.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum BodyPair {
    Obstacle(u16, u16),
    Floor(u16),
    RelativePlacement(u16, u16),
}

/// Robot placed by its joints alone, in the middle of a cell; filled where needed.
#[derive(Default)]
pub(super) struct RelativePlacement {
    pub(super) axes: Vec<RelativeAxis>,
    /// Frames relative to an arbitrary origin.
    pub(super) frames: Vec<Isometry3<f64>>,
    pub(super) parts: Vec<Option<Solid>>,
}
