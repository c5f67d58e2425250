//! Recognition: the thing of a scene that a label and a position of a detector are of, and entities for what
//! the scene lacks. The host and drivers ask here, so that both give a thing the same id.
//!
//! Labels come from outside: they are cleaned and bounded.

use super::{Entity, EntityShape, Placement, normal};
use motet_stdlib::lang::kinds;
use smol_str::{SmolStr, format_smolstr};

/// Minimum confidence of a detection that counts.
pub const SURE: f64 = 0.5;
/// Greatest distance in m at which a detection without an id may be a thing with its label.
pub const RECOGNISED_M: f64 = 0.3;
/// The most things that the scene lacks and somebody keeps.
pub const MOST_NEW: usize = 32;
/// The most characters of a label, and of an id that a driver gives.
pub const MOST_LABEL: usize = 40;
/// Category of every thing that the scene lacks: `the blue thing` is one of them.
const THING: &str = "thing";
/// Density of water in kg/m³.
const WATER: f64 = 1000.0;
/// Labels of people.
const PEOPLE: [&str; 6] = ["person", "human", "man", "woman", "child", "face"];

/// Thing that a detection without an id is of: the nearest with its label within [`RECOGNISED_M`], else the
/// only object of the scene that has the label as its class or a name. `of_scene` are entities of the scene
/// and `new` others that were seen before; neither has those that other detections of the same look are of.
/// O(entities).
///
/// ```
/// use motet_robots::{builtin, scene};
///
/// let kitchen = builtin::scene("kitchen").unwrap();
/// let told = || kitchen.entities.values();
/// let mug = scene::recognise(told(), [].into_iter(), "red mug", Some([1.9, 0.2, 0.8]));
/// assert_eq!(mug.unwrap().id, "mug_1");
/// assert!(scene::recognise(told(), [].into_iter(), "stapler", Some([1.9, 0.2, 0.8])).is_none());
/// ```
#[must_use]
pub fn recognise<'a>(
    of_scene: impl Iterator<Item = &'a Entity> + Clone,
    new: impl Iterator<Item = &'a Entity>,
    label: &str,
    position: Option<[f64; 3]>,
) -> Option<&'a Entity> {
    let of_scene = of_scene.filter(|entity| entity.is_loose());
    let alike = of_scene.clone().chain(new.filter(|entity| entity.is_loose()));
    let alike = alike.filter(|entity| entity.descriptions().any(|name| name == label));
    let gap = |entity: &Entity| Some(distance(entity.pose?.xyz, position?));
    let near = alike.filter_map(|entity| Some((gap(entity)?, entity)));
    let near = near.filter(|(gap, _)| *gap <= RECOGNISED_M);
    if let Some((_, entity)) = near.min_by(|one, other| one.0.total_cmp(&other.0)) {
        return Some(entity);
    }
    let is_called = |entity: &&Entity| {
        let mut names = std::iter::once(&entity.class).chain(&entity.names);
        entity.kind == kinds::OBJECT && names.any(|name| normal(name) == label)
    };
    let mut called = of_scene.filter(is_called);
    called.next().filter(|_| called.next().is_none())
}

/// A label in lower case with letters, digits and single spaces only, so that no label of a detector writes
/// a line or a tag of a prompt. At most [`MOST_LABEL`] characters.
#[must_use]
pub fn clean_label(label: &str) -> SmolStr {
    let words = label.split(|letter: char| !letter.is_alphanumeric()).filter(|word| !word.is_empty());
    let text = words.map(str::to_lowercase).collect::<Vec<_>>().join(" ");
    text.chars().take(MOST_LABEL).collect::<String>().trim_end().into()
}

/// Id for a thing that the scene lacks: its label, as [`clean_label`] writes it, with the first free number.
#[must_use]
pub fn numbered_id(label: &str, is_free: impl Fn(&str) -> bool) -> SmolStr {
    let stem = label.replace([' ', '-', '\''], "_");
    let ids = (1_u64..).map(|number| format_smolstr!("{stem}_{number}"));
    ids.into_iter().find(|id| is_free(id)).unwrap_or_default()
}

impl Entity {
    /// True for what can stand elsewhere the next time: an object or a person that is not fixed.
    #[must_use]
    pub fn is_loose(&self) -> bool {
        !self.fixed && matches!(self.kind.as_str(), kinds::OBJECT | kinds::PERSON)
    }

    /// Makes a thing that a detector saw and the scene lacks: a person by its label, else an object. Sides
    /// in m of 1 mm to 5 m make its shape. A small object has the mass in kg of as much water, so that a hand
    /// may try it; nothing is presumed of one of more than 1 kg.
    #[must_use]
    pub fn detected(id: SmolStr, label: &SmolStr, pose: Option<Placement>, extent: Option<[f64; 3]>) -> Self {
        let kind = if PEOPLE.contains(&label.as_str()) { kinds::PERSON } else { kinds::OBJECT };
        let is_solid = |sides: &[f64; 3]| sides.iter().all(|side| (0.001..=5.0).contains(side));
        let extent = extent.filter(is_solid);
        let mass = extent.map(|sides| sides.iter().product::<f64>() * WATER);
        Self {
            kind: kind.into(),
            mass_kg: mass.filter(|mass| *mass <= 1.0 && kind == kinds::OBJECT),
            class: label.clone(),
            names: vec![label.clone()],
            categories: vec![SmolStr::new_static(THING)],
            shape: extent.map(EntityShape::Box),
            pose,
            fixed: false,
            ..Self::place(id, Placement::default())
        }
    }
}

/// Distance between two points in m.
#[must_use]
pub fn distance(one: [f64; 3], other: [f64; 3]) -> f64 {
    one.iter().zip(other).map(|(one, other)| (one - other).powi(2)).sum::<f64>().sqrt()
}
