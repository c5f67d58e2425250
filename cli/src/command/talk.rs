//! `motet talk`: a conversation of many requests and questions with a robot on any driver.

use clap::Args;

use crate::conversation::{ConversationArgs, converse};
use crate::error::{CliError, Exit};
use crate::flags::DiagnosticFormat;
use crate::output::Colors;
use crate::report::Report;

/// Flags of `motet talk`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet talk --robot hsr --scene kitchen\n  \
    motet talk --robot hsr --scene kitchen --driver mujoco --speed max\n  \
    printf 'bring me the coke\\nwhat did you do?\\n' | motet talk --robot hsr --scene kitchen --speed max\n\n\
    Each line is a request (`bring me the coke`), a question (`where is the coke?`, `what do you hold?`,\n\
    `is the fridge open?`, `what did you do?`) or a statement (`the coke is in the fridge`). A line typed\n\
    while the robot moves counts at once; of a pipe only with --live. The conversation ends with the\n\
    input.\n\n\
    Exit codes: 0 everything was done or answered, 3 something was not, 130 interrupted.")]
pub(crate) struct TalkArgs {
    #[command(flatten)]
    conversation: ConversationArgs,
}

/// Runs the command.
pub(crate) fn run(args: &TalkArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run_held(DiagnosticFormat::Human, colors, |report| {
        converse(None, &args.conversation, colors, report)
    })
}
