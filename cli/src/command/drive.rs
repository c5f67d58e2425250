//! `motet drive`: checks a policy and runs it on a driver in another process.

use std::path::PathBuf;

use clap::Args;
use motet::run::{create_journal, engine, start_state};
use motet_host::remote::protocol::Hello;
use motet_host::remote::{DriverAddress, DriverTimeouts};
use motet_planner::runtime_check::{CheckMode, Guard};
use motet_project::{SavedDriver, SavedProject};
use motet_runtime::{Driver, EngineSettings, Event, Time};

use super::run::compile;
use crate::error::{CliError, Exit};
use crate::flags::{OutputFormat, SessionArgs, Speed};
use crate::output::Colors;
use crate::report::Report;
use crate::run_view::{Clock, view};
use crate::runner::{PacedView, Runner, connect};

/// Flags of `motet drive`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet drive fetch_mug.motet --robot hsr --driver 'python3 examples/drivers/echo.py'\n  \
    motet drive fetch_mug.motet --robot hsr --driver tcp://127.0.0.1:4711 --record run/")]
pub(crate) struct DriveArgs {
    /// Policy file, or `-` for stdin
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Policy to run; required if the file has several
    #[arg(long, value_name = "NAME")]
    policy: Option<String>,
    #[command(flatten)]
    session: SessionArgs,
    /// Driver: a command that speaks the driver protocol on its stdin and stdout, or tcp://127.0.0.1:PORT
    #[arg(long, value_name = "COMMAND|ADDRESS")]
    driver: DriverAddress,
    /// Write a journal of the run into this folder; `motet run --resume` continues it
    #[arg(long, value_name = "FOLDER")]
    record: Option<PathBuf>,
    /// View of the run: a tree of steps, or JSON events
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    format: OutputFormat,
}

/// Runs the command.
pub(crate) fn run(args: &DriveArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run(args.format.into(), colors, |report| check_and_drive(args, colors, report))
}

fn check_and_drive(args: &DriveArgs, colors: Colors, report: &mut Report) -> Result<Exit, CliError> {
    let mut project = args.session.project().open_with(report)?;
    let policy = args.policy.as_deref();
    let Some((graph, _, opened)) = compile(&args.file, policy, args.format, &mut project, report)? else {
        return Ok(Exit::Findings);
    };
    let start = start_state(opened.scene.as_ref());
    let mut driver = connect(&args.driver, Hello::of(&graph), Time::ZERO)?;
    let guard = opened.session.world_tracker().map(|course| Guard::new(course, CheckMode::Beside));
    let engine = engine(graph, &start, driver.capabilities(), guard.as_ref(), settings())?;
    let journal = match &args.record {
        Some(folder) => {
            let instance = &driver.welcome().instance;
            let saved = SavedDriver::process(&args.driver, instance, SavedProject::of(opened));
            Some(create_journal(folder, &engine, &start, &saved)?)
        }
        None => None,
    };
    let view = view(args.format, engine.graph(), colors, Clock::Wall);
    // The driver keeps the time of the wall clock, so the view never waits.
    let paced = PacedView::new(view, Speed::Times(1.0)).with_guard(guard);
    let events = vec![Event::Begin];
    Runner { engine, driver: &mut driver, journal, from: Time::ZERO, events }.run(paced)
}

/// Settings of the engine: a safe stop may take as long as it takes to reach a silent driver again.
fn settings() -> EngineSettings {
    let recovery = u64::try_from(DriverTimeouts::default().recovery().as_nanos()).unwrap_or(u64::MAX);
    EngineSettings { safe_stop_within: Time::from_nanos(recovery), ..EngineSettings::default() }
}
