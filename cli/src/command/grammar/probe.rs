//! `motet grammar probe`: whether a server holds a model to a grammar, or only seems to.

use std::time::Duration;

use motet_decode::export::{Dialect, probe_body};
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
    let url = address(&args.url, dialect);
    let (body, demanded) = probe_body(dialect, &args.model);
    let answer = ask(args, &url, &body)?;
    let said = content(&answer)
        .ok_or_else(|| Trouble::Other(format!("`{url}` did not answer with a chat message")))?;
    let is_held = serde_json::from_str::<Value>(said.trim()).is_ok_and(|answer| answer == demanded);
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

/// The address of chat requests, from that of a server.
fn address(url: &str, dialect: Dialect) -> String {
    let base = url.trim_end_matches('/');
    if base.ends_with("/chat/completions") || base.ends_with("/api/chat") {
        return base.to_owned();
    }
    match dialect {
        Dialect::Ollama => format!("{base}/api/chat"),
        Dialect::Vllm | Dialect::LlamaCpp | Dialect::Sglang | Dialect::OpenAi => {
            format!("{}/v1/chat/completions", base.strip_suffix("/v1").unwrap_or(base))
        }
    }
}

fn ask(args: &ProbeArgs, url: &str, body: &Value) -> Result<Value, Trouble> {
    let trouble = |why: String| Trouble::Other(format!("cannot ask `{url}`: {why}"));
    let config = ureq::Agent::config_builder()
        .timeout_global(Some(Duration::from_secs(args.timeout)))
        .http_status_as_error(false)
        .build();
    let mut request = ureq::Agent::new_with_config(config).post(url);
    if let Some(variable) = &args.key_from {
        let key =
            std::env::var(variable).map_err(|_| trouble(format!("there is no variable `{variable}`")))?;
        request = request.header("Authorization", format!("Bearer {key}"));
    }
    let mut response = request.send_json(body).map_err(|error| trouble(error.to_string()))?;
    let status = response.status();
    let text = response.body_mut().read_to_string().map_err(|error| trouble(error.to_string()))?;
    if !status.is_success() {
        let shown: String = text.trim().chars().take(4 * SHOWN_CHARS).collect();
        return Err(trouble(format!("it answers {status}: {shown}")));
    }
    serde_json::from_str(&text).map_err(|error| trouble(format!("its answer is no JSON: {error}")))
}

/// The text of a chat answer: of an OpenAI-like server, or of Ollama.
fn content(answer: &Value) -> Option<&str> {
    answer
        .pointer("/choices/0/message/content")
        .or_else(|| answer.pointer("/message/content"))
        .and_then(Value::as_str)
}
