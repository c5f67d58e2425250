//! The simulator: a world, the goals that run in it, and who watches it.

use crate::body::{BasePose, distance};
use crate::faults::{FaultSchedule, Faults};
use crate::observation::InitialFacts;
use crate::people::{People, Strolls};
use crate::profile::Profile;
use crate::route::Contact;
use crate::task::Task;
use crate::telemetry::Trail;
use crate::world::SimWorld;
use indexmap::IndexMap;
use motet_graph::Value;
use motet_robots::card::{CameraMount, Robot};
use motet_robots::scene::Scene;
use motet_runtime::{Answer, Detection, DriverEvent, Pattern, Query, Time, Truth};
use motet_stdlib::lang::fluents;
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::SeedableRng;
use smol_str::SmolStr;
use std::collections::VecDeque;

/// While something moves, watches are looked at that often, in ns.
const SAMPLE_NANOS: u64 = 50_000_000;
/// Difference in m up to which the pose of a thing counts as known.
const KNOWN_M: f64 = 0.05;

/// A robot in a room. It implements [`motet_runtime::Driver`]; its time is virtual and goes as the host
/// advances it.
///
/// There are two worlds: the one that is, and the one that the robot believes in. Drives and grasps aim at
/// where things are believed to be, and end as the world makes them end. The belief changes by what the robot
/// sees and feels. [`Self::holds`] and [`Self::position`] give the truth, [`motet_runtime::Driver::observe`]
/// the belief.
///
/// The same robot, scene and options and the same calls at the same times give the same reports, byte for
/// byte.
#[derive(Clone, Debug)]
pub struct Sim {
    /// The world as it is.
    pub(crate) world: SimWorld,
    /// The world as the robot believes that it is.
    pub(crate) belief: SimWorld,
    pub(crate) people: People,
    /// The true scene, by which things are described.
    pub(crate) scene: Scene,
    pub(crate) profile: Profile,
    pub(crate) seed: u64,
    /// Number of the call that runs or has run last.
    pub(crate) occasion: u64,
    /// Number of calls so far.
    pub(crate) calls: u64,
    /// Positions that the robot was told.
    pub(crate) told: IndexMap<SmolStr, [f64; 3]>,
    pub(crate) strolls: Strolls,
    /// Contact at which the present motion of the base will end.
    pub(crate) contact: Option<Contact>,
    /// True if the present motion of the base follows a path that was certified.
    pub(crate) follows: bool,
    pub(crate) faults: FaultSchedule,
    pub(crate) random: SplitMix64,
    pub(crate) tasks: Vec<Task>,
    pub(crate) watches: Vec<(Query, Answer)>,
    pub(crate) outbox: VecDeque<(Time, DriverEvent)>,
    pub(crate) trail: Trail,
    /// News that the robot has seen and the host has not read.
    pub(crate) sighted: VecDeque<Detection>,
    /// The name of the first camera.
    pub(crate) camera: Option<SmolStr>,
    observes: Vec<SmolStr>,
    initial_facts: InitialFacts,
}

impl Sim {
    /// A world at time 0, of which the robot was told the scene. What the scene leaves open is filled in: a
    /// thing without a pose gets a place of its own, an object without mass or width is light and slim;
    /// `start` and `user` always exist. The truth is the world of the options, or else the scene with the
    /// errors of the profile.
    #[must_use]
    pub fn new(robot: &Robot, scene: &Scene, options: SimOptions) -> Self {
        let answers = options.script.answers.iter().chain(&options.faults.answers).cloned();
        let mut belief = SimWorld::new(robot, scene, &options);
        let world = match &options.world {
            Some(real) => SimWorld::new(robot, real, &options.beside_scene(robot, scene)),
            None => belief.displaced(&options.profile.room, options.seed),
        };
        belief.base = world.base;
        let mut sim = Self {
            strolls: Strolls::new(&world, &options.profile.people, options.seed),
            world,
            people: People::new(answers),
            scene: options.world.unwrap_or_else(|| scene.clone()),
            profile: options.profile,
            seed: options.seed,
            occasion: 0,
            calls: 0,
            told: belief.things.iter().map(|(id, thing)| (id.clone(), thing.body.xyz)).collect(),
            belief,
            contact: None,
            follows: false,
            faults: FaultSchedule::new(&options.faults),
            random: SplitMix64::seed_from_u64(options.seed),
            tasks: Vec::new(),
            watches: Vec::new(),
            outbox: VecDeque::new(),
            trail: Trail::default(),
            sighted: VecDeque::new(),
            camera: robot.cameras.keys().next().cloned(),
            observes: robot.observes.clone(),
            initial_facts: options.initial_facts,
        };
        sim.feel();
        sim
    }

    /// Position where the base is now.
    #[must_use]
    pub const fn base(&self) -> BasePose {
        self.world.base
    }

    /// The present time of the world.
    #[must_use]
    pub const fn now(&self) -> Time {
        self.world.now
    }

    /// The held thing; of the first hand if several hold one.
    #[must_use]
    pub fn held(&self) -> Option<&SmolStr> {
        self.world.hands.values().find_map(|grip| grip.holds.as_ref())
    }

    /// The true position of an entity's pose in the frame `map`, in m.
    #[must_use]
    pub fn position(&self, entity: &str) -> Option<[f64; 3]> {
        self.world.thing(entity).map(|thing| thing.body.xyz)
    }

    /// The position of an entity as the robot believes it, in the frame `map`, in m.
    #[must_use]
    pub fn believed_position(&self, entity: &str) -> Option<[f64; 3]> {
        self.belief.thing(entity).filter(|thing| !thing.lost).map(|thing| thing.body.xyz)
    }

    /// True if a fact holds in the world, whatever the robot can observe; nothing where the world does not
    /// know.
    ///
    /// Arguments are names of entities and hands.
    #[must_use]
    pub fn holds(&self, fluent: &str, args: &[&str]) -> Option<bool> {
        match (fluent, args) {
            // Knowledge is the robot's, and its truth the world's.
            (fluents::LOCATED, [id]) => {
                let believed = self.belief.fact(fluent, args, &self.initial_facts)?;
                let known = self.believed_position(id).zip(self.position(id));
                Some(believed && known.is_some_and(|(one, other)| distance(one, other) <= KNOWN_M))
            }
            (_, _) => self.world.fact(fluent, args, &self.initial_facts),
        }
    }

    /// The true answer to a query, whatever the robot can observe; unknown where the world does not know.
    #[must_use]
    pub fn truth(&self, query: &Query) -> Answer {
        self.world.answer(query, &self.initial_facts)
    }

    /// Utterances of the robot with the times at which they ended, the latest thousand at least.
    #[must_use]
    pub fn said(&self) -> &[(Time, SmolStr)] {
        &self.people.heard
    }

    pub(crate) fn report(&mut self, event: DriverEvent) {
        self.outbox.push_back((self.world.now, event));
    }

    /// Observation of the robot, by its senses and its belief. Fluents and measures that its card does not
    /// list cannot be observed.
    pub(crate) fn read(&mut self, query: &Query) -> Answer {
        let observable = match query {
            Query::Fact { fluent: name, .. } | Query::Measure { measure: name, .. } => {
                self.observes.contains(name)
            }
            Query::Field { .. } => true,
        };
        if !observable {
            return Answer::Unknown;
        }
        self.feel();
        self.look_for(query);
        let is_visibility = matches!(query, Query::Fact { fluent, .. } if fluent == fluents::VISIBLE);
        let source = if is_visibility { &self.world } else { &self.belief };
        source.answer(query, &self.initial_facts)
    }

    /// Looks for what a query is about.
    fn look_for(&mut self, query: &Query) {
        let is_felt = |name: &str| {
            matches!(
                name,
                fluents::FREE | fluents::HOLDING | fluents::LIFTED | fluents::VISITED | fluents::STANDING
            )
        };
        let named = |value: &Value| match value {
            Value::Entity(id) => Some(id.clone()),
            Value::Bool(_) | Value::Int(_) | Value::Number(_) | Value::Text(_) => None,
            Value::Case(_) | Value::Pose(_) | Value::List(_) => None,
        };
        let ids: Vec<SmolStr> = match query {
            Query::Fact { fluent, .. } if is_felt(fluent) => return,
            Query::Fact { args, .. } => {
                if args.contains(&Pattern::Any) {
                    self.look_about(self.glance());
                }
                let is = |arg: &Pattern| match arg {
                    Pattern::Is(value) => named(value),
                    Pattern::Any => None,
                };
                args.iter().filter_map(is).collect()
            }
            Query::Measure { args, .. } => args.iter().filter_map(named).collect(),
            Query::Field { .. } => return,
        };
        let look = self.glance();
        ids.iter().for_each(|id| self.refresh(id, look));
    }

    /// Time at which something happens next.
    pub(crate) fn next_time(&self) -> Time {
        let now = self.world.now;
        let tasks = self.tasks.iter().map(|task| task.stage.due()).min().unwrap_or(Time::NEVER);
        let sampled = if self.world.is_moving() && !self.watches.is_empty() {
            Time::from_nanos((now.nanos() / SAMPLE_NANOS + 1).saturating_mul(SAMPLE_NANOS))
        } else {
            Time::NEVER
        };
        let contact = self.contact.as_ref().map_or(Time::NEVER, |contact| contact.at);
        tasks.min(self.faults.next_time()).min(sampled).min(contact).min(self.strolls.next_time())
    }

    /// The host's time has come to `now`: everything until then happens.
    pub(crate) fn pass(&mut self, now: Time) {
        loop {
            let next = self.next_time();
            if next >= now {
                break;
            }
            self.reach(next);
        }
        if now > self.world.now {
            self.world.advance(now);
        }
    }

    /// Time comes to `now`: changes that are due happen, then stages end, then watchers look.
    pub(crate) fn reach(&mut self, now: Time) {
        self.world.advance(now.max(self.world.now));
        let mut changed = false;
        while let Some(change) = self.faults.take(now) {
            self.world.happen(&change);
            changed = true;
        }
        while let Some(person) = self.strolls.take(now) {
            changed |= self.stroll(&person);
        }
        if changed {
            self.expect_contact();
        }
        if let Some(contact) = self.contact.take_if(|contact| contact.at <= now) {
            self.bump(&contact.with);
        }
        while let Some(place) = self.tasks.iter().position(|task| task.stage.due() <= now) {
            let task = self.tasks.remove(place);
            self.go_on(task);
        }
        self.look();
    }

    /// Tells watchers what has changed.
    pub(crate) fn look(&mut self) {
        let mut watches = std::mem::take(&mut self.watches);
        for (query, last) in &mut watches {
            let answer = self.read(query);
            if answer != *last {
                last.clone_from(&answer);
                self.report(DriverEvent::Observed { query: query.clone(), answer });
            }
        }
        self.watches = watches;
    }
}

/// Choices about a simulated world. The default: seed 0, nothing goes wrong, people answer as it pleases the
/// robot.
///
/// ```
/// use motet_sim::{PersonScript, SimOptions};
///
/// let script = PersonScript { answers: vec![Some("the red one".to_owned()), None] };
/// let options = SimOptions { seed: 3, script, ..SimOptions::default() };
/// assert!(options.faults.calls.is_empty());
/// ```
#[derive(Clone, PartialEq, Debug, Default)]
pub struct SimOptions {
    /// Decides how long things take, within a tenth, and what goes wrong. Same seed, same run.
    pub seed: u64,
    pub faults: Faults,
    /// Scripted answers of people.
    pub script: PersonScript,
    /// Rates and sizes of what goes wrong by itself.
    pub profile: Profile,
    /// The room as it is. Without one it is the scene that the robot was told, with the errors of the
    /// profile.
    pub world: Option<Scene>,
    /// The parent of each kind that the policy's library declares, so that a `Tray: Surface` counts as a
    /// surface. Kinds of the standard library need not be in it.
    pub kinds: IndexMap<SmolStr, SmolStr>,
    /// Entities beside the scene's, with their kind, that shall have a place in the world all the same. One
    /// of a scene with the same name counts before it.
    pub entities: Vec<(SmolStr, SmolStr)>,
    /// Facts that hold at the start, by fluent and arguments. The world is made such that they do: what is
    /// told to be on the table is put there. Those of fluents that it does not simulate answer observations
    /// of them.
    pub initial_facts: IndexMap<(SmolStr, Vec<SmolStr>), bool>,
    /// Camera as the robot's joints bear it. Where that is not said, it is above the middle of the base and
    /// turns up and down without an end.
    pub eye: Option<CameraMount>,
}

impl SimOptions {
    /// The same options with further facts at the start. Facts about any entity, and those that are not
    /// known, are left out: the world is as it is.
    #[must_use]
    pub fn with_facts(mut self, facts: impl IntoIterator<Item = (Query, Truth)>) -> Self {
        for (query, truth) in facts {
            let Query::Fact { fluent, args } = query else { continue };
            let name = |arg: &Pattern| match arg {
                Pattern::Is(Value::Entity(id) | Value::Case(id)) => Some(id.clone()),
                Pattern::Is(_) | Pattern::Any => None,
            };
            let args: Option<Vec<SmolStr>> = args.iter().map(name).collect();
            if let (Some(args), Truth::True | Truth::False) = (args, truth) {
                self.initial_facts.insert((fluent, args), truth == Truth::True);
            }
        }
        self
    }

    /// The same options without the facts that the scene says by itself: in a room that differs from the
    /// scene, these are what the robot believes, and only a state given beside the scene holds in both.
    fn beside_scene(&self, robot: &Robot, scene: &Scene) -> Self {
        let mut options = Self { initial_facts: InitialFacts::new(), ..self.clone() };
        let told = SimWorld::new(robot, scene, &options);
        let is_beside = |((fluent, args), holds): &(&(SmolStr, Vec<SmolStr>), &bool)| {
            let args: Vec<&str> = args.iter().map(SmolStr::as_str).collect();
            told.fact(fluent, &args, &options.initial_facts) != Some(**holds)
        };
        let beside: Vec<_> = self.initial_facts.iter().filter(is_beside).collect();
        options.initial_facts = beside.into_iter().map(|(fact, holds)| (fact.clone(), *holds)).collect();
        options
    }
}

/// Scripted answers of people.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct PersonScript {
    /// Answers to `ask` and `choose`, in order; `None` refuses. Where they have run out, people say "yes" and
    /// take the first thing that they are offered.
    pub answers: Vec<Option<String>>,
}
