//! A hand on a handle that moves: states that follow it, and whether the robot and what moves stay clear of each other
//! and of all else.

use nalgebra::{Isometry3, Translation3, Vector3};
use smol_str::SmolStr;

use crate::collision::Solid;
use crate::inverse::{Tolerance, numeric};
use crate::planning::certify::deflate::resized;
use crate::planning::checking::motion_bound::MotionBound;
use crate::planning::grasp::candidates::GraspCandidate;
use crate::planning::motions::pull::HandlePull;
use crate::planning::scene::articulation::Articulation;
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::MIN_CLEARANCE;
use crate::planning::scene::contact::{AllowedCollisions, Contact};
use crate::planning::scene::grid_index::{Obstacle, ObstacleIndex};
use crate::planning::search::context::QueryContext;
use crate::planning::search::path::{ContactTally, plane};
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
pub(crate) enum FollowMode {
    /// The base, with the arm still.
    Base(HandSlide),
    /// The arm, with the base still.
    Arm(HandSlide),
}

/// How much of the door's turn the hand does not make but slides about the bar: 0 none, 1 all, so that it keeps its
/// direction.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct HandSlide(pub(crate) f64);

impl QueryContext<'_> {
    /// The last state of a way that follows the handle, where the base follows; else the state itself.
    pub(crate) fn follows_to(
        &self,
        pull: &HandlePull<'_>,
        hold: &GraspCandidate,
        configuration: &Configuration,
        following: FollowMode,
    ) -> Option<Configuration> {
        match following {
            FollowMode::Base(turning) => {
                Some(carried(&self.gripping(pull.hand, configuration), &pull.moved(hold, 1.0, turning)))
            }
            FollowMode::Arm(_) => self
                .configurations(pull, hold, &self.gripping(pull.hand, configuration), following)?
                .last()
                .cloned(),
        }
    }

    /// The states of a way that follows the handle, where all of it is free.
    pub(crate) fn follow(
        &self,
        pull: &HandlePull<'_>,
        hold: &GraspCandidate,
        configuration: &Configuration,
        following: FollowMode,
        met: &mut ContactTally,
    ) -> Option<Vec<Configuration>> {
        let configurations =
            self.configurations(pull, hold, &self.gripping(pull.hand, configuration), following)?;
        let (FollowMode::Base(turning) | FollowMode::Arm(turning)) = following;
        let count = configurations.len().saturating_sub(1).max(1) as f64;
        let [x, y] = plane(configuration);
        let far = configurations
            .iter()
            .map(|configuration| libm::hypot(configuration.base[0] - x, configuration.base[1] - y));
        let checker = self.around([x, y], far.fold(0.0, f64::max) + 0.01);
        for (pair, at) in configurations.windows(2).zip(0..) {
            let [one, other] = pair else { continue };
            let done = [f64::from(at) / count, f64::from(at + 1) / count];
            let middle = one.towards(other, 0.5);
            let wanted = pull.moved(hold, (done[0] + done[1]) / 2.0, turning) * hold.map_from_tip;
            let tip = self.model.map_from_links(&middle).get(pull.hand.tip).copied()?;
            let off = (tip.translation.vector - wanted.translation.vector).norm();
            if off > OFF[0] || tip.rotation.angle_to(&wanted.rotation) > OFF[1] {
                return None;
            }
            let free = checker
                .edge(one, other, AllowedCollisions::default())
                .and_then(|()| self.edge_beside(one, other, pull, done));
            if let Err(contact) = free {
                met.add(&contact);
                return None;
            }
        }
        Some(configurations)
    }

    fn configurations(
        &self,
        pull: &HandlePull<'_>,
        hold: &GraspCandidate,
        configuration: &Configuration,
        following: FollowMode,
    ) -> Option<Vec<Configuration>> {
        let angle = pull.opening.hinge().map_or(0.0, |(_, angle)| angle.abs());
        match following {
            FollowMode::Base(turning) => {
                let steps = libm::ceil(angle / TURN).max(1.0) as u32;
                let done = |step: u32| f64::from(step) / f64::from(steps);
                Some(
                    (0..=steps)
                        .map(|step| carried(configuration, &pull.moved(hold, done(step), turning)))
                        .collect(),
                )
            }
            FollowMode::Arm(turning) => {
                let steps = libm::ceil((pull.opening.length() / STEP).max(angle / TURN)).max(1.0) as u32;
                let chain = pull.hand.solver.chain();
                let base_from_map = self.map_from_base(configuration.base).inverse();
                let mut values: Vec<f64> = chain
                    .in_tree
                    .iter()
                    .map(|at| configuration.joints.get(*at).copied().unwrap_or(0.0))
                    .collect();
                let mut configurations = vec![configuration.clone()];
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
                    let mut joints = configuration.joints.clone();
                    for (at, value) in chain.in_tree.iter().zip(&values) {
                        if let Some(slot) = joints.get_mut(*at) {
                            *slot = *value;
                        }
                    }
                    configurations.push(Configuration { base: configuration.base, joints });
                }
                Some(configurations)
            }
        }
    }

    /// Whether the straight way between two states is free of what moves along, from `done[0]` to `done[1]` of the travel.
    fn edge_beside(
        &self,
        from: &Configuration,
        to: &Configuration,
        pull: &HandlePull<'_>,
        done: [f64; 2],
    ) -> Result<(), Contact> {
        let [begin, end] = pull.parts;
        let part = |share: f64| {
            let done = done[0] + (done[1] - done[0]) * share;
            begin + (end - begin) * done
        };
        let drives = self.model.drives();
        let mut open = vec![(0.5, 0.5, 0)];
        while let Some((middle, half, depth)) = open.pop() {
            let configuration = from.towards(to, middle);
            let poses = self.model.map_from_links(&configuration);
            let placed = self.body.placed(&poses);
            let motion_bound = MotionBound { from, to, half };
            let moving = pull.opening.moving(part(middle));
            let span = (part(middle + half) - part(middle - half)).abs() / 2.0;
            let mut is_certain = true;
            for (own, solid) in self.body.parts().iter().zip(&placed) {
                if !drives && pull.hand.carried.get(own.link) != Some(&true) {
                    continue;
                }
                let ancestors = self.model.ancestor_joints(own.link);
                let goes = motion_bound.in_map(configuration.base, ancestors, &poses, solid, solid.reach());
                for other in &moving {
                    let margin = goes + pull.opening.goes(other, span);
                    if solid.is_farther(other, MIN_CLEARANCE + margin) {
                        continue;
                    }
                    if depth >= DEPTH || !solid.is_farther(other, MIN_CLEARANCE) {
                        let link = self.model.tree().links().get(own.link).cloned().unwrap_or_default();
                        return Err(Contact { link, other: pull.id.into(), is_own: false });
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
    pub(crate) fn without(&self, index: usize, opening: &Articulation, part: f64) -> (Self, Vec<Solid>) {
        let carried = |entity: usize| {
            let entity = self.scene.entities.get_index(entity).map(|(_, entity)| entity);
            let pose = entity.filter(|entity| !entity.fixed).and_then(|entity| self.state.pose(entity));
            pose.is_some_and(|pose| opening.carries(&pose.translation.vector, part))
        };
        let back = opening.map_moved(part).inverse();
        let mut context = self.clone();
        let (inside, checker): (Vec<Obstacle>, Vec<Obstacle>) = self
            .obstacles
            .iter()
            .filter(|obstacle| obstacle.entity != index)
            .partition(|obstacle| carried(obstacle.entity));
        let still = opening.still().iter().map(|solid| Obstacle::new(index, *solid));
        context.obstacles = ObstacleIndex::new(checker.into_iter().chain(still).collect());
        context.opening = Some(index);
        (context, inside.iter().map(|obstacle| obstacle.solid.moved(&back)).collect())
    }

    /// The room with what moves where it is when it is open by a part.
    pub(crate) fn beside(&self, opening: &Articulation, part: f64) -> Self {
        let mut context = self.clone();
        let entity = self.opening.unwrap_or(usize::MAX);
        context.obstacles =
            self.obstacles.with(opening.moving(part).into_iter().map(|solid| Obstacle::new(entity, solid)));
        context
    }

    /// What the door or drawer itself runs into on its way: the first thing that it overlaps at one of 65 places.
    pub(crate) fn stops(&self, opening: &Articulation, [from, to]: [f64; 2]) -> Option<SmolStr> {
        const PLACES: u32 = 64;
        (0..=PLACES).find_map(|at| {
            let part = from + (to - from) * f64::from(at) / f64::from(PLACES);
            let moving: Vec<Solid> = opening.moving(part).iter().map(smaller).collect();
            let others = self.obstacles.iter().filter(|obstacle| Some(obstacle.entity) != self.opening);
            let met = others
                .into_iter()
                .find(|obstacle| moving.iter().any(|it| !it.is_farther(&obstacle.solid, 0.0)));
            met.map(|obstacle| self.name(obstacle.entity))
        })
    }
}

impl HandlePull<'_> {
    /// How the hand has moved in the map since it took the handle, after `done` of its way.
    pub(crate) fn moved(
        &self,
        hold: &GraspCandidate,
        done: f64,
        HandSlide(share): HandSlide,
    ) -> Isometry3<f64> {
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
fn carried(configuration: &Configuration, moved: &Isometry3<f64>) -> Configuration {
    let [x, y, yaw] = configuration.base;
    let place = moved * nalgebra::Point3::new(x, y, 0.0);
    let ahead = moved.rotation * Vector3::x();
    configuration.at([place.x, place.y, yaw + libm::atan2(ahead.y, ahead.x)])
}

fn smaller(solid: &Solid) -> Solid {
    resized(solid, |half| (half - PLAY).max(half * 0.1))
}
