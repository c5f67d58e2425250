//! A robot of which some joints move: what is needed to place it in eight states at once.

use nalgebra::{Isometry3, Matrix3, Vector3};

use super::slab::{sides, single};
use super::{FAR, LONG, MOVED, TURNED, TURNS};
use crate::collision::{Body, Shape, Solid};
use crate::kinematics::{Driver, Rig, RigJoint};

/// A robot. Frame 0 stands still on the base, frame `n` + 1 is that of joint `n`.
#[derive(Clone, Debug)]
pub(crate) struct Figure {
    pub(super) base_from_root: Rigid,
    pub(super) joints: Vec<Joint>,
    drivers: Vec<Driver>,
    pub(super) parts: Vec<Part>,
    pub(super) pairs: Vec<Parts>,
    /// For each frame the joints that move it, from the root on.
    pub(super) levers: Vec<Vec<usize>>,
}

/// A pose by the images of the three directions, and of the origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rigid {
    pub(super) turn: [[f32; 3]; 3],
    pub(super) at: [f32; 3],
}

/// A joint turned by `q`: `still + swing sin q + bend (1 − cos q)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Joint {
    pub(super) parent: usize,
    pub(super) slides: bool,
    /// In the frame that carries it, as is all else.
    pub(super) at: [f32; 3],
    pub(super) axis: [f32; 3],
    pub(super) still: [[f32; 3]; 3],
    pub(super) swing: [[f32; 3]; 3],
    pub(super) bend: [[f32; 3]; 3],
}

/// A part as the capsule that holds it, in its frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub(super) frame: usize,
    /// A bit for that frame and for each that carries it.
    pub(super) carriers: u64,
    pub(super) centre: [f32; 3],
    /// From the centre to an end of the capsule's axis.
    pub(super) half: [f32; 3],
    pub(super) radius: f32,
    /// The radius of a capsule about the same axis within it.
    pub(super) inner: f32,
    /// The radius of the ball around the centre that holds it.
    pub(super) reach: f32,
    /// How far it may be off as it is placed, twice, in m.
    pub(super) slack: f32,
    /// What is no capsule: the box that holds it, by its directions and half of its sides.
    pub(super) slab: Option<([[f32; 3]; 3], [f32; 3])>,
    /// Whether it is a cylinder along the last of these directions.
    pub(super) is_round: bool,
}

/// Two parts that may not touch, in different frames.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parts {
    pub(super) one: usize,
    pub(super) other: usize,
    /// How many joints, from the root on, move both.
    pub(super) common: usize,
}

/// Eight states, and how far the robot may go from each.
#[derive(Clone, Debug)]
pub(crate) struct Eight {
    /// x and y from the origin, and yaw.
    pub(super) base: [[f32; 8]; 3],
    /// For each joint.
    pub(super) positions: Vec<[f32; 8]>,
    /// How far each joint goes, and the base slides and turns.
    pub(super) amounts: Vec<f32>,
    pub(super) slides: f32,
    pub(super) turns: f32,
    /// Whether they are on a way between free states, so that what does not move on it is free.
    pub(super) is_way: bool,
}

impl Figure {
    /// A robot with a body; `None` where it is too large.
    pub(crate) fn new(rig: &Rig, base_from_root: &Isometry3<f64>, body: &Body) -> Option<Self> {
        let mut levers: Vec<Vec<usize>> = vec![vec![]];
        // How far from the base's origin each frame can be, and how far its directions and its origin may be off.
        let mut frames = vec![[base_from_root.translation.vector.norm(), TURNED, 4.0 * TURNED + MOVED]];
        for (joint, at) in rig.joints.iter().zip(0..) {
            let mut own = levers.get(joint.parent)?.clone();
            own.push(at);
            levers.push(own);
            let slide = if joint.slides { 1.0 } else { 0.0 };
            let long = joint.before.translation.vector.norm() + slide;
            let [far, turned, moved] = frames.get(joint.parent)?;
            frames.push([far + long, turned + TURNED, moved + turned * long + MOVED]);
        }
        let parts = body.parts().iter().map(|part| {
            let (frame, pose) = rig.links.get(part.link)?;
            let solid = part.solid.moved(pose);
            let [far, turned, moved] = frames.get(*frame)?;
            let long = solid.centre.norm() + solid.reach();
            let slack = 2.0 * (moved + turned * long + MOVED);
            let carriers = levers.get(*frame)?.iter().fold(0, |bits, joint| bits | frame_bit(joint + 1));
            if far + long <= LONG { Part::new((*frame, carriers), &solid, slack) } else { None }
        });
        let parts = parts.collect::<Option<Vec<Part>>>()?;
        let mut pairs = Vec::new();
        for [one, other] in body.pairs() {
            let frames = (parts.get(*one)?.frame, parts.get(*other)?.frame);
            // What is in one frame is as far apart as it was.
            if frames.0 != frames.1 {
                let (a, b) = (levers.get(frames.0)?, levers.get(frames.1)?);
                let common = a.iter().zip(b).take_while(|(a, b)| a == b).count();
                pairs.push(Parts { one: *one, other: *other, common });
            }
        }
        Some(Self {
            base_from_root: Rigid::new(base_from_root),
            joints: rig.joints.iter().map(Joint::new).collect(),
            drivers: rig.joints.iter().map(|joint| joint.driver).collect(),
            parts,
            pairs,
            levers,
        })
    }

    /// Eight times the same state, which is nowhere yet.
    pub(crate) fn eight(&self) -> Eight {
        Eight {
            base: [[0.0; 8]; 3],
            positions: vec![[0.0; 8]; self.joints.len()],
            amounts: vec![0.0; self.joints.len()],
            slides: 0.0,
            turns: 0.0,
            is_way: false,
        }
    }

    /// Sets one of eight states; whether it is within what is accurate. The base is seen from the origin.
    pub(crate) fn set(&self, eight: &mut Eight, lane: usize, base: [f64; 3], joints: &[f64]) -> bool {
        let mut is_within = true;
        for ((slots, value), limit) in eight.base.iter_mut().zip(base).zip([FAR, FAR, TURNS]) {
            is_within &= value.abs() <= limit;
            slots.get_mut(lane).into_iter().for_each(|slot| *slot = value as f32);
        }
        for (slots, driver) in eight.positions.iter_mut().zip(&self.drivers) {
            let position = driver.position(joints);
            is_within &= position.abs() <= TURNS;
            slots.get_mut(lane).into_iter().for_each(|slot| *slot = position as f32);
        }
        is_within
    }

    /// Says that the states are on a way between free ones, and how far the robot goes from each: by a change of the base, and of
    /// the tree's variables.
    pub(crate) fn spread(&self, eight: &mut Eight, base: [f64; 3], change: impl Fn(usize) -> f64) {
        eight.is_way = true;
        // Rounded up.
        let single = |value: f64| (value.abs() * (1.0 + 1e-5)) as f32;
        for (slot, driver) in eight.amounts.iter_mut().zip(&self.drivers) {
            *slot = single(change(driver.variable) * driver.multiplier);
        }
        let [x, y, yaw] = base;
        (eight.slides, eight.turns) = (single((x * x + y * y).sqrt()), single(yaw));
    }
}

impl Rigid {
    fn new(pose: &Isometry3<f64>) -> Self {
        let turn = pose.rotation.to_rotation_matrix();
        Self { turn: columns(turn.matrix()), at: single(&pose.translation.vector) }
    }
}

impl Joint {
    fn new(joint: &RigJoint) -> Self {
        let before = joint.before.rotation.to_rotation_matrix().into_inner();
        let cross = joint.axis.cross_matrix();
        Self {
            parent: joint.parent,
            slides: joint.slides,
            at: single(&joint.before.translation.vector),
            axis: single(&(before * joint.axis.into_inner())),
            still: columns(&before),
            swing: columns(&(before * cross)),
            bend: columns(&(before * cross * cross)),
        }
    }
}

impl Part {
    fn new((frame, carriers): (usize, u64), solid: &Solid, slack: f64) -> Option<Self> {
        let sides = sides(&solid.shape)?;
        let along = |axis: usize, half: f64| solid.axes.get(axis).map(|axis| axis * half);
        // In a capsule around the longest axis of a box or a cylinder, a little less long than it.
        let around = |axis: usize| {
            let half = *sides.get(axis)?;
            let wide = (sides.norm_squared() - half * half).max(0.0).sqrt();
            Some((along(axis, half)?, wide))
        };
        let longest = sides.imax();
        let (half, radius) = match solid.shape {
            Shape::Capsule { radius, half } => (along(2, half)?, radius),
            Shape::Cylinder { radius, half } if half > 0.5 * radius => (along(2, half)?, radius),
            Shape::Cylinder { radius, half } => (Vector3::zeros(), libm::hypot(radius, half)),
            Shape::Box(_) => around(longest)?,
            Shape::HalfSpace => return None,
        };
        let is_capsule = matches!(solid.shape, Shape::Capsule { .. });
        let axes = [along(0, 1.0)?, along(1, 1.0)?, along(2, 1.0)?].map(|axis| single(&axis));
        Some(Self {
            frame,
            carriers,
            centre: single(&solid.centre),
            half: single(&half),
            radius: radius as f32,
            inner: if is_capsule { radius as f32 } else { 0.0 },
            reach: solid.reach() as f32,
            slack: slack as f32,
            is_round: matches!(solid.shape, Shape::Cylinder { .. }),
            slab: (!is_capsule).then(|| (axes, single(&sides))),
        })
    }
}

/// The bit of a frame; the last of them stand together.
pub(super) fn frame_bit(frame: usize) -> u64 {
    1 << frame.min(63)
}

fn columns(matrix: &Matrix3<f64>) -> [[f32; 3]; 3] {
    [0, 1, 2].map(|at: usize| single(&matrix.column(at).into_owned()))
}
