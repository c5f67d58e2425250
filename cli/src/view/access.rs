//! Access to the page: the token of its address, and the checks of `Host` and `Origin`.
//!
//! A browser sends a page of another site to this server only by a name that its owner controls, or with the
//! origin of that site. So the host of a request is an address or `localhost`, and its origin is this server.

use std::net::{IpAddr, SocketAddr};

use axum::http::HeaderMap;
use axum::http::header::{HOST, ORIGIN};

/// Secret that the address of a page carries: 32 hexadecimal digits.
#[derive(Clone, Debug)]
pub(crate) struct Token(String);

impl Token {
    /// New token from the randomness of the system.
    pub(crate) fn new() -> Result<Self, getrandom::Error> {
        let mut bytes = [0; 16];
        getrandom::fill(&mut bytes)?;
        Ok(Self(bytes.iter().map(|byte| format!("{byte:02x}")).collect()))
    }

    /// Text of the token.
    pub(crate) fn as_str(&self) -> &str {
        &self.0
    }

    /// Compares a token in a time that does not depend on where the two differ.
    pub(crate) fn is(&self, given: &str) -> bool {
        let pairs = self.0.bytes().zip(given.bytes());
        given.len() == self.0.len() && pairs.fold(0, |differ, (one, other)| differ | (one ^ other)) == 0
    }
}

/// Reason to refuse a request.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Refusal {
    /// The host is a name that anybody may point here.
    Host,
    /// The request comes from a page of another site.
    Origin,
    Token,
}

impl Refusal {
    /// Sentence for the one who asked.
    pub(crate) const fn says(self) -> &'static str {
        match self {
            Self::Host => "open the page by its address, not by another name",
            Self::Origin => "the request comes from another page",
            Self::Token => "the address lacks the token that `--view` has printed",
        }
    }
}

/// Checks the headers of a request.
pub(crate) fn check_headers(headers: &HeaderMap) -> Result<(), Refusal> {
    let text = |name| headers.get(name).map(|value| value.to_str().unwrap_or_default());
    let host = text(HOST).filter(|host| is_address(host)).ok_or(Refusal::Host)?;
    match text(ORIGIN) {
        Some(origin) if origin.strip_prefix("http://") != Some(host) => Err(Refusal::Origin),
        Some(_) | None => Ok(()),
    }
}

/// Is `true` for `localhost` and addresses, with or without a port.
fn is_address(host: &str) -> bool {
    let name = match host.rsplit_once(':') {
        Some((name, port)) if port.bytes().all(|digit| digit.is_ascii_digit()) => name,
        Some(_) | None => host,
    };
    let bare = name.strip_prefix('[').and_then(|name| name.strip_suffix(']')).unwrap_or(name);
    name == "localhost" || bare.parse::<IpAddr>().is_ok() || host.parse::<SocketAddr>().is_ok()
}

#[cfg(test)]
mod tests {
    use axum::http::{HeaderMap, HeaderValue};

    use super::{Refusal, Token, check_headers};

    fn check(host: &str, origin: Option<&str>) -> Result<(), Refusal> {
        let mut headers = HeaderMap::new();
        headers.insert("host", HeaderValue::from_str(host).unwrap());
        origin.map(|origin| headers.insert("origin", HeaderValue::from_str(origin).unwrap()));
        check_headers(&headers)
    }

    #[test]
    fn token_is_random_and_compared_whole() {
        let (one, other) = (Token::new().unwrap(), Token::new().unwrap());
        assert_eq!(one.as_str().len(), 32);
        assert!(one.is(one.as_str()));
        let first = one.as_str().chars().next().unwrap();
        for wrong in
            [other.as_str(), "", one.as_str().trim_start_matches(first), &format!("{}0", one.as_str())]
        {
            assert!(!one.is(wrong), "{wrong}");
        }
    }

    #[test]
    fn headers_name_an_address_and_this_page() {
        for host in ["127.0.0.1:4711", "localhost:80", "localhost", "[::1]:4711", "10.1.2.3", "[fe80::1]"] {
            assert_eq!(check(host, None), Ok(()), "{host}");
            assert_eq!(check(host, Some(&format!("http://{host}"))), Ok(()), "{host}");
        }
        for host in ["evil.example:4711", "localhost.evil.example", "", "127.0.0.1.nip.io:80", "a:b:c"] {
            assert_eq!(check(host, None), Err(Refusal::Host), "{host}");
        }
        for origin in ["http://evil.example", "https://127.0.0.1:4711", "null", "http://127.0.0.1:4712", ""] {
            assert_eq!(check("127.0.0.1:4711", Some(origin)), Err(Refusal::Origin), "{origin}");
        }
        assert_eq!(check_headers(&HeaderMap::new()), Err(Refusal::Host));
    }
}
