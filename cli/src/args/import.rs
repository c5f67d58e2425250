//! `motet import`: other languages' files as Motet.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::FormatArgs;

/// `motet import`
#[derive(Args, Debug)]
pub(crate) struct ImportArgs {
    /// From which language.
    #[command(subcommand)]
    pub(crate) command: ImportCommand,
}

/// The languages.
#[derive(Subcommand, Debug)]
pub(crate) enum ImportCommand {
    /// Write a PDDL domain and problem as Motet declarations, or a plan for them as a policy
    Pddl(PddlArgs),
}

/// `motet import pddl`
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet import pddl domain.pddl problem.pddl -o blocks.motet\n  \
    motet import pddl domain.pddl problem.pddl --plan plan.txt -o plan.motet\n  \
    motet check plan.motet --domain blocks.motet")]
pub(crate) struct PddlArgs {
    /// The domain
    #[arg(value_name = "DOMAIN")]
    pub(crate) domain: PathBuf,
    /// The problem
    #[arg(value_name = "PROBLEM")]
    pub(crate) problem: PathBuf,
    /// A plan, an `(action argument …)` a line: it is written as a policy that states the problem's goal, to be checked
    /// with the declarations as `--domain`
    #[arg(long, value_name = "FILE")]
    pub(crate) plan: Option<PathBuf>,
    /// Where to write it; standard output where not given
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// How to say what is wrong.
    #[command(flatten)]
    pub(crate) format: FormatArgs,
}
