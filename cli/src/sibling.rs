//! Commands in executables of their own, which are built and installed apart: `motet-ros2`, `motet-fleet`.

use std::ffi::OsString;
use std::path::PathBuf;
use std::process::Command;

use crate::error::{CliError, Exit};

/// Path of an executable: next to that of this command, or in PATH.
pub(crate) fn find(name: &str) -> Result<PathBuf, CliError> {
    let own = crate::PROGRAM.get().cloned().or_else(|| std::env::current_exe().ok());
    let beside = own.and_then(|own| Some(own.parent()?.join(name)));
    let path = std::env::var_os("PATH").unwrap_or_default();
    let candidates = beside.into_iter().chain(std::env::split_paths(&path).map(|folder| folder.join(name)));
    let found = candidates.into_iter().find(|file| file.is_file());
    found.ok_or_else(|| CliError::Advised {
        problem: format!("the executable `{name}` is neither next to `motet` nor in PATH"),
        help: format!("in the sources of Motet: `cargo install --path {}`", package(name)),
    })
}

/// Folder of the package of an executable.
fn package(name: &str) -> &'static str {
    if name == "motet-ros2" { "runtime/ros2" } else { "cli/fleet" }
}

/// Runs a command of an executable with arguments, and ends as it does.
pub(crate) fn run_as(name: &str, command: &str, arguments: &[OsString]) -> Result<Exit, CliError> {
    let words: Vec<OsString> = [command.into()].into_iter().chain(arguments.iter().cloned()).collect();
    run(name, &words)
}

/// Runs an executable with arguments, and ends as it does. On Unix it takes the place of this process, so
/// that signals reach it.
pub(crate) fn run(name: &str, arguments: &[OsString]) -> Result<Exit, CliError> {
    let program = find(name)?;
    let mut command = Command::new(&program);
    command.args(arguments);
    let started = |error| CliError::Message(format!("cannot start `{}`: {error}", program.display()));
    #[cfg(unix)]
    {
        Err(started(std::os::unix::process::CommandExt::exec(&mut command)))
    }
    #[cfg(not(unix))]
    {
        let status = command.status().map_err(started)?;
        Ok(match status.code() {
            Some(0) => Exit::Success,
            Some(1) => Exit::Findings,
            Some(3) => Exit::Failed,
            Some(130) | None => Exit::Interrupted,
            Some(_) => Exit::CouldNotRun,
        })
    }
}
