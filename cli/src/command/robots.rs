//! `motet robots`: lists and shows robots, checks their files, and writes the card of a new one.

mod add;
mod mjcf;
mod xacro;

use std::path::PathBuf;

use clap::{Args, Subcommand};
use motet_geometry::kinematics::KinematicChain;
use motet_geometry::planning::{AllowedCollisions, Contact, IkSolver, QueryContext, RobotModel, SceneState};
use motet_project::{ProjectError, RobotFiles, SessionInputs, robot_names, touching};
use motet_robots::card::{Drive, Range, Robot};
use motet_robots::clearance::Clearance;
use motet_robots::scene::Scene;
use motet_robots::urdf::Urdf;
use motet_syntax::ast::{Item, PrimitiveDecl, TypeExpr};
use motet_syntax::unit::Dimension;
use motet_syntax::{FileId, Source, Sources};
use smol_str::SmolStr;

use crate::error::{CliError, Exit};
use crate::flags::DiagnosticFormat;
use crate::output::{Colors, count};
use crate::report::Report;

/// Flags of `motet robots`.
#[derive(Args, Debug)]
pub(crate) struct RobotsArgs {
    /// Action [default: list]
    #[command(subcommand)]
    command: Option<RobotsCommand>,
}

/// Subcommands of `motet robots`.
#[derive(Subcommand, Debug)]
enum RobotsCommand {
    /// List the built-in robots
    List,
    /// Show a robot: its body, its observations, and the signature of each primitive
    Show {
        /// Built-in name, or folder with a robot.toml
        #[arg(value_name = "NAME|FOLDER")]
        name: String,
    },
    /// Check that a robot's card and URDF are correct and fit each other
    Check {
        /// Built-in name, or folder with a robot.toml
        #[arg(value_name = "NAME|FOLDER")]
        name: String,
    },
    /// Write a MuJoCo model of a robot in a scene
    Mjcf(mjcf::MjcfArgs),
    /// Write a first card for a robot from its URDF
    Add {
        /// URDF or xacro of the robot; of a xacro, the URDF is written beside the card
        #[arg(value_name = "URDF")]
        urdf: PathBuf,
        /// Folder for the robot.toml [default: folder of the URDF]
        #[arg(long, value_name = "FOLDER")]
        to: Option<PathBuf>,
        /// SRDF of the robot [default: the one beside the URDF]
        #[arg(long, value_name = "SRDF")]
        srdf: Option<PathBuf>,
        /// Folder that holds ROS packages, for `package://` and `$(find …)`; repeatable
        #[arg(long, value_name = "FOLDER")]
        packages: Vec<PathBuf>,
        /// Argument of a xacro; repeatable
        #[arg(long = "arg", value_name = "NAME:=VALUE")]
        arguments: Vec<String>,
        /// Link of the tip of the hand, where the card is to have another arm than the one that is found
        #[arg(long, value_name = "LINK")]
        tip: Option<String>,
    },
}

/// Runs the command.
pub(crate) fn run(args: &RobotsArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run(DiagnosticFormat::Human, colors, |report| match &args.command {
        None | Some(RobotsCommand::List) => list(report),
        Some(RobotsCommand::Show { name }) => show(name, report),
        Some(RobotsCommand::Check { name }) => check(name, report),
        Some(RobotsCommand::Mjcf(args)) => mjcf::run(args, report),
        Some(RobotsCommand::Add { urdf, to, srdf, packages, arguments, tip }) => {
            let inputs = add::AddInputs {
                urdf,
                to: to.as_deref(),
                srdf: srdf.as_deref(),
                packages,
                arguments,
                tip: tip.as_deref(),
            };
            add::add(&inputs, report)
        }
    })
}

fn list(report: &mut Report) -> Result<Exit, CliError> {
    let width = robot_names().map(str::len).max().unwrap_or_default();
    for name in robot_names() {
        let robot = RobotFiles::find(name)?.card(&mut Sources::default(), report)?;
        let hands = robot.hands.first().map_or_else(String::new, |(_, hand)| {
            format!(", carries {} kg, reaches {} m", hand.payload_kg, hand.reach_m)
        });
        let primitives = robot.primitives.len();
        report.out.line(&format!("{name:width$}  {}: {primitives} primitives{hands}", robot.title));
    }
    Ok(Exit::Success)
}

fn show(name: &str, report: &mut Report) -> Result<Exit, CliError> {
    let robot = RobotFiles::find(name)?.card(&mut Sources::default(), report)?;
    body(&robot, report);
    let declared = signatures(&robot);
    for (primitive, bounds) in &robot.primitives {
        match declared.iter().rfind(|(decl, _)| decl.name.text == *primitive) {
            Some((decl, text)) => report.out.text(&signature(decl, text, bounds)),
            None => report.out.line(&format!("\n// {primitive}: not declared")),
        }
    }
    Ok(Exit::Success)
}

fn body(robot: &Robot, report: &mut Report) {
    let base = &robot.base;
    let drive = match base.drive {
        Drive::Fixed => "fixed".to_owned(),
        Drive::Omnidirectional => format!("omnidirectional, {} m/s", base.speed_m_per_s),
        Drive::Differential => format!("differential drive, {} m/s", base.speed_m_per_s),
        Drive::Legged => format!("legged, {} m/s", base.speed_m_per_s),
    };
    report.out.line(&format!("{} ({})", robot.title, robot.name));
    report.out.line(&format!("  base      {drive}, radius {} m", base.radius_m));
    for (name, hand) in &robot.hands {
        report.out.line(&format!(
            "  {name:8}  hand: up to {} kg and {} m wide, reaches {} m at heights of {}",
            hand.payload_kg,
            hand.opening_m,
            hand.reach_m,
            range(&hand.heights_m, "m"),
        ));
    }
    for (name, camera) in &robot.cameras {
        let view = camera.view_rad.to_degrees().round();
        report.out.line(&format!("  {name:8}  camera: sees {} m, {view}° wide", camera.range_m));
    }
    for (name, parts) in robot.resources.iter().filter(|(_, parts)| !parts.is_empty()) {
        report.out.line(&format!("  {name:8}  contains {}", parts.join(", ")));
    }
    let Clearance { base_m, arm_m } = robot.clearance;
    report.out.line(&format!("  keeps     {base_m} m from obstacles with the base, {arm_m} m with the arm"));
    for (number, fact) in observations(robot).iter().enumerate() {
        let label = if number == 0 { "observes" } else { "" };
        report.out.line(&format!("  {label:8}  {fact}"));
    }
    if !robot.initially.is_empty() {
        report.out.line(&format!("  at first  {}", robot.initially.join(", ")));
    }
}

/// Declarations of primitives with their texts; a later one overrides an earlier one.
pub(crate) fn signatures(robot: &Robot) -> Vec<(PrimitiveDecl, String)> {
    let primitive = |(item, text)| match item {
        Item::Primitive(decl) => Some((decl, text)),
        _ => None,
    };
    declared(robot).into_iter().filter_map(primitive).collect()
}

/// Facts and measures that the robot observes, with their parameters.
fn observations(robot: &Robot) -> Vec<String> {
    let declared = declared(robot);
    let shown = |observed: &SmolStr| {
        let known = declared.iter().rev().find_map(|(item, text)| {
            let name = match item {
                Item::Fluent(decl) => &decl.name,
                Item::Measure(decl) => &decl.name,
                _ => return None,
            };
            text.split_once(' ').filter(|_| name.text == *observed).map(|(_, signature)| signature.to_owned())
        });
        known.unwrap_or_else(|| observed.to_string())
    };
    robot.observes.iter().map(shown).collect()
}

/// Declarations of the standard library and then of the robot, each with its text.
fn declared(robot: &Robot) -> Vec<(Item, String)> {
    let own = ("primitives.motet", robot.declarations.as_str());
    let files = motet_stdlib::FILES.iter().copied().chain([own]);
    let mut found = Vec::new();
    for (name, text) in files.filter(|(_, text)| !text.trim().is_empty()) {
        let source = Source::new(name, text);
        for item in motet_syntax::read(&source, FileId(0)).file.items {
            let text = source.slice(item.span()).to_owned();
            found.push((item, text));
        }
    }
    found
}

/// Declaration of a primitive with its documentation and the bounds of the robot.
pub(crate) fn signature(
    decl: &PrimitiveDecl,
    text: &str,
    bounds: &indexmap::IndexMap<smol_str::SmolStr, Range>,
) -> String {
    let mut written = String::from("\n");
    for line in decl.doc.lines() {
        written.push_str(&format!("/// {line}\n"));
    }
    written.push_str(text.trim_end());
    for (param, bound) in bounds {
        let unit =
            decl.params.iter().find(|known| known.name.text == *param).map_or("", |known| unit(&known.ty));
        written.push_str(&format!("\n    // {param}: {}", range(bound, unit)));
    }
    written.push('\n');
    written
}

/// SI unit of a quantity type; empty for other types.
fn unit(ty: &TypeExpr) -> &'static str {
    let TypeExpr::Named(name) = ty else { return "" };
    Dimension::of_type(&name.text).map_or("", Dimension::si_symbol)
}

fn range(range: &Range, unit: &str) -> String {
    // Bounds such as a full turn are not round numbers; three decimals are enough for people.
    let round = |value: f64| (value * 1000.0).round() / 1000.0;
    let space = if unit.is_empty() { "" } else { " " };
    format!("{} .. {}{space}{unit}", round(range.least), round(range.greatest))
}

/// Runs the command.
fn check(name: &str, report: &mut Report) -> Result<Exit, CliError> {
    let files = RobotFiles::find(name)?;
    let mut sources = Sources::default();
    let found = files.card(&mut sources, report).and_then(|robot| {
        // Both are checked, so that one run reports all errors.
        let inputs = SessionInputs { robot: Some(&robot), ..SessionInputs::default() };
        let declared = inputs.open("robot card", &mut sources, report);
        let urdf = files.body(&robot, &mut sources, report)?;
        declared.map(|_| (robot, urdf))
    });
    match found {
        Ok((robot, urdf)) => {
            let described = urdf.map_or_else(
                || BodyReport { lines: vec![NO_BODY.to_owned()], warnings: 0 },
                |urdf| describe(&robot, &urdf),
            );
            report.count_warnings(described.warnings);
            let title = robot.title.escape_debug();
            report.out.line(&format!("{title} ({}): {}", robot.name, report.tally()));
            for line in described.lines {
                report.out.line(&format!("  {line}"));
            }
            Ok(Exit::Success)
        }
        // The errors have been printed.
        Err(ProjectError::Invalid { .. }) => Ok(Exit::Findings),
        Err(other) => Err(other.into()),
    }
}

const NO_BODY: &str = "the card names no URDF under [model], so no motion can be computed";

/// Description of a body.
struct BodyReport {
    lines: Vec<String>,
    /// Number of warnings among the lines.
    warnings: usize,
}

impl BodyReport {
    fn warn(&mut self, posture: &str, what: &str, help: &str) {
        self.warnings += 1;
        self.lines.push(format!("{posture:8}  warning: {what}"));
        self.lines.push(format!("{:8}  help: {help}", ""));
    }
}

fn describe(robot: &Robot, urdf: &Urdf) -> BodyReport {
    let machine = RobotModel::new(robot, urdf);
    let tree = machine.tree();
    let solids: usize = urdf.links.iter().map(|link| link.collisions.len()).sum();
    let mut lines = vec![format!(
        "body      {}, {} ({} independently), {} for collision",
        count(urdf.links.len(), "link"),
        count(urdf.joints.len(), "joint"),
        match tree.dofs().len() {
            1 => "1 moves".to_owned(),
            moving => format!("{moving} move"),
        },
        count(solids, "shape"),
    )];
    let base = robot.model.as_ref().and_then(|model| model.base.as_deref());
    let base = base.and_then(|base| tree.link(base).ok()).unwrap_or(tree.root());
    for (name, hand) in &robot.hands {
        let tip = hand.tip.as_deref().and_then(|tip| tree.link(tip).ok());
        let Some(chain) = tip.and_then(|tip| KinematicChain::new(tree, base, tip)) else {
            lines.push(format!("{name:8}  not connected to the base link"));
            continue;
        };
        // The height of the base does not change the solver.
        let found = IkSolver::of(&chain, robot.base.drive, 0.0);
        lines.push(format!("{name:8}  {}: {}", count(chain.dofs.len(), "joint"), solver(&found)));
    }
    lines.extend(machine.body().uncovered_links().iter().filter_map(|link| {
        Some(format!(
            "the mesh of `{}` was not read, so no motion is computed",
            tree.links().get(*link)?.escape_debug()
        ))
    }));
    let mut described = BodyReport { lines, warnings: 0 };
    postures(&machine, &mut described);
    described
}

/// Tolerance of a part below the floor, in m: the accuracy of a foot's height.
const FLOOR_TOLERANCE: f64 = 0.01;

/// Describes contacts and parts below the floor in each posture.
fn postures(machine: &RobotModel, described: &mut BodyReport) {
    let scene = Scene::default();
    let mut world = SceneState::new(machine, &scene);
    for posture in machine.card().postures.keys() {
        let Some(joints) = machine.posture(posture, machine.rest()) else { continue };
        world.robot.joints = joints;
        let room = QueryContext::new(machine, &scene, &world);
        let name = posture.escape_debug().to_string();
        let touch = room.contact(&world.robot, AllowedCollisions::default());
        let sunk = machine.lowest(&world.robot, |_| true).filter(|(_, height)| *height < -FLOOR_TOLERANCE);
        let unread = machine.body().uncovered_links().len();
        if touch.is_none() && sunk.is_none() {
            let known = match unread {
                0 => String::new(),
                _ => format!(", as far as shapes are known: {} without one", count(unread, "link")),
            };
            described.lines.push(format!("{name:8}  touches neither itself nor the floor{known}"));
        }
        if let Some(Contact { link, other, is_own }) = touch {
            let (link, other) = (link.escape_debug(), other.escape_debug());
            let instead = format!("give joints other positions under `[postures.{name}]`");
            let help = if is_own {
                let found = touching(machine, &world.robot.joints);
                format!(
                    "{instead}, or allow the contact by an SRDF, named as `srdf` in `[model]`: {}",
                    add::srdf_lines(&found, "User")
                )
            } else {
                format!("{instead}, or a greater `height` in `[model]`")
            };
            described.warn(&name, &format!("`{link}` touches `{other}`"), &help);
        }
        if let Some((link, height)) = sunk {
            let base = machine.card().model.as_ref().map_or(0.0, |model| model.height_m);
            let what = format!("`{}` is {:.2} m below the floor", link.escape_debug(), -height);
            let help = format!(
                "`height` in `[model]` is the height of the base link above the floor; \
                 {:.3} m puts this part on the floor",
                base - height
            );
            described.warn(&name, &what, &help);
        }
    }
}

/// Name of the inverse kinematics of a hand.
fn solver(solver: &IkSolver) -> &'static str {
    match solver {
        IkSolver::Lift(_) => "closed form: a lift and a wrist with intersecting axes",
        IkSolver::Parallel(_) => "closed form: six joints, three of them parallel",
        IkSolver::Seven(_) => "closed form: seven joints with shoulder, elbow and wrist",
        IkSolver::Steps(_) => "numeric",
    }
}
