//! A room made ready: a robot in a world, with what stands around as solids, and the map of where its base can drive.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock};

use motet_robots::scene::{Entity, EntityShape, Scene};
use smol_str::SmolStr;

use crate::collision::{CollisionModel, LinkSolid, Solid};
use crate::planning::base::base_map::BaseMap;
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::{AllowedCollisions, Contact};
use crate::planning::scene::grid_index::{Obstacle, ObstacleIndex};
use crate::planning::scene::obstacle::{solid_shape, solids};
use crate::planning::scene::robot_model::RobotModel;
use crate::planning::scene::scene_state::SceneState;
use crate::simd::BatchModel;

/// A robot in a world. Made once for all queries of one world; O(entities), and O(obstacles × cells of the map) when it is first
/// asked how the base drives.
#[derive(Clone, Debug)]
pub struct QueryContext<'w> {
    pub(crate) model: &'w RobotModel,
    pub(crate) scene: &'w Scene,
    pub(crate) state: &'w SceneState,
    /// With what is in the hand.
    pub(crate) body: CollisionModel,
    /// Index of the part that is in the hand.
    pub(crate) held: Option<usize>,
    pub(crate) obstacles: ObstacleIndex,
    /// Made when it is first asked for, or taken from [`BaseMapCache`].
    map: OnceLock<Option<Arc<BaseMap>>>,
    maps: Option<&'w BaseMapCache>,
    /// Straight ways out of where the robot is, if it has no room to turn there; made when they are first asked for.
    pub(crate) escapes: OnceLock<Vec<(Configuration, [f64; 2])>>,
    /// Components of the map to which ways lead from where the robot is.
    pub(crate) homes: OnceLock<Vec<u32>>,
    /// What the robot touches where it is.
    start_contact: OnceLock<Option<Contact>>,
    /// The robot for a quick look, and for each variable whether it moves it; made when it is first asked for.
    pub(crate) batch_model: OnceLock<Option<(BatchModel, Vec<bool>)>>,
    /// Index of the container that is about to open or close, whose moving parts are not among the things.
    pub(crate) opening: Option<usize>,
    /// Entities with a mesh for a shape.
    unseen: Vec<SmolStr>,
}

/// Maps of where a robot's base can drive in a scene, by what else the world is like: made once, whatever the base does.
#[derive(Debug, Default)]
pub struct BaseMapCache(Mutex<BTreeMap<Vec<u8>, Arc<BaseMap>>>);

impl BaseMapCache {
    /// The most that are kept; beyond, all are forgotten.
    const MOST: usize = 64;

    fn get(&self, key: &[u8], make: impl Fn() -> Arc<BaseMap>) -> Arc<BaseMap> {
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

impl<'w> QueryContext<'w> {
    /// Makes a room ready.
    #[must_use]
    pub fn new(model: &'w RobotModel, scene: &'w Scene, state: &'w SceneState) -> Self {
        let mut obstacles = Vec::new();
        for (entity, at) in scene.entities.values().zip(0..) {
            let parts = solids(entity, state).into_iter();
            obstacles.extend(parts.map(|solid| Obstacle::new(at, solid)));
        }
        let mut body = model.body().clone();
        let mut held = None;
        if let (Some((id, tip_from_object)), Some(hand)) = (&state.held, model.hand())
            && let Some(shape) = scene.entities.get(id).and_then(solid_shape)
        {
            held = Some(body.parts().len());
            let part = LinkSolid { link: hand.tip, solid: Solid::new(tip_from_object, shape) };
            body = body.with_attached(part, |link| hand.members.get(link) == Some(&true));
        }
        let is_mesh = |entity: &&Entity| matches!(entity.shape, Some(EntityShape::Mesh { .. }));
        let unseen = scene.entities.values().filter(is_mesh).map(|entity| entity.id.clone()).collect();
        Self {
            model,
            scene,
            state,
            body,
            held,
            obstacles: ObstacleIndex::new(obstacles),
            map: OnceLock::new(),
            maps: None,
            escapes: OnceLock::new(),
            homes: OnceLock::new(),
            start_contact: OnceLock::new(),
            batch_model: OnceLock::new(),
            opening: None,
            unseen,
        }
    }

    /// What the robot touches where it is.
    pub(crate) fn start_contact(&self) -> Option<&Contact> {
        let robot = &self.state.robot;
        // Parts that never move against each other are looked at here alone.
        let find = || self.along(robot, robot).contact_exactly(robot, AllowedCollisions::default());
        self.start_contact.get_or_init(find).as_ref()
    }

    /// The room with all that is otherwise made when it is first asked for.
    #[must_use]
    pub fn ready(self) -> Self {
        self.prepare();
        self
    }

    /// The room with maps that were made for others of the same machine and scene, and that keep what is made for this one.
    #[must_use]
    pub fn with_base_maps(self, maps: &'w BaseMapCache) -> Self {
        Self { maps: Some(maps), ..self }
    }

    /// The same machine, scene and maps in another world.
    pub(crate) fn in_state<'o>(&self, state: &'o SceneState) -> QueryContext<'o>
    where
        'w: 'o,
    {
        let context = QueryContext::new(self.model, self.scene, state);
        QueryContext { maps: self.maps, ..context }
    }

    /// Where the base can drive with the arm as it is; `None` where it does not drive.
    pub(crate) fn map(&self) -> Option<&BaseMap> {
        let make = || Arc::new(BaseMap::new(self, &self.state.robot.joints));
        let map = self.map.get_or_init(|| {
            self.model.drives().then(|| match self.maps {
                Some(maps) => maps.get(&self.state.key_without_base(), make),
                None => make(),
            })
        });
        map.as_deref()
    }

    /// The robot that is asked.
    #[must_use]
    pub fn model(&self) -> &RobotModel {
        self.model
    }

    /// Where the robot is.
    #[must_use]
    pub fn start(&self) -> &Configuration {
        &self.state.robot
    }

    /// What stands around: ids of entities with a solid of theirs, in the order of the scene.
    pub fn obstacles(&self) -> impl Iterator<Item = (SmolStr, &Solid)> {
        self.obstacles.iter().map(|obstacle| (self.name(obstacle.entity), &obstacle.solid))
    }

    /// The solids of the robot in a state, with what it holds.
    #[must_use]
    pub fn robot_at(&self, configuration: &Configuration) -> Vec<Solid> {
        self.body.placed(&self.model.map_from_links(configuration))
    }

    /// Why nothing can be said in this room, if so: something in it has a shape that is not known.
    pub(crate) fn blind_spot(&self) -> Option<String> {
        if let Some(entity) = self.unseen.first() {
            return Some(format!("the shape of `{entity}` is a mesh, which is not read"));
        }
        let link =
            self.body.uncovered_links().first().and_then(|link| self.model.tree().links().get(*link))?;
        Some(format!("the shape of the robot's link `{link}` is a mesh, which is not read"))
    }

    /// An entity with its index.
    pub(crate) fn entity(&self, id: &str) -> Option<(usize, &'w Entity)> {
        let (at, _, entity) = self.scene.entities.get_full(id)?;
        Some((at, entity))
    }

    /// The entity's solids, as they stand.
    pub(crate) fn solids_of(&self, entity: usize) -> impl Iterator<Item = &Solid> {
        self.obstacles
            .iter()
            .filter(move |obstacle| obstacle.entity == entity)
            .map(|obstacle| &obstacle.solid)
    }

    /// The name of an entity by index.
    pub(crate) fn name(&self, entity: usize) -> SmolStr {
        self.scene.entities.get_index(entity).map(|(id, _)| id.clone()).unwrap_or_default()
    }
}
