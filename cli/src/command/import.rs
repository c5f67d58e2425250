//! `motet import`: files of other planning languages and behaviour trees as Motet, and rooms of other tools
//! as scenes.

mod btcpp;

use std::io::Read as _;
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand, ValueEnum};
use motet_pddl::PddlSource;
use motet_project::files::{add_source, read_small};
use motet_robots::import::{self, MAX_CELLS, MapOptions, UnknownCells};
use motet_robots::scene;
use motet_syntax::{Diagnostic, FileId, Source, Sources};

use crate::error::{CliError, Exit};
use crate::flags::FormatArgs;
use crate::output::Colors;
use crate::report::Report;

/// Flags of `motet import`.
#[derive(Args, Debug)]
pub(crate) struct ImportArgs {
    #[command(subcommand)]
    command: ImportCommand,
}

/// Languages that can be imported.
#[derive(Subcommand, Debug)]
enum ImportCommand {
    /// Import a PDDL domain and problem as declarations, or a plan for them as a policy
    Pddl(PddlArgs),
    /// Import a behaviour tree of BehaviorTree.CPP 4 as a policy
    Btcpp(Box<btcpp::BtcppArgs>),
    /// Import a map of occupied cells, as ROS map servers write it, as a scene with walls
    Map(MapArgs),
    /// Import the models of an SDF as a scene
    Sdf(SdfArgs),
}

/// Flags of `motet import map`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet import map room.yaml -o room.json\n  \
    motet import map room.yaml --coarsen 2 --unknown occupied -o room.json")]
struct MapArgs {
    /// YAML file of the map; its image lies beside it
    #[arg(value_name = "YAML")]
    map: PathBuf,
    /// Height of the walls in m
    #[arg(long, value_name = "METRES", default_value_t = 2.0, value_parser = height)]
    height: f64,
    /// Use of cells that are neither occupied nor free
    #[arg(long, value_enum, default_value_t = Unknown::Free)]
    unknown: Unknown,
    /// Merge squares of N by N cells to one, occupied if any of them is
    #[arg(long, value_name = "N", default_value_t = 1,
        value_parser = clap::value_parser!(u16).range(1..=1000))]
    coarsen: u16,
    /// File to write [default: stdout]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    format: FormatArgs,
}

/// Flags of `motet import sdf`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  motet import sdf room.sdf -o room.json")]
struct SdfArgs {
    /// SDF file with a world or models
    #[arg(value_name = "SDF")]
    world: PathBuf,
    /// File to write [default: stdout]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    format: FormatArgs,
}

/// Use of cells of a map that are neither occupied nor free.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
enum Unknown {
    /// Nothing stands there
    Free,
    /// Something may stand there
    Occupied,
}

fn height(text: &str) -> Result<f64, String> {
    let height = text.parse().ok().filter(|height| (0.01..=100.0).contains(height));
    height.ok_or_else(|| "a height is from 0.01 to 100 m".to_owned())
}

/// Flags of `motet import pddl`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet import pddl domain.pddl problem.pddl -o blocks.motet\n  \
    motet import pddl domain.pddl problem.pddl --plan plan.txt -o plan.motet\n  \
    motet check plan.motet --domain blocks.motet")]
struct PddlArgs {
    /// PDDL domain file
    #[arg(value_name = "DOMAIN")]
    domain: PathBuf,
    /// PDDL problem file
    #[arg(value_name = "PROBLEM")]
    problem: PathBuf,
    /// Plan with one `(action argument …)` per line. It becomes a policy with the goal of the problem;
    /// check it with the declarations as `--domain`
    #[arg(long, value_name = "FILE")]
    plan: Option<PathBuf>,
    /// File to write [default: stdout]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    format: FormatArgs,
}

/// Runs the command.
pub(crate) fn run(args: &ImportArgs, colors: Colors) -> Result<Exit, CliError> {
    let (format, output) = match &args.command {
        ImportCommand::Pddl(args) => (args.format.format, &args.output),
        ImportCommand::Btcpp(args) => (args.format.format, &args.output),
        ImportCommand::Map(args) => (args.format.format, &args.output),
        ImportCommand::Sdf(args) => (args.format.format, &args.output),
    };
    Report::run(format, colors, |report| {
        if output.is_none() {
            report.hold();
        }
        match &args.command {
            ImportCommand::Pddl(args) => pddl(args, report),
            ImportCommand::Btcpp(args) => btcpp::run(args, report),
            ImportCommand::Map(args) => map(args, report),
            ImportCommand::Sdf(args) => sdf(args, report),
        }
    })
}

fn map(args: &MapArgs, report: &mut Report) -> Result<Exit, CliError> {
    let (mut sources, mut diagnostics) = (Sources::default(), Vec::new());
    let (source, file) = read(&args.map, &mut sources, &mut diagnostics)?;
    let mut scene = None;
    if diagnostics.is_empty() {
        let (map, found) = import::read_map(&source, file);
        diagnostics = found;
        if let Some(map) = map {
            let unknown = match args.unknown {
                Unknown::Free => UnknownCells::Free,
                Unknown::Occupied => UnknownCells::Occupied,
            };
            let coarsen = usize::from(args.coarsen);
            let options = MapOptions { height_m: args.height, unknown, coarsen };
            let image = read_image(&args.map.with_file_name("").join(&map.image))?;
            match map.scene(&image, &options) {
                Ok(walls) => scene = Some(walls),
                Err(problem) => diagnostics.push(*problem),
            }
        }
    }
    report.print(&diagnostics, &sources);
    scene.map_or(Ok(Exit::Findings), |scene| {
        write(&scene::write(&scene), true, args.output.as_deref(), report)
    })
}

fn sdf(args: &SdfArgs, report: &mut Report) -> Result<Exit, CliError> {
    let (mut sources, mut diagnostics) = (Sources::default(), Vec::new());
    let (source, file) = read(&args.world, &mut sources, &mut diagnostics)?;
    let mut scene = None;
    if diagnostics.is_empty() {
        (scene, diagnostics) = import::read_sdf(&source, file);
    }
    report.print(&diagnostics, &sources);
    scene.map_or(Ok(Exit::Findings), |scene| {
        write(&scene::write(&scene), true, args.output.as_deref(), report)
    })
}

/// Reads an image. What exceeds the greatest map as text is cut, so that its reader reports the size.
fn read_image(path: &Path) -> Result<Vec<u8>, CliError> {
    let fail = |source| CliError::from(motet_project::ProjectError::Read { path: path.to_owned(), source });
    let mut bytes = Vec::new();
    motet_project::files::open(path)?.take(8 * MAX_CELLS as u64).read_to_end(&mut bytes).map_err(fail)?;
    Ok(bytes)
}

fn write(text: &str, is_json: bool, output: Option<&Path>, report: &mut Report) -> Result<Exit, CliError> {
    report.out.file(output, text, is_json)?;
    Ok(Exit::Success)
}

fn pddl(args: &PddlArgs, report: &mut Report) -> Result<Exit, CliError> {
    let (mut sources, mut diagnostics) = (Sources::default(), Vec::new());
    let (domain, first) = read(&args.domain, &mut sources, &mut diagnostics)?;
    let (problem, second) = read(&args.problem, &mut sources, &mut diagnostics)?;
    let plan = args.plan.as_ref().map(|path| read(path, &mut sources, &mut diagnostics)).transpose()?;
    let mut imported = None;
    if diagnostics.is_empty() {
        let domain = PddlSource { source: &domain, file: first };
        let problem = PddlSource { source: &problem, file: second };
        let plan = plan.as_ref().map(|(source, file)| PddlSource { source, file: *file });
        (imported, diagnostics) = motet_pddl::import(domain, problem, plan);
    }
    report.print(&diagnostics, &sources);
    let Some(imported) = imported else { return Ok(Exit::Findings) };
    let text = if args.plan.is_some() { imported.policy_text() } else { imported.declarations_text() };
    write(&text, false, args.output.as_deref(), report)
}

fn read(
    path: &Path,
    sources: &mut Sources,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<(Source, FileId), CliError> {
    let bytes = read_small(path)?;
    let (source, file, more) = add_source(&path.display().to_string(), &bytes, sources);
    diagnostics.extend(more);
    Ok((source, file))
}
