//! `motet fleet view`: a page with all robots.

use crate::link::{Fleet, say};
use axum::extract::{Path, State};
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::{Html, IntoResponse, Response};
use axum::routing::{get, post};
use axum::{Json, Router};
use serde_json::json;
use std::net::SocketAddr;
use std::sync::Arc;

/// The page. It has no content of others: names and texts of robots are set as text.
const PAGE: &str = include_str!("fleet.html");
/// What a browser may load: nothing but the page itself.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; \
                      connect-src 'self'; frame-ancestors 'none'";

#[derive(clap::Args, Debug)]
pub(crate) struct ViewArgs {
    /// Address of this machine to serve at
    #[arg(long, value_name = "ADDRESS", default_value = "127.0.0.1:0", value_parser = address)]
    at: SocketAddr,
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
}

/// Serves the page until the process is ended.
pub(crate) async fn serve(fleet: Fleet, args: &ViewArgs) -> Result<u8, String> {
    let token = crate::signed::new_id()?;
    let page = Arc::new(Page { fleet, token });
    let router = Router::new()
        .route(
            "/",
            get(|| async {
                ([(header::CONTENT_SECURITY_POLICY, HeaderValue::from_static(POLICY))], Html(PAGE))
            }),
        )
        .route("/robots", get(robots))
        .route("/stop/{robot}", post(stop))
        .with_state(Arc::clone(&page));
    let listener =
        tokio::net::TcpListener::bind(args.at).await.map_err(|error| format!("{}: {error}", args.at))?;
    let at = listener.local_addr().map_err(|error| error.to_string())?;
    say(&format!("the page is at http://{at}/#{}", page.token));
    axum::serve(listener, router).await.map_err(|error| error.to_string())?;
    Ok(0)
}

/// Refuses requests without the token of the page's address, and those by another name of this machine.
fn refused(page: &Page, headers: &HeaderMap) -> Option<Response> {
    let text = |name: &str| headers.get(name).and_then(|value| value.to_str().ok()).unwrap_or_default();
    let host = text("host").rsplit_once(':').map_or("", |(host, _)| host);
    let is_token = text("x-motet-token") == page.token;
    if is_token && matches!(host, "127.0.0.1" | "localhost" | "[::1]") {
        return None;
    }
    Some((StatusCode::FORBIDDEN, "open the page by the address that was printed").into_response())
}

async fn robots(State(page): State<Arc<Page>>, headers: HeaderMap) -> Response {
    if let Some(refused) = refused(&page, &headers) {
        return refused;
    }
    match page.fleet.states().await {
        Ok(states) => Json(json!({"now": crate::signed::now(), "robots": states})).into_response(),
        Err(why) => (StatusCode::BAD_GATEWAY, why).into_response(),
    }
}

async fn stop(State(page): State<Arc<Page>>, Path(robot): Path<String>, headers: HeaderMap) -> Response {
    if let Some(refused) = refused(&page, &headers) {
        return refused;
    }
    if !crate::signed::is_name(&robot) {
        return (StatusCode::NOT_FOUND, "no such robot").into_response();
    }
    match page.fleet.request(&robot, "stop", Vec::new()).await {
        Ok(answer) => Json(answer).into_response(),
        Err(why) => (StatusCode::BAD_GATEWAY, why).into_response(),
    }
}
