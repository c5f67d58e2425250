//! Settings of a client: the address of a server, its key, times and sizes.

use std::fmt;
use std::net::IpAddr;
use std::time::Duration;

use hyper_util::client::proxy::matcher::{Intercept, Matcher};
use reqwest::Url;

use crate::dialect::{self, Delivery, Dialect, GrammarCarrier, Protocol};
use crate::image::EncodedImage;

/// Server, model, and limits of time and size.
#[derive(Clone, Debug)]
pub struct ClientSettings {
    pub address: ServerUrl,
    /// The name of the model.
    pub model: String,
    /// Dialect of the server; without one, chats go as to OpenAI, and no grammar is sent.
    pub dialect: Option<Dialect>,
    /// Part of the request that carries the grammar; without one, no grammar is sent.
    pub carrier: Option<GrammarCarrier>,
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

impl ClientSettings {
    /// The defaults for a server and a model.
    #[must_use]
    pub fn new(address: ServerUrl, model: impl Into<String>) -> Self {
        Self {
            address,
            model: model.into(),
            dialect: None,
            carrier: Some(GrammarCarrier::default()),
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

    /// Address of a request: Gemini has the model and the delivery in it.
    pub(crate) fn request_url(&self, delivery: Delivery) -> Url {
        let mut url = self.address.0.clone();
        if self.dialect.map(Dialect::protocol) != Some(Protocol::Gemini) {
            return url;
        }
        let model = self.model.strip_prefix("models/").unwrap_or(&self.model);
        let method = match delivery {
            Delivery::Whole => "generateContent",
            Delivery::Streamed => "streamGenerateContent",
        };
        // The segment is encoded, whatever the name of the model is.
        if let Ok(mut segments) = url.path_segments_mut() {
            segments.push(&format!("{model}:{method}"));
        }
        if delivery == Delivery::Streamed {
            url.set_query(Some("alt=sse"));
        }
        url
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
        let path = dialect::protocol(dialect).path;
        let is_whole =
            |path: &str| base.ends_with(path.trim_start_matches("/v1beta").trim_start_matches("/v1"));
        if !is_whole(path) && !(is_chat(dialect) && (is_whole("/chat/completions") || is_whole("/api/chat")))
        {
            let server = ["/v1beta", "/v1"].iter().find_map(|version| base.strip_suffix(version));
            url.set_path(&format!("{}{path}", server.unwrap_or(&base)));
        }
        Ok(Self(url))
    }

    /// The proxy through which requests go, by the environment (`HTTPS_PROXY`, `HTTP_PROXY`, `ALL_PROXY`,
    /// `NO_PROXY`, also in small letters). None stands before this machine.
    #[must_use]
    pub fn proxy(&self) -> Option<ProxyUrl> {
        let url = self.0.as_str().parse().ok().filter(|_| !self.is_loopback())?;
        Matcher::from_env().intercept(&url).map(ProxyUrl)
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
}

/// True for servers that are asked at the path of chat completions or of Ollama, whichever is given.
fn is_chat(dialect: Option<Dialect>) -> bool {
    matches!(dialect.map(Dialect::protocol), None | Some(Protocol::Chat | Protocol::Ollama))
}

impl fmt::Display for ServerUrl {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// A proxy on the way to a server. Its name and password are not shown.
#[derive(Clone, Debug)]
pub struct ProxyUrl(Intercept);

impl ProxyUrl {
    /// The proxy, for all requests of a client.
    pub(crate) fn proxy(&self) -> reqwest::Result<reqwest::Proxy> {
        let proxy = reqwest::Proxy::all(self.0.uri().to_string())?;
        Ok(match (self.0.basic_auth(), self.0.raw_auth()) {
            (Some(auth), _) => proxy.custom_http_auth(auth.clone()),
            (None, Some((name, password))) => proxy.basic_auth(name, password),
            (None, None) => proxy,
        })
    }
}

impl fmt::Display for ProxyUrl {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let uri = self.0.uri();
        // What stands before an `@` is the password that it was given.
        let host = uri.authority().map_or("", |of| of.as_str().rsplit('@').next().unwrap_or_default());
        write!(f, "{}://{host}", uri.scheme_str().unwrap_or("http"))
    }
}

/// A key, which is never shown.
#[derive(Clone, PartialEq, Eq)]
pub struct ApiKey(String);

impl ApiKey {
    /// The key in a variable of the environment; none where there is no such variable, or nothing in it.
    #[must_use]
    pub fn from_variable(name: &str) -> Option<Self> {
        Self::new(&std::env::var(name).ok()?)
    }

    /// The key in a text, such as the content of a file; none if there is nothing in it but white space.
    #[must_use]
    pub fn new(text: &str) -> Option<Self> {
        let key = text.trim();
        (!key.is_empty()).then(|| Self(key.to_owned()))
    }

    /// Value of a header with the key behind a prefix.
    pub(crate) fn header(&self, prefix: &str) -> String {
        format!("{prefix}{}", self.0)
    }

    /// A text of the server, which may quote what it was sent, without the key, however JSON or Motet spells
    /// it.
    pub(crate) fn cut_from(&self, text: &str) -> String {
        let (mut cut, mut rest) = (String::with_capacity(text.len()), text);
        while let Some(first) = rest.chars().next() {
            match self.spelt_in(rest) {
                KeySpelling::Whole(length) => {
                    cut.push_str("[key]");
                    rest = rest.get(length..).unwrap_or_default();
                }
                KeySpelling::Begun | KeySpelling::Other => {
                    cut.push(first);
                    rest = rest.get(first.len_utf8()..).unwrap_or_default();
                }
            }
        }
        cut
    }

    /// Offset at which a text ends with the beginning of the key; its length if it does not.
    pub(crate) fn begun_at(&self, text: &str) -> usize {
        // Each character may be spelt as `\u{XXXXXX}`.
        let longest = 10 * self.0.len();
        let mut ends = text.char_indices().map(|(at, _)| at).filter(|at| text.len() - at <= longest);
        let begins =
            |at: &usize| matches!(text.get(*at..).map(|end| self.spelt_in(end)), Some(KeySpelling::Begun));
        ends.find(begins).unwrap_or(text.len())
    }

    /// Compares the beginning of a text with the key. Each character stands for itself, or is escaped as in
    /// JSON or as Motet prints it.
    fn spelt_in(&self, text: &str) -> KeySpelling {
        let mut rest = text;
        for wanted in self.0.chars() {
            if rest.is_empty() {
                return KeySpelling::Begun;
            }
            if let Some(after) = rest.strip_prefix(wanted) {
                rest = after;
                continue;
            }
            let Some(escape) = rest.strip_prefix('\\') else { return KeySpelling::Other };
            if let Some(braced) = escape.strip_prefix("u{") {
                let digits = braced.trim_start_matches(|digit: char| digit.is_ascii_hexdigit());
                let code = braced.strip_suffix(digits).and_then(|code| u32::from_str_radix(code, 16).ok());
                match digits.strip_prefix('}') {
                    Some(after) if code == Some(u32::from(wanted)) => rest = after,
                    None if digits.is_empty() && braced.len() <= 6 => return KeySpelling::Begun,
                    Some(_) | None => return KeySpelling::Other,
                }
                continue;
            }
            let digits = escape.strip_prefix('u').map(|digits| digits.get(..4.min(digits.len())));
            let (is_same, length) = match (digits, escape.chars().next()) {
                (_, None) => return KeySpelling::Begun,
                (Some(Some(digits)), _) if digits.len() < 4 => return KeySpelling::Begun,
                (Some(digits), _) => {
                    let code = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok());
                    (code == Some(u32::from(wanted)), 5)
                }
                (None, Some(other)) => (other == wanted, other.len_utf8()),
            };
            match escape.get(length..) {
                Some(after) if is_same => rest = after,
                Some(_) | None => return KeySpelling::Other,
            }
        }
        KeySpelling::Whole(text.len() - rest.len())
    }
}

/// Result of comparing a text with a key.
enum KeySpelling {
    /// The key stands there, in so many bytes.
    Whole(usize),
    /// The text ends within what may be the key.
    Begun,
    Other,
}

impl fmt::Debug for ApiKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Key(…)")
    }
}
