//! `motet ros2 check`: what a binding binds of a robot, and what not.

use crate::bind::{Binding, CallKind, Deed};
use crate::layout::Layouts;
use crate::plan::Card;
use crate::robot::Robot;
use motet_project::{Discard, open_robot};
use motet_robots::scene::Scene;
use motet_syntax::Sources;
use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Time in which DDS discovers the nodes of a robot.
const DISCOVERS: Duration = Duration::from_secs(3);
/// Facts that the driver believes by what its own goals did, and measures that follow from poses.
const BELIEVED: [&str; 13] = [
    "holding", "lifted", "free", "at", "on", "in", "open", "clear", "near", "visited", "standing", "visible",
    "distance",
];

/// Reads a scene.
///
/// # Errors
///
/// There is no such scene, or it has errors.
pub(crate) fn read_scene(name: &str) -> Result<Scene, String> {
    motet_project::read_scene(name, &mut Sources::default(), &mut Discard).map_err(|error| error.to_string())
}

/// Data of the card of a robot, and `program`, the command that plans its paths.
///
/// # Errors
///
/// There is no such robot, or it has errors.
pub(crate) fn read_card(robot: &str, program: Option<PathBuf>) -> Result<Card, String> {
    let opened = open_robot(robot, &mut Sources::default(), &mut Discard);
    let (card, urdf) = opened.map_err(|error| error.to_string())?;
    let joints = urdf.into_iter().flat_map(|urdf| urdf.joints);
    let limited = joints.filter_map(|joint| {
        let limits = joint.limits?;
        Some((joint.name.to_string(), (limits.lower, limits.upper)))
    });
    let limits = limited.collect();
    let mut postures = BTreeMap::new();
    for (name, posture) in &card.postures {
        let joints = posture.iter().map(|(joint, position)| (joint.to_string(), *position));
        postures.insert(name.to_string(), joints.collect());
    }
    Ok(Card { name: robot.to_owned(), program, limits, postures, clearance: card.clearance })
}

/// Lines about a binding, and the number of problems.
#[derive(Default)]
struct Report {
    lines: Vec<String>,
    problems: usize,
}

impl Report {
    fn good(&mut self, name: &str, text: &str) {
        self.lines.push(format!("  ✓ {name:<22} {text}"));
    }

    fn none(&mut self, name: &str, text: &str) {
        self.lines.push(format!("  – {name:<22} {text}"));
    }

    fn wrong(&mut self, name: &str, text: &str) {
        self.problems += 1;
        self.lines.push(format!("  ✗ {name:<22} {text}"));
    }

    fn title(&mut self, text: &str) {
        self.lines.push(format!("\n{text}"));
    }
}

/// Prints what a binding binds of a robot, and compares it with the nodes of the network if `live`. The exit
/// status is 1 if something is wrong.
///
/// # Errors
///
/// The binding, the robot or a layout cannot be read, or DDS does not start.
pub(crate) fn check(
    name: &str,
    robot: Option<&str>,
    live: bool,
    folder: Option<&Path>,
) -> Result<u8, String> {
    let binding = Binding::read(name)?;
    let layouts = Layouts::of(binding.ros.distribution, folder)?;
    let robot = crate::robot_of(&binding, robot)?;
    let opened = open_robot(&robot, &mut Sources::default(), &mut Discard);
    let (card, urdf) = opened.map_err(|error| error.to_string())?;
    let joints: Vec<String> = urdf.map_or_else(Vec::new, |urdf| {
        let moving = urdf.joints.iter().filter(|joint| joint.kind != motet_robots::urdf::JointKind::Fixed);
        moving.map(|joint| joint.name.to_string()).collect()
    });
    let mut report = Report::default();
    report.lines.push(format!(
        "{} with `{name}`: ROS 2 {}, {:?}, domain {}",
        card.title,
        binding.ros.distribution,
        binding.ros.middleware,
        binding.domain()
    ));
    check_primitives(&binding, card.primitives.keys().map(smol_str::SmolStr::as_str), &mut report);
    check_joints(&binding, &joints, &mut report);
    check_observations(&binding, card.observes.iter().map(smol_str::SmolStr::as_str), &mut report);
    // Opening tries every type and every expression.
    let mut opened = Robot::open(binding, layouts)?;
    if live {
        compare(&mut opened, &mut report);
    }
    report.title(&match report.problems {
        0 => "no problem".to_owned(),
        1 => "1 problem".to_owned(),
        count => format!("{count} problems"),
    });
    // Nobody may read to the end.
    let _ = writeln!(std::io::stdout(), "{}", report.lines.join("\n"));
    Ok(u8::from(report.problems > 0))
}

fn check_primitives<'a>(binding: &Binding, known: impl Iterator<Item = &'a str>, report: &mut Report) {
    report.title("primitives");
    let known: Vec<&str> = known.collect();
    for primitive in &known {
        match binding.steps(primitive) {
            Some(steps) => {
                let steps: Vec<String> = steps.iter().map(|step| words(&step.deed)).collect();
                report.good(primitive, &steps.join(", "));
            }
            None => report.none(primitive, "not bound: a call is refused"),
        }
    }
    for primitive in binding.primitives.keys().filter(|own| !known.contains(&own.as_str())) {
        report.wrong(primitive, "bound, and the robot has no such primitive");
    }
}

fn words(deed: &Deed) -> String {
    match deed {
        Deed::Motion(direction) => format!("motion {direction:?}").to_lowercase(),
        Deed::Gripper(opening) => format!("gripper {opening:?}").to_lowercase(),
        Deed::Call(call) => {
            let kind = match call.kind {
                CallKind::Action => "action",
                CallKind::Service => "service",
                CallKind::Topic => "topic",
            };
            format!("{kind} {}", call.name)
        }
        Deed::Wait(secs) => format!("wait {secs} s"),
        Deed::Require(text) => format!("require {text}"),
        Deed::Look => "look".to_owned(),
        Deed::Detect => "detect".to_owned(),
        Deed::Answer { topic, .. } => format!("answer {topic}"),
    }
}

fn check_joints(binding: &Binding, joints: &[String], report: &mut Report) {
    report.title("joints");
    for joint in joints {
        let ros = binding.ros_joint(joint);
        let controller = binding.controllers.iter().find(|one| one.joints.iter().any(|own| own == ros));
        match controller {
            Some(controller) => report.good(joint, &controller.action),
            None => report.none(joint, "no controller"),
        }
    }
    for joint in binding.controllers.iter().flat_map(|controller| &controller.joints) {
        let card = binding.card_joint(joint);
        if !joints.iter().any(|own| own == card) {
            report.wrong(joint, "has a controller, and the URDF has no such joint");
        }
    }
    match &binding.move_group {
        Some(bound) => {
            report.good("motions without a path", &format!("{} for {}", bound.action, bound.group))
        }
        None => report.none("motions without a path", "fail"),
    }
    match (
        &binding.base.odometry,
        binding.controllers.iter().find(|one| !one.base.is_empty()),
        &binding.navigation,
    ) {
        (None, ..) => {
            report.none("base", "no odometry: the robot does not drive, and a stop asks its joints only")
        }
        (_, Some(controller), _) => {
            report.good("base", &format!("{}, follows certified paths", controller.action))
        }
        (_, None, Some(navigation)) => {
            report.good("base", &format!("{}, goes to the end of a path", navigation.action))
        }
        (_, None, None) => report.wrong("base", "has odometry, and nothing that drives it"),
    }
}

fn check_observations<'a>(binding: &Binding, observed: impl Iterator<Item = &'a str>, report: &mut Report) {
    report.title("facts and measures");
    let observed: Vec<&str> = observed.collect();
    for name in &observed {
        let bound = binding.facts.get(*name).or_else(|| binding.measures.get(*name));
        match bound {
            Some(bound) => report.good(name, &format!("{} on {}", bound.value, bound.topic)),
            None if BELIEVED.contains(name) => report.none(name, "by what the driver believes"),
            None => report.none(name, "unknown"),
        }
    }
    for name in binding.facts.keys().chain(binding.measures.keys()) {
        if !observed.contains(&name.as_str()) {
            report.wrong(name, "bound, and the robot does not observe it");
        }
    }
}

/// Compares with the nodes that DDS discovers.
fn compare(robot: &mut Robot, report: &mut Report) {
    let begun = Instant::now();
    while begun.elapsed() < DISCOVERS {
        let message = robot.received.recv_timeout(Duration::from_millis(50));
        let heard = message.map(|message| robot.hear(&message, &|_| false));
        drop(heard);
        robot.tick();
    }
    report.title("the network");
    for at in 0..robot.actions.len() {
        let name = robot.actions[at].name.clone();
        match robot.missing(at) {
            [] => report.good(&name, "its server is there"),
            missing => report.wrong(&name, &format!("nobody serves {}", missing.join(", "))),
        }
    }
    let [readers, writers] = robot.graph();
    for (topic, is_written) in robot.topics() {
        let name = topic.trim_start_matches("rt").to_owned();
        let others = if is_written { &readers } else { &writers };
        let found: Vec<&str> =
            others.iter().filter(|one| one.topic == topic).map(|one| one.type_name.as_str()).collect();
        match (found.first(), is_written) {
            (Some(type_name), false) => report.good(&name, &format!("sent as {type_name}")),
            (Some(type_name), true) => report.good(&name, &format!("read as {type_name}")),
            (None, false) => report.wrong(&name, "nobody sends it"),
            (None, true) => report.wrong(&name, "nobody reads it"),
        }
    }
    let base = robot.body.base(&robot.binding);
    match base {
        Ok(base) => {
            report.good("pose of the base", &format!("({:.2}, {:.2}) m, {:.2} rad", base.x, base.y, base.yaw))
        }
        Err(why) if robot.binding.base.odometry.is_some() => report.wrong("pose of the base", &why),
        Err(_) => {}
    }
}
