//! `motet robots mjcf`: writes the MuJoCo model of a robot in a scene.

use std::path::PathBuf;

use clap::Args;
use motet_geometry::mjcf;
use motet_geometry::planning::RobotModel;
use motet_project::{SessionInputs, open_robot, read_scene, read_state_into, require};
use motet_robots::scene;
use motet_syntax::Sources;

use crate::error::{CliError, Exit};
use crate::output::replace_file;
use crate::report::Report;

/// Flags of `motet robots mjcf`.
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  \
    motet robots mjcf --robot hsr --scene kitchen -o kitchen.xml\n\n\
    The model has the shapes of the collision checks and refers to no other file. Bodies are\n\
    named by the ids of the scene, links `robot/LINK`, and drawers and doors `ID/door`.")]
pub(crate) struct MjcfArgs {
    /// Robot: a built-in name (see `motet robots`), or a folder with a robot.toml
    #[arg(long, value_name = "NAME|FOLDER")]
    robot: String,
    /// Scene: a built-in name, or a JSON file
    #[arg(long, value_name = "NAME|FILE")]
    scene: String,
    /// Facts at the start: what the hand holds, and which containers are open; a JSON object, or a file
    /// with one
    #[arg(long, value_name = "FACTS|FILE")]
    state: Option<PathBuf>,
    /// File for the model [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Runs the command.
pub(crate) fn run(args: &MjcfArgs, report: &mut Report) -> Result<Exit, CliError> {
    let mut sources = Sources::default();
    let (robot, urdf) = open_robot(&args.robot, &mut sources, report)?;
    let Some(urdf) = urdf else {
        return Err(CliError::Message(format!("the card of `{}` names no URDF under [model]", robot.name)));
    };
    let mut room = read_scene(&args.scene, &mut sources, report)?;
    require("scene", &scene::fit(&room, &urdf), &sources, report)?;
    if let Some(state) = &args.state {
        let state = read_state_into(&mut room, state, &mut sources, report)?;
        SessionInputs::of(&robot, &room, Some(&state)).open("state", &mut sources, report)?;
    }
    let model = mjcf::write(&RobotModel::new(&robot, &urdf), &urdf, &room)
        .map_err(|error| CliError::Message(error.to_string()))?;
    match &args.output {
        Some(path) => replace_file(path, &model)?,
        None => report.out.text(&model),
    }
    Ok(Exit::Success)
}
