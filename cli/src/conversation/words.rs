//! Words during a run: lines that the flags schedule, or that a person types. A run of one policy takes those
//! that stop it, hold it and let it go on; a conversation reads the others, too.

use std::cmp::Reverse;
use std::rc::Rc;
use std::str::FromStr;

use clap::Args;
use motet_runtime::{RunControl, Time};

use super::operator::OperatorInput;
use crate::error::CliError;
use crate::flags::time_of_run;
use crate::interrupt::SLICE;
use crate::output::{escape, note};
use crate::run_view::SpokenControl;

/// Interval at which scheduled lines are checked.
const INTERVAL: Time = Time::from_nanos(100_000_000);

/// Flags of the words during a run.
#[derive(Args, Debug)]
pub(crate) struct WordArgs {
    /// Take lines of stdin as they come, also while the robot moves, as from a terminal
    #[arg(long)]
    pub(crate) live: bool,
    /// Line that is typed during the run, such as `12s: wait`; repeatable
    #[arg(long, value_name = "TIME: TEXT")]
    pub(crate) say: Vec<ScheduledRequest>,
}

/// Lines that are typed during a run.
pub(super) struct TypedLines {
    /// Scheduled lines, the latest first.
    scheduled: Vec<ScheduledRequest>,
    operator: Rc<OperatorInput>,
}

impl TypedLines {
    pub(super) fn new(args: &WordArgs, operator: Rc<OperatorInput>) -> Self {
        let mut scheduled = args.say.clone();
        scheduled.reverse();
        scheduled.sort_by_key(|request| Reverse(request.at));
        Self { scheduled, operator }
    }

    /// Next line that is due, which is shown.
    pub(super) fn due(&mut self, now: Time) -> Option<String> {
        let due = self.scheduled.pop_if(|request| request.at <= now).map(|request| request.text);
        let line = due.or_else(|| self.operator.typed())?;
        note(&format!("> {}", escape(&line)));
        Some(line)
    }

    /// True while scheduled lines are left.
    pub(super) fn are_scheduled(&self) -> bool {
        !self.scheduled.is_empty()
    }

    /// True if nobody can say anything more while the robot moves.
    pub(super) fn are_over(&self) -> bool {
        self.scheduled.is_empty() && self.operator.is_over()
    }

    /// Longest span without a look for lines that are due.
    pub(super) fn at_least_every(&self) -> Time {
        if self.scheduled.is_empty() { Time::NEVER } else { INTERVAL }
    }
}

/// Words for a run of one policy.
pub(crate) struct RunWords {
    lines: TypedLines,
    is_held: bool,
    is_stopped: bool,
}

impl RunWords {
    /// Words of the flags; none if they ask for none.
    pub(crate) fn of(args: &WordArgs) -> Result<Option<Box<dyn SpokenControl>>, CliError> {
        let operator = match args.live {
            true => OperatorInput::read(&[], true, None)?,
            false if args.say.is_empty() => return Ok(None),
            false => OperatorInput::Never,
        };
        let lines = TypedLines::new(args, Rc::new(operator));
        Ok(Some(Box::new(Self { lines, is_held: false, is_stopped: false })))
    }
}

impl SpokenControl for RunWords {
    fn at_least_every(&self) -> Time {
        self.lines.at_least_every()
    }

    fn is_stopped(&self) -> bool {
        self.is_stopped
    }

    fn control(&mut self, now: Time) -> Option<RunControl> {
        let was_held = self.is_held;
        match self.lines.due(now) {
            Some(line) if motet_requests::stops(&line) => self.is_stopped = true,
            Some(line) if motet_requests::holds(&line) => self.is_held = true,
            Some(line) if motet_requests::proceeds(&line) => self.is_held = false,
            Some(_) => note("  a policy takes `stop`, `wait` and `go on`; `motet do` takes other words"),
            None if self.is_held && self.lines.are_over() => {
                note("  stopped: nobody is there to let it go on");
                self.is_stopped = true;
            }
            // Time of a simulation may pass at any speed, and a person needs a moment.
            None if self.is_held && !self.lines.are_scheduled() => {
                std::thread::sleep(SLICE);
                return None;
            }
            None => return None,
        }
        if self.is_stopped {
            return Some(RunControl::Stop);
        }
        if was_held == self.is_held {
            return Some(RunControl::Continue);
        }
        note_held(self.is_held);
        Some(if self.is_held { RunControl::Hold } else { RunControl::Proceed })
    }
}

/// Says that a person holds the run, or lets it go on.
pub(super) fn note_held(is_held: bool) {
    note(if is_held { "  keeps still; `go on` lets it go on" } else { "  goes on" });
}

/// Request that is typed at a time of the run.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct ScheduledRequest {
    /// Time since the start of the first run.
    pub(super) at: Time,
    pub(super) text: String,
}

impl FromStr for ScheduledRequest {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || "write a time and a request, such as `12s: bring me the apple instead`".to_owned();
        let (at, text) = text.split_once(':').ok_or_else(wrong)?;
        let at =
            Time::from_secs(time_of_run(at).map_err(|why| format!("`{at}` is no time: {why}; {}", wrong()))?);
        let text = text.trim();
        if text.is_empty() { Err(wrong()) } else { Ok(Self { at, text: text.to_owned() }) }
    }
}

#[cfg(test)]
mod tests {
    use super::ScheduledRequest;
    use motet_runtime::Time;

    #[test]
    fn scheduled_request_has_a_time() {
        let request = ScheduledRequest { at: Time::from_secs(1.5), text: "stop: now".to_owned() };
        assert_eq!("1.5s: stop: now".parse(), Ok(request));
        assert!("0s: wait".parse::<ScheduledRequest>().is_ok_and(|request| request.at == Time::ZERO));
        for wrong in ["", "stop", "12: stop", "12s:", "soon: stop", ": stop"] {
            assert!(wrong.parse::<ScheduledRequest>().is_err(), "{wrong}");
        }
    }
}
