//! Explanation of an infeasible answer: the nearest change that makes the motion feasible. Each change is
//! tried in a changed scene or state before it is suggested.
//!
//! Runs where an answer is shown, not where it is computed: it takes as long as a few queries.

use motet_robots::scene::{Entity, Scene};
use motet_stdlib::lang::kinds;
use nalgebra::Translation3;
use smol_str::SmolStr;

use super::tight_spot::tight_spot;
use crate::planning::context::QueryContext;
use crate::planning::placing::{MapPose, Misfit, PlaceRules};
use crate::planning::query::{
    BearingLimit, Infeasible, InfeasibleReason, MotionAnswer, MotionQuery, ReachLength, SearchBudget,
};
use crate::planning::scene::plane;
use crate::planning::search::whole_centimetres;

/// Greatest number of obstacles tried for removal, one at a time.
const TAKEN: usize = 3;
/// Greatest distance of such an obstacle from the target, in m: between the outlines of most objects and
/// their middle.
const NEAR: f64 = 0.8;
/// Greatest budget of one trial: candidates and paths.
const EFFORT: [usize; 2] = [64, 16];
/// Greatest number of cells of one trial: a change that does not help needs no proof.
const CELLS: usize = 1024;
/// Lifts of an object that are tried, in m.
const LIFTS: [f64; 5] = [0.02, 0.05, 0.1, 0.2, 0.3];

/// Weights of entities that are no objects, and of those that never move, in removable objects.
const LARGE: u32 = 8;
const FIXED: u32 = 100;
/// Distance in m from the final place of the base to which a route may lead: the base comes straight in
/// from there.
const STRAIGHT: f64 = 0.55;

impl QueryContext<'_> {
    /// Completes an infeasible answer with the nearest change that would help, in words, where one is known.
    ///
    /// Each suggested change was tried: with it the motion is feasible. Where every route of the base is
    /// cut off, the reason names the obstacle. Takes as long as a few queries.
    ///
    /// ```
    /// use motet_geometry::planning::{
    ///     MotionAnswer, MotionQuery, QueryContext, RobotModel, SceneState, SearchBudget,
    /// };
    /// use motet_robots::builtin::{self, RobotWithBody};
    ///
    /// let RobotWithBody { robot, urdf } = builtin::robot("hsr").unwrap();
    /// let mut scene = builtin::scene("kitchen").unwrap();
    /// // The mug is far too high.
    /// scene.entities["mug_1"].pose.as_mut().unwrap().xyz[2] = 2.5;
    /// let model = RobotModel::new(&robot, &urdf);
    /// let state = SceneState::new(&model, &scene);
    /// let context = QueryContext::new(&model, &scene, &state);
    ///
    /// let (query, budget) = (MotionQuery::Reach("mug_1".into(), None), SearchBudget::default());
    /// let MotionAnswer::Infeasible(why) = context.answer(&query, budget) else { panic!() };
    /// let change = context.explain(&query, &why, budget).change.unwrap();
    /// assert!(change.starts_with("`mug_1` would have to be at least") && change.ends_with("m lower"));
    /// ```
    #[must_use]
    pub fn explain(&self, query: &MotionQuery, why: &Infeasible, budget: SearchBudget) -> Infeasible {
        let mut explained = why.clone();
        let mut least = budget;
        least.candidates = least.candidates.min(EFFORT[0]);
        least.paths = least.paths.min(EFFORT[1]);
        least.cells = least.cells.min(CELLS);
        explained.tight = tight_spot(self, query, &why.reason, budget).map(Box::new);
        if explained.change.is_some() {
            return explained;
        }
        explained.change = match &why.reason {
            InfeasibleReason::TooHeavy { .. } | InfeasibleReason::TooWide { .. } => None,
            InfeasibleReason::NoPlace(Misfit::Taken { by, .. }) => {
                cleared(self, query, by.as_ref(), least).or_else(|| unruled(self, query, least))
            }
            InfeasibleReason::Beside { .. } => in_the_middle(self, query, least),
            InfeasibleReason::NoPlace(_) => unruled(self, query, least),
            InfeasibleReason::OutOfReach { length: ReachLength::Sight, needs, reach } => {
                query.entities().next_back().map(|id| {
                    let nearer = whole_centimetres(needs - reach);
                    format!("the robot has to be at least {nearer:.2} m nearer to `{id}`")
                })
            }
            InfeasibleReason::OutOfReach { length: ReachLength::Distance, needs, reach } => {
                query.entities().next_back().map(|id| {
                    format!(
                        "`{id}` would have to be at least {:.2} m nearer",
                        whole_centimetres(needs - reach)
                    )
                })
            }
            InfeasibleReason::OutOfReach { length: ReachLength::Height, .. } => None,
            InfeasibleReason::NotInView { by: None, aside: Some(BearingLimit { needs, limit }) }
                if self.model.drives() =>
            {
                let to = if *needs > 0.0 { "left" } else { "right" };
                // Rounding must not add a degree.
                let least = libm::ceil((needs.abs() - limit).to_degrees() - 1e-6);
                Some(format!("turn to the {to} by at least {least:.0}° first"))
            }
            InfeasibleReason::NotInView { by: Some(by), .. } if self.state.holds(by) => {
                Some(format!("put `{by}` down first"))
            }
            InfeasibleReason::NoFreePose { by, .. }
            | InfeasibleReason::BlockedPath { by }
            | InfeasibleReason::NotInView { by, .. } => {
                let shut = shut_in(self, query);
                if shut.is_some() {
                    shut
                } else if let Some((by, change)) = cut_off(self, query, why, least) {
                    if let InfeasibleReason::BlockedPath { by: named } = &mut explained.reason {
                        *named = Some(by);
                    }
                    change
                } else {
                    (cleared(self, query, by.as_ref(), least))
                        .or_else(|| lifted(self, query, &why.reason, least))
                        .or_else(|| elsewhere(self, query, least))
                }
            }
        };
        explained
    }
}

/// Obstacle that cuts the base off from its goal, and its removal where that helps. `None` for an answer
/// without a free pose that no removal helps.
fn cut_off(
    context: &QueryContext<'_>,
    query: &MotionQuery,
    why: &Infeasible,
    budget: SearchBudget,
) -> Option<(SmolStr, Option<String>)> {
    let between = barrier(context, query, why, |id| may_go(context, query, id));
    let names: Vec<SmolStr> = between.into_iter().map(|at| context.name(at)).collect();
    let fixed = names.iter().find(|id| !may_go(context, query, id));
    let helps = || {
        let scene = without(context.scene, &names);
        let context = context.in_scene(&scene);
        matches!(context.answer(query, budget), MotionAnswer::Feasible(_))
    };
    let may_help = fixed.is_none() && !names.is_empty() && names.len() <= TAKEN;
    let change = (may_help && helps()).then(|| {
        let what = match query {
            MotionQuery::GoTo(to) => {
                let reach = context.scene.entities.get(to).map_or(0.0, |it| context.served_within(it));
                format!("a place within {reach:.2} m of `{to}`")
            }
            _ => match query.entities().next_back() {
                Some(id) => format!("a place from which `{id}` is in reach"),
                None => "such a place".to_owned(),
            },
        };
        let them = if names.len() == 1 { "it" } else { "them" };
        format!("every path to {what} is blocked by {}: move {them} away", listed(&names))
    });
    let is_way = matches!(why.reason, InfeasibleReason::BlockedPath { .. });
    let by = fixed.or(names.first()).filter(|_| is_way || change.is_some())?;
    Some((by.clone(), change))
}

/// Suggests to open the closed container that holds the target.
fn shut_in(context: &QueryContext<'_>, query: &MotionQuery) -> Option<String> {
    let around = |id: &SmolStr| context.scene.entities.get(context.scene.entities.get(id)?.inside.as_ref()?);
    let is_shut = |it: &&Entity| it.travel.is_some() && !context.state.is_open(it);
    let shut = query.entities().find_map(|id| {
        // An object that was taken out is no longer inside.
        let is_there = !context.state.holds(id) && !context.state.moved.contains_key(id);
        std::iter::successors(around(id).filter(|_| is_there), |it| around(&it.id)).take(8).find(is_shut)
    })?;
    Some(format!("open `{}` first", shut.id))
}

/// Suggests to remove one obstacle, without which the motion is feasible.
fn cleared(
    context: &QueryContext<'_>,
    query: &MotionQuery,
    by: Option<&SmolStr>,
    budget: SearchBudget,
) -> Option<String> {
    let by = by.filter(|by| may_go(context, query, by));
    let about = query.entities().next_back().and_then(|id| context.scene.entities.get(id));
    let place = about.and_then(|entity| context.state.pose(entity)).map(|pose| pose.translation.vector);
    let far = |entity: &Entity| Some((context.state.pose(entity)?.translation.vector - place?).norm());
    let near =
        context.scene.entities.values().filter(|it| Some(&it.id) != by && may_go(context, query, &it.id));
    let near = near.filter_map(|it| far(it).filter(|far| *far < NEAR).map(|far| (far, &it.id)));
    let mut near: Vec<(f64, &SmolStr)> = near.collect();
    near.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    let tried = by.into_iter().chain(near.into_iter().map(|(_, id)| id)).take(TAKEN);
    let helps = |id: &&SmolStr| {
        let scene = without(context.scene, std::slice::from_ref(*id));
        let context = context.in_scene(&scene);
        matches!(context.answer(query, budget), MotionAnswer::Feasible(_))
    };
    let id = { tried }.find(helps)?;
    Some(match query {
        MotionQuery::GoTo(to) => {
            let reach = context.served_within(context.scene.entities.get(to)?);
            format!("a place within {reach:.2} m of `{to}` is blocked by `{id}`: move it away")
        }
        _ => format!("`{id}` is in the way: move it away"),
    })
}

/// Suggests to put the object anywhere on its support where the rules exclude every place.
fn unruled(context: &QueryContext<'_>, query: &MotionQuery, budget: SearchBudget) -> Option<String> {
    let MotionQuery::Put(object, on, _) = query else { return None };
    let query = MotionQuery::Put(object.clone(), on.clone(), PlaceRules::default());
    let helps = matches!(context.answer(&query, budget), MotionAnswer::Feasible(_));
    helps.then(|| format!("it is feasible elsewhere on `{on}`"))
}

/// Suggests to grasp an object at its middle where the point is beside it.
fn in_the_middle(context: &QueryContext<'_>, query: &MotionQuery, budget: SearchBudget) -> Option<String> {
    let MotionQuery::ReachAt(id, _) = query else { return None };
    let pose = context.scene.entities.get(id).and_then(|entity| context.state.pose(entity))?;
    let middle = MapPose::new(pose.translation.vector.into(), 0.0);
    let query = MotionQuery::ReachAt(id.clone(), Some(middle));
    let helps = matches!(context.answer(&query, budget), MotionAnswer::Feasible(_));
    helps.then(|| format!("it is feasible at the middle of `{id}`, {middle}"))
}

/// Suggests how much higher an object would have to be where no grasp pose is free.
fn lifted(
    context: &QueryContext<'_>,
    query: &MotionQuery,
    reason: &InfeasibleReason,
    budget: SearchBudget,
) -> Option<String> {
    let (MotionQuery::Reach(id, _), InfeasibleReason::NoFreePose { .. }) = (query, reason) else {
        return None;
    };
    let pose = context.scene.entities.get(id).and_then(|entity| context.state.pose(entity))?;
    let helps = |up: &f64| {
        let mut state = context.state.clone();
        state.moved.insert(id.clone(), Translation3::new(0.0, 0.0, *up) * pose);
        matches!(context.in_state(&state).answer(query, budget), MotionAnswer::Feasible(_))
    };
    let up = LIFTS.into_iter().find(helps)?;
    Some(format!("it is feasible with `{id}` {up:.2} m higher"))
}

/// Checks whether an entity can be removed without the target.
fn may_go(context: &QueryContext<'_>, query: &MotionQuery, id: &str) -> bool {
    // Never propose removing a person as an obstacle.
    let is_thing = |it: &Entity| !it.fixed && it.shape.is_some() && it.kind != kinds::PERSON;
    let is_free = context.scene.entities.get(id).is_some_and(is_thing);
    let is_asked = query.entities().any(|about| goes_with(context.scene, about, id));
    is_free && !is_asked && !context.state.holds(id)
}

/// Suggests a posture of the arm, or a place of the base, from which the motion is feasible.
fn elsewhere(context: &QueryContext<'_>, query: &MotionQuery, budget: SearchBudget) -> Option<String> {
    let (MotionQuery::Look(to) | MotionQuery::Offer(_, to)) = query else { return None };
    let helps = |first: &MotionQuery| {
        let MotionAnswer::Feasible(way) = context.answer(first, budget) else { return false };
        let state = context.after_move(&way);
        let is_elsewhere = state.robot != context.state.robot;
        is_elsewhere && matches!(context.in_state(&state).answer(query, budget), MotionAnswer::Feasible(_))
    };
    let mut postures = context.model.card().postures.keys();
    if let Some(name) = postures.find(|name| helps(&MotionQuery::Posture((*name).clone()))) {
        return Some(format!("move the arm to the posture `{name}` first"));
    }
    (context.model.drives() && helps(&MotionQuery::GoTo(to.clone()))).then(|| format!("go to `{to}` first"))
}

/// Entities on every route of the base to its goal, in order from the start: as few as were found, entities
/// that `may_go` permits to remove first. Empty where a route passes them all, or none is known. O(cells of
/// the map × obstacles near).
pub(crate) fn barrier(
    context: &QueryContext<'_>,
    query: &MotionQuery,
    why: &Infeasible,
    may_go: impl Fn(&str) -> bool,
) -> Vec<usize> {
    let asks = matches!(
        query,
        MotionQuery::GoTo(_)
            | MotionQuery::Reach(..)
            | MotionQuery::ReachAt(..)
            | MotionQuery::Put(..)
            | MotionQuery::Pull(_)
            | MotionQuery::Push(_)
    );
    let Some(map) = context.map().filter(|_| asks) else { return vec![] };
    let target = query.entities().next_back().and_then(|id| context.entity(id));
    let Some((index, entity)) = target else { return vec![] };
    let Some(pose) = context.state.pose(entity) else { return vec![] };
    let start = plane(&context.state.robot);
    let from: Vec<[f64; 2]> =
        std::iter::once(start).chain(context.escapes(map).iter().map(|(_, place)| *place)).collect();
    // Neither the target nor the held object is an obstacle.
    let weight = |at: usize| {
        let (id, entity) = context.scene.entities.get_index(at).filter(|_| at != index)?;
        Some(match (may_go(id), entity.kind.as_str()) {
            (true, kinds::OBJECT) => 1,
            (true, _) => LARGE,
            (false, _) => FIXED,
        })
    };
    let reach = match (query, context.model.hand()) {
        (MotionQuery::GoTo(_), _) => context.served_within(entity),
        (_, Some(hand)) => context.farthest(hand),
        (_, None) => return vec![],
    };
    let centre = pose.translation.vector;
    let far = context.far_from(index, entity, [centre.x, centre.y]);
    let found = map.through(&from, weight, |[x, y]| far(x, y) <= reach).unwrap_or_default();
    // A place near the goal but behind a wall is useless.
    match &why.configuration {
        Some(configuration) if found.is_empty() && !context.is_near_drivable(configuration.base) => {
            let [to_x, to_y] = plane(configuration);
            let is_near = |[x, y]: [f64; 2]| libm::hypot(x - to_x, y - to_y) <= STRAIGHT;
            map.through(&from, weight, is_near).unwrap_or_default()
        }
        Some(_) | None => found,
    }
}

/// List of names in backticks.
fn listed(names: &[SmolStr]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.split_last() {
        Some((last, before)) if !before.is_empty() => format!("{} and {last}", before.join(", ")),
        Some(_) | None => quoted.concat(),
    }
}

/// Scene without some entities and everything that they support or contain.
fn without(scene: &Scene, ids: &[SmolStr]) -> Scene {
    let mut scene = scene.clone();
    let is_gone = |it: &SmolStr| ids.iter().any(|id| goes_with(&scene, it, id));
    let gone: Vec<SmolStr> = scene.entities.keys().filter(|it| is_gone(it)).cloned().collect();
    scene.entities.retain(|it, _| !gone.contains(it));
    scene
}

/// Checks whether an entity is another one, or is supported or contained by it, directly or not.
fn goes_with(scene: &Scene, one: &str, other: &str) -> bool {
    let below = |id: &str| {
        let entity = scene.entities.get(id)?;
        entity.on.as_deref().or(entity.inside.as_deref())
    };
    std::iter::successors(Some(one), |id| below(id)).take(16).any(|id| id == other)
}
