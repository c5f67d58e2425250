//! From a [`Scene`] to its JSON text. What the model leaves open is left out, so reading it gives the same
//! scene.

use serde_json::{Map, Value, json};

use super::model::{CameraView, Entity, EntityShape, Placement, RobotState, Scene, Travel};
use crate::clearance::ClearanceOverride;

/// Writes a scene as one line of JSON. Reading it again gives the same scene where all its numbers are
/// finite. O(entities).
///
/// ```
/// use motet_robots::{builtin, scene};
/// use motet_syntax::{FileId, Source};
///
/// let kitchen = builtin::scene("kitchen").unwrap();
/// let (again, _) = scene::read(&Source::new("kitchen.json", scene::write(&kitchen)), FileId(0));
/// assert_eq!(again.unwrap(), kitchen);
/// ```
#[must_use]
pub fn write(scene: &Scene) -> String {
    let entities: Vec<Value> = scene.entities.values().map(entity).collect();
    let mut document = Map::new();
    document.insert("motet_scene".to_owned(), json!(1));
    document.insert("frame".to_owned(), json!("map"));
    document.insert("robot".to_owned(), robot(&scene.robot));
    let ClearanceOverride { base_m, arm_m } = scene.clearance;
    let parts = [("base", base_m), ("arm", arm_m)].into_iter();
    let parts: Map<String, Value> =
        parts.filter_map(|(key, value)| Some((key.to_owned(), json!(value?)))).collect();
    if !parts.is_empty() {
        document.insert("clearance".to_owned(), Value::Object(parts));
    }
    document.insert("entities".to_owned(), entities.into());
    if !scene.views.is_empty() {
        document.insert("views".to_owned(), scene.views.iter().map(view).collect());
    }
    Value::Object(document).to_string()
}

fn robot(robot: &RobotState) -> Value {
    let mut map = Map::new();
    map.insert("base".to_owned(), json!(robot.base));
    if !robot.joints.is_empty() {
        let joints = robot.joints.iter().map(|(name, value)| (name.to_string(), json!(value)));
        map.insert("joints".to_owned(), Value::Object(joints.collect()));
    }
    if let Some(holding) = &robot.holding {
        map.insert("holding".to_owned(), holding.as_deref().map_or(Value::Null, Value::from));
    }
    if let Some(grip) = robot.grip.as_ref().filter(|grip| robot.holding == Some(Some(grip.of.clone()))) {
        map.insert("grip".to_owned(), placement(&grip.tip_from_object));
    }
    if let Some(at) = &robot.at {
        map.insert("at".to_owned(), json!(at.as_str()));
    }
    Value::Object(map)
}

fn entity(entity: &Entity) -> Value {
    let mut map = Map::new();
    let mut put = |key: &str, value: Value| map.insert(key.to_owned(), value);
    put("id", json!(entity.id.as_str()));
    put("kind", json!(entity.kind.as_str()));
    if !entity.class.is_empty() {
        put("class", json!(entity.class.as_str()));
    }
    for (key, words) in [("names", &entity.names), ("categories", &entity.categories)] {
        if !words.is_empty() {
            put(key, words.iter().map(|word| Value::from(word.as_str())).collect());
        }
    }
    if let Some(pose) = &entity.pose {
        put("pose", placement(pose));
    }
    if let Some(it) = &entity.shape {
        put("shape", shape(it));
    }
    if let Some(mass) = entity.mass_kg {
        put("mass", json!(mass));
    }
    if let Some(width) = entity.fields.get("width") {
        put("width", json!(width));
    }
    if entity.fixed {
        put("fixed", json!(true));
    }
    for (key, holder) in [("on", &entity.on), ("in", &entity.inside)] {
        if let Some(holder) = holder {
            put(key, json!(holder.as_str()));
        }
    }
    for (key, is) in [("visible", entity.visible), ("open", entity.open), ("locked", entity.locked)] {
        if let Some(is) = is {
            put(key, json!(is));
        }
    }
    if let Some(it) = &entity.travel {
        put("travel", travel(it));
    }
    let fields: Map<String, Value> = entity
        .fields
        .iter()
        .filter(|(name, _)| *name != "width")
        .map(|(name, value)| (name.to_string(), json!(value)))
        .collect();
    if !fields.is_empty() {
        put("fields", Value::Object(fields));
    }
    Value::Object(map)
}

fn placement(pose: &Placement) -> Value {
    json!({"xyz": pose.xyz, "rpy": pose.rpy})
}

fn shape(shape: &EntityShape) -> Value {
    match shape {
        EntityShape::Box(extents) => json!({"box": extents}),
        EntityShape::Cylinder { radius, height } => json!({"cylinder": {"radius": radius, "height": height}}),
        EntityShape::Sphere { radius } => json!({"sphere": {"radius": radius}}),
        EntityShape::Capsule { radius, height } => json!({"capsule": {"radius": radius, "height": height}}),
        EntityShape::Mesh { file, scale } => json!({"mesh": {"file": file, "scale": scale}}),
    }
}

fn travel(travel: &Travel) -> Value {
    match travel {
        Travel::Slide { axis, distance } => json!({"slide": {"axis": axis, "distance": distance}}),
        Travel::Hinge { axis, at, angle } => json!({"hinge": {"axis": axis, "at": at, "angle": angle}}),
    }
}

fn view(view: &CameraView) -> Value {
    let mut map = Map::new();
    map.insert("camera".to_owned(), json!(view.camera.as_str()));
    map.insert("image".to_owned(), json!(view.image));
    if let Some(depth) = &view.depth {
        map.insert("depth".to_owned(), json!(depth));
    }
    if let Some(pose) = &view.pose {
        map.insert("pose".to_owned(), placement(pose));
    }
    if let Some([fx, fy, cx, cy]) = view.intrinsics {
        map.insert("intrinsics".to_owned(), json!({"fx": fx, "fy": fy, "cx": cx, "cy": cy}));
    }
    Value::Object(map)
}

#[cfg(test)]
mod tests {
    use motet_syntax::{FileId, Severity, Source};

    use crate::builtin::SCENES;
    use crate::scene::read;

    const ALL: &str = r#"{"motet_scene": 1, "robot": {"base": [1, 2, 0.5], "joints": {"lift": 0.1},
        "holding": "ball", "grip": {"xyz": [0, 0, 0.1], "rpy": [0, 1.5, 0]}, "at": "box"},
        "clearance": {"base": 0.04},
        "entities": [
          {"id": "box", "kind": "Container", "pose": {"xyz": [0, 1, 2]}, "shape": {"box": [1, 1, 1]},
              "open": true, "locked": false,
           "travel": {"hinge": {"axis": [0, 0, 2], "at": [0.5, 0, 0], "angle": 1.5}},
               "fields": {"volume": 0.1}},
          {"id": "ball", "kind": "Object", "shape": {"sphere": {"radius": 0.1}}, "mass": 0.1, "width": 0.2},
          {"id": "rod", "kind": "Object", "shape": {"capsule": {"radius": 0.1, "height": 1}}, "in": "box",
              "visible": false},
          {"id": "thing", "kind": "Object", "shape": {"mesh": {"file": "a.stl"}}}],
        "views": [{"camera": "head", "image": "a.png", "depth": "d.png", "pose": {"xyz": [0, 0, 1]},
                   "intrinsics": {"fx": 500, "fy": 500, "cx": 320, "cy": 240}}]}"#;

    #[test]
    fn write_and_read_round_trip() {
        let built_in = SCENES.into_iter().map(|scene| (scene.name, scene.json));
        for (name, text) in built_in.chain([("all", ALL)]) {
            let (scene, mut said) = read(&Source::new(name, text), FileId(0));
            // Warnings for meshes are expected.
            said.retain(|said| said.severity == Severity::Error);
            assert!(said.is_empty(), "{name}: {said:?}");
            let scene = scene.unwrap();
            let (again, mut said) = read(&Source::new(name, super::write(&scene)), FileId(0));
            said.retain(|said| said.severity == Severity::Error);
            assert!(said.is_empty(), "{name}: {said:?}");
            assert_eq!(again.unwrap(), scene, "{name}");
        }
    }
}
