//! Answers as lines of JSON. Lengths are in m, angles in rad, masses in kg; keys have a fixed order.

use motet_geometry::planning::{
    Configuration, GraspSide, MotionAnswer, MotionQuery, MotionWitness, RobotModel, UnknownReason, components,
};
use serde_json::{Map, Value, json};

/// MotionAnswer as a line of JSON.
pub(super) fn line(machine: &RobotModel, query: &MotionQuery, answer: &MotionAnswer) -> String {
    let mut object = Map::new();
    object.insert("query".into(), query.to_string().into());
    match answer {
        MotionAnswer::Feasible(witness) => {
            object.insert("answer".into(), "feasible".into());
            object.insert("witness".into(), of(machine, witness));
        }
        MotionAnswer::Infeasible(why) => {
            object.insert("answer".into(), "infeasible".into());
            object.insert("reason".into(), why.reason.name().into());
            object.insert("says".into(), why.reason.to_string().into());
            for (name, value) in super::numbers(&why.reason) {
                object.insert(name.into(), json!(value));
            }
            object.insert("change".into(), why.change.clone().into());
            object.insert("certified".into(), why.certified.into());
        }
        MotionAnswer::Unknown(unknown) => {
            object.insert("answer".into(), "unknown".into());
            let why = match unknown {
                UnknownReason::Budget => "the search ran out of its budget",
                UnknownReason::Because(why) => why.as_str(),
            };
            object.insert("says".into(), why.into());
        }
    }
    Value::Object(object).to_string()
}

fn of(machine: &RobotModel, witness: &MotionWitness) -> Value {
    let grasp = witness.grasp.as_ref().map(|grasp| {
        let side = match grasp.side {
            GraspSide::Top => "top",
            GraspSide::Side => "side",
            GraspSide::Front => "front",
        };
        let pose = |(xyz, quaternion): ([f64; 3], [f64; 4])| json!({"xyz": xyz, "quaternion_xyzw": quaternion});
        json!({
            "object": grasp.object, "side": side, "width": grasp.width,
            "map_from_tip": pose(components(&grasp.map_from_tip)), "tip_from_object": pose(components(&grasp.tip_from_object)),
        })
    });
    json!({
        "path": witness.path.iter().map(|at| state(machine, at)).collect::<Vec<_>>(),
        "grasp": grasp,
        "margins": {
            "clearance": witness.margins.clearance,
            "limit": witness.margins.limit,
            "payload": witness.margins.payload,
        },
    })
}

fn state(machine: &RobotModel, state: &Configuration) -> Value {
    let names = machine.tree().dofs().iter().map(|dof| dof.name.to_string());
    let joints: Map<String, Value> = names.zip(state.joints.iter().map(|value| json!(value))).collect();
    json!({"base": state.base, "joints": joints})
}
