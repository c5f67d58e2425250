//! Settings of a client.

use std::time::Duration;

use motet_decode::export::Dialect;

use crate::address::ServerUrl;
use crate::image::EncodedImage;
use crate::key::ApiKey;

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
