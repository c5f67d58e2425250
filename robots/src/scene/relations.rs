//! What stands on, lies in or is held by what: every name exists, and nothing carries itself.

use std::collections::{HashMap, HashSet};

use motet_syntax::json::Spanned;
use motet_syntax::{Diagnostic, Span, suggest};
use smol_str::SmolStr;

use super::errors::{HeldElsewhere, SupportCycle, UnknownEntity};
use super::model::Scene;
use super::wire;

/// Takes relations out of the scene that cannot be, and says why.
pub(super) fn settle(
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
    /// Says that a name is not known; the right one, where one is close.
    fn unknown(&mut self, key: &'static str, name: &Spanned<SmolStr>) -> bool {
        if self.scene.entities.contains_key(&name.value) {
            return false;
        }
        let known = self.scene.entities.keys().map(SmolStr::as_str);
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
        if let Some(Some(held)) = &robot.holding {
            if self.unknown("holding", held) {
                self.scene.robot.holding = None;
            }
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
        let places: HashMap<&SmolStr, Span> =
            wires.iter().rev().map(|wire| (&wire.id.value, where_said(wire))).collect();
        let mut done: HashSet<SmolStr> = HashSet::new();
        let roots: Vec<SmolStr> = self.scene.entities.keys().cloned().collect();
        for root in roots {
            // A walk keeps the way that it came, and how many of the two supports of each it has seen.
            let mut way: Vec<(SmolStr, usize)> = vec![(root, 0)];
            while let Some((id, next)) = way.pop() {
                let support = (!done.contains(&id)).then(|| self.support(&id, next)).flatten();
                let Some(support) = support else {
                    if next >= 2 || done.contains(&id) {
                        done.insert(id);
                    } else {
                        way.push((id, next + 1));
                    }
                    continue;
                };
                way.push((id.clone(), next + 1));
                match way.iter().position(|(on_way, _)| *on_way == support) {
                    Some(first) => {
                        let ring: Vec<SmolStr> = way.iter().skip(first).map(|(id, _)| id.clone()).collect();
                        self.ring(ring, &id, next, &places);
                    }
                    None => way.push((support, 0)),
                }
            }
        }
    }

    fn support(&self, id: &SmolStr, which: usize) -> Option<SmolStr> {
        let entity = self.scene.entities.get(id)?;
        match which {
            0 => entity.on.clone(),
            1 => entity.inside.clone(),
            _ => None,
        }
    }

    fn ring(&mut self, ring: Vec<SmolStr>, last: &SmolStr, which: usize, places: &HashMap<&SmolStr, Span>) {
        let span_of = |id: &SmolStr| places.get(id).copied().unwrap_or_default();
        let others = ring.iter().filter(|id| *id != last).map(|id| (id.clone(), span_of(id))).collect();
        self.found.push(SupportCycle { span: span_of(last), ring, others }.into());
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
