//! Answers to motion queries, for people and as JSON.

use motet_geometry::planning::{
    Configuration, GraspSide, InfeasibleReason, MIN_CLEARANCE, Misfit, MotionAnswer, MotionLimits,
    MotionQuery, MotionWitness, PathTime, RobotModel, SceneState, SpeedShare, UnknownReason, components,
};
use serde_json::{Map, Value, json};

/// Answer for people, with a line break at its end.
pub(super) fn describe(query: &MotionQuery, answer: &MotionAnswer) -> String {
    match answer {
        MotionAnswer::Feasible(witness) => {
            let [x, y, yaw] = witness.path.last().map_or([0.0; 3], |state| state.base);
            let mut line = format!(
                "{query}: feasible, base at ({x:.2}, {y:.2}) m, {:.0}°, {}, {:.3} m clear",
                degrees(yaw),
                segments(witness.path.len().saturating_sub(1)),
                witness.margins.clearance,
            );
            let required = witness.margins.required;
            if required.base_m.max(required.arm_m) > MIN_CLEARANCE {
                let [base, arm] = [required.base_m, required.arm_m].map(|metres| metres * 100.0);
                line.push_str(&format!(" (kept: base {base:.1} cm, arm {arm:.1} cm)"));
            }
            if let Some(limit) = witness.margins.limit {
                line.push_str(&format!(", {limit:.2} from a joint limit (rad, or m for a prismatic joint)"));
            }
            if let Some(payload) = witness.margins.payload {
                line.push_str(&format!(", {payload:.2} kg to spare"));
            }
            line + "\n"
        }
        MotionAnswer::Infeasible(why) => {
            let proof = if why.certified { "proven" } else { "the search ended without one" };
            let help = why.change.as_ref().map_or_else(String::new, |change| format!("  help: {change}\n"));
            format!("{query}: {}, {} ({proof})\n{help}", why.reason.name(), why.says())
        }
        MotionAnswer::Unknown(UnknownReason::Budget) => format!(
            "{query}: unknown, the search ran out of its budget\n  \
             help: `--effort 4` tries four times as often\n"
        ),
        MotionAnswer::Unknown(UnknownReason::Because(why)) => format!("{query}: unknown, {why}\n"),
    }
}

fn segments(number: usize) -> String {
    if number == 1 { "a path of 1 segment".to_owned() } else { format!("a path of {number} segments") }
}

/// Angle in degrees from -180 (exclusive) to 180: along a path a base may turn further.
fn degrees(angle: f64) -> f64 {
    let rounded = angle.to_degrees().round();
    let within = (rounded + 180.0).rem_euclid(360.0) - 180.0;
    if within == -180.0 { 180.0 } else { within }
}

/// Numbers of a reason with their names.
fn numbers(reason: &InfeasibleReason) -> Vec<(&'static str, f64)> {
    match reason {
        InfeasibleReason::OutOfReach { needs, reach, .. } => vec![("needs", *needs), ("reach", *reach)],
        InfeasibleReason::TooHeavy { needs, limit }
        | InfeasibleReason::TooWide { needs, limit }
        | InfeasibleReason::Beside { needs, limit } => {
            vec![("needs", *needs), ("limit", *limit)]
        }
        InfeasibleReason::NotInView { aside: Some(aside), .. } => {
            vec![("needs", aside.needs.abs()), ("limit", aside.limit)]
        }
        InfeasibleReason::NoPlace(Misfit::Narrow { needs, limit, .. }) => {
            vec![("needs", *needs), ("limit", *limit)]
        }
        InfeasibleReason::NoPlace(_)
        | InfeasibleReason::NoFreePose { .. }
        | InfeasibleReason::BlockedPath { .. }
        | InfeasibleReason::NotInView { aside: None, .. } => {
            vec![]
        }
    }
}

/// Answer as a JSON object.
pub(super) fn json_line(
    (machine, world): (&RobotModel, &SceneState),
    query: &MotionQuery,
    answer: &MotionAnswer,
) -> String {
    let mut object = Map::new();
    object.insert("query".into(), query.to_string().into());
    match answer {
        MotionAnswer::Feasible(witness) => {
            object.insert("answer".into(), "feasible".into());
            object.insert("witness".into(), witness_json(machine, world, witness));
        }
        MotionAnswer::Infeasible(why) => {
            object.insert("answer".into(), "infeasible".into());
            object.insert("reason".into(), why.reason.name().into());
            object.insert("says".into(), why.says().into());
            for (name, value) in numbers(&why.reason) {
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

fn witness_json(machine: &RobotModel, world: &SceneState, witness: &MotionWitness) -> Value {
    let grasp = witness.grasp.as_ref().map(|grasp| {
        let side = match grasp.side {
            GraspSide::Top => "top",
            GraspSide::Side => "side",
            GraspSide::Front => "front",
        };
        let pose = |(xyz, turn): ([f64; 3], [f64; 4])| json!({"xyz": xyz, "quaternion_xyzw": turn});
        json!({
            "object": grasp.object, "side": side, "width": grasp.width,
            "map_from_tip": pose(components(&grasp.map_from_tip)),
            "tip_from_object": pose(components(&grasp.tip_from_object)),
        })
    });
    let load = world.held.is_some().then_some(machine);
    let times = MotionLimits::of(machine).times_with_load(&witness.path, SpeedShare::FULL, load);
    json!({
        "path": witness.path.iter().zip(times).map(|(at, time)| state(machine, at, time)).collect::<Vec<_>>(),
        "grasp": grasp,
        "margins": {
            "clearance": witness.margins.clearance,
            "required": {"base": witness.margins.required.base_m, "arm": witness.margins.required.arm_m},
            "limit": witness.margins.limit,
            "payload": witness.margins.payload,
        },
    })
}

fn state(machine: &RobotModel, state: &Configuration, time: PathTime) -> Value {
    let names = machine.tree().dofs().iter().map(|dof| dof.name.to_string());
    let joints: Map<String, Value> = names.zip(state.joints.iter().map(|value| json!(value))).collect();
    json!({"base": state.base, "joints": joints, "at": time.at, "ramp": time.ramp})
}

#[cfg(test)]
mod tests {

    #[test]
    fn degrees_are_within_a_half_turn() {
        for (angle, shown) in [(-3.16, 179.0), (3.15, 180.0), (0.0, 0.0), (7.0, 41.0), (-1.57, -90.0)] {
            assert_eq!(super::degrees(angle), shown, "{angle}");
        }
    }
}
