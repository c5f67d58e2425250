//! `motet completions`: completions for a shell.

use clap::{Args, CommandFactory};

use crate::Cli;
use crate::error::{CliError, Exit};
use crate::output::Output;
use crate::report;

/// Flags of `motet completions`.
#[derive(Args, Debug)]
#[command(
    after_help = "Example:\n  motet completions bash > ~/.local/share/bash-completion/completions/motet"
)]
pub(crate) struct CompletionsArgs {
    #[arg(value_enum)]
    shell: clap_complete::Shell,
}

/// Runs the command.
pub(crate) fn run(args: &CompletionsArgs) -> Result<Exit, CliError> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "motet", &mut script);
    let mut out = Output::default();
    out.text(&String::from_utf8_lossy(&script));
    report::close(&mut out, Ok(Exit::Success))
}
