//! HTTP endpoint of the server. Every request needs the token, a known `Host`, and, from a browser, a known
//! `Origin`.

use std::convert::Infallible;
use std::net::{Ipv4Addr, SocketAddr};
use std::str::FromStr;
use std::sync::Arc;
use std::time::Duration;

use http::header::{AUTHORIZATION, WWW_AUTHENTICATE};
use http::{Request, Response, StatusCode};
use http_body_util::combinators::BoxBody;
use http_body_util::{BodyExt as _, Full};
use hyper::body::{Bytes, Incoming};
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use rmcp::transport::streamable_http_server::session::local::LocalSessionManager;
use rmcp::transport::streamable_http_server::{StreamableHttpServerConfig, StreamableHttpService};
use tokio::net::TcpListener;
use tokio::sync::Semaphore;

use super::server::MotetServer;
use crate::error::CliError;
use crate::output::note;

/// Path of the endpoint.
const PATH: &str = "/mcp";
/// The most connections at a time.
const MAX_CONNECTIONS: usize = 64;
/// The most bytes of a request.
const MAX_REQUEST_BYTES: usize = 1024 * 1024;
/// The longest time in which a client sends the head of a request.
const HEAD_TIME: Duration = Duration::from_secs(10);
/// The fewest characters of a token.
const MIN_TOKEN_CHARS: usize = 16;

/// Address to listen on.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct HttpAddress(SocketAddr);

impl FromStr for HttpAddress {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let port = text.parse().ok().map(|port: u16| SocketAddr::from((Ipv4Addr::LOCALHOST, port)));
        port.or_else(|| text.parse().ok())
            .map(Self)
            .ok_or_else(|| "write a port such as 4712, or an address such as 127.0.0.1:4712".to_owned())
    }
}

/// Secret that every request carries.
#[derive(Clone)]
pub(crate) struct BearerToken(Arc<str>);

impl BearerToken {
    /// Reads the token from an environment variable.
    pub(crate) fn from_variable(variable: &str) -> Result<Self, CliError> {
        let is_name = variable.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '_');
        let advised = |problem: String| CliError::Advised {
            problem,
            help: format!(
                "put at least {MIN_TOKEN_CHARS} random letters and digits into a variable, and name it: \
                 --token-from MOTET_TOKEN"
            ),
        };
        if !is_name {
            // It may be the token itself, which is not shown.
            return Err(advised(
                "the value of `--token-from` is no name of an environment variable".to_owned(),
            ));
        }
        let token = std::env::var(variable).unwrap_or_default();
        let token = token.trim();
        if token.len() < MIN_TOKEN_CHARS || !token.chars().all(|letter| letter.is_ascii_graphic()) {
            return Err(advised(format!("the environment variable `{variable}` holds no token")));
        }
        Ok(Self(token.into()))
    }

    /// True if a request carries the token. The time does not depend on how much of it is right.
    fn is_in<T>(&self, request: &Request<T>) -> bool {
        let given = request.headers().get(AUTHORIZATION).map(http::HeaderValue::as_bytes);
        let Some((scheme, given)) = given.and_then(|given| given.split_at_checked("Bearer ".len())) else {
            return false;
        };
        let differs = |(a, b): (&u8, &u8)| a ^ b;
        let is_same = given.len() == self.0.len()
            && given.iter().zip(self.0.as_bytes()).map(differs).fold(0, |all, one| all | one) == 0;
        is_same && scheme.eq_ignore_ascii_case(b"Bearer ")
    }
}

/// Address of the endpoint, and conditions for those who call it.
pub(crate) struct HttpAccess {
    pub(crate) address: HttpAddress,
    pub(crate) token: BearerToken,
    /// Further names of this host.
    pub(crate) hosts: Vec<String>,
    /// Origins of pages in browsers.
    pub(crate) origins: Vec<String>,
}

/// Serves clients until the future is dropped.
pub(crate) async fn serve(server: MotetServer, access: HttpAccess) -> Result<(), CliError> {
    let cannot =
        |error: std::io::Error| CliError::Message(format!("cannot listen on {}: {error}", access.address.0));
    let listener = TcpListener::bind(access.address.0).await.map_err(cannot)?;
    let own = listener.local_addr().map_err(cannot)?;
    let mut hosts: Vec<String> = ["localhost", "127.0.0.1", "::1"].map(str::to_owned).to_vec();
    if !own.ip().is_loopback() {
        note("warning: the token goes over the network without encryption: put a proxy with TLS in front");
        if !own.ip().is_unspecified() {
            hosts.push(own.ip().to_string());
        }
    }
    hosts.extend(access.hosts);
    let config = StreamableHttpServerConfig::default()
        .with_allowed_hosts(hosts)
        .with_allowed_origins(access.origins)
        .enforce_origin_validation()
        .with_max_request_body_bytes(MAX_REQUEST_BYTES);
    let sessions = Arc::new(LocalSessionManager::default());
    let service = StreamableHttpService::new(move || Ok(server.clone()), sessions, config);
    let places = Arc::new(Semaphore::new(MAX_CONNECTIONS));
    note(&format!("listening on http://{own}{PATH}"));
    loop {
        let Ok(place) = Arc::clone(&places).acquire_owned().await else { return Ok(()) };
        // A connection that breaks at once is no reason to end.
        let Ok((stream, _)) = listener.accept().await else { continue };
        let (service, token) = (TowerToHyperService::new(service.clone()), access.token.clone());
        tokio::spawn(async move {
            let service = service_fn(|request: Request<Incoming>| {
                let (service, token) = (service.clone(), token.clone());
                async move {
                    if request.uri().path() != PATH {
                        return Ok(refused(StatusCode::NOT_FOUND, "the endpoint is /mcp"));
                    }
                    if !token.is_in(&request) {
                        return Ok(refused(StatusCode::UNAUTHORIZED, "a request needs the bearer token"));
                    }
                    hyper::service::Service::call(&service, request).await
                }
            });
            let connection = http1::Builder::new()
                .timer(TokioTimer::new())
                .header_read_timeout(HEAD_TIME)
                .serve_connection(TokioIo::new(stream), service);
            // A client that goes away is no error.
            let _ = connection.await;
            drop(place);
        });
    }
}

fn refused(status: StatusCode, why: &'static str) -> Response<BoxBody<Bytes, Infallible>> {
    let mut response = Response::new(Full::new(Bytes::from_static(why.as_bytes())).boxed());
    *response.status_mut() = status;
    if status == StatusCode::UNAUTHORIZED {
        response.headers_mut().insert(WWW_AUTHENTICATE, http::HeaderValue::from_static("Bearer"));
    }
    response
}

#[cfg(test)]
mod tests {
    use http::Request;

    use super::{BearerToken, HttpAddress};

    #[test]
    fn http_address_is_a_port_of_this_machine_or_an_address() {
        let shown = |text: &str| text.parse().map(|HttpAddress(address)| address.to_string());
        assert_eq!(shown("4712"), Ok("127.0.0.1:4712".to_owned()));
        assert_eq!(shown("0.0.0.0:1"), Ok("0.0.0.0:1".to_owned()));
        for text in ["", "localhost", "70000", "1.2.3.4", ":80"] {
            assert!(shown(text).is_err(), "{text}");
        }
    }

    #[test]
    fn bearer_token_is_compared_whole() {
        let token = BearerToken("abcdefgh12345678".into());
        let given =
            |value: &str| token.is_in(&Request::builder().header("Authorization", value).body(()).unwrap());
        assert!(given("Bearer abcdefgh12345678"));
        for value in ["", "Bearer ", "abcdefgh12345678", "Bearer abcdefgh1234567", "Basic abcdefgh12345678"] {
            assert!(!given(value), "{value}");
        }
        assert!(!token.is_in(&Request::builder().body(()).unwrap()));
    }
}
