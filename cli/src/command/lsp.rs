//! `motet lsp`: a language server for editors on stdin and stdout.

use std::path::{Path, PathBuf};
use std::{env, io};

use clap::Args;
use motet_lsp::{ServerEnd, serve};

use crate::error::{CliError, Exit};
use crate::flags::SessionArgs;

/// Flags of `motet lsp`.
#[derive(Args, Debug)]
#[command(
    after_help = "An editor starts it, and speaks the Language Server Protocol on stdin and stdout. The\n\
    nearest `motet.toml` of each document says what it is checked against; a flag goes before it.\n\
    Exit codes: 0 the editor ended it, 1 the editor left without a word, 2 could not run."
)]
pub(crate) struct LspArgs {
    #[command(flatten)]
    session: SessionArgs,
    /// Speak on stdin and stdout, the only way there is; editors pass it by custom
    #[arg(long)]
    stdio: bool,
}

/// Runs the command.
pub(crate) fn run(args: &LspArgs) -> Result<Exit, CliError> {
    let session = args.session.clone();
    let open = move |folder: &Path| {
        session.project_in(folder).map_err(|error| match error.help() {
            Some(help) => format!("{error}; {help}"),
            None => error.to_string(),
        })
    };
    let served = serve(io::BufReader::new(io::stdin()), io::stdout(), Box::new(open), cache());
    match served {
        Ok(ServerEnd::Ordered) => Ok(Exit::Success),
        Ok(ServerEnd::Abrupt) => Ok(Exit::Findings),
        Err(error) => Err(CliError::Message(error.to_string())),
    }
}

/// Folder in the cache of the user, or else in that for temporary files.
fn cache() -> PathBuf {
    let variable = |name: &str| env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    let cache = variable("XDG_CACHE_HOME")
        .or_else(|| variable("LOCALAPPDATA"))
        .or_else(|| variable("HOME").map(|home| home.join(".cache")))
        .unwrap_or_else(env::temp_dir);
    cache.join("motet").join(env!("CARGO_PKG_VERSION"))
}
