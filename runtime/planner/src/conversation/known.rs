//! What is known between two policies: what a run believed at its end, and what people said. From it come the scene and the
//! state that the next policy is checked against, and the start of the next run.

use indexmap::IndexMap;
use motet_compiler::{Given, Session, State};
use motet_graph::{Graph, Value};
use motet_robots::scene::Scene;
use motet_runtime::{Engine, Pattern, Query, Snapshot, StartState, Truth};
use motet_syntax::{Span, print};
use smol_str::SmolStr;

use crate::request::{Located, Situation};

/// What is known beside a scene.
#[derive(Clone, Debug, Default)]
pub struct Known {
    /// In order: a later fact wins, and one with `any` is meant of every entity.
    facts: Vec<(Query, Truth)>,
    some: Vec<Query>,
    /// What was spoken of, the latest last.
    pub(super) spoken_of: Vec<SmolStr>,
}

impl Known {
    /// Whether nothing is known but what the scene says.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.facts.is_empty()
    }

    /// Takes over what a run believes. Of what its graph does not speak of, what was known before stays; of what the scene
    /// says, as a session was `given` it, nothing stays that is no longer believed.
    pub fn learn(&mut self, engine: &Engine, given: &Session) {
        self.take(engine.snapshot(), engine.graph(), given);
    }

    /// The same in the middle of a run, for a policy that is to take over: of what running steps change nothing is known then.
    pub fn learn_midway(&mut self, engine: &Engine, given: &Session) {
        self.take(engine.interrupted(), engine.graph(), given);
    }

    fn take(&mut self, snapshot: Snapshot, graph: &Graph, given: &Session) {
        let speaks = |query: &Query| match query {
            Query::Fact { fluent, .. } => graph.fluents.iter().any(|known| known.name == *fluent),
            Query::Measure { .. } | Query::Field { .. } => true,
        };
        self.facts.retain(|(query, _)| !speaks(query));
        let said = given.given().map(|given| (query(given), Truth::Unknown));
        self.facts.extend(said.filter(|(query, _)| speaks(query)));
        self.facts.extend(snapshot.facts);
        self.some.retain(|query| !speaks(query));
        self.some.extend(snapshot.some);
    }

    /// Where the objects are, as far as that is known.
    #[must_use]
    pub fn places(&self, scene: &Scene) -> Vec<Located> {
        let told = self.situation(scene).supports;
        let objects = scene.entities.values().filter(|entity| entity.kind == "Object");
        let places = objects.filter_map(|entity| {
            let told = told.iter().find(|(id, _)| *id == entity.id).map(|(_, place)| place.clone());
            let place = told.unwrap_or_else(|| entity.on.clone().or_else(|| entity.inside.clone()))?;
            let is_container = scene.entities.get(&place).is_some_and(|place| place.kind == "Container");
            Some(Located {
                thing: entity.id.clone(),
                relation: if is_container { "in" } else { "on" },
                place,
            })
        });
        places.collect()
    }

    /// After a step that failed it is unknown where the thing is that it was about. Until somebody looks it is taken to be
    /// where it was: a hand that slipped left it there. The next plan looks before it takes.
    pub fn presume(&mut self, before: &[Located]) {
        for known in before {
            let thing = Pattern::Is(Value::Entity(known.thing.clone()));
            let mut about = self.facts.iter().rev().filter_map(|(query, truth)| match query {
                Query::Fact { fluent, args } if fluent == "at" && args.first() == Some(&thing) => {
                    Some(*truth)
                }
                _ => None,
            });
            if about.next() != Some(Truth::Unknown) {
                continue;
            }
            let place = Pattern::Is(Value::Entity(known.place.clone()));
            for fluent in ["on", "in", "at"] {
                let args = vec![thing.clone(), Pattern::Any];
                self.facts.push((Query::Fact { fluent: fluent.into(), args }, Truth::False));
            }
            for fluent in [known.relation, "at"] {
                let args = vec![thing.clone(), place.clone()];
                self.facts.push((Query::Fact { fluent: fluent.into(), args }, Truth::True));
            }
        }
    }

    /// Takes in what the robot feels of itself: what it holds is nowhere else, and where it stands it stands.
    pub fn notice(&mut self, felt: &[(Query, Truth)]) {
        let robot = Pattern::Is(Value::Entity(SmolStr::new_static("robot")));
        let stands = |query: &Query| match query {
            Query::Fact { fluent, args } => fluent == "at" && args.first() == Some(&robot),
            Query::Measure { .. } | Query::Field { .. } => false,
        };
        if felt.iter().any(|(query, _)| stands(query)) {
            let args = vec![robot.clone(), Pattern::Any];
            self.facts.push((Query::Fact { fluent: "at".into(), args }, Truth::False));
        }
        for (query, truth) in felt {
            let Query::Fact { fluent, args } = query else { continue };
            // That it is nowhere else was said above.
            if stands(query) && *truth != Truth::True {
                continue;
            }
            if let ("holding", Truth::True, Some(thing)) = (fluent.as_str(), truth, args.first()) {
                for place in ["on", "in", "at"] {
                    let args = vec![thing.clone(), Pattern::Any];
                    self.facts.push((Query::Fact { fluent: place.into(), args }, Truth::False));
                }
            }
            self.facts.push((query.clone(), *truth));
        }
    }

    /// Where the robot stands no longer counts: from there something could not be reached.
    pub fn doubt_standing(&mut self) {
        let robot = Pattern::Is(Value::Entity(SmolStr::new_static("robot")));
        let args = vec![robot, Pattern::Any];
        self.facts.push((Query::Fact { fluent: "at".into(), args }, Truth::Unknown));
    }

    /// Takes in where somebody says that a thing is.
    pub fn hear(&mut self, said: &Located) {
        let thing = Pattern::Is(Value::Entity(said.thing.clone()));
        let mut tell = |fluent: &str, args: Vec<Pattern>, truth| {
            self.facts.push((Query::Fact { fluent: fluent.into(), args }, truth));
        };
        for fluent in ["on", "in", "at"] {
            tell(fluent, vec![thing.clone(), Pattern::Any], Truth::False);
        }
        let place = Pattern::Is(Value::Entity(said.place.clone()));
        for fluent in [said.relation, "at"] {
            tell(fluent, vec![thing.clone(), place.clone()], Truth::True);
        }
        for fluent in ["visible", "located", "clear"] {
            tell(fluent, vec![thing.clone()], Truth::Unknown);
        }
        self.spoken_of.push(said.thing.clone());
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

    /// The scene as it is now, as motions are looked for in it, with the base where it stands (x, y, heading in the frame
    /// `map`); none where it is not known where some object is, which could then stand in the way of anything.
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
    pub fn state(&self) -> State {
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
        State { facts }
    }

    /// What the next run begins with, where its policy was checked in a session: what the session was given, of which a graph
    /// says only what it says of single entities, then what is known.
    #[must_use]
    pub fn start(&self, scene: &Scene, session: &Session) -> StartState {
        let entities = scene.entities.values().map(|entity| (entity.id.clone(), entity.kind.clone()));
        let given = session.given().map(|given| {
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

    /// What the hand holds.
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
    pub fn situation<'s>(&self, scene: &'s Scene) -> Situation<'s> {
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
        Situation {
            holding: self.holding(scene),
            supports: supports.into_iter().collect(),
            spoken_of: self.spoken_of.clone(),
            ..Situation::new(scene)
        }
    }
}

fn query(given: Given) -> Query {
    let args = given.args.into_iter().map(|arg| arg.map_or(Pattern::Any, Pattern::Is));
    Query::Fact { fluent: given.fluent, args: args.collect() }
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
