//! `motet dataset`: instruction–policy pairs for fine-tuning, made and linted.

mod images;
mod lint;
mod make;

use motet_dataset::Body;
use motet_geometry::planning::SearchBudget;
use motet_syntax::Sources;

use crate::args::{DatasetArgs, DatasetCommand, Format, MotionArgs};
use crate::exit::{Exit, Trouble};
use crate::out::Colors;
use crate::report::Report;
use crate::workbench::Card;

/// Runs the command.
///
/// # Errors
///
/// A file cannot be read or written, or what it says cannot be used.
pub(crate) fn run(args: &DatasetArgs, colors: Colors) -> Result<Exit, Trouble> {
    let mut report = Report::new(Format::Human, colors);
    report.hold();
    let result = match &args.command {
        Some(DatasetCommand::Lint(args)) => lint::lint(args, &mut report),
        None => make::make(&args.make, &mut report),
    };
    report.close(result)
}

/// A robot with its body.
fn body(name: &str, report: &mut Report) -> Result<Body, Trouble> {
    let mut sources = Sources::default();
    let card = Card::find(name)?;
    let robot = card.read(&mut sources, report)?;
    let urdf = card.body(&robot, &mut sources, report)?;
    Ok(Body { robot, urdf })
}

fn effort(args: &MotionArgs) -> Option<SearchBudget> {
    (!args.no_geometry).then(|| SearchBudget::default().times(args.effort.into()))
}
