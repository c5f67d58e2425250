//! What geometry needs, made once for a robot and a scene, with the answers that were given so far.

use std::sync::{Arc, Mutex};

use motet_geometry::planning::{
    BaseMapCache, Configuration as Placed, Infeasible, MotionAnswer, MotionQuery, MotionWitness,
    QueryContext, RobotModel, SceneState, SearchBudget,
};
use motet_robots::card::Robot;
use motet_robots::scene::{Entity, Placement, Scene};
use motet_robots::urdf::Urdf;
use rustc_hash::FxHashMap;
use smol_str::{SmolStr, format_smolstr};

use super::ways::Keyed;
use crate::world::State;

/// The most answers that are kept; beyond, all are forgotten. They are the same when asked again.
const MOST_ANSWERS: usize = 20_000;

/// A robot's body in a scene, of which motions are asked.
#[derive(Debug)]
pub struct Geometry {
    machine: RobotModel,
    scene: Scene,
    start: Result<Arc<Keyed>, SmolStr>,
    budget: SearchBudget,
    memo: Mutex<Memo>,
    maps: BaseMapCache,
}

#[derive(Debug, Default)]
struct Memo {
    answers: FxHashMap<(Box<[u8]>, MotionQuery), Arc<MotionAnswer>>,
    after: FxHashMap<(Box<[u8]>, MotionQuery, Change), Next>,
    told: FxHashMap<(Box<[u8]>, MotionQuery), Infeasible>,
}

/// The world after a motion, where it is known.
type Next = Option<Arc<Keyed>>;

/// What a step leaves behind beside where the base and the arm went.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(super) enum Change {
    /// The robot is where the way led.
    Gone,
    /// The robot is where it was, with the thing in its hand.
    Taken,
    /// The robot is where it was, the thing where it was put.
    Put,
    /// The robot is where it was, the thing with a person.
    Given,
    /// What was closed is open, or the other way round.
    Travelled,
}

impl Geometry {
    /// A robot in a scene, in a state where one is given. O(parts² of the robot).
    #[must_use]
    pub fn new(
        robot: &Robot,
        urdf: &Urdf,
        scene: &Scene,
        state: Option<&State>,
        budget: SearchBudget,
    ) -> Self {
        let machine = RobotModel::new(robot, urdf);
        let mut scene = scene.clone();
        let start = begin(&machine, &mut scene, state);
        Self { machine, scene, start, budget, memo: Mutex::default(), maps: BaseMapCache::default() }
    }

    /// The same robot in another scene, in no further state.
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
        }
    }

    /// Where the card's first camera is of a robot that is ready to look, in the posture `start` where it has one: in the frame
    /// of the base on the floor, in m. None where the card does not say which link it is.
    #[must_use]
    pub fn eye(&self) -> Option<[f64; 3]> {
        let machine = &self.machine;
        let frame = machine.card().cameras.values().next()?.frame.as_ref()?;
        let link = machine.tree().link(frame).ok()?;
        let joints = machine.posture("start", machine.rest()).unwrap_or_else(|| machine.rest().to_vec());
        let poses = machine.map_from_links(&Placed { base: [0.0; 3], joints });
        Some(poses.get(link)?.translation.vector.into())
    }

    /// The world at the start, or why it is not known.
    pub(super) fn start(&self) -> Result<Arc<Keyed>, SmolStr> {
        self.start.clone()
    }

    pub(super) fn machine(&self) -> &RobotModel {
        &self.machine
    }

    pub(super) fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Whether a container with a door is open in a world; none of what has no door.
    pub(super) fn is_open(&self, world: &SceneState, id: &str) -> Option<bool> {
        let entity = self.scene.entities.get(id)?;
        entity.travel.as_ref()?;
        Some(world.is_open(entity))
    }

    /// Answers a query in a world.
    pub(super) fn answer(&self, at: &Keyed, query: &MotionQuery) -> Arc<MotionAnswer> {
        let key = (at.key.clone(), query.clone());
        if let Some(known) = self.memo().as_ref().and_then(|memo| memo.answers.get(&key).cloned()) {
            return known;
        }
        let answer = Arc::new(self.room(&at.world).answer(query, self.budget));
        if let Some(mut memo) = self.memo() {
            if memo.answers.len() >= MOST_ANSWERS {
                *memo = Memo::default();
            }
            memo.answers.insert(key, Arc::clone(&answer));
        }
        answer
    }

    /// Why a motion is infeasible in a world, as it is told: with what would help.
    pub(super) fn explained(&self, at: &Keyed, query: &MotionQuery, why: &Infeasible) -> Infeasible {
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

    /// Whether a thing can be grasped from where the robot is; none where neither was proven.
    pub(super) fn reaches(&self, at: &Keyed, object: &str) -> Option<bool> {
        match &*self.answer(at, &MotionQuery::Reach(object.into(), None)) {
            MotionAnswer::Feasible(_) => Some(true),
            MotionAnswer::Infeasible(why) => why.certified.then_some(false),
            MotionAnswer::Unknown(_) => None,
        }
    }

    /// The world after a motion that was found; none where it is not known.
    pub(super) fn after(
        &self,
        at: &Keyed,
        query: &MotionQuery,
        change: Change,
        way: &MotionWitness,
    ) -> Option<Arc<Keyed>> {
        let key = (at.key.clone(), query.clone(), change);
        if let Some(known) = self.memo().and_then(|memo| memo.after.get(&key).cloned()) {
            return known;
        }
        let room = self.room(&at.world);
        let world = match change {
            Change::Gone => Some(room.after_move(way)),
            Change::Taken => room.after_reach(way),
            Change::Put => room.after_put(way),
            Change::Travelled => room.after_pull(way),
            Change::Given => match query {
                MotionQuery::Offer(_, to) => room.after_offer(to),
                _ => None,
            },
        };
        let world = world.map(|world| Arc::new(keyed(world)));
        if let Some(mut memo) = self.memo() {
            memo.after.insert(key, world.clone());
        }
        world
    }

    fn room<'w>(&'w self, world: &'w SceneState) -> QueryContext<'w> {
        QueryContext::new(&self.machine, &self.scene, world).with_base_maps(&self.maps)
    }

    /// A lock that was poisoned by a panic elsewhere only loses what was kept.
    fn memo(&self) -> Option<std::sync::MutexGuard<'_, Memo>> {
        self.memo.lock().ok()
    }
}

/// The world of a scene and a state. `start` becomes a place of the scene.
fn begin(machine: &RobotModel, scene: &mut Scene, state: Option<&State>) -> Result<Arc<Keyed>, SmolStr> {
    for (fact, (holds, _)) in state.into_iter().flat_map(|state| &state.facts) {
        let Some((fluent, args)) = fact.split_once('(') else { continue };
        let arg = args.trim_end_matches(')').trim().trim_matches('`');
        match fluent.trim() {
            "open" => {
                if let Some(entity) = scene.entities.get_mut(arg) {
                    entity.open = *holds;
                }
            }
            "holding" if *holds == Some(true) => scene.robot.holding = Some(Some(arg.into())),
            "at" | "on" | "in" | "holding" => {
                return Err(format_smolstr!(
                    "the state says `{fact}`, and the scene does not say where that is"
                ));
            }
            _ => {}
        }
    }
    let is_door = |entity: &&Entity| entity.travel.is_some() && entity.open.is_none();
    if let Some(door) = scene.entities.values().find(is_door) {
        return Err(format_smolstr!("it is not known whether `{}` is open", door.id));
    }
    if let Some(Some(held)) = &scene.robot.holding
        && scene.entities.get(held).is_none_or(|entity| entity.shape.is_none())
    {
        return Err(format_smolstr!("the shape of `{held}`, which the hand holds, is not known"));
    }
    let [x, y, yaw] = scene.robot.base;
    let pose = Placement { xyz: [x, y, 0.0], rpy: [0.0, 0.0, yaw] };
    scene.entities.entry("start".into()).or_insert_with(|| Entity::place("start".into(), pose));
    Ok(Arc::new(keyed(SceneState::new(machine, scene))))
}

fn keyed(world: SceneState) -> Keyed {
    let key = world.fingerprint().into_boxed_slice();
    Keyed { world, key }
}
