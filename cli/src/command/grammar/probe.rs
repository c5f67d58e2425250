//! `motet grammar probe`: whether a server holds a model to a grammar, or only seems to.

use std::time::Duration;

use motet_client::{ApiKey, Client, ClientSettings, ServerUrl, content};
use motet_decode::export::probe_body;
use serde_json::Value;

use super::dialect;
use crate::args::ProbeArgs;
use crate::exit::{Exit, Trouble};
use crate::out::Out;

/// How much of an answer is shown.
const SHOWN_CHARS: usize = 80;

/// Runs the command.
///
/// # Errors
///
/// The server cannot be reached, refuses the request, or answers with something that is no chat answer.
pub(super) fn run(args: &ProbeArgs) -> Result<Exit, Trouble> {
    let dialect = dialect(args.dialect);
    let url = ServerUrl::new(&args.url, Some(dialect)).map_err(Trouble::Other)?;
    let (body, demanded) = probe_body(dialect, &args.model);
    let answer = ask(args, url.clone(), &body)?;
    let said = content(&answer)
        .ok_or_else(|| Trouble::Other(format!("`{url}` did not answer with a chat message")))?;
    let is_held = serde_json::from_str::<Value>(said.trim()).is_ok_and(|answer| answer == demanded);
    if !is_held && is_cut(said, &demanded) {
        return Err(Trouble::Other(format!(
            "`{url}` broke its answer off at `{}`: whether it holds the model to the grammar cannot be told",
            said.trim()
        )));
    }
    let mut out = Out::default();
    let exit = if is_held {
        out.line(&format!("{url}: the model is held to the grammar"));
        Exit::Clean
    } else {
        let shown: String = said.trim().chars().take(SHOWN_CHARS).collect();
        out.line(&format!(
            "{url}: the grammar is ignored: asked for {demanded} and nothing else, it answered `{shown}`"
        ));
        Exit::Findings
    };
    crate::report::close(&mut out, Ok(exit))
}

/// Whether an answer is the beginning of what the grammar demands, and no more.
fn is_cut(said: &str, demanded: &Value) -> bool {
    let bare = |text: &str| text.chars().filter(|letter| !letter.is_whitespace()).collect::<String>();
    bare(&demanded.to_string()).starts_with(&bare(said))
}

fn ask(args: &ProbeArgs, address: ServerUrl, body: &Value) -> Result<Value, Trouble> {
    let trouble = |why: String| Trouble::Other(format!("cannot ask `{address}`: {why}"));
    let timeout = Duration::from_secs(args.timeout);
    let key = args.key_from.as_deref().map(key).transpose()?;
    let settings = ClientSettings {
        key,
        timeout,
        idle_timeout: timeout,
        ..ClientSettings::new(address.clone(), &args.model)
    };
    let answer = Client::new(settings).and_then(|client| client.once(body));
    answer.map_err(|why| trouble(why.to_string()))
}

/// The key in a variable of the environment.
///
/// # Errors
///
/// There is none.
pub(in crate::command) fn key(variable: &str) -> Result<ApiKey, Trouble> {
    ApiKey::from_variable(variable)
        .ok_or_else(|| Trouble::Other(format!("there is no variable `{variable}` with a key in it")))
}
