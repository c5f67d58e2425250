//! `motet-fleet`: robots of a fleet over NATS. The command `motet` passes `agent`, `fleet` and `journal` on.

mod agent;
mod archive;
mod journal;
mod link;
mod notes;
mod operator;
mod results;
mod run;
mod ship;
mod signed;
mod swap;
mod view;

use clap::{Parser, Subcommand};
use std::io::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;

/// Run orders on robots of a fleet, and let operators see and steer them
#[derive(Parser, Debug)]
#[command(name = "motet", version, disable_help_subcommand = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand, Debug)]
enum Command {
    /// Run orders of a fleet on this robot; it goes on without the link
    Agent(Box<agent::AgentArgs>),
    /// See and steer the robots of a fleet
    Fleet(operator::FleetArgs),
    /// Copy journals into an archive and back
    Journal(archive::JournalArgs),
}

#[tokio::main]
async fn main() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Agent(args) => agent::serve(*args).await,
        Command::Fleet(args) => operator::run(args).await,
        Command::Journal(args) => archive::run(args).await,
    };
    match result {
        Ok(code) => code.into(),
        Err(why) => {
            let _ = writeln!(std::io::stderr(), "error: {}", why.escape_debug());
            ExitCode::from(2)
        }
    }
}

/// The command `motet`: next to this executable, or in PATH.
fn motet() -> Option<PathBuf> {
    let beside = std::env::current_exe().ok().and_then(|own| Some(own.parent()?.join("motet")));
    let path = std::env::var_os("PATH").unwrap_or_default();
    let mut candidates =
        beside.into_iter().chain(std::env::split_paths(&path).map(|folder| folder.join("motet")));
    candidates.find(|file| file.is_file())
}
