//! `motet fleet view`: a page with all robots, the results of their orders and the journals of these.

use crate::journal;
use crate::link::{Fleet, say};
use crate::results::Results;
use crate::signed::{is_name, new_id, now, private_key};
use axum::extract::{Path, State};
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header};
use axum::response::{Html, IntoResponse, Response};
use axum::routing::{get, post};
use axum::{Json, Router};
use bytes::Bytes;
use ed25519_dalek::SigningKey;
use serde::Deserialize;
use serde_json::json;
use std::collections::VecDeque;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use tokio::sync::Semaphore;

/// The page. It has no content of others: names and texts of robots are set as text.
const PAGE: &str = include_str!("fleet.html");
/// Policy of the page: a browser loads nothing but the page itself.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; \
                      connect-src 'self'; img-src data:; base-uri 'none'; form-action 'none'; \
                      frame-ancestors 'none'";
/// Policy of the page of a journal, beside its own: it is not of the origin of this page.
const JOURNAL_POLICY: &str = "sandbox allow-scripts; frame-ancestors 'none'";
/// Most bytes of a journal that is shown, and pages of journals that are kept.
const MOST_BYTES: usize = 64 * 1024 * 1024;
const MOST_PAGES: usize = 8;
/// Most pages of journals that are made at a time.
const MAKES: usize = 2;
/// Most letters of an answer.
const MOST_LETTERS: usize = 2_000;

#[derive(clap::Args, Debug)]
pub(crate) struct ViewArgs {
    /// Address of this machine to serve at
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1:0", value_parser = address)]
    at: SocketAddr,
    /// File with the private key of the operator: the page answers questions with it
    #[arg(long, value_name = "FILE")]
    key: Option<PathBuf>,
    /// Command `motet`, which makes the pages of journals [default: next to this executable, or in PATH]
    #[arg(long, value_name = "FILE")]
    motet: Option<PathBuf>,
}

/// An address of this machine.
fn address(text: &str) -> Result<SocketAddr, String> {
    let address: SocketAddr = text.parse().map_err(|_| "write ADDRESS:PORT, such as 127.0.0.1:8080")?;
    if address.ip().is_loopback() {
        Ok(address)
    } else {
        Err("the page is for this machine alone".to_owned())
    }
}

struct Page {
    fleet: Fleet,
    token: String,
    key: Option<SigningKey>,
    motet: Option<PathBuf>,
    results: Arc<Results>,
    /// Pages of journals by names that nobody guesses.
    pages: Mutex<VecDeque<(String, Bytes)>>,
    makes: Semaphore,
}

/// Serves the page until the process is ended.
pub(crate) async fn serve(fleet: Fleet, args: &ViewArgs) -> Result<u8, String> {
    let results = Arc::new(Results::default());
    let page = Arc::new(Page {
        fleet: fleet.clone(),
        token: new_id()?,
        key: args.key.as_deref().map(private_key).transpose()?,
        motet: args.motet.clone().or_else(crate::motet),
        results: Arc::clone(&results),
        pages: Mutex::default(),
        makes: Semaphore::new(MAKES),
    });
    let router = Router::new()
        .route("/", get(|| async { (headers(POLICY), Html(PAGE)) }))
        .route("/robots", get(robots))
        .route("/stop/{robot}", post(stop))
        .route("/answer/{robot}", post(answer))
        .route("/journal/{robot}/{order}", post(make_journal))
        .route("/journal/{name}", get(show_journal))
        .with_state(Arc::clone(&page));
    let listener =
        tokio::net::TcpListener::bind(args.at).await.map_err(|error| format!("{}: {error}", args.at))?;
    let at = listener.local_addr().map_err(|error| error.to_string())?;
    say(&format!("the page is at http://{at}/#{}", page.token));
    tokio::spawn(async move { results.follow(&fleet).await });
    axum::serve(listener, router).await.map_err(|error| error.to_string())?;
    Ok(0)
}

/// Headers of a page with a policy.
fn headers(policy: &'static str) -> [(HeaderName, HeaderValue); 4] {
    [
        (header::CONTENT_SECURITY_POLICY, HeaderValue::from_static(policy)),
        (header::CACHE_CONTROL, HeaderValue::from_static("no-store")),
        (header::REFERRER_POLICY, HeaderValue::from_static("no-referrer")),
        (header::X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff")),
    ]
}

/// Checks whether a request names this machine as such: a page elsewhere that has the name of its own server
/// lead here does not.
fn is_here(headers: &HeaderMap) -> bool {
    let host = headers.get("host").and_then(|value| value.to_str().ok()).unwrap_or_default();
    let name = match host.rsplit_once(':') {
        Some((name, port)) if port.bytes().all(|byte| byte.is_ascii_digit()) => name,
        Some(_) | None => host,
    };
    matches!(name, "127.0.0.1" | "localhost" | "[::1]")
}

/// Checks whether a request has the token of the page's address, and names this machine.
fn is_admitted(headers: &HeaderMap, token: &str) -> bool {
    let given = headers.get("x-motet-token").and_then(|value| value.to_str().ok());
    given == Some(token) && is_here(headers)
}

/// Reason for which the page does not do something.
struct Refusal(StatusCode, String);

impl IntoResponse for Refusal {
    fn into_response(self) -> Response {
        (self.0, self.1).into_response()
    }
}

impl Page {
    /// Refuses requests of others, and names that are none.
    fn admit(&self, headers: &HeaderMap, names: &[&str]) -> Result<(), Refusal> {
        if !is_admitted(headers, &self.token) {
            let why = "open the page by the address that was printed".to_owned();
            return Err(Refusal(StatusCode::FORBIDDEN, why));
        }
        if names.iter().all(|name| is_name(name)) {
            Ok(())
        } else {
            Err(Refusal(StatusCode::NOT_FOUND, "no such robot".to_owned()))
        }
    }
}

fn far(why: String) -> Refusal {
    Refusal(StatusCode::BAD_GATEWAY, why)
}

async fn robots(State(page): State<Arc<Page>>, headers: HeaderMap) -> Result<Response, Refusal> {
    page.admit(&headers, &[])?;
    let robots = page.fleet.states().await.map_err(far)?;
    let told = json!({
        "now": now(),
        "robots": robots,
        "results": page.results.latest(),
        "signs": page.key.is_some(),
        "shows": page.motet.is_some(),
    });
    Ok(Json(told).into_response())
}

async fn stop(
    State(page): State<Arc<Page>>,
    Path(robot): Path<String>,
    headers: HeaderMap,
) -> Result<Response, Refusal> {
    page.admit(&headers, &[robot.as_str()])?;
    let answer = page.fleet.request(&robot, "stop", Vec::new()).await.map_err(far)?;
    Ok(Json(answer).into_response())
}

/// Answer to a question `ORDER/NUMBER`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Answer {
    question: String,
    text: String,
}

async fn answer(
    State(page): State<Arc<Page>>,
    Path(robot): Path<String>,
    headers: HeaderMap,
    body: String,
) -> Result<Response, Refusal> {
    page.admit(&headers, &[robot.as_str()])?;
    let wrong = |why: &str| Refusal(StatusCode::UNPROCESSABLE_ENTITY, why.to_owned());
    let given: Answer = serde_json::from_str(&body).map_err(|error| wrong(&error.to_string()))?;
    if given.text.trim().is_empty() || given.text.chars().count() > MOST_LETTERS {
        return Err(wrong(&format!("an answer has 1 to {MOST_LETTERS} letters")));
    }
    let key = page.key.as_ref().ok_or_else(|| wrong("this page has no key: `motet fleet ask` answers"))?;
    let told = page.fleet.answer(key, &robot, &given.question, &given.text).await;
    Ok(Json(told.map_err(far)?).into_response())
}

/// Makes the page of the journal of an order as far as the server has it; the place at which it can be read.
async fn make_journal(
    State(page): State<Arc<Page>>,
    Path((robot, order)): Path<(String, String)>,
    headers: HeaderMap,
) -> Result<Response, Refusal> {
    page.admit(&headers, &[robot.as_str(), order.as_str()])?;
    let none = || Refusal(StatusCode::NOT_IMPLEMENTED, "there is no command `motet` here".to_owned());
    let motet = page.motet.as_deref().ok_or_else(none)?;
    let _one = page.makes.acquire().await.map_err(|error| far(error.to_string()))?;
    let lines = journal::lines(&page.fleet, &robot, &order, MOST_BYTES).await.map_err(far)?;
    let html = journal::page(motet, &lines).await.map_err(far)?;
    let name = new_id().map_err(far)?;
    let mut pages = page.pages.lock().unwrap_or_else(PoisonError::into_inner);
    pages.push_back((name.clone(), html.into()));
    while pages.len() > MOST_PAGES {
        pages.pop_front();
    }
    Ok(Json(json!({"page": format!("/journal/{name}")})).into_response())
}

/// Shows a page that was made; its name is what admits a reader.
async fn show_journal(
    State(page): State<Arc<Page>>,
    Path(name): Path<String>,
    headers: HeaderMap,
) -> Result<Response, Refusal> {
    let pages = page.pages.lock().unwrap_or_else(PoisonError::into_inner);
    let found = pages.iter().find(|(own, _)| *own == name).filter(|_| is_here(&headers));
    let (_, html) = found.ok_or_else(|| {
        Refusal(StatusCode::NOT_FOUND, "this page is gone: open the journal once more".to_owned())
    })?;
    Ok((self::headers(JOURNAL_POLICY), Html(html.clone())).into_response())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sent(host: &str, token: Option<&str>) -> HeaderMap {
        let mut headers = HeaderMap::new();
        headers.insert("host", HeaderValue::from_str(host).unwrap());
        if let Some(token) = token {
            headers.insert("x-motet-token", HeaderValue::from_str(token).unwrap());
        }
        headers
    }

    #[test]
    fn request_needs_the_token_and_the_name_of_this_machine() {
        for host in ["127.0.0.1:8080", "localhost:1", "[::1]:8080", "127.0.0.1", "[::1]"] {
            assert!(is_admitted(&sent(host, Some("t0")), "t0"), "{host}");
            for token in [None, Some(""), Some("t"), Some("t00")] {
                assert!(!is_admitted(&sent(host, token), "t0"), "{host} {token:?}");
            }
        }
        for host in ["evil.example:8080", "127.0.0.1.evil.example", "", ":8080", "[::2]:1", "127.0.0.1:x"] {
            assert!(!is_admitted(&sent(host, Some("t0")), "t0"), "{host}");
        }
        assert!(!is_admitted(&HeaderMap::new(), ""));
    }

    #[test]
    fn page_is_for_this_machine_alone() {
        assert!(address("127.0.0.1:0").is_ok() && address("[::1]:80").is_ok());
        assert!(address("0.0.0.0:80").is_err() && address("example.org:80").is_err());
    }
}
