//! The executable of the `motet` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    // Beyond a limit of file sizes (`ulimit -f`) a write then fails as on a full disk, and a run ends safely.
    #[cfg(unix)]
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, std::sync::Arc::default());
    motet_cli::run(std::env::args_os(), None).into()
}
