//! Geometry of a robot in a scene: motion queries with a cache of answers.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use motet_geometry::planning::{
    BaseMapCache, Infeasible, InfeasibleReason, KeptRegion, MotionAnswer, MotionQuery, MotionWitness,
    PlanningScene, QueryContext, ReachLength, RobotModel, SceneState, SearchBudget, UnknownReason,
};
use motet_robots::card::{CameraMount, Robot};
use motet_robots::scene::{Entity, Grip, Placement, Scene};
use motet_robots::urdf::Urdf;
use motet_stdlib::lang;
use rustc_hash::FxHashMap;
use smol_str::{SmolStr, format_smolstr};

use super::plain_reason::target;
use crate::declare::Library;
use crate::environment::InitialState;
use crate::ir::Fluent;

/// Maximal number of cached answers; beyond it the cache is cleared. A repeated query has the same answer.
const MOST_ANSWERS: usize = 20_000;

/// A robot's body in a scene, for motion queries. Shared by all sessions with this robot, scene and state.
#[derive(Debug)]
pub struct Geometry {
    machine: RobotModel,
    scene: Scene,
    start: Result<Arc<Fingerprinted>, SmolStr>,
    budget: SearchBudget,
    memo: Mutex<Memo>,
    maps: BaseMapCache,
    /// Things that are nobody knows exactly where.
    unplaced: Vec<SmolStr>,
    /// The scene with one of these at a guessed pose, for queries about it.
    guessed: BTreeMap<SmolStr, Scene>,
}

#[derive(Debug, Default)]
struct Memo {
    answers: FxHashMap<(Box<[u8]>, MotionQuery), Arc<MotionAnswer>>,
    after: FxHashMap<(Box<[u8]>, MotionQuery, SceneChange), Next>,
    told: FxHashMap<(Box<[u8]>, MotionQuery), Infeasible>,
}

/// Tolerance of the limits of a joint that a driver reports, in rad or m.
const SENSED: f64 = 0.02;

/// World with its fingerprint; equal fingerprints mean equal worlds.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Fingerprinted {
    pub(super) world: SceneState,
    pub(super) key: Box<[u8]>,
}

/// World after a motion; `None` if it is unknown.
type Next = Option<Arc<Fingerprinted>>;

/// Change of the scene by a motion, beside the robot's own pose.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum SceneChange {
    /// The robot stands at the end of the path.
    Gone,
    /// The hand holds the thing, and the robot stands where it stood.
    Taken,
    /// The thing stands where it was put, and the robot stands where it stood.
    Put,
    /// A person has the thing, and the robot stands where it stood.
    Given,
    /// A container is open that was closed, or the reverse.
    Travelled,
}

impl Geometry {
    /// Builds the geometry of a robot in a scene and an initial state. O(parts² of the robot).
    #[must_use]
    pub fn new(
        robot: &Robot,
        urdf: &Urdf,
        scene: &Scene,
        state: Option<&InitialState>,
        budget: SearchBudget,
    ) -> Self {
        let machine = RobotModel::new(robot, urdf);
        let mut scene = scene.clone();
        let start = begin(&machine, &mut scene, state);
        let (memo, maps) = (Mutex::default(), BaseMapCache::default());
        Self { machine, scene, start, budget, memo, maps, unplaced: Vec::new(), guessed: BTreeMap::new() }
    }

    /// The same robot in another scene, without an initial state.
    #[must_use]
    pub fn elsewhere(&self, scene: &Scene) -> Self {
        let mut scene = scene.clone();
        let start = begin(&self.machine, &mut scene, None);
        Self {
            machine: self.machine.clone(),
            scene,
            start,
            budget: self.budget,
            memo: Mutex::default(),
            maps: BaseMapCache::default(),
            unplaced: Vec::new(),
            guessed: BTreeMap::new(),
        }
    }

    /// The same robot in the same scene, where the world at the start is unknown for a reason.
    #[must_use]
    pub fn astray(&self, why: &str) -> Self {
        Self { start: Err(why.into()), ..self.elsewhere(&self.scene) }
    }

    /// The geometry and the world in which the hand holds its thing as it felt, and things stand where they
    /// were seen. The geometry is a new one only for things that the scene lacks or that it has on another
    /// support.
    pub(super) fn seeing(
        this: &Arc<Self>,
        at: &Fingerprinted,
        felt: Option<&Grip>,
        things: impl Iterator<Item = Entity>,
    ) -> (Arc<Self>, Arc<Fingerprinted>) {
        let gripping = felt.and_then(|grip| at.world.gripping(&this.machine, &this.scene, grip));
        let (mut world, mut scene) = (gripping.unwrap_or_else(|| at.world.clone()), None);
        for thing in things {
            match this.scene.entities.get(&thing.id) {
                Some(known) if (&known.on, &known.inside) == (&thing.on, &thing.inside) => {
                    let there = Entity { pose: thing.pose, ..known.clone() };
                    world.moved.remove(&thing.id);
                    world.moved.extend(world.pose(&there).map(|pose| (thing.id.clone(), pose)));
                }
                Some(_) | None => {
                    world.moved.remove(&thing.id);
                    let scene: &mut Scene = scene.get_or_insert_with(|| this.scene.clone());
                    scene.entities.insert(thing.id.clone(), thing);
                }
            }
        }
        let geometry = scene.map_or_else(|| Arc::clone(this), |scene| Arc::new(this.elsewhere(&scene)));
        (geometry, Arc::new(fingerprinted(world)))
    }

    /// The world in which the robot stands elsewhere: the pose of its base, and joints by name. `None` if a
    /// joint is beyond its limits.
    pub(super) fn standing(
        &self,
        at: &Fingerprinted,
        base: [f64; 3],
        joints: &BTreeMap<SmolStr, f64>,
    ) -> Option<Arc<Fingerprinted>> {
        let mut world = at.world.clone();
        world.robot.base = base;
        for (value, dof) in world.robot.joints.iter_mut().zip(self.machine.tree().dofs()) {
            let Some(told) = joints.get(&dof.name) else { continue };
            let is_within = |(least, most): (f64, f64)| (least - SENSED..=most + SENSED).contains(told);
            if !told.is_finite() || dof.limits.is_some_and(|limits| !is_within(limits)) {
                return None;
            }
            *value = *told;
        }
        Some(Arc::new(fingerprinted(world)))
    }

    /// The same geometry, in which some things have no exact pose, as the scene leaves it out: they may be in
    /// the way of any motion, so no motion counts as feasible before it is tried, and a thing itself is
    /// refused only for what holds wherever it stands near the guess, such as its height.
    #[must_use]
    pub fn with_unplaced(mut self, things: Vec<(SmolStr, Option<Placement>)>) -> Self {
        for (id, guess) in things {
            if let Some(pose) = guess {
                let mut scene = self.scene.clone();
                scene.entities.get_mut(&id).into_iter().for_each(|thing| thing.pose = Some(pose));
                self.guessed.insert(id.clone(), scene);
            }
            self.unplaced.push(id);
        }
        self
    }

    /// Reason for which no motion is certain, if a thing has no exact pose.
    pub(super) fn unplaced(&self) -> Option<SmolStr> {
        let first = self.unplaced.first()?;
        Some(format_smolstr!("it is not known exactly where `{first}` is"))
    }

    /// Camera of the robot, as [`RobotModel::camera_mount`] tells it.
    #[must_use]
    pub fn eye(&self) -> Option<CameraMount> {
        self.machine.camera_mount()
    }

    /// World at the start, or the reason why it is unknown.
    pub(super) fn start(&self) -> Result<Arc<Fingerprinted>, SmolStr> {
        self.start.clone()
    }

    /// Model of the robot.
    #[must_use]
    pub fn machine(&self) -> &RobotModel {
        &self.machine
    }

    pub(super) fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Returns whether a container is open in a world; `None` if it has no door.
    pub(super) fn is_open(&self, world: &SceneState, id: &str) -> Option<bool> {
        let entity = self.scene.entities.get(id)?;
        entity.travel.as_ref()?;
        Some(world.is_open(entity))
    }

    /// Truth of `holding` or `open` in a world; `None` for any other fluent.
    pub(super) fn holds(
        &self,
        library: &Library,
        world: &SceneState,
        fluent: Fluent,
        entity: &str,
    ) -> Option<bool> {
        let items = &library.lang_items;
        if items.holding == Some(fluent) {
            return Some(world.holds(entity));
        }
        self.is_open(world, entity).filter(|_| items.open == Some(fluent))
    }

    /// Answers a query in a world, from the cache if it is there.
    pub(super) fn answer(&self, at: &Fingerprinted, query: &MotionQuery) -> Arc<MotionAnswer> {
        let key = (at.key.clone(), query.clone());
        if let Some(known) = self.memo().as_ref().and_then(|memo| memo.answers.get(&key).cloned()) {
            return known;
        }
        let is_guessed = |id: &&SmolStr| self.guessed.contains_key(*id) && !at.world.moved.contains_key(*id);
        let answer = match target(query).filter(is_guessed) {
            Some(id) => self.guessed_answer(&at.world, query, id),
            None => self.room(&at.world).answer(query, self.budget),
        };
        let answer = Arc::new(answer);
        if let Some(mut memo) = self.memo() {
            if memo.answers.len() >= MOST_ANSWERS {
                *memo = Memo::default();
            }
            memo.answers.insert(key, Arc::clone(&answer));
        }
        answer
    }

    /// Answer about a thing at a guessed pose: only what does not depend on where exactly it stands.
    fn guessed_answer(&self, world: &SceneState, query: &MotionQuery, id: &SmolStr) -> MotionAnswer {
        let unknown = || {
            let why = format!("it is not known exactly where `{id}` is");
            MotionAnswer::Unknown(UnknownReason::Because(why))
        };
        let Some(scene) = self.guessed.get(id) else { return unknown() };
        let answer = QueryContext::new(&self.machine, scene, world).answer(query, self.budget);
        let lasts = |why: &Infeasible| {
            why.certified
                && matches!(
                    why.reason,
                    InfeasibleReason::OutOfReach { length: ReachLength::Height, .. }
                        | InfeasibleReason::TooHeavy { .. }
                        | InfeasibleReason::TooWide { .. }
                )
        };
        match answer {
            MotionAnswer::Infeasible(why) if lasts(&why) => MotionAnswer::Infeasible(why),
            MotionAnswer::Feasible(_) | MotionAnswer::Infeasible(_) | MotionAnswer::Unknown(_) => unknown(),
        }
    }

    /// The world with these regions, which the robot may not enter, in place of its own.
    pub(super) fn keeping(&self, at: &Arc<Fingerprinted>, kept: Vec<KeptRegion>) -> Arc<Fingerprinted> {
        if at.world.kept == kept {
            return Arc::clone(at);
        }
        Arc::new(fingerprinted(SceneState { kept, ..at.world.clone() }))
    }

    /// Distance in m of the robot and of what it holds to a region; 0 within it.
    pub(super) fn distance(&self, world: &SceneState, region: &KeptRegion) -> f64 {
        region.distance(&PlanningScene::new(&self.machine, &self.scene, world).robot_at(&world.robot))
    }

    /// Explanation of infeasibility in a world, with a proposed change.
    pub(super) fn explained(&self, at: &Fingerprinted, query: &MotionQuery, why: &Infeasible) -> Infeasible {
        let key = (at.key.clone(), query.clone());
        if let Some(known) = self.memo().and_then(|memo| memo.told.get(&key).cloned()) {
            return known;
        }
        let told = self.room(&at.world).explain(query, why, self.budget);
        if let Some(mut memo) = self.memo() {
            memo.told.insert(key, told.clone());
        }
        told
    }

    /// Returns whether the robot can grasp a thing from its pose; `None` if neither answer is proven.
    pub(super) fn reaches(&self, at: &Fingerprinted, object: &str) -> Option<bool> {
        match &*self.answer(at, &MotionQuery::Reach(object.into(), None)) {
            MotionAnswer::Feasible(_) => Some(true),
            MotionAnswer::Infeasible(why) => why.certified.then_some(false),
            MotionAnswer::Unknown(_) => None,
        }
    }

    /// World after a motion that was found; `None` if it is unknown.
    pub(super) fn after(
        &self,
        at: &Fingerprinted,
        query: &MotionQuery,
        change: SceneChange,
        motion: &MotionWitness,
    ) -> Option<Arc<Fingerprinted>> {
        let key = (at.key.clone(), query.clone(), change);
        if let Some(known) = self.memo().and_then(|memo| memo.after.get(&key).cloned()) {
            return known;
        }
        let room = self.room(&at.world);
        let world = match change {
            SceneChange::Gone => Some(room.after_move(motion)),
            SceneChange::Taken => room.after_reach(motion),
            SceneChange::Put => room.after_put(motion),
            SceneChange::Travelled => room.after_pull(motion),
            SceneChange::Given => match query {
                MotionQuery::Offer(_, to) => room.after_offer(to),
                _ => None,
            },
        };
        let world = world.map(|world| Arc::new(fingerprinted(world)));
        if let Some(mut memo) = self.memo() {
            memo.after.insert(key, world.clone());
        }
        world
    }

    /// World after a motion that was found, but for the place of the robot; `None` if it is unknown.
    pub(super) fn outcome(
        &self,
        at: &Fingerprinted,
        change: SceneChange,
        motion: &MotionWitness,
    ) -> Option<Arc<Fingerprinted>> {
        let room = self.room(&at.world);
        let world = match change {
            SceneChange::Taken => room.taken(motion),
            SceneChange::Put => room.put_down(motion),
            SceneChange::Travelled => room.travelled(motion),
            SceneChange::Gone | SceneChange::Given => None,
        };
        world.map(|world| Arc::new(fingerprinted(world)))
    }

    /// The geometry and the world in which nobody knows exactly where a thing is, and the hand does not hold
    /// it. What stood somewhere is near that place.
    pub(super) fn without(&self, at: &Fingerprinted, id: &SmolStr) -> (Arc<Self>, Arc<Fingerprinted>) {
        let (mut scene, mut world) = (self.scene.clone(), at.world.clone());
        let mut guess = None;
        if let Some(thing) = scene.entities.get_mut(id) {
            guess = at.world.pose(thing).filter(|_| !at.world.holds(id)).map(|pose| {
                let (roll, pitch, yaw) = pose.rotation.euler_angles();
                Placement { xyz: pose.translation.vector.into(), rpy: [roll, pitch, yaw] }
            });
            (thing.pose, thing.on, thing.inside) = (None, None, None);
        }
        world.moved.remove(id);
        world.held.take_if(|(held, _)| held == id);
        let geometry = self.elsewhere(&scene).with_unplaced(vec![(id.clone(), guess)]);
        (Arc::new(geometry), Arc::new(fingerprinted(world)))
    }

    /// Search budget of a motion.
    pub(super) fn budget(&self) -> SearchBudget {
        self.budget
    }

    pub(super) fn room<'w>(&'w self, world: &'w SceneState) -> QueryContext<'w> {
        QueryContext::new(&self.machine, &self.scene, world).with_base_maps(&self.maps)
    }

    /// Cache of answers; `None` after a panic of another thread, which only loses the cache.
    fn memo(&self) -> Option<std::sync::MutexGuard<'_, Memo>> {
        self.memo.lock().ok()
    }
}

/// World at the start of a scene and a state. Adds `start` to the places of the scene.
fn begin(
    machine: &RobotModel,
    scene: &mut Scene,
    state: Option<&InitialState>,
) -> Result<Arc<Fingerprinted>, SmolStr> {
    if let Some(state) = state {
        state.put_into(scene)?;
    }
    let is_door = |entity: &&Entity| entity.travel.is_some() && entity.open.is_none();
    if let Some(door) = scene.entities.values().find(is_door) {
        return Err(format_smolstr!("it is unknown whether `{}` is open", door.id));
    }
    if let Some(Some(held)) = &scene.robot.holding
        && scene.entities.get(held).is_none_or(|entity| entity.shape.is_none())
    {
        return Err(format_smolstr!("the shape of `{held}`, which the hand holds, is unknown"));
    }
    let [x, y, yaw] = scene.robot.base;
    let pose = Placement { xyz: [x, y, 0.0], rpy: [0.0, 0.0, yaw] };
    let start = lang::entities::START;
    scene.entities.entry(start.into()).or_insert_with(|| Entity::place(start.into(), pose));
    Ok(Arc::new(fingerprinted(SceneState::new(machine, scene))))
}

fn fingerprinted(world: SceneState) -> Fingerprinted {
    let key = world.fingerprint().into_boxed_slice();
    Fingerprinted { world, key }
}

/// Answer to the question whether the robot can reach a thing.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Access {
    /// A path to the thing was found, and the motion at its end.
    Feasible,
    /// The search found no motion.
    Infeasible {
        /// Reason: `too heavy: …`.
        why: SmolStr,
        /// True if infeasibility is proven; false if the search ended without a result.
        is_certified: bool,
    },
    /// The search gave no answer, for this reason.
    Unknown(SmolStr),
}

impl Geometry {
    /// Decides whether the robot, from its pose at the start, can drive to a thing and there grasp it, or
    /// open or close it by its handle. At most two searches, whose answers are cached.
    #[must_use]
    pub fn access(&self, id: &str) -> Access {
        let start = match self.start() {
            Ok(start) => start,
            Err(why) => return Access::Unknown(why),
        };
        let Some(entity) = self.scene().entities.get(id) else {
            return Access::Unknown(format_smolstr!("the scene has no `{id}`"));
        };
        if self.scene().robot.holding.as_ref().and_then(Option::as_ref) == Some(&entity.id) {
            return Access::Feasible;
        }
        if let Some(around) = &entity.inside
            && self.is_open(&start.world, around) == Some(false)
        {
            return Access::Unknown(format_smolstr!("it is in {around}, which is closed"));
        }
        let (mut at, id) = (start, entity.id.clone());
        if self.machine().drives() {
            let query = MotionQuery::GoTo(id.clone());
            let answer = self.answer(&at, &query);
            let MotionAnswer::Feasible(motion) = &*answer else { return said(&answer) };
            match self.after(&at, &query, SceneChange::Gone, motion) {
                Some(there) => at = Arc::clone(&there),
                None => return Access::Unknown(SmolStr::new_static("the end of the path is unknown")),
            }
        }
        let query = match self.is_open(&at.world, &id) {
            Some(true) => MotionQuery::Push(id),
            Some(false) => MotionQuery::Pull(id),
            None if entity.kind == lang::kinds::OBJECT => MotionQuery::Reach(id, None),
            None => return Access::Feasible,
        };
        said(&self.answer(&at, &query))
    }
}

fn said(answer: &MotionAnswer) -> Access {
    match answer {
        MotionAnswer::Feasible(_) => Access::Feasible,
        MotionAnswer::Infeasible(why) => {
            let is_certified = why.certified;
            Access::Infeasible { why: why.says().into(), is_certified }
        }
        MotionAnswer::Unknown(UnknownReason::Budget) => {
            Access::Unknown(SmolStr::new_static("the search was cut short"))
        }
        MotionAnswer::Unknown(UnknownReason::Because(why)) => Access::Unknown(why.as_str().into()),
    }
}
