//! Hand on a moving handle: configurations that follow it, and their collision check against the moving
//! drawer or door.

use nalgebra::{Isometry3, Vector3};
use smol_str::SmolStr;

use crate::collision::Solid;
use crate::inverse::{Tolerance, numeric};
use crate::planning::certify::deflate::resized;
use crate::planning::checking::motion_bound::MotionBound;
use crate::planning::context::QueryContext;
use crate::planning::grasp::candidates::GraspCandidate;
use crate::planning::motions::handle::{FollowMode, HandlePull, gripping};
use crate::planning::query::contact_tally::ContactTally;
use crate::planning::scene::articulation::Articulation;
use crate::planning::scene::configuration::{Configuration, plane};
use crate::planning::scene::contact::{AllowedCollisions, Contact, MIN_CLEARANCE};
use crate::planning::scene::grid_index::{Obstacle, ObstacleIndex};

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
            .edge(one, other, AllowedCollisions::default())
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
    let mut open = vec![(0.5, 0.5, 0)];
    while let Some((middle, half, depth)) = open.pop() {
        let configuration = from.towards(to, middle);
        let poses = context.model.map_from_links(&configuration);
        let placed = context.body.placed(&poses);
        let motion_bound = MotionBound { from, to, half };
        let moving = pull.opening.moving(part(middle));
        let span = (part(middle + half) - part(middle - half)).abs() / 2.0;
        let mut is_certain = true;
        for (own, solid) in context.body.parts().iter().zip(&placed) {
            if !drives && pull.hand.carried.get(own.link) != Some(&true) {
                continue;
            }
            let ancestors = context.model.ancestor_joints(own.link);
            let goes = motion_bound.in_map(configuration.base, ancestors, &poses, solid, solid.reach());
            for other in &moving {
                let margin = goes + pull.opening.goes(other, span);
                if solid.is_farther(other, MIN_CLEARANCE + margin) {
                    continue;
                }
                if depth >= DEPTH || !solid.is_farther(other, MIN_CLEARANCE) {
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
    let still = opening.still().iter().map(|solid| Obstacle::new(index, *solid));
    changed.planning.obstacles = ObstacleIndex::new(around.into_iter().chain(still).collect());
    changed.planning.opening = Some(index);
    (changed, inside.iter().map(|obstacle| obstacle.solid.moved(&back)).collect())
}

/// Context with the moving parts at `part` of the travel.
pub(crate) fn beside<'w>(context: &QueryContext<'w>, opening: &Articulation, part: f64) -> QueryContext<'w> {
    let mut changed = context.clone();
    let entity = context.opening.unwrap_or(usize::MAX);
    changed.planning.obstacles =
        context.obstacles.with(opening.moving(part).into_iter().map(|solid| Obstacle::new(entity, solid)));
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
