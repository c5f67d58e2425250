//! What a scene says, as entities and facts (section 8 of the language page).

use motet_robots::scene::{Entity as Thing, Scene, normal};
use motet_syntax::Diagnostic;
use rustc_hash::{FxHashMap, FxHashSet};
use smol_str::SmolStr;

use super::errors::{TakenName, TooManyEntities, UnknownKind};
use super::{Entities, MAX_ENTITIES, World};
use crate::ir::{Entity, Fact, ROBOT, START, Term, USER};
use crate::library::Library;
use crate::resolve::near::near;

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
            None if thing.kind.is_empty() => library.kind_named("Entity"),
            None => {
                let near = near(&thing.kind, library.kinds.iter().map(|def| def.name.as_str()));
                let (kind, entity) = (thing.kind.clone(), thing.id.clone());
                diagnostics.push(UnknownKind { span: thing.spans.kind, kind, entity, near }.into());
                library.kind_named("Entity")
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

/// What finds each entity: all that a scene calls it, or its name where no scene is given.
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

/// Names a fluent of the standard library where it is declared with that many parameters.
struct Teller<'a> {
    library: &'a Library,
    world: &'a mut World,
}

impl Teller<'_> {
    fn tell(&mut self, fluent: &str, args: &[Option<Entity>], value: bool) {
        let Some(id) = self.library.names.fluents.get(fluent).copied() else { return };
        let Some(def) = self.library.fluent(id).filter(|def| def.params.len() == args.len()) else { return };
        // An entity that the parameter cannot take has no such fact.
        for ((_, ty), arg) in def.params.iter().zip(args) {
            let kind = arg.and_then(|entity| self.world.entities.kind(entity));
            if let (Some(kind), Some(wanted)) = (kind, ty.kind())
                && !self.library.is_kind(kind, wanted)
            {
                return;
            }
        }
        let args = args.iter().map(|arg| arg.map(Term::Entity)).collect();
        self.world.tell(Fact { fluent: id, args }, value);
    }

    /// `free` of every hand.
    fn hands(&mut self, free: bool) {
        let library = self.library;
        let Some(fluent) = library.names.fluents.get("free").copied() else { return };
        let Some(hand) = library.names.enums.get("Hand").copied() else { return };
        let takes_hand = library.fluent(fluent).is_some_and(
            |def| matches!(def.params.as_slice(), [(_, ty)] if ty.base == crate::ir::Base::Enum(hand)),
        );
        if !takes_hand {
            return;
        }
        let cases = library.enums.get(hand.index()).map_or(0, |def| def.cases.len());
        for case in 0..u16::try_from(cases).unwrap_or(0) {
            self.world.tell(Fact { fluent, args: vec![Some(Term::Case(hand, case))] }, free);
        }
    }
}

pub(super) fn facts(library: &Library, world: &mut World) {
    let scene = world.scene.clone();
    let closed = library.closed_world;
    let mut teller = Teller { library, world };
    let held = scene.as_ref().and_then(|scene| scene.robot.holding.clone());
    // Nothing is held where nothing is said, but not in a closed world that says all there is.
    if !closed || held.is_some() {
        teller.tell("holding", &[None], false);
        teller.hands(!matches!(held, Some(Some(_))));
    }
    teller.tell("visited", &[None], false);
    // Only objects are on, in or held out to something; furniture, places and people are where they are.
    if let Some(object) = library.names.kinds.get("Object").copied() {
        let entities = teller.world.entities.iter().filter(|(id, ..)| *id != ROBOT);
        let others =
            entities.filter(|(.., kind)| !library.is_kind(*kind, object) && !library.is_kind(object, *kind));
        for entity in others.map(|(id, ..)| id).collect::<Vec<_>>() {
            teller.tell("at", &[Some(entity), None], false);
        }
    }
    let Some(scene) = scene else { return };
    if let Some(place) = scene.robot.at.as_ref().and_then(|at| find(&teller, at)) {
        teller.tell("at", &[Some(ROBOT), None], false);
        teller.tell("at", &[Some(ROBOT), Some(place)], true);
        teller.tell("near", &[Some(place)], true);
    }
    let supports: FxHashSet<_> = scene.entities.values().filter_map(|thing| thing.on.as_ref()).collect();
    for thing in scene.entities.values() {
        if let Some(entity) = find(&teller, &thing.id) {
            let is_held = matches!(&held, Some(Some(id)) if *id == thing.id);
            place(&mut teller, thing, entity, is_held);
            state(&mut teller, thing, entity, supports.contains(&thing.id));
        }
    }
}

/// What goes with a state that says that `entity` is held and nothing of the hands.
pub(super) fn held(library: &Library, world: &mut World, entity: Entity) {
    let mut teller = Teller { library, world };
    for fluent in ["on", "in", "at"] {
        teller.tell(fluent, &[Some(entity), None], false);
    }
    teller.hands(false);
}

fn find(teller: &Teller<'_>, name: &SmolStr) -> Option<Entity> {
    teller.world.entities.find(name).map(|found| found.0)
}

/// Where a thing is: a scene that says so says it whole.
fn place(teller: &mut Teller<'_>, thing: &Thing, entity: Entity, is_held: bool) {
    let me = Some(entity);
    if is_held || thing.on.is_some() || thing.inside.is_some() {
        for fluent in ["on", "in", "at"] {
            teller.tell(fluent, &[me, None], false);
        }
    }
    if is_held {
        teller.tell("holding", &[me], true);
        teller.tell("lifted", &[me], true);
        return;
    }
    for (fluent, support) in [("on", &thing.on), ("in", &thing.inside)] {
        if let Some(support) = support.as_ref().and_then(|support| find(teller, support)) {
            teller.tell(fluent, &[me, Some(support)], true);
            teller.tell("at", &[me, Some(support)], true);
        }
    }
}

/// Whether it is seen, open, locked, and whether something stands on it.
fn state(teller: &mut Teller<'_>, thing: &Thing, entity: Entity, covered: bool) {
    let me = [Some(entity)];
    if let Some(visible) = thing.visible {
        teller.tell("visible", &me, visible);
    }
    match (thing.open, thing.travel) {
        (Some(open), _) => teller.tell("open", &me, open),
        // What has no door is always open.
        (None, None) => teller.tell("open", &me, true),
        (None, Some(_)) => {}
    }
    match (thing.locked, thing.travel) {
        (Some(locked), _) => teller.tell("locked", &me, locked),
        (None, None) => teller.tell("locked", &me, false),
        (None, Some(_)) => {}
    }
    teller.tell("clear", &me, !covered);
}
