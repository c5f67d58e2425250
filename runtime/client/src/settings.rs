//! Settings of a client: the address of a server, its key, times and sizes.

use std::fmt;
use std::net::IpAddr;
use std::time::Duration;

use motet_decode::export::Dialect;
use reqwest::Url;

use crate::image::EncodedImage;

/// Server, model, and limits of time and size.
#[derive(Clone, Debug)]
pub struct ClientSettings {
    pub address: ServerUrl,
    /// The name of the model.
    pub model: String,
    /// Dialect in which the server takes a grammar; without one, no grammar is sent.
    pub dialect: Option<Dialect>,
    /// In which notation it takes it.
    pub notation: Notation,
    /// The server's key.
    pub key: Option<ApiKey>,
    /// Images of the room, sent with the first message that is not the system's.
    pub images: Vec<EncodedImage>,
    /// The longest to wait for a connection.
    pub connect_timeout: Duration,
    /// The longest between two pieces of a reply, and for the first.
    pub idle_timeout: Duration,
    /// The longest for a whole reply, with all retries.
    pub timeout: Duration,
    /// Number of times a request is sent again where the server cannot be reached, is busy (429) or fails
    /// (5xx).
    pub retries: u32,
    /// Delay before the first retry if the server does not state one; doubled before each further one, and
    /// never longer than [`ClientSettings::longest_back_off`].
    pub back_off: Duration,
    /// The longest wait before a retry, also where the server asks for a longer one.
    pub longest_back_off: Duration,
    /// The most bytes of a reply, with all that surrounds its text.
    pub max_bytes: usize,
}

/// In which notation a server takes a grammar.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Notation {
    /// The one that every server of its kind takes: JSON Schema.
    #[default]
    Usual,
    /// Lark, where llguidance runs the grammars.
    Lark,
}

impl ClientSettings {
    /// The defaults for a server and a model.
    #[must_use]
    pub fn new(address: ServerUrl, model: impl Into<String>) -> Self {
        Self {
            address,
            model: model.into(),
            dialect: None,
            notation: Notation::Usual,
            key: None,
            images: Vec::new(),
            connect_timeout: Duration::from_secs(10),
            idle_timeout: Duration::from_secs(60),
            timeout: Duration::from_secs(120),
            retries: 3,
            back_off: Duration::from_millis(500),
            longest_back_off: Duration::from_secs(20),
            max_bytes: 4 << 20,
        }
    }
}

/// The address of chat requests.
///
/// ```
/// use motet_client::ServerUrl;
///
/// let url = ServerUrl::new("http://localhost:8000/v1", None)?;
/// assert_eq!(url.to_string(), "http://localhost:8000/v1/chat/completions");
/// assert!(url.is_loopback());
/// assert!(ServerUrl::new("ftp://localhost", None).is_err());
/// # Ok::<(), String>(())
/// ```
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
        let Some(host) = self.0.host_str() else { return false };
        let address = host.trim_start_matches('[').trim_end_matches(']').parse::<IpAddr>();
        address.map_or_else(
            |_| host.trim_end_matches('.') == "localhost",
            // The system takes the unspecified address for this machine.
            |address| address.is_loopback() || address.is_unspecified(),
        )
    }

    /// True if whoever is on the way can read what is sent: it goes to another machine without encryption.
    ///
    /// ```
    /// use motet_client::ServerUrl;
    ///
    /// assert!(ServerUrl::new("http://models.example", None)?.is_in_clear());
    /// assert!(!ServerUrl::new("https://models.example", None)?.is_in_clear());
    /// assert!(!ServerUrl::new("http://localhost.:8000", None)?.is_in_clear());
    /// # Ok::<(), String>(())
    /// ```
    #[must_use]
    pub fn is_in_clear(&self) -> bool {
        self.0.scheme() == "http" && !self.is_loopback()
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

/// A key, which is never shown.
#[derive(Clone, PartialEq, Eq)]
pub struct ApiKey(String);

impl ApiKey {
    /// The key in a variable of the environment; none where there is no such variable, or nothing in it.
    #[must_use]
    pub fn from_variable(name: &str) -> Option<Self> {
        let key = std::env::var(name).ok()?;
        let key = key.trim();
        (!key.is_empty()).then(|| Self(key.to_owned()))
    }

    pub(crate) fn bearer(&self) -> String {
        format!("Bearer {}", self.0)
    }

    /// A text of the server, which may quote what it was sent, without the key.
    pub(crate) fn cut_from(&self, text: &str) -> String {
        text.replace(&self.0, "[key]")
    }
}

impl fmt::Debug for ApiKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Key(…)")
    }
}
