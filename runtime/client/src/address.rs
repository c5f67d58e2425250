//! Address of a server for chat requests.

use std::fmt;

use motet_decode::export::Dialect;
use reqwest::Url;

/// The address of chat requests.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ServerUrl(Url);

impl ServerUrl {
    /// The address of chat requests, from that of a server: the path is that of the dialect where none is
    /// given.
    ///
    /// # Errors
    ///
    /// Why it is no address, in a clause.
    pub fn new(server: &str, dialect: Option<Dialect>) -> Result<Self, String> {
        let mut url = Url::parse(server).map_err(|error| format!("`{server}` is no address: {error}"))?;
        if !matches!(url.scheme(), "http" | "https") {
            return Err(format!("`{server}` is no address of a server: it begins with http:// or https://"));
        }
        if !url.username().is_empty() || url.password().is_some() {
            return Err(
                "an address with a name or a password in it would be shown: give a key with --key-from"
                    .to_owned(),
            );
        }
        let base = url.path().trim_end_matches('/').to_owned();
        if !base.ends_with("/chat/completions") && !base.ends_with("/api/chat") {
            let path = match dialect {
                Some(Dialect::Ollama) => format!("{base}/api/chat"),
                Some(Dialect::Vllm | Dialect::LlamaCpp | Dialect::Sglang | Dialect::OpenAi) | None => {
                    format!("{}/v1/chat/completions", base.strip_suffix("/v1").unwrap_or(&base))
                }
            };
            url.set_path(&path);
        }
        Ok(Self(url))
    }

    /// True if it is this machine.
    #[must_use]
    pub fn is_loopback(&self) -> bool {
        matches!(self.0.host_str(), Some("localhost" | "127.0.0.1" | "[::1]"))
    }

    pub(crate) fn url(&self) -> Url {
        self.0.clone()
    }
}

impl fmt::Display for ServerUrl {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}
