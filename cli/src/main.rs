//! The `motet` command: reads the command line, calls the command, turns what it came to into an exit code.

mod args;
mod command;
mod document;
mod exit;
mod form;
mod graph;
mod input;
mod out;
mod progress;
mod report;
mod workbench;

use std::process::ExitCode;

use clap::Parser;

use args::{Cli, Command};
use exit::{Exit, Trouble};
use out::{Colors, note};

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            // Help that nobody reads is no mistake.
            let _ = error.print();
            return if error.use_stderr() { Exit::CouldNotRun.into() } else { Exit::Clean.into() };
        }
    };
    let colors = Colors::new(cli.color);
    match dispatch(&cli.command, colors) {
        Ok(exit) => exit.into(),
        Err(trouble) => {
            say(&trouble, colors);
            Exit::CouldNotRun.into()
        }
    }
}

fn dispatch(command: &Command, colors: Colors) -> Result<Exit, Trouble> {
    match command {
        Command::Check(args) => command::check::run(args, colors),
        Command::Fmt(args) => command::fmt::run(args, colors),
        Command::Compile(args) => command::compile::run(args, colors),
        Command::Import(args) => command::import::run(args, colors),
        Command::Do(args) => command::act::run(args, colors),
        Command::Prompt(args) => command::prompt::run(args, colors),
        Command::Dialog(args) => command::dialog::run(args, colors),
        Command::Dataset(args) => command::dataset::run(args, colors),
        Command::Plan(args) => command::plan::run(args, colors),
        Command::Run(args) => command::run::run(args, colors),
        Command::Drive(args) => command::run::drive(args, colors),
        Command::Replay(args) => command::replay::run(args, colors),
        Command::Export(args) => match &args.command {
            args::ExportCommand::Mcap(args) => command::run::mcap(args),
        },
        Command::Feasible(args) => command::feasible::run(args, colors),
        Command::Robots(args) => command::robots::run(args, colors),
        Command::Explain(args) => command::explain::run(args),
        Command::Grammar(args) => command::grammar::run(args, colors),
        Command::Decode(args) => command::decode::run(args, colors),
        Command::Schema(args) => command::schema::run(args),
        Command::Completions(args) => command::completions::run(args),
    }
}

fn say(trouble: &Trouble, colors: Colors) {
    let error = if colors.stderr { "\u{1b}[1;31merror\u{1b}[0m" } else { "error" };
    note(&format!("{error}: {trouble}"));
    if let Some(help) = trouble.help() {
        note(&format!("  help: {help}"));
    }
}
