//! `motet new`: a folder with settings, a scene and a first policy.

use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;
use motet_project::{Project, ProjectError, RobotFiles};
use motet_robots::builtin;
use motet_syntax::suggest;

use crate::error::{CliError, Exit};
use crate::flags::DiagnosticFormat;
use crate::output::{Colors, note, replace_file};
use crate::report::Report;

/// Flags of `motet new`.
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  \
    motet new kitchen_help && cd kitchen_help && motet run policies/hello.motet\n\n\
    The folder has motet.toml, scene.json and policies/hello.motet; with --card the robot's card and\n\
    body too, to be changed.")]
pub(crate) struct NewArgs {
    /// New or empty folder
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
    /// Built-in robot that the policies are for
    #[arg(long, value_name = "NAME", default_value = "hsr")]
    robot: String,
    /// Built-in scene to begin with
    #[arg(long, value_name = "NAME", default_value = "kitchen")]
    scene: String,
    /// Copy the card and the body of the robot into the folder
    #[arg(long)]
    card: bool,
}

/// Runs the command.
pub(crate) fn run(args: &NewArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run(DiagnosticFormat::Human, colors, |report| make(args, report))
}

fn make(args: &NewArgs, report: &mut Report) -> Result<Exit, CliError> {
    let unknown = |what, name: &str, names: Vec<&'static str>| {
        let near = suggest::closest(name, names.iter().copied());
        let near = near.map_or_else(String::new, |near| format!("did you mean `{near}`? "));
        let help = format!("{near}built-in {what}s: {}", suggest::one_of(names));
        CliError::from(ProjectError::Unknown { what, name: name.to_owned(), help })
    };
    let scene = builtin::scene_text(&args.scene).ok_or_else(|| {
        unknown("scene", &args.scene, builtin::SCENES.iter().map(|scene| scene.name).collect())
    })?;
    let robot = builtin::robot_texts(&args.robot)
        .filter(|_| RobotFiles::built_in(&args.robot).is_some())
        .ok_or_else(|| unknown("robot", &args.robot, motet_project::robot_names().collect()))?;
    let folder = &args.folder;
    if fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_some()) {
        return Err(CliError::Message(format!("`{}` exists and is not empty", folder.display())));
    }
    let failed = |source| CliError::Write { path: folder.clone(), source };
    fs::create_dir_all(folder.join("policies")).map_err(failed)?;
    let mut files = vec![(PathBuf::from("scene.json"), scene.json.to_owned())];
    let named = if args.card {
        fs::create_dir_all(folder.join("robot")).map_err(failed)?;
        files.push((Path::new("robot").join("robot.toml"), robot.card.to_owned()));
        files.push((Path::new("robot").join("robot.urdf"), robot.urdf.to_owned()));
        files.extend(
            robot.declarations.map(|text| (Path::new("robot").join("primitives.motet"), text.to_owned())),
        );
        "robot"
    } else {
        args.robot.as_str()
    };
    let settings = format!(
        "# Robot and scene of the policies in this folder.\nrobot = \"{named}\"\nscene = \"scene.json\"\n"
    );
    files.push((PathBuf::from("motet.toml"), settings));
    files.push((Path::new("policies").join("hello.motet"), policy(robot.name)));
    for (name, text) in &files {
        replace_file(&folder.join(name), text)?;
    }
    // What was written has to open.
    let robot = if args.card { folder.join("robot").display().to_string() } else { args.robot.clone() };
    let project = Project::builder().robot(robot).scene(folder.join("scene.json").display().to_string());
    let mut project = project.without_motions().open_with(report)?;
    project.session(report)?;
    for (name, _) in &files {
        report.out.line(&folder.join(name).display().to_string());
    }
    note(&format!("run it: motet run {}", folder.join("policies").join("hello.motet").display()));
    Ok(Exit::Success)
}

/// First policy, which every robot can carry out.
fn policy(robot: &str) -> String {
    format!(
        "/// Says hello. `motet run` runs it in simulation.\npolicy hello for {robot} {{\n    \
         say(\"Hello, what can I do for you?\")\n    done\n}}\n"
    )
}
