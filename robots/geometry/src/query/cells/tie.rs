//! How far two parts of a robot can be off from where they are to each other in the middle of a cell: only by what the joints between them
//! move, wherever both of them are.

use std::rc::Rc;

use nalgebra::{Isometry3, Vector3};

use crate::collision::Solid;
use crate::inverse::family::farthest;
use crate::kinematics::Rig;

/// The joints between any two frames of a rig.
pub(super) struct Ties {
    /// The frames whose joints are between two, from the second to the first, by the first and then the second.
    between: Vec<Vec<Rc<[Between]>>>,
}

/// A joint between two frames.
#[derive(Clone, Copy, Debug)]
struct Between {
    /// Of the rig's joints.
    joint: usize,
    /// −1 where it carries the first of both.
    sign: f64,
}

/// A joint where it is in the middle of a cell.
#[derive(Clone, Copy)]
pub(super) struct Axis {
    slides: bool,
    /// By which variable it is moved, and how far it goes for that.
    variable: usize,
    scale: f64,
    /// How far the variable can be off.
    off: f64,
    direction: Vector3<f64>,
    at: Vector3<f64>,
}

impl Ties {
    pub(super) fn new(rig: &Rig) -> Self {
        let up = |mut frame: usize| {
            let mut all = vec![];
            while let Some(joint) = frame.checked_sub(1) {
                all.push(joint);
                frame = rig.joints.get(joint).map_or(0, |joint| joint.parent);
            }
            all
        };
        let ways: Vec<Vec<usize>> = (0..=rig.joints.len()).map(up).collect();
        let path = |one: &Vec<usize>, other: &Vec<usize>| {
            let only = |all: &[usize], others: &[usize], sign: f64| {
                let only = all.iter().filter(|joint| !others.contains(joint));
                only.map(|joint| Between { joint: *joint, sign }).collect::<Vec<_>>()
            };
            let mut path = only(other, one, 1.0);
            path.extend(only(one, other, -1.0).into_iter().rev());
            path.into()
        };
        let between = ways.iter().map(|one| ways.iter().map(|other| path(one, other)).collect());
        Self { between: between.collect() }
    }

    /// The joints of a rig where its frames are, with how far their variables can be off.
    pub(super) fn axes(rig: &Rig, frames: &[Isometry3<f64>], offs: &[f64]) -> Vec<Axis> {
        let joints = rig.joints.iter().zip(frames.iter().skip(1)).zip(offs);
        let axes = joints.map(|((joint, frame), off)| Axis {
            slides: joint.slides,
            variable: joint.driver.variable,
            scale: joint.driver.multiplier,
            off: *off,
            direction: frame.rotation * joint.axis.into_inner(),
            at: frame.translation.vector,
        });
        axes.collect()
    }

    /// How far a part that one frame carries goes at most, seen from another frame, in m: the axis of a capsule, and every point of anything
    /// else.
    pub(super) fn drift(&self, from: usize, to: usize, solid: &Solid, axes: &[Axis]) -> f64 {
        farthest(solid, None, |point, rim| self.off(from, to, (point, rim), axes))
    }

    /// The same for what is so near to a point. Joints farther out move first, so that those nearer in find it farther from them by no more
    /// than it went.
    pub(super) fn off(
        &self,
        from: usize,
        to: usize,
        (point, rim): (&Vector3<f64>, f64),
        axes: &[Axis],
    ) -> f64 {
        let Some(path) = self.between.get(from).and_then(|all| all.get(to)) else { return f64::INFINITY };
        let mut gone = 0.0;
        // What one variable slides on both sides goes along with itself.
        let mut slid = Slid { variable: usize::MAX, off: 0.0, step: Vector3::zeros() };
        for Between { joint, sign } in path.iter() {
            let Some(axis) = axes.get(*joint) else { return f64::INFINITY };
            if !axis.slides || slid.variable != axis.variable {
                gone += slid.step.norm() * slid.off;
                slid = Slid { variable: axis.variable, off: axis.off, step: Vector3::zeros() };
            }
            if axis.slides {
                slid.step += axis.direction * (axis.scale * sign);
                continue;
            }
            let out = point - axis.at;
            let aside = (out - axis.direction * out.dot(&axis.direction)).norm();
            // A chord is no longer than its arc, nor than twice the radius.
            gone += (axis.off * axis.scale.abs()).min(2.0) * (aside + rim + gone);
        }
        gone + slid.step.norm() * slid.off
    }
}

/// What slides by one variable.
struct Slid {
    variable: usize,
    off: f64,
    step: Vector3<f64>,
}

/// Parts that two frames carry and that may touch.
#[derive(Clone)]
pub(super) struct Tied {
    /// Both frames; the second has moved when its parts are looked at from the first.
    pub(super) frames: [usize; 2],
    /// The radius of a ball about its origin that holds the parts of the second.
    pub(super) reach: f64,
    /// How far that could be off when others were last left out.
    pub(super) drift: f64,
    pub(super) pairs: Rc<[[u16; 2]]>,
}
