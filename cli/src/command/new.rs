//! `motet new`: makes a folder for policies, with a robot, a scene, settings and a policy that runs.

use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;
use motet_project::{Project, ProjectSession, RobotFiles, read_scene};
use motet_robots::builtin;
use motet_robots::scene;
use motet_stdlib::lang::kinds;
use motet_syntax::Sources;

use crate::error::{CliError, Exit};
use crate::flags::{DiagnosticFormat, ROBOTS, SCENES};
use crate::output::{Colors, note, replace_file};
use crate::report::Report;

/// Most objects for which a first policy is planned.
const MOST_OBJECTS: usize = 12;

/// Flags of `motet new`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet new home                              for the HSR in a copy of the built-in kitchen\n  \
    motet new home --robot anymal_z1 --scene living_room\n  \
    motet new lab --own-robot                   with a copy of the robot's card and URDF to change\n\n\
    Then, in the folder: `motet check .` and `motet run first.motet --speed max`.")]
pub(crate) struct NewArgs {
    /// Folder to make, which must be empty or not exist
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
    /// Robot: a built-in name, or a folder with a robot.toml
    #[arg(long, value_name = "NAME|FOLDER", value_parser = ROBOTS, hide_possible_values = true, default_value = "hsr")]
    robot: String,
    /// Scene to copy: a built-in name, or a JSON file
    #[arg(long, value_name = "NAME|FILE", value_parser = SCENES, hide_possible_values = true, default_value = "kitchen")]
    scene: String,
    /// Copy the card and the URDF of a built-in robot too
    #[arg(long)]
    own_robot: bool,
}

/// Runs the command.
pub(crate) fn run(args: &NewArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run(DiagnosticFormat::Human, colors, |report| make(args, report))
}

fn make(args: &NewArgs, report: &mut Report) -> Result<Exit, CliError> {
    let folder = &args.folder;
    if folder.exists() && !is_empty(folder)? {
        return Err(CliError::Advised {
            problem: format!("`{}` exists and is not empty", folder.display()),
            help: "name a folder that does not exist; nothing is overwritten".to_owned(),
        });
    }
    // What is wrong with the robot or the scene is told before anything is written.
    let robot_name = Project::builder()
        .robot(&args.robot)
        .scene(&args.scene)
        .open_with(report)?
        .into_session(report)?
        .robot
        .map(|robot| robot.name.to_string())
        .unwrap_or_default();
    let scene = read_scene(&args.scene, &mut Sources::default(), report)?;
    let robot = robot(args)?;
    fs::create_dir_all(folder).map_err(|source| CliError::Write { path: folder.clone(), source })?;
    for (name, text) in &robot.files {
        let path = folder.join(&robot.entry).join(name);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent)
                .map_err(|source| CliError::Write { path: parent.to_owned(), source })?;
        }
        replace_file(&path, text)?;
    }
    replace_file(&folder.join("scene.json"), &scene::write(&scene))?;
    let settings = format!("robot = {}\nscene = \"scene.json\"\n", toml_text(&robot.entry));
    replace_file(&folder.join("motet.toml"), &settings)?;
    let opened = motet_project::read_config(&folder.join("motet.toml"))?.open_with(report)?;
    let policy = first_policy(&opened.into_session(report)?, &robot_name);
    replace_file(&folder.join("first.motet"), &policy)?;
    note(&format!(
        "made `{}` with motet.toml, scene.json and first.motet\n  next: cd {} && motet check . && \
         motet run first.motet --speed max",
        folder.display(),
        folder.display()
    ));
    Ok(Exit::Success)
}

fn is_empty(folder: &Path) -> Result<bool, CliError> {
    let mut entries = fs::read_dir(folder).map_err(|source| CliError::read(folder.to_owned(), source))?;
    Ok(entries.next().is_none())
}

/// Robot of the settings, and the files that belong to it.
struct NewRobot {
    entry: String,
    files: Vec<(&'static str, String)>,
}

fn robot(args: &NewArgs) -> Result<NewRobot, CliError> {
    let built_in = builtin::robot_texts(&args.robot);
    match (built_in, args.own_robot) {
        (Some(texts), true) => {
            let mut files =
                vec![("robot.toml", texts.card.to_owned()), ("robot.urdf", texts.urdf.to_owned())];
            files.extend(texts.declarations.map(|text| ("primitives.motet", text.to_owned())));
            Ok(NewRobot { entry: "robot".to_owned(), files })
        }
        (Some(_), false) => Ok(NewRobot { entry: args.robot.clone(), files: Vec::new() }),
        (None, true) => Err(CliError::Advised {
            problem: "`--own-robot` copies a built-in robot".to_owned(),
            help: "leave it out: `--robot FOLDER` already is your own robot".to_owned(),
        }),
        (None, false) => {
            RobotFiles::find(&args.robot)?;
            let path = Path::new(&args.robot);
            let path = fs::canonicalize(path).map_err(|source| CliError::read(path.to_owned(), source))?;
            Ok(NewRobot { entry: path.display().to_string(), files: Vec::new() })
        }
    }
}

fn toml_text(text: &str) -> String {
    // A basic string of TOML has the escapes of JSON.
    serde_json::Value::from(text).to_string()
}

/// Policy that brings one of the objects, or else says a word.
fn first_policy(opened: &ProjectSession, robot: &str) -> String {
    let scene = opened.scene.clone().unwrap_or_default();
    let objects = scene.entities.values().filter(|entity| entity.kind == kinds::OBJECT);
    for object in objects.take(MOST_OBJECTS) {
        if let Ok(planned) = motet::plan::for_request(opened, &format!("bring me the {}", object.id)) {
            return planned.planned.text;
        }
    }
    format!("policy hello for {robot} {{\n    say(\"Hello!\")\n    done\n}}\n")
}
