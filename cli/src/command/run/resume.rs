//! `motet run --resume`: goes on with a run whose process ended before it did.

use std::path::Path;

use motet_host::journal::JournalWriter;
use motet_host::remote::protocol::Hello;
use motet_planner::runtime_check::{CheckMode, Guard};
use motet_runtime::journal::{
    DriverReplay, EngineReplay, JournalEntry, JournalHead, OpenGoals, ResumeEntry, StepEntry,
};
use motet_runtime::{Driver, Event, Time, Verifier as _};

use super::drive;
use super::pace::Pace;
use super::play::{self, Play, journal_trouble};
use super::saved::Saved;
use super::view::Clock;
use crate::args::RunArgs;
use crate::exit::{Exit, Trouble};
use crate::out::{Colors, note};

/// Rebuilds the engine and the world from a journal, and goes on.
///
/// # Errors
///
/// The journal cannot be read, is damaged, or the engine or the world does not do the same again.
pub(super) fn resume(folder: &Path, args: &RunArgs, colors: Colors) -> Result<Exit, Trouble> {
    let mut entries = Vec::new();
    let (mut writer, tail) =
        JournalWriter::open(folder, &mut |_, entry| entries.push(entry)).map_err(journal_trouble)?;
    let Some(JournalEntry::Head(head)) = entries.first() else {
        return Err(Trouble::Other("the journal has no head".to_owned()));
    };
    let mut replay = EngineReplay::new(head).map_err(|error| Trouble::Other(error.to_string()))?;
    let saved = Saved::of(&head.driver)?;
    let mut world = match &saved {
        Saved::Simulator(saved) => Some(saved.make()?),
        Saved::Process { .. } => None,
    };
    let clock = match &saved {
        Saved::Simulator(_) => Clock::Simulated,
        Saved::Process { .. } => Clock::Wall,
    };
    let view = play::view(args.format, replay.engine().graph(), colors, clock);
    let mut pace = Pace::new(view, args.simulated.speed);
    let (mut ledger, mut retrace) = (OpenGoals::default(), DriverReplay::default());
    let verifies = match &saved {
        Saved::Simulator(_) => args.simulated.speed.verifies(),
        Saved::Process { .. } => CheckMode::Beside,
    };
    let guard = saved.guard().filter(|_| head.settings.verify_within.is_some());
    let mut guard = guard.and_then(|guard| guard.make(colors)).map(|course| Guard::new(course, verifies));
    let mut begun = false;
    for (number, entry) in entries.iter().enumerate() {
        let differs = |what: String| Trouble::Other(format!("entry {number} of the journal: {what}"));
        match replay.take(entry) {
            Ok(None) => {}
            Ok(Some(_)) => {
                return Err(differs(
                    "the engine does something else now; `motet replay` shows what".to_owned(),
                ));
            }
            Err(error) => return Err(differs(error.to_string())),
        }
        if let Some(world) = &mut world {
            retrace.take(world, entry).map_err(|astray| differs(astray.to_string()))?;
        }
        if let Some(guard) = &mut guard {
            if let JournalEntry::Step(StepEntry { event: Some(event), .. }) = entry {
                guard.event(event);
            }
            replay.effects().iter().for_each(|effect| guard.effect(effect));
        }
        ledger.take(entry);
        pace.past(replay.now(), replay.effects());
        begun |= matches!(entry, JournalEntry::Step(step) if step.event == Some(Event::Begin));
    }
    if ledger.is_over {
        note("the run is over, nothing is left to do");
        let end = replay.effects().iter().find_map(|effect| match effect {
            motet_runtime::Effect::Finished(end) => Some(play::exit(end)),
            _ => None,
        });
        return Ok(end.unwrap_or(Exit::Clean));
    }
    let from = now(head, &saved, replay.now());
    let mut events = if begun { Vec::new() } else { vec![Event::Begin] };
    let unix_ns = play::unix_ns();
    let resumed = JournalEntry::Resumed(ResumeEntry { unix_ns, cut_bytes: tail.torn_bytes });
    writer.append(|chain| chain.line(resumed)).and_then(|()| writer.sync()).map_err(journal_trouble)?;
    let cut = match tail.torn_bytes {
        0 => String::new(),
        bytes => format!("; {bytes} bytes of an unfinished entry were cut off"),
    };
    let goals = crate::out::count(ledger.goals.len(), "goal");
    note(&format!("resumed at {} after {} entries, {goals} open{cut}", replay.now(), entries.len()));
    let pace = pace.with_guard(guard);
    let driver: Box<dyn Driver> = match (saved, world) {
        (Saved::Process { address, instance, .. }, _) => {
            let hello = Hello::of(replay.engine().graph());
            let mut driver = drive::connect(&address.into(), hello, from)?;
            let caught_up = driver.catch_up(&ledger, &instance, from);
            events.extend(caught_up.map_err(|breakage| Trouble::Other(breakage.to_string()))?);
            Box::new(driver)
        }
        (Saved::Simulator(_), Some(world)) => Box::new(world),
        (Saved::Simulator(saved), None) => Box::new(saved.make()?),
    };
    let mut driver = driver;
    let engine = replay.into_engine();
    let play = Play { engine, driver: &mut *driver, journal: Some(writer), from, events };
    Ok(play::exit(&play.run(pace)?))
}

/// The time at which the run goes on. A world of its own has stood still meanwhile; for a robot the time went on.
fn now(head: &JournalHead, saved: &Saved, last: Time) -> Time {
    match saved {
        Saved::Simulator(_) => last,
        Saved::Process { .. } => {
            let passed = play::unix_ns().saturating_sub(head.began_unix_ns);
            head.from.after(Time::from_nanos(passed)).max(last)
        }
    }
}
