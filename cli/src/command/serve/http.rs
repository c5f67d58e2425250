//! HTTP of the endpoint: connections, routes, limits, and replies as they arrive.

use std::convert::Infallible;
use std::io;
use std::net::IpAddr;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use futures_util::stream::unfold;
use http_body_util::combinators::UnsyncBoxBody;
use http_body_util::{BodyExt as _, Full, LengthLimitError, Limited, StreamBody};
use hyper::body::{Body as _, Bytes, Frame, Incoming};
use hyper::header::{AUTHORIZATION, CONTENT_TYPE, HOST, HeaderMap, HeaderValue, RETRY_AFTER};
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper::{Method, Request, Response, StatusCode};
use hyper_util::rt::{TokioIo, TokioTimer};
use motet_client::ApiKey;
use serde_json::Value;
use tokio::sync::{Semaphore, mpsc};
use tokio::task::JoinHandle;
use tokio::time::{sleep, timeout};

use super::answer::{self, ApiError, ErrorKind, Head, Reply};
use super::gateway::{Gateway, Limits};
use super::request::{ChatRequest, Delivery};
use crate::interrupt::{SLICE, is_interrupted};

type Body = UnsyncBoxBody<Bytes, Infallible>;

/// Time for the head of a request, and for its body.
const READ_TIME: Duration = Duration::from_secs(20);
/// Time between two signs of life of a reply that is being planned. A client that has left is noticed by it.
const SIGN_OF_LIFE: Duration = Duration::from_secs(1);
/// Time that running requests have to end after an interrupt.
const END_TIME: Duration = Duration::from_secs(2);
/// Number of connections beside those that are worked on.
const WAITING: usize = 64;

/// Serves until the process is interrupted.
pub(super) fn serve(
    listener: std::net::TcpListener,
    gateway: Arc<Gateway>,
    limits: Limits,
) -> io::Result<()> {
    listener.set_nonblocking(true)?;
    let runtime = tokio::runtime::Builder::new_multi_thread()
        .worker_threads(1)
        .max_blocking_threads(limits.parallel + 1)
        .thread_name("motet-serve")
        .enable_all()
        .build()?;
    let ended = runtime.block_on(accept(listener, gateway, limits));
    runtime.shutdown_timeout(END_TIME);
    ended
}

async fn accept(listener: std::net::TcpListener, gateway: Arc<Gateway>, limits: Limits) -> io::Result<()> {
    let listener = tokio::net::TcpListener::from_std(listener)?;
    let places = Arc::new(Semaphore::new(limits.parallel));
    let connections = Arc::new(Semaphore::new(limits.parallel + WAITING));
    while !is_interrupted() {
        let Ok(accepted) = timeout(SLICE, listener.accept()).await else { continue };
        let Ok((stream, _)) = accepted else {
            // Such as too many open files, which pass.
            sleep(SLICE).await;
            continue;
        };
        // Too many connections are closed at once: one that waits would take a file all the same.
        let Ok(connection) = Arc::clone(&connections).try_acquire_owned() else { continue };
        let (gateway, places) = (Arc::clone(&gateway), Arc::clone(&places));
        tokio::spawn(async move {
            let service = service_fn(move |request| {
                let (gateway, places) = (Arc::clone(&gateway), Arc::clone(&places));
                async move { Ok::<_, Infallible>(respond(gateway, places, request).await) }
            });
            let mut http = http1::Builder::new();
            http.timer(TokioTimer::new()).header_read_timeout(READ_TIME).max_buf_size(64 << 10);
            // A client that hangs up is no mistake of ours.
            let _ = http.serve_connection(TokioIo::new(stream), service).await;
            drop(connection);
        });
    }
    Ok(())
}

async fn respond(
    gateway: Arc<Gateway>,
    places: Arc<Semaphore>,
    request: Request<Incoming>,
) -> Response<Body> {
    route(gateway, places, request).await.unwrap_or_else(|error| {
        let (status, _) = error.kind.status();
        let mut response = json(status, &error.json());
        if error.kind == ErrorKind::TooMany {
            response.headers_mut().insert(RETRY_AFTER, HeaderValue::from_static("1"));
        }
        response
    })
}

async fn route(
    gateway: Arc<Gateway>,
    places: Arc<Semaphore>,
    request: Request<Incoming>,
) -> Result<Response<Body>, ApiError> {
    let (head, body) = request.into_parts();
    let given = bearer(&head.headers);
    if gateway.is_local && !is_named_local(&head.headers) {
        // A page of the web that gives its own name to this machine.
        let why = "this endpoint answers to `localhost` and its addresses only";
        return Err(ApiError::new(ErrorKind::Forbidden, why));
    }
    if let Some(token) = &gateway.token
        && given.as_ref() != Some(token)
    {
        return Err(ApiError::new(ErrorKind::Unauthorized, "the API key is not the token of this endpoint"));
    }
    let path = head.uri.path();
    match (&head.method, path) {
        (&Method::GET, "/v1/models") => Ok(json(200, &answer::models(gateway.model()))),
        (&Method::GET, path) if path.strip_prefix("/v1/models/") == Some(gateway.model()) => {
            Ok(json(200, &answer::model(gateway.model())))
        }
        (&Method::GET, path) if path.starts_with("/v1/models/") => {
            Err(ApiError::new(ErrorKind::NoModel, format!("there is only `{}`", gateway.model())))
        }
        (&Method::POST, "/v1/chat/completions") => {
            let kind = head.headers.get(CONTENT_TYPE).and_then(|kind| kind.to_str().ok()).unwrap_or_default();
            // A page of the web cannot send this without asking, and nobody answers it.
            if !kind.trim().to_ascii_lowercase().starts_with("application/json") {
                return Err(ApiError::new(ErrorKind::NoJson, "the body is `application/json`"));
            }
            // Before the body is read: it may be large.
            let Ok(place) = places.try_acquire_owned() else {
                let why = format!("{} requests are being worked on", gateway.limits.parallel);
                return Err(ApiError::new(ErrorKind::TooMany, why));
            };
            let bytes = read(body, gateway.limits.body).await?;
            let request = ChatRequest::read(&bytes, gateway.model())?;
            let key = given.filter(|_| gateway.token.is_none());
            let leaving = Leaving(Arc::new(AtomicBool::new(false)));
            let (delivery, head) = (request.delivery, Head::new(gateway.model()));
            let is_left = Arc::clone(&leaving.0);
            let job = tokio::task::spawn_blocking(move || {
                let reply = gateway.plan(&request, key, &is_left);
                drop(place);
                reply
            });
            match delivery {
                Delivery::Whole => {
                    let reply = ended(job.await)?;
                    drop(leaving);
                    Ok(json(200, &head.completion(&reply)))
                }
                Delivery::Events | Delivery::EventsWithUsage => Ok(events(job, leaving, head, delivery)),
            }
        }
        (_, "/v1/models" | "/v1/chat/completions") => {
            Err(ApiError::new(ErrorKind::BadMethod, format!("`{path}` does not take {}", head.method)))
        }
        _ => Err(ApiError::new(ErrorKind::NotFound, "there are `/v1/chat/completions` and `/v1/models`")),
    }
}

/// Sets its flag when it is dropped: the client has left, or has its reply.
struct Leaving(Arc<AtomicBool>);

impl Drop for Leaving {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

type Job = JoinHandle<Result<Reply, ApiError>>;

/// Result of a job; one that was ended from outside, or broke, is an error.
fn ended(job: Result<Result<Reply, ApiError>, tokio::task::JoinError>) -> Result<Reply, ApiError> {
    job.unwrap_or_else(|_| Err(ApiError::new(ErrorKind::Ending, "the request was not worked on to its end")))
}

/// Reply as server-sent events: signs of life while it is planned, then all of it.
fn events(mut job: Job, leaving: Leaving, head: Head, delivery: Delivery) -> Response<Body> {
    let (sender, receiver) = mpsc::channel::<String>(4);
    tokio::spawn(async move {
        // The client has left once nothing can be sent.
        let leaving = leaving;
        if sender.send(event(&head.first())).await.is_err() {
            return;
        }
        let reply = loop {
            match timeout(SIGN_OF_LIFE, &mut job).await {
                Ok(reply) => break ended(reply),
                Err(_) if sender.send(": planning\n\n".to_owned()).await.is_err() => return,
                Err(_) => {}
            }
        };
        let mut all: Vec<Value> = Vec::new();
        match &reply {
            Ok(reply) => {
                all.extend(head.chunks(reply));
                all.extend((delivery == Delivery::EventsWithUsage).then(|| head.counted(reply)));
            }
            Err(error) => all.push(error.json()),
        }
        for value in &all {
            if sender.send(event(value)).await.is_err() {
                return;
            }
        }
        let _ = sender.send("data: [DONE]\n\n".to_owned()).await;
        drop(leaving);
    });
    let frames = unfold(receiver, |mut receiver| async move {
        let text = receiver.recv().await?;
        Some((Ok(Frame::data(Bytes::from(text))), receiver))
    });
    let mut response = Response::new(StreamBody::new(frames).boxed_unsync());
    response.headers_mut().insert(CONTENT_TYPE, HeaderValue::from_static("text/event-stream"));
    response
}

fn event(value: &Value) -> String {
    format!("data: {value}\n\n")
}

/// Reads a body.
async fn read(body: Incoming, most: usize) -> Result<Bytes, ApiError> {
    let too_large = || ApiError::new(ErrorKind::TooLarge, format!("the body has more than {most} bytes"));
    // One that says so is not read at all.
    if body.size_hint().lower() > u64::try_from(most).unwrap_or(u64::MAX) {
        return Err(too_large());
    }
    let read = timeout(READ_TIME, Limited::new(body, most).collect()).await;
    match read {
        Err(_) => Err(ApiError::new(ErrorKind::TooSlow, "the body did not come in time")),
        Ok(Ok(body)) => Ok(body.to_bytes()),
        Ok(Err(error)) if error.is::<LengthLimitError>() => Err(too_large()),
        Ok(Err(error)) => Err(ApiError::new(ErrorKind::BadRequest, format!("the body breaks off: {error}"))),
    }
}

/// The API key of a client.
fn bearer(headers: &HeaderMap) -> Option<ApiKey> {
    let value = headers.get(AUTHORIZATION)?.to_str().ok()?;
    let (scheme, key) = value.split_once(' ')?;
    scheme.eq_ignore_ascii_case("bearer").then(|| ApiKey::new(key)).flatten()
}

/// Is `true` if the client calls this machine by one of its own names.
fn is_named_local(headers: &HeaderMap) -> bool {
    let Some(host) = headers.get(HOST).and_then(|host| host.to_str().ok()) else { return false };
    let name = match host.strip_prefix('[') {
        Some(rest) => rest.split(']').next().unwrap_or_default(),
        None => host.split(':').next().unwrap_or_default(),
    };
    name.eq_ignore_ascii_case("localhost")
        || name.parse::<IpAddr>().is_ok_and(|address| address.is_loopback())
}

fn json(status: u16, value: &Value) -> Response<Body> {
    let mut response = Response::new(Full::new(Bytes::from(value.to_string())).boxed_unsync());
    *response.status_mut() = StatusCode::from_u16(status).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
    response.headers_mut().insert(CONTENT_TYPE, HeaderValue::from_static("application/json"));
    response
}
