//! `motet-ros2`: a driver for robots that speak ROS 2. `motet run --driver ros2:BINDING` starts it.

mod action;
mod bind;
mod cdr;
mod check;
mod clock;
mod dds;
mod driver;
mod group;
mod joint;
mod layout;
mod lines;
mod observe;
#[doc(hidden)]
pub mod outside;
mod perceive;
mod picture;
mod plan;
mod robot;
mod service;
mod state;
mod task;
mod tasks;
mod template;
mod tf;
mod world;

use bind::Binding;
use clap::{Parser, Subcommand};
use layout::{Distribution, Layouts};
use std::io::{BufReader, Write as _};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Drive robots that speak ROS 2, without a ROS installation
#[derive(Parser, Debug)]
#[command(name = "motet ros2", version, disable_help_subcommand = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand, Debug)]
enum Command {
    /// Speak the driver protocol on stdin and stdout, in front of the robot
    Drive(DriveArgs),
    /// Show what a binding binds of a robot's primitives, facts and joints, and what not
    Check(CheckArgs),
    /// Serve an action that runs policies, so that ROS 2 nodes can ask Motet
    Tasks(tasks::TasksArgs),
    /// List the interfaces that have layouts, or write a message of zeros in hexadecimal digits
    Layouts(LayoutsArgs),
}

#[derive(clap::Args, Debug)]
struct DriveArgs {
    /// Binding: a built-in name, or a TOML file
    binding: String,
    /// Robot: a built-in name, or a folder with a robot.toml [default: that of the binding]
    #[arg(long, value_name = "NAME|FOLDER")]
    robot: Option<String>,
    /// Scene: a built-in name, or a JSON file
    #[arg(long, value_name = "NAME|FILE")]
    scene: String,
    /// Command `motet`, which plans if the robot does not stand at the start of a path [default: from PATH]
    #[arg(long, value_name = "FILE")]
    motet: Option<PathBuf>,
    /// Folder with further layouts, in files that end in `.layouts`
    #[arg(long, value_name = "FOLDER")]
    layouts: Option<PathBuf>,
}

#[derive(clap::Args, Debug)]
struct CheckArgs {
    /// Binding: a built-in name, or a TOML file
    binding: String,
    /// Robot: a built-in name, or a folder with a robot.toml [default: that of the binding]
    #[arg(long, value_name = "NAME|FOLDER")]
    robot: Option<String>,
    /// Compare with the nodes that DDS discovers within 3 s
    #[arg(long)]
    live: bool,
    /// Folder with further layouts, in files that end in `.layouts`
    #[arg(long, value_name = "FOLDER")]
    layouts: Option<PathBuf>,
}

#[derive(clap::Args, Debug)]
struct LayoutsArgs {
    /// Distribution of ROS 2
    #[arg(long, default_value = "jazzy", value_name = "NAME")]
    distribution: Distribution,
    /// Folder with further layouts, in files that end in `.layouts`
    #[arg(long, value_name = "FOLDER")]
    layouts: Option<PathBuf>,
    /// Message whose CDR bytes are written, with the values of `--json`
    #[arg(long, value_name = "TYPE")]
    encode: Option<String>,
    /// Values of the message
    #[arg(long, value_name = "JSON", requires = "encode")]
    json: Option<String>,
}

/// Runs the command line.
#[must_use]
pub fn run() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Drive(args) => drive(args),
        Command::Check(args) => {
            check::check(&args.binding, args.robot.as_deref(), args.live, args.layouts.as_deref())
        }
        Command::Tasks(args) => tasks::serve(&args),
        Command::Layouts(args) => layouts(&args),
    };
    let code = result.unwrap_or_else(|why| {
        lines::print_error(format!("error: {why}"));
        2
    });
    lines::end_notes();
    code.into()
}

fn drive(args: DriveArgs) -> Result<u8, String> {
    let binding = Binding::read(&args.binding)?;
    let card = robot_of(&binding, args.robot.as_deref())?;
    let layouts = binding.layouts(args.layouts.as_deref())?;
    let scene = check::read_scene(&args.scene)?;
    let card = check::read_card(&card, args.motet.or_else(|| on_path("motet")))?;
    let robot = robot::Robot::open(binding, layouts)?;
    let lines = lines::read_lines(BufReader::new(std::io::stdin()));
    let out = lines::Output::open(std::io::stdout());
    driver::Driver::new(robot, world::World::new(scene), card, out).serve(&lines)?;
    Ok(0)
}

fn robot_of(binding: &Binding, robot: Option<&str>) -> Result<String, String> {
    let robot = robot.map(str::to_owned).or_else(|| binding.robot.clone());
    robot.ok_or_else(|| "the binding names no robot: give --robot NAME|FOLDER".to_owned())
}

/// Executable of a name in the folders of PATH.
fn on_path(name: &str) -> Option<PathBuf> {
    let folders = std::env::var_os("PATH")?;
    std::env::split_paths(&folders).map(|folder| folder.join(name)).find(|file| file.is_file())
}

fn layouts(args: &LayoutsArgs) -> Result<u8, String> {
    let layouts = Layouts::of(args.distribution, args.layouts.as_deref().map(Path::new))?;
    if let Some(name) = &args.encode {
        let value = match &args.json {
            Some(text) => serde_json::from_str(text).map_err(|error| format!("--json: {error}"))?,
            None => serde_json::Value::Null,
        };
        let bytes = cdr::encode(&layouts, name, &value)?;
        let digits: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        let _ = writeln!(std::io::stdout(), "{digits}");
        return Ok(0);
    }
    let line = |(name, kind)| format!("{:<8} {name}\n", format!("{kind:?}").to_lowercase());
    let lines: String = layouts.interfaces().map(line).collect();
    // Nobody may read to the end.
    let _ = write!(std::io::stdout(), "{lines}");
    Ok(0)
}
