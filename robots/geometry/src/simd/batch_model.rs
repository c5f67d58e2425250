//! A robot of which some joints move: what is needed to place it in eight states at once.

use nalgebra::{Isometry3, Matrix3, Vector3};

use super::obb::{sides, single};
use super::posed_batch::Lane8x3;
use super::{FAR, LONG, MOVED, TURNED, TURNS};
use crate::collision::{CollisionModel, Shape, Solid};
use crate::kinematics::{JointCoupling, ReducedJoint, ReducedModel};

/// A robot. Frame 0 stands still on the base, frame `n` + 1 is that of joint `n`.
#[derive(Clone, Debug)]
pub(crate) struct BatchModel {
    pub(super) base_from_root: Rigid,
    pub(super) joints: Vec<BatchJoint>,
    couplings: Vec<JointCoupling>,
    pub(super) parts: Vec<BatchPart>,
    /// For each part, in rows of eight, the later ones that it may not touch.
    pub(super) beside: Vec<Vec<Beside>>,
    /// For each frame the joints that move it, from the root on.
    pub(super) ancestors: Vec<Vec<usize>>,
    stride: usize,
}

/// A pose by the images of the three directions, and of the origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rigid {
    pub(super) turn: [[f32; 3]; 3],
    pub(super) at: [f32; 3],
}

/// A joint turned by `q`: `still + swing sin q + bend (1 − cos q)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct BatchJoint {
    pub(super) parent: usize,
    pub(super) is_prismatic: bool,
    /// In the frame that carries it, as is all else.
    pub(super) at: [f32; 3],
    pub(super) axis: [f32; 3],
    pub(super) still: [[f32; 3]; 3],
    pub(super) swing: [[f32; 3]; 3],
    pub(super) bend: [[f32; 3]; 3],
}

/// A part as the capsule that holds it, in its frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct BatchPart {
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
    /// The radius of the ball around the frame's origin that holds it.
    pub(super) far: f32,
    /// How far it may be off as it is placed, twice, in m.
    pub(super) slack: f32,
    /// What is no capsule: the box that holds it, by its directions and half of its sides.
    pub(super) obb: Option<([[f32; 3]; 3], [f32; 3])>,
    /// Whether it is a cylinder along the last of these directions.
    pub(super) is_round: bool,
}

/// Of eight parts those that may not touch another one and are in other frames than it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Beside {
    /// A bit for each of them.
    pub(super) parts: u8,
    /// How many joints, from the root on, move both.
    pub(super) common: [usize; 8],
}

/// Eight states, and how far the robot may go from each.
#[derive(Clone, Debug)]
pub(crate) struct Batch8 {
    /// x and y from the origin, and yaw.
    pub(super) base: [[f32; 8]; 3],
    /// The directions and the origin of the root's frame, where it is not on a base.
    pub(super) root: Option<[Lane8x3; 4]>,
    /// For each joint.
    pub(super) positions: Vec<[f32; 8]>,
    /// By how much each joint changes on the way, and the base.
    pub(super) changes: Vec<f32>,
    pub(super) shift: [f32; 3],
    /// How far each joint goes, and the base slides and turns.
    pub(super) amounts: Vec<f32>,
    pub(super) slides: f32,
    pub(super) turns: f32,
    /// Whether they are on a way between free states, so that what does not move on it is free.
    pub(super) is_way: bool,
}

impl BatchModel {
    /// A robot with a body; `None` where it is too large.
    pub(crate) fn new(
        reduced: &ReducedModel,
        base_from_root: &Isometry3<f64>,
        body: &CollisionModel,
    ) -> Option<Self> {
        let mut ancestors: Vec<Vec<usize>> = vec![vec![]];
        // How far from the base's origin each frame can be, and how far its directions and its origin may be off.
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
            // What is in one frame is as far apart as it was.
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

    /// Solids that move as one, in a frame of their own; `None` where they are too large.
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

    /// The root's frame at some poses, at most eight, the first again for what is left; `None` where one is too far away.
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

    /// One more than the most joints that move a part, and one more.
    pub(super) fn stride(&self) -> usize {
        self.stride
    }

    /// Eight times the same state, which is nowhere yet.
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

    /// Sets one of eight states; whether it is within what is accurate. The base is seen from the origin.
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

    /// Sets eight states at shares of the straight way between two free ones, from each of which the robot goes on by `half` of the
    /// way to either side; whether the way is within what is accurate.
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

    /// Says that the states are on a way between free ones, and how far the robot goes from each: by a change of the base, and of
    /// the tree's variables.
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
    /// Whether a joint of which the frame's bit is set moves one of two and not the other.
    #[inline(always)]
    pub(super) fn is_moved_against(&self, other: &Self, moving: u64) -> bool {
        let last = bit(usize::MAX);
        ((self.carriers ^ other.carriers) | ((self.carriers | other.carriers) & last)) & moving != 0
    }

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
            far: ((solid.centre.norm() + solid.reach()) * (1.0 + 1e-6)) as f32,
            slack: slack as f32,
            is_round: matches!(solid.shape, Shape::Cylinder { .. }),
            obb: (!is_capsule).then(|| (axes, single(&sides))),
        })
    }
}

impl Batch8 {
    /// Bits of the frames whose joints move on the way.
    pub(super) fn moving(&self) -> u64 {
        let moving = self.amounts.iter().zip(1..).filter(|(amount, _)| **amount > 0.0);
        moving.fold(0, |bits, (_, frame)| bits | bit(frame))
    }
}

/// A bit for each of some, of which the last stand together.
#[inline(always)]
pub(super) fn bit(at: usize) -> u64 {
    1 << at.min(63)
}

fn columns(matrix: &Matrix3<f64>) -> [[f32; 3]; 3] {
    [0, 1, 2].map(|at: usize| single(&matrix.column(at).into_owned()))
}
