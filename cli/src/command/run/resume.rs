//! `motet run --resume`: continues a run whose process ended before it did.

use std::path::Path;

use motet::run::unix_ns;
use motet_host::journal::JournalWriter;
use motet_host::remote::protocol::Hello;
use motet_planner::runtime_check::{CheckMode, Guard};
use motet_project::{SavedDriver, SavedProject};
use motet_runtime::journal::{
    DriverReplay, EngineReplay, JournalEntry, JournalHead, OpenGoals, ResumeEntry, StepEntry,
};
use motet_runtime::{Driver, Event, Time, Verifier as _};

use super::RunArgs;
use crate::command::drive::connect;
use crate::error::{CliError, Exit};
use crate::output::{Colors, count, note};
use crate::report::Report;
use crate::run_view::{Clock, view};
use crate::runner::{PacedView, Runner, exit_of, journal_error};

/// Rebuilds the engine and the simulator from a journal, and continues.
///
/// # Errors
///
/// The journal cannot be read or is damaged, or the replay differs from it.
pub(super) fn resume(
    folder: &Path,
    args: &RunArgs,
    colors: Colors,
    report: &mut Report,
) -> Result<Exit, CliError> {
    let mut entries = Vec::new();
    let (mut writer, tail) =
        JournalWriter::open(folder, &mut |_, entry| entries.push(entry)).map_err(journal_error)?;
    let Some(JournalEntry::Head(head)) = entries.first() else {
        return Err(CliError::Message("the journal has no head".to_owned()));
    };
    let mut replay = EngineReplay::new(head).map_err(|error| CliError::Message(error.to_string()))?;
    let saved = SavedDriver::from_json(&head.driver)?;
    let mut simulator = match &saved {
        SavedDriver::Simulator(saved) => Some(saved.open()?),
        SavedDriver::Process { .. } => None,
    };
    let clock = match &saved {
        SavedDriver::Simulator(_) => Clock::Simulated,
        SavedDriver::Process { .. } => Clock::Wall,
    };
    let view = view(args.format, replay.engine().graph(), colors, clock);
    let mut paced = PacedView::new(view, args.simulation.speed);
    let (mut ledger, mut retrace) = (OpenGoals::default(), DriverReplay::default());
    let verifies = match &saved {
        SavedDriver::Simulator(_) => args.simulation.speed.verifies(),
        SavedDriver::Process { .. } => CheckMode::Beside,
    };
    let checked = saved.project().filter(|_| head.settings.verify_within.is_some());
    let course = checked.and_then(|checked| open_course(checked, report));
    let mut guard = course.map(|course| Guard::new(course, verifies));
    let mut begun = false;
    for (number, entry) in entries.iter().enumerate() {
        let differs = |why: String| CliError::Message(format!("entry {number} of the journal: {why}"));
        match replay.take(entry) {
            Ok(None) => {}
            Ok(Some(_)) => {
                return Err(differs(
                    "the engine acts differently now; `motet replay` shows the difference".to_owned(),
                ));
            }
            Err(error) => return Err(differs(error.to_string())),
        }
        if let Some(simulator) = &mut simulator {
            retrace.take(simulator, entry).map_err(|astray| differs(astray.to_string()))?;
        }
        if let Some(guard) = &mut guard {
            if let JournalEntry::Step(StepEntry { event: Some(event), .. }) = entry {
                guard.event(event);
            }
            replay.effects().iter().for_each(|effect| guard.effect(effect));
        }
        ledger.take(entry);
        paced.past(replay.now(), replay.effects());
        begun |= matches!(entry, JournalEntry::Step(step) if step.event == Some(Event::Begin));
    }
    if ledger.is_over {
        note("the run is over; nothing is left to do");
        let end = replay.effects().iter().find_map(|effect| match effect {
            motet_runtime::Effect::Finished(end) => Some(exit_of(end)),
            _ => None,
        });
        return Ok(end.unwrap_or(Exit::Success));
    }
    let from = now(head, &saved, replay.now());
    let mut events = if begun { Vec::new() } else { vec![Event::Begin] };
    let unix_ns = unix_ns();
    let resumed = JournalEntry::Resumed(ResumeEntry { unix_ns, cut_bytes: tail.torn_bytes });
    writer.append(|chain| chain.line(resumed)).and_then(|()| writer.sync()).map_err(journal_error)?;
    let cut = match tail.torn_bytes {
        0 => String::new(),
        bytes => format!("; cut off {bytes} bytes of an unfinished entry"),
    };
    let goals = count(ledger.goals.len(), "goal");
    note(&format!("resumed at {} after {} entries, {goals} open{cut}", replay.now(), entries.len()));
    let paced = paced.with_guard(guard);
    let driver: Box<dyn Driver> = match (saved, simulator) {
        (SavedDriver::Process { address, instance, .. }, _) => {
            let hello = Hello::of(replay.engine().graph());
            let mut driver = connect(&address.into(), hello, from)?;
            let caught_up = driver.catch_up(&ledger, &instance, from);
            events.extend(caught_up.map_err(|breakage| CliError::Message(breakage.to_string()))?);
            Box::new(driver)
        }
        (SavedDriver::Simulator(_), Some(simulator)) => Box::new(simulator),
        (SavedDriver::Simulator(saved), None) => Box::new(saved.open()?),
    };
    let mut driver = driver;
    let engine = replay.into_engine();
    Runner { engine, driver: &mut *driver, journal: Some(writer), from, events }.run(paced)
}

/// Time at which the run continues. Simulated time has stood still since the crash; the time of a robot has
/// not.
fn now(head: &JournalHead, saved: &SavedDriver, last: Time) -> Time {
    match saved {
        SavedDriver::Simulator(_) => last,
        SavedDriver::Process { .. } => {
            let passed = unix_ns().saturating_sub(head.began_unix_ns);
            head.from.after(Time::from_nanos(passed)).max(last)
        }
    }
}

/// World tracker at the beginning of the run; `None`, with a note, if the files of the project are gone or
/// have changed.
fn open_course(saved: &SavedProject, report: &mut Report) -> Option<motet_compiler::WorldTracker> {
    match saved.open(report) {
        Ok(Some(course)) => Some(course),
        Ok(None) => {
            note("the scene has changed since the run began: deferred motions are left to the driver");
            None
        }
        Err(error) => {
            note(&format!("deferred motions are left to the driver: {}", CliError::from(error)));
            None
        }
    }
}
