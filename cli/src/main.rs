//! The executable of the `motet` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    motet_cli::run(std::env::args_os(), None).into()
}
