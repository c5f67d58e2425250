//! What is known of one cell of states: where each part of the robot is, how far it can be from there, and what it touches.

use std::f64::consts::TAU;
use std::rc::Rc;

use nalgebra::{Isometry3, Vector3};

use super::Family;
use super::board::{Share, is_in};
use super::joined::Own;
use super::tie::Ties;
use crate::collision::Solid;
use crate::inverse::interval::{CellEnclosure, DisplacementBound, PoseSet};
use crate::kinematics::ReducedModel;
use crate::query::around::{Around, above_floor};
use crate::query::machine::Hand;
use crate::query::room::GAP;
use crate::query::shrunk::{Placed, SLACK, inner};
use crate::query::solver::Solver;
use crate::query::touch::Allowed;

/// What is needed to look at cells.
pub(super) struct Cover<'a, 'r, 'w> {
    pub(super) around: &'a Around<'r, 'w>,
    pub(super) hand: &'a Hand,
    pub(super) family: Family<'a>,
    pub(super) allowed: Allowed,
    pub(super) reduced: ReducedModel,
    pub(super) ties: Ties,
    /// The robot's joints with the hand as it reaches.
    joints: Vec<f64>,
    /// For each frame of the rig but the first the joint of the arm that it is, if it is one.
    arm: Vec<Option<usize>>,
    /// The frame of the tip, and the tip in it.
    last: usize,
    frame_from_tip: Isometry3<f64>,
    pub(super) limbs: Vec<Limb>,
    /// Of the things the radius of the greatest ball within, about.
    things: Vec<f64>,
}

/// A part of the robot.
pub(super) struct Limb {
    pub(super) frame: usize,
    /// In the frame.
    pub(super) solid: Solid,
    pub(super) inner: f64,
    pub(super) reach: f64,
}

/// Two that may not touch: a part and a thing, the floor or another part.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Pair {
    Thing(u16, u16),
    Floor(u16),
    Own(u16, u16),
}

/// What a part may touch in a cell.
#[derive(Clone)]
pub(super) struct Group {
    part: u16,
    /// How far it could be off when others were last left out.
    drift: f64,
    is_above_floor: bool,
    /// Those first that the largest balls are in.
    things: Rc<[u16]>,
}

impl Group {
    /// One after the other.
    pub(super) fn pairs(&self) -> impl Iterator<Item = Pair> + '_ {
        let things = self.things.iter().map(|at| Pair::Thing(self.part, *at));
        things.chain(self.is_above_floor.then_some(Pair::Floor(self.part)))
    }
}

/// Where a part can be off by less than this share of what it could when it was last looked for what it cannot touch, that
/// is done again.
pub(super) const FEWER: f64 = 0.6;
/// Before it can be off by less than this, in m, it is not looked for at all.
pub(super) const FAR: f64 = 0.8;

/// The robot in a cell: the frames of the rig, and those of its parts that were asked for.
#[derive(Default)]
pub(super) struct Placing {
    pub(super) frames: Vec<(Isometry3<f64>, DisplacementBound)>,
    parts: Vec<Option<Placed>>,
    /// Of each joint of the rig its position, and how far its variable can be off; nothing where that is not known.
    pub(super) steps: Vec<[f64; 2]>,
    pub(super) is_joined: bool,
    pub(super) own: Own,
}

impl Placing {
    fn part(&self, part: u16) -> Option<&Placed> {
        self.parts.get(usize::from(part))?.as_ref()
    }
}

impl<'a, 'r, 'w> Cover<'a, 'r, 'w> {
    /// `None` where the robot is not simple enough.
    pub(super) fn new(around: &'a Around<'r, 'w>, hand: &'a Hand, allowed: Allowed) -> Option<Self> {
        let (room, machine) = (around.room, around.room.machine);
        let family = match &hand.solver {
            Solver::Lift(arm) => Family::Lift(arm),
            Solver::Parallel(arm) if machine.drives() => {
                Family::Parallel(arm, room.map_from_base([0.0; 3]).translation.z)
            }
            Solver::Seven(arm) if !machine.drives() => {
                let base = room.world.robot.base;
                Family::Seven(arm, room.map_from_base(base), base)
            }
            Solver::Parallel(_) | Solver::Seven(_) | Solver::Steps(_) => Family::Any,
        };
        let chain = hand.solver.chain();
        let joints = room.with(hand, [0.0; 3], &[]).joints;
        let reduced = machine.tree().reduced(&joints, |dof| chain.in_tree.contains(&dof))?;
        let (last, frame_from_tip) = *reduced.links.get(hand.tip)?;
        // From the tip down to the base.
        let (mut frame, mut order) = (last, vec![]);
        while let Some(joint) = frame.checked_sub(1).and_then(|at| reduced.joints.get(at)) {
            order.push(frame);
            frame = joint.parent;
        }
        order.reverse();
        if order.len() != chain.joints.len() {
            return None;
        }
        let arm = (1..=reduced.joints.len()).map(|at| order.iter().position(|frame| *frame == at)).collect();
        let mut limbs = Vec::new();
        for part in room.body.parts() {
            let (frame, pose) = reduced.links.get(part.link)?;
            let solid = part.solid.moved(pose);
            limbs.push(Limb { frame: *frame, solid, inner: inner(&solid), reach: solid.reach() });
        }
        let things: Vec<f64> = around.things.iter().map(|near| inner(&near.solid)).collect();
        // More than any robot or neighbourhood has.
        let is_small = limbs.len() < usize::from(u16::MAX) && things.len() < usize::from(u16::MAX);
        let cover = Self {
            around,
            hand,
            family,
            allowed,
            ties: Ties::new(&reduced),
            reduced,
            joints,
            arm,
            last,
            frame_from_tip,
            limbs,
            things,
        };
        is_small.then_some(cover)
    }

    /// What the hand may touch of what stands around, and all else that the arm or the base moves against each other.
    pub(super) fn groups(&self) -> [Rc<[Group]>; 2] {
        let (mut hand, mut others) = (vec![], vec![]);
        for ((limb, own), part) in self.around.limbs.iter().zip(&self.limbs).zip(0..) {
            let things = self.around.things.iter().zip(&self.things).zip(0..);
            let things =
                things.filter(|((near, _), _)| limb.counts && !limb.may_touch(near.entity, self.allowed));
            let mut things: Vec<(f64, u16)> = things.map(|((_, inner), at)| (*inner, at)).collect();
            things.sort_by(|(one, _), (other, _)| other.total_cmp(one));
            let things = things.into_iter().map(|(_, at)| at).collect();
            let is_above_floor = limb.counts && limb.is_carried;
            let group = Group { part, drift: FAR / FEWER, is_above_floor, things };
            if group.is_above_floor || !group.things.is_empty() {
                if own.frame == self.last { hand.push(group) } else { others.push(group) }
            }
        }
        [hand.into(), others.into()]
    }

    /// What of a group may touch; `None` where the group is as it was.
    ///
    /// # Errors
    ///
    /// What touches throughout.
    pub(super) fn left_of(&self, placing: &mut Placing, group: &Group) -> Result<Option<Group>, Pair> {
        let part = group.part;
        self.ensure(placing, part);
        let Some(own) = placing.part(part) else { return Ok(None) };
        if group.is_above_floor && self.is_on_floor(placing, own, part, 1.0) {
            return Err(Pair::Floor(part));
        }
        let is_fewer = own.drift < FEWER * group.drift;
        let mut things: Vec<u16> = Vec::new();
        for at in group.things.iter().copied() {
            let Some(near) = self.around.things.get(usize::from(at)) else { continue };
            if is_fewer && own.is_apart(&near.solid, near.reach, own.drift) {
                continue;
            }
            if self.is_in(placing, own, part, at, 1.0) {
                return Err(Pair::Thing(part, at));
            }
            if is_fewer {
                things.push(at);
            }
        }
        if !is_fewer {
            return Ok(None);
        }
        let drift = own.drift;
        Ok(Some(Group { drift, things: kept(things, &group.things), ..*group }))
    }

    /// How far a pair can be off.
    pub(super) fn off_by(&self, placing: &mut Placing, pair: Pair) -> f64 {
        match pair {
            Pair::Thing(part, _) | Pair::Floor(part) => self.part(placing, part).map_or(0.0, |own| own.drift),
            Pair::Own(part, at) => self.own_off(placing, part, at),
        }
    }

    /// Whether something of some groups touches in the middle.
    pub(super) fn is_stuck_in_middle(&self, placing: &mut Placing, groups: &[Group]) -> bool {
        groups.iter().flat_map(Group::pairs).any(|pair| self.touches_in_middle(placing, pair))
    }

    /// Puts the hand alone where its tip is at any of some poses; what is elsewhere is not known to be anywhere.
    pub(super) fn place_hand(&self, tips: &PoseSet, placing: &mut Placing) {
        let pose = tips.map_from_tip * self.frame_from_tip.inverse();
        placing.frames.clear();
        let unknown = DisplacementBound::unknown();
        placing.frames.resize(self.reduced.joints.len() + 1, (Isometry3::identity(), unknown));
        placing.frames.get_mut(self.last).into_iter().for_each(|slot| *slot = (pose, tips.displacement));
        placing.steps.clear();
        self.forget(placing);
    }

    /// Puts the robot where it is in a cell.
    pub(super) fn place(&self, enclosure: &CellEnclosure, placing: &mut Placing) {
        let chain = self.hand.solver.chain();
        let root = (self.around.room.machine.map_from_root(enclosure.base), enclosure.base_displacement);
        placing.frames.clear();
        placing.frames.push(root);
        placing.steps.clear();
        placing.is_joined = enclosure.is_joined;
        for (joint, arm) in self.reduced.joints.iter().zip(&self.arm) {
            let mut values = chain.in_tree.iter().zip(&enclosure.values).zip(&chain.dofs);
            let known = values.find(|((at, _), _)| **at == joint.coupling.dof);
            // Values that differ by full turns are one for the arm, and not for what follows it.
            let turns = known.is_some_and(|(_, dof)| {
                !dof.is_prismatic && dof.limits.is_none_or(|(lower, upper)| upper - lower > TAU)
            });
            let known = known.map(|((_, value), _)| *value);
            let still = self.joints.get(joint.coupling.dof).copied().unwrap_or_default();
            let [value, off] = known.unwrap_or([still, 0.0]);
            let position = joint.coupling.multiplier * value + joint.coupling.offset;
            placing.steps.push([position, off]);
            if let Some(frame) = arm.and_then(|at| enclosure.frames.get(at)) {
                placing.frames.push(*frame);
                continue;
            }
            // What follows a joint of the arm elsewhere.
            let (parent, drift) = placing.frames.get(joint.parent).copied().unwrap_or(root);
            let off = off * joint.coupling.multiplier;
            let pose = parent * joint.before * joint.motion(position);
            let drift = match (joint.is_prismatic, off == 0.0) {
                _ if turns => DisplacementBound::unknown(),
                (true, _) => drift.slid(pose.rotation * joint.axis.into_inner() * off),
                (false, true) => drift,
                (false, false) => DisplacementBound::unknown(),
            };
            placing.frames.push((pose, drift));
        }
        self.forget(placing);
    }

    fn forget(&self, placing: &mut Placing) {
        placing.parts.clear();
        placing.parts.resize(self.limbs.len(), None);
        placing.own.axes.clear();
        placing.own.parts.clear();
        placing.own.parts.resize(self.limbs.len(), None);
    }

    /// A part where it is in the middle of a cell, and how far it can be from there.
    pub(super) fn part<'p>(&self, placing: &'p mut Placing, part: u16) -> Option<&'p Placed> {
        self.ensure(placing, part);
        placing.part(part)
    }

    fn ensure(&self, placing: &mut Placing, part: u16) {
        let at = usize::from(part);
        let Some(slot @ None) = placing.parts.get_mut(at) else { return };
        let Some(limb) = self.limbs.get(at) else { return };
        let Some((pose, drift)) = placing.frames.get(limb.frame) else { return };
        let solid = limb.solid.moved(pose);
        *slot = Some(Placed { solid, inner: limb.inner, reach: limb.reach, drift: drift.of(&solid) });
    }

    /// Whether a pair touches wherever both go by no more than a share of how far they can be off.
    pub(super) fn touches(&self, placing: &mut Placing, pair: Pair, share: f64) -> bool {
        match pair {
            Pair::Thing(part, at) => {
                self.ensure(placing, part);
                placing.part(part).is_some_and(|own| self.is_in(placing, own, part, at, share))
            }
            Pair::Own(part, at) => {
                if placing.steps.is_empty() {
                    return false;
                }
                self.own_touches(placing, part, at, share)
            }
            Pair::Floor(part) => {
                self.ensure(placing, part);
                placing.part(part).is_some_and(|own| self.is_on_floor(placing, own, part, share))
            }
        }
    }

    /// Whether a part touches a thing throughout.
    fn is_in(&self, placing: &Placing, own: &Placed, part: u16, at: u16, share: f64) -> bool {
        let at = usize::from(at);
        let Some((near, inner)) = self.around.things.get(at).zip(self.things.get(at)) else { return false };
        let wide = own.reach + near.reach + GAP;
        if (own.solid.centre - near.solid.centre).norm_squared() > wide * wide {
            return false;
        }
        let frame = self.limbs.get(usize::from(part)).and_then(|limb| placing.frames.get(limb.frame));
        frame.is_some_and(|(_, drift)| is_in(&own.solid, &Share(share, drift), &near.solid))
            || own.touches(&near.solid, *inner, near.reach, share * own.drift)
    }

    /// Whether a part is on the floor throughout, by the lowest point of it in the middle.
    fn is_on_floor(&self, placing: &Placing, own: &Placed, part: u16, share: f64) -> bool {
        let frame = self.limbs.get(usize::from(part)).and_then(|limb| placing.frames.get(limb.frame));
        let Some((_, drift)) = frame else { return false };
        let up = Vector3::z();
        let lowest = own.solid.support(&-up);
        lowest.z - own.solid.rim() + share * drift.along(&lowest, &up) + SLACK <= GAP
    }

    /// Whether a pair touches in the middle; what is not known to be anywhere touches nothing.
    pub(super) fn touches_in_middle(&self, placing: &mut Placing, pair: Pair) -> bool {
        match pair {
            Pair::Thing(part, at) => {
                let at = usize::from(at);
                let thing = self.around.things.get(at).zip(self.things.get(at));
                self.part(placing, part).zip(thing).is_some_and(|(own, (near, inner))| {
                    own.drift.is_finite() && own.touches(&near.solid, *inner, near.reach, 0.0)
                })
            }
            Pair::Own(part, at) => {
                if placing.steps.is_empty() {
                    return false;
                }
                self.ensure_both(placing, part, at);
                self.both(placing, part, at).is_some_and(|(one, other)| one.touches(other, 0.0))
            }
            Pair::Floor(part) => self
                .part(placing, part)
                .is_some_and(|own| own.drift.is_finite() && above_floor(&own.solid) + SLACK <= GAP),
        }
    }
}

/// What is left of all, which stays what it is where that is all.
pub(super) fn kept<T: Copy>(left: Vec<T>, all: &Rc<[T]>) -> Rc<[T]> {
    if left.len() == all.len() { Rc::clone(all) } else { left.into() }
}
