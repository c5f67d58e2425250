//! `motet completions`: completions for a shell.

use clap::builder::PossibleValuesParser;
use clap::{Args, CommandFactory};
use motet_compiler::explain_pages;
use motet_robots::builtin;
use motet_sim::Profile;

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
    clap_complete::generate(args.shell, &mut with_names(Cli::command()), "motet", &mut script);
    let mut out = Output::default();
    out.text(&String::from_utf8_lossy(&script));
    report::close(&mut out, Ok(Exit::Success))
}

/// Command whose arguments offer the names that are built in, for completions only: each takes paths as well.
fn with_names(command: clap::Command) -> clap::Command {
    let command = command.mut_args(|arg| {
        let names: Vec<&'static str> = match arg.get_id().as_str() {
            "robot" => motet_project::robot_names().collect(),
            "scene" | "world" => builtin::SCENES.iter().map(|scene| scene.name).collect(),
            "profile" => Profile::names().collect(),
            "code" => explain_pages::PAGES.iter().map(|page| page.code).collect(),
            _ => return arg,
        };
        arg.value_parser(PossibleValuesParser::new(names))
    });
    command.mut_subcommands(with_names)
}
