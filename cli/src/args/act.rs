//! The flags of `motet do`.

use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;
use motet_runtime::Time;

use super::duration::duration;
use super::input::WorldArgs;
use super::model::ModelArgs;
use super::run::{RunFormat, SimulatedArgs};

/// `motet do`
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet do 'bring me the coke' --robot hsr --scene kitchen\n  \
    motet do 'bring me the mug' --robot hsr --scene kitchen --ask script answers.txt --speed max\n  \
    motet do 'bring me the coke' --robot hsr --scene kitchen --planner http://localhost:8000 --model NAME --dialect vllm\n\n\
    A line that is typed while the robot moves is a new request and takes over at once; `--say '12s: bring me the apple instead'` types\n\
    one after 12 s of the run.")]
pub(crate) struct DoArgs {
    /// What to do, in words
    #[arg(value_name = "REQUEST")]
    pub(crate) request: String,
    /// In which world.
    #[command(flatten)]
    pub(crate) world: WorldArgs,
    /// Who plans.
    #[command(flatten)]
    pub(crate) asking: ModelArgs,
    /// Who answers questions: `terminal`, `never`, or `script FILE` with an answer a line
    #[arg(long, num_args = 1..=2, value_names = ["terminal|script|never", "FILE"])]
    pub(crate) ask: Vec<String>,
    /// What is said while the robot moves, and when: `12s: bring me the apple instead`; as often as wanted
    #[arg(long, value_name = "TIME: TEXT")]
    pub(crate) say: Vec<Said>,
    /// New folder in which the requests, policies, questions, endings and the journal of each run are written down
    #[arg(long, value_name = "FOLDER")]
    pub(crate) record: Option<PathBuf>,
    /// How the world is simulated.
    #[command(flatten)]
    pub(crate) simulated: SimulatedArgs,
    /// Scene as it really is, where it is otherwise than the robot is told: a built-in name, or a JSON file
    #[arg(long = "real", value_name = "NAME|FILE")]
    pub(crate) real: Option<String>,
    /// How to show the run
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub(crate) format: RunFormat,
}

/// Something that is said at a time.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Said {
    /// When, since the first run began.
    pub(crate) at: Time,
    /// What.
    pub(crate) text: String,
}

impl FromStr for Said {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || "write when and what, such as `12s: bring me the apple instead`".to_owned();
        let (at, text) = text.split_once(':').ok_or_else(wrong)?;
        let at = Time::from_secs(duration(at).map_err(|_| wrong())?);
        let text = text.trim();
        if text.is_empty() { Err(wrong()) } else { Ok(Self { at, text: text.to_owned() }) }
    }
}

#[cfg(test)]
mod tests {
    use super::Said;
    use motet_runtime::Time;

    #[test]
    fn what_is_said_has_a_time() {
        let said = Said { at: Time::from_secs(1.5), text: "stop: now".to_owned() };
        assert_eq!("1.5s: stop: now".parse(), Ok(said));
        for wrong in ["", "stop", "12: stop", "12s:", "soon: stop", ": stop"] {
            assert!(wrong.parse::<Said>().is_err(), "{wrong}");
        }
    }
}
