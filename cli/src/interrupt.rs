//! Requests to stop, from Ctrl-C and other signals, and the commands that may move the robot meanwhile.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::Duration;

use motet_runtime::journal::OpenGoals;
use motet_runtime::{DriverEvent, Effect, Event, GoalId};

use crate::error::CliError;
use crate::output::queue::WhenFull;
use crate::output::{self, escape, note};
use crate::typed_line;

/// Interval at which a waiting run checks for an interrupt.
pub(crate) const SLICE: Duration = Duration::from_millis(50);

/// Number of requests to stop: presses of Ctrl-C, and other signals to end.
static REQUESTS: AtomicU32 = AtomicU32::new(0);

/// Commands that may move the robot, by their goals. They stay until the driver has said that they ended or
/// stand still, or the run has given up waiting for that.
static MOVING: Mutex<BTreeMap<GoalId, String>> = Mutex::new(BTreeMap::new());

/// Turns each signal to end that a process can handle into a request to stop. The second one ends the process
/// where nothing can move; otherwise it says what may move, and the process ends with the safe stop.
pub(crate) fn catch_interrupts() -> Result<(), CliError> {
    static CAUGHT: OnceLock<Result<(), String>> = OnceLock::new();
    let caught = CAUGHT.get_or_init(|| catch().map_err(|error| error.to_string()));
    caught.clone().map_err(|error| CliError::Message(format!("cannot handle Ctrl-C: {error}")))
}

/// Catches the signals, and lets no reader of the output stop the runs that begin now.
pub(crate) fn guard_runs(when: WhenFull) -> Result<(), CliError> {
    catch_interrupts()?;
    let cannot = |error| CliError::Message(format!("cannot write the output: {error}"));
    output::queue::begin(when, is_interrupted).map_err(cannot)
}

#[cfg(unix)]
fn catch() -> std::io::Result<()> {
    use signal_hook::consts::{
        SIGALRM, SIGHUP, SIGINT, SIGPROF, SIGQUIT, SIGTERM, SIGTSTP, SIGUSR1, SIGUSR2, SIGVTALRM, SIGXCPU,
    };
    let ends = [SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF, SIGXCPU];
    let mut signals = signal_hook::iterator::Signals::new(ends.into_iter().chain([SIGTSTP]))?;
    let each = move || {
        for signal in signals.forever() {
            match signal {
                // A suspended run would watch nothing while the robot moves.
                SIGTSTP if note_moving() => note("so the run is not suspended; Ctrl-C stops it"),
                SIGTSTP => {
                    let _ = signal_hook::low_level::emulate_default_handler(SIGTSTP);
                }
                _ => request_stop(),
            }
        }
    };
    std::thread::Builder::new().name("signals".to_owned()).spawn(each).map(drop)
}

#[cfg(not(unix))]
fn catch() -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(request_stop)
}

fn request_stop() {
    if REQUESTS.fetch_add(1, Ordering::SeqCst) == 0 {
        return;
    }
    if !note_moving() {
        typed_line::restore();
        output::queue::drain();
        std::process::exit(130);
    }
    note("the run ends once the driver has confirmed the stop, or has not answered in time");
}

fn moving() -> MutexGuard<'static, BTreeMap<GoalId, String>> {
    MOVING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Says which commands may still move the robot. False if there are none.
pub(crate) fn note_moving() -> bool {
    let commands: Vec<String> = moving().values().cloned().collect();
    if !commands.is_empty() {
        note(&format!("these commands may still move the robot: {}", commands.join(", ")));
    }
    !commands.is_empty()
}

/// Keeps in mind what an effect lets move.
pub(crate) fn note_effect(effect: &Effect) {
    match effect {
        Effect::Start { goal, command, .. } => {
            moving().insert(*goal, escape(&command.to_string()));
        }
        Effect::Finished(_) => moving().clear(),
        _ => {}
    }
}

/// Keeps in mind what a run that goes on had let move.
pub(crate) fn note_open(ledger: &OpenGoals) {
    let open = ledger.goals.iter().map(|(goal, open)| (*goal, escape(&open.command.to_string())));
    moving().extend(open);
}

/// Keeps in mind what an event says to stand still.
pub(crate) fn note_event(event: &Event) {
    if let Event::Driver(
        DriverEvent::Ended { goal, .. } | DriverEvent::Refused { goal, .. } | DriverEvent::Stopped { goal },
    ) = event
    {
        moving().remove(goal);
    }
}

/// Is `true` after Ctrl-C and after another signal to end.
pub(crate) fn is_interrupted() -> bool {
    REQUESTS.load(Ordering::SeqCst) > 0
}
