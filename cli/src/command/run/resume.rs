//! `motet run --resume`: goes on with a run whose process ended before it did.

use std::path::Path;

use motet_host::journal::Writer;
use motet_runtime::journal::{Entry, Ledger, Replay, Resumed, Retrace};
use motet_runtime::{Event, wire};

use super::pace::Pace;
use super::play::{self, Play, journal_trouble};
use super::saved::Saved;
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
        Writer::open(folder, &mut |_, entry| entries.push(entry)).map_err(journal_trouble)?;
    let Some(Entry::Head(head)) = entries.first() else {
        return Err(Trouble::Other("the journal has no head".to_owned()));
    };
    let mut replay = Replay::new(head).map_err(|error| Trouble::Other(error.to_string()))?;
    let Saved::Simulator(saved) = Saved::of(&head.driver)?;
    let mut simulator = saved.make()?;
    let view = play::view(args.format, replay.engine().graph(), colors);
    let mut pace = Pace::new(view, args.speed);
    let (mut ledger, mut retrace) = (Ledger::default(), Retrace::default());
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
        retrace.take(&mut simulator, entry).map_err(|astray| differs(astray.to_string()))?;
        ledger.take(entry);
        pace.past(replay.now(), replay.effects());
        begun |= matches!(entry, Entry::Step(step) if step.event == Some(wire::Event::Begin));
    }
    let end = replay.effects().iter().find_map(|effect| match effect {
        motet_runtime::Effect::Finished(end) => Some((**end).clone()),
        _ => None,
    });
    if ledger.is_over {
        note("the run is over, nothing is left to do");
        return Ok(end.map_or(Exit::Clean, |end| play::exit(&end)));
    }
    let unix_ns = play::unix_ns();
    let resumed = Entry::Resumed(Resumed { unix_ns, cut_bytes: tail.torn_bytes });
    writer.append(|chain| chain.line(resumed)).and_then(|()| writer.sync()).map_err(journal_trouble)?;
    let cut = match tail.torn_bytes {
        0 => String::new(),
        bytes => format!("; {bytes} bytes of an unfinished entry were cut off"),
    };
    let goals = crate::out::count(ledger.goals.len(), "goal");
    note(&format!("resumed at {} after {} entries, {goals} open{cut}", replay.now(), entries.len()));
    let from = replay.now();
    let events = if begun { Vec::new() } else { vec![Event::Begin] };
    let play =
        Play { engine: replay.into_engine(), driver: &mut simulator, journal: Some(writer), from, events };
    Ok(play::exit(&play.run(pace)?))
}
