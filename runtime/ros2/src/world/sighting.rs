//! Detections as things of the room: those without an id get the one of the thing that they are of.

use super::World;
use motet_graph::Pose;
use motet_host::remote::protocol::DetectedThing;
use motet_robots::scene::{
    Entity, MOST_NEW, Placement, SURE, clean_label, distance, normal, numbered_id, recognise, singular,
};
use motet_runtime::{ToldSupport, ToldThing};
use smol_str::SmolStr;
use std::collections::BTreeSet;

use super::Place;

/// Distance in m from where the host was told that a thing is, from which on it is told again.
const ELSEWHERE: f64 = 0.08;
/// The most detections that wait to be reported.
const MOST_NEWS: usize = 1_000;

impl World {
    /// Gives each detection without an id the one of the thing that it is of, the surest first. What is none
    /// of the known things keeps none. O(detections · entities).
    pub(crate) fn recognise(&self, things: &mut [DetectedThing]) {
        let mut taken: BTreeSet<String> = things.iter().filter_map(|thing| thing.id.clone()).collect();
        let unnamed = things.iter_mut().filter(|thing| thing.id.is_none() && thing.confidence >= SURE);
        let mut unnamed: Vec<&mut DetectedThing> = unnamed.collect();
        unnamed.sort_by(|one, other| other.confidence.total_cmp(&one.confidence));
        for thing in unnamed {
            thing.id = self.known(thing, &taken);
            taken.extend(thing.id.clone());
        }
    }

    /// Thing that a detection is of, and that is none of those that were `taken`.
    fn known(&self, thing: &DetectedThing, taken: &BTreeSet<String>) -> Option<String> {
        let label = clean_label(&thing.label);
        if label.is_empty() {
            return None;
        }
        let free = self.scene.entities.values().filter(|entity| !taken.contains(entity.id.as_str()));
        let of_scene = free.clone().filter(|entity| !self.found.contains(entity.id.as_str()));
        let new = free.filter(|entity| self.found.contains(entity.id.as_str()));
        let found = recognise(of_scene, new, &label, thing.pose.map(|pose| pose.xyz))?;
        Some(found.id.to_string())
    }

    /// Id for a detection of a thing that the scene lacks, which becomes one of the room. `None` if `what`
    /// does not describe it, or if it is not sure.
    pub(crate) fn discover(&mut self, what: &str, thing: &DetectedThing) -> Option<String> {
        let (wanted, label) = (normal(what), clean_label(&thing.label));
        let is_wanted = !label.is_empty() && (label == wanted || label == singular(&wanted));
        if thing.confidence < SURE || !is_wanted {
            return None;
        }
        // A second detection of the same look may be of the same thing.
        if let Some(id) = self.known(thing, &BTreeSet::new()) {
            return Some(id);
        }
        let id = numbered_id(&label, |id| !self.scene.entities.contains_key(id));
        self.add(id.clone(), &label, thing.pose, thing.extent);
        self.tell(DetectedThing { id: Some(id.to_string()), ..thing.clone() });
        Some(id.to_string())
    }

    /// Adds a thing that the scene lacks. Beyond the most, the one that was seen the longest ago goes.
    fn add(&mut self, id: SmolStr, label: &SmolStr, pose: Option<Pose>, extent: Option<[f64; 3]>) {
        if self.found.len() >= MOST_NEW {
            let oldest = self.found.iter().min_by_key(|id| self.seen.get(*id).copied()).cloned();
            if let Some(oldest) = oldest {
                self.found.remove(&oldest);
                self.scene.entities.shift_remove(oldest.as_str());
                self.places.remove(&oldest);
                self.seen.remove(&oldest);
            }
        }
        let placement = pose.map(|pose| Placement { xyz: pose.xyz, rpy: [0.0, 0.0, pose.yaw()] });
        self.scene.entities.insert(id.clone(), Entity::detected(id.clone(), label, placement, extent));
        self.places.insert(id.to_string(), Place::Unknown);
        self.seen.insert(id.to_string(), std::time::Instant::now());
        self.found.insert(id.to_string());
    }

    /// Takes in what the host knows of a thing: its support, or which detection it gave this id.
    pub(crate) fn told(&mut self, thing: &ToldThing) {
        match (&thing.label, self.scene.entities.contains_key(&thing.id)) {
            (Some(label), false) => self.add(thing.id.clone(), &clean_label(label), thing.pose, None),
            (Some(_), true) => self.saw(&thing.id, thing.pose.map(Into::into)),
            (None, _) => {}
        }
        if let Some(pose) = thing.pose {
            self.reported.insert(thing.id.to_string(), pose.xyz);
        }
        let place = match &thing.support {
            Some(ToldSupport::On(at)) => Place::On(at.to_string()),
            Some(ToldSupport::In(at)) => Place::In(at.to_string()),
            Some(ToldSupport::At(at)) => Place::At(at.to_string()),
            None => Place::Unknown,
        };
        self.put(Some(thing.id.to_string()), place);
    }

    /// Notes that a known thing is to be reported if it is elsewhere than the host was told.
    pub(crate) fn note(&mut self, thing: &DetectedThing) {
        let (Some(id), Some(pose)) = (&thing.id, thing.pose) else { return };
        let of_scene = || self.scene.entities.get(id.as_str())?.pose.map(|pose| pose.xyz);
        let before = self.reported.get(id).copied().or_else(of_scene);
        let is_held = self.places.get(id) == Some(&Place::Hand);
        let is_elsewhere = before.is_none_or(|before| distance(before, pose.xyz) > ELSEWHERE);
        if thing.confidence >= SURE && is_elsewhere && !is_held {
            self.tell(thing.clone());
        } else if let Some(before) = before {
            // The place in the scene moves along with what is seen; the host knows the one before.
            self.reported.entry(id.clone()).or_insert(before);
        }
    }

    fn tell(&mut self, thing: DetectedThing) {
        if let (Some(id), Some(pose)) = (&thing.id, thing.pose) {
            self.reported.insert(id.clone(), pose.xyz);
        }
        if self.news.len() < MOST_NEWS {
            self.news.push(thing);
        }
    }

    /// Detections that the host does not know of, each once.
    pub(crate) fn take_news(&mut self) -> Vec<DetectedThing> {
        std::mem::take(&mut self.news)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(label: &str, xyz: [f64; 3], confidence: f64) -> DetectedThing {
        let pose = Some(Pose { xyz, quaternion: [0.0, 0.0, 0.0, 1.0] });
        DetectedThing { label: label.to_owned(), id: None, pose, extent: None, error_m: None, confidence }
    }

    /// Two red mugs 0.2 m apart on a table.
    fn room() -> World {
        let mut scene = motet_robots::builtin::scene("kitchen").unwrap().clone();
        let first = scene.entities.get("mug_1").unwrap().clone();
        let mut second = Entity { id: "mug_2".into(), ..first };
        second.pose.as_mut().unwrap().xyz[1] += 0.2;
        scene.entities.insert("mug_2".into(), second);
        World::new(scene)
    }

    fn ids(world: &World, things: &[DetectedThing]) -> Vec<Option<String>> {
        let mut things = things.to_vec();
        world.recognise(&mut things);
        things.into_iter().map(|thing| thing.id).collect()
    }

    #[test]
    fn label_is_of_the_nearest_thing_that_it_describes() {
        let world = room();
        let [x, y, z] = world.pose("mug_1").unwrap().xyz;
        let id = |name: &str| Some(name.to_owned());
        let near = |dy: f64| seen("Red mug", [x, y + dy, z], 0.9);
        assert_eq!(ids(&world, &[near(0.15)]), [id("mug_2")]);
        assert_eq!(ids(&world, &[near(0.08)]), [id("mug_1")]);
        // Each is one of them: the surer detection comes first.
        let less = DetectedThing { confidence: 0.6, ..near(0.02) };
        assert_eq!(ids(&world, &[less, near(0.08)]), [id("mug_2"), id("mug_1")]);
        assert_eq!(ids(&world, &[near(0.6)]), [None], "out of the gate of both");
        assert_eq!(ids(&world, &[DetectedThing { confidence: 0.4, ..near(0.0) }]), [None], "not sure");
        assert_eq!(ids(&world, &[seen("stapler", [x, y, z], 0.9)]), [None]);
    }

    #[test]
    fn only_thing_of_a_name_is_known_anywhere() {
        let world = World::new(motet_robots::builtin::scene("kitchen").unwrap().clone());
        assert_eq!(ids(&world, &[seen("red mug", [0.0, 3.0, 0.5], 0.9)]), [Some("mug_1".to_owned())]);
    }

    #[test]
    fn thing_that_the_scene_lacks_gets_the_id_that_the_host_would_give() {
        let mut world = room();
        let stapler = seen("Blue stapler", [2.0, 0.5, 0.8], 0.9);
        assert_eq!(world.discover("red mug", &stapler), None);
        assert_eq!(world.discover("the blue stapler", &stapler).as_deref(), Some("blue_stapler_1"));
        assert_eq!(world.take_news()[0].id.as_deref(), Some("blue_stapler_1"));
        assert_eq!(
            ids(&world, &[seen("blue stapler", [2.1, 0.5, 0.8], 0.9)]),
            [Some("blue_stapler_1".into())]
        );
        assert_eq!(world.matches("blue stapler"), ["blue_stapler_1"]);
        for at in 0..40 {
            let other = seen("blue stapler", [10.0 + f64::from(at), 0.0, 0.8], 0.9);
            assert!(world.discover("blue stapler", &other).is_some());
        }
        assert_eq!(world.found.len(), MOST_NEW);
    }

    #[test]
    fn host_says_which_detection_it_gave_an_id() {
        let mut world = room();
        let pose = seen("", [2.0, 0.5, 0.8], 0.9).pose;
        let told = ToldThing { id: "cup_7".into(), label: Some("green cup".into()), pose, support: None };
        world.told(&told);
        assert_eq!(ids(&world, &[seen("green cup", [2.0, 0.6, 0.8], 0.9)]), [Some("cup_7".to_owned())]);
    }

    #[test]
    fn thing_that_was_moved_is_reported_once() {
        let mut world = room();
        let [x, y, z] = world.pose("mug_1").unwrap().xyz;
        let see = |dy: f64| {
            let thing = DetectedThing { id: Some("mug_1".to_owned()), ..seen("mug", [x, y + dy, z], 0.9) };
            world.note(&thing);
            world.saw("mug_1", thing.pose.map(Into::into));
            world.take_news().len()
        };
        assert_eq!([0.02, 0.06, 0.1, 0.12, 0.3].map(see), [0, 0, 1, 0, 1]);
    }
}
