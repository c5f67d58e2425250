//! `motet scenes`: lists, shows, checks and draws scenes.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};
use motet::feasible::decide_in;
use motet_geometry::planning::RobotModel;
use motet_project::{SessionInputs, open_robot, read_scene, require};
use motet_robots::builtin;
use motet_robots::scene::{Entity, Scene, fit};
use motet_syntax::Sources;

use crate::error::{CliError, Exit};
use crate::flags::{DiagnosticFormat, settings_of};
use crate::output::{Colors, count_irregular};
use crate::report::Report;

/// Flags of `motet scenes`.
#[derive(Args, Debug)]
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
    /// Show the entities of a scene: kinds, poses, and where each is
    Show {
        #[command(flatten)]
        scene: SceneArg,
    },
    /// Check a scene, and with a robot if it can act in it
    Check {
        #[command(flatten)]
        scene: SceneArg,
        #[command(flatten)]
        robot: RobotArg,
    },
    /// Draw a scene from above as SVG
    Draw {
        #[command(flatten)]
        scene: SceneArg,
        #[command(flatten)]
        robot: RobotArg,
        /// File to write [default: stdout]
        #[arg(short, long, value_name = "FILE")]
        output: Option<PathBuf>,
    },
}

/// Scene of a subcommand.
#[derive(Args, Debug)]
struct SceneArg {
    /// Built-in name, or a JSON file [default: the scene of motet.toml]
    #[arg(value_name = "NAME|FILE")]
    scene: Option<String>,
}

/// Robot of a subcommand.
#[derive(Args, Debug)]
struct RobotArg {
    /// Robot: a built-in name (see `motet robots`), or a folder with a robot.toml [default: that of
    /// motet.toml]
    #[arg(long, value_name = "NAME|FOLDER")]
    robot: Option<String>,
}

impl SceneArg {
    fn name(&self) -> Result<String, CliError> {
        let settings = settings_of(Path::new("."))?;
        let name = self.scene.as_deref().or(settings.scene_name()).map(str::to_owned);
        name.ok_or_else(|| CliError::Advised {
            problem: "no scene is named".to_owned(),
            help: "name one, or have a `motet.toml` with a scene; `motet scenes` lists the built-in ones"
                .to_owned(),
        })
    }
}

impl RobotArg {
    fn name(&self) -> Result<Option<String>, CliError> {
        let settings = settings_of(Path::new("."))?;
        Ok(self.robot.clone().or_else(|| settings.robot_name().map(str::to_owned)))
    }
}

/// Runs the command.
pub(crate) fn run(args: &ScenesArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run(DiagnosticFormat::Human, colors, |report| match &args.command {
        None | Some(ScenesCommand::List) => list(report),
        Some(ScenesCommand::Show { scene }) => show(&scene.name()?, report),
        Some(ScenesCommand::Check { scene, robot }) => {
            check(&scene.name()?, robot.name()?.as_deref(), report)
        }
        Some(ScenesCommand::Draw { scene, robot, output }) => {
            draw(&scene.name()?, robot.name()?.as_deref(), output.as_deref(), report)
        }
    })
}

fn list(report: &mut Report) -> Result<Exit, CliError> {
    let width = builtin::SCENES.iter().map(|scene| scene.name.len()).max().unwrap_or_default();
    for builtin in builtin::SCENES {
        let scene = read_scene(builtin.name, &mut Sources::default(), report)?;
        report.out.line(&format!("{:width$}  {}", builtin.name, summary(&scene)));
    }
    Ok(Exit::Success)
}

/// Numbers of the entities of each kind, in alphabetical order.
fn summary(scene: &Scene) -> String {
    let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
    for entity in scene.entities.values() {
        *kinds.entry(entity.kind.as_str()).or_default() += 1;
    }
    let kinds = kinds.into_iter().map(|(kind, number)| format!("{number} {kind}"));
    let entities = count_irregular(scene.entities.len(), "entity", "entities");
    format!("{entities}: {}", kinds.collect::<Vec<_>>().join(", "))
}

fn show(name: &str, report: &mut Report) -> Result<Exit, CliError> {
    let scene = read_scene(name, &mut Sources::default(), report)?;
    report.out.line(&format!("{name}  {}", summary(&scene)));
    let width = scene.entities.keys().map(|id| id.len()).max().unwrap_or_default();
    for (id, entity) in &scene.entities {
        report.out.line(&format!("  {id:width$}  {:9}  {}", entity.kind, description(entity)));
    }
    Ok(Exit::Success)
}

/// Place, state and names of an entity.
fn description(entity: &Entity) -> String {
    let mut parts = Vec::new();
    if let Some(pose) = &entity.pose {
        let [x, y, z] = pose.xyz;
        parts.push(format!("at ({x:.2}, {y:.2}, {z:.2}) m"));
    }
    parts.extend(entity.on.iter().map(|on| format!("on {on}")));
    parts.extend(entity.inside.iter().map(|inside| format!("in {inside}")));
    for (state, yes, no) in [(entity.open, "open", "closed"), (entity.locked, "locked", "unlocked")] {
        parts.extend(state.map(|holds| if holds { yes } else { no }.to_owned()));
    }
    parts.extend(entity.mass_kg.map(|mass| format!("{mass} kg")));
    if !entity.names.is_empty() {
        let names = entity.names.iter().map(|name| format!("\"{name}\""));
        parts.push(names.collect::<Vec<_>>().join(", "));
    }
    parts.join(", ")
}

fn check(name: &str, robot: Option<&str>, report: &mut Report) -> Result<Exit, CliError> {
    let mut sources = Sources::default();
    let scene = read_scene(name, &mut sources, report)?;
    if let Some(robot) = robot {
        let (robot, urdf) = open_robot(robot, &mut sources, report)?;
        SessionInputs::of(&robot, &scene, None).open("scene", &mut sources, report)?;
        if let Some(urdf) = urdf {
            require("scene", &fit(&scene, &urdf), &sources, report)?;
        }
    }
    let fits = robot.map_or_else(String::new, |robot| format!("; {robot} can act in it"));
    report.out.line(&format!("{name}: {}; {}{fits}", summary(&scene), report.tally()));
    Ok(Exit::Success)
}

fn draw(
    name: &str,
    robot: Option<&str>,
    output: Option<&Path>,
    report: &mut Report,
) -> Result<Exit, CliError> {
    let mut sources = Sources::default();
    let scene = read_scene(name, &mut sources, report)?;
    let robot = robot.ok_or_else(|| CliError::Advised {
        problem: "a drawing shows a robot in the scene".to_owned(),
        help: "give --robot, or name one in `motet.toml`".to_owned(),
    })?;
    let (robot, urdf) = open_robot(robot, &mut sources, report)?;
    let urdf =
        urdf.ok_or_else(|| CliError::Message(format!("the card of `{}` names no body", robot.name)))?;
    require("scene", &fit(&scene, &urdf), &sources, report)?;
    let machine = RobotModel::new(&robot, &urdf);
    let svg = decide_in((&machine, &scene), [], 1, &mut |_| ControlFlow::Continue(()));
    report.out.file(output, &svg, false)?;
    Ok(Exit::Success)
}
