//! `motet robots`: lists and shows robots, checks their files, and writes the card of a new one.

mod add;
mod check;

use std::path::PathBuf;

use clap::{Args, Subcommand};
use motet_project::{RobotFiles, robot_names};
use motet_robots::card::{Drive, Range, Robot};
use motet_syntax::ast::{Item, PrimitiveDecl, TypeExpr};
use motet_syntax::unit::Dimension;
use motet_syntax::{FileId, Source, Sources};

use crate::error::{CliError, Exit};
use crate::flags::DiagnosticFormat;
use crate::output::Colors;
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
    /// Write a first card for a robot from its URDF
    Add {
        /// URDF of the robot
        #[arg(value_name = "URDF")]
        urdf: PathBuf,
        /// Folder for the robot.toml [default: folder of the URDF]
        #[arg(long, value_name = "FOLDER")]
        to: Option<PathBuf>,
        /// SRDF of the robot [default: the one beside the URDF]
        #[arg(long, value_name = "SRDF")]
        srdf: Option<PathBuf>,
    },
}

/// Runs the command.
///
/// # Errors
///
/// There is no such robot, or its card has errors.
pub(crate) fn run(args: &RobotsArgs, colors: Colors) -> Result<Exit, CliError> {
    let mut report = Report::new(DiagnosticFormat::Human, colors);
    let result = match &args.command {
        None | Some(RobotsCommand::List) => list(&mut report),
        Some(RobotsCommand::Show { name }) => show(name, &mut report),
        Some(RobotsCommand::Check { name }) => check::run(name, &mut report),
        Some(RobotsCommand::Add { urdf, to, srdf }) => {
            add::run(urdf, to.as_deref(), srdf.as_deref(), &mut report)
        }
    };
    report.close(result)
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
    report.out.line(&format!("  observes  {}", robot.observes.join(", ")));
    if !robot.initially.is_empty() {
        report.out.line(&format!("  at first  {}", robot.initially.join(", ")));
    }
}

/// Declarations of primitives with their texts; a later one overrides an earlier one.
fn signatures(robot: &Robot) -> Vec<(PrimitiveDecl, String)> {
    let own = ("primitives.motet", robot.declarations.as_str());
    let files = motet_stdlib::FILES.iter().copied().chain([own]);
    let mut found = Vec::new();
    for (name, text) in files.filter(|(_, text)| !text.trim().is_empty()) {
        let source = Source::new(name, text);
        for item in motet_syntax::read(&source, FileId(0)).file.items {
            if let Item::Primitive(decl) = item {
                let text = source.slice(decl.span).to_owned();
                found.push((decl, text));
            }
        }
    }
    found
}

fn signature(
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
