//! Server of a page: its files, its items as server-sent events, and the commands of its operator.
//!
//! The id of an event is the number of the run and of its journal's entry. A page that connects again sends
//! the last one that it got, and gets what follows.

use std::convert::Infallible;
use std::net::SocketAddr;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use axum::extract::{DefaultBodyLimit, Query, Request, State};
use axum::http::header::{CACHE_CONTROL, CONTENT_SECURITY_POLICY, CONTENT_TYPE, HeaderName};
use axum::http::{HeaderMap, HeaderValue, StatusCode};
use axum::middleware::{self, Next};
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use axum::{Json, Router};
use futures_util::stream::{self, Stream};
use motet::workbench::Workbench;
use motet_runtime::{CameraImage, RunControl};
use serde::Deserialize;
use tokio::sync::{OwnedSemaphorePermit, Semaphore, watch};

use super::access::{Refusal, Token, check_headers};
use super::file;
use super::hub::{Hub, Item, NotTaken};
use crate::error::CliError;

/// Most pages that are served at a time.
const MOST_PAGES: usize = 32;
/// Most bytes of a command.
const MOST_BYTES: usize = 16 * 1024;
/// Most bytes of a question to the workbench: a policy with what JSON adds.
const MOST_QUESTION_BYTES: usize = 3 * 1024 * 1024;
/// The most bytes of a policy that is to take over, and the time for its check and the swap.
const MOST_POLICY_BYTES: usize = 1024 * 1024;
const SWAPS: Duration = Duration::from_secs(30);
/// Time for the answer to arrive, at whose end a policy takes over no more.
const ANSWERS: Duration = Duration::from_millis(500);
/// Most letters of a line.
const MOST_LETTERS: usize = 2_000;
/// Items that go out together.
const BATCH: usize = 256;
/// Header of a command with the token.
const TOKEN: &str = "x-motet-token";
/// Time after which a page connects again.
const RETRY: Duration = Duration::from_millis(400);
/// Time in which pages get the last items of a run that is over.
const FAREWELL: Duration = Duration::from_secs(2);
/// The page loads nothing from elsewhere, runs no script in its text, and is shown in no frame.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; \
                      connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Part of the server that its handlers share.
#[derive(Debug)]
struct Shared {
    hub: Arc<Hub>,
    /// Workbench of the page, if it has one. It answers one question after the other.
    bench: Option<Mutex<Workbench>>,
    token: Token,
    pages: Arc<Semaphore>,
    /// Number of pages that have not got the end of the run, connected or about to connect again.
    awaited: AtomicUsize,
    is_over: AtomicBool,
    over: watch::Sender<bool>,
}

/// Running server. Dropped, it stays until the process ends.
#[derive(Debug)]
pub(crate) struct Server {
    shared: Arc<Shared>,
    address: SocketAddr,
    thread: JoinHandle<()>,
}

impl Server {
    /// Listens at an address, and serves pages on a thread of its own.
    pub(crate) fn start(
        address: SocketAddr,
        hub: Arc<Hub>,
        bench: Option<Workbench>,
    ) -> Result<Self, CliError> {
        let cannot = |error: &dyn std::fmt::Display| {
            CliError::Message(format!("cannot serve the page at {address}: {error}"))
        };
        let token = Token::new().map_err(|error| cannot(&error))?;
        let listener = std::net::TcpListener::bind(address).map_err(|error| cannot(&error))?;
        listener.set_nonblocking(true).map_err(|error| cannot(&error))?;
        let bound = listener.local_addr().map_err(|error| cannot(&error))?;
        let (over, _) = watch::channel(false);
        let shared = Arc::new(Shared {
            hub,
            bench: bench.map(Mutex::new),
            token,
            pages: Arc::new(Semaphore::new(MOST_PAGES)),
            awaited: AtomicUsize::new(0),
            is_over: AtomicBool::new(false),
            over,
        });
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
        let runtime = runtime.map_err(|error| cannot(&error))?;
        let router = router(Arc::clone(&shared));
        let mut ends = shared.over.subscribe();
        let thread = std::thread::spawn(move || {
            runtime.block_on(async {
                let Ok(listener) = tokio::net::TcpListener::from_std(listener) else { return };
                let served = axum::serve(listener, router).into_future();
                tokio::select! {
                    _ = served => {}
                    _ = ends.wait_for(|is_over| *is_over) => {}
                }
            });
        });
        Ok(Self { shared, address: bound, thread })
    }

    /// Address of the page, with its token.
    pub(crate) fn url(&self) -> String {
        format!("http://{}/#{}", self.address, self.shared.token.as_str())
    }

    /// Lets the connected pages get the last items, and ends the server.
    pub(crate) fn finish(self) {
        self.shared.is_over.store(true, Ordering::SeqCst);
        // Wakes the pages that wait for an item.
        self.shared.hub.push("over", &serde_json::json!({"t": "over"}));
        let slice = Duration::from_millis(20);
        let mut left = FAREWELL;
        while self.shared.awaited.load(Ordering::SeqCst) > 0 && !left.is_zero() {
            std::thread::sleep(slice);
            left = left.saturating_sub(slice);
        }
        self.shared.over.send_replace(true);
        // A thread that panicked has nothing more to serve.
        let _ = self.thread.join();
    }
}

fn router(shared: Arc<Shared>) -> Router {
    Router::new()
        .route("/", get(|| async { page("text/html; charset=utf-8", file::HTML) }))
        .route("/view.js", get(|| async { page("text/javascript; charset=utf-8", file::SCRIPT) }))
        .route("/view.css", get(|| async { page("text/css; charset=utf-8", file::STYLE) }))
        .route("/licenses.txt", get(|| async { page("text/plain; charset=utf-8", file::LICENSES) }))
        .route("/events", get(events))
        .route("/picture", get(picture))
        .route("/say", post(say))
        .route("/answer", post(answer))
        .route("/ask", post(ask).layer(DefaultBodyLimit::max(MOST_QUESTION_BYTES)))
        .route("/swap", post(swap).layer(DefaultBodyLimit::max(MOST_POLICY_BYTES)))
        .route("/stop", post(async |shared, headers| control(shared, &headers, RunControl::Stop)))
        .route("/hold", post(async |shared, headers| control(shared, &headers, RunControl::Hold)))
        .route("/proceed", post(async |shared, headers| control(shared, &headers, RunControl::Proceed)))
        .layer(DefaultBodyLimit::max(MOST_BYTES))
        .layer(middleware::from_fn(guard))
        .with_state(shared)
}

/// Checks the headers of every request, and sets those of every reply.
async fn guard(request: Request, next: Next) -> Response {
    let mut reply = match check_headers(request.headers()) {
        Ok(()) => next.run(request).await,
        Err(refusal) => refused(refusal),
    };
    let headers = reply.headers_mut();
    headers.insert(CONTENT_SECURITY_POLICY, HeaderValue::from_static(POLICY));
    for (name, value) in [
        (HeaderName::from_static("x-content-type-options"), "nosniff"),
        (HeaderName::from_static("referrer-policy"), "no-referrer"),
        (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
        (CACHE_CONTROL, "no-store"),
    ] {
        headers.insert(name, HeaderValue::from_static(value));
    }
    reply
}

fn page(kind: &'static str, text: &'static str) -> Response {
    ([(CONTENT_TYPE, kind)], text).into_response()
}

fn refused(refusal: Refusal) -> Response {
    (StatusCode::FORBIDDEN, refusal.says()).into_response()
}

/// Query of the stream of events: a browser sends no header of ours with it.
#[derive(Debug, Deserialize)]
struct Access {
    #[serde(default)]
    token: String,
    /// Id of the last item that the page has.
    #[serde(default)]
    after: String,
}

async fn events(
    State(shared): State<Arc<Shared>>,
    headers: HeaderMap,
    Query(access): Query<Access>,
) -> Response {
    if !shared.token.is(&access.token) {
        return refused(Refusal::Token);
    }
    let Ok(permit) = Arc::clone(&shared.pages).try_acquire_owned() else {
        return (StatusCode::SERVICE_UNAVAILABLE, "too many pages are open").into_response();
    };
    let last = headers.get("last-event-id").and_then(|id| id.to_str().ok()).unwrap_or(&access.after);
    let position = shared.hub.after(last);
    if position == 0 {
        shared.awaited.fetch_add(1, Ordering::SeqCst);
    }
    let news = shared.hub.news();
    let batch = Vec::new().into_iter();
    let cursor = Cursor { shared, news, position, batch, retry: Some(RETRY), _permit: permit };
    let keep = KeepAlive::new().interval(Duration::from_secs(10));
    Sse::new(items(cursor)).keep_alive(keep).into_response()
}

/// Latest picture of the robot's camera; nothing if there is none yet.
async fn picture(State(shared): State<Arc<Shared>>, Query(access): Query<Access>) -> Response {
    if !shared.token.is(&access.token) {
        return refused(Refusal::Token);
    }
    let image = shared.hub.sight.want();
    let kind = |image: &CameraImage| {
        ["image/png", "image/jpeg"].into_iter().find(|known| *known == image.media_type)
    };
    match image.and_then(|image| Some((kind(&image)?, image))) {
        Some((kind, image)) => ([(CONTENT_TYPE, kind)], image.bytes).into_response(),
        None => StatusCode::NO_CONTENT.into_response(),
    }
}

/// Place of a page in the items.
struct Cursor {
    shared: Arc<Shared>,
    news: watch::Receiver<usize>,
    position: usize,
    batch: std::vec::IntoIter<Item>,
    /// Time after which the page connects again, to be sent once.
    retry: Option<Duration>,
    _permit: OwnedSemaphorePermit,
}

/// Items from the place of a page on, as they come; the end once the run is over.
fn items(cursor: Cursor) -> impl Stream<Item = Result<Event, Infallible>> {
    stream::unfold(cursor, |mut cursor| async {
        loop {
            if let Some(item) = cursor.batch.next() {
                let event = Event::default().data(&item.json);
                let event = match &item.id {
                    Some(id) => event.id(id),
                    None => event,
                };
                let event = match cursor.retry.take() {
                    Some(retry) => event.retry(retry),
                    None => event,
                };
                return Some((Ok(event), cursor));
            }
            let _ = *cursor.news.borrow_and_update();
            let batch = cursor.shared.hub.from(cursor.position, BATCH);
            if batch.is_empty() {
                if cursor.shared.is_over.load(Ordering::SeqCst) {
                    let less = |awaited: usize| Some(awaited.saturating_sub(1));
                    let _ = cursor.shared.awaited.fetch_update(Ordering::SeqCst, Ordering::SeqCst, less);
                    return None;
                }
                if cursor.news.changed().await.is_err() {
                    return None;
                }
                continue;
            }
            cursor.position += batch.len();
            cursor.batch = batch.into_iter();
        }
    })
}

/// Line for the run.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Line {
    text: String,
    /// Question that it answers.
    #[serde(default)]
    question: String,
}

impl Line {
    /// One line of text; `None` if nothing is in it, or too much.
    fn checked(&self) -> Option<String> {
        let text: String = self.text.chars().map(|one| if one.is_control() { ' ' } else { one }).collect();
        let text = text.trim();
        (!text.is_empty() && text.chars().count() <= MOST_LETTERS).then(|| text.to_owned())
    }
}

fn allowed(shared: &Shared, headers: &HeaderMap) -> bool {
    let given = headers.get(TOKEN).and_then(|token| token.to_str().ok());
    given.is_some_and(|given| shared.token.is(given))
}

async fn say(State(shared): State<Arc<Shared>>, headers: HeaderMap, Json(line): Json<Line>) -> Response {
    take(&shared, &headers, &line, |hub, text| hub.say(text))
}

async fn answer(State(shared): State<Arc<Shared>>, headers: HeaderMap, Json(line): Json<Line>) -> Response {
    take(&shared, &headers, &line, |hub, text| hub.answer(&line.question, text))
}

/// Answers a question to the workbench, on a thread that may take its time.
async fn ask(State(shared): State<Arc<Shared>>, headers: HeaderMap, question: String) -> Response {
    if !allowed(&shared, &headers) {
        return refused(Refusal::Token);
    }
    if shared.bench.is_none() {
        return (StatusCode::CONFLICT, "this page has no workbench").into_response();
    }
    let answered = tokio::task::spawn_blocking(move || {
        let bench = shared.bench.as_ref()?;
        Some(bench.lock().unwrap_or_else(PoisonError::into_inner).answer(&question))
    });
    match answered.await {
        Ok(Some(answer)) => ([(CONTENT_TYPE, "application/json")], answer).into_response(),
        Ok(None) | Err(_) => {
            (StatusCode::INTERNAL_SERVER_ERROR, "the question has no answer").into_response()
        }
    }
}

/// Offers a policy that is to take over, and waits for what becomes of it.
async fn swap(State(shared): State<Arc<Shared>>, headers: HeaderMap, policy: String) -> Response {
    if !allowed(&shared, &headers) {
        return refused(Refusal::Token);
    }
    let Ok(result) = shared.hub.offer(policy, Instant::now() + SWAPS - ANSWERS) else {
        return (StatusCode::CONFLICT, "this run takes no other policy").into_response();
    };
    let answered = tokio::task::spawn_blocking(move || result.recv_timeout(SWAPS)).await;
    match answered {
        Ok(Ok(Ok(swapped))) => Json(swapped).into_response(),
        Ok(Ok(Err(refusal))) => (StatusCode::UNPROCESSABLE_ENTITY, Json(refusal)).into_response(),
        Ok(Err(_)) | Err(_) => {
            (StatusCode::CONFLICT, "the run is over, or the check takes too long").into_response()
        }
    }
}

fn take(
    shared: &Shared,
    headers: &HeaderMap,
    line: &Line,
    give: impl FnOnce(&Hub, String) -> Result<(), NotTaken>,
) -> Response {
    if !allowed(shared, headers) {
        return refused(Refusal::Token);
    }
    let Some(text) = line.checked() else {
        let why = format!("a line has 1 to {MOST_LETTERS} letters");
        return (StatusCode::UNPROCESSABLE_ENTITY, why).into_response();
    };
    match give(&shared.hub, text) {
        Ok(()) => StatusCode::NO_CONTENT.into_response(),
        Err(NotTaken::Nobody) => (StatusCode::CONFLICT, "this run takes no lines").into_response(),
        Err(NotTaken::Answered) => (StatusCode::CONFLICT, "this question waits no longer").into_response(),
    }
}

fn control(State(shared): State<Arc<Shared>>, headers: &HeaderMap, wish: RunControl) -> Response {
    if !allowed(&shared, headers) {
        return refused(Refusal::Token);
    }
    shared.hub.control(wish);
    StatusCode::NO_CONTENT.into_response()
}

#[cfg(test)]
mod tests {
    use std::io::{BufRead as _, BufReader, Read as _, Write as _};
    use std::net::TcpStream;
    use std::sync::Arc;
    use std::sync::mpsc::channel;

    use serde_json::json;

    use super::{Hub, MOST_BYTES, MOST_LETTERS, MOST_PAGES, Server};

    struct Served {
        server: Server,
        hub: Arc<Hub>,
    }

    fn served() -> Served {
        let hub = Arc::new(Hub::default());
        let server = Server::start("127.0.0.1:0".parse().unwrap(), Arc::clone(&hub), None).unwrap();
        Served { server, hub }
    }

    impl Served {
        fn token(&self) -> &str {
            self.server.shared.token.as_str()
        }

        /// Sends a request with more headers and a body, and leaves the connection open.
        fn ask(&self, line: &str, more: &str, body: &str) -> BufReader<TcpStream> {
            let mut stream = TcpStream::connect(self.server.address).unwrap();
            let (address, length) = (self.server.address, body.len());
            write!(
                stream,
                "{line} HTTP/1.1\r\nhost: {address}\r\n{more}content-length: {length}\r\n\r\n{body}"
            )
            .unwrap();
            BufReader::new(stream)
        }

        fn status(&self, line: &str, more: &str, body: &str) -> u16 {
            status(&mut self.ask(line, more, body))
        }

        /// Status of a command with the token.
        fn command(&self, line: &str, body: &str) -> u16 {
            let more = format!("x-motet-token: {}\r\ncontent-type: application/json\r\n", self.token());
            self.status(line, &more, body)
        }
    }

    fn status(reply: &mut BufReader<TcpStream>) -> u16 {
        let mut line = String::new();
        reply.read_line(&mut line).unwrap();
        line.split(' ').nth(1).unwrap().parse().unwrap()
    }

    #[test]
    fn server_takes_commands_with_the_token_only() {
        let served = served();
        let (lines, typed) = channel();
        served.hub.take_lines(lines);
        let json = "content-type: application/json\r\n";
        let wrong = format!("{json}x-motet-token: 0\r\n");
        for command in ["stop", "hold", "proceed", "say", "answer"] {
            let (line, body) = (format!("POST /{command}"), json!({"text": "hello"}).to_string());
            assert_eq!(served.status(&line, json, &body), 403, "{command} without a token");
            assert_eq!(served.status(&line, &wrong, &body), 403, "{command} with a wrong token");
        }
        assert_eq!(served.status("GET /events?token=0", "", ""), 403);
        let elsewhere = format!("{json}x-motet-token: {}\r\norigin: http://evil.example\r\n", served.token());
        assert_eq!(served.status("POST /stop", &elsewhere, ""), 403);
        assert!(!served.hub.is_stopped());
        assert_eq!(served.command("POST /say", r#"{"text": " bring\nme the mug "}"#), 204);
        assert_eq!(typed.try_iter().collect::<Vec<_>>(), ["bring me the mug"]);
        assert_eq!(served.command("POST /stop", ""), 204);
        assert!(served.hub.is_stopped());
        served.server.finish();
    }

    #[test]
    fn server_limits_lines_and_bodies() {
        let served = served();
        let (lines, _typed) = channel();
        served.hub.take_lines(lines);
        let say = |text: &str| served.command("POST /say", &json!({"text": text}).to_string());
        assert_eq!(say(&"x".repeat(MOST_LETTERS)), 204);
        assert_eq!(say(&"x".repeat(MOST_LETTERS + 1)), 422);
        assert_eq!(say(" \u{7} "), 422);
        assert_eq!(say(&"x".repeat(MOST_BYTES)), 413);
        assert_eq!(served.command("POST /say", "{"), 400);
        assert_eq!(served.command("POST /answer", r#"{"question": "1:#1", "text": "yes"}"#), 409);
        assert_eq!(served.command("GET /stop", ""), 405);
        assert_eq!(served.command("GET /../Cargo.toml", ""), 404);
        served.server.finish();
    }

    #[test]
    fn server_gives_a_page_what_follows_its_last_item() {
        let served = served();
        for seq in 0..3 {
            served.hub.push(&format!("1-{seq}"), &json!({"t": "step"}));
        }
        let line = format!("GET /events?token={}", served.token());
        // The page loses its connection, and connects again.
        assert_eq!(status(&mut served.ask(&line, "", "")), 200);
        let mut reply = served.ask(&line, "last-event-id: 1-1\r\n", "");
        assert_eq!(status(&mut reply), 200);
        served.hub.push("1-3", &json!({"t": "step", "text": "two\nlines"}));
        served.server.finish();
        let mut text = String::new();
        // The server may close the connection in the middle of a chunk.
        let _ = reply.read_to_string(&mut text);
        let ids: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("id: ")).collect();
        assert_eq!(ids, ["1-2", "1-3", "over"]);
    }

    #[test]
    fn server_serves_so_many_pages() {
        let served = served();
        served.hub.push("1-0", &json!({"t": "step"}));
        let line = format!("GET /events?token={}", served.token());
        let mut pages: Vec<_> = (0..MOST_PAGES).map(|_| served.ask(&line, "", "")).collect();
        assert!(pages.iter_mut().all(|page| status(page) == 200));
        assert_eq!(served.status(&line, "", ""), 503);
        served.server.finish();
    }
}
