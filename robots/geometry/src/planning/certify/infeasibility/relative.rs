//! How far two parts of a robot can be off from where they are to each other in the middle of a cell: only by what the joints between them
//! move, wherever both of them are.

use std::rc::Rc;

use nalgebra::{Isometry3, Vector3};

use super::bound_obstacle::MotionExtent;
use super::cover::BodyPair;
use crate::collision::Solid;
use crate::inverse::interval::{RotationBound, farthest};
use crate::kinematics::ReducedModel;

/// The joints between any two frames of a rig.
pub(super) struct RelativeChains {
    /// The frames whose joints are between two, from the second to the first, by the first and then the second.
    between: Vec<Vec<Rc<[ChainJoint]>>>,
}

/// A joint between two frames.
#[derive(Clone, Copy, Debug)]
struct ChainJoint {
    /// Of the rig's joints.
    joint: usize,
    /// −1 where it carries the first of both.
    sign: f64,
}

/// A joint where it is in the middle of a cell.
#[derive(Clone, Copy)]
pub(super) struct RelativeAxis {
    slides: bool,
    /// By which variable it is moved, and how far it goes for that.
    dof: usize,
    scale: f64,
    /// How far the variable can be off.
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

    /// The joints of a rig where its frames are, with how far their variables can be off.
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

    /// What a part that one frame carries does, seen from another.
    pub(super) fn relative<'t>(
        &'t self,
        from: usize,
        to: usize,
        axes: &'t [RelativeAxis],
    ) -> Option<RelativeChain<'t>> {
        Some(RelativeChain { path: self.between.get(from)?.get(to)?, axes })
    }
}

/// What a part that one frame carries does, seen from another. Joints farther out move first, so that those nearer in find it where it was,
/// off by no more than it went.
pub(super) struct RelativeChain<'t> {
    path: &'t [ChainJoint],
    axes: &'t [RelativeAxis],
}

/// What a joint, or some that slide by one variable, does.
enum AxisMotion {
    Turns(RotationBound),
    /// By no more than this forwards or backwards.
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
            // What one variable slides on both sides goes along with itself.
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

    /// How far a solid goes at most, in m: the axis of a capsule, and every point of anything else.
    pub(super) fn drift(&self, solid: &Solid) -> f64 {
        farthest(solid, None, |point, rim| self.point(point, rim))
    }

    /// The same for what is so near to a point.
    pub(super) fn point(&self, point: &Vector3<f64>, rim: f64) -> f64 {
        self.moves().fold(0.0, |gone, step| match step {
            AxisMotion::Turns(spin) => gone + spin.far(point, rim, gone),
            AxisMotion::Slides(step) => gone + step.norm(),
        })
    }

    /// How it slides, where it only does that by one variable.
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

/// Parts that two frames carry and that may touch.
#[derive(Clone)]
pub(super) struct PairGroup {
    /// Both frames; the second has moved when its parts are looked at from the first.
    pub(super) frames: [usize; 2],
    /// The radius of a ball about its origin that holds the parts of the second.
    pub(super) reach: f64,
    /// How far that could be off when others were last left out.
    pub(super) drift: f64,
    pub(super) pairs: Rc<[[u16; 2]]>,
}

impl PairGroup {
    /// One after the other.
    pub(super) fn pairs(&self) -> impl Iterator<Item = BodyPair> + '_ {
        self.pairs.iter().map(|[part, at]| BodyPair::RelativePlacement(*part, *at))
    }
}
