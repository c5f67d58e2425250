//! `motet do`: carries out a request in words on any driver: plans, checks, runs, asks, and replans.

use clap::Args;

use crate::conversation::{ConversationArgs, converse};
use crate::error::{CliError, Exit};
use crate::flags::DiagnosticFormat;
use crate::output::Colors;
use crate::report::Report;

/// Flags of `motet do`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet do 'bring me the coke' --robot hsr --scene kitchen\n  \
    motet do 'where is the coke?' --robot hsr --scene kitchen\n  \
    motet do 'bring me the mug' --robot hsr --scene kitchen --ask script answers.txt --speed max\n  \
    motet do 'bring me the coke' --robot hsr --scene kitchen --driver tcp://127.0.0.1:4711\n  \
    motet do 'bring me the coke' --robot hsr --scene kitchen --planner http://localhost:8000 --model NAME\n\n\
    A line typed while the robot moves counts at once: `stop`, `wait`, `go on`, a question, or a new\n\
    request, which takes over. `--say '12s: bring me the apple instead'` types one after 12 s of the run.\n\n\
    Exit codes: 0 done or answered, 3 not done, 130 interrupted.")]
pub(crate) struct DoArgs {
    /// Request or question in English
    #[arg(value_name = "REQUEST")]
    request: String,
    #[command(flatten)]
    conversation: ConversationArgs,
}

/// Runs the command.
pub(crate) fn run(args: &DoArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run_held(DiagnosticFormat::Human, colors, |report| {
        converse(Some(&args.request), &args.conversation, colors, report)
    })
}
