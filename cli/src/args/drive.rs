//! The flags of `motet drive`.

use std::path::PathBuf;

use clap::Args;
use motet_host::remote::DriverAddress;

use super::input::WorldArgs;
use super::run::RunFormat;

/// `motet drive`
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet drive fetch_mug.motet --robot hsr --driver 'python3 examples/drivers/echo.py'\n  \
    motet drive fetch_mug.motet --robot hsr --driver tcp://127.0.0.1:4711 --record run/")]
pub(crate) struct DriveArgs {
    /// The policy: a file, or `-` for standard input
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Which policy of the file; needed where it has several
    #[arg(long, value_name = "NAME")]
    pub(crate) policy: Option<String>,
    /// What is known of the world.
    #[command(flatten)]
    pub(crate) world: WorldArgs,
    /// The driver: a command that speaks the driver protocol on its standard input and output, or tcp://127.0.0.1:PORT
    #[arg(long, value_name = "COMMAND|ADDRESS")]
    pub(crate) driver: DriverAddress,
    /// Write a journal of the run into this folder; `motet run --resume` goes on with it
    #[arg(long, value_name = "FOLDER")]
    pub(crate) record: Option<PathBuf>,
    /// How to show the run
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub(crate) format: RunFormat,
}
