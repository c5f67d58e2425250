//! `motet scenes`: lists, shows, checks and draws scenes.

use std::ops::ControlFlow;
use std::path::PathBuf;

use clap::{Args, Subcommand};
use motet::feasible::decide_in;
use motet_geometry::planning::RobotModel;
use motet_project::{ProjectError, open_robot, read_scene, require};
use motet_robots::builtin;
use motet_robots::scene::{self, Entity, EntityShape, Scene};
use motet_syntax::Sources;

use crate::error::{CliError, Exit};
use crate::flags::{DiagnosticFormat, ROBOTS, SCENES};
use crate::output::{Colors, count, escape, note, replace_file};
use crate::report::Report;

/// Flags of `motet scenes`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet scenes\n  \
    motet scenes show kitchen\n  \
    motet scenes check my_room.json --robot hsr\n  \
    motet scenes draw kitchen --robot hsr -o kitchen.svg")]
pub(crate) struct ScenesArgs {
    /// Action [default: list]
    #[command(subcommand)]
    command: Option<ScenesCommand>,
}

/// Subcommands of `motet scenes`.
#[derive(Subcommand, Debug)]
enum ScenesCommand {
    /// List the built-in scenes
    List,
    /// Show the entities of a scene: kind, names, place and size
    Show {
        #[command(flatten)]
        scene: SceneArg,
    },
    /// Check that a scene is correct and fits a robot
    Check {
        #[command(flatten)]
        scene: SceneArg,
        /// Robot that it must fit: a built-in name, or a folder with a robot.toml
        #[arg(long, value_name = "NAME|FOLDER", value_parser = ROBOTS, hide_possible_values = true)]
        robot: Option<String>,
    },
    /// Draw a scene from above, with a robot at its start
    Draw {
        #[command(flatten)]
        scene: SceneArg,
        /// Robot in the drawing: a built-in name, or a folder with a robot.toml
        #[arg(long, value_name = "NAME|FOLDER", value_parser = ROBOTS, hide_possible_values = true, default_value = "hsr")]
        robot: String,
        /// SVG file [default: the name of the scene with .svg]
        #[arg(short, long, value_name = "FILE")]
        output: Option<PathBuf>,
    },
}

/// Scene on the command line.
#[derive(Args, Debug)]
struct SceneArg {
    /// Built-in name, or JSON file
    #[arg(value_name = "NAME|FILE", value_parser = SCENES, hide_possible_values = true)]
    scene: String,
}

/// Runs the command.
pub(crate) fn run(args: &ScenesArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run(DiagnosticFormat::Human, colors, |report| match &args.command {
        None | Some(ScenesCommand::List) => list(report),
        Some(ScenesCommand::Show { scene }) => show(&scene.scene, report),
        Some(ScenesCommand::Check { scene, robot }) => check(&scene.scene, robot.as_deref(), report),
        Some(ScenesCommand::Draw { scene, robot, output }) => {
            draw(&scene.scene, robot, output.clone(), report)
        }
    })
}

fn list(report: &mut Report) -> Result<Exit, CliError> {
    let width = builtin::SCENES.iter().map(|scene| scene.name.len()).max().unwrap_or_default();
    for named in builtin::SCENES {
        let scene = read_scene(named.name, &mut Sources::default(), report)?;
        report.out.line(&format!("{:width$}  {}", named.name, contents(&scene)));
    }
    Ok(Exit::Success)
}

/// Number of entities of each kind, in the order in which the kinds first occur.
fn contents(scene: &Scene) -> String {
    let mut kinds: Vec<(&str, usize)> = Vec::new();
    for entity in scene.entities.values() {
        match kinds.iter_mut().find(|(kind, _)| *kind == entity.kind) {
            Some((_, number)) => *number += 1,
            None => kinds.push((&entity.kind, 1)),
        }
    }
    let kinds: Vec<String> =
        kinds.into_iter().map(|(kind, number)| count(number, &kind.to_lowercase())).collect();
    kinds.join(", ")
}

fn show(name: &str, report: &mut Report) -> Result<Exit, CliError> {
    let scene = read_scene(name, &mut Sources::default(), report)?;
    let [x, y, yaw] = scene.robot.base;
    let holding = match &scene.robot.holding {
        Some(Some(id)) => format!(", holds {id}"),
        Some(None) => ", holds nothing".to_owned(),
        None => String::new(),
    };
    report.out.line(&format!("robot at ({x:.2}, {y:.2}) m, {:.0}°{holding}", yaw.to_degrees()));
    let width = |of: fn(&Entity) -> &str| {
        scene.entities.values().map(|entity| of(entity).chars().count()).max().unwrap_or_default()
    };
    let (ids, kinds) = (width(|entity| &entity.id), width(|entity| &entity.kind));
    for entity in scene.entities.values() {
        let line = format!("{:ids$}  {:kinds$}  {}", entity.id, entity.kind, described(entity));
        report.out.line(escape(&line).trim_end());
    }
    Ok(Exit::Success)
}

/// Place, size, state and names of an entity.
fn described(entity: &Entity) -> String {
    let mut parts = Vec::new();
    parts.push(match &entity.pose {
        Some(pose) => {
            let [x, y, z] = pose.xyz;
            format!("at ({x:.2}, {y:.2}, {z:.2}) m")
        }
        None => "place unknown".to_owned(),
    });
    parts.extend(entity.on.as_ref().map(|on| format!("on {on}")));
    parts.extend(entity.inside.as_ref().map(|inside| format!("in {inside}")));
    parts.extend(entity.shape.as_ref().map(size));
    parts.extend(entity.mass_kg.map(|mass| format!("{mass} kg")));
    parts.extend(entity.open.map(|open| if open { "open" } else { "closed" }.to_owned()));
    parts.extend(entity.locked.filter(|locked| *locked).map(|_| "locked".to_owned()));
    if !entity.names.is_empty() {
        let names: Vec<String> = entity.names.iter().map(|name| format!("\"{name}\"")).collect();
        parts.push(format!("called {}", names.join(", ")));
    }
    parts.join(", ")
}

fn size(shape: &EntityShape) -> String {
    match shape {
        EntityShape::Box([x, y, z]) => format!("box {x} × {y} × {z} m"),
        EntityShape::Cylinder { radius, height } => format!("cylinder ⌀ {} × {height} m", 2.0 * radius),
        EntityShape::Capsule { radius, height } => {
            format!("capsule ⌀ {} × {} m", 2.0 * radius, height + 2.0 * radius)
        }
        EntityShape::Sphere { radius } => format!("sphere ⌀ {} m", 2.0 * radius),
        EntityShape::Mesh { file, .. } => format!("mesh {file}"),
    }
}

fn check(name: &str, robot: Option<&str>, report: &mut Report) -> Result<Exit, CliError> {
    match checked(name, robot, report) {
        Ok(scene) => {
            report.out.line(&format!("{}: {}", contents(&scene), report.tally()));
            Ok(Exit::Success)
        }
        // The errors have been printed.
        Err(CliError::Project(ProjectError::Invalid { .. })) => Ok(Exit::Findings),
        Err(other) => Err(other),
    }
}

/// Scene without errors, which fits a robot and passes the check of a session.
fn checked(name: &str, robot: Option<&str>, report: &mut Report) -> Result<Scene, CliError> {
    let mut sources = Sources::default();
    let scene = read_scene(name, &mut sources, report)?;
    let Some(robot) = robot else { return Ok(scene) };
    let (robot, urdf) = open_robot(robot, &mut sources, report)?;
    if let Some(urdf) = &urdf {
        require("scene", &scene::fit(&scene, urdf), &sources, report)?;
    }
    let session = motet_compiler::Session::builder().robot(&robot).scene(&scene).build(&mut sources);
    require("scene", session.input_diagnostics(), &sources, report)?;
    Ok(scene)
}

fn draw(name: &str, robot: &str, output: Option<PathBuf>, report: &mut Report) -> Result<Exit, CliError> {
    let mut sources = Sources::default();
    let (robot, urdf) = open_robot(robot, &mut sources, report)?;
    let urdf = urdf.ok_or_else(|| CliError::from(motet::Error::NoBody(robot.name.to_string())))?;
    let scene = read_scene(name, &mut sources, report)?;
    require("scene", &scene::fit(&scene, &urdf), &sources, report)?;
    let machine = RobotModel::new(&robot, &urdf);
    let drawing = decide_in((&machine, &scene), [], 1, &mut |_| ControlFlow::Continue(()));
    let output = output.unwrap_or_else(|| {
        let stem = PathBuf::from(name).file_stem().map(PathBuf::from).unwrap_or_else(|| "scene".into());
        stem.with_extension("svg")
    });
    replace_file(&output, &drawing)?;
    note(&format!("wrote {}", output.display()));
    Ok(Exit::Success)
}
