//! What a client is told once.

use std::time::Duration;

use motet_decode::export::Dialect;

use crate::address::ServerUrl;
use crate::image::EncodedImage;
use crate::key::ApiKey;

/// Which server and model, and how long and how much.
#[derive(Clone, Debug)]
pub struct ClientSettings {
    /// Where requests go.
    pub address: ServerUrl,
    /// The name of the model.
    pub model: String,
    /// How the server takes a grammar; none where it is not told of any.
    pub dialect: Option<Dialect>,
    /// In which notation it takes it.
    pub notation: Notation,
    /// The server's key.
    pub key: Option<ApiKey>,
    /// What the model sees of the room, with the first message that is not the system's.
    pub images: Vec<EncodedImage>,
    /// The longest to wait for a connection.
    pub connect_timeout: Duration,
    /// The longest between two pieces of a reply, and for the first.
    pub idle_timeout: Duration,
    /// The longest for a whole reply, with all retries.
    pub timeout: Duration,
    /// How often a request is sent again where the server cannot be reached, is busy (429) or fails (5xx).
    pub retries: u32,
    /// What is waited before the first retry where the server does not say; twice as long before each further one, and
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
