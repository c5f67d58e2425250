//! A scene after reading: ids are unique and identifiers or back-quotable, numbers finite, shapes positive, every
//! entity named by `on`, `in`, `holding` exists, supports have no cycle.

use indexmap::IndexMap;
use motet_syntax::Span;
use smol_str::SmolStr;

/// A scene. Lengths in metres, angles in radians, poses in the frame `map`, z up.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Scene {
    /// Where the robot is.
    pub robot: RobotState,
    /// What there is, by id, in the order of the file.
    pub entities: IndexMap<SmolStr, Entity>,
    /// What a camera saw.
    pub views: Vec<CameraView>,
}

/// The robot at the start.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct RobotState {
    /// Position in m and heading in rad.
    pub base: [f64; 3],
    /// Joint values by name, in m or rad.
    pub joints: IndexMap<SmolStr, f64>,
    /// What it holds: `None` where the scene does not say, `Some(None)` for nothing.
    pub holding: Option<Option<SmolStr>>,
    /// The entity that it stands at so that it serves it, where the scene says.
    pub at: Option<SmolStr>,
    /// Where the scene's file gives joints.
    pub spans: JointSpans,
}

/// Where each joint was read, by its name. That is no part of where it is, so any two are equal.
#[derive(Clone, Debug, Default)]
pub struct JointSpans(pub IndexMap<SmolStr, Span>);

impl PartialEq for JointSpans {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// One thing, place or person.
#[derive(Clone, PartialEq, Debug)]
pub struct Entity {
    /// Its id; the same as its key.
    pub id: SmolStr,
    /// The name of its kind, `Object`.
    pub kind: SmolStr,
    /// What it is, `mug`; empty where nothing is said.
    pub class: SmolStr,
    /// Other names, `red mug`.
    pub names: Vec<SmolStr>,
    /// What it belongs to, `drinkware`.
    pub categories: Vec<SmolStr>,
    /// The pose of its shape's centre (of the feet for a `Person` and a `Place`), where known.
    pub pose: Option<Placement>,
    /// Its shape.
    pub shape: Option<EntityShape>,
    /// Its mass in kg.
    pub mass_kg: Option<f64>,
    /// Whether it never moves.
    pub fixed: bool,
    /// The entity that it stands on.
    pub on: Option<SmolStr>,
    /// The container that it is in.
    pub inside: Option<SmolStr>,
    /// Whether the robot's camera sees it at the start.
    pub visible: Option<bool>,
    /// Whether it is open.
    pub open: Option<bool>,
    /// Whether it is locked.
    pub locked: Option<bool>,
    /// How it opens.
    pub travel: Option<Travel>,
    /// Other fields that its kind declares, in SI units.
    pub fields: IndexMap<SmolStr, f64>,
    /// Where the scene's file says so.
    pub spans: EntitySpans,
}

/// Where an entity was read. That is no part of what it is, so any two are equal.
#[derive(Clone, Copy, Debug, Default)]
pub struct EntitySpans {
    /// Its id.
    pub id: Span,
    /// Its kind.
    pub kind: Span,
}

impl PartialEq for EntitySpans {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Entity {
    /// A place of which only the pose is known.
    #[must_use]
    pub fn place(id: SmolStr, pose: Placement) -> Self {
        Self {
            id,
            kind: SmolStr::new_static("Place"),
            class: SmolStr::default(),
            names: Vec::new(),
            categories: Vec::new(),
            pose: Some(pose),
            shape: None,
            mass_kg: None,
            fixed: true,
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
}

/// A pose as a scene gives it.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Placement {
    /// Position in m.
    pub xyz: [f64; 3],
    /// Roll, pitch, yaw in rad, about fixed axes x, y, z in that order.
    pub rpy: [f64; 3],
}

/// A shape about its own centre, axes along the entity's.
#[derive(Clone, PartialEq, Debug)]
pub enum EntityShape {
    /// Full extents along x, y, z.
    Box([f64; 3]),
    /// Along z.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Height.
        height: f64,
    },
    /// A ball.
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// Along z; `height` without the caps.
    Capsule {
        /// Radius.
        radius: f64,
        /// Height of the cylinder between the caps.
        height: f64,
    },
    /// Triangles in a file.
    Mesh {
        /// The file's name as given.
        file: String,
        /// Scale along x, y, z.
        scale: [f64; 3],
    },
}

/// How a container or a door opens.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Travel {
    /// A drawer.
    Slide {
        /// Unit direction of opening in the entity's frame.
        axis: [f64; 3],
        /// How far, in m.
        distance: f64,
    },
    /// A door.
    Hinge {
        /// Unit axis in the entity's frame.
        axis: [f64; 3],
        /// A point of the axis in the entity's frame.
        at: [f64; 3],
        /// How far, in rad.
        angle: f64,
    },
}

/// What a camera saw.
#[derive(Clone, PartialEq, Debug)]
pub struct CameraView {
    /// Which camera.
    pub camera: SmolStr,
    /// The image's file.
    pub image: String,
    /// The depth image's file: 16-bit PNG in mm.
    pub depth: Option<String>,
    /// The camera's pose.
    pub pose: Option<Placement>,
    /// fx, fy, cx, cy in pixels.
    pub intrinsics: Option<[f64; 4]>,
}
