//! Foxglove's messages, as far as they are used here: `foxglove.FrameTransforms` and `foxglove.SceneUpdate`.

use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Value, json};

/// A world at a moment, in the frame `map`.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct McapScene {
    /// Position where the base stands: x and y in m, the heading in rad.
    pub base: [f64; 3],
    /// Bodies in the scene.
    pub bodies: Vec<McapBody>,
}

/// A body with its pose and shape.
#[derive(Clone, PartialEq, Debug)]
pub struct McapBody {
    pub id: String,
    /// Its centre in m.
    pub xyz: [f64; 3],
    /// Its turn about the vertical in rad.
    pub heading: f64,
    pub solid: McapSolid,
}

/// Shape of a body.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum McapSolid {
    /// Full extents in m.
    Box([f64; 3]),
    /// In m, upright.
    Cylinder {
        radius: f64,
        height: f64,
    },
    Sphere {
        radius: f64,
    },
}

#[derive(Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub(super) struct Stamp {
    sec: u64,
    nsec: u64,
}

#[derive(Clone, Copy, PartialEq, Serialize, JsonSchema)]
struct Vector3 {
    x: f64,
    y: f64,
    z: f64,
}

#[derive(Clone, Copy, PartialEq, Serialize, JsonSchema)]
struct Quaternion {
    x: f64,
    y: f64,
    z: f64,
    w: f64,
}

#[derive(Clone, Copy, PartialEq, Serialize, JsonSchema)]
struct Pose {
    position: Vector3,
    orientation: Quaternion,
}

#[derive(Clone, Copy, PartialEq, Serialize, JsonSchema)]
struct Color {
    r: f64,
    g: f64,
    b: f64,
    a: f64,
}

#[derive(Clone, PartialEq, Serialize, JsonSchema)]
pub(super) struct FrameTransforms {
    transforms: Vec<FrameTransform>,
}

#[derive(Clone, PartialEq, Serialize, JsonSchema)]
struct FrameTransform {
    timestamp: Stamp,
    parent_frame_id: String,
    child_frame_id: String,
    translation: Vector3,
    rotation: Quaternion,
}

#[derive(Clone, PartialEq, Serialize, JsonSchema)]
pub(super) struct SceneUpdate {
    deletions: Vec<Value>,
    entities: Vec<SceneEntity>,
}

#[derive(Clone, PartialEq, Serialize, JsonSchema)]
struct SceneEntity {
    timestamp: Stamp,
    frame_id: String,
    id: String,
    lifetime: Stamp,
    frame_locked: bool,
    metadata: Vec<Value>,
    arrows: Vec<Value>,
    cubes: Vec<Cube>,
    spheres: Vec<Cube>,
    cylinders: Vec<Cylinder>,
    lines: Vec<Value>,
    triangles: Vec<Value>,
    texts: Vec<Text>,
    models: Vec<Value>,
}

/// A cube or a sphere by its extents.
#[derive(Clone, Copy, PartialEq, Serialize, JsonSchema)]
struct Cube {
    pose: Pose,
    size: Vector3,
    color: Color,
}

#[derive(Clone, Copy, PartialEq, Serialize, JsonSchema)]
struct Cylinder {
    pose: Pose,
    size: Vector3,
    bottom_scale: f64,
    top_scale: f64,
    color: Color,
}

#[derive(Clone, PartialEq, Serialize, JsonSchema)]
struct Text {
    pose: Pose,
    billboard: bool,
    font_size: f64,
    scale_invariant: bool,
    color: Color,
    text: String,
}

const THING: Color = Color { r: 0.55, g: 0.6, b: 0.65, a: 0.8 };
const WORDS: Color = Color { r: 0.1, g: 0.1, b: 0.1, a: 1.0 };

impl Stamp {
    pub(super) const fn of(nanos: u64) -> Self {
        Self { sec: nanos / 1_000_000_000, nsec: nanos % 1_000_000_000 }
    }
}

impl McapScene {
    /// The frame of the base in that of the map.
    pub(super) fn transforms(&self, now: u64) -> FrameTransforms {
        let [x, y, heading] = self.base;
        FrameTransforms {
            transforms: vec![FrameTransform {
                timestamp: Stamp::of(now),
                parent_frame_id: "map".to_owned(),
                child_frame_id: "base".to_owned(),
                translation: Vector3 { x, y, z: 0.0 },
                rotation: about_z(heading),
            }],
        }
    }

    pub(super) fn scene(&self, now: u64) -> SceneUpdate {
        let entities = self.bodies.iter().map(|body| body.entity(now)).collect();
        SceneUpdate { deletions: Vec::new(), entities }
    }
}

impl McapBody {
    fn entity(&self, now: u64) -> SceneEntity {
        let [x, y, z] = self.xyz;
        let pose = Pose { position: Vector3 { x, y, z }, orientation: about_z(self.heading) };
        let (mut cubes, mut spheres, mut cylinders) = (Vec::new(), Vec::new(), Vec::new());
        let height = match self.solid {
            McapSolid::Box([x, y, z]) => {
                cubes.push(Cube { pose, size: Vector3 { x, y, z }, color: THING });
                z
            }
            McapSolid::Cylinder { radius, height } => {
                let size = Vector3 { x: 2.0 * radius, y: 2.0 * radius, z: height };
                let (bottom_scale, top_scale, color) = (1.0, 1.0, THING);
                cylinders.push(Cylinder { pose, size, bottom_scale, top_scale, color });
                height
            }
            McapSolid::Sphere { radius } => {
                let size = Vector3 { x: 2.0 * radius, y: 2.0 * radius, z: 2.0 * radius };
                spheres.push(Cube { pose, size, color: THING });
                2.0 * radius
            }
        };
        let above = Pose { position: Vector3 { x, y, z: z + 0.5 * height + 0.05 }, ..pose };
        let (billboard, font_size, scale_invariant) = (true, 0.1, false);
        let text = self.id.clone();
        SceneEntity {
            timestamp: Stamp::of(now),
            frame_id: "map".to_owned(),
            id: self.id.clone(),
            lifetime: Stamp::of(0),
            frame_locked: false,
            metadata: Vec::new(),
            arrows: Vec::new(),
            cubes,
            spheres,
            cylinders,
            lines: Vec::new(),
            triangles: Vec::new(),
            texts: vec![Text { pose: above, billboard, font_size, scale_invariant, color: WORDS, text }],
            models: Vec::new(),
        }
    }
}

fn about_z(angle: f64) -> Quaternion {
    let (sin, cos) = (0.5 * angle).sin_cos();
    Quaternion { x: 0.0, y: 0.0, z: sin, w: cos }
}

/// The JSON Schema of a type without references, which not every tool follows.
pub(super) fn flat_schema<T: JsonSchema>() -> Value {
    let settings = schemars::generate::SchemaSettings::draft07().with(|settings| {
        settings.inline_subschemas = true;
    });
    let schema = settings.into_generator().into_root_schema_for::<T>();
    serde_json::to_value(schema).unwrap_or_else(|_| json!({"type": "object"}))
}
