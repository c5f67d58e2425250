//! Checks of the parts of a scene: conversion of one entity or view from its wire form to the model, each
//! number checked against the range of its quantity. Impossible values are left out.

use indexmap::IndexMap;
use motet_stdlib::lang::kinds;
use motet_syntax::ast::MAX_MISTAKES;
use motet_syntax::json::Spanned;
use motet_syntax::render::is_steering;
use motet_syntax::{Diagnostic, Span};
use smol_str::SmolStr;

use super::diagnostics::{
    BadClearance, BadId, BadZone, EmptyName, FieldTwice, NotPositive, TooFar, TooWideAngle, ZeroAxis,
};
use super::model::{CameraView, Entity, EntityShape, EntitySpans, Placement, Scene, Travel};
use super::quantity::{FURTHEST, SceneQuantity};
use super::wire;
use crate::card::JointPosition;
use crate::clearance::{ClearanceOverride, GREATEST_CLEARANCE};
use crate::mesh::UnreadMesh;
use crate::urdf::Urdf;

/// Fields of entities with a key of their own.
const OWN_KEYS: &[&str] = &["mass", "width"];

/// Converts an entity, its relations unchecked.
pub(super) fn entity(wire: &Spanned<wire::Entity>, numbers: &mut NumberReader) -> Entity {
    if wire.kind.is_empty() {
        numbers.found.push(EmptyName { span: wire.kind.span, key: "kind" }.into());
    }
    let alone = std::slice::from_ref;
    let (kind, class) = (alone(&wire.kind.value), alone(&wire.class));
    let named = [("kind", kind), ("class", class), ("names", &wire.names), ("categories", &wire.categories)];
    for (key, names) in named {
        for id in names.iter().filter(|name| name.contains(is_steering)) {
            numbers.found.push(BadId { span: wire.id.span, key, id: id.clone() }.into());
        }
    }
    let name = |name: &Option<Spanned<SmolStr>>| name.as_ref().map(|name| name.value.clone());
    let entity = Entity {
        id: wire.id.value.clone(),
        kind: wire.kind.value.clone(),
        class: wire.class.clone(),
        names: wire.names.clone(),
        categories: wire.categories.clone(),
        pose: wire.pose.0.as_ref().and_then(|pose| placement(pose, numbers)),
        shape: wire.shape.0.as_ref().and_then(|it| shape(it, wire.id.span, numbers)),
        mass_kg: wire.mass.as_ref().and_then(|mass| numbers.one(mass, SceneQuantity::Mass)),
        fixed: wire.fixed,
        on: name(&wire.on),
        inside: name(&wire.r#in),
        visible: wire.visible.as_ref().map(|visible| visible.value),
        open: wire.open,
        locked: wire.locked,
        travel: wire.travel.0.as_ref().and_then(|it| travel(it, numbers)),
        fields: fields(wire, numbers),
        spans: EntitySpans {
            id: wire.id.span,
            kind: wire.kind.span,
            visible: wire.visible.as_ref().map_or(wire.id.span, |visible| visible.span),
        },
    };
    if let Some(problem) = zone_problem(wire, &entity) {
        numbers.found.push(BadZone { span: wire.id.span, id: wire.id.value.clone(), problem }.into());
    }
    entity
}

/// Reason for which a zone is none: it lacks its extent, or has a property of a thing. A part with a mistake
/// of its own is not counted as missing.
fn zone_problem(wire: &wire::Entity, entity: &Entity) -> Option<&'static str> {
    if entity.kind != kinds::ZONE {
        return None;
    }
    let is_upright = |pose: &Placement| pose.rpy[0] == 0.0 && pose.rpy[1] == 0.0;
    if wire.pose.0.is_none() {
        return Some("has no `pose`");
    }
    if wire.shape.0.is_none() {
        return Some("has no `shape`");
    }
    if !matches!(entity.shape, Some(EntityShape::Box(_) | EntityShape::Cylinder { .. }) | None) {
        return Some("has no `box` or `cylinder` as its shape");
    }
    if entity.pose.as_ref().is_some_and(|pose| !is_upright(pose)) {
        return Some("is tilted");
    }
    if wire.on.is_some() || wire.r#in.is_some() {
        return Some("is on or in something");
    }
    (wire.mass.is_some() || wire.travel.0.is_some()).then_some("has a `mass` or a `travel`")
}

fn fields(wire: &wire::Entity, numbers: &mut NumberReader) -> IndexMap<SmolStr, f64> {
    let mut fields = IndexMap::new();
    if let Some(width) = wire.width.as_ref().and_then(|width| numbers.one(width, SceneQuantity::Size)) {
        fields.insert("width".into(), width);
    }
    for (name, value) in &wire.fields {
        if OWN_KEYS.contains(&name.as_str()) {
            numbers.found.push(FieldTwice { span: value.span, field: name.clone() }.into());
        } else if let Some(value) = numbers.one(value, SceneQuantity::Field) {
            fields.insert(name.clone(), value);
        }
    }
    fields
}

/// Converts the clearance of a room.
pub(super) fn clearance(clearance: &wire::Clearance, numbers: &mut NumberReader) -> ClearanceOverride {
    let mut one = |number: &Option<Spanned<f64>>| numbers.one(number.as_ref()?, SceneQuantity::Clearance);
    ClearanceOverride { base_m: one(&clearance.base), arm_m: one(&clearance.arm) }
}

pub(super) fn placement(pose: &wire::Pose, numbers: &mut NumberReader) -> Option<Placement> {
    let xyz = numbers.three(&pose.xyz, SceneQuantity::Coordinate);
    let rpy = match &pose.rpy {
        Some(rpy) => numbers.three(rpy, SceneQuantity::Angle),
        None => Some([0.0; 3]),
    };
    Some(Placement { xyz: xyz?, rpy: rpy? })
}

fn shape(shape: &wire::Shape, span: Span, numbers: &mut NumberReader) -> Option<EntityShape> {
    let mut rod = |rod: &wire::Rod| {
        let radius = numbers.one(&rod.radius, SceneQuantity::Size);
        let height = numbers.one(&rod.height, SceneQuantity::Size);
        Some((radius?, height?))
    };
    Some(match shape {
        wire::Shape::Cylinder(it) => {
            rod(it).map(|(radius, height)| EntityShape::Cylinder { radius, height })?
        }
        wire::Shape::Capsule(it) => {
            rod(it).map(|(radius, height)| EntityShape::Capsule { radius, height })?
        }
        wire::Shape::Box(extents) => EntityShape::Box(numbers.three(extents, SceneQuantity::Size)?),
        wire::Shape::Sphere(ball) => {
            EntityShape::Sphere { radius: numbers.one(&ball.radius, SceneQuantity::Size)? }
        }
        wire::Shape::Mesh(mesh) => {
            let scale = match &mesh.scale {
                Some(scale) => numbers.three(scale, SceneQuantity::Scale)?,
                None => [1.0; 3],
            };
            let file = mesh.file.clone();
            let problem = "those of a scene are not".to_owned();
            let help =
                "give the `box`, `cylinder`, `capsule` or `sphere` that encloses it instead".to_owned();
            numbers.found.push(UnreadMesh { span, file: file.clone(), problem, help }.into());
            EntityShape::Mesh { file, scale }
        }
    })
}

fn travel(travel: &wire::Travel, numbers: &mut NumberReader) -> Option<Travel> {
    match travel {
        wire::Travel::Slide(slide) => {
            let axis = numbers.axis(&slide.axis);
            let distance = numbers.one(&slide.distance, SceneQuantity::Size);
            Some(Travel::Slide { axis: axis?, distance: distance? })
        }
        wire::Travel::Hinge(hinge) => {
            let axis = numbers.axis(&hinge.axis);
            let at = numbers.three(&hinge.at, SceneQuantity::Coordinate);
            let angle = numbers.one(&hinge.angle, SceneQuantity::Opening)?;
            if angle > std::f64::consts::TAU {
                numbers.found.push(TooWideAngle { span: hinge.angle.span, found: angle }.into());
                return None;
            }
            Some(Travel::Hinge { axis: axis?, at: at?, angle })
        }
    }
}

/// Converts a camera view.
pub(super) fn view(view: &wire::View, numbers: &mut NumberReader) -> Option<CameraView> {
    let intrinsics = view.intrinsics.0.as_ref().and_then(|it| {
        let fx = numbers.one(&it.fx, SceneQuantity::FocalLength);
        let fy = numbers.one(&it.fy, SceneQuantity::FocalLength);
        let cx = numbers.one(&it.cx, SceneQuantity::Pixel);
        let cy = numbers.one(&it.cy, SceneQuantity::Pixel);
        Some([fx?, fy?, cx?, cy?])
    });
    Some(CameraView {
        camera: view.camera.clone(),
        image: view.image.clone(),
        depth: view.depth.clone(),
        pose: view.pose.0.as_ref().and_then(|pose| placement(pose, numbers)),
        intrinsics,
    })
}

/// Checks that the joints of a scene are joints of the robot that move by themselves, within their limits.
/// Each diagnostic has the span in the scene. O(joints given × joints).
///
/// ```
/// use motet_robots::{builtin, scene};
/// use motet_syntax::{FileId, Source};
///
/// let text = r#"{"motet_scene": 1, "robot": {"joints": {"arm_lift_joint": 2}}, "entities": []}"#;
/// let (room, _) = scene::read(&Source::new("room.json", text), FileId(0));
/// let found = scene::fit(&room.unwrap(), &builtin::robot("hsr").unwrap().urdf);
/// assert_eq!(found[0].message, "joint `arm_lift_joint` is at 2, outside its limits of 0 to 0.69");
/// ```
#[must_use]
pub fn fit(scene: &Scene, urdf: &Urdf) -> Vec<Diagnostic> {
    let place = |name: &str| scene.robot.spans.0.get(name).copied().unwrap_or_default();
    let told = scene.robot.joints.iter().filter_map(|(name, value)| {
        JointPosition { joint: name, value: *value, span: place(name) }.fault(urdf)
    });
    told.take(MAX_MISTAKES + 1).collect()
}

/// Checks numbers and collects diagnostics.
#[derive(Debug, Default)]
pub(super) struct NumberReader {
    /// Diagnostics so far.
    pub(super) found: Vec<Diagnostic>,
}

impl NumberReader {
    /// Checks a number; `None` if it is impossible.
    pub(super) fn one(&mut self, number: &Spanned<f64>, quantity: SceneQuantity) -> Option<f64> {
        self.value(number.value, number.span, quantity)
    }

    /// Checks three numbers; reports at most one mistake.
    pub(super) fn three(&mut self, point: &Spanned<[f64; 3]>, quantity: SceneQuantity) -> Option<[f64; 3]> {
        let [x, y, z] = point.value;
        Some([
            self.value(x, point.span, quantity)?,
            self.value(y, point.span, quantity)?,
            self.value(z, point.span, quantity)?,
        ])
    }

    /// Normalises a direction to length 1.
    pub(super) fn axis(&mut self, axis: &Spanned<[f64; 3]>) -> Option<[f64; 3]> {
        let raw = self.three(axis, SceneQuantity::Direction)?;
        // Scaled first, so that the squares lose neither tiny nor huge components.
        let greatest = raw.iter().fold(0.0_f64, |most, part| most.max(part.abs()));
        if greatest == 0.0 {
            self.found.push(ZeroAxis { span: axis.span }.into());
            return None;
        }
        let scaled = raw.map(|part| part / greatest);
        let length = scaled.iter().map(|part| part * part).sum::<f64>().sqrt();
        Some(scaled.map(|part| part / length))
    }

    /// The value is finite: JSON has no other numbers, and the reader refuses those too large for a float.
    fn value(&mut self, value: f64, span: Span, quantity: SceneQuantity) -> Option<f64> {
        if quantity.has_to_be_positive() && value <= 0.0 {
            self.found.push(NotPositive { span, quantity, found: value }.into());
        } else if quantity == SceneQuantity::Clearance && !(0.0..=GREATEST_CLEARANCE).contains(&value) {
            self.found.push(BadClearance { span, found: value }.into());
        } else if quantity.has_bound() && value.abs() > FURTHEST {
            self.found.push(TooFar { span, quantity, found: value }.into());
        } else {
            return Some(value);
        }
        None
    }
}
