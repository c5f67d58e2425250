//! `motet export`: journals in other formats.

use std::path::PathBuf;

use clap::{Args, Subcommand};

/// `motet export`
#[derive(Args, Debug)]
pub(crate) struct ExportArgs {
    /// To which format.
    #[command(subcommand)]
    pub(crate) command: ExportCommand,
}

/// The formats.
#[derive(Subcommand, Debug)]
pub(crate) enum ExportCommand {
    /// Write a journal as an MCAP file, for Foxglove and other viewers
    Mcap(McapArgs),
}

/// `motet export mcap`
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  motet export mcap run/ -o run.mcap")]
pub(crate) struct McapArgs {
    /// The folder of the journal
    #[arg(value_name = "FOLDER")]
    pub(crate) folder: PathBuf,
    /// The file to write
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,
}
