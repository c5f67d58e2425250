//! Motions that MoveGroup of MoveIt plans and carries out, where no certified path exists.

use super::{Move, Phase, Surroundings, Task};
use crate::cdr::Message;
use crate::group::{GraspPose, MoveGroup};
use crate::plan::NoPath;
use crate::robot::Robot;
use crate::template::of_pose;
use crate::tf::Transform;
use motet_graph::{Value as Argument, Witness};
use serde_json::{Value, json};

/// Type of a sphere in `shape_msgs/SolidPrimitive`.
const SPHERE: u8 = 2;
/// Code of success in `moveit_msgs/MoveItErrorCodes`.
const SUCCESS: i64 = 1;
/// Other codes of `moveit_msgs/MoveItErrorCodes`, in words.
const ERRORS: [(i64, &str); 14] = [
    (99999, "it failed"),
    (-1, "the planning failed"),
    (-2, "the plan is invalid"),
    (-3, "the surroundings changed"),
    (-4, "a controller failed"),
    (-6, "it took too long"),
    (-7, "somebody preempted it"),
    (-10, "the robot collides where it stands"),
    (-12, "the goal collides"),
    (-14, "the goal was missed"),
    (-15, "there is no such planning group"),
    (-18, "there is no such link"),
    (-21, "a transform is missing"),
    (-31, "there is no solution of the inverse kinematics"),
];

impl Task {
    /// Moves by MoveGroup to where a motion without a path ends. Without MoveGroup, or if it is certain that
    /// there is no path, the step fails.
    pub(super) fn plan_by_move_group(&mut self, around: &mut Surroundings<'_>, why: &NoPath) {
        let bound = around.robot.binding.move_group.clone().filter(|_| !why.is_certified);
        let Some(bound) = bound else {
            self.fail(around, why.says.clone());
            return;
        };
        let goals = self.group_goals(around, &bound);
        let goals = goals.map_err(|wrong| format!("{}; MoveGroup has no goal: {wrong}", why.says));
        match goals {
            Ok(goals) => {
                let text = format!("{}; MoveGroup plans a way that nobody has certified", why.says);
                self.own_motions.push(text);
                self.before = Some(controlled(around.robot));
                self.move_group(around.robot, &bound, goals);
            }
            Err(text) => self.fail(around, text),
        }
    }

    /// Moves back to where the joints were.
    pub(super) fn return_by_move_group(&mut self, around: &mut Surroundings<'_>, before: &[(String, f64)]) {
        match around.robot.binding.move_group.clone() {
            Some(bound) => self.move_group(around.robot, &bound, vec![at_joints(&bound, before)]),
            None => self.fail(around, "MoveGroup is not bound".to_owned()),
        }
    }

    fn move_group(&mut self, robot: &Robot, bound: &MoveGroup, goals: Vec<Value>) {
        // Both scenes are differences: without this MoveIt would forget what it knows.
        let scene = json!({"is_diff": true, "robot_state": {"is_diff": true}});
        // A slower manner slows this way down, too; MoveGroup does not go faster than the binding says.
        let stretch = self.command.manner.map_or(1.0, motet_graph::Manner::stretch).max(1.0);
        let frame = bound.frame.as_ref().unwrap_or(&robot.binding.frames.base);
        self.moves.push_back(Move::Group(json!({
            "request": {
                "workspace_parameters": {
                    "header": {"frame_id": frame},
                    "min_corner": {"x": -10.0, "y": -10.0, "z": -10.0},
                    "max_corner": {"x": 10.0, "y": 10.0, "z": 10.0},
                },
                "start_state": {"is_diff": true},
                "goal_constraints": goals,
                "pipeline_id": bound.pipeline,
                "planner_id": bound.planner,
                "group_name": bound.group,
                "num_planning_attempts": bound.attempts,
                "allowed_planning_time": bound.planning_secs,
                "max_velocity_scaling_factor": bound.speed / stretch,
                "max_acceleration_scaling_factor": bound.acceleration / stretch,
            },
            "planning_options": {"planning_scene_diff": scene},
        })));
        self.phase = Phase::Next;
    }

    /// Goals of MoveGroup for the motion of the command, any of which will do.
    fn group_goals(&self, around: &Surroundings<'_>, bound: &MoveGroup) -> Result<Vec<Value>, String> {
        let motion = self.command.motions.first().ok_or("the command has no motion")?;
        if let Some(witness) = &motion.witness {
            return end_of(around.robot, witness).map(|joints| vec![at_joints(bound, &joints)]);
        }
        let posture = |name: &str| around.card.postures.get(name);
        let query = motion.query.as_str();
        let first = if query == "reach_at" { motion.args.get(1) } else { motion.args.first() };
        let thing = match (query, first) {
            ("posture", Some(Argument::Case(name) | Argument::Text(name) | Argument::Entity(name))) => {
                let posture = posture(name).ok_or_else(|| format!("there is no posture `{name}`"))?;
                let joints: Vec<(String, f64)> = posture
                    .iter()
                    .map(|(joint, position)| (around.robot.binding.ros_joint(joint).to_owned(), *position))
                    .filter(|(joint, _)| around.robot.binding.controls(joint))
                    .collect();
                return Ok(vec![at_joints(bound, &joints)]);
            }
            ("reach", Some(Argument::Entity(id))) => {
                around.world.pose(id).ok_or_else(|| format!("nobody knows where `{id}` is"))?
            }
            ("reach" | "reach_at", Some(Argument::Pose(pose))) => Transform::from(*pose),
            _ => return Err(format!("`{query}` says no pose of the hand")),
        };
        let Some(link) = bound.link.as_ref().filter(|_| !bound.grasps.is_empty()) else {
            return Err("[move_group] has no `link` with `grasps`".to_owned());
        };
        let frames = &around.robot.binding.frames;
        let frame = bound.frame.as_ref().unwrap_or(&frames.base);
        let from_map = around.robot.body.frames.look_up(frame, &frames.map, None, frames.age_secs)?;
        let grasp = |grasp: &GraspPose| {
            let pose = from_map.then(thing).then(Transform::from_rpy(grasp.xyz, grasp.rpy));
            at_pose(bound, link, frame, pose)
        };
        Ok(bound.grasps.iter().map(grasp).collect())
    }
}

/// Positions of all joints that a controller moves, by their names in ROS.
fn controlled(robot: &Robot) -> Vec<(String, f64)> {
    let positions = robot.body.positions().into_iter();
    positions.filter(|(joint, _)| robot.binding.controls(joint)).collect()
}

/// Joints at the end of a path by their names in ROS, if the base stands where the path ends.
fn end_of(robot: &Robot, witness: &Witness) -> Result<Vec<(String, f64)>, String> {
    let binding = &robot.binding;
    let last = witness.path.last().ok_or("the path has no waypoint")?;
    if binding.base.odometry.is_some()
        && let Some(away) = super::moving::base_away(robot.body.base(binding)?, last.base, binding)
    {
        return Err(format!("the base is {away} from where the path ends"));
    }
    let joints = witness.joints.iter().zip(&last.joints);
    let joints = joints.map(|(joint, position)| (binding.ros_joint(joint).to_owned(), *position));
    Ok(joints.filter(|(joint, _)| binding.controls(joint)).collect())
}

/// `moveit_msgs/Constraints` for positions of joints.
fn at_joints(bound: &MoveGroup, joints: &[(String, f64)]) -> Value {
    let joints: Vec<Value> = joints
        .iter()
        .map(|(joint, position)| {
            json!({"joint_name": joint, "position": position, "tolerance_above": bound.rotation,
                "tolerance_below": bound.rotation, "weight": 1.0})
        })
        .collect();
    json!({"joint_constraints": joints})
}

/// `moveit_msgs/Constraints` for a pose of a link.
fn at_pose(bound: &MoveGroup, link: &str, frame: &str, pose: Transform) -> Value {
    let header = json!({"frame_id": frame});
    let centre = of_pose(pose.xyz, [0.0, 0.0, 0.0, 1.0]);
    let orientation = of_pose(pose.xyz, pose.quaternion)["orientation"].take();
    json!({
        "position_constraints": [{
            "header": header,
            "link_name": link,
            "constraint_region": {
                "primitives": [{"type": SPHERE, "dimensions": [bound.position]}],
                "primitive_poses": [centre],
            },
            "weight": 1.0,
        }],
        "orientation_constraints": [{
            "header": header,
            "link_name": link,
            "orientation": orientation,
            "absolute_x_axis_tolerance": bound.rotation,
            "absolute_y_axis_tolerance": bound.rotation,
            "absolute_z_axis_tolerance": bound.rotation,
            "weight": 1.0,
        }],
    })
}

/// Code of a result of MoveGroup.
fn code(result: &Message) -> Option<i64> {
    match result.get("error_code.val")? {
        Message::Int(code) => Some(*code),
        _ => None,
    }
}

/// True for the result of MoveGroup that says that it failed.
pub(super) fn is_failure(result: &Message) -> bool {
    code(result).is_some_and(|code| code != SUCCESS)
}

/// Error of a result in words.
pub(super) fn error(result: &Message) -> String {
    let Some(code) = code(result) else {
        let parts = ["error_code", "error_string", "error_msg"].map(|field| match result.get(field) {
            Some(Message::Text(text)) => text.clone(),
            Some(Message::Int(code)) => code.to_string(),
            Some(Message::Uint(code)) => code.to_string(),
            _ => String::new(),
        });
        return parts.iter().filter(|part| !part.is_empty()).cloned().collect::<Vec<_>>().join(" ");
    };
    let words = ERRORS.iter().find(|(own, _)| *own == code).map_or("an error", |(_, words)| words);
    match result.get("error_code.message") {
        Some(Message::Text(text)) if !text.is_empty() => format!("{words} ({code}): {text}"),
        _ => format!("{words} ({code})"),
    }
}
