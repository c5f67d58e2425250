//! Sightings: detections of a driver as things of the scene. Known things stand where they were seen, and
//! unknown ones get an entity of their own that is called by its label.
//!
//! Detections come from outside. Their labels are cleaned, and ids, labels and things are bounded.

use std::collections::BTreeSet;

use indexmap::IndexMap;
use motet_robots::scene::{
    Entity, EntityShape, MOST_LABEL, MOST_NEW, Outline, PlacedOutline, Placement, SURE, Scene, clean_label,
    distance, numbered_id, recognise,
};
use motet_runtime::{Detection, Time, ToldThing};
use motet_stdlib::lang::{entities, kinds};
use smol_str::SmolStr;

/// Standard deviation of a position in m, where neither the detector nor the scene gives one.
const ERROR_M: f64 = 0.01;
/// Number of standard deviations beyond which a thing has moved.
const SIGMAS: f64 = 3.0;
/// Greatest distance in m between the bottom of a thing and what it stands on.
const CONTACT_M: f64 = 0.05;

/// Things that were seen since the scene was recorded.
#[derive(Clone, Debug, Default)]
pub struct Sightings {
    things: IndexMap<SmolStr, SeenThing>,
    in_view: BTreeSet<SmolStr>,
    /// New things of which the driver was not told yet.
    untold: Vec<ToldThing>,
}

/// Thing that stands elsewhere than in the scene, or that the scene lacks.
#[derive(Clone, Debug)]
struct SeenThing {
    /// The entity at the pose where it was seen, with what it stands on or lies in.
    entity: Entity,
    error_m: f64,
    at: Time,
    is_new: bool,
}

impl Sightings {
    /// Takes detections in. Returns the things that were seen for the first time or have moved since, with
    /// their support by where they are. A detection without an id counts for the nearest thing with its
    /// label within 30 cm, else for the only object with that class or name. What the hand holds does not
    /// count.
    /// O(detections · entities).
    ///
    /// ```
    /// use motet_planner::vision::Sightings;
    /// use motet_runtime::{Detection, Time};
    ///
    /// let kitchen = motet_robots::builtin::scene("kitchen").unwrap();
    /// let on_the_table = motet_graph::Pose { xyz: [2.6, 0.2, 0.8], quaternion: [0.0, 0.0, 0.0, 1.0] };
    /// let stapler = Detection {
    ///     entity: None,
    ///     class: "blue stapler".into(),
    ///     pose: Some(on_the_table),
    ///     extent: None,
    ///     error_m: None,
    ///     confidence: 0.9,
    ///     at: Time::ZERO,
    /// };
    /// let mut seen = Sightings::default();
    /// let news = seen.note(&kitchen, None, &[stapler]);
    /// assert_eq!(news[0].id, "blue_stapler_1");
    /// ```
    pub fn note(&mut self, scene: &Scene, held: Option<&str>, seen: &[Detection]) -> Vec<Entity> {
        let mut news: Vec<Entity> = Vec::new();
        let mut taken = BTreeSet::new();
        for one in seen.iter().filter(|one| one.confidence >= SURE) {
            let label = clean_label(&one.class);
            let id = self.recognised(scene, one, &label, &taken);
            if let Some(id) = &id {
                self.in_view.insert(id.clone());
                taken.insert(id.clone());
            }
            let seen = match id {
                Some(id) if held == Some(id.as_str()) => None,
                Some(id) => self.measure(scene, &id, one),
                None => self.discover(scene, one, label),
            };
            if let Some(entity) = seen {
                taken.insert(entity.id.clone());
                news.retain(|known| known.id != entity.id);
                news.push(entity);
            }
        }
        news
    }

    /// Forgets what is in view, since the robot or the room has moved.
    pub fn look_away(&mut self) {
        self.in_view.clear();
    }

    /// Things in view at the last look.
    pub fn in_view(&self) -> impl Iterator<Item = &SmolStr> {
        self.in_view.iter()
    }

    /// New things of which the driver was not told yet, each once.
    pub fn take_untold(&mut self) -> Vec<ToldThing> {
        std::mem::take(&mut self.untold)
    }

    /// True if everything is as in the scene.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.things.is_empty()
    }

    /// The scene with everything where it was seen. A thing that `is_stale` with its support was moved since:
    /// it keeps the place that the scene gives it, and one that the scene lacks has none.
    #[must_use]
    pub fn over(&self, scene: &Scene, is_stale: impl Fn(&str, Option<&SmolStr>) -> bool) -> Scene {
        let mut scene = scene.clone();
        for (id, seen) in &self.things {
            let there = &seen.entity;
            let is_stale = is_stale(id, there.on.as_ref().or(there.inside.as_ref()));
            match scene.entities.get_mut(id) {
                Some(_) if is_stale => {}
                Some(known) => {
                    known.pose = there.pose;
                    (known.on, known.inside) = (there.on.clone(), there.inside.clone());
                }
                None if is_stale => {
                    let nowhere = Entity { pose: None, on: None, inside: None, ..there.clone() };
                    scene.entities.insert(id.clone(), nowhere);
                }
                None => {
                    scene.entities.insert(id.clone(), there.clone());
                }
            }
        }
        scene
    }

    /// Positions of things that were seen, by their ids.
    pub fn positions(&self) -> impl Iterator<Item = (&SmolStr, [f64; 3])> {
        self.things.iter().filter_map(|(id, seen)| Some((id, seen.entity.pose?.xyz)))
    }

    /// Thing of the scene or of earlier sightings that a detection is of. One without an id is none of those
    /// that were `taken` by other detections of the same look.
    fn recognised(
        &self,
        scene: &Scene,
        one: &Detection,
        label: &str,
        taken: &BTreeSet<SmolStr>,
    ) -> Option<SmolStr> {
        let known =
            |id: &str| self.things.get(id).map(|seen| &seen.entity).or_else(|| scene.entities.get(id));
        if let Some(entity) = one.entity.as_ref().and_then(|id| known(id)) {
            return Some(entity.id.clone());
        }
        if one.entity.as_ref().is_some_and(|id| is_usable(id)) || label.is_empty() {
            return None;
        }
        let is_free = |entity: &&Entity| !taken.contains(&entity.id);
        let told = scene.entities.values().filter_map(|entity| known(&entity.id)).filter(is_free);
        let new = self.things.values().filter(|seen| seen.is_new).map(|seen| &seen.entity).filter(is_free);
        let found = recognise(told, new, label, one.pose.map(|pose| pose.xyz))?;
        Some(found.id.clone())
    }

    /// Takes in the position of a known thing. `Some` if it has moved.
    fn measure(&mut self, scene: &Scene, id: &SmolStr, one: &Detection) -> Option<Entity> {
        let (pose, error_m) = (one.pose?, error_of(one));
        let (entity, known) = match self.things.get(id) {
            Some(seen) => (seen.entity.clone(), seen.error_m),
            None => (scene.entities.get(id)?.clone(), ERROR_M),
        };
        if !entity.is_loose() {
            return None;
        }
        let mut xyz = pose.xyz;
        if let Some(feet) = entity.pose.filter(|_| entity.kind == kinds::PERSON) {
            xyz[2] = feet.xyz[2];
        }
        let is_there =
            entity.pose.is_some_and(|told| distance(told.xyz, xyz) <= SIGMAS * known.hypot(error_m));
        if is_there {
            // A second look makes the first more exact.
            if let Some(seen) = self.things.get_mut(id)
                && let Some(place) = &mut seen.entity.pose
            {
                let share = seen.error_m.powi(2) / (seen.error_m.powi(2) + error_m.powi(2));
                // What stands on something has its height from that.
                let exact = if seen.entity.on.is_some() { 2 } else { 3 };
                for (old, new) in place.xyz.iter_mut().zip(xyz).take(exact) {
                    *old += share * (new - *old);
                }
                seen.error_m *= (1.0 - share).sqrt();
                seen.at = one.at;
            }
            return None;
        }
        let [roll, pitch, _] = entity.pose.map_or([0.0; 3], |old| old.rpy);
        let there = Entity { pose: Some(Placement { xyz, rpy: [roll, pitch, pose.yaw()] }), ..entity };
        let there = self.supported(scene, there);
        let is_new = self.things.get(id).is_some_and(|seen| seen.is_new);
        self.things.insert(id.clone(), SeenThing { entity: there.clone(), error_m, at: one.at, is_new });
        Some(there)
    }

    /// Makes an entity of a thing that is not known.
    fn discover(&mut self, scene: &Scene, one: &Detection, label: SmolStr) -> Option<Entity> {
        let named = one.entity.as_ref().filter(|id| is_usable(id));
        let label = match named {
            Some(id) if label.is_empty() => clean_label(id),
            _ => label,
        };
        if label.is_empty() {
            return None;
        }
        let is_free = |id: &str| !scene.entities.contains_key(id) && !self.things.contains_key(id);
        let id = match named {
            Some(id) => id.clone(),
            None => numbered_id(&label, is_free),
        };
        let pose = one.pose.map(|pose| Placement { xyz: pose.xyz, rpy: [0.0, 0.0, pose.yaw()] });
        let entity = Entity::detected(id.clone(), &label, pose, one.extent);
        let entity = self.supported(scene, entity);
        let new = self.things.iter().filter(|(_, seen)| seen.is_new);
        if new.clone().count() >= MOST_NEW {
            let oldest = new.min_by_key(|(_, seen)| seen.at).map(|(id, _)| id.clone())?;
            self.things.shift_remove(&oldest);
            self.in_view.remove(&oldest);
        }
        let seen = SeenThing { entity: entity.clone(), error_m: error_of(one), at: one.at, is_new: true };
        self.things.insert(id.clone(), seen);
        self.in_view.insert(id.clone());
        self.untold.push(ToldThing { id, label: Some(label), pose: one.pose, support: None });
        Some(entity)
    }

    /// The entity with what it stands on or lies in where it is: the highest of what is right below it. On a
    /// surface it touches that, however inexact its height was seen.
    fn supported(&self, scene: &Scene, entity: Entity) -> Entity {
        let Some(mut pose) = entity.pose.filter(|_| entity.kind == kinds::OBJECT) else { return entity };
        let [x, y, z] = pose.xyz;
        let bottom = z - half_height(&entity);
        let tops = scene.entities.values().filter_map(|other| {
            let is_in = other.kind == kinds::CONTAINER;
            if !is_in && other.kind != kinds::SURFACE {
                return None;
            }
            let (place, shape) = (other.pose?, other.shape.as_ref()?);
            let (sin, cos) = place.rpy[2].sin_cos();
            let outline = Outline::of(shape)?;
            let at = PlacedOutline { outline, centre: [place.xyz[0], place.xyz[1]], axis: [cos, sin] };
            let (middle, half) = (place.xyz[2], half_height(other));
            let is_below = (bottom - middle - half).abs() <= CONTACT_M;
            let is_within = is_in && (z - middle).abs() <= half + CONTACT_M;
            let fits = at.gap_to([x, y]) <= 0.0 && (is_within || (!is_in && is_below));
            fits.then(|| (middle + half, other.id.clone(), is_in))
        });
        let highest = tops.max_by(|one, other| one.0.total_cmp(&other.0));
        let (on, inside) = match highest {
            Some((_, id, true)) => (None, Some(id)),
            Some((top, id, false)) => {
                if pose.rpy.iter().take(2).all(|tilt| *tilt == 0.0) {
                    pose.xyz[2] = top + half_height(&entity);
                }
                (Some(id), None)
            }
            None => (None, None),
        };
        Entity { on, inside, pose: Some(pose), ..entity }
    }
}

/// True if a thing lies on the floor, by the pose where it was seen.
#[must_use]
pub fn lies_on_floor(entity: &Entity) -> bool {
    entity.pose.is_some_and(|pose| pose.xyz[2] - half_height(entity) <= CONTACT_M)
}

fn error_of(one: &Detection) -> f64 {
    one.error_m.unwrap_or(ERROR_M).clamp(0.001, 1.0)
}

fn half_height(entity: &Entity) -> f64 {
    match &entity.shape {
        Some(EntityShape::Box([_, _, z])) => z / 2.0,
        Some(EntityShape::Cylinder { height, .. }) => height / 2.0,
        Some(EntityShape::Sphere { radius }) => *radius,
        Some(EntityShape::Capsule { radius, height }) => radius + height / 2.0,
        Some(EntityShape::Mesh { .. }) | None => 0.0,
    }
}

/// True for an id of a driver that a policy can write and that means nothing else.
fn is_usable(id: &str) -> bool {
    let is_name = id.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '_')
        && id.starts_with(|letter: char| letter.is_ascii_alphabetic());
    is_name && id.len() <= MOST_LABEL && !entities::ALL.contains(&id) && id != "any"
}
