//! `motet feasible`: decides which motions are feasible for a robot in a scene, with the path or the reason.

use std::path::{Path, PathBuf};

use clap::{Args, value_parser};
use motet::feasible::{FeasibilityQuestion, Motions, decide};
use motet_geometry::planning::MotionAnswer;
use motet_robots::clearance::ClearanceOverride;

use crate::error::{CliError, Exit};
use crate::flags::{ClearanceArgs, OutputFormat, settings_of};
use crate::output::{Colors, replace_file};
use crate::report::{Progress, Report};

/// Flags of `motet feasible`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet feasible --robot hsr --scene kitchen --for 'reach(mug_1)'\n  \
    motet feasible --robot hsr --scene kitchen --for 'reach(coke, top)' --svg coke.svg\n  \
    motet feasible --robot hsr --scene kitchen --all --format json\n\n\
    A motion is go_to(ENTITY), reach(OBJECT), reach(OBJECT, top|side|front),\n\
    reach_at(OBJECT, pose(1.9 m, 0.3 m, 0.8 m, 0 deg)), put(OBJECT, ENTITY),\n\
    put_at(OBJECT, ENTITY, pose(1.9 m, 0.3 m, 0.8 m, 0 deg)), offer(OBJECT, PERSON), pull(CONTAINER),\n\
    push(ENTITY), look(ENTITY), posture(NAME) or stand_at(pose(1.2 m, 0.5 m, 90 deg)). A place has\n\
    rules: put(OBJECT, ENTITY, near: ENTITY), and likewise beside: ENTITY, away_from_edge: 10 cm,\n\
    upright: false, at: pose(…).\n\
    The scene or the state defines the object in the hand: \"robot\": {\"holding\": …}.\n\
    Exit codes: 0 all motions of --for are feasible, 1 one is not or is unknown, 2 could not run.")]
pub(crate) struct FeasibleArgs {
    /// Robot: a built-in name (see `motet robots`), or a folder with a robot.toml [default: that of
    /// motet.toml]
    #[arg(long, value_name = "NAME|FOLDER")]
    robot: Option<String>,
    /// Scene: a built-in name, or a JSON file [default: that of motet.toml]
    #[arg(long, value_name = "NAME|FILE")]
    scene: Option<String>,
    /// Facts at the start: what the hand holds, and which containers are open; a JSON object such as
    /// '{"holding(mug_1)": true}', or a file with one
    #[arg(long, value_name = "FACTS|FILE")]
    state: Option<PathBuf>,
    /// Motion to decide; repeatable
    #[arg(long = "for", value_name = "MOTION", required_unless_present = "all")]
    motions: Vec<String>,
    /// Decide go_to for all entities, reach for all objects, pull or push for all doors, and all postures,
    /// each from the start; the exit code is 0
    #[arg(long, conflicts_with = "motions")]
    all: bool,
    /// Search budget of a motion: 4 tries four times as often [default: 1]
    #[arg(long, value_name = "FACTOR", value_parser = value_parser!(u16).range(1..=1000))]
    effort: Option<u16>,
    #[command(flatten)]
    clearance: ClearanceArgs,
    /// Format of the answers
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    format: OutputFormat,
    /// Draw the scene from above with the robot and the paths
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

/// Runs the command.
pub(crate) fn run(args: &FeasibleArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run(args.format.into(), colors, |report| answer(args, report))
}

fn answer(args: &FeasibleArgs, report: &mut Report) -> Result<Exit, CliError> {
    let settings = settings_of(Path::new("."))?;
    let missing = |what: &str| CliError::Advised {
        problem: format!("no {what} is named"),
        help: format!("give --{what}, or name one in `motet.toml`"),
    };
    let robot = args.robot.as_deref().or(settings.robot_name()).ok_or_else(|| missing("robot"))?;
    let scene = args.scene.as_deref().or(settings.scene_name()).ok_or_else(|| missing("scene"))?;
    let (clearance, effort) = settings.motions().unwrap_or((ClearanceOverride::default(), 1));
    let question = FeasibilityQuestion {
        robot,
        scene,
        state: args.state.as_deref(),
        motions: if args.all { Motions::All } else { Motions::These(&args.motions) },
        effort: args.effort.unwrap_or(effort),
        clearance: args.clearance.given().or(clearance),
    };
    let mut exit = Exit::Success;
    let mut progress = None;
    let drawing = decide(&question, report, &mut |report, verdict| {
        let progress = progress.get_or_insert_with(|| Progress::of_items(verdict.left + 1, "deciding"));
        progress.suspend(|| match args.format {
            OutputFormat::Human => report.out.text(&verdict.text),
            OutputFormat::Json => report.out.json_line(&verdict.json),
        });
        progress.advance(1);
        if !args.all && !matches!(verdict.answer, MotionAnswer::Feasible(_)) {
            exit = Exit::Findings;
        }
    })?;
    if let Some(path) = &args.svg {
        replace_file(path, &drawing)?;
    }
    Ok(exit)
}
