//! Query context: a planning scene with everything that its queries compute once and share.
//!
//! The caches fill at first use, behind shared references, so that a context can be used from several
//! threads.

use std::collections::BTreeMap;
use std::ops::Deref;
use std::sync::{Arc, Mutex, OnceLock};

use motet_robots::clearance::Clearance;
use motet_robots::scene::Scene;

use super::base::BaseMap;
use super::scene::{Configuration, Contact, PlanningScene, RobotModel, SceneState};
use crate::simd::BatchModel;

/// Query context: a planning scene and the caches of its queries. Built in O(entities); the map of the
/// floor costs O(obstacles × cells) at its first use. `Send` and `Sync`.
#[derive(Clone, Debug)]
pub struct QueryContext<'w> {
    pub(crate) planning: PlanningScene<'w>,
    /// Map of the floor, built at first use or taken from [`BaseMapCache`]; `None` inside for a base that
    /// does not drive.
    map: OnceLock<Option<Arc<BaseMap>>>,
    maps: Option<&'w BaseMapCache>,
    /// Straight edges out of the start where it has no room to turn.
    pub(crate) escapes: OnceLock<Vec<(Configuration, [f64; 2])>>,
    /// Components of the map that the base can reach from the start.
    pub(crate) homes: OnceLock<Vec<u32>>,
    /// Contact at the start.
    pub(crate) start_contact: OnceLock<Option<Contact>>,
    /// Batch model of the robot, and for each variable whether the model moves it.
    pub(crate) batch_model: OnceLock<Option<(BatchModel, Vec<bool>)>>,
}

/// Cache of base maps, shared by the contexts of one robot and scene. A map does not depend on the base's
/// pose, unless the base stands nearer to an obstacle than the clearance.
#[derive(Debug, Default)]
pub struct BaseMapCache(Mutex<BTreeMap<Vec<u8>, Arc<BaseMap>>>);

impl BaseMapCache {
    /// Greatest number of maps; beyond it, all are dropped.
    const MOST: usize = 64;

    fn get(&self, key: &[u8], make: impl Fn() -> Arc<BaseMap>) -> Arc<BaseMap> {
        // A poisoned lock only loses cached maps.
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
    /// Context of a robot in a scene and a state; O(entities). Everything else is computed at first use.
    #[must_use]
    pub fn new(model: &'w RobotModel, scene: &'w Scene, state: &'w SceneState) -> Self {
        Self::of(PlanningScene::new(model, scene, state))
    }

    fn of(planning: PlanningScene<'w>) -> Self {
        Self {
            planning,
            map: OnceLock::new(),
            maps: None,
            escapes: OnceLock::new(),
            homes: OnceLock::new(),
            start_contact: OnceLock::new(),
            batch_model: OnceLock::new(),
        }
    }

    /// Shares base maps with the other contexts of the same robot and scene.
    #[must_use]
    pub fn with_base_maps(self, maps: &'w BaseMapCache) -> Self {
        Self { maps: Some(maps), ..self }
    }

    /// Context of the same robot, scene, clearance and maps in another state.
    pub(crate) fn in_state<'o>(&self, state: &'o SceneState) -> QueryContext<'o>
    where
        'w: 'o,
    {
        let planning = PlanningScene::with_clearance(self.model, self.scene, state, self.clearance);
        QueryContext { maps: self.maps, ..QueryContext::of(planning) }
    }

    /// Context of the same robot, state and clearance in another scene.
    pub(crate) fn in_scene<'o>(&self, scene: &'o Scene) -> QueryContext<'o>
    where
        'w: 'o,
    {
        QueryContext::of(PlanningScene::with_clearance(self.model, scene, self.state, self.clearance))
    }

    /// Context of the same robot, scene and state that keeps another clearance.
    pub(crate) fn keeping(&self, clearance: Clearance) -> Self {
        QueryContext::of(PlanningScene::with_clearance(self.model, self.scene, self.state, clearance))
    }

    /// Key of the map: the state without the base, and what only this start permits.
    fn map_key(&self) -> Vec<u8> {
        let mut key = self.state.key_without_base();
        let Clearance { base_m, arm_m } = self.clearance;
        let mut add = |value: f64| key.extend_from_slice(&value.to_bits().to_le_bytes());
        [base_m, arm_m].into_iter().for_each(&mut add);
        for (at, padding) in self.permitted() {
            [at as f64, padding.base, padding.arm].into_iter().for_each(&mut add);
        }
        key
    }

    /// Map of the floor with the arm as it is; `None` for a base that does not drive.
    pub(crate) fn map(&self) -> Option<&BaseMap> {
        let make = || Arc::new(BaseMap::new(&self.planning, &self.state.robot.joints));
        let map = self.map.get_or_init(|| {
            self.model.drives().then(|| match self.maps {
                Some(maps) => maps.get(&self.map_key(), make),
                None => make(),
            })
        });
        map.as_deref()
    }
}

impl<'w> Deref for QueryContext<'w> {
    type Target = PlanningScene<'w>;

    fn deref(&self) -> &Self::Target {
        &self.planning
    }
}
