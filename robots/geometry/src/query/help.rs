//! What would help where a motion is infeasible: asked of the same world with one thing changed, so that what is told is known to do.
//!
//! This is looked for where an answer is told, not where it is given: it takes as long as a few queries.

use motet_robots::scene::{Entity, Scene};
use smol_str::SmolStr;

use super::answer::{Answer, Aside, Budget, Infeasible, Query, Reason};
use super::room::Room;
use super::span::whole_centimetres;

/// Things that are taken away, one at a time, to see whether that helps.
const TAKEN: usize = 3;
/// How near to what is asked for a thing has to be to be taken away, in m: between the outlines of most things and their middle.
const NEAR: f64 = 0.8;
/// The most that is looked at for one change.
const EFFORT: [usize; 2] = [64, 16];

impl Room<'_> {
    /// The nearest change that would help a motion that is infeasible, in words; `None` where none is known. What is said of a thing
    /// that is in the way, or of another place to stand, was tried: with it the motion is feasible.
    #[must_use]
    pub fn help(&self, query: &Query, why: &Infeasible, budget: Budget) -> Option<String> {
        if why.change.is_some() {
            return why.change.clone();
        }
        let mut least = budget;
        least.candidates = least.candidates.min(EFFORT[0]);
        least.paths = least.paths.min(EFFORT[1]);
        match &why.reason {
            Reason::TooHeavy { .. } | Reason::TooWide { .. } => None,
            Reason::OutOfReach { what: "sight", needs, reach } => {
                let id = targets(query).next_back()?;
                Some(format!(
                    "the robot has to be at least {:.2} m nearer to `{id}`",
                    whole_centimetres(needs - reach)
                ))
            }
            Reason::OutOfReach { what: "distance", needs, reach } => {
                let id = targets(query).next_back()?;
                Some(format!(
                    "`{id}` would have to be at least {:.2} m nearer",
                    whole_centimetres(needs - reach)
                ))
            }
            Reason::OutOfReach { .. } => None,
            Reason::NotInView { by: None, aside: Some(Aside { needs, limit }) } if self.machine.drives() => {
                let to = if *needs > 0.0 { "left" } else { "right" };
                // Rounding makes no degree more of it.
                let least = libm::ceil((needs.abs() - limit).to_degrees() - 1e-6);
                Some(format!("turn to the {to} by at least {least:.0}° before"))
            }
            Reason::NoFreePose { by } | Reason::BlockedPath { by } | Reason::NotInView { by, .. } => (self
                .shut_in(query))
            .or_else(|| self.cleared(query, by.as_ref(), least))
            .or_else(|| self.elsewhere(query, least)),
        }
    }

    /// What the motion is about lies in something that is closed.
    fn shut_in(&self, query: &Query) -> Option<String> {
        let around = |id: &SmolStr| self.scene.entities.get(self.scene.entities.get(id)?.inside.as_ref()?);
        let is_shut = |it: &&Entity| it.travel.is_some() && !self.world.is_open(it);
        let shut = targets(query).find_map(|id| {
            // What was taken out of it is no longer in it.
            let is_there = !self.world.holds(id) && !self.world.moved.contains_key(id);
            std::iter::successors(around(id).filter(|_| is_there), |it| around(&it.id)).take(8).find(is_shut)
        })?;
        Some(format!("open `{}` before", shut.id))
    }

    /// Something that can be taken away, without which the motion is feasible.
    fn cleared(&self, query: &Query, by: Option<&SmolStr>, budget: Budget) -> Option<String> {
        let by = by.filter(|by| self.may_go(query, by));
        let about = targets(query).next_back().and_then(|id| self.scene.entities.get(id));
        let place = about.and_then(|entity| self.world.pose(entity)).map(|pose| pose.translation.vector);
        let far = |entity: &Entity| Some((self.world.pose(entity)?.translation.vector - place?).norm());
        let near = self.scene.entities.values().filter(|it| Some(&it.id) != by && self.may_go(query, &it.id));
        let near = near.filter_map(|it| far(it).filter(|far| *far < NEAR).map(|far| (far, &it.id)));
        let mut near: Vec<(f64, &SmolStr)> = near.collect();
        near.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        let tried = by.into_iter().chain(near.into_iter().map(|(_, id)| id)).take(TAKEN);
        let helps = |id: &&SmolStr| {
            let scene = without(self.scene, id);
            let room = Room::new(self.machine, &scene, self.world);
            matches!(room.answer(query, budget), Answer::Feasible(_))
        };
        let id = { tried }.find(helps)?;
        Some(match query {
            Query::GoTo(to) => {
                let reach = self.served_within(self.scene.entities.get(to)?);
                format!("a place within {reach:.2} m of `{to}` is blocked by `{id}`: take it out of the way")
            }
            _ => format!("without `{id}` it can be done: take it out of the way"),
        })
    }

    /// Whether something else can be taken away, and what the motion is about stays.
    fn may_go(&self, query: &Query, id: &str) -> bool {
        let is_free = self.scene.entities.get(id).is_some_and(|it| !it.fixed && it.shape.is_some());
        let is_asked = targets(query).any(|about| goes_with(self.scene, about, id));
        is_free && !is_asked && !self.world.holds(id)
    }

    /// That the motion, which leaves the base where it is, is feasible with the arm in a posture, or from where what it is about is
    /// served.
    fn elsewhere(&self, query: &Query, budget: Budget) -> Option<String> {
        let (Query::Look(to) | Query::Offer(_, to)) = query else { return None };
        let helps = |first: &Query| {
            let Answer::Feasible(way) = self.answer(first, budget) else { return false };
            let world = self.gone_along(&way);
            let is_elsewhere = world.robot != self.world.robot;
            is_elsewhere && matches!(self.in_world(&world).answer(query, budget), Answer::Feasible(_))
        };
        let mut postures = self.machine.card().postures.keys();
        if let Some(name) = postures.find(|name| helps(&Query::Posture((*name).clone()))) {
            return Some(format!("bring the arm into the posture `{name}` before"));
        }
        (self.machine.drives() && helps(&Query::GoTo(to.clone()))).then(|| format!("go to `{to}` before"))
    }
}

/// What a motion is about, what it is about most at last.
fn targets(query: &Query) -> impl DoubleEndedIterator<Item = &SmolStr> {
    let (first, second) = match query {
        Query::Put(object, other) | Query::Offer(object, other) => (Some(object), Some(other)),
        Query::GoTo(id) | Query::Reach(id, _) | Query::Look(id) | Query::Pull(id) | Query::Push(id) => {
            (Some(id), None)
        }
        Query::Posture(_) | Query::Other(_) => (None, None),
    };
    first.into_iter().chain(second)
}

/// The scene without a thing and what stands on it or is in it.
fn without(scene: &Scene, id: &str) -> Scene {
    let mut scene = scene.clone();
    let gone: Vec<SmolStr> = scene.entities.keys().filter(|it| goes_with(&scene, it, id)).cloned().collect();
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
