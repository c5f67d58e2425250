//! The flags of `motet do`.

use std::path::PathBuf;

use clap::Args;

use super::input::WorldArgs;
use super::model::ModelArgs;
use super::run::{RunFormat, SimulatedArgs};

/// `motet do`
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet do 'bring me the coke' --robot hsr --scene kitchen\n  \
    motet do 'bring me the mug' --robot hsr --scene kitchen --ask script answers.txt --speed max\n  \
    motet do 'bring me the coke' --robot hsr --scene kitchen --planner http://localhost:8000 --model NAME --dialect vllm\n\n\
    A line that is typed while the robot moves is a new request and takes over at once.")]
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
    /// Folder in which the requests, policies, questions and endings are written down
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
