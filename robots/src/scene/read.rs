//! Reader of scenes, from JSON to a [`Scene`]: ids, the robot, and relations (`on`, `in`, `holding`, `at`):
//! every name exists, and supports have no cycle. [`super::check`] checks single entities.

use std::collections::{HashMap, HashSet};

use indexmap::IndexMap;
use motet_syntax::json::{self, Spanned};
use motet_syntax::render::is_steering;
use motet_syntax::{Diagnostic, FileId, Source, Span, suggest};
use smol_str::SmolStr;

use super::check::NumberReader;
use super::diagnostics::{
    BadId, DuplicateId, Frame, GripOfNothing, HeldElsewhere, ReservedId, SupportCycle, TooManyEntities,
    UnknownEntity, Version,
};
use super::model::{Entity, Grip, JointSpans, MAX_ENTITIES, RobotState, Scene};
use super::quantity::SceneQuantity;
use super::{check, wire};

/// Ids with a meaning of their own in policies.
const RESERVED: &[&str] = &["robot", "any"];

/// Reads a scene and returns it with its diagnostics.
///
/// Only an unreadable document gives no scene. Otherwise the scene comes without its faulty parts, so it
/// keeps the invariants of the model. O(bytes).
#[must_use]
pub fn read(source: &Source, file: FileId) -> (Option<Scene>, Vec<Diagnostic>) {
    let (document, mut found) = json::read::<wire::Document>(source, file);
    let Some(document) = document else { return (None, found) };
    if document.motet_scene.value != 1 {
        let version = Version { span: document.motet_scene.span, found: document.motet_scene.value };
        found.push(version.into());
        return (None, found);
    }
    let mut numbers = NumberReader::default();
    if let Some(frame) = document.frame.as_ref().filter(|frame| frame.value != "map") {
        numbers.found.push(Frame { span: frame.span, found: frame.value.clone() }.into());
    }
    let count = document.entities.len();
    if let Some(first) = document.entities.iter().skip(MAX_ENTITIES).find_map(|entity| entity.0.as_ref()) {
        numbers.found.push(TooManyEntities { span: first.id.span, count }.into());
    }
    let wires: Vec<_> =
        document.entities.into_iter().take(MAX_ENTITIES).filter_map(|entity| entity.0).collect();
    let robot = document.robot.0.unwrap_or_default();
    let clearance = document.clearance.0.as_ref();
    let mut scene = Scene {
        clearance: clearance.map(|it| check::clearance(it, &mut numbers)).unwrap_or_default(),
        entities: entities(&wires, &mut numbers),
        views: document.views.iter().filter_map(|view| check::view(view.0.as_ref()?, &mut numbers)).collect(),
        robot: at_start(&robot, &mut numbers),
    };
    found.append(&mut numbers.found);
    found.extend(resolve_relations(&mut scene, &wires, &robot));
    found.sort_by_key(|diagnostic| diagnostic.span.start);
    (Some(scene), found)
}

fn entities(wires: &[Spanned<wire::Entity>], numbers: &mut NumberReader) -> IndexMap<SmolStr, Entity> {
    let mut entities = IndexMap::with_capacity(wires.len());
    let mut places: IndexMap<SmolStr, Span> = IndexMap::with_capacity(wires.len());
    for wire in wires {
        let (id, span) = (wire.id.value.clone(), wire.id.span);
        if id.is_empty() || id.contains(|letter| matches!(letter, '`' | ',' | ';') || is_steering(letter)) {
            numbers.found.push(BadId { span, key: "id", id }.into());
        } else if RESERVED.contains(&id.as_str()) {
            numbers.found.push(ReservedId { span, id }.into());
        } else if let Some(first) = places.get(&id).copied() {
            numbers.found.push(DuplicateId { span, id, first }.into());
        } else {
            places.insert(id.clone(), span);
            entities.insert(id, check::entity(wire, numbers));
        }
    }
    entities
}

fn at_start(robot: &wire::Robot, numbers: &mut NumberReader) -> RobotState {
    let base = robot.base.0.as_ref().and_then(|base| {
        let [x, y, heading] = base.value;
        let x = numbers.one(&Spanned::new(x, base.span), SceneQuantity::Coordinate)?;
        let y = numbers.one(&Spanned::new(y, base.span), SceneQuantity::Coordinate)?;
        Some([x, y, numbers.one(&Spanned::new(heading, base.span), SceneQuantity::Angle)?])
    });
    let joints = robot.joints.iter().filter_map(|(name, value)| {
        let value = numbers.one(value, SceneQuantity::Joint)?;
        Some((name.clone(), value))
    });
    RobotState {
        base: base.unwrap_or_default(),
        joints: joints.collect(),
        holding: robot.holding.as_ref().map(|held| held.as_ref().map(|id| id.value.clone())),
        grip: grip(robot, numbers),
        at: robot.at.as_ref().map(|at| at.value.clone()),
        spans: JointSpans(robot.joints.iter().map(|(name, value)| (name.clone(), value.span)).collect()),
    }
}

fn grip(robot: &wire::Robot, numbers: &mut NumberReader) -> Option<Grip> {
    let grip = robot.grip.0.as_ref()?;
    let Some(Some(held)) = &robot.holding else {
        numbers.found.push(GripOfNothing { span: grip.xyz.span }.into());
        return None;
    };
    Some(Grip { of: held.value.clone(), tip_from_object: check::placement(grip, numbers)? })
}

/// Number of mistakes for which a close name is searched, and of entities of a cycle that are listed.
const SHOWN: usize = 8;

/// Removes impossible relations from the scene and returns their diagnostics.
pub(super) fn resolve_relations(
    scene: &mut Scene,
    wires: &[Spanned<wire::Entity>],
    robot: &wire::Robot,
) -> Vec<Diagnostic> {
    let mut relations = Relations { scene, found: Vec::new() };
    let mut seen = HashSet::new();
    for wire in wires {
        // Of entities with one id the first counts.
        if seen.insert(&wire.id.value) {
            relations.supports(wire);
        }
    }
    relations.cycles(wires);
    relations.robot(robot);
    relations.held(robot, wires);
    relations.found
}

struct Relations<'s> {
    scene: &'s mut Scene,
    found: Vec<Diagnostic>,
}

impl Relations<'_> {
    /// Reports an unknown name, with the right one if one is close; returns true for an unknown name.
    fn unknown(&mut self, key: &'static str, name: &Spanned<SmolStr>) -> bool {
        if self.scene.entities.contains_key(&name.value) {
            return false;
        }
        // A search for a close name is linear in the names: it is worth it for the first mistakes.
        let known = self.scene.entities.keys().map(SmolStr::as_str).filter(|_| self.found.len() < SHOWN);
        let near = suggest::closest(&name.value, known).map(SmolStr::new);
        self.found.push(UnknownEntity { span: name.span, key, name: name.value.clone(), near }.into());
        true
    }

    fn supports(&mut self, wire: &wire::Entity) {
        let no_support = wire.on.as_ref().is_some_and(|on| self.unknown("on", on));
        let no_container = wire.r#in.as_ref().is_some_and(|within| self.unknown("in", within));
        if let Some(entity) = self.scene.entities.get_mut(&wire.id.value) {
            entity.on.take_if(|_| no_support);
            entity.inside.take_if(|_| no_container);
        }
    }

    fn robot(&mut self, robot: &wire::Robot) {
        if robot.holding.iter().flatten().any(|held| self.unknown("holding", held)) {
            self.scene.robot.holding = None;
            self.scene.robot.grip = None;
        }
        if robot.at.as_ref().is_some_and(|at| self.unknown("at", at)) {
            self.scene.robot.at = None;
        }
    }

    fn held(&mut self, robot: &wire::Robot, wires: &[Spanned<wire::Entity>]) {
        let Some(Some(held)) = &robot.holding else { return };
        let Some(entity) = self.scene.entities.get_mut(&held.value) else { return };
        if entity.on.take().is_some() | entity.inside.take().is_some() {
            let place = wires.iter().find(|wire| wire.id.value == held.value);
            let place = place.and_then(|wire| wire.on.as_ref().or(wire.r#in.as_ref()));
            let span = place.map_or(held.span, |place| place.span);
            self.found.push(HeldElsewhere { span, id: held.value.clone(), held: held.span }.into());
        }
    }

    /// Finds cycles and cuts each. An entity has at most two supports, and each is visited once. O(entities).
    fn cycles(&mut self, wires: &[Spanned<wire::Entity>]) {
        // Of entities with one id the first counts.
        let places = wires.iter().rev().map(|wire| (&wire.id.value, where_said(wire)));
        let places: HashMap<&SmolStr, Span> = places.collect();
        let mut done: HashSet<SmolStr> = HashSet::new();
        let roots: Vec<SmolStr> = self.scene.entities.keys().cloned().collect();
        for root in roots {
            // Path of the walk, each entity with the number of its supports visited, and the same as a set.
            let mut way: Vec<(SmolStr, u8)> = Vec::new();
            let mut on_way: HashSet<SmolStr> = HashSet::new();
            let mut next = Some(root);
            loop {
                if let Some(id) = next.take().filter(|id| !done.contains(id)) {
                    on_way.insert(id.clone());
                    way.push((id, 0));
                }
                let Some((id, seen)) = way.last_mut() else { break };
                let (id, which) = (id.clone(), *seen);
                *seen += 1;
                match self.support(&id, which) {
                    Some(support) if on_way.contains(&support) => {
                        let ring = way.iter().map(|(id, _)| id).skip_while(|id| **id != support).cloned();
                        self.ring(ring.collect(), &id, which, &places);
                    }
                    Some(support) => next = Some(support),
                    None if which >= 2 => {
                        way.pop();
                        on_way.remove(&id);
                        done.insert(id);
                    }
                    None => {}
                }
            }
        }
    }

    /// Support of an entity: 0 for `on`, 1 for `in`.
    fn support(&self, id: &SmolStr, which: u8) -> Option<SmolStr> {
        let entity = self.scene.entities.get(id)?;
        match which {
            0 => entity.on.clone(),
            1 => entity.inside.clone(),
            _ => None,
        }
    }

    fn ring(&mut self, ring: Vec<SmolStr>, last: &SmolStr, which: u8, places: &HashMap<&SmolStr, Span>) {
        let span_of = |id: &SmolStr| places.get(id).copied();
        let others = ring.iter().filter(|id| *id != last);
        let others = others.filter_map(|id| Some((id.clone(), span_of(id)?))).take(SHOWN).collect();
        self.found.push(SupportCycle { span: span_of(last).unwrap_or_default(), ring, others }.into());
        if let Some(entity) = self.scene.entities.get_mut(last) {
            match which {
                0 => entity.on = None,
                _ => entity.inside = None,
            }
        }
    }
}

/// Span of the support of an entity.
fn where_said(wire: &wire::Entity) -> Span {
    wire.on.as_ref().or(wire.r#in.as_ref()).map_or(wire.id.span, |place| place.span)
}
