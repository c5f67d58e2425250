//! What would help where a motion is infeasible: asked of the same world with one thing changed, so that what is told is known to do.
//!
//! This is looked for where an answer is told, not where it is given: it takes as long as a few queries.

use motet_robots::scene::{Entity, Scene};
use nalgebra::Translation3;
use smol_str::SmolStr;

use crate::planning::query::answer::{
    BearingLimit, Infeasible, InfeasibleReason, MotionAnswer, MotionQuery, SearchBudget,
};
use crate::planning::search::context::QueryContext;
use crate::planning::search::workspace::whole_centimetres;

/// Things that are taken away, one at a time, to see whether that helps.
const TAKEN: usize = 3;
/// How near to what is asked for a thing has to be to be taken away, in m: between the outlines of most things and their middle.
const NEAR: f64 = 0.8;
/// The most that is looked at for one change.
const EFFORT: [usize; 2] = [64, 16];
/// That a change would not help needs no proof: so many cells.
const CELLS: usize = 1024;
/// By how much higher a thing is tried, in m.
const LIFTS: [f64; 5] = [0.02, 0.05, 0.1, 0.2, 0.3];

impl QueryContext<'_> {
    /// An answer as it is told: with the nearest change that would help, in words, where one is known. What is said of a thing that is in
    /// the way, of a thing that lies too low, or of another place to stand, was tried: with it the motion is feasible. Where every way of the base is cut off, the
    /// reason names what does that.
    #[must_use]
    pub fn explain(&self, query: &MotionQuery, why: &Infeasible, budget: SearchBudget) -> Infeasible {
        let mut told = why.clone();
        if told.change.is_some() {
            return told;
        }
        let mut least = budget;
        least.candidates = least.candidates.min(EFFORT[0]);
        least.paths = least.paths.min(EFFORT[1]);
        least.cells = least.cells.min(CELLS);
        told.change = match &why.reason {
            InfeasibleReason::TooHeavy { .. } | InfeasibleReason::TooWide { .. } => None,
            InfeasibleReason::OutOfReach { what: "sight", needs, reach } => {
                targets(query).next_back().map(|id| {
                    let nearer = whole_centimetres(needs - reach);
                    format!("the robot has to be at least {nearer:.2} m nearer to `{id}`")
                })
            }
            InfeasibleReason::OutOfReach { what: "distance", needs, reach } => {
                targets(query).next_back().map(|id| {
                    format!(
                        "`{id}` would have to be at least {:.2} m nearer",
                        whole_centimetres(needs - reach)
                    )
                })
            }
            InfeasibleReason::OutOfReach { .. } => None,
            InfeasibleReason::NotInView { by: None, aside: Some(BearingLimit { needs, limit }) }
                if self.model.drives() =>
            {
                let to = if *needs > 0.0 { "left" } else { "right" };
                // Rounding makes no degree more of it.
                let least = libm::ceil((needs.abs() - limit).to_degrees() - 1e-6);
                Some(format!("turn to the {to} by at least {least:.0}° before"))
            }
            InfeasibleReason::NoFreePose { by, .. }
            | InfeasibleReason::BlockedPath { by }
            | InfeasibleReason::NotInView { by, .. } => {
                let shut = self.shut_in(query);
                if shut.is_some() {
                    shut
                } else if let Some((by, change)) = self.cut_off(query, why, least) {
                    if let InfeasibleReason::BlockedPath { by: named } = &mut told.reason {
                        *named = Some(by);
                    }
                    change
                } else {
                    (self.cleared(query, by.as_ref(), least))
                        .or_else(|| self.lifted(query, &why.reason, least))
                        .or_else(|| self.elsewhere(query, least))
                }
            }
        };
        told
    }

    /// What cuts the base off from where it would have to stand, and that it would have to be taken away, where that helps. Nothing of
    /// an answer that found no free pose, where it would not help.
    fn cut_off(
        &self,
        query: &MotionQuery,
        why: &Infeasible,
        budget: SearchBudget,
    ) -> Option<(SmolStr, Option<String>)> {
        let between = self.barrier(query, why, |id| self.may_go(query, id));
        let names: Vec<SmolStr> = between.into_iter().map(|at| self.name(at)).collect();
        let fixed = names.iter().find(|id| !self.may_go(query, id));
        let helps = || {
            let scene = without(self.scene, &names);
            let context = QueryContext::new(self.model, &scene, self.state);
            matches!(context.answer(query, budget), MotionAnswer::Feasible(_))
        };
        let may_help = fixed.is_none() && !names.is_empty() && names.len() <= TAKEN;
        let change = (may_help && helps()).then(|| {
            let what = match query {
                MotionQuery::GoTo(to) => {
                    let reach = self.scene.entities.get(to).map_or(0.0, |it| self.served_within(it));
                    format!("a place within {reach:.2} m of `{to}`")
                }
                _ => match targets(query).next_back() {
                    Some(id) => format!("a place from which `{id}` is in reach"),
                    None => "such a place".to_owned(),
                },
            };
            let them = if names.len() == 1 { "it" } else { "them" };
            format!("every way to {what} is blocked by {}: take {them} out of the way", listed(&names))
        });
        let is_way = matches!(why.reason, InfeasibleReason::BlockedPath { .. });
        let by = fixed.or(names.first()).filter(|_| is_way || change.is_some())?;
        Some((by.clone(), change))
    }

    /// What the motion is about lies in something that is closed.
    fn shut_in(&self, query: &MotionQuery) -> Option<String> {
        let around = |id: &SmolStr| self.scene.entities.get(self.scene.entities.get(id)?.inside.as_ref()?);
        let is_shut = |it: &&Entity| it.travel.is_some() && !self.state.is_open(it);
        let shut = targets(query).find_map(|id| {
            // What was taken out of it is no longer in it.
            let is_there = !self.state.holds(id) && !self.state.moved.contains_key(id);
            std::iter::successors(around(id).filter(|_| is_there), |it| around(&it.id)).take(8).find(is_shut)
        })?;
        Some(format!("open `{}` before", shut.id))
    }

    /// Something that can be taken away, without which the motion is feasible.
    fn cleared(&self, query: &MotionQuery, by: Option<&SmolStr>, budget: SearchBudget) -> Option<String> {
        let by = by.filter(|by| self.may_go(query, by));
        let about = targets(query).next_back().and_then(|id| self.scene.entities.get(id));
        let place = about.and_then(|entity| self.state.pose(entity)).map(|pose| pose.translation.vector);
        let far = |entity: &Entity| Some((self.state.pose(entity)?.translation.vector - place?).norm());
        let near = self.scene.entities.values().filter(|it| Some(&it.id) != by && self.may_go(query, &it.id));
        let near = near.filter_map(|it| far(it).filter(|far| *far < NEAR).map(|far| (far, &it.id)));
        let mut near: Vec<(f64, &SmolStr)> = near.collect();
        near.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        let tried = by.into_iter().chain(near.into_iter().map(|(_, id)| id)).take(TAKEN);
        let helps = |id: &&SmolStr| {
            let scene = without(self.scene, std::slice::from_ref(*id));
            let context = QueryContext::new(self.model, &scene, self.state);
            matches!(context.answer(query, budget), MotionAnswer::Feasible(_))
        };
        let id = { tried }.find(helps)?;
        Some(match query {
            MotionQuery::GoTo(to) => {
                let reach = self.served_within(self.scene.entities.get(to)?);
                format!("a place within {reach:.2} m of `{to}` is blocked by `{id}`: take it out of the way")
            }
            _ => format!("without `{id}` it can be done: take it out of the way"),
        })
    }

    /// By how much higher a thing would have to be that lies where no pose of the hand is free.
    fn lifted(&self, query: &MotionQuery, reason: &InfeasibleReason, budget: SearchBudget) -> Option<String> {
        let (MotionQuery::Reach(id, _), InfeasibleReason::NoFreePose { .. }) = (query, reason) else {
            return None;
        };
        let pose = self.scene.entities.get(id).and_then(|entity| self.state.pose(entity))?;
        let helps = |up: &f64| {
            let mut state = self.state.clone();
            state.moved.insert(id.clone(), Translation3::new(0.0, 0.0, *up) * pose);
            matches!(self.in_state(&state).answer(query, budget), MotionAnswer::Feasible(_))
        };
        let up = LIFTS.into_iter().find(helps)?;
        Some(format!("with `{id}` {up:.2} m higher it can be done"))
    }

    /// Whether something else can be taken away, and what the motion is about stays.
    fn may_go(&self, query: &MotionQuery, id: &str) -> bool {
        // Nobody is taken away.
        let is_thing = |it: &Entity| !it.fixed && it.shape.is_some() && it.kind != "Person";
        let is_free = self.scene.entities.get(id).is_some_and(is_thing);
        let is_asked = targets(query).any(|about| goes_with(self.scene, about, id));
        is_free && !is_asked && !self.state.holds(id)
    }

    /// That the motion, which leaves the base where it is, is feasible with the arm in a posture, or from where what it is about is
    /// served.
    fn elsewhere(&self, query: &MotionQuery, budget: SearchBudget) -> Option<String> {
        let (MotionQuery::Look(to) | MotionQuery::Offer(_, to)) = query else { return None };
        let helps = |first: &MotionQuery| {
            let MotionAnswer::Feasible(way) = self.answer(first, budget) else { return false };
            let state = self.after_move(&way);
            let is_elsewhere = state.robot != self.state.robot;
            is_elsewhere && matches!(self.in_state(&state).answer(query, budget), MotionAnswer::Feasible(_))
        };
        let mut postures = self.model.card().postures.keys();
        if let Some(name) = postures.find(|name| helps(&MotionQuery::Posture((*name).clone()))) {
            return Some(format!("bring the arm into the posture `{name}` before"));
        }
        (self.model.drives() && helps(&MotionQuery::GoTo(to.clone()))).then(|| format!("go to `{to}` before"))
    }
}

/// What a motion is about, what it is about most at last.
pub(crate) fn targets(query: &MotionQuery) -> impl DoubleEndedIterator<Item = &SmolStr> {
    let (first, second) = match query {
        MotionQuery::Put(object, other) | MotionQuery::Offer(object, other) => (Some(object), Some(other)),
        MotionQuery::GoTo(id)
        | MotionQuery::Reach(id, _)
        | MotionQuery::Look(id)
        | MotionQuery::Pull(id)
        | MotionQuery::Push(id) => (Some(id), None),
        MotionQuery::Posture(_) | MotionQuery::Other(_) => (None, None),
    };
    first.into_iter().chain(second)
}

/// Names in backticks, as they are said.
fn listed(names: &[SmolStr]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.split_last() {
        Some((last, before)) if !before.is_empty() => format!("{} and {last}", before.join(", ")),
        Some(_) | None => quoted.concat(),
    }
}

/// The scene without some things and what stands on them or is in them.
fn without(scene: &Scene, ids: &[SmolStr]) -> Scene {
    let mut scene = scene.clone();
    let is_gone = |it: &SmolStr| ids.iter().any(|id| goes_with(&scene, it, id));
    let gone: Vec<SmolStr> = scene.entities.keys().filter(|it| is_gone(it)).cloned().collect();
    scene.entities.retain(|it, _| !gone.contains(it));
    scene
}

/// Whether one thing is another, or stands on it or is in it, directly or not.
fn goes_with(scene: &Scene, one: &str, other: &str) -> bool {
    let below = |id: &str| {
        let entity = scene.entities.get(id)?;
        entity.on.as_deref().or(entity.inside.as_deref())
    };
    std::iter::successors(Some(one), |id| below(id)).take(16).any(|id| id == other)
}
