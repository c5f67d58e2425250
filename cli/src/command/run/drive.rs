//! `motet drive`: checks a policy and runs it on a driver in another process.

use motet_host::remote::protocol::Hello;
use motet_host::remote::{DriverAddress, DriverTimeouts, RemoteDriver};
use motet_planner::runtime_check::{CheckMode, Guard};
use motet_runtime::{Driver, EngineSettings, Event, Time};

use super::pace::Pace;
use super::play::{self, Play};
use super::saved::Saved;
use super::saved_guard::SavedGuard;
use super::view::Clock;
use super::{compile, form_of, start};
use crate::args::{DriveArgs, Speed};
use crate::exit::{Exit, Trouble};
use crate::out::{Colors, note, plain};
use crate::report::Report;
use crate::workbench::Workbench;

/// Runs the command.
///
/// # Errors
///
/// The file cannot be read, the driver cannot be reached, or the journal not be written.
pub(crate) fn run(args: &DriveArgs, colors: Colors) -> Result<Exit, Trouble> {
    let mut report = Report::new(form_of(args.format), colors);
    let result = check_and_drive(args, colors, &mut report);
    report.close(result)
}

fn check_and_drive(args: &DriveArgs, colors: Colors, report: &mut Report) -> Result<Exit, Trouble> {
    let mut bench = Workbench::open(&args.world, report)?;
    let policy = args.policy.as_deref();
    let Some((graph, _, setting)) = compile(&args.file, policy, args.format, &mut bench, report)? else {
        return Ok(Exit::Findings);
    };
    let start = start(setting.scene.as_ref());
    let mut driver = connect(&args.driver, Hello::of(&graph), Time::ZERO)?;
    let guard = setting.session.course().map(|course| Guard::new(course, CheckMode::Beside));
    let engine = play::engine(graph, &start, driver.capabilities(), guard.as_ref(), settings())?;
    let journal = match &args.record {
        Some(folder) => {
            let saved = Saved::process(
                &args.driver,
                &driver.welcome().instance,
                SavedGuard::of(&args.world, setting),
            );
            Some(play::journal(folder, &engine, &start, &saved)?)
        }
        None => None,
    };
    let view = play::view(args.format, engine.graph(), colors, Clock::Wall);
    // The driver's time is the wall clock's; the pace has nothing to wait for.
    let pace = Pace::new(view, Speed::Times(1.0)).with_guard(guard);
    let play = Play { engine, driver: &mut driver, journal, from: Time::ZERO, events: vec![Event::Begin] };
    Ok(play::exit(&play.run(pace)?))
}

/// A safe stop is waited for until a driver that went silent can have been called again.
fn settings() -> EngineSettings {
    let recovery = u64::try_from(DriverTimeouts::default().recovery().as_nanos()).unwrap_or(u64::MAX);
    EngineSettings { safe_stop_within: Time::from_nanos(recovery), ..EngineSettings::default() }
}

/// Starts or calls a driver.
///
/// # Errors
///
/// It cannot be reached, or does not speak the protocol.
pub(super) fn connect(address: &DriverAddress, hello: Hello, from: Time) -> Result<RemoteDriver, Trouble> {
    let say = |text: &str| note(&format!("driver: {}", plain(text)));
    RemoteDriver::connect(address.clone(), hello, DriverTimeouts::default(), from, Box::new(say))
        .map_err(|breakage| Trouble::Other(format!("{} ({address})", plain(&breakage.to_string()))))
}
