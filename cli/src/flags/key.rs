//! Flags for the key of a model server, which is read from the environment or a file and never shown.

use std::path::PathBuf;

use clap::Args;
use motet_client::{ApiKey, ServerUrl};
use motet_project::files::read_small;

use crate::error::CliError;

/// Key of a model server.
#[derive(Args, Debug)]
pub(crate) struct KeyArgs {
    /// Environment variable that holds the server's API key
    #[arg(long, value_name = "VARIABLE")]
    key_from: Option<String>,
    /// File that holds the server's API key and nothing else
    #[arg(long, value_name = "FILE", conflicts_with = "key_from")]
    key_file: Option<PathBuf>,
    /// Send the key to another machine also without encryption
    #[arg(long)]
    key_in_clear: bool,
}

impl KeyArgs {
    pub(crate) fn is_given(&self) -> bool {
        self.key_from.is_some() || self.key_file.is_some()
    }

    /// Key for a server; `None` if none is given.
    pub(crate) fn key(&self, server: &ServerUrl) -> Result<Option<ApiKey>, CliError> {
        if let Some(variable) = &self.key_from {
            check_name(variable, "--key-from")?;
        }
        if self.is_given() && !self.may_go_to(server) {
            return Err(CliError::Advised {
                problem: format!("the key would go to `{server}` without encryption"),
                help: "give an address that begins with https://, or `--key-in-clear` in a network that you \
                       trust"
                    .to_owned(),
            });
        }
        if let Some(variable) = &self.key_from {
            return from_variable(variable).map(Some);
        }
        let Some(path) = &self.key_file else { return Ok(None) };
        let bytes = read_small(path)?;
        let key = ApiKey::new(&String::from_utf8_lossy(&bytes));
        key.map(Some).ok_or_else(|| CliError::Message(format!("the file `{}` holds no key", path.display())))
    }

    /// Is `true` if a key may go to a server: nobody on the way can read it, or the flags permit that.
    pub(crate) fn may_go_to(&self, server: &ServerUrl) -> bool {
        self.key_in_clear || !server.is_in_clear()
    }
}

/// Refuses a text that cannot be the name of a variable: it may be the key itself, which is not shown.
fn check_name(variable: &str, flag: &str) -> Result<(), CliError> {
    if variable.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '_') {
        return Ok(());
    }
    Err(CliError::Advised {
        problem: format!("the value of `{flag}` is no name of an environment variable"),
        help: format!("put the key into a variable and name that: {flag} API_KEY"),
    })
}

/// Token in an environment variable.
pub(crate) fn token_from(variable: &str) -> Result<ApiKey, CliError> {
    check_name(variable, "--token-from")?;
    from_variable(variable)
}

fn from_variable(variable: &str) -> Result<ApiKey, CliError> {
    ApiKey::from_variable(variable)
        .ok_or_else(|| CliError::Message(format!("the environment variable `{variable}` holds no key")))
}
