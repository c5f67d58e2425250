//! Explanation of a motion that only the clearance excludes: the greatest clearance that leaves a motion, and
//! the place where that motion has no more room.

use motet_robots::clearance::Clearance;
use smol_str::SmolStr;

use crate::collision::Solid;
use crate::planning::context::QueryContext;
use crate::planning::query::{
    Gap, InfeasibleReason, MotionAnswer, MotionQuery, MotionWitness, SearchBudget, TightGroup, TightSpot,
};
use crate::planning::scene::{AllowedCollisions, Configuration, MIN_CLEARANCE};

/// Number of halvings of the interval in which the greatest clearance is.
const HALVINGS: u32 = 5;
/// Distance in m between two checked configurations of a path.
const STEP: f64 = 0.03;
/// Greatest distance to the second side of a gap, as a multiple of that to the first, and beyond it in m.
const OTHER_SIDE: [f64; 2] = [1.5, 0.02];

/// Greatest clearance that leaves a motion where the given one leaves none; `None` where the clearance does
/// not matter.
pub(crate) fn tight_spot(
    context: &QueryContext<'_>,
    query: &MotionQuery,
    reason: &InfeasibleReason,
    budget: SearchBudget,
) -> Option<TightSpot> {
    let full = context.clearance;
    let is_about_room =
        matches!(reason, InfeasibleReason::NoFreePose { .. } | InfeasibleReason::BlockedPath { .. });
    if !is_about_room || full.base_m.max(full.arm_m) <= MIN_CLEARANCE {
        return None;
    }
    let witness = |group: TightGroup, share: f64| {
        let part = |is_scaled: bool, metres: f64| if is_scaled { metres * share } else { metres };
        let clearance = Clearance {
            base_m: part(group != TightGroup::Arm, full.base_m),
            arm_m: part(group != TightGroup::Base, full.arm_m),
        };
        match context.keeping(clearance).answer(query, budget) {
            MotionAnswer::Feasible(witness) => Some(witness),
            MotionAnswer::Infeasible(_) | MotionAnswer::Unknown(_) => None,
        }
    };
    // Most motions that are infeasible are so without a clearance too.
    let mut best = witness(TightGroup::Both, 0.0)?;
    let alone = [TightGroup::Base, TightGroup::Arm].into_iter();
    let alone = alone.filter_map(|group| Some((group, witness(group, 0.0)?))).next();
    let group = alone.map_or(TightGroup::Both, |(group, found)| {
        best = found;
        group
    });
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        match witness(group, middle) {
            Some(found) => (best, low) = (found, middle),
            None => high = middle,
        }
    }
    let needs = if group == TightGroup::Base { full.base_m } else { full.arm_m };
    let spot = narrowest(context, query, group, &best);
    let (by, gap) = spot.map_or((None, None), |(by, gap)| (Some(by), gap));
    Some(TightSpot { group, needs, most: needs * low, by, gap })
}

/// Obstacle that a path passes at the least distance, and the gap there if the base drives through one.
fn narrowest(
    context: &QueryContext<'_>,
    query: &MotionQuery,
    group: TightGroup,
    witness: &MotionWitness,
) -> Option<(SmolStr, Option<Gap>)> {
    // While a door moves, its place is not that of the scene.
    if matches!(query, MotionQuery::Pull(_) | MotionQuery::Push(_)) {
        return None;
    }
    let target = |id: &SmolStr| context.entity(id).map(|(index, _)| index);
    let allowed = match query {
        MotionQuery::Reach(id, _) | MotionQuery::ReachAt(id, _) => {
            AllowedCollisions::of_grasp(context, target(id)?)
        }
        MotionQuery::Put(_, on, _) => AllowedCollisions { held: target(on), ..AllowedCollisions::default() },
        _ => AllowedCollisions::default(),
    };
    let checker = context.all_around(&witness.path, 1.0);
    let mut least: Option<(f64, usize, Configuration)> = None;
    for pair in witness.path.windows(2) {
        let [from, to] = pair else { continue };
        let [dx, dy, turn] = [0, 1, 2]
            .map(|at: usize| from.base.get(at).zip(to.base.get(at)).map_or(0.0, |(from, to)| to - from));
        let steps = libm::ceil((libm::hypot(dx, dy) + turn.abs()) / STEP).max(8.0) as u32;
        for step in 0..=steps {
            let configuration = from.towards(to, f64::from(step) / f64::from(steps));
            let found = checker.nearest(&configuration, allowed, |is_arm| match group {
                TightGroup::Base => !is_arm,
                TightGroup::Arm => is_arm,
                TightGroup::Both => true,
            });
            if let Some((metres, obstacle)) = found
                && least.as_ref().is_none_or(|(known, ..)| metres < *known)
            {
                least = Some((metres, obstacle, configuration));
            }
        }
    }
    let (metres, at, configuration) = least?;
    let by = context.obstacles.get(at)?;
    let gap = (group == TightGroup::Base).then(|| gap(context, at, metres, &configuration)).flatten();
    Some((context.name(by.entity), gap))
}

/// Gap in which the base stands between an obstacle, `metres` away, and one on its other side.
fn gap(context: &QueryContext<'_>, at: usize, metres: f64, configuration: &Configuration) -> Option<Gap> {
    let one = context.obstacles.get(at)?;
    let placed = context.robot_at(configuration);
    let own: Vec<&Solid> = placed
        .iter()
        .zip(0..)
        .filter(|(_, part)| !context.is_carried(*part))
        .map(|(solid, _)| solid)
        .collect();
    let near = |solid: &Solid| own.iter().map(|own| own.distance(solid)).fold(f64::INFINITY, f64::min);
    let side = OTHER_SIDE[0] * metres + OTHER_SIDE[1];
    let others = context.obstacles.iter().zip(0..).filter(|(_, other)| *other != at);
    let others = others.filter_map(|(other, _)| {
        let beyond = near(&other.solid);
        let width = one.solid.distance(&other.solid);
        // Across the base, not beside it.
        (beyond <= side && width > 2.0 * (metres + beyond)).then_some((beyond, width, other.entity))
    });
    let (beyond, width, other) = others.min_by(|(one, ..), (other, ..)| one.total_cmp(other))?;
    Some(Gap { other: context.name(other), width, base: width - metres - beyond })
}
