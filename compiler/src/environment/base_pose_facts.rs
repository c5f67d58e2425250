//! Facts at the start that follow from the pose of the base: what the robot serves from there, and what it is
//! near. They hold as long as nothing else is said about the robot or the thing.

use indexmap::IndexMap;
use motet_robots::scene::ServedKind;

use super::{Environment, key};
use crate::declare::Library;
use crate::facts::{ANY, Cause, FactKey, TruthSet, arg};
use crate::ir::{Entity, Fact, Fluent, Kind, ROBOT, Term};

/// Facts that follow from the pose of the base, by fluent and key.
#[derive(Clone, Debug, Default)]
pub(crate) struct BasePoseFacts {
    facts: IndexMap<(Fluent, FactKey), (Fact, bool)>,
}

impl BasePoseFacts {
    /// The facts with their values.
    pub(crate) fn facts(&self) -> impl Iterator<Item = (&Fact, bool)> {
        self.facts.values().map(|(fact, holds)| (fact, *holds))
    }

    /// Drops the facts that a fact, perhaps with `any`, covers: another word was given about them.
    pub(super) fn drop_covered(&mut self, fact: &Fact) {
        if self.facts.is_empty() {
            return;
        }
        let of = key(fact);
        // All facts with more arguments than one are about the robot.
        if of.is_pattern() && of.arg(0) != ANY && of.arg(0) != ROBOT.0 {
            return;
        }
        if of.is_pattern() {
            self.facts.retain(|(fluent, key), _| *fluent != fact.fluent || !of.covers(*key));
        } else {
            self.facts.swap_remove(&(fact.fluent, of));
        }
    }
}

/// Fluents about the place of the robot: `at` and `near`, if they are declared as in the standard library.
#[derive(Clone, Copy)]
struct PlaceFluents {
    at: Fluent,
    near: Option<Fluent>,
}

impl PlaceFluents {
    fn of(library: &Library) -> Option<Self> {
        let with = |fluent: Option<Fluent>, params: usize| {
            fluent.filter(|id| library.fluent(*id).is_some_and(|def| def.params.len() == params))
        };
        Some(Self { at: with(library.lang_items.at, 2)?, near: with(library.lang_items.near, 1) })
    }

    fn served(self, entity: Entity) -> Fact {
        let args = [ROBOT, entity].map(|entity| Some(Term::Entity(entity)));
        Fact { fluent: self.at, args: args.into_iter().collect() }
    }

    fn nearby(self, entity: Entity) -> Option<Fact> {
        Some(Fact { fluent: self.near?, args: [Some(Term::Entity(entity))].into_iter().collect() })
    }
}

/// Records what the pose of the base in the scene decides. In a closed world the scene says all there is.
pub(super) fn derive(library: &Library, environment: &mut Environment) {
    let (Some(fluents), Some(reach)) = (PlaceFluents::of(library), library.serving_reach) else { return };
    let Some(scene) = environment.scene.clone().filter(|_| !library.closed_world) else { return };
    let held = scene.robot.holding.as_ref().and_then(Option::as_ref);
    let [x, y, _] = scene.robot.base;
    let mut found: Vec<(Fact, bool)> = Vec::new();
    let mut open: Vec<Fact> = Vec::new();
    for (entity, name, kind) in environment.entities.iter() {
        if entity == ROBOT {
            continue;
        }
        let Some(thing) = scene.entities.get(name) else {
            open.push(fluents.served(entity));
            continue;
        };
        if scene.robot.at.as_ref() == Some(name) {
            continue;
        }
        let kind = served_kind(library, kind);
        let is_held = held == Some(name);
        match if is_held { Some(false) } else { reach.serves([x, y], &scene, thing, kind) } {
            Some(serves) => found.push((fluents.served(entity), serves)),
            None => open.push(fluents.served(entity)),
        }
        // People walk; whether one is near is for the run.
        if kind != ServedKind::Person
            && !is_held
            && let (Some(near), Some(fact)) =
                (reach.is_near([x, y], &scene, thing, kind), fluents.nearby(entity))
        {
            found.push((fact, near));
        }
    }
    // The scene that names the place of the robot has said of all others that it is not there.
    let says_place = scene.robot.at.is_some();
    let refuted = found.iter().filter(|(fact, holds)| fact.fluent == fluents.at && !holds).count();
    // Few facts in the store: the rest of a pattern is found at once, however many things there are.
    let by_pattern = says_place || open.len() < refuted;
    if by_pattern && !says_place {
        let all = FactKey::new([arg(ROBOT), ANY].into_iter());
        environment.facts.set(fluents.at, all, TruthSet::no(Cause::START));
        for fact in &open {
            environment.facts.set(fluents.at, key(fact), TruthSet::NOTHING_KNOWN);
        }
    }
    for (fact, holds) in found {
        let is_covered = by_pattern && fact.fluent == fluents.at && !holds;
        if !is_covered {
            environment.facts.set(fact.fluent, key(&fact), TruthSet::of(holds, Cause::START));
        }
        if !(is_covered && says_place) {
            environment.base_pose_facts.facts.insert((fact.fluent, key(&fact)), (fact, holds));
        }
    }
}

/// Facts about what the robot serves and is near with its base at a point of the floor: of things that never
/// move, by fluent and key. O(entities).
pub(crate) fn from_base(
    library: &Library,
    environment: &Environment,
    base: [f64; 2],
) -> Vec<(Fluent, FactKey, bool)> {
    let (Some(fluents), Some(reach)) = (PlaceFluents::of(library), library.serving_reach) else {
        return Vec::new();
    };
    let Some(scene) = environment.scene.as_ref().filter(|_| !library.closed_world) else { return Vec::new() };
    let mut found = Vec::new();
    for (entity, name, kind) in environment.entities.iter() {
        let kind = served_kind(library, kind);
        let stays = |thing: &&motet_robots::scene::Entity| thing.fixed || kind == ServedKind::Place;
        let Some(thing) = scene.entities.get(name).filter(stays) else { continue };
        if kind == ServedKind::Person {
            continue;
        }
        let serves = reach.serves(base, scene, thing, kind);
        let near = reach.is_near(base, scene, thing, kind);
        let near = near.and_then(|near| Some((fluents.nearby(entity)?, near)));
        let facts = serves.map(|serves| (fluents.served(entity), serves)).into_iter().chain(near);
        found.extend(facts.map(|(fact, holds)| (fact.fluent, key(&fact), holds)));
    }
    found
}

fn served_kind(library: &Library, kind: Kind) -> ServedKind {
    let items = &library.lang_items;
    let is = |wanted: Option<Kind>| wanted.is_some_and(|wanted| library.is_kind(kind, wanted));
    if is(items.place) {
        ServedKind::Place
    } else if is(items.person) {
        ServedKind::Person
    } else if is(items.object) {
        ServedKind::Object
    } else {
        ServedKind::Furniture
    }
}

/// Takes back what the pose of the base has decided, where a fact that is about to be recorded says that the
/// robot or a thing is elsewhere than in the scene.
pub(super) fn doubt(library: &Library, environment: &mut Environment, fact: &Fact, value: Option<bool>) {
    let Some(fluents) = PlaceFluents::of(library).filter(|_| !environment.base_pose_facts.facts.is_empty())
    else {
        return;
    };
    let items = &library.lang_items;
    let moves = [Some(fluents.at), items.on, items.inside, items.holding].contains(&Some(fact.fluent));
    let known = environment.facts.get(fact.fluent, key(fact));
    let is_known = match value {
        Some(true) => known.is_true(),
        Some(false) => known.is_false(),
        None => false,
    };
    let Some(first) = fact.args.first().filter(|_| moves && !is_known) else { return };
    match first {
        Some(Term::Entity(ROBOT)) if value.is_some() || fact.args.contains(&None) => {
            forget_all(fluents, environment);
        }
        Some(Term::Entity(ROBOT)) => {}
        Some(Term::Entity(thing)) => forget_thing(fluents, environment, *thing),
        // Of which thing it is said is not known.
        _ => forget_all(fluents, environment),
    }
}

/// Forgets all that follows from the pose of the base. What was given stays.
fn forget_all(fluents: PlaceFluents, environment: &mut Environment) {
    environment.base_pose_facts = BasePoseFacts::default();
    let robot = FactKey::new([arg(ROBOT), ANY].into_iter());
    environment.facts.set(fluents.at, robot, TruthSet::NOTHING_KNOWN);
    if let Some(near) = fluents.near {
        environment.facts.set(near, FactKey::new([ANY].into_iter()), TruthSet::NOTHING_KNOWN);
    }
    let is_of_robot = |fact: &Fact| {
        Some(fact.fluent) == fluents.near
            || (fact.fluent == fluents.at && fact.args.first() == Some(&Some(Term::Entity(ROBOT))))
    };
    for (fact, value) in environment.given.iter().filter(|(fact, _)| is_of_robot(fact)) {
        environment.facts.set(fact.fluent, key(fact), TruthSet::of(*value, Cause::START));
    }
}

/// Forgets what follows from the pose of the base about a thing and all that is on or in it.
fn forget_thing(fluents: PlaceFluents, environment: &mut Environment, thing: Entity) {
    let mut moved = vec![environment.name(thing)];
    if let Some(scene) = environment.scene.clone() {
        let mut next = 0;
        while let Some(support) = moved.get(next).cloned() {
            next += 1;
            let above = scene.entities.values().filter(|other| {
                [&other.on, &other.inside].iter().any(|below| below.as_ref() == Some(&support))
            });
            for other in above {
                if !moved.contains(&other.id) {
                    moved.push(other.id.clone());
                }
            }
        }
    }
    for name in moved {
        let Some((entity, _)) = environment.entities.find(&name) else { continue };
        for fact in [Some(fluents.served(entity)), fluents.nearby(entity)].into_iter().flatten() {
            if environment.base_pose_facts.facts.contains_key(&(fact.fluent, key(&fact))) {
                environment.base_pose_facts.drop_covered(&fact);
                environment.facts.set(fact.fluent, key(&fact), TruthSet::NOTHING_KNOWN);
            }
        }
    }
}
