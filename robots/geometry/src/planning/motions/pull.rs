//! `pull`, and `push` of a container: the hand grasps the handle and follows it along the container's travel.
//!
//! The robot follows in one of two modes. The base moves with the arm still: beside the handle, or turning
//! with the door, or half of each, while the hand turns about the bar. Or the base is still and the arm
//! follows. Each segment is certified with the door or drawer moving, by motion bounds on both.

use std::ops::ControlFlow;

use nalgebra::Isometry3;

use super::handle::{
    BEYOND, HandlePull, beside, follow, follows_to, front_around, gripping, stops, without, without_bar,
};
use crate::planning::certify::Certificate;
use crate::planning::context::QueryContext;
use crate::planning::grasp::GraspCandidate;
use crate::planning::query::{
    ContactTally, Grasp, Infeasible, InfeasibleReason, Margins, MotionAnswer, MotionWitness, SearchBudget,
    UnknownReason, certain, exhausted,
};
use crate::planning::scene::{AllowedCollisions, Articulation, Configuration, HandModel, THICK};
use crate::planning::search::LAST;

/// Approach distances before a handle, in m; the shorter where the longer is blocked.
const BACK: [f64; 2] = [0.1, 0.05];

/// Answers `pull`: opens a container, `parts` `[0, 1]`, or closes it, `[1, 0]`, by its handle.
pub(crate) fn pull(
    context: &QueryContext<'_>,
    id: &str,
    parts: [f64; 2],
    budget: SearchBudget,
) -> MotionAnswer {
    let unknown = |why: String| MotionAnswer::Unknown(UnknownReason::Because(why));
    let Some((index, entity)) = context.entity(id) else { return unknown(format!("there is no `{id}`")) };
    let Some(hand) = context.model.hand() else {
        return unknown("the card names no hand with a tip".into());
    };
    if let Some((held, _)) = &context.state.held {
        return unknown(format!("the hand holds `{held}`"));
    }
    if entity.travel.is_none() {
        return unknown(format!("`{id}` does not open"));
    }
    let [from, to] = parts;
    if context.state.is_open(entity) != (from > to) {
        let is = if from > to { "closed" } else { "open" };
        return unknown(format!("`{id}` is already {is}"));
    }
    let Some(opening) = Articulation::new(entity, context.state) else {
        return unknown(format!("the shape of `{id}` does not determine how it opens"));
    };
    // The hand is about to close around the bar.
    let context = &without_bar(context, index, &opening);
    let (clear, contents) = without(context, index, &opening, from);
    let opening = opening.with(contents);
    if let Some(by) = stops(&clear, &opening, parts) {
        let change = Some(format!("move `{by}` away"));
        return certain(InfeasibleReason::BlockedPath { by: Some(by) }, change);
    }
    let depth = (front_around(context, hand, THICK) - BEYOND).max(hand.palm + THICK / 2.0);
    let padding = context.padding_of(index);
    let pull = HandlePull { id, index, hand, opening, parts, depth, padding };
    let all = pull.holds();
    let tips: Vec<_> = all.iter().map(|hold| hold.map_from_tip).collect();
    let mut poses = ContactTally::default();
    let free = free_holds(context, (hand, index), &all, &tips, &mut poses);
    let answer = search_pull(context, &pull, &clear, &free, budget, poses);
    let MotionAnswer::Infeasible(found) = answer else { return answer };
    let bar = (pull.opening.map_moved(from) * pull.opening.handle().centre).coords;
    MotionAnswer::Infeasible(
        match context.reach_envelope(hand).beyond_all(&bar, &format!("the handle of `{id}`"), &tips) {
            Some((reason, change)) => Infeasible { reason, change, ..found },
            None => found,
        },
    )
}

/// Grasp candidates in which the hand alone is free.
fn free_holds<'h>(
    context: &QueryContext<'_>,
    (hand, index): (&HandModel, usize),
    all: &'h [GraspCandidate],
    tips: &[Isometry3<f64>],
    met: &mut ContactTally,
) -> Vec<&'h GraspCandidate> {
    let hand_checker = context.hand_checker(hand, tips, AllowedCollisions::near(index));
    let is_free = |hold: &&GraspCandidate| {
        hand_checker.contact(&hold.map_from_tip).map(|contact| met.add(&contact)).is_none()
    };
    all.iter().filter(is_free).collect()
}

fn search_pull(
    context: &QueryContext<'_>,
    pull: &HandlePull<'_>,
    clear: &QueryContext<'_>,
    holds: &[&GraspCandidate],
    budget: SearchBudget,
    mut poses: ContactTally,
) -> MotionAnswer {
    let end = beside(clear, &pull.opening, pull.parts[1]);
    let bar = pull.opening.map_moved(pull.parts[0]) * pull.opening.handle().centre;
    let wide = context.farthest(pull.hand) + pull.opening.handle().half + pull.depth + LAST;
    let checker = context.around([bar.x, bar.y], wide);
    let mut ways = ContactTally::default();
    let (mut tried, mut is_cut_off, mut is_free) = (0, false, false);
    let allowed = AllowedCollisions::near(pull.index);
    for at in 0..budget.candidates {
        for hold in holds {
            for configuration in context.candidates(pull.hand, &hold.map_from_tip, at) {
                if !context.is_near_drivable(configuration.base) {
                    is_cut_off = true;
                    continue;
                }
                if let Some(contact) = checker.contact(&configuration, allowed) {
                    poses.add(&contact);
                    continue;
                }
                is_free = true;
                let mut path = None;
                for following in pull.followings(context.model) {
                    let Some(last) = follows_to(clear, pull, hold, &configuration, following) else {
                        continue;
                    };
                    if let Some(contact) = end.contact(&last, allowed) {
                        ways.add(&contact);
                        continue;
                    }
                    tried += 1;
                    path = follow(clear, pull, hold, &configuration, following, &mut ways);
                    if path.is_some() {
                        break;
                    }
                }
                let found = path.and_then(|way| {
                    Some((way_to_handle(context, pull, hold, &configuration, &mut ways)?, way))
                });
                if let Some((way_in, way)) = found {
                    return MotionAnswer::Feasible(Box::new(pulled_along(
                        context, pull, clear, hold, way_in, way,
                    )));
                }
                if tried >= budget.paths {
                    return MotionAnswer::Unknown(UnknownReason::Budget);
                }
            }
        }
    }
    // A free configuration contradicts a proof.
    if !is_free {
        let manifold = pull.manifold();
        let covered =
            checker.covered(pull.hand, &manifold, allowed, budget.cells, |_, _| ControlFlow::Break(()));
        if covered == Certificate::Nowhere {
            return certain(poses.none_free(), None);
        }
    }
    exhausted(is_free || is_cut_off, &poses, &ways)
}

/// Path from the start to the handle, with the fingers closed around it at the end.
fn way_to_handle(
    context: &QueryContext<'_>,
    pull: &HandlePull<'_>,
    hold: &GraspCandidate,
    configuration: &Configuration,
    met: &mut ContactTally,
) -> Option<Vec<Configuration>> {
    BACK.into_iter().find_map(|back| {
        let mut line = context.approach(pull.hand, configuration, &hold.map_from_tip, back)?;
        line.push(gripping(context, pull.hand, configuration));
        let inwards = line.first()?.inwards(&hold.map_from_tip.translation.vector);
        context.route_along(&line, inwards, AllowedCollisions::near(pull.index), met)
    })
}

fn pulled_along(
    context: &QueryContext<'_>,
    pull: &HandlePull<'_>,
    clear: &QueryContext<'_>,
    hold: &GraspCandidate,
    way_in: Vec<Configuration>,
    way: Vec<Configuration>,
) -> MotionWitness {
    let allowed = AllowedCollisions::near(pull.index);
    let first = context.margins(&way_in, allowed);
    let second = clear.margins(&way, allowed);
    let count = way.len().saturating_sub(1).max(1) as f64;
    let [from, to] = pull.parts;
    // Clearance to the moving door at the way-points.
    let nearest = way.iter().zip(0..).map(|(configuration, at)| {
        let part = from + (to - from) * (f64::from(at) / count);
        beside(clear, &pull.opening, part).clearance(configuration, allowed)
    });
    let clearance = nearest.fold(first.clearance.min(second.clearance), f64::min);
    let turns = way_in.last().zip(way.first()).map_or(0.0, |(end, begin)| end.base[2] - begin.base[2]);
    let mut path = way_in;
    path.extend(way.iter().skip(1).map(|configuration| configuration.turned(turns)));
    let limit = [first.limit, second.limit].into_iter().flatten().reduce(f64::min);
    let grasp = Some(Grasp {
        object: pull.id.into(),
        side: hold.side,
        map_from_tip: hold.map_from_tip,
        tip_from_object: hold.map_from_tip.inverse() * pull.map_from_handle(pull.parts[0]),
        width: hold.width,
    });
    MotionWitness { path, grasp, margins: Margins { clearance, limit, ..first } }
}
