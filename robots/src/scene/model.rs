//! Data model of a scene: ids are unique and can be written in a policy, numbers are finite, shapes positive,
//! every entity named by `on`, `in` or `holding` exists, and supports have no cycle.

use indexmap::IndexMap;
use motet_stdlib::lang::{fluents, kinds};
use motet_syntax::Span;
use smol_str::SmolStr;

use crate::clearance::ClearanceOverride;
use crate::quaternion::{Quaternion, to_rpy};

/// Greatest number of entities in one scene.
pub const MAX_ENTITIES: usize = 20_000;

/// Scene. Lengths in metres, angles in radians, poses in the frame `map`, z up.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Scene {
    /// State of the robot at the start.
    pub robot: RobotState,
    /// Distances from obstacles that motions keep in this room, in place of those of the card.
    pub clearance: ClearanceOverride,
    /// Entities by id, in the order of the file.
    pub entities: IndexMap<SmolStr, Entity>,
    /// Images of a camera in the room.
    pub views: Vec<CameraView>,
}

impl Scene {
    /// Name of an entity in speech: its first other name, or its id in words.
    #[must_use]
    pub fn called(&self, id: &str) -> String {
        let name = self.entities.get(id).and_then(|entity| entity.names.first());
        name.map_or_else(|| id.replace(['_', '-'], " "), ToString::to_string)
    }
}

/// State of the robot at the start.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct RobotState {
    /// Position x, y in m and heading in rad.
    pub base: [f64; 3],
    /// Joint values by name, in m or rad.
    pub joints: IndexMap<SmolStr, f64>,
    /// Held entity: `None` if the scene does not say, `Some(None)` for an empty hand.
    pub holding: Option<Option<SmolStr>>,
    /// Grasp of a held entity, if the scene gives it. It counts while the hand holds this entity.
    pub grip: Option<Grip>,
    /// Entity at which the robot is within its working area, if the scene gives it.
    pub at: Option<SmolStr>,
    /// Spans of the joints in the file of the scene.
    pub spans: JointSpans,
}

/// Grasp of an entity.
#[derive(Clone, PartialEq, Debug)]
pub struct Grip {
    /// Id of the entity.
    pub of: SmolStr,
    /// Pose of the entity in the frame of the hand's tip.
    pub tip_from_object: Placement,
}

impl Grip {
    /// Grip of an entity at a pose in the frame of the hand's tip, with a quaternion x, y, z, w. `None` for a
    /// pose that no hand has: farther than [`Self::FARTHEST_M`], or without a direction.
    #[must_use]
    pub fn new(of: SmolStr, xyz: [f64; 3], quaternion: Quaternion) -> Option<Self> {
        let norm = quaternion.iter().map(|part| part * part).sum::<f64>().sqrt();
        let rpy = to_rpy(quaternion.map(|part| part / norm));
        Self::at(of, Placement { xyz, rpy }).filter(|_| (0.9..1.1).contains(&norm))
    }

    /// Grip of an entity at a placement in the frame of the hand's tip; `None` for one that no hand has.
    #[must_use]
    pub fn at(of: SmolStr, tip_from_object: Placement) -> Option<Self> {
        let is_near = tip_from_object.xyz.iter().all(|part| part.abs() <= Self::FARTHEST_M);
        is_near.then_some(Self { of, tip_from_object })
    }

    /// Greatest distance along an axis between a hand and the middle of what it holds, in m.
    pub const FARTHEST_M: f64 = 2.0;
}

/// Spans of joints by name. They are not part of the state, so any two are equal.
#[derive(Clone, Debug, Default)]
pub struct JointSpans(pub IndexMap<SmolStr, Span>);

impl PartialEq for JointSpans {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// Thing, surface, container, place or person.
#[derive(Clone, PartialEq, Debug)]
pub struct Entity {
    /// Id, equal to its key.
    pub id: SmolStr,
    /// Name of its kind, such as `Object`.
    pub kind: SmolStr,
    /// Class such as `mug`; empty if the scene gives none.
    pub class: SmolStr,
    /// Other names, such as `red mug`.
    pub names: Vec<SmolStr>,
    /// Categories such as `drinkware`.
    pub categories: Vec<SmolStr>,
    /// Pose of the centre of its shape (of the feet for a `Person` and a `Place`), if known.
    pub pose: Option<Placement>,
    pub shape: Option<EntityShape>,
    /// Mass in kg.
    pub mass_kg: Option<f64>,
    /// True if it never moves.
    pub fixed: bool,
    /// Entity that supports it.
    pub on: Option<SmolStr>,
    /// Container that it is in.
    pub inside: Option<SmolStr>,
    /// Visibility to the camera of the robot at the start.
    pub visible: Option<bool>,
    /// Open or closed, if known.
    pub open: Option<bool>,
    /// Locked or not, if known.
    pub locked: Option<bool>,
    /// Motion of its drawer or door.
    pub travel: Option<Travel>,
    /// Other fields that its kind declares, in SI units.
    pub fields: IndexMap<SmolStr, f64>,
    /// Spans of the entity in the file of the scene.
    pub spans: EntitySpans,
}

/// Spans of an entity. They are not part of it, so any two are equal.
#[derive(Clone, Copy, Debug, Default)]
pub struct EntitySpans {
    pub id: Span,
    pub kind: Span,
    /// Value of `visible`; the id without one.
    pub visible: Span,
}

impl PartialEq for EntitySpans {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Entity {
    /// Makes a place of which only the pose is known.
    #[must_use]
    pub fn place(id: SmolStr, pose: Placement) -> Self {
        Self { fixed: true, ..Self::new(id, SmolStr::new_static(kinds::PLACE), Some(pose)) }
    }

    /// Entity of which only the kind is known, and perhaps the pose.
    #[must_use]
    pub fn new(id: SmolStr, kind: SmolStr, pose: Option<Placement>) -> Self {
        Self {
            id,
            kind,
            class: SmolStr::default(),
            names: Vec::new(),
            categories: Vec::new(),
            pose,
            shape: None,
            mass_kg: None,
            fixed: false,
            on: None,
            inside: None,
            visible: None,
            open: None,
            locked: None,
            travel: None,
            fields: IndexMap::new(),
            spans: EntitySpans::default(),
        }
    }

    /// Extents along its own axes, in m; `None` of a mesh.
    #[must_use]
    pub fn extents(&self) -> Option<[f64; 3]> {
        Some(match *self.shape.as_ref()? {
            EntityShape::Box(extents) => extents,
            EntityShape::Cylinder { radius, height } => [2.0 * radius, 2.0 * radius, height],
            EntityShape::Sphere { radius } => [2.0 * radius; 3],
            EntityShape::Capsule { radius, height } => [2.0 * radius, 2.0 * radius, height + 2.0 * radius],
            EntityShape::Mesh { .. } => return None,
        })
    }

    /// Fluent between a thing and this entity as its support: `in` for a container, `on` for anything else.
    #[must_use]
    pub fn relation(&self) -> &'static str {
        if self.kind == kinds::CONTAINER { fluents::IN } else { fluents::ON }
    }
}

/// Pose with roll, pitch and yaw.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Placement {
    /// Position in m.
    pub xyz: [f64; 3],
    /// Roll, pitch, yaw in rad, about the fixed axes x, y, z in that order.
    pub rpy: [f64; 3],
}

/// Shape centred at its origin, axes along those of the entity.
#[derive(Clone, PartialEq, Debug)]
pub enum EntityShape {
    /// Box with full extents along x, y, z.
    Box([f64; 3]),
    /// Cylinder along z.
    Cylinder {
        radius: f64,
        height: f64,
    },
    Sphere {
        radius: f64,
    },
    /// Capsule along z; `height` without the caps.
    Capsule {
        radius: f64,
        /// Height of the cylinder between the caps.
        height: f64,
    },
    /// Triangles in a file.
    Mesh {
        /// Name of the file as written.
        file: String,
        /// Scale along x, y, z.
        scale: [f64; 3],
    },
}

/// Motion of the drawer or door of a container.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Travel {
    Slide {
        /// Unit direction of opening in the frame of the entity.
        axis: [f64; 3],
        /// Distance in m.
        distance: f64,
    },
    Hinge {
        /// Unit axis in the frame of the entity.
        axis: [f64; 3],
        /// Point of the axis in the frame of the entity.
        at: [f64; 3],
        /// Angle in rad.
        angle: f64,
    },
}

/// Images of a camera in the room.
#[derive(Clone, PartialEq, Debug)]
pub struct CameraView {
    pub camera: SmolStr,
    /// File of the image.
    pub image: String,
    /// File of the depth image: 16-bit PNG in mm.
    pub depth: Option<String>,
    /// Pose of the camera.
    pub pose: Option<Placement>,
    /// Intrinsics fx, fy, cx, cy in pixels.
    pub intrinsics: Option<[f64; 4]>,
}

impl Scene {
    /// Entities that a description such as `"the red mug"` fits, in the order of the file.
    ///
    /// A description fits by id, a name, the class or a category, as a whole; letter case, leading articles,
    /// and the difference of `_`, `-` and a space do not count. Where it fits none, its [`singular`] is
    /// tried, and a word for anything fits all ([`is_anything`]). An empty description fits none.
    /// O(entities).
    #[must_use]
    pub fn matches(&self, description: &str) -> Vec<&Entity> {
        let fitting = |wanted: &str| -> Vec<&Entity> {
            let fits =
                |entity: &&Entity| !wanted.is_empty() && entity.descriptions().any(|name| name == wanted);
            self.entities.values().filter(fits).collect()
        };
        let wanted = normal(description);
        let mut found = fitting(&wanted);
        if found.is_empty() {
            found = fitting(singular(&wanted));
        }
        if found.is_empty() && is_anything(&wanted) {
            found = self.entities.values().collect();
        }
        found
    }
}

impl Entity {
    /// Opening that a hand needs, in m: the width that the scene gives, else the smallest horizontal extent
    /// of the shape in its own frame. `None` if neither is known, as for a mesh.
    ///
    /// ```
    /// use motet_robots::builtin;
    ///
    /// let kitchen = builtin::scene("kitchen").unwrap();
    /// assert_eq!(kitchen.entities["mug_1"].width(), Some(0.08));
    /// // The scene gives the thickness of the plate.
    /// assert_eq!(kitchen.entities["plate"].width(), Some(0.02));
    /// ```
    #[must_use]
    pub fn width(&self) -> Option<f64> {
        if let Some(width) = self.fields.get("width") {
            return Some(*width);
        }
        match self.shape.as_ref()? {
            EntityShape::Box([x, y, _]) => Some(x.min(*y)),
            EntityShape::Cylinder { radius, .. }
            | EntityShape::Sphere { radius }
            | EntityShape::Capsule { radius, .. } => Some(2.0 * radius),
            EntityShape::Mesh { .. } => None,
        }
    }

    /// All its names as [`normal`] writes them, with repetitions.
    pub fn descriptions(&self) -> impl Iterator<Item = String> {
        let names = [&self.id, &self.class].into_iter().chain(&self.names).chain(&self.categories);
        names.map(|name| normal(name)).filter(|name| !name.is_empty())
    }
}

/// Checks if a description in [`normal`] form is a word for anything: "objects", "thing".
///
/// ```
/// use motet_robots::scene;
///
/// assert!(scene::is_anything("things") && !scene::is_anything("red things"));
/// ```
#[must_use]
pub fn is_anything(description: &str) -> bool {
    matches!(singular(description), "object" | "thing" | "item" | "anything" | "everything")
}

/// Singular of a description whose last word may be a plural, by its last letters; not always a word.
///
/// ```
/// use motet_robots::scene;
///
/// assert_eq!(scene::singular("red mugs"), "red mug");
/// assert_eq!(scene::singular("glasses"), "glass");
/// assert_eq!(scene::singular("glass"), "glass");
/// ```
#[must_use]
pub fn singular(description: &str) -> &str {
    let is_stem =
        |stem: &&str| stem.ends_with(['s', 'x', 'z']) || stem.ends_with("ch") || stem.ends_with("sh");
    let shorter = |end: &str| description.strip_suffix(end).filter(|stem| !stem.is_empty());
    match shorter("es").filter(is_stem) {
        Some(stem) => stem,
        None => shorter("s").filter(|stem| !stem.ends_with('s')).unwrap_or(description),
    }
}

/// Normal form of a description: words in lower case with single spaces, without leading articles.
///
/// ```
/// use motet_robots::scene;
///
/// assert_eq!(scene::normal("The  red_Mug"), "red mug");
/// ```
#[must_use]
pub fn normal(text: &str) -> String {
    let is_gap = |letter: char| letter.is_whitespace() || matches!(letter, '_' | '-');
    let words = text.split(is_gap).filter(|word| !word.is_empty()).map(str::to_lowercase);
    let words: Vec<_> = words.skip_while(|word| matches!(word.as_str(), "a" | "an" | "the")).collect();
    words.join(" ")
}
