#![doc = include_str!("../README.md")]

mod body;
pub mod dialect;
mod image;
mod reply_reader;
mod settings;
mod stream;
mod talk;

pub use image::{EncodedImage, ImageError, MAX_IMAGE_BYTES};
pub use reply_reader::content;
pub use settings::{ApiKey, ClientSettings, ProxyUrl, ServerUrl};

use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::Duration;

use motet_decode::Grammar;
use motet_planner::model::{Message, Model, ModelError, Reply, ReplyEvent};
use motet_planner::vision::Pointer;
use motet_runtime::CameraImage as Picture;
use reqwest::header::{HeaderMap, HeaderName, HeaderValue};
use reqwest::redirect;
use serde_json::{Map, Value};
use tokio::runtime::Runtime;
use tokio::task::AbortHandle;

/// A connection to one server. Dropping it ends what it does.
#[derive(Debug)]
pub struct Client {
    http: reqwest::Client,
    settings: Arc<ClientSettings>,
    runtime: Option<Runtime>,
    /// The latest offer, and what holds a reply to it: a room offers the same for many requests.
    held: Option<(Grammar, Option<Map<String, Value>>)>,
}

impl Client {
    /// Prepares requests to a server; nothing is sent yet.
    ///
    /// # Errors
    ///
    /// The key cannot stand in a header, or the system gives no thread or no certificates.
    pub fn new(settings: ClientSettings) -> Result<Self, ModelError> {
        let wrong = |why: String| ModelError::Unreachable { why };
        // The first to set it wins, and all set the same.
        let _ = rustls::crypto::ring::default_provider().install_default();
        let protocol = dialect::protocol(settings.dialect);
        let fixed = protocol.headers.iter();
        let fixed =
            fixed.map(|(name, value)| (HeaderName::from_static(name), HeaderValue::from_static(value)));
        let mut headers: HeaderMap = fixed.collect();
        if let Some(key) = &settings.key {
            let (name, prefix) = protocol.key_header;
            let mut value = HeaderValue::try_from(key.header(prefix))
                .map_err(|_| wrong("the key has characters that no header takes".to_owned()))?;
            value.set_sensitive(true);
            headers.insert(HeaderName::from_static(name), value);
        }
        let wrong_builder = |error| wrong(stream::reason(error));
        let mut builder = reqwest::Client::builder()
            .default_headers(headers)
            .connect_timeout(settings.connect_timeout)
            // A key is not carried to where a server points.
            .redirect(redirect::Policy::none())
            // The one that people are told of, and no other.
            .no_proxy();
        if let Some(proxy) = settings.address.proxy() {
            builder = builder.proxy(proxy.proxy().map_err(wrong_builder)?);
        }
        let http = builder.build().map_err(wrong_builder)?;
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(1)
            .thread_name("motet-client")
            .enable_all()
            .build()
            .map_err(|error| wrong(error.to_string()))?;
        Ok(Self { http, settings: Arc::new(settings), runtime: Some(runtime), held: None })
    }

    /// Sends a body as it is, with the retries and times of the settings, and gives the whole answer. Blocks.
    ///
    /// # Errors
    ///
    /// Why there is none.
    pub fn once(&self, body: &Value) -> Result<Value, ModelError> {
        let Some(runtime) = &self.runtime else { return Err(ModelError::Cancelled) };
        runtime.block_on(talk::once(&self.http, &self.settings, body.to_string()))
    }

    fn send(&self, body: &Value) -> Incoming {
        let (sender, news) = mpsc::channel();
        let (http, settings, text) = (self.http.clone(), Arc::clone(&self.settings), body.to_string());
        let task = self.runtime.as_ref().map(|runtime| {
            runtime.spawn(async move { talk::talk(&http, &settings, text, &sender).await }).abort_handle()
        });
        Incoming { news, task }
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        // A name that is being looked up would otherwise be waited for.
        if let Some(runtime) = self.runtime.take() {
            runtime.shutdown_background();
        }
    }
}

impl Model for Client {
    fn ask(&mut self, chat: &[Message], constraint: &Grammar) -> Result<Box<dyn Reply>, ModelError> {
        if self.held.as_ref().is_none_or(|(offer, _)| offer != constraint) {
            self.held = Some((constraint.clone(), body::constraint(&self.settings, constraint)?));
        }
        let held = self.held.as_ref().and_then(|(_, held)| held.as_ref());
        let body = body::chat(&self.settings, chat, held)?;
        Ok(Box::new(self.send(&body)))
    }

    fn name(&self) -> String {
        format!("{} at {}", self.settings.model, self.settings.address)
    }
}

/// Asks with the picture, and gives the answer as it was written.
impl Pointer for Client {
    fn ask(&mut self, image: &Picture, question: &str) -> Result<String, String> {
        let answer = body::question(&self.settings, image, question).and_then(|body| self.once(&body));
        let answer = answer.map_err(|why| why.to_string())?;
        content(self.settings.dialect, &answer).ok_or_else(|| "its answer is no reply to a chat".to_owned())
    }
}

/// A reply on its way. Dropping it hangs up.
struct Incoming {
    news: Receiver<ReplyEvent>,
    task: Option<AbortHandle>,
}

impl Reply for Incoming {
    fn next(&mut self, wait: Duration) -> ReplyEvent {
        match self.news.recv_timeout(wait) {
            Ok(news) => news,
            Err(RecvTimeoutError::Timeout) => ReplyEvent::Nothing,
            // The task has told how it ended before it went, unless it was ended from outside.
            Err(RecvTimeoutError::Disconnected) => ReplyEvent::Failed(ModelError::Cancelled),
        }
    }
}

impl Drop for Incoming {
    fn drop(&mut self) {
        if let Some(task) = &self.task {
            task.abort();
        }
    }
}
