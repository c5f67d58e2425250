//! The world as it is known: as a scene, as a state, as the start of a run, and as requests are understood
//! in it.

use indexmap::IndexMap;
use motet_compiler::{InitialState, Session};
use motet_graph::Value;
use motet_robots::scene::Scene;
use motet_runtime::{Pattern, Query, StartState, Truth};
use motet_syntax::{Span, print};
use smol_str::SmolStr;

use super::{Knowledge, query};
use motet_requests::{ReportedLocation, RequestContext};

impl Knowledge {
    /// Knowledge locations of objects.
    #[must_use]
    pub fn places(&self, scene: &Scene) -> Vec<ReportedLocation> {
        let told = self.situation(scene).supports;
        let objects = scene.entities.values().filter(|entity| entity.kind == "Object");
        let places = objects.filter_map(|entity| {
            let told = told.iter().find(|(id, _)| *id == entity.id).map(|(_, place)| place.clone());
            let place = told.unwrap_or_else(|| entity.on.clone().or_else(|| entity.inside.clone()))?;
            let is_container = scene.entities.get(&place).is_some_and(|place| place.kind == "Container");
            Some(ReportedLocation {
                thing: entity.id.clone(),
                relation: if is_container { "in" } else { "on" },
                place,
            })
        });
        places.collect()
    }

    /// The scene without what is known otherwise, or no longer.
    #[must_use]
    pub fn scene(&self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        for (query, _) in &self.facts {
            let Query::Fact { fluent, args } = query else { continue };
            let Some(Pattern::Is(Value::Entity(id))) = args.first() else {
                if fluent == "visible" {
                    scene.entities.values_mut().for_each(|entity| entity.visible = None);
                }
                if fluent == "holding" {
                    scene.robot.holding = None;
                }
                continue;
            };
            if id == "robot" && fluent == "at" {
                scene.robot.at = None;
            }
            if fluent == "holding" {
                scene.robot.holding = None;
            }
            let Some(entity) = scene.entities.get_mut(id) else { continue };
            match fluent.as_str() {
                "on" | "in" | "at" if entity.on.is_some() || entity.inside.is_some() => {
                    (entity.on, entity.inside) = (None, None);
                }
                "visible" => entity.visible = None,
                _ => {}
            }
        }
        for id in self.moved(&scene) {
            if let Some(entity) = scene.entities.get_mut(&id) {
                entity.pose = None;
            }
        }
        scene
    }

    /// The scene as it is now, as motions are looked for in it, with the base where it stands (x, y,
    /// heading in the frame
    /// `map`); none where it is not known where some object is, which could then stand in the way of
    /// anything.
    #[must_use]
    pub fn placed(&self, scene: &Scene, base: [f64; 3]) -> Option<Scene> {
        let situation = self.situation(scene);
        let mut placed = scene.clone();
        (placed.robot.base, placed.robot.at) = (base, None);
        // What the scene says of the joints was said of the start.
        placed.robot.joints = IndexMap::new();
        placed.robot.holding = Some(situation.holding.clone());
        for (id, support) in &situation.supports {
            let Some(entity) = placed.entities.get_mut(id).filter(|entity| entity.kind == "Object") else {
                continue;
            };
            let before = entity.on.as_ref().or(entity.inside.as_ref());
            if situation.holding.as_ref() != Some(id) && support.as_ref() != before {
                return None;
            }
        }
        for (query, truth) in &self.facts {
            let Query::Fact { fluent, args } = query else { continue };
            if fluent != "open" {
                continue;
            }
            let [Pattern::Is(Value::Entity(id))] = args.as_slice() else { return None };
            if let Some(entity) = placed.entities.get_mut(id) {
                entity.open = match truth {
                    Truth::True => Some(true),
                    Truth::False => Some(false),
                    Truth::Unknown => None,
                };
            }
        }
        Some(placed)
    }

    /// Objects that are known to be elsewhere than where the scene has them, or not known to be there.
    fn moved(&self, stripped: &Scene) -> Vec<SmolStr> {
        let fixed = |id: &SmolStr| stripped.entities.get(id).is_none_or(|entity| entity.kind != "Object");
        let mut moved: Vec<SmolStr> = Vec::new();
        for (query, truth) in &self.facts {
            if let Query::Fact { fluent, args } = query
                && fluent == "holding"
                && *truth == Truth::True
                && let Some(Pattern::Is(Value::Entity(id))) = args.first()
                && !fixed(id)
            {
                moved.push(id.clone());
            }
        }
        moved
    }

    /// The facts as the compiler takes them; of what is no longer known it is told just that.
    #[must_use]
    pub fn state(&self) -> InitialState {
        let mut facts: IndexMap<String, (Option<bool>, Span)> = IndexMap::new();
        for (query, truth) in &self.facts {
            let Some(text) = text(query) else { continue };
            // A later fact stands later.
            facts.shift_remove(&text);
            let known = match truth {
                Truth::True => Some(true),
                Truth::False => Some(false),
                Truth::Unknown => None,
            };
            facts.insert(text, (known, Span::default()));
        }
        InitialState { facts }
    }

    /// Start of the next run, whose policy was checked in `session`: the session's facts, of which a graph
    /// only carries those about single entities, then everything known since.
    #[must_use]
    pub fn start(&self, scene: &Scene, session: &Session) -> StartState {
        let entities = scene.entities.values().map(|entity| (entity.id.clone(), entity.kind.clone()));
        let given = session.initial_facts().map(|given| {
            let truth = if given.holds { Truth::True } else { Truth::False };
            (query(given), truth)
        });
        StartState {
            facts: given.chain(self.facts.iter().cloned()).collect(),
            some: self.some.clone(),
            entities: entities.collect(),
            ..StartState::default()
        }
    }

    /// Object in the hand, if it is known.
    #[must_use]
    pub fn holding(&self, scene: &Scene) -> Option<SmolStr> {
        let mut held = scene.robot.holding.clone().flatten();
        for (query, truth) in &self.facts {
            let Query::Fact { fluent, args } = query else { continue };
            if fluent != "holding" {
                continue;
            }
            match (args.first(), truth) {
                (Some(Pattern::Is(Value::Entity(id))), Truth::True) => held = Some(id.clone()),
                (Some(Pattern::Is(Value::Entity(id))), _) if held.as_ref() == Some(id) => held = None,
                (Some(Pattern::Any), Truth::False | Truth::Unknown) => held = None,
                _ => {}
            }
        }
        held
    }

    /// The situation in which a request is understood.
    #[must_use]
    pub fn situation<'s>(&self, scene: &'s Scene) -> RequestContext<'s> {
        let mut supports: IndexMap<SmolStr, Option<SmolStr>> = IndexMap::new();
        for (query, truth) in &self.facts {
            let Query::Fact { fluent, args } = query else { continue };
            if !matches!(fluent.as_str(), "on" | "in" | "at") {
                continue;
            }
            let [Pattern::Is(Value::Entity(thing)), place] = args.as_slice() else { continue };
            match (place, truth) {
                (Pattern::Is(Value::Entity(place)), Truth::True) => {
                    supports.insert(thing.clone(), Some(place.clone()));
                }
                (Pattern::Is(Value::Entity(place)), Truth::False | Truth::Unknown)
                    if supports.get(thing).is_some_and(|known| known.as_ref() == Some(place)) =>
                {
                    supports.insert(thing.clone(), None);
                }
                (Pattern::Any, Truth::False | Truth::Unknown) => {
                    supports.insert(thing.clone(), None);
                }
                _ => {}
            }
        }
        RequestContext {
            holding: self.holding(scene),
            supports: supports.into_iter().collect(),
            spoken_of: self.spoken_of.clone(),
            came_from: self.came_from.clone(),
            ..RequestContext::new(scene)
        }
    }
}

/// A fact as a state file has it; none where an argument is no name.
fn text(query: &Query) -> Option<String> {
    let Query::Fact { fluent, args } = query else { return None };
    let args = args.iter().map(|arg| match arg {
        Pattern::Any => Some("any".to_owned()),
        Pattern::Is(Value::Entity(id) | Value::Case(id)) => Some(print::identifier(id)),
        Pattern::Is(_) => None,
    });
    Some(format!("{}({})", print::identifier(fluent), args.collect::<Option<Vec<_>>>()?.join(", ")))
}
