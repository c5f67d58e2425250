//! What stands on, lies in or is held by what: every name exists, and nothing carries itself.

use std::collections::{HashMap, HashSet};

use motet_syntax::json::Spanned;
use motet_syntax::{Diagnostic, Span, suggest};
use smol_str::SmolStr;

use super::errors::{HeldElsewhere, SupportCycle, UnknownEntity};
use super::model::Scene;
use super::wire;

/// For how many mistakes a close name is looked for, and how many things of a ring are shown.
const SHOWN: usize = 8;

/// Takes relations out of the scene that cannot be, and says why.
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
    /// Whether a name is not known; then it is told, with the right one where one is close.
    fn unknown(&mut self, key: &'static str, name: &Spanned<SmolStr>) -> bool {
        if self.scene.entities.contains_key(&name.value) {
            return false;
        }
        // Looking for a close name takes as long as there are names: it is worth it for the first mistakes.
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

    /// Finds rings, and opens each. Every entity has at most two supports; each is walked once. O(entities).
    fn cycles(&mut self, wires: &[Spanned<wire::Entity>]) {
        // Of entities with one id the first counts.
        let places = wires.iter().rev().map(|wire| (&wire.id.value, where_said(wire)));
        let places: HashMap<&SmolStr, Span> = places.collect();
        let mut done: HashSet<SmolStr> = HashSet::new();
        let roots: Vec<SmolStr> = self.scene.entities.keys().cloned().collect();
        for root in roots {
            // The way that the walk came, each with how many of its two supports were seen, and the same as a set.
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

    /// What carries an entity: first what it is on, then what it is in.
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

/// Where an entity says what carries it.
fn where_said(wire: &wire::Entity) -> Span {
    wire.on.as_ref().or(wire.r#in.as_ref()).map_or(wire.id.span, |place| place.span)
}
