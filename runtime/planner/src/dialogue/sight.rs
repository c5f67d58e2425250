//! Perception as knowledge: what the robot saw elsewhere than in the scene, and what the driver is still to
//! be told.

use indexmap::IndexMap;
use motet_graph::Value;
use motet_requests::ReportedLocation;
use motet_robots::scene::{Entity, Scene};
use motet_runtime::{Answer, Detection, Engine, Pattern, Query, ToldThing, Truth};
use motet_stdlib::lang::{PLACING, fluents, kinds};
use smol_str::SmolStr;

use super::Knowledge;
use crate::vision::lies_on_floor;

impl Knowledge {
    /// Next thing of which the driver was not told yet.
    pub fn take_untold(&mut self) -> Option<ToldThing> {
        self.untold.extend(self.seen.take_untold());
        (!self.untold.is_empty()).then(|| self.untold.remove(0))
    }

    /// Takes in what is in view now, before a plan.
    pub fn look(&mut self, scene: &Scene, seen: &[Detection]) {
        self.seen.look_away();
        self.see(scene, seen);
        // Without facts the scene says it.
        if !self.facts.is_empty() {
            let visible = |id: &SmolStr| (fact(fluents::VISIBLE, [id]), Truth::True);
            self.facts.extend(self.seen.in_view().map(visible));
        }
    }

    /// Takes in what was seen during a run. Returns the things that are news, where they are, and the facts
    /// that follow from it and that the engine does not believe.
    pub fn notice_seen(
        &mut self,
        scene: &Scene,
        seen: &[Detection],
        engine: &Engine,
    ) -> (Vec<Entity>, Vec<(Query, Answer)>) {
        let before = self.seen_scene(scene);
        let supports = self.supports();
        let news = self.see(scene, seen);
        let believes = |query: &Query| match query {
            Query::Fact { fluent, args } => engine.believes(fluent, args) == Truth::True,
            Query::Measure { .. } | Query::Field { .. } => false,
        };
        let mut facts = Vec::new();
        for entity in news.iter().filter(|entity| is_settled(entity)) {
            let told = support(&before, &supports, &entity.id);
            let now = relation(entity);
            let is_known =
                now.as_ref().is_some_and(|(fluent, place)| believes(&fact(fluent, [&entity.id, place])));
            if is_known || believes(&fact(fluents::HOLDING, [&entity.id])) {
                continue;
            }
            for place in told.iter().filter(|told| now.as_ref().is_none_or(|(_, place)| place != *told)) {
                let gone = PLACING.iter().map(|fluent| fact(fluent, [&entity.id, place]));
                facts.extend(gone.filter(believes).map(|query| (query, Answer::Truth(false))));
            }
            if let Some((fluent, place)) = &now {
                let there = [fluent, fluents::AT].map(|fluent| fact(fluent, [&entity.id, place]));
                facts.extend(there.map(|query| (query, Answer::Truth(true))));
            }
            facts.push((fact(fluents::LOCATED, [&entity.id]), Answer::Truth(true)));
        }
        (news, facts)
    }

    /// Takes in what was seen, in view still or not. Returns the things that are news, where they are.
    fn see(&mut self, scene: &Scene, seen: &[Detection]) -> Vec<Entity> {
        let before = self.seen_scene(scene);
        let held = self.holding(&before);
        let news = self.seen.note(&before, held.as_deref(), seen);
        for entity in news.iter().filter(|entity| is_settled(entity)) {
            let now = relation(entity);
            let told = support(&before, &self.supports(), &entity.id);
            if told.as_ref() == now.as_ref().map(|(_, place)| place)
                && before.entities.contains_key(&entity.id)
            {
                continue;
            }
            let thing = Pattern::Is(Value::Entity(entity.id.clone()));
            let nowhere = PLACING.iter().map(|fluent| {
                let args = vec![thing.clone(), Pattern::Any];
                (Query::Fact { fluent: (*fluent).into(), args }, Truth::False)
            });
            self.facts.extend(nowhere);
            if let Some((fluent, place)) = &now {
                let there = [fluent, fluents::AT].map(|fluent| fact(fluent, [&entity.id, place]));
                self.facts.extend(there.map(|query| (query, Truth::True)));
            }
            self.facts.push((fact(fluents::LOCATED, [&entity.id]), Truth::True));
        }
        for id in self.seen.in_view() {
            self.missed.retain(|one| one.thing != *id);
            if !self.seen_so_far.contains(id) {
                self.seen_so_far.push(id.clone());
            }
        }
        news
    }

    /// Takes in that a thing was looked for where it was believed to be, and not seen there.
    pub(super) fn miss(&mut self, scene: &Scene, thing: &SmolStr) {
        self.missed.extend(self.place_of(scene, thing));
    }

    /// Known place of a thing; none where it was looked for and not seen.
    pub(super) fn place_of(&self, scene: &Scene, thing: &SmolStr) -> Option<ReportedLocation> {
        self.places(scene).into_iter().find(|one| one.thing == *thing && !self.missed.contains(one))
    }

    /// Relation and place of a thing in view, as it was seen there.
    pub(super) fn seen_place(&self, scene: &Scene, id: &SmolStr) -> Option<(&'static str, SmolStr)> {
        self.seen.in_view().find(|seen| *seen == id)?;
        relation(self.seen.over(scene, |_, _| false).entities.get(id)?)
    }

    /// Forgets what is in view, since the robot moves.
    pub(super) fn look_away(&mut self) {
        self.seen.look_away();
    }

    /// The scene with everything where it was seen last, unless it was moved since.
    pub(super) fn seen_scene(&self, scene: &Scene) -> Scene {
        if self.seen.is_empty() {
            return scene.clone();
        }
        let (supports, held) = (self.supports(), self.holding(scene));
        self.seen.over(scene, |id, support| {
            let is_elsewhere = supports.get(id).is_some_and(|known| known.as_ref() != support);
            is_elsewhere || held.as_deref() == Some(id)
        })
    }
}

/// A fact about entities.
fn fact<const N: usize>(fluent: &str, of: [&SmolStr; N]) -> Query {
    let args = of.map(|id| Pattern::Is(Value::Entity(id.clone())));
    Query::Fact { fluent: fluent.into(), args: args.into() }
}

/// Relation of a thing to its support, with the support.
fn relation(entity: &Entity) -> Option<(&'static str, SmolStr)> {
    let inside = || Some((fluents::IN, entity.inside.clone()?));
    entity.on.clone().map(|on| (fluents::ON, on)).or_else(inside)
}

/// Support of a thing as the facts tell it, or else the scene.
fn support(scene: &Scene, told: &IndexMap<SmolStr, Option<SmolStr>>, id: &SmolStr) -> Option<SmolStr> {
    told.get(id).cloned().unwrap_or_else(|| {
        let known = scene.entities.get(id)?;
        known.on.clone().or_else(|| known.inside.clone())
    })
}

/// True if the place where a thing was seen says what it stands on: one without a support and above the floor
/// is carried by somebody.
fn is_settled(entity: &Entity) -> bool {
    let is_placed = entity.on.is_some() || entity.inside.is_some() || lies_on_floor(entity);
    entity.kind == kinds::OBJECT && is_placed
}
