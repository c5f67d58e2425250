//! Batch model of a robot with some joints free, for eight configurations at once.

use nalgebra::{Isometry3, Matrix3, Vector3};

use super::boxes::{sides, single};
use super::lanes::Lane8x3;
use super::{FAR, LONG, MOVED, TURNED, TURNS};
use crate::collision::{CollisionModel, Shape, Solid};
use crate::kinematics::{JointCoupling, ReducedJoint, ReducedModel};

/// Robot with some joints free. Frame 0 is fixed to the base, frame `n` + 1 is that of joint `n`.
#[derive(Clone, Debug)]
pub(crate) struct BatchModel {
    pub(super) base_from_root: Rigid,
    pub(super) joints: Vec<BatchJoint>,
    couplings: Vec<JointCoupling>,
    pub(super) parts: Vec<BatchPart>,
    /// For each part, in rows of eight, the later parts that it must not touch.
    pub(super) beside: Vec<Vec<Beside>>,
    /// For each frame the joints that move it, from the root on.
    pub(super) ancestors: Vec<Vec<usize>>,
    stride: usize,
}

/// Pose as the images of the three axes and of the origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rigid {
    pub(super) turn: [[f32; 3]; 3],
    pub(super) at: [f32; 3],
}

/// Joint with its rotation by `q` as `still + swing sin q + bend (1 − cos q)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct BatchJoint {
    pub(super) parent: usize,
    pub(super) is_prismatic: bool,
    /// In the parent frame, as are the other fields.
    pub(super) at: [f32; 3],
    pub(super) axis: [f32; 3],
    pub(super) still: [[f32; 3]; 3],
    pub(super) swing: [[f32; 3]; 3],
    pub(super) bend: [[f32; 3]; 3],
}

/// Part as its bounding capsule, in its frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct BatchPart {
    pub(super) frame: usize,
    /// Bit mask of that frame and its ancestors.
    pub(super) carriers: u64,
    pub(super) centre: [f32; 3],
    /// From the centre to an end of the capsule's axis.
    pub(super) half: [f32; 3],
    pub(super) radius: f32,
    /// Radius of an inner capsule about the same axis.
    pub(super) inner: f32,
    /// Radius of the bounding ball around the centre.
    pub(super) reach: f32,
    /// Radius of the bounding ball around the origin of the frame.
    pub(super) far: f32,
    /// Twice the error of its place, in m.
    pub(super) slack: f32,
    /// Box of a part that is no capsule: its axes and half extents.
    pub(super) obb: Option<([[f32; 3]; 3], [f32; 3])>,
    /// True for a cylinder along the last of these axes.
    pub(super) is_round: bool,
}

/// Self-collision pairs of one part with a row of eight others in other frames.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Beside {
    /// Bit mask of the parts.
    pub(super) parts: u8,
    /// Number of joints, from the root on, that move both.
    pub(super) common: [usize; 8],
}

/// Eight configurations, and the motion of the robot around each.
#[derive(Clone, Debug)]
pub(crate) struct Batch8 {
    /// x and y from the origin, and yaw, of the base.
    pub(super) base: [[f32; 8]; 3],
    /// Axes and origin of the root frame, for a body that is not on a base.
    pub(super) root: Option<[Lane8x3; 4]>,
    /// Positions of each joint.
    pub(super) positions: Vec<[f32; 8]>,
    /// Signed change of each joint and of the base along the edge.
    pub(super) changes: Vec<f32>,
    pub(super) shift: [f32; 3],
    /// Greatest motion of each joint, and translation and rotation of the base.
    pub(super) amounts: Vec<f32>,
    pub(super) slides: f32,
    pub(super) turns: f32,
    /// True for configurations on an edge between free ones: solids that do not move on it are free.
    pub(super) is_way: bool,
}

impl BatchModel {
    /// Builds the batch model of a robot; `None` if it is too large for the error bounds.
    pub(crate) fn new(
        reduced: &ReducedModel,
        base_from_root: &Isometry3<f64>,
        body: &CollisionModel,
    ) -> Option<Self> {
        let mut ancestors: Vec<Vec<usize>> = vec![vec![]];
        // Greatest distance of each frame from the origin of the base, and the errors of its axes and its
        // origin.
        let mut frames = vec![[base_from_root.translation.vector.norm(), TURNED, 4.0 * TURNED + MOVED]];
        for (joint, at) in reduced.joints.iter().zip(0..) {
            let mut own = ancestors.get(joint.parent)?.clone();
            own.push(at);
            ancestors.push(own);
            let slide = if joint.is_prismatic { 1.0 } else { 0.0 };
            let long = joint.before.translation.vector.norm() + slide;
            let [far, turned, moved] = frames.get(joint.parent)?;
            frames.push([far + long, turned + TURNED, moved + turned * long + MOVED]);
        }
        let parts = body.parts().iter().map(|part| {
            let (frame, pose) = reduced.links.get(part.link)?;
            let solid = part.solid.moved(pose);
            let [far, turned, moved] = frames.get(*frame)?;
            let long = solid.centre.norm() + solid.reach();
            let slack = 2.0 * (moved + turned * long + MOVED);
            let carriers = ancestors.get(*frame)?.iter().fold(0, |bits, joint| bits | bit(joint + 1));
            if far + long <= LONG { BatchPart::new((*frame, carriers), &solid, slack) } else { None }
        });
        let parts = parts.collect::<Option<Vec<BatchPart>>>()?;
        let mut beside = vec![vec![Beside::default(); parts.len().div_ceil(8)]; parts.len()];
        for [one, other] in body.pairs() {
            let frames = (parts.get(*one)?.frame, parts.get(*other)?.frame);
            // Solids on one frame keep their distance.
            if frames.0 != frames.1 {
                let (a, b) = (ancestors.get(frames.0)?, ancestors.get(frames.1)?);
                let common = a.iter().zip(b).take_while(|(a, b)| a == b).count();
                let row = beside.get_mut(*one)?.get_mut(other / 8)?;
                row.parts |= 1 << (other % 8);
                *row.common.get_mut(other % 8)? = common;
            }
        }
        Some(Self {
            base_from_root: Rigid::new(base_from_root),
            joints: reduced.joints.iter().map(BatchJoint::new).collect(),
            couplings: reduced.joints.iter().map(|joint| joint.coupling).collect(),
            parts,
            beside,
            stride: ancestors.iter().map(Vec::len).max().unwrap_or_default() + 2,
            ancestors,
        })
    }

    /// Batch model of solids that move as one body; `None` if they are too large.
    pub(crate) fn rigid<'s>(solids: impl Iterator<Item = &'s Solid>) -> Option<Self> {
        let parts = solids.map(|solid| {
            let long = solid.centre.norm() + solid.reach();
            let slack = 2.0 * (4.0 * TURNED + MOVED + TURNED * long + MOVED);
            if long <= LONG { BatchPart::new((0, 0), solid, slack) } else { None }
        });
        let parts = parts.collect::<Option<Vec<BatchPart>>>()?;
        let beside = vec![vec![]; parts.len()];
        let base_from_root = Rigid::new(&Isometry3::identity());
        Some(Self {
            base_from_root,
            joints: vec![],
            couplings: vec![],
            parts,
            beside,
            ancestors: vec![vec![]],
            stride: 2,
        })
    }

    /// Batch of poses of the root, at most eight; the first fills the lanes that are left. `None` if one is
    /// too far away.
    pub(crate) fn at(&self, poses: &[Isometry3<f64>]) -> Option<Batch8> {
        let mut root = [[[0.0; 8]; 3]; 4];
        let first = poses.first()?;
        for lane in 0..8 {
            let pose = poses.get(lane).unwrap_or(first);
            let at = &pose.translation.vector;
            if at.iter().any(|value| value.abs() > FAR) {
                return None;
            }
            let [x, y, z] = columns(pose.rotation.to_rotation_matrix().matrix());
            for (rows, values) in root.iter_mut().zip([x, y, z, single(at)]) {
                for (row, value) in rows.iter_mut().zip(values) {
                    row.get_mut(lane).into_iter().for_each(|slot| *slot = value);
                }
            }
        }
        Some(Batch8 { root: Some(root), ..self.batch() })
    }

    /// Two more than the greatest number of joints that move a part.
    pub(super) fn stride(&self) -> usize {
        self.stride
    }

    /// Batch of eight equal configurations without a place yet.
    pub(crate) fn batch(&self) -> Batch8 {
        Batch8 {
            base: [[0.0; 8]; 3],
            root: None,
            positions: vec![[0.0; 8]; self.joints.len()],
            changes: vec![0.0; self.joints.len()],
            shift: [0.0; 3],
            amounts: vec![0.0; self.joints.len()],
            slides: 0.0,
            turns: 0.0,
            is_way: false,
        }
    }

    /// Sets one of eight configurations, with the base relative to the origin; returns whether it is within
    /// the accurate range.
    pub(crate) fn set(&self, batch: &mut Batch8, lane: usize, base: [f64; 3], joints: &[f64]) -> bool {
        let mut is_within = true;
        for ((slots, value), limit) in batch.base.iter_mut().zip(base).zip([FAR, FAR, TURNS]) {
            is_within &= value.abs() <= limit;
            slots.get_mut(lane).into_iter().for_each(|slot| *slot = value as f32);
        }
        for (slots, coupling) in batch.positions.iter_mut().zip(&self.couplings) {
            let position = coupling.position(joints);
            is_within &= position.abs() <= TURNS;
            slots.get_mut(lane).into_iter().for_each(|slot| *slot = position as f32);
        }
        is_within
    }

    /// Sets eight configurations at fractions of the edge between two free ones, each the centre of a segment
    /// of `half` of the edge to either side; returns whether the edge is within the accurate range.
    pub(crate) fn set_on(
        &self,
        batch: &mut Batch8,
        [(from, from_joints), (to, to_joints)]: [([f64; 3], &[f64]); 2],
        shares: &[f64; 8],
        half: f64,
    ) -> bool {
        let mut is_within = true;
        let mut set = |slots: &mut [f32; 8], [from, to]: [f64; 2], limit: f64| {
            is_within &= from.abs() <= limit && to.abs() <= limit;
            for (slot, share) in slots.iter_mut().zip(shares) {
                *slot = (from + (to - from) * share) as f32;
            }
        };
        let [x, y, yaw] = &mut batch.base;
        let [from_x, from_y, from_yaw] = from;
        let [to_x, to_y, to_yaw] = to;
        set(x, [from_x, to_x], FAR);
        set(y, [from_y, to_y], FAR);
        set(yaw, [from_yaw, to_yaw], TURNS);
        for (slots, coupling) in batch.positions.iter_mut().zip(&self.couplings) {
            set(slots, [coupling.position(from_joints), coupling.position(to_joints)], TURNS);
        }
        let change = |from: f64, to: f64| (to - from) * half;
        let base = [change(from_x, to_x), change(from_y, to_y), change(from_yaw, to_yaw)];
        self.set_motion(batch, base, |at| {
            from_joints.get(at).zip(to_joints.get(at)).map_or(0.0, |(from, to)| change(*from, *to))
        });
        is_within
    }

    /// Marks the configurations as points of an edge between free ones, and sets the motion around each: by a
    /// change of the base and of the degrees of freedom of the tree.
    pub(crate) fn set_motion(&self, batch: &mut Batch8, base: [f64; 3], change: impl Fn(usize) -> f64) {
        batch.is_way = true;
        // Rounded up.
        let single = |value: f64| (value.abs() * (1.0 + 1e-5)) as f32;
        for ((slot, signed), coupling) in
            batch.amounts.iter_mut().zip(&mut batch.changes).zip(&self.couplings)
        {
            let change = change(coupling.dof) * coupling.multiplier;
            (*slot, *signed) = (single(change), change as f32);
        }
        let [x, y, yaw] = base;
        batch.shift = base.map(|value| value as f32);
        (batch.slides, batch.turns) = (single((x * x + y * y).sqrt()), single(yaw));
    }
}

impl Rigid {
    fn new(pose: &Isometry3<f64>) -> Self {
        let turn = pose.rotation.to_rotation_matrix();
        Self { turn: columns(turn.matrix()), at: single(&pose.translation.vector) }
    }
}

impl BatchJoint {
    fn new(joint: &ReducedJoint) -> Self {
        let before = joint.before.rotation.to_rotation_matrix().into_inner();
        let cross = joint.axis.cross_matrix();
        Self {
            parent: joint.parent,
            is_prismatic: joint.is_prismatic,
            at: single(&joint.before.translation.vector),
            axis: single(&(before * joint.axis.into_inner())),
            still: columns(&before),
            swing: columns(&(before * cross)),
            bend: columns(&(before * cross * cross)),
        }
    }
}

impl BatchPart {
    /// Checks whether one of the moving joints moves exactly one of two parts.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn is_moved_against(&self, other: &Self, moving: u64) -> bool {
        let last = bit(usize::MAX);
        ((self.carriers ^ other.carriers) | ((self.carriers | other.carriers) & last)) & moving != 0
    }

    fn new((frame, carriers): (usize, u64), solid: &Solid, slack: f64) -> Option<Self> {
        let sides = sides(&solid.shape)?;
        let along = |axis: usize, half: f64| solid.axes.get(axis).map(|axis| axis * half);
        // Capsule around the longest axis of a box or a cylinder, slightly shorter than it.
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
            far: ((solid.centre.norm() + solid.reach()) * (1.0 + 1e-6)) as f32,
            slack: slack as f32,
            is_round: matches!(solid.shape, Shape::Cylinder { .. }),
            obb: (!is_capsule).then(|| (axes, single(&sides))),
        })
    }
}

impl Batch8 {
    /// Bit mask of the frames whose joints move along the edge.
    pub(super) fn moving(&self) -> u64 {
        let moving = self.amounts.iter().zip(1..).filter(|(amount, _)| **amount > 0.0);
        moving.fold(0, |bits, (_, frame)| bits | bit(frame))
    }
}

/// Bit of an index; those from 63 on share one.
#[cfg_attr(optimised, inline(always))]
pub(super) fn bit(at: usize) -> u64 {
    1 << at.min(63)
}

fn columns(matrix: &Matrix3<f64>) -> [[f32; 3]; 3] {
    [0, 1, 2].map(|at: usize| single(&matrix.column(at).into_owned()))
}
