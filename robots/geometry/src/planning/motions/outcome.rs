//! Outcome of a motion: the scene state after it.
//!
//! A motion of the base ends where its path ends. A motion of the hand ends with the robot back at the
//! start, and only where a path back was certified: lifted off the support, or straight back, and then the
//! way it came.

use nalgebra::Vector3;

use crate::planning::context::QueryContext;
use crate::planning::query::answer::MotionWitness;
use crate::planning::query::contact_tally::ContactTally;
use crate::planning::scene::articulation::Articulation;
use crate::planning::scene::configuration::{Configuration, plane};
use crate::planning::scene::contact::AllowedCollisions;
use crate::planning::scene::robot_model::away;
use crate::planning::scene::scene_state::SceneState;
use crate::planning::search::path::LAST;

/// Lift off the support before the robot moves on, in m.
const LIFT: f64 = 0.05;
/// Distances of the straight way back, in m.
const BACK: [f64; 2] = [0.1, 0.05];

/// Openings that release a handle, in m; the first is the widest.
const OPENED: [f64; 3] = [f64::INFINITY, 0.06, 0.03];

/// State after the robot followed a path.
pub(crate) fn after_move(context: &QueryContext<'_>, witness: &MotionWitness) -> SceneState {
    let mut state = context.state.clone();
    if let Some(last) = witness.path.last() {
        state.robot = last.clone();
    }
    let [_, _, yaw] = &mut state.robot.base;
    *yaw = crate::trigonometry::wrapped(*yaw);
    state
}

/// State after a grasp, with the robot back at the start; `None` where no path back was found.
pub(crate) fn after_reach(context: &QueryContext<'_>, witness: &MotionWitness) -> Option<SceneState> {
    let grasp = witness.grasp.as_ref()?;
    let hand = context.model.hand()?;
    let end = witness.path.last()?;
    let mut state = context.state.clone();
    state.held = Some((grasp.object.clone(), grasp.tip_from_object));
    state.moved.remove(&grasp.object);
    let rest = context.model.rest();
    state.robot.joints = hand.around(&state.robot.joints, rest, grasp.width);
    let end = &Configuration { base: end.base, joints: hand.around(&end.joints, rest, grasp.width) };
    let (index, _) = context.entity(&grasp.object)?;
    let support = context.support(index);
    let after = context.in_state(&state);
    let held = AllowedCollisions { hand: None, held: support };
    let up = Vector3::new(0.0, 0.0, LIFT);
    let back = |far: f64| away(&grasp.map_from_tip, hand, far);
    let ways = [up, back(BACK[0]), back(BACK[1]), up + back(BACK[0])];
    let is_back = ways.into_iter().any(|shift| {
        let Some(line) = after.line(hand, end, &grasp.map_from_tip, &shift) else { return false };
        let inwards = line.first().map(|first| first.inwards(&grasp.map_from_tip.translation.vector));
        inwards.is_some_and(|inwards| {
            after.route_along(&line, inwards, held, &mut ContactTally::default()).is_some()
        })
    });
    is_back.then_some(state)
}

/// State after an object was put down, with the robot back at the start; `None` where no path back was
/// found.
pub(crate) fn after_put(context: &QueryContext<'_>, witness: &MotionWitness) -> Option<SceneState> {
    let grasp = witness.grasp.as_ref()?;
    let (hand, end) = (context.model.hand()?, witness.path.last()?);
    let mut state = context.state.clone();
    state.held = None;
    state.moved.insert(grasp.object.clone(), grasp.map_from_tip * grasp.tip_from_object);
    let (index, _) = context.entity(&grasp.object)?;
    let after = context.in_state(&state);
    let allowed = AllowedCollisions { hand: Some(index), held: None };
    // The fingers open before the hand draws back.
    let open = Configuration { base: end.base, joints: hand.opened(&end.joints) };
    after.edge(end, &open, allowed).ok()?;
    let is_back = BACK.into_iter().any(|far| {
        let shift = away(&grasp.map_from_tip, hand, far);
        let Some(line) = after.line(hand, &open, &grasp.map_from_tip, &shift) else { return false };
        let inwards = line.first().map(|first| first.inwards(&grasp.map_from_tip.translation.vector));
        inwards.is_some_and(|inwards| {
            after.route_along(&line, inwards, allowed, &mut ContactTally::default()).is_some()
        })
    });
    is_back.then_some(state)
}

/// State after a person took the held object, with the robot back at the start.
pub(crate) fn after_offer(context: &QueryContext<'_>, to: &str) -> Option<SceneState> {
    let mut state = context.state.clone();
    let (held, _) = state.held.take()?;
    let (_, person) = context.entity(to)?;
    // In a person's hands the object is in nobody's way.
    state.moved.insert(held, context.state.pose(person)?);
    Some(state)
}

/// Checks whether a path connects the start with a configuration in front of a place.
pub(crate) fn leads_back(
    context: &QueryContext<'_>,
    configuration: &Configuration,
    place: &Vector3<f64>,
) -> bool {
    let (inwards, none) = (configuration.inwards(place), AllowedCollisions::default());
    context
        .route_along(std::slice::from_ref(configuration), inwards, none, &mut ContactTally::default())
        .is_some()
}

/// State after a container was opened or closed, with the robot back at the start, or at the handle with
/// its arm folded; `None` where neither was found. The contents of a drawer move with it.
pub(crate) fn after_pull(context: &QueryContext<'_>, witness: &MotionWitness) -> Option<SceneState> {
    let none = AllowedCollisions::default();
    let grasp = witness.grasp.as_ref()?;
    let (hand, end) = (context.model.hand()?, witness.path.last()?);
    let (_, entity) = context.entity(&grasp.object)?;
    let opening = Articulation::new(entity, context.state)?;
    let was_open = context.state.is_open(entity);
    let (from, to) = if was_open { (1.0, 0.0) } else { (0.0, 1.0) };
    let mut state = context.state.clone();
    state.open.insert(grasp.object.clone(), !was_open);
    let moved = opening.map_moved(to) * opening.map_moved(from).inverse();
    for inside in context.scene.entities.values().filter(|entity| !entity.fixed) {
        if let Some(pose) = context.state.pose(inside)
            && opening.carries(&pose.translation.vector, from)
        {
            state.moved.insert(inside.id.clone(), moved * pose);
        }
    }
    let map_from_tip = context.model.map_from_links(end).get(hand.tip).copied()?;
    let mut there = None;
    let after = context.in_state(&state);
    let ways = OPENED.into_iter().flat_map(|width| BACK.map(|far| (width, far)));
    for (width, far) in ways {
        // At most as far as the door beside the hand permits.
        let fingers = |configuration: &Configuration| {
            hand.around(&configuration.joints, context.model.rest(), width.min(hand.card.opening_m))
        };
        let open = Configuration { base: end.base, joints: fingers(end) };
        if after.edge(end, &open, none).is_err() {
            continue;
        }
        let shift = away(&map_from_tip, hand, far);
        let Some(line) = after.line(hand, &open, &map_from_tip, &shift) else { continue };
        let line: Vec<Configuration> = line
            .iter()
            .map(|configuration| Configuration { base: configuration.base, joints: fingers(configuration) })
            .collect();
        let is_free = after.around(plane(&open), LAST).is_free(&line, none, &mut ContactTally::default());
        let Some(first) = line.first().filter(|_| is_free) else { continue };
        if leads_back(&after, first, &map_from_tip.translation.vector) {
            return Some(state);
        }
        let [x, y, yaw] = first.base;
        let base = [x, y, crate::trigonometry::wrapped(yaw)];
        let (first, folded) =
            (first.at(base), Configuration { base, joints: context.state.robot.joints.clone() });
        let is_folded = after.unfold(&first, &folded, &mut ContactTally::default()).is_some();
        there = there.or(is_folded.then_some(folded));
    }
    drop(after);
    state.robot = there?;
    Some(state)
}
