//! A hand on a handle that moves: states that follow it, and whether the robot and what moves stay clear of each other
//! and of all else.

use nalgebra::{Isometry3, Translation3, Vector3};
use smol_str::SmolStr;

use super::excursion::Excursion;
use super::grasp::Hold;
use super::opening::Opening;
use super::pull::Pull;
use super::room::{GAP, Room};
use super::shrunk::resized;
use super::state::State;
use super::things::{Thing, Things};
use super::touch::{Allowed, Touch};
use super::travel::{Tally, plane};
use crate::collision::Solid;
use crate::inverse::{Tolerance, numeric};
use crate::trigonometry::turn;

/// The greatest angle of a door between two way-points, in rad.
const TURN: f64 = 0.05;
/// The greatest way of a handle between two way-points where the arm follows, in m.
const STEP: f64 = 0.03;
/// How far the hand may be from where the handle wants it, in m and in rad, between two way-points.
const OFF: [f64; 2] = [0.002, 0.02];
/// How often a leg is halved before it counts as not free.
const DEPTH: u32 = 12;
/// By how much what moves is taken smaller where it may touch its surroundings, as drawers and doors do, in m.
const PLAY: f64 = 0.004;

/// What moves so that the hand follows.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Following {
    /// The base, with the arm still.
    Base(Turning),
    /// The arm, with the base still.
    Arm(Turning),
}

/// How much of the door's turn the hand does not make but slides about the bar: 0 none, 1 all, so that it keeps its
/// direction.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Turning(pub(super) f64);

impl Room<'_> {
    /// The last state of a way that follows the handle, where the base follows; else the state itself.
    pub(super) fn follows_to(
        &self,
        pull: &Pull<'_>,
        hold: &Hold,
        state: &State,
        following: Following,
    ) -> Option<State> {
        match following {
            Following::Base(turning) => {
                Some(carried(&self.gripping(pull.hand, state), &pull.moved(hold, 1.0, turning)))
            }
            Following::Arm(_) => {
                self.states(pull, hold, &self.gripping(pull.hand, state), following)?.last().cloned()
            }
        }
    }

    /// The states of a way that follows the handle, where all of it is free.
    pub(super) fn follow(
        &self,
        pull: &Pull<'_>,
        hold: &Hold,
        state: &State,
        following: Following,
        met: &mut Tally,
    ) -> Option<Vec<State>> {
        let states = self.states(pull, hold, &self.gripping(pull.hand, state), following)?;
        let (Following::Base(turning) | Following::Arm(turning)) = following;
        let count = states.len().saturating_sub(1).max(1) as f64;
        let [x, y] = plane(state);
        let far = states.iter().map(|state| libm::hypot(state.base[0] - x, state.base[1] - y));
        let around = self.around([x, y], far.fold(0.0, f64::max) + 0.01);
        for (pair, at) in states.windows(2).zip(0..) {
            let [one, other] = pair else { continue };
            let done = [f64::from(at) / count, f64::from(at + 1) / count];
            let middle = one.towards(other, 0.5);
            let wanted = pull.moved(hold, (done[0] + done[1]) / 2.0, turning) * hold.map_from_tip;
            let tip = self.machine.map_from_links(&middle).get(pull.hand.tip).copied()?;
            let off = (tip.translation.vector - wanted.translation.vector).norm();
            if off > OFF[0] || tip.rotation.angle_to(&wanted.rotation) > OFF[1] {
                return None;
            }
            let free = around
                .edge(one, other, Allowed::default())
                .and_then(|()| self.edge_beside(one, other, pull, done));
            if let Err(touch) = free {
                met.add(&touch);
                return None;
            }
        }
        Some(states)
    }

    fn states(
        &self,
        pull: &Pull<'_>,
        hold: &Hold,
        state: &State,
        following: Following,
    ) -> Option<Vec<State>> {
        let angle = pull.opening.hinge().map_or(0.0, |(_, angle)| angle.abs());
        match following {
            Following::Base(turning) => {
                let steps = libm::ceil(angle / TURN).max(1.0) as u32;
                let done = |step: u32| f64::from(step) / f64::from(steps);
                Some((0..=steps).map(|step| carried(state, &pull.moved(hold, done(step), turning))).collect())
            }
            Following::Arm(turning) => {
                let steps = libm::ceil((pull.opening.length() / STEP).max(angle / TURN)).max(1.0) as u32;
                let chain = pull.hand.solver.chain();
                let base_from_map = self.map_from_base(state.base).inverse();
                let mut values: Vec<f64> =
                    chain.in_tree.iter().map(|at| state.joints.get(*at).copied().unwrap_or(0.0)).collect();
                let mut states = vec![state.clone()];
                for step in 1..=steps {
                    let done = f64::from(step) / f64::from(steps);
                    let wanted = base_from_map * pull.moved(hold, done, turning) * hold.map_from_tip;
                    let next = numeric::refined(chain, &wanted, &values, 20, Tolerance::EXACT)?;
                    let jump = next.iter().zip(&values).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                    // Another branch of the arm does not follow.
                    if jump > 0.5 {
                        return None;
                    }
                    values = next;
                    let mut joints = state.joints.clone();
                    for (at, value) in chain.in_tree.iter().zip(&values) {
                        if let Some(slot) = joints.get_mut(*at) {
                            *slot = *value;
                        }
                    }
                    states.push(State { base: state.base, joints });
                }
                Some(states)
            }
        }
    }

    /// Whether the straight way between two states is free of what moves along, from `done[0]` to `done[1]` of the travel.
    fn edge_beside(&self, from: &State, to: &State, pull: &Pull<'_>, done: [f64; 2]) -> Result<(), Touch> {
        let [begin, end] = pull.parts;
        let part = |share: f64| {
            let done = done[0] + (done[1] - done[0]) * share;
            begin + (end - begin) * done
        };
        let drives = self.machine.drives();
        let mut open = vec![(0.5, 0.5, 0)];
        while let Some((middle, half, depth)) = open.pop() {
            let state = from.towards(to, middle);
            let poses = self.machine.map_from_links(&state);
            let placed = self.body.placed(&poses);
            let excursion = Excursion { from, to, half };
            let moving = pull.opening.moving(part(middle));
            let span = (part(middle + half) - part(middle - half)).abs() / 2.0;
            let mut is_certain = true;
            for (own, solid) in self.body.parts().iter().zip(&placed) {
                if !drives && pull.hand.carried.get(own.link) != Some(&true) {
                    continue;
                }
                let ancestors = self.machine.ancestor_joints(own.link);
                let goes = excursion.in_map(state.base, ancestors, &poses, solid, solid.reach());
                for other in &moving {
                    let room = goes + pull.opening.goes(other, span);
                    if solid.is_farther(other, GAP + room) {
                        continue;
                    }
                    if depth >= DEPTH || !solid.is_farther(other, GAP) {
                        let link = self.machine.tree().links().get(own.link).cloned().unwrap_or_default();
                        return Err(Touch { link, other: pull.id.into(), is_own: false });
                    }
                    is_certain = false;
                }
            }
            if !is_certain {
                open.push((middle - half / 2.0, half / 2.0, depth + 1));
                open.push((middle + half / 2.0, half / 2.0, depth + 1));
            }
        }
        Ok(())
    }

    /// The room without a container and what goes with it, but with what of it stays; and what goes with it, as it lies when it
    /// is closed.
    pub(super) fn without(&self, index: usize, opening: &Opening, part: f64) -> (Self, Vec<Solid>) {
        let carried = |entity: usize| {
            let entity = self.scene.entities.get_index(entity).map(|(_, entity)| entity);
            let pose = entity.filter(|entity| !entity.fixed).and_then(|entity| self.world.pose(entity));
            pose.is_some_and(|pose| opening.carries(&pose.translation.vector, part))
        };
        let back = opening.map_moved(part).inverse();
        let mut room = self.clone();
        let (inside, around): (Vec<Thing>, Vec<Thing>) =
            self.things.iter().filter(|thing| thing.entity != index).partition(|thing| carried(thing.entity));
        let still = opening.still().iter().map(|solid| Thing::new(index, *solid));
        room.things = Things::new(around.into_iter().chain(still).collect());
        room.opening = Some(index);
        (room, inside.iter().map(|thing| thing.solid.moved(&back)).collect())
    }

    /// The room with what moves where it is when it is open by a part.
    pub(super) fn beside(&self, opening: &Opening, part: f64) -> Self {
        let mut room = self.clone();
        let entity = self.opening.unwrap_or(usize::MAX);
        room.things =
            self.things.with(opening.moving(part).into_iter().map(|solid| Thing::new(entity, solid)));
        room
    }

    /// What the door or drawer itself runs into on its way: the first thing that it overlaps at one of 65 places.
    pub(super) fn stops(&self, opening: &Opening, [from, to]: [f64; 2]) -> Option<SmolStr> {
        const PLACES: u32 = 64;
        (0..=PLACES).find_map(|at| {
            let part = from + (to - from) * f64::from(at) / f64::from(PLACES);
            let moving: Vec<Solid> = opening.moving(part).iter().map(smaller).collect();
            let others = self.things.iter().filter(|thing| Some(thing.entity) != self.opening);
            let met =
                others.into_iter().find(|thing| moving.iter().any(|it| !it.is_farther(&thing.solid, 0.0)));
            met.map(|thing| self.name(thing.entity))
        })
    }
}

impl Pull<'_> {
    /// How the hand has moved in the map since it took the handle, after `done` of its way.
    pub(super) fn moved(&self, hold: &Hold, done: f64, Turning(share): Turning) -> Isometry3<f64> {
        let [from, to] = self.parts;
        let part = from + (to - from) * done;
        let moved = self.opening.map_moved(part) * self.opening.map_moved(from).inverse();
        let Some((axis, angle)) = self.opening.hinge() else { return moved };
        let bar = self.bar(hold);
        let back = turn(&axis, -share * angle * (part - from));
        Translation3::from((moved * bar).coords) * (back * moved.rotation) * Translation3::from(-bar.coords)
    }
}

/// A state with the base moved along with something that stays level.
fn carried(state: &State, moved: &Isometry3<f64>) -> State {
    let [x, y, yaw] = state.base;
    let place = moved * nalgebra::Point3::new(x, y, 0.0);
    let ahead = moved.rotation * Vector3::x();
    state.at([place.x, place.y, yaw + libm::atan2(ahead.y, ahead.x)])
}

fn smaller(solid: &Solid) -> Solid {
    resized(solid, |half| (half - PLAY).max(half * 0.1))
}
