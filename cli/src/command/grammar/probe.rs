//! `motet grammar probe`: tests whether a server enforces a grammar.

use std::time::Duration;

use motet_client::{ApiKey, Client, ClientSettings, ServerUrl, content};
use motet_decode::export::probe_body;
use serde_json::Value;

use super::{ProbeArgs, dialect};
use crate::error::{CliError, Exit};
use crate::output::Output;

/// Number of characters of an answer that are shown.
const SHOWN_CHARS: usize = 80;

/// Runs the command.
///
/// # Errors
///
/// The server cannot be reached, refuses the request, or does not answer with a chat message.
pub(super) fn run(args: &ProbeArgs) -> Result<Exit, CliError> {
    let dialect = dialect(args.dialect);
    let url = ServerUrl::new(&args.url, Some(dialect)).map_err(CliError::Message)?;
    let (body, demanded) = probe_body(dialect, &args.model);
    let answer = ask(args, url.clone(), &body)?;
    let said = content(&answer)
        .ok_or_else(|| CliError::Message(format!("`{url}` did not answer with a chat message")))?;
    let is_held = serde_json::from_str::<Value>(said.trim()).is_ok_and(|answer| answer == demanded);
    if !is_held && is_cut(said, &demanded) {
        return Err(CliError::Message(format!(
            "`{url}` cut its answer off at `{}`, so the test is inconclusive",
            said.trim()
        )));
    }
    let mut out = Output::default();
    let exit = if is_held {
        out.line(&format!("{url}: the server enforces the grammar"));
        Exit::Success
    } else {
        let shown: String = said.trim().chars().take(SHOWN_CHARS).collect();
        out.line(&format!(
            "{url}: the server ignores the grammar: restricted to {demanded}, it answered `{shown}`"
        ));
        Exit::Findings
    };
    crate::report::close(&mut out, Ok(exit))
}

/// Is `true` if an answer is a proper prefix of the one that the grammar demands.
fn is_cut(said: &str, demanded: &Value) -> bool {
    let bare = |text: &str| text.chars().filter(|letter| !letter.is_whitespace()).collect::<String>();
    bare(&demanded.to_string()).starts_with(&bare(said))
}

fn ask(args: &ProbeArgs, address: ServerUrl, body: &Value) -> Result<Value, CliError> {
    let failed = |why: String| CliError::Message(format!("cannot ask `{address}`: {why}"));
    let timeout = Duration::from_secs(args.timeout);
    let key = args.key_from.as_deref().map(key).transpose()?;
    let settings = ClientSettings {
        key,
        timeout,
        idle_timeout: timeout,
        ..ClientSettings::new(address.clone(), &args.model)
    };
    let answer = Client::new(settings).and_then(|client| client.once(body));
    answer.map_err(|why| failed(why.to_string()))
}

/// Reads the server's key from an environment variable.
///
/// # Errors
///
/// The variable is not set.
pub(in crate::command) fn key(variable: &str) -> Result<ApiKey, CliError> {
    ApiKey::from_variable(variable)
        .ok_or_else(|| CliError::Message(format!("the environment variable `{variable}` holds no key")))
}
