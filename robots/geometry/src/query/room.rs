//! A room made ready: a robot in a world, with what stands around as solids, and the map of where its base can drive.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock};

use motet_robots::scene::{Entity, EntityShape, Scene};
use smol_str::SmolStr;

use super::machine::Machine;
use super::map::Map;
use super::obstacle::{solid_shape, solids};
use super::state::State;
use super::things::{Thing, Things};
use super::touch::{Allowed, Touch};
use super::world::World;
use crate::collision::{CollisionModel, LinkSolid, Solid};
use crate::simd::BatchModel;

/// How far everything stays from everything else, in m.
pub const GAP: f64 = 0.002;

/// A robot in a world. Made once for all queries of one world; O(entities), and O(obstacles × cells of the map) when it is first
/// asked how the base drives.
#[derive(Clone, Debug)]
pub struct Room<'w> {
    pub(super) machine: &'w Machine,
    pub(super) scene: &'w Scene,
    pub(super) world: &'w World,
    /// With what is in the hand.
    pub(super) body: CollisionModel,
    /// Index of the part that is in the hand.
    pub(super) held: Option<usize>,
    pub(super) things: Things,
    /// Made when it is first asked for, or taken from [`Maps`].
    map: OnceLock<Option<Arc<Map>>>,
    maps: Option<&'w Maps>,
    /// Straight ways out of where the robot is, if it has no room to turn there; made when they are first asked for.
    pub(super) escapes: OnceLock<Vec<(State, [f64; 2])>>,
    /// Components of the map to which ways lead from where the robot is.
    pub(super) homes: OnceLock<Vec<u32>>,
    /// What the robot touches where it is.
    at_start: OnceLock<Option<Touch>>,
    /// The robot for a quick look, and for each variable whether it moves it; made when it is first asked for.
    pub(super) batch_model: OnceLock<Option<(BatchModel, Vec<bool>)>>,
    /// Index of the container that is about to open or close, whose moving parts are not among the things.
    pub(super) opening: Option<usize>,
    /// Entities with a mesh for a shape.
    uncovered_links: Vec<SmolStr>,
}

/// Maps of where a robot's base can drive in a scene, by what else the world is like: made once, whatever the base does.
#[derive(Debug, Default)]
pub struct Maps(Mutex<BTreeMap<Vec<u8>, Arc<Map>>>);

impl Maps {
    /// The most that are kept; beyond, all are forgotten.
    const MOST: usize = 64;

    fn get(&self, key: &[u8], make: impl Fn() -> Arc<Map>) -> Arc<Map> {
        // A lock that a panic elsewhere poisoned only loses what was kept.
        if let Some(known) = self.0.lock().ok().and_then(|maps| maps.get(key).cloned()) {
            return known;
        }
        let map = make();
        if let (true, Ok(mut maps)) = (map.is_anywhere(), self.0.lock()) {
            if maps.len() >= Self::MOST {
                maps.clear();
            }
            maps.insert(key.to_vec(), Arc::clone(&map));
        }
        map
    }
}

impl<'w> Room<'w> {
    /// Makes a room ready.
    #[must_use]
    pub fn new(machine: &'w Machine, scene: &'w Scene, world: &'w World) -> Self {
        let mut things = Vec::new();
        for (entity, at) in scene.entities.values().zip(0..) {
            let parts = solids(entity, world).into_iter();
            things.extend(parts.map(|solid| Thing::new(at, solid)));
        }
        let mut body = machine.body().clone();
        let mut held = None;
        if let (Some((id, tip_from_object)), Some(hand)) = (&world.held, machine.hand())
            && let Some(shape) = scene.entities.get(id).and_then(solid_shape)
        {
            held = Some(body.parts().len());
            let part = LinkSolid { link: hand.tip, solid: Solid::new(tip_from_object, shape) };
            body = body.with_attached(part, |link| hand.members.get(link) == Some(&true));
        }
        let is_mesh = |entity: &&Entity| matches!(entity.shape, Some(EntityShape::Mesh { .. }));
        let uncovered_links =
            scene.entities.values().filter(is_mesh).map(|entity| entity.id.clone()).collect();
        Self {
            machine,
            scene,
            world,
            body,
            held,
            things: Things::new(things),
            map: OnceLock::new(),
            maps: None,
            escapes: OnceLock::new(),
            homes: OnceLock::new(),
            at_start: OnceLock::new(),
            batch_model: OnceLock::new(),
            opening: None,
            uncovered_links,
        }
    }

    /// What the robot touches where it is.
    pub(super) fn at_start(&self) -> Option<&Touch> {
        let robot = &self.world.robot;
        // Parts that never move against each other are looked at here alone.
        let find = || self.along(robot, robot).touch_exactly(robot, Allowed::default());
        self.at_start.get_or_init(find).as_ref()
    }

    /// The room with all that is otherwise made when it is first asked for.
    #[must_use]
    pub fn ready(self) -> Self {
        self.prepare();
        self
    }

    /// The room with maps that were made for others of the same machine and scene, and that keep what is made for this one.
    #[must_use]
    pub fn sharing(self, maps: &'w Maps) -> Self {
        Self { maps: Some(maps), ..self }
    }

    /// The same machine, scene and maps in another world.
    pub(super) fn in_world<'o>(&self, world: &'o World) -> Room<'o>
    where
        'w: 'o,
    {
        let room = Room::new(self.machine, self.scene, world);
        Room { maps: self.maps, ..room }
    }

    /// Where the base can drive with the arm as it is; `None` where it does not drive.
    pub(super) fn map(&self) -> Option<&Map> {
        let make = || Arc::new(Map::new(self, &self.world.robot.joints));
        let map = self.map.get_or_init(|| {
            self.machine.drives().then(|| match self.maps {
                Some(maps) => maps.get(&self.world.key_without_base(), make),
                None => make(),
            })
        });
        map.as_deref()
    }

    /// The robot that is asked.
    #[must_use]
    pub fn machine(&self) -> &Machine {
        self.machine
    }

    /// Where the robot is.
    #[must_use]
    pub fn start(&self) -> &State {
        &self.world.robot
    }

    /// What stands around: ids of entities with a solid of theirs, in the order of the scene.
    pub fn obstacles(&self) -> impl Iterator<Item = (SmolStr, &Solid)> {
        self.things.iter().map(|thing| (self.name(thing.entity), &thing.solid))
    }

    /// The solids of the robot in a state, with what it holds.
    #[must_use]
    pub fn robot_at(&self, state: &State) -> Vec<Solid> {
        self.body.placed(&self.machine.map_from_links(state))
    }

    /// Why nothing can be said in this room, if so: something in it has a shape that is not known.
    pub(super) fn blind_spot(&self) -> Option<String> {
        if let Some(entity) = self.uncovered_links.first() {
            return Some(format!("the shape of `{entity}` is a mesh, which is not read"));
        }
        let link =
            self.body.uncovered_links().first().and_then(|link| self.machine.tree().links().get(*link))?;
        Some(format!("the shape of the robot's link `{link}` is a mesh, which is not read"))
    }

    /// An entity with its index.
    pub(super) fn entity(&self, id: &str) -> Option<(usize, &'w Entity)> {
        let (at, _, entity) = self.scene.entities.get_full(id)?;
        Some((at, entity))
    }

    /// The entity's solids, as they stand.
    pub(super) fn solids_of(&self, entity: usize) -> impl Iterator<Item = &Solid> {
        self.things.iter().filter(move |thing| thing.entity == entity).map(|thing| &thing.solid)
    }

    /// The name of an entity by index.
    pub(super) fn name(&self, entity: usize) -> SmolStr {
        self.scene.entities.get_index(entity).map(|(id, _)| id.clone()).unwrap_or_default()
    }
}
