//! `motet ros2 check`: what a binding binds of a robot, and what not.

mod contract;
mod live;

use crate::bind::{Binding, CallKind, StepKind};
use crate::plan::Card;
use crate::robot::Robot;
use motet_project::{Discard, Project, open_robot};
use motet_robots::scene::Scene;
use motet_stdlib::lang::{fluents, measures};
use motet_syntax::Sources;
use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// True for facts that the driver believes by what its own goals did, and measures that follow from poses.
fn is_believed(name: &str) -> bool {
    let is_sensed = matches!(name, fluents::REACHABLE | fluents::STANDING);
    fluents::ALL.contains(&name) && !is_sensed || name == measures::DISTANCE
}

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
    let open = card.hands.values().flat_map(|hand| &hand.open);
    let open_hand = open.map(|(joint, position)| (joint.to_string(), *position)).collect();
    Ok(Card { name: robot.to_owned(), program, limits, postures, open_hand, clearance: card.clearance })
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
    let layouts = binding.layouts(folder)?;
    let robot = crate::robot_of(&binding, robot)?;
    let mut report = Report::default();
    check_offline(&binding, name, &robot, &mut report)?;
    // Opening tries every type and every expression.
    let mut opened = Robot::open(binding, layouts)?;
    if live {
        live::compare(&mut opened, &mut report);
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

/// Compares a binding with the card of its robot and the declarations of its primitives.
fn check_offline(binding: &Binding, name: &str, robot: &str, report: &mut Report) -> Result<(), String> {
    let opened = open_robot(robot, &mut Sources::default(), &mut Discard);
    let (card, urdf) = opened.map_err(|error| error.to_string())?;
    let project = Project::builder().robot(robot).without_motions().open();
    let project = project.and_then(|project| project.into_session(&mut Discard));
    let project = project.map_err(|error| error.to_string())?;
    let joints: Vec<String> = urdf.map_or_else(Vec::new, |urdf| {
        let moving = urdf.joints.iter().filter(|joint| joint.kind != motet_robots::urdf::JointKind::Fixed);
        moving.map(|joint| joint.name.to_string()).collect()
    });
    report.lines.push(format!(
        "{} with `{name}`: ROS 2 {}, {:?}, domain {}",
        card.title,
        binding.ros.distribution,
        binding.ros.middleware,
        binding.domain()
    ));
    check_primitives(binding, card.primitives.keys().map(smol_str::SmolStr::as_str), report);
    let signatures = project.session.signatures();
    let kinds: Vec<&str> = signatures.kinds.iter().map(|kind| kind.name.as_str()).collect();
    for declared in project.session.library().signatures() {
        for finding in contract::findings(binding, declared, &card, &kinds) {
            report.wrong(&declared.name.text, &finding);
        }
    }
    if let Some(finding) = contract::of_gripper(binding) {
        report.wrong("gripper", &finding);
    }
    check_joints(binding, &joints, report);
    check_observations(binding, card.observes.iter().map(smol_str::SmolStr::as_str), report);
    Ok(())
}

fn check_primitives<'a>(binding: &Binding, known: impl Iterator<Item = &'a str>, report: &mut Report) {
    report.title("primitives");
    let known: Vec<&str> = known.collect();
    for primitive in &known {
        match binding.steps(primitive) {
            Some(steps) => {
                let steps: Vec<String> = steps.iter().map(|step| words(&step.kind)).collect();
                report.good(primitive, &steps.join(", "));
            }
            None => report.none(primitive, "not bound: a policy that calls it is refused"),
        }
    }
    for primitive in binding.primitives.keys().filter(|own| !known.contains(&own.as_str())) {
        report.wrong(primitive, "bound, and the robot has no such primitive");
    }
}

fn words(kind: &StepKind) -> String {
    match kind {
        StepKind::Motion(direction) => format!("motion {direction:?}").to_lowercase(),
        StepKind::Posture(name) => format!("posture {name}"),
        StepKind::Go(place) => format!("go to {place}"),
        StepKind::Gripper(opening) => format!("gripper {opening:?}").to_lowercase(),
        StepKind::Call(call) => {
            let kind = match call.kind {
                CallKind::Action => "action",
                CallKind::Service => "service",
                CallKind::Topic => "topic",
            };
            format!("{kind} {}", call.name)
        }
        StepKind::Wait(secs) => format!("wait {secs} s"),
        StepKind::Require(text) => format!("require {text}"),
        StepKind::Look => "look".to_owned(),
        StepKind::Detect => "detect".to_owned(),
        StepKind::Search => "search".to_owned(),
        StepKind::Answer { topic, .. } => format!("answer {topic}"),
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
            None if is_believed(name) => report.none(name, "by the beliefs of the driver"),
            None => report.none(name, "unknown"),
        }
    }
    for name in binding.facts.keys().chain(binding.measures.keys()) {
        if !observed.contains(&name.as_str()) {
            report.wrong(name, "bound, and the robot does not observe it");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bind::BUILT_IN;
    use std::collections::BTreeSet;

    const EXAMPLES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");

    fn problems(binding: &Binding, robot: &str) -> Vec<String> {
        let mut report = Report::default();
        check_offline(binding, "own", robot, &mut report).unwrap();
        report.lines.into_iter().filter(|line| line.contains('✗')).collect()
    }

    #[test]
    fn built_in_bindings_fit_their_robots() {
        let mut checked = Vec::new();
        for (name, _) in BUILT_IN {
            let binding = Binding::read(name).unwrap();
            let Some(robot) = binding.robot.clone() else { continue };
            assert_eq!(problems(&binding, &robot), [""; 0], "{name}");
            checked.push(name);
        }
        assert_eq!(checked, ["hsr", "anymal_z1"]);
    }

    /// Bindings without a robot of their own have the standard primitives, which those of the HSR are.
    #[test]
    fn built_in_bindings_without_a_card_fit_the_standard_primitives() {
        for name in ["nav2_arm", "tiago"] {
            let found = problems(&Binding::read(name).unwrap(), "hsr");
            let of_steps: Vec<_> = found.iter().filter(|line| line.contains("step ")).collect();
            assert!(of_steps.is_empty(), "{name}: {of_steps:?}");
        }
    }

    /// Number of the examples of a robot, and the primitives that they call and its binding does not have.
    fn unbound(robot: &str) -> (usize, BTreeSet<String>) {
        let binding = Binding::read(robot).unwrap();
        let (mut count, mut missing) = (0, BTreeSet::new());
        for file in std::fs::read_dir(EXAMPLES).unwrap().map(|entry| entry.unwrap().path()) {
            let is_policy = file.extension().is_some_and(|end| end == "motet");
            let text = std::fs::read_to_string(&file).ok().filter(|_| is_policy).unwrap_or_default();
            // The first lines say where the policy runs.
            let scene =
                text.split_once(&format!("Robot {robot}, scene ")).and_then(|(_, rest)| rest.split_once('.'));
            let Some((scene, _)) = scene else { continue };
            let project = Project::builder().robot(robot).scene(scene).without_motions().open().unwrap();
            let opened = project.into_session(&mut Discard).unwrap();
            let source = motet_syntax::Source::new("example", text.clone());
            let parsed = motet_syntax::read(&source, motet_project::DOCUMENT);
            let graph = opened.session.compile(&parsed, None).graph.unwrap_or_else(|| panic!("{file:?}"));
            let names = graph.primitives.iter().map(|primitive| primitive.name.to_string());
            missing.extend(names.filter(|name| binding.steps(name).is_none()));
            count += 1;
        }
        (count, missing)
    }

    #[test]
    fn examples_of_the_robots_are_bound() {
        assert_eq!(unbound("hsr"), (16, BTreeSet::new()));
        assert_eq!(unbound("anymal_z1"), (2, BTreeSet::new()));
    }

    #[test]
    fn steps_that_do_not_fit_their_primitive_are_found_with_their_lines() {
        let text = r#"
joints = { topic = "/joint_states" }
[primitives.say]
steps = [{ motion = "there" }, { topic = "/say", type = "std_msgs/String", message = { data = "{txt}" } }]
[primitives.turn]
steps = [
    { action = "/turn", type = "nav2_msgs/Spin", message = { target_yaw = "{by in deg}" } },
    { action = "/turn", type = "nav2_msgs/Spin", message = { target_yaw = "{by in mm}" }, fails = "blokced" },
]
[primitives.pick]
steps = [
    { topic = "/pick", type = "std_msgs/String", message = { data = "{object.pose in base} {from.pose}" } },
    { posture = "hme", fails = "timeout" },
    { topic = "/pick", type = "std_msgs/String", message = { data = "{object in base}" }, fails = "melted" },
]
[primitives.home]
steps = [{ search = true }, { wait_secs = 1.0, fails = "slipped" }]
"#;
        let found = problems(&Binding::parse(text, "own").unwrap(), "hsr");
        let found: Vec<String> =
            found.iter().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
        let expected = [
            "✗ home step 1 in line 17: `home` has no argument that says what to look for",
            "✗ home step 2 in line 17: `fails = \"slipped\"` is no failure of `home`: `blocked`",
            "✗ pick step 1 in line 12: `{from.pose}`: `from` has no `pose`",
            "✗ pick step 2 in line 13: the robot has no posture `hme`: did you mean `home`?",
            "✗ pick step 3 in line 14: `fails = \"melted\"` is no failure of `pick`: `not_found`, \
             `unreachable`, `blocked`, `slipped` or `too_heavy`",
            "✗ pick step 3 in line 14: `{object in base}`: `object` has neither a frame nor a unit",
            "✗ say step 1 in line 4: `say` declares no motion",
            "✗ say step 2 in line 4: `{txt}` is no argument of `say`: did you mean `text`?",
            "✗ turn step 2 in line 8: `fails = \"blokced\"` is no failure of `turn`: did you mean `blocked`?",
            "✗ turn step 2 in line 8: `mm` is no unit of Angle: `rad` or `deg`",
        ];
        let mut sorted = found;
        sorted.sort();
        assert_eq!(sorted, expected);
    }

    #[test]
    fn values_of_the_hand_are_its_width() {
        let text = "joints = { topic = \"j\" }\n\
             [gripper]\naction = \"/hand\"\ntype = \"t\"\nopen = {}\nclose = {}\n";
        let of = |width: &str| {
            let binding = Binding::parse(&format!("{text}width = {{ p = \"{width}\" }}"), "own").unwrap();
            contract::of_gripper(&binding)
        };
        assert_eq!(of("{width}"), None);
        assert_eq!(of("{width in mm}"), None);
        assert_eq!(of("{width in deg}").unwrap(), "`deg` is no unit of Length: `m`, `cm`, `mm` or `km`");
        assert!(of("{depth}").unwrap().starts_with("`{depth}` is no value of the hand"));
    }
}
