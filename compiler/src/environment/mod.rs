//! The environment: entities, and the facts at the start. Built once from a library, a scene and a state,
//! then shared by all policies that are checked against it.

pub(crate) mod base_pose_facts;
mod diagnostics;
mod initial_state;
mod scene_facts;

pub(crate) use base_pose_facts::BasePoseFacts;
pub use initial_state::{FactLifetime, InitialState};

use std::sync::Arc;

use motet_robots::scene::{Scene, is_anything, normal, singular};
use motet_stdlib::lang;
use motet_syntax::Diagnostic;
use rustc_hash::{FxHashMap, FxHashSet};
use smol_str::SmolStr;

use crate::declare::{Library, PerceptionLifetime};
use crate::facts::{ANY, Cause, FactKey, FactStore, TruthSet, arg};
use crate::ir::{Entities, Entity, Fact, Fluent, Kind, ROBOT, Term};

pub(crate) use diagnostics::CODES;

/// Entities and facts at the start.
#[derive(Clone, Debug)]
pub struct Environment {
    entities: Entities,
    /// The first scene that was given; its entities have the same names.
    scene: Option<Arc<Scene>>,
    /// Entities by description.
    descriptions: FxHashMap<String, Vec<Entity>>,
    /// Last two bytes of each description: a cheap test that rules out most texts.
    endings: FxHashSet<(u8, u8)>,
    pub(crate) facts: FactStore<'static>,
    /// Lifetimes of facts at the start, by their causes.
    pub(crate) lasting: Vec<PerceptionLifetime>,
    /// The facts at the start as they were given, in order, for the graph.
    pub(crate) given: Vec<(Fact, bool)>,
    /// Arguments of these facts, by fluent and place.
    given_of: FxHashSet<(Fluent, usize, u16)>,
    /// Facts that follow from the pose of the base, unless another word was given about them.
    pub(crate) base_pose_facts: BasePoseFacts,
}

impl Environment {
    /// Builds the environment of a library, a scene and a state, and returns it with diagnostics about scene
    /// and state.
    #[must_use]
    pub fn new(
        library: &Library,
        scene: Option<&Scene>,
        state: Option<&InitialState>,
    ) -> (Self, Vec<Diagnostic>) {
        let mut diagnostics = Vec::new();
        let mut entities = Entities::default();
        for (name, kind) in library.standard_entities() {
            entities.add(name.into(), kind);
        }
        for (name, kind, _) in &library.entities {
            entities.add(name.clone(), *kind);
        }
        if let Some(scene) = scene {
            scene_facts::entities(library, scene, &mut entities, &mut diagnostics);
        }
        let closed = TruthSet::no(Cause::NOTHING);
        let default = if library.closed_world { closed } else { TruthSet::NOTHING_KNOWN };
        let facts = FactStore::new(library.fluents.len(), default);
        let descriptions = scene_facts::descriptions(scene, &entities);
        let endings = descriptions.keys().flat_map(|key| match key.as_bytes() {
            [.., first, last] => [(*first, *last), (*first, *last)],
            // An article may stand before it.
            [only] => [(0, *only), (b' ', *only)],
            [] => [(0, 0), (0, 0)],
        });
        let endings = endings.collect();
        let scene = scene.cloned().map(Arc::new);
        let mut environment = Self {
            entities,
            scene,
            descriptions,
            endings,
            facts,
            lasting: Vec::new(),
            given: Vec::new(),
            given_of: FxHashSet::default(),
            base_pose_facts: BasePoseFacts::default(),
        };
        scene_facts::facts(library, &mut environment);
        base_pose_facts::derive(library, &mut environment);
        for (fact, value, _) in &library.initially {
            base_pose_facts::doubt(library, &mut environment, fact, Some(*value));
            environment.assert_fact(fact.clone(), *value);
        }
        if let Some(state) = state {
            diagnostics.extend(state.apply(library, &mut environment));
        }
        (environment, diagnostics)
    }

    pub(crate) fn entities(&self) -> &Entities {
        &self.entities
    }

    /// The scene, if there is one.
    pub(crate) fn scene(&self) -> Option<&Scene> {
        self.scene.as_deref()
    }

    /// Returns whether another environment of the same library has the same names, kinds and descriptions.
    /// Its policies may then use the same words, though other facts hold.
    pub(crate) fn has_same_vocabulary(&self, other: &Self) -> bool {
        self.has_scene() == other.has_scene()
            && self.entities == other.entities
            && self.descriptions == other.descriptions
    }

    /// Returns whether there is a scene.
    #[must_use]
    pub fn has_scene(&self) -> bool {
        self.scene.is_some()
    }

    /// Records a fact at the start.
    pub(crate) fn assert_fact(&mut self, fact: Fact, value: bool) {
        self.facts.set(fact.fluent, key(&fact), TruthSet::of(value, Cause::START));
        self.base_pose_facts.drop_covered(&fact);
        // One about every entity says it of those, too, of which something was said. Of a single one the
        // later word counts by coming later.
        if fact.args.iter().any(Option::is_none) {
            self.forget_given(&fact);
        }
        let of = key(&fact);
        self.given_of.extend((0..fact.args.len()).map(|index| (fact.fluent, index, of.arg(index))));
        self.given.push((fact, value));
    }

    /// Gives a fact at the start the lifetime of a perception before it.
    pub(crate) fn limit(&mut self, fact: &Fact, value: bool, lifetime: PerceptionLifetime) {
        let cause = Cause::seen_at_start(self.lasting.len());
        self.lasting.push(lifetime);
        self.facts.set(fact.fluent, key(fact), TruthSet::of(value, cause));
    }

    /// Records that a fact is unknown at the start; a fact with `any` covers many.
    pub(crate) fn forget(&mut self, fact: &Fact) {
        self.facts.set(fact.fluent, key(fact), TruthSet::open(Cause::START));
        self.base_pose_facts.drop_covered(fact);
        self.forget_given(fact);
    }

    /// Facts at the start, in order: a later one overrides.
    pub(crate) fn initial_facts(&self) -> impl Iterator<Item = (&Fact, bool)> {
        self.given.iter().map(|(fact, holds)| (fact, *holds)).chain(self.base_pose_facts.facts())
    }

    /// Returns whether some of the facts that a fact at the start covers were forgotten after it.
    pub(crate) fn leaves_open(&self, fact: &Fact) -> bool {
        let mut is_open = false;
        self.facts.parts(fact.fluent, key(fact), |part| {
            is_open |= self.facts.get(fact.fluent, part).open.is_some();
        });
        is_open
    }

    /// Drops earlier entries that a fact covers.
    fn forget_given(&mut self, fact: &Fact) {
        let known = fact.args.iter().enumerate().filter(|(_, arg)| arg.is_some());
        let mut places = known.map(|(index, _)| (fact.fluent, index, key(fact).arg(index)));
        if places.any(|place| !self.given_of.contains(&place)) {
            return;
        }
        self.given.retain(|(given, _)| {
            given.fluent != fact.fluent
                || !fact.args.iter().zip(&given.args).all(|(of, given)| of.is_none() || of == given)
        });
    }

    /// Entities of a kind that a description fits, in the order of the environment.
    pub(crate) fn described(&self, library: &Library, description: &str, kind: Kind) -> Vec<Entity> {
        let fits =
            |entity: &Entity| self.entities.kind(*entity).is_some_and(|found| library.is_kind(found, kind));
        let fitting = |wanted: &str| -> Vec<Entity> {
            let found = self.descriptions.get(wanted).map(Vec::as_slice).unwrap_or_default();
            found.iter().copied().filter(fits).collect()
        };
        let wanted = normal(description);
        let mut found = fitting(&wanted);
        if found.is_empty() {
            found = fitting(singular(&wanted));
        }
        if found.is_empty() && is_anything(&wanted) {
            found = self.entities.iter().map(|(entity, ..)| entity).filter(fits).collect();
        }
        found
    }

    /// A description that finds an entity and no other of its kind: its name, or else the shortest
    /// description that does, the first of them in alphabetical order. O(descriptions).
    pub(crate) fn description_of(
        &self,
        library: &Library,
        name: &SmolStr,
        (entity, kind): (Entity, Kind),
    ) -> Option<SmolStr> {
        let finds = |description: &str| self.described(library, description, kind) == [entity];
        if finds(name) {
            return Some(name.clone());
        }
        let others = self.descriptions.iter().filter(|(_, found)| found.contains(&entity));
        let others = others.map(|(description, _)| description).filter(|description| finds(description));
        others.min_by_key(|description| (description.len(), description.as_str())).map(SmolStr::from)
    }

    /// Returns whether a description fits any entity.
    pub(crate) fn is_description(&self, description: &str) -> bool {
        let is_gap = |byte: u8| matches!(byte, b' ' | b'_' | b'-');
        let mut bytes = description.bytes().rev().skip_while(|byte| is_gap(*byte));
        let last = bytes.next().unwrap_or(0);
        let first = bytes.next().unwrap_or(0);
        let first = if is_gap(first) { b' ' } else { first.to_ascii_lowercase() };
        let may_be = self.endings.contains(&(first, last.to_ascii_lowercase()));
        (may_be || !description.is_ascii()) && self.descriptions.contains_key(&normal(description))
    }

    /// Returns whether a text that begins like that may describe an entity. O(descriptions).
    pub(crate) fn begins_description(&self, begun: &str) -> bool {
        let wanted = normal(begun);
        // An article may be about to be complete, and then says nothing.
        let is_article = ["an", "the"].iter().any(|article| article.starts_with(&wanted));
        !begun.is_ascii()
            || is_article
            || self.descriptions.keys().any(|description| description.starts_with(&wanted))
    }

    /// A number of an entity of the scene, in SI units: `mass`, `width`, or a field of its own.
    pub(crate) fn number(&self, entity: Entity, field: &str) -> Option<f64> {
        if entity == ROBOT {
            return None;
        }
        let found = self.scene.as_ref()?.entities.get(self.entities.name(entity)?)?;
        match field {
            lang::fields::MASS => found.mass_kg,
            lang::fields::WIDTH => found.width(),
            _ => None,
        }
        .or_else(|| found.fields.get(field).copied())
    }

    /// Name of an entity.
    pub(crate) fn name(&self, entity: Entity) -> SmolStr {
        self.entities.name(entity).cloned().unwrap_or_else(|| SmolStr::new_static("?"))
    }
}

/// Key of a ground fact, or the pattern of one with `any`.
fn key(fact: &Fact) -> FactKey {
    FactKey::new(fact.args.iter().map(|term| match term {
        Some(Term::Entity(entity)) => arg(*entity),
        Some(Term::Case(_, case)) => *case,
        _ => ANY,
    }))
}
