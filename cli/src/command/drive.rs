//! `motet drive`: checks a policy and runs it on a driver in another process, or checks such a driver.

mod conformance;

use std::path::{Path, PathBuf};

use clap::Args;
use motet::run::{create_journal, engine, run_id, start_state};
use motet_host::remote::protocol::Hello;
use motet_host::remote::{DriverAddress, DriverTimeouts};
use motet_planner::runtime_check::{CheckMode, Guard};
use motet_project::{SavedDriver, SavedProject};
use motet_runtime::{Driver, DriverClock, EngineSettings, Event, Time};

use super::run::compile;
use crate::documents::one_document;
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
    motet drive fetch_mug.motet --robot hsr --driver tcp://127.0.0.1:4711 --record run/\n  \
    motet drive --check --driver 'python3 my_driver.py'    check the laws of drivers")]
pub(crate) struct DriveArgs {
    /// Policy file, or `-` for stdin; with `--check`, the driver gets its first call instead of `say`
    #[arg(value_name = "FILE", required_unless_present = "check")]
    file: Option<PathBuf>,
    /// Policy to run; required if the file has several
    #[arg(long, value_name = "NAME")]
    policy: Option<String>,
    #[command(flatten)]
    session: SessionArgs,
    /// Driver: a command that speaks the driver protocol on its stdin and stdout, or tcp://127.0.0.1:PORT
    #[arg(long, value_name = "COMMAND|ADDRESS")]
    driver: DriverAddress,
    /// Check if the driver keeps the laws of drivers, and print each broken one with its messages
    #[arg(long, conflicts_with_all = ["record", "speed"])]
    check: bool,
    /// Seconds that a call may take in a check
    ///
    /// The default is 5, or the deadline of the call for a driver that owns the clock.
    #[arg(long, value_name = "SECS", requires = "check")]
    patience: Option<f64>,
    /// Write a journal of the run into this folder; `motet run --resume` continues it
    #[arg(long, value_name = "FOLDER")]
    record: Option<PathBuf>,
    /// Speed of a driver that owns the clock, such as a simulator: a factor such as 10, or max
    #[arg(long, value_name = "FACTOR")]
    speed: Option<Speed>,
    /// View of the run: a tree of steps, or JSON events
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    format: OutputFormat,
}

/// Runs the command.
pub(crate) fn run(args: &DriveArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run(args.format.into(), colors, |report| match &args.file {
        file if args.check => conformance::check(file.as_deref(), args, report),
        Some(file) => check_and_drive(file, args, colors, report),
        None => Err(CliError::Message("a policy is needed".to_owned())),
    })
}

fn check_and_drive(
    file: &Path,
    args: &DriveArgs,
    colors: Colors,
    report: &mut Report,
) -> Result<Exit, CliError> {
    let mut project = args.session.project().open_with(report)?;
    let policy = args.policy.as_deref();
    let document = one_document(file)?;
    let Some((graph, _, opened)) = compile(&document, policy, args.format, &mut project, report)? else {
        return Ok(Exit::Findings);
    };
    let start = start_state(opened.scene.as_ref());
    let run = run_id();
    let mut driver = connect(&args.driver, Hello::of(&graph, &run), Time::ZERO)?;
    let (clock, speed, verifies) = match (driver.capabilities().clock, args.speed) {
        (DriverClock::Driver, speed) => {
            let speed = speed.unwrap_or(Speed::Times(1.0));
            (Clock::Simulated, speed, speed.verifies())
        }
        (DriverClock::Wall, None) => (Clock::Wall, Speed::Times(1.0), CheckMode::Beside),
        (DriverClock::Wall, Some(_)) => {
            let why =
                "this driver goes by the clock on the wall: `--speed` is for drivers that own the clock";
            return Err(CliError::Message(why.to_owned()));
        }
    };
    let guard = opened.session.world_tracker().map(|course| Guard::new(course, verifies));
    let engine = engine(graph, &start, driver.capabilities(), guard.as_ref(), settings())?;
    let journal = match &args.record {
        Some(folder) => {
            let instance = &driver.welcome().instance;
            let saved = SavedDriver::process(&args.driver, instance, SavedProject::of(opened));
            Some(create_journal(folder, &run, (&engine, &start), &saved)?)
        }
        None => None,
    };
    let view = view(args.format, engine.graph(), colors, clock);
    // Where the driver keeps the time of the wall clock, the view never waits.
    let paced = PacedView::new(view, speed).with_guard(guard);
    let events = vec![Event::Begin];
    Runner { engine, driver: &mut driver, journal, from: Time::ZERO, events }.run(paced)
}

/// Settings of the engine: a safe stop may take as long as it takes to reach a silent driver again.
fn settings() -> EngineSettings {
    let recovery = u64::try_from(DriverTimeouts::default().recovery().as_nanos()).unwrap_or(u64::MAX);
    EngineSettings { safe_stop_within: Time::from_nanos(recovery), ..EngineSettings::default() }
}
