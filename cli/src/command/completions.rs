//! `motet completions`: completions for a shell.

use clap::CommandFactory;

use crate::args::{Cli, CompletionsArgs};
use crate::exit::{Exit, Trouble};
use crate::out::Out;
use crate::report;

/// Runs the command.
///
/// # Errors
///
/// Standard output cannot be written.
pub(crate) fn run(args: &CompletionsArgs) -> Result<Exit, Trouble> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "motet", &mut script);
    let mut out = Out::default();
    out.text(&String::from_utf8_lossy(&script));
    report::close(&mut out, Ok(Exit::Clean))
}
