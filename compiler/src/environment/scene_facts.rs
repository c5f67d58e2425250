//! Entities and facts of a scene (section 8 of the language page).

use motet_robots::scene::{Entity as Thing, Scene, normal};
use motet_syntax::Diagnostic;
use rustc_hash::{FxHashMap, FxHashSet};
use smol_str::SmolStr;

use super::Environment;
use super::diagnostics::{TakenName, TooManyEntities, UnknownKind};
use crate::declare::Library;
use crate::declare::name::near;
use crate::ir::{Entities, Entity, Fact, Fluent, Kind, MAX_ENTITIES, ROBOT, START, Term, USER};

pub(super) fn entities(
    library: &Library,
    scene: &Scene,
    entities: &mut Entities,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for thing in scene.entities.values() {
        let kind = match library.names.kinds.get(&thing.kind) {
            Some(kind) => *kind,
            // That the kind is empty was said when the scene was read.
            None if thing.kind.is_empty() => Kind::ROOT,
            None => {
                let near = near(&thing.kind, library.kinds.iter().map(|def| def.name.as_str()));
                let (kind, entity) = (thing.kind.clone(), thing.id.clone());
                diagnostics.push(UnknownKind { span: thing.spans.kind, kind, entity, near }.into());
                Kind::ROOT
            }
        };
        if entities.len() >= MAX_ENTITIES {
            diagnostics.push(TooManyEntities { span: thing.spans.id, limit: MAX_ENTITIES }.into());
            return;
        }
        let known = entities.find(&thing.id);
        // `user` and `start` may be placed by the scene; the robot is its own.
        let placeable = known.is_none_or(|(entity, _)| entity == USER || entity == START);
        if entities.add(thing.id.clone(), kind).is_none() && !placeable {
            diagnostics.push(TakenName { span: thing.spans.id, entity: thing.id.clone() }.into());
        }
    }
}

/// Entities by description: all that a scene calls them, or their names without a scene.
pub(super) fn descriptions(scene: Option<&Scene>, entities: &Entities) -> FxHashMap<String, Vec<Entity>> {
    let mut found: FxHashMap<String, Vec<Entity>> = FxHashMap::default();
    for (entity, name, _) in entities.iter() {
        let thing = scene.and_then(|scene| scene.entities.get(name));
        let own = scene.is_none().then(|| normal(name));
        for description in thing.into_iter().flat_map(Thing::descriptions).chain(own) {
            let list = found.entry(description).or_default();
            if list.last() != Some(&entity) {
                list.push(entity);
            }
        }
    }
    found
}

/// Records facts with fluents of the standard library, if these are declared with as many parameters.
struct FactRecorder<'a> {
    library: &'a Library,
    environment: &'a mut Environment,
}

impl FactRecorder<'_> {
    fn assert_fact(&mut self, fluent: Option<Fluent>, args: &[Option<Entity>], value: bool) {
        let Some(id) = fluent else { return };
        let Some(def) = self.library.fluent(id).filter(|def| def.params.len() == args.len()) else { return };
        // An entity that the parameter cannot take has no such fact.
        for ((_, ty), arg) in def.params.iter().zip(args) {
            let kind = arg.and_then(|entity| self.environment.entities.kind(entity));
            if let (Some(kind), Some(wanted)) = (kind, ty.kind())
                && !self.library.is_kind(kind, wanted)
            {
                return;
            }
        }
        let args = args.iter().map(|arg| arg.map(Term::Entity)).collect();
        self.environment.assert_fact(Fact { fluent: id, args }, value);
    }

    /// Records `free` for every hand.
    fn hands(&mut self, free: bool) {
        let library = self.library;
        let (Some(fluent), Some(hand)) = (library.lang_items.free, library.lang_items.hand) else { return };
        let takes_hand = library.fluent(fluent).is_some_and(
            |def| matches!(def.params.as_slice(), [(_, ty)] if ty.base == crate::ir::Base::Enum(hand)),
        );
        if !takes_hand {
            return;
        }
        let cases = library.enums.get(hand.index()).map_or(0, |def| def.cases.len());
        for case in 0..u16::try_from(cases).unwrap_or(0) {
            self.environment.assert_fact(Fact { fluent, args: vec![Some(Term::Case(hand, case))] }, free);
        }
    }
}

pub(super) fn facts(library: &Library, environment: &mut Environment) {
    let scene = environment.scene.clone();
    let closed = library.closed_world;
    let items = library.lang_items;
    let mut recorder = FactRecorder { library, environment };
    let held = scene.as_ref().and_then(|scene| scene.robot.holding.clone());
    // Nothing is held where nothing is said, but not in a closed environment that says all there is.
    if !closed || held.is_some() {
        recorder.assert_fact(items.holding, &[None], false);
        recorder.hands(!matches!(held, Some(Some(_))));
    }
    recorder.assert_fact(items.visited, &[None], false);
    // Only objects are on, in or held out to something; furniture, places and people are where they are.
    if let Some(object) = library.lang_items.object {
        let entities = recorder.environment.entities.iter().filter(|(id, ..)| *id != ROBOT);
        let others =
            entities.filter(|(.., kind)| !library.is_kind(*kind, object) && !library.is_kind(object, *kind));
        for entity in others.map(|(id, ..)| id).collect::<Vec<_>>() {
            recorder.assert_fact(items.at, &[Some(entity), None], false);
        }
    }
    let Some(scene) = scene else { return };
    if let Some(place) = scene.robot.at.as_ref().and_then(|at| find(&recorder, at)) {
        recorder.assert_fact(items.at, &[Some(ROBOT), None], false);
        recorder.assert_fact(items.at, &[Some(ROBOT), Some(place)], true);
        recorder.assert_fact(items.near, &[Some(place)], true);
    }
    let supports: FxHashSet<_> = scene.entities.values().filter_map(|thing| thing.on.as_ref()).collect();
    for thing in scene.entities.values() {
        if let Some(entity) = find(&recorder, &thing.id) {
            let is_held = matches!(&held, Some(Some(id)) if *id == thing.id);
            place(&mut recorder, thing, entity, is_held);
            state(&mut recorder, thing, entity, supports.contains(&thing.id));
        }
    }
}

/// Records the consequences of a state that says that `entity` is held and says nothing about the hands.
pub(super) fn held(library: &Library, environment: &mut Environment, entity: Entity) {
    let items = library.lang_items;
    let mut recorder = FactRecorder { library, environment };
    for fluent in [items.on, items.inside, items.at] {
        recorder.assert_fact(fluent, &[Some(entity), None], false);
    }
    recorder.hands(false);
}

fn find(recorder: &FactRecorder<'_>, name: &SmolStr) -> Option<Entity> {
    recorder.environment.entities.find(name).map(|found| found.0)
}

/// Records the place of a thing. A scene that gives a place gives it completely.
fn place(recorder: &mut FactRecorder<'_>, thing: &Thing, entity: Entity, is_held: bool) {
    let items = recorder.library.lang_items;
    let me = Some(entity);
    if is_held || thing.on.is_some() || thing.inside.is_some() {
        for fluent in [items.on, items.inside, items.at] {
            recorder.assert_fact(fluent, &[me, None], false);
        }
    }
    if is_held {
        recorder.assert_fact(items.holding, &[me], true);
        recorder.assert_fact(items.lifted, &[me], true);
        return;
    }
    for (fluent, support) in [(items.on, &thing.on), (items.inside, &thing.inside)] {
        if let Some(support) = support.as_ref().and_then(|support| find(recorder, support)) {
            recorder.assert_fact(fluent, &[me, Some(support)], true);
            recorder.assert_fact(items.at, &[me, Some(support)], true);
        }
    }
}

/// Records whether a thing is seen, open, locked, and whether something stands on it.
fn state(recorder: &mut FactRecorder<'_>, thing: &Thing, entity: Entity, covered: bool) {
    let items = recorder.library.lang_items;
    let me = [Some(entity)];
    if let Some(visible) = thing.visible {
        recorder.assert_fact(items.visible, &me, visible);
    }
    match (thing.open, thing.travel) {
        (Some(open), _) => recorder.assert_fact(items.open, &me, open),
        // What has no door is always open.
        (None, None) => recorder.assert_fact(items.open, &me, true),
        (None, Some(_)) => {}
    }
    match (thing.locked, thing.travel) {
        (Some(locked), _) => recorder.assert_fact(items.locked, &me, locked),
        (None, None) => recorder.assert_fact(items.locked, &me, false),
        (None, Some(_)) => {}
    }
    recorder.assert_fact(items.clear, &me, !covered);
}
