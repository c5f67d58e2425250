//! Tools that describe the world: robots, primitives, and the scene at present.

use motet_compiler::InitialFact;
use motet_project::{RobotFiles, robot_names};
use motet_robots::scene::{Entity, Scene};
use motet_syntax::Sources;
use serde_json::{Map, Value, json};

use super::answer::Refusal;
use super::environment::{AgentEnvironment, StderrSink, scene_names};
use crate::command::robots::{signature, signatures};

/// The built-in robots and scenes, and the robot of the command line.
pub(super) fn robots(own: &AgentEnvironment, drives: bool) -> Result<Value, Refusal> {
    let mut robots = Vec::new();
    for name in robot_names() {
        let robot = RobotFiles::find(name)?.card(&mut Sources::default(), &mut StderrSink)?;
        robots.push(json!({"name": name, "title": robot.title, "primitives": robot.primitives.len()}));
    }
    let scenes: Vec<&str> = scene_names().collect();
    Ok(json!({
        "robots": robots,
        "scenes": scenes,
        "robot_of_this_server": own.robot_name(),
        "can_run_policies": drives,
    }))
}

/// Declarations of the primitives of a robot, with its bounds.
pub(super) fn primitives(situation: &AgentEnvironment, name: Option<&str>) -> Result<Value, Refusal> {
    let robot = situation.robot()?;
    let declared = signatures(robot);
    let mut found = Map::new();
    for (primitive, bounds) in &robot.primitives {
        if name.is_some_and(|name| name != primitive.as_str()) {
            continue;
        }
        if let Some((decl, text)) = declared.iter().rfind(|(decl, _)| decl.name.text == *primitive) {
            found.insert(primitive.to_string(), signature(decl, text, bounds).trim().into());
        }
    }
    match name {
        Some(name) if found.is_empty() => {
            let names: Vec<&str> = robot.primitives.keys().map(|name| name.as_str()).collect();
            Err(Refusal::unknown("primitive", name, format!("known: {}", names.join(", "))))
        }
        _ => Ok(json!({"robot": robot.name.as_str(), "primitives": found})),
    }
}

/// Entities and facts at present.
pub(super) fn scene(situation: &AgentEnvironment) -> Value {
    let scene = &situation.scene;
    let entities: Vec<Value> = scene.entities.values().map(entity).collect();
    json!({
        "robot": situation.robot_name(),
        "robot_pose": pose_of_base(scene),
        "entities": entities,
        "facts": facts(situation),
        "about_facts": "a fact that is not listed does not hold, or is not known",
    })
}

/// Facts that hold, and those about one thing that are known not to hold.
fn facts(situation: &AgentEnvironment) -> Vec<String> {
    let mut known: Vec<InitialFact> = Vec::new();
    for fact in situation.session.initial_facts() {
        let is_about = |other: &InitialFact| {
            let fits = |(arg, given): (&Option<_>, &Option<_>)| arg.is_none() || arg == given;
            other.fluent == fact.fluent && fact.args.iter().zip(&other.args).all(fits)
        };
        // A later fact overrides, and one about anything all those before it.
        known.retain(|other| !is_about(other));
        known.push(fact);
    }
    let is_told = |fact: &&InitialFact| fact.holds || fact.args.iter().all(Option::is_some);
    let shown = known.iter().filter(is_told).map(|fact| {
        let args: Vec<String> =
            fact.args.iter().map(|arg| arg.as_ref().map_or("any".to_owned(), ToString::to_string)).collect();
        let not = if fact.holds { "" } else { "not " };
        format!("{not}{}({})", fact.fluent, args.join(", "))
    });
    shown.collect()
}

fn pose_of_base(scene: &Scene) -> Value {
    let [x, y, yaw] = scene.robot.base;
    json!({"x_m": round(x), "y_m": round(y), "heading_deg": yaw.to_degrees().round()})
}

fn entity(entity: &Entity) -> Value {
    let mut all = Map::new();
    all.insert("id".to_owned(), json!(entity.id));
    all.insert("kind".to_owned(), json!(entity.kind));
    if !entity.names.is_empty() {
        all.insert("names".to_owned(), json!(entity.names));
    }
    let place = [("on", &entity.on), ("in", &entity.inside)];
    for (name, place) in place.into_iter().filter_map(|(name, place)| Some((name, place.as_ref()?))) {
        all.insert(name.to_owned(), json!(place));
    }
    if let Some(pose) = &entity.pose {
        all.insert("xyz_m".to_owned(), json!(pose.xyz.map(round)));
    }
    if let Some(mass) = entity.mass_kg {
        all.insert("mass_kg".to_owned(), json!(mass));
    }
    Value::Object(all)
}

/// Length to the millimetre.
fn round(metres: f64) -> f64 {
    (metres * 1000.0).round() / 1000.0
}
