//! Knowledge between two policies: the beliefs at the end of a run, and statements of people. The scene and
//! the state of the next check, and the start of the next run, come from it.

use indexmap::IndexMap;
use motet_compiler::{FactLifetime, InitialFact, InitialState, Session};
use motet_graph::{CallNode, Graph, Node, NodeKind, Value};
use motet_requests::{Preference, ReportedLocation, RequestContext};
use motet_robots::scene::{Entity, EntityShape, Grip, Placement, Scene, Travel};
use motet_runtime::{
    Engine, Pattern, PendingCleanup, PerceivedFact, Query, Snapshot, StartState, ToldSupport, ToldThing,
    Truth,
};
use motet_stdlib::lang::{self, PLACING, entities, fluents, kinds};
use motet_syntax::{Span, print};
use smol_str::SmolStr;

use crate::runtime_check::grip;
use crate::vision::Sightings;

/// Knowledge beyond a scene.
#[derive(Clone, Debug, Default)]
pub struct Knowledge {
    /// Facts in order: a later fact wins, and a fact with `any` is about every entity.
    pub(super) facts: Vec<(Query, Truth)>,
    some: Vec<Query>,
    /// Facts among these that last only so long.
    lasting: Vec<PerceivedFact>,
    /// Cleanups of policies that are over, which have not run to their end.
    pending: Vec<PendingCleanup>,
    /// Entities that were mentioned, the latest last.
    pub(super) spoken_of: Vec<SmolStr>,
    /// Earlier locations of moved things, the latest last.
    came_from: Vec<(SmolStr, SmolStr)>,
    /// Things that were seen elsewhere than in the scene, or that it lacks.
    pub(super) seen: Sightings,
    /// Things that were in view so far, in the order in which they were seen.
    pub(super) seen_so_far: Vec<SmolStr>,
    /// Places at which a thing was looked for and not seen.
    pub(super) missed: Vec<ReportedLocation>,
    /// Places at which the robot looked at everything that is there.
    pub(super) looked_at: Vec<SmolStr>,
    /// Things of which the driver was not told yet.
    pub(super) untold: Vec<ToldThing>,
    /// Grip of the thing that the hand took last, if it is known.
    grip: Option<Grip>,
    /// Preferences of the person.
    pub(super) prefers: Vec<Preference>,
}

impl Knowledge {
    /// True if nothing is known beyond the scene.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.facts.is_empty() && self.seen.is_empty()
    }

    /// Takes over the beliefs at the end of a run. Earlier knowledge stays if the graph has no fluent for
    /// it. Facts of the scene, as the session was `given` it, are dropped if they are no longer believed.
    pub fn learn(&mut self, engine: &Engine, given: &Session) {
        self.take(engine.snapshot(), engine.graph(), given);
    }

    /// Takes over the beliefs in the middle of a run, for a policy that is to take over. Facts that running
    /// steps change become unknown.
    pub fn learn_midway(&mut self, engine: &Engine, given: &Session) {
        self.take(engine.interrupted(), engine.graph(), given);
    }

    fn take(&mut self, snapshot: Snapshot, graph: &Graph, given: &Session) {
        let speaks = |query: &Query| match query {
            Query::Fact { fluent, .. } => graph.fluents.iter().any(|known| known.name == *fluent),
            Query::Measure { .. } | Query::Field { .. } => true,
        };
        self.facts.retain(|(query, _)| !speaks(query));
        let said = given.initial_facts().map(|given| (query(given), Truth::Unknown));
        self.facts.extend(said.filter(|(query, _)| speaks(query)));
        self.facts.extend(snapshot.facts);
        self.some.retain(|query| !speaks(query));
        self.some.extend(snapshot.some);
        self.lasting.retain(|lasting| !speaks(&lasting.fact));
        self.lasting.extend(snapshot.lasting);
        self.pending = snapshot.pending;
        let mut missed = std::mem::take(&mut self.missed);
        missed.retain(|one| self.told(fluents::VISIBLE, &one.thing) != Some(Truth::True));
        self.missed = missed;
        // What a run has grasped, it tells; one that grasps nothing leaves the hand as it was.
        let is_grasp = |node: &Node| match &node.kind {
            NodeKind::Call(CallNode { motion: Some(motion), .. }) => motion.query.starts_with(lang::REACH),
            _ => false,
        };
        self.grip.take_if(|_| graph.nodes.iter().any(is_grasp));
        let told = snapshot.readings.iter().filter_map(|one| Some((one.at, grip(&one.query, &one.value)?)));
        self.grip = told.max_by_key(|(at, _)| *at).map(|(_, grip)| grip).or(self.grip.take());
    }
}

/// An object without an exact pose, with a guess.
pub(super) type UnplacedThing = (SmolStr, Option<Placement>);

/// Pose of a thing in the middle of a surface. `None` where a shape or a pose is not known.
fn on_top(scene: &Scene, thing: &str, support: &str) -> Option<Placement> {
    let support = scene.entities.get(support).filter(|entity| entity.kind == kinds::SURFACE)?;
    let half_height = |entity: &Entity| match entity.shape.as_ref()? {
        EntityShape::Box([_, _, z]) => Some(z / 2.0),
        EntityShape::Cylinder { height, .. } => Some(height / 2.0),
        EntityShape::Sphere { radius } => Some(*radius),
        EntityShape::Capsule { .. } | EntityShape::Mesh { .. } => None,
    };
    let below = support.pose.filter(|pose| pose.rpy[0] == 0.0 && pose.rpy[1] == 0.0)?;
    let [x, y, z] = below.xyz;
    let z = z + half_height(support)? + half_height(scene.entities.get(thing)?)?;
    Some(Placement { xyz: [x, y, z], rpy: [0.0; 3] })
}

fn query(given: InitialFact) -> Query {
    let args = given.args.into_iter().map(|arg| arg.map_or(Pattern::Any, Pattern::Is));
    Query::Fact { fluent: given.fluent, args: args.collect() }
}

impl Knowledge {
    /// Known locations of objects.
    #[must_use]
    pub fn places(&self, scene: &Scene) -> Vec<ReportedLocation> {
        let scene = &self.seen_scene(scene);
        let told = self.situation(scene).supports;
        let objects = scene.entities.values().filter(|entity| entity.kind == kinds::OBJECT);
        let places = objects.filter_map(|entity| {
            let told = told.iter().find(|(id, _)| *id == entity.id).map(|(_, place)| place.clone());
            let place = told.unwrap_or_else(|| entity.on.clone().or_else(|| entity.inside.clone()))?;
            let relation = scene.entities.get(&place).map_or(fluents::ON, Entity::relation);
            Some(ReportedLocation { thing: entity.id.clone(), relation, place })
        });
        places.collect()
    }

    /// The scene without the facts that are known to be different or are no longer known.
    #[must_use]
    pub fn scene(&self, scene: &Scene) -> Scene {
        let mut scene = self.seen_scene(scene);
        for (query, _) in &self.facts {
            let Query::Fact { fluent, args } = query else { continue };
            let Some(Pattern::Is(Value::Entity(id))) = args.first() else {
                if fluent == fluents::VISIBLE {
                    scene.entities.values_mut().for_each(|entity| entity.visible = None);
                }
                if fluent == fluents::HOLDING {
                    scene.robot.holding = None;
                }
                continue;
            };
            if id == entities::ROBOT && fluent == fluents::AT {
                scene.robot.at = None;
            }
            if fluent == fluents::HOLDING {
                scene.robot.holding = None;
            }
            let Some(entity) = scene.entities.get_mut(id) else { continue };
            match fluent.as_str() {
                fluents::ON | fluents::IN | fluents::AT if entity.on.is_some() || entity.inside.is_some() => {
                    (entity.on, entity.inside) = (None, None);
                }
                fluents::VISIBLE => entity.visible = None,
                _ => {}
            }
        }
        for id in self.moved(&scene) {
            if let Some(entity) = scene.entities.get_mut(&id) {
                entity.pose = None;
            }
        }
        for id in self.seen.in_view() {
            if let Some(entity) = scene.entities.get_mut(id) {
                entity.visible = Some(true);
            }
        }
        scene
    }

    /// The scene at present, for motion searches, with the base at a pose (x, y, heading in the frame
    /// `map`), and the objects whose exact pose is not known, each with a guess if it stands on something.
    /// `None` if it is not known which doors are open.
    #[must_use]
    pub fn placed(&self, scene: &Scene, base: [f64; 3]) -> Option<(Scene, Vec<UnplacedThing>)> {
        let scene = &self.seen_scene(scene);
        let situation = self.situation(scene);
        let mut placed = scene.clone();
        (placed.robot.base, placed.robot.at) = (base, None);
        // What the scene says of the joints was said of the start.
        placed.robot.joints = IndexMap::new();
        placed.robot.holding = Some(situation.holding.clone());
        let is_held = |grip: &&Grip| situation.holding.as_ref() == Some(&grip.of);
        if let Some(grip) = self.grip.as_ref().filter(is_held) {
            placed.robot.grip = Some(grip.clone());
        }
        let mut unplaced = Vec::new();
        for (id, support) in &situation.supports {
            let guess = support.as_ref().and_then(|support| on_top(scene, id, support));
            let Some(entity) = placed.entities.get_mut(id).filter(|entity| entity.kind == kinds::OBJECT)
            else {
                continue;
            };
            let before = entity.on.as_ref().or(entity.inside.as_ref());
            if situation.holding.as_ref() != Some(id) && support.as_ref() != before {
                (entity.pose, entity.on, entity.inside) = (None, None, None);
                // What a person has is no obstacle, as after an offer in a plan.
                let is_given = support.as_ref().and_then(|support| scene.entities.get(support));
                if is_given.is_none_or(|at| at.kind != kinds::PERSON) {
                    unplaced.push((id.clone(), guess));
                }
            }
        }
        for (query, truth) in &self.facts {
            let Query::Fact { fluent, args } = query else { continue };
            if fluent != fluents::OPEN {
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
        // What was seen in an open drawer has moved with it since.
        let is_shut = |id: &SmolStr| {
            let drawer = placed.entities.get(id);
            drawer.is_some_and(|it| matches!(it.travel, Some(Travel::Slide { .. })) && it.open == Some(false))
        };
        let was_seen = |entity: &&Entity| self.seen.positions().any(|(id, _)| *id == entity.id);
        let inside = placed.entities.values().filter(|entity| entity.inside.as_ref().is_some_and(is_shut));
        let gone: Vec<SmolStr> = inside.filter(was_seen).map(|entity| entity.id.clone()).collect();
        for id in gone {
            placed.entities.get_mut(&id).into_iter().for_each(|entity| entity.pose = None);
            unplaced.push((id, None));
        }
        Some((placed, unplaced))
    }

    /// Objects that are known to be elsewhere than in the scene, or not known to be there.
    fn moved(&self, stripped: &Scene) -> Vec<SmolStr> {
        let fixed =
            |id: &SmolStr| stripped.entities.get(id).is_none_or(|entity| entity.kind != kinds::OBJECT);
        let mut moved: Vec<SmolStr> = Vec::new();
        for (query, truth) in &self.facts {
            if let Query::Fact { fluent, args } = query
                && fluent == fluents::HOLDING
                && *truth == Truth::True
                && let Some(Pattern::Is(Value::Entity(id))) = args.first()
                && !fixed(id)
            {
                moved.push(id.clone());
            }
        }
        moved
    }

    /// Facts in the form of the compiler; facts that are no longer known are explicitly unknown.
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
        let lasting = self.lasting.iter().filter_map(|lasting| {
            let PerceivedFact { fact, uses, entities } = lasting;
            Some(FactLifetime { fact: text(fact)?, uses: uses.clone(), entities: entities.clone() })
        });
        InitialState { facts, grip: self.grip.clone(), lasting: lasting.collect() }
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
            lasting: self.lasting.clone(),
            entities: entities.collect(),
            pending: self.pending.clone(),
            ..StartState::default()
        }
    }

    /// Object in the hand, if it is known.
    #[must_use]
    pub fn holding(&self, scene: &Scene) -> Option<SmolStr> {
        let mut held = scene.robot.holding.clone().flatten();
        for (query, truth) in &self.facts {
            let Query::Fact { fluent, args } = query else { continue };
            if fluent != fluents::HOLDING {
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

    /// Context in which a request is read.
    #[must_use]
    pub fn situation<'s>(&self, scene: &'s Scene) -> RequestContext<'s> {
        let is_fresh =
            |(id, _): &(&SmolStr, [f64; 3])| scene.entities.get(*id).is_some_and(|one| one.pose.is_some());
        let seen_at = self.seen.positions().filter(is_fresh).map(|(id, at)| (id.clone(), at)).collect();
        RequestContext {
            holding: self.holding(scene),
            supports: self.supports().into_iter().collect(),
            spoken_of: self.spoken_of.clone(),
            came_from: self.came_from.clone(),
            seen_at,
            prefers: self.prefers.clone(),
            ..RequestContext::new(scene)
        }
    }

    /// Supports of things as the facts tell them; `None` for a thing that is nowhere, or nobody knows where.
    pub(super) fn supports(&self) -> IndexMap<SmolStr, Option<SmolStr>> {
        let mut supports: IndexMap<SmolStr, Option<(&str, SmolStr)>> = IndexMap::new();
        for (query, truth) in &self.facts {
            let Query::Fact { fluent, args } = query else { continue };
            if !PLACING.contains(&fluent.as_str()) {
                continue;
            }
            let [Pattern::Is(Value::Entity(thing)), place] = args.as_slice() else { continue };
            let known = supports.get(thing).and_then(|known| known.as_ref());
            match (place, truth) {
                (Pattern::Is(Value::Entity(place)), Truth::True) => {
                    supports.insert(thing.clone(), Some((fluent, place.clone())));
                }
                (Pattern::Is(Value::Entity(place)), Truth::False | Truth::Unknown)
                    if known.is_some_and(|(_, known)| known == place) =>
                {
                    supports.insert(thing.clone(), None);
                }
                // What is on nothing may be in something.
                (Pattern::Any, Truth::False | Truth::Unknown)
                    if known.is_none_or(|(relation, _)| *relation == fluent.as_str()) =>
                {
                    supports.insert(thing.clone(), None);
                }
                _ => {}
            }
        }
        supports.into_iter().map(|(thing, known)| (thing, known.map(|(_, place)| place))).collect()
    }
}

/// A fact in the form of a state file; `None` if an argument is not a name.
fn text(query: &Query) -> Option<String> {
    let Query::Fact { fluent, args } = query else { return None };
    let args = args.iter().map(|arg| match arg {
        Pattern::Any => Some("any".to_owned()),
        Pattern::Is(Value::Entity(id) | Value::Case(id)) => Some(print::identifier(id)),
        Pattern::Is(_) => None,
    });
    Some(format!("{}({})", print::identifier(fluent), args.collect::<Option<Vec<_>>>()?.join(", ")))
}

impl Knowledge {
    /// Presumes after a failed step that the object is where it was before, until somebody looks: a hand
    /// that slipped left it there. What was seen since the last step began is where it was seen: a step that
    /// was cancelled had put it down. The next plan looks before it picks.
    pub fn presume(&mut self, scene: &Scene, before: &[ReportedLocation]) {
        for known in before {
            if self.latest(fluents::AT, &known.thing) != Some(Truth::Unknown) {
                continue;
            }
            let (relation, place) =
                self.seen_place(scene, &known.thing).unwrap_or((known.relation, known.place.clone()));
            let thing = Pattern::Is(Value::Entity(known.thing.clone()));
            let place = Pattern::Is(Value::Entity(place));
            for fluent in PLACING {
                let args = vec![thing.clone(), Pattern::Any];
                self.facts.push((Query::Fact { fluent: fluent.into(), args }, Truth::False));
            }
            for fluent in [relation, fluents::AT] {
                let args = vec![thing.clone(), place.clone()];
                self.facts.push((Query::Fact { fluent: fluent.into(), args }, Truth::True));
            }
        }
    }

    /// An object that the robot took and no longer holds, while nobody put it anywhere: it fell.
    #[must_use]
    pub(in crate::dialogue) fn fallen(&self, scene: &Scene) -> Option<SmolStr> {
        let situation = self.situation(scene);
        let nowhere = situation.supports.into_iter().filter(|(_, place)| place.is_none());
        let mut things = nowhere.map(|(id, _)| id).filter(|id| situation.holding.as_ref() != Some(id));
        things.find(|id| {
            let is_object = scene.entities.get(id).is_some_and(|entity| entity.kind == kinds::OBJECT);
            is_object && self.latest(fluents::AT, id) == Some(Truth::False)
        })
    }

    /// Latest truth of a fact about one entity and any other.
    fn latest(&self, fluent: &str, id: &SmolStr) -> Option<Truth> {
        let subject = Pattern::Is(Value::Entity(id.clone()));
        self.facts.iter().rev().find_map(|(query, truth)| match query {
            Query::Fact { fluent: known, args } if known == fluent && args.first() == Some(&subject) => {
                Some(*truth)
            }
            _ => None,
        })
    }

    /// Forgets where an object is.
    pub(in crate::dialogue) fn forget_place(&mut self, id: &SmolStr) {
        let subject = Pattern::Is(Value::Entity(id.clone()));
        for fluent in PLACING {
            let args = vec![subject.clone(), Pattern::Any];
            self.facts.push((Query::Fact { fluent: fluent.into(), args }, Truth::Unknown));
        }
    }

    /// Takes in the robot's answers about itself: a held object is nowhere else, and the robot is at one
    /// place.
    pub fn notice(&mut self, felt: &[(Query, Truth)]) {
        let robot = Pattern::Is(Value::Entity(SmolStr::new_static(entities::ROBOT)));
        let stands = |query: &Query| match query {
            Query::Fact { fluent, args } => fluent == fluents::AT && args.first() == Some(&robot),
            Query::Measure { .. } | Query::Field { .. } => false,
        };
        if felt.iter().any(|(query, _)| stands(query)) {
            let args = vec![robot.clone(), Pattern::Any];
            self.facts.push((Query::Fact { fluent: fluents::AT.into(), args }, Truth::False));
        }
        for (query, truth) in felt {
            let Query::Fact { fluent, args } = query else { continue };
            // That it is nowhere else was said above.
            if stands(query) && *truth != Truth::True {
                continue;
            }
            if let (fluents::HOLDING, Truth::True, Some(thing)) = (fluent.as_str(), truth, args.first()) {
                for place in PLACING {
                    let args = vec![thing.clone(), Pattern::Any];
                    self.facts.push((Query::Fact { fluent: place.into(), args }, Truth::False));
                }
            }
            self.facts.push((query.clone(), *truth));
        }
    }

    /// Knowledge of these facts, in order.
    #[must_use]
    pub fn of(facts: impl IntoIterator<Item = (Query, Truth)>) -> Self {
        Self { facts: facts.into_iter().collect(), ..Self::default() }
    }

    /// Takes in facts, in order.
    pub fn tell(&mut self, facts: impl IntoIterator<Item = (Query, Truth)>) {
        self.facts.extend(facts);
    }

    /// Truth of a fact about one entity, as far as it was told or learned: the latest word counts.
    #[must_use]
    pub fn told(&self, fluent: &str, entity: &SmolStr) -> Option<Truth> {
        let is_it = |query: &Query| match query {
            Query::Fact { fluent: name, args } => match args.as_slice() {
                [Pattern::Is(Value::Entity(id))] => name == fluent && id == entity,
                [Pattern::Any] => name == fluent,
                _ => false,
            },
            Query::Measure { .. } | Query::Field { .. } => false,
        };
        self.facts.iter().rev().find(|(query, _)| is_it(query)).map(|(_, truth)| *truth)
    }

    /// Entity at which the robot is known to stand.
    #[must_use]
    pub fn standing(&self, scene: &Scene) -> Option<SmolStr> {
        let robot = Pattern::Is(Value::Entity(SmolStr::new_static(entities::ROBOT)));
        let mut at = scene.robot.at.clone();
        for (query, truth) in &self.facts {
            let Query::Fact { fluent, args } = query else { continue };
            if fluent != fluents::AT || args.first() != Some(&robot) {
                continue;
            }
            match (args.get(1), truth) {
                (Some(Pattern::Is(Value::Entity(place))), Truth::True) => at = Some(place.clone()),
                (Some(Pattern::Is(Value::Entity(place))), _) if at.as_ref() != Some(place) => {}
                (_, _) => at = None,
            }
        }
        at
    }

    /// Forgets the robot's place at an entity, since something could not be reached from there.
    pub fn doubt_standing(&mut self) {
        let robot = Pattern::Is(Value::Entity(SmolStr::new_static(entities::ROBOT)));
        let args = vec![robot, Pattern::Any];
        self.facts.push((Query::Fact { fluent: fluents::AT.into(), args }, Truth::Unknown));
    }

    /// Keeps the former places of moved objects, so that they can be put back.
    pub(in crate::dialogue) fn remember_moved(
        &mut self,
        before: &[ReportedLocation],
        after: &[ReportedLocation],
    ) {
        for known in before {
            let now = after.iter().find(|now| now.thing == known.thing);
            if now.is_none_or(|now| now.place != known.place) {
                self.came_from.retain(|(thing, _)| *thing != known.thing);
                self.came_from.push((known.thing.clone(), known.place.clone()));
            }
        }
    }

    /// Takes in a stated location.
    pub fn hear(&mut self, said: &ReportedLocation) {
        self.missed.retain(|one| one.thing != said.thing);
        let thing = Pattern::Is(Value::Entity(said.thing.clone()));
        let mut tell = |fluent: &str, args: Vec<Pattern>, truth| {
            self.facts.push((Query::Fact { fluent: fluent.into(), args }, truth));
        };
        for fluent in PLACING {
            tell(fluent, vec![thing.clone(), Pattern::Any], Truth::False);
        }
        let place = Pattern::Is(Value::Entity(said.place.clone()));
        for fluent in [said.relation, fluents::AT] {
            tell(fluent, vec![thing.clone(), place.clone()], Truth::True);
        }
        for fluent in [fluents::VISIBLE, fluents::LOCATED, fluents::CLEAR] {
            tell(fluent, vec![thing.clone()], Truth::Unknown);
        }
        self.spoken_of.push(said.thing.clone());
        let place = said.place.clone();
        let support = match said.relation {
            fluents::IN => ToldSupport::In(place),
            fluents::ON => ToldSupport::On(place),
            _ => ToldSupport::At(place),
        };
        let (id, support) = (said.thing.clone(), Some(support));
        self.untold.push(ToldThing { id, label: None, pose: None, support });
    }
}
