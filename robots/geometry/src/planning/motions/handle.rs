//! Handle of a container: the grasps of it, the configurations of a hand that follows it, and their collision
//! check against the moving drawer or door.

use nalgebra::{Isometry3, Point3, Translation3, Unit, UnitQuaternion, Vector3};
use smol_str::SmolStr;

use crate::collision::{Shape, Solid};
use crate::inverse::{Tolerance, numeric};
use crate::planning::certify::resized;
use crate::planning::checking::MotionBound;
use crate::planning::context::QueryContext;
use crate::planning::grasp::{GraspCandidate, GraspManifold};
use crate::planning::query::{ContactTally, GraspSide};
use crate::planning::scene::{
    AllowedCollisions, Articulation, Configuration, Contact, FingerContact, HandModel, IkSolver,
    MIN_CLEARANCE, Obstacle, ObstacleIndex, Padding, RobotModel, THICK, plane,
};
use crate::trigonometry::turn;

/// Overlap of the finger tips with the bar beyond its middle, in m.
pub(crate) const BEYOND: f64 = 0.01;
/// Approach angles about the handle from the normal of its face, in rad.
const TILTS: [f64; 5] = [0.0, 0.52, -0.52, 1.05, -1.05];
/// Places along a handle, as shares of half of its length.
const PLACES: [f64; 3] = [0.0, 0.6, -0.6];

/// Handle to be grasped, and the travel that it follows.
pub(crate) struct HandlePull<'a> {
    pub(crate) id: &'a str,
    /// Index of the container.
    pub(crate) index: usize,
    pub(crate) hand: &'a HandModel,
    pub(crate) opening: Articulation,
    /// Start and end of the travel, 0 closed and 1 open.
    pub(crate) parts: [f64; 2],
    /// Distance of the bar's middle before the tip, in m.
    pub(crate) depth: f64,
    /// Distances that base and arm keep from the moving parts.
    pub(crate) padding: Padding,
}

/// Part of the robot that follows the handle.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum FollowMode {
    /// Base, with the arm still.
    Base(HandSlide),
    /// Arm, with the base still.
    Arm(HandSlide),
}

/// Share of the door's turn that the hand slides about the bar: 0 turns with the door, 1 keeps its direction.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct HandSlide(pub(crate) f64);

impl HandlePull<'_> {
    /// Modes in which the robot may follow, the most promising first.
    pub(crate) fn followings(&self, model: &RobotModel) -> Vec<FollowMode> {
        use motet_robots::card::Drive;
        let mut all = Vec::new();
        let turns_level = self.opening.hinge().is_none_or(|(axis, _)| axis.z.abs() > 1.0 - 1e-9);
        if turns_level && matches!(model.card().base.drive, Drive::Omnidirectional | Drive::Legged) {
            let turnings: &[f64] = if self.opening.hinge().is_some() { &[1.0, 0.5, 0.0] } else { &[0.0] };
            all.extend(turnings.iter().map(|share| FollowMode::Base(HandSlide(*share))));
        }
        if !matches!(self.hand.solver, IkSolver::Lift(_)) {
            let turnings: &[f64] = if self.opening.hinge().is_some() { &[0.5, 0.0, 1.0] } else { &[0.0] };
            all.extend(turnings.iter().map(|share| FollowMode::Arm(HandSlide(*share))));
        }
        all
    }

    /// Pose of the handle's middle at `part` of the travel.
    pub(crate) fn map_from_handle(&self, part: f64) -> Isometry3<f64> {
        let handle = self.opening.handle();
        let rotation = UnitQuaternion::face_towards(&handle.along, &handle.out);
        self.opening.map_moved(part)
            * Isometry3::from_parts(Translation3::from(handle.centre.coords), rotation)
    }

    /// Grasp candidates of the handle in a fixed order.
    pub(crate) fn holds(&self) -> Vec<GraspCandidate> {
        let handle = self.opening.handle();
        let moved = self.opening.map_moved(self.parts[0]);
        let axis = Unit::new_normalize(handle.along);
        let mut all = Vec::new();
        for tilt in TILTS {
            let approach = turn(&axis, tilt) * -handle.out;
            let closes = handle.along.cross(&approach);
            for place in PLACES {
                for closes in [closes, -closes] {
                    let bar = handle.centre + handle.along * (place * handle.half);
                    let rotation = self.hand.turned(&approach, &closes);
                    let at = bar.coords - approach * self.depth - closes * self.hand.middle(THICK);
                    let pose = Isometry3::from_parts(Translation3::from(at), rotation);
                    let approach = moved.rotation * approach;
                    let side = if approach.z < -0.819 { GraspSide::Top } else { GraspSide::Side };
                    // A hand never comes from below.
                    if approach.z <= 0.5 {
                        all.push(GraspCandidate {
                            map_from_tip: moved * pose,
                            approach,
                            side,
                            width: THICK,
                            depth: self.depth,
                            contact: FingerContact::Round,
                            push: Vector3::zeros(),
                        });
                    }
                }
            }
        }
        all
    }

    /// Manifold of all grasps of the handle, for a certificate.
    pub(crate) fn manifold(&self) -> GraspManifold<'_> {
        let handle = self.opening.handle();
        let moved = self.opening.map_moved(self.parts[0]);
        let (along, out) = (moved.rotation * handle.along, moved.rotation * handle.out);
        let shape = Shape::Capsule { radius: THICK / 2.0, half: handle.half };
        let bar =
            Solid { centre: (moved * handle.centre).coords, axes: [out, along.cross(&out), along], shape };
        let most = |all: &[f64]| all.iter().copied().fold(0.0, f64::max);
        GraspManifold::of_bar(self.hand, &bar, out, self.depth, [most(&TILTS), most(&PLACES)])
    }

    /// Point of the bar between the fingers, at the start.
    pub(crate) fn bar(&self, hold: &GraspCandidate) -> Point3<f64> {
        let closes = hold.map_from_tip.rotation * Vector3::from(self.hand.card.closes);
        let from_tip = hold.approach * self.depth + closes * self.hand.middle(THICK);
        Point3::from(hold.map_from_tip.translation.vector + from_tip)
    }
}

impl HandlePull<'_> {
    /// Motion of the hand in the map after `done` of its path.
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

/// Configuration with the fingers around the handle.
pub(crate) fn gripping(
    context: &QueryContext<'_>,
    hand: &HandModel,
    configuration: &Configuration,
) -> Configuration {
    Configuration {
        base: configuration.base,
        joints: hand.around(&configuration.joints, context.model.rest(), THICK),
    }
}

/// Reach of the hand in front of its tip with the fingers closed around an object of a width, in m.
pub(crate) fn front_around(context: &QueryContext<'_>, hand: &HandModel, width: f64) -> f64 {
    let rest = context.model.rest();
    let poses = context.model.tree().root_from_links(&hand.around(rest, rest, width));
    let tip_from_root = poses.get(hand.tip).copied().unwrap_or_default().inverse();
    let points = Vector3::from(hand.card.points);
    let parts = context.model.body().parts().iter().filter(|it| hand.members.get(it.link) == Some(&true));
    let ends = parts.filter_map(|part| {
        let solid = part.solid.moved(&(tip_from_root * poses.get(part.link)?));
        Some(solid.centre.dot(&points) + solid.extent(&points))
    });
    ends.fold(0.0, f64::max)
}

/// Greatest turn of a door between two way-points, in rad.
const TURN: f64 = 0.05;
/// Greatest motion of a handle between two way-points where the arm follows, in m.
const STEP: f64 = 0.03;
/// Greatest error of the hand between two way-points, in m and in rad.
const OFF: [f64; 2] = [0.002, 0.02];
/// Greatest number of halvings; a segment that needs more counts as blocked.
const DEPTH: u32 = 12;
/// Deflation of a drawer or door against its surroundings, which it may touch, in m.
const PLAY: f64 = 0.004;

/// Last configuration of a path that follows the handle.
pub(crate) fn follows_to(
    context: &QueryContext<'_>,
    pull: &HandlePull<'_>,
    hold: &GraspCandidate,
    configuration: &Configuration,
    following: FollowMode,
) -> Option<Configuration> {
    match following {
        FollowMode::Base(turning) => {
            Some(carried(&gripping(context, pull.hand, configuration), &pull.moved(hold, 1.0, turning)))
        }
        FollowMode::Arm(_) => {
            let start = gripping(context, pull.hand, configuration);
            configurations(context, pull, hold, &start, following)?.last().cloned()
        }
    }
}

/// Configurations of a path that follows the handle, where all of it is free.
pub(crate) fn follow(
    context: &QueryContext<'_>,
    pull: &HandlePull<'_>,
    hold: &GraspCandidate,
    configuration: &Configuration,
    following: FollowMode,
    met: &mut ContactTally,
) -> Option<Vec<Configuration>> {
    let configurations =
        configurations(context, pull, hold, &gripping(context, pull.hand, configuration), following)?;
    let (FollowMode::Base(turning) | FollowMode::Arm(turning)) = following;
    let count = configurations.len().saturating_sub(1).max(1) as f64;
    let [x, y] = plane(configuration);
    let far = configurations
        .iter()
        .map(|configuration| libm::hypot(configuration.base[0] - x, configuration.base[1] - y));
    let checker = context.around([x, y], far.fold(0.0, f64::max) + 0.01);
    for (pair, at) in configurations.windows(2).zip(0..) {
        let [one, other] = pair else { continue };
        let done = [f64::from(at) / count, f64::from(at + 1) / count];
        let middle = one.towards(other, 0.5);
        let wanted = pull.moved(hold, (done[0] + done[1]) / 2.0, turning) * hold.map_from_tip;
        let tip = context.model.map_from_links(&middle).get(pull.hand.tip).copied()?;
        let off = (tip.translation.vector - wanted.translation.vector).norm();
        if off > OFF[0] || tip.rotation.angle_to(&wanted.rotation) > OFF[1] {
            return None;
        }
        let free = checker
            .edge(one, other, AllowedCollisions::near(pull.index))
            .and_then(|()| edge_beside(context, one, other, pull, done));
        if let Err(contact) = free {
            met.add(&contact);
            return None;
        }
    }
    Some(configurations)
}

fn configurations(
    context: &QueryContext<'_>,
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
            let base_from_map = context.map_from_base(configuration.base).inverse();
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
                // A jump to another branch does not follow the handle.
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

/// Checks an edge against the moving solids, which go from `done[0]` to `done[1]` of the travel meanwhile.
fn edge_beside(
    context: &QueryContext<'_>,
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
    let drives = context.model.drives();
    let padding = pull.padding;
    let mut open = vec![(0.5, 0.5, 0)];
    while let Some((middle, half, depth)) = open.pop() {
        let configuration = from.towards(to, middle);
        let poses = context.model.map_from_links(&configuration);
        let placed = context.body.placed(&poses);
        let motion_bound = MotionBound { from, to, half };
        let moving = pull.opening.moving(part(middle));
        let span = (part(middle + half) - part(middle - half)).abs() / 2.0;
        let mut is_certain = true;
        for ((own, solid), part) in context.body.parts().iter().zip(&placed).zip(0..) {
            if !drives && pull.hand.carried.get(own.link) != Some(&true) {
                continue;
            }
            let ancestors = context.model.ancestor_joints(own.link);
            let goes = motion_bound.in_map(configuration.base, ancestors, &poses, solid, solid.reach());
            // The hand is at the handle by intent.
            let pad = match pull.hand.members.get(own.link) {
                Some(true) => MIN_CLEARANCE,
                Some(false) | None => padding.of(context.is_carried(part)),
            };
            for other in &moving {
                let margin = goes + pull.opening.goes(other, span);
                if solid.is_farther(other, pad + margin) {
                    continue;
                }
                if depth >= DEPTH || !solid.is_farther(other, pad) {
                    let link = context.model.tree().links().get(own.link).cloned().unwrap_or_default();
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

/// Context without a container's moving parts and its contents, and the contents in the closed pose.
pub(crate) fn without<'w>(
    context: &QueryContext<'w>,
    index: usize,
    opening: &Articulation,
    part: f64,
) -> (QueryContext<'w>, Vec<Solid>) {
    let carried = |entity: usize| {
        let entity = context.scene.entities.get_index(entity).map(|(_, entity)| entity);
        let pose = entity.filter(|entity| !entity.fixed).and_then(|entity| context.state.pose(entity));
        pose.is_some_and(|pose| opening.carries(&pose.translation.vector, part))
    };
    let back = opening.map_moved(part).inverse();
    let mut changed = context.clone();
    let (inside, around): (Vec<Obstacle>, Vec<Obstacle>) = context
        .obstacles
        .iter()
        .filter(|obstacle| obstacle.entity != index)
        .partition(|obstacle| carried(obstacle.entity));
    let padding = context.padding_of(index);
    let still = opening.still().iter().map(|solid| Obstacle::new(index, *solid, padding));
    changed.planning.obstacles = ObstacleIndex::new(around.into_iter().chain(still).collect());
    changed.planning.opening = Some(index);
    (changed, inside.iter().map(|obstacle| obstacle.solid.moved(&back)).collect())
}

/// Context without the handle of an open container.
pub(crate) fn without_bar<'w>(
    context: &QueryContext<'w>,
    index: usize,
    opening: &Articulation,
) -> QueryContext<'w> {
    let bar = opening.bar(1.0);
    let mut changed = context.clone();
    let is_bar = |obstacle: &&Obstacle| obstacle.entity == index && obstacle.solid == bar;
    changed.planning.obstacles =
        ObstacleIndex::new(context.obstacles.iter().filter(|obstacle| !is_bar(obstacle)).copied().collect());
    changed
}

/// Context with the moving parts at `part` of the travel.
pub(crate) fn beside<'w>(context: &QueryContext<'w>, opening: &Articulation, part: f64) -> QueryContext<'w> {
    let mut changed = context.clone();
    let entity = context.opening.unwrap_or(usize::MAX);
    let padding = context.padding_of(entity);
    let moving = opening.moving(part).into_iter().map(|solid| Obstacle::new(entity, solid, padding));
    changed.planning.obstacles = context.obstacles.with(moving);
    changed
}

/// First obstacle that the drawer or door itself overlaps at one of 65 places of its travel.
pub(crate) fn stops(
    context: &QueryContext<'_>,
    opening: &Articulation,
    [from, to]: [f64; 2],
) -> Option<SmolStr> {
    const PLACES: u32 = 64;
    (0..=PLACES).find_map(|at| {
        let part = from + (to - from) * f64::from(at) / f64::from(PLACES);
        let moving: Vec<Solid> = opening.moving(part).iter().map(smaller).collect();
        let others = context.obstacles.iter().filter(|obstacle| Some(obstacle.entity) != context.opening);
        let met =
            others.into_iter().find(|obstacle| moving.iter().any(|it| !it.is_farther(&obstacle.solid, 0.0)));
        met.map(|obstacle| context.name(obstacle.entity))
    })
}

/// Configuration with the base moved along with a level motion.
fn carried(configuration: &Configuration, moved: &Isometry3<f64>) -> Configuration {
    let [x, y, yaw] = configuration.base;
    let place = moved * nalgebra::Point3::new(x, y, 0.0);
    let ahead = moved.rotation * Vector3::x();
    configuration.at([place.x, place.y, yaw + libm::atan2(ahead.y, ahead.x)])
}

fn smaller(solid: &Solid) -> Solid {
    resized(solid, |half| (half - PLAY).max(half * 0.1))
}
