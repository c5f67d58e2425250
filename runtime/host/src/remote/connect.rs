//! Position where a driver is: a command to start, or a port of this machine.

use super::link::{ErrorOutput, KeepAlive, Link, LinkError};
use std::fmt;
use std::io::{BufReader, Write};
use std::net::{SocketAddr, TcpStream, ToSocketAddrs};
#[cfg(unix)]
use std::os::unix::net::UnixStream;
use std::process::{Command, Stdio};
use std::str::FromStr;
use std::time::Duration;
use thiserror::Error;

/// Position where a driver is.
///
/// ```
/// use motet_host::remote::DriverAddress;
///
/// let command: DriverAddress = "python3 'my driver.py' --rate 50".parse()?;
/// assert_eq!(command.to_string(), "python3 my driver.py --rate 50");
/// // Only this machine is called: the protocol has no authentication.
/// assert!("tcp://192.0.2.1:4000".parse::<DriverAddress>().is_err());
/// # Ok::<(), motet_host::remote::DriverAddressError>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum DriverAddress {
    /// A command with its arguments; it speaks on its standard input and output.
    Command(Vec<String>),
    /// A TCP port on this machine.
    Tcp(SocketAddr),
}

/// An address that cannot be used.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
pub enum DriverAddressError {
    /// Nothing is given.
    #[error("it is empty: give a command, or tcp://127.0.0.1:PORT")]
    Empty,
    /// A quotation mark without its partner.
    #[error("a quotation mark is not closed")]
    Quote,
    /// No address and port, nor a port of `localhost`.
    #[error("`{0}` is no address and port, such as 127.0.0.1:4000")]
    Socket(String),
    /// The driver protocol has no authentication and stays on the machine.
    #[error("`{0}` is not on this machine: only addresses such as 127.0.0.1 are called")]
    NotLoopback(SocketAddr),
}

impl FromStr for DriverAddress {
    type Err = DriverAddressError;

    /// `tcp://127.0.0.1:PORT`, or a command as a shell would split it at blanks, with single and double
    /// quotes and no expansion.
    fn from_str(text: &str) -> Result<Self, DriverAddressError> {
        if let Some(place) = text.trim().strip_prefix("tcp://") {
            // No other name is looked up, which can take seconds and tells a server of names.
            let named =
                || place.strip_prefix("localhost:").and_then(|_| place.to_socket_addrs().ok()?.next());
            let socket = place.parse().ok().or_else(named);
            let socket: SocketAddr = socket.ok_or_else(|| DriverAddressError::Socket(place.to_owned()))?;
            if !socket.ip().is_loopback() {
                return Err(DriverAddressError::NotLoopback(socket));
            }
            return Ok(Self::Tcp(socket));
        }
        let words = words(text)?;
        if words.is_empty() { Err(DriverAddressError::Empty) } else { Ok(Self::Command(words)) }
    }
}

impl fmt::Display for DriverAddress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Command(words) => f.write_str(&words.join(" ")),
            Self::Tcp(socket) => write!(f, "tcp://{socket}"),
        }
    }
}

fn words(text: &str) -> Result<Vec<String>, DriverAddressError> {
    let mut words = Vec::new();
    let mut word: Option<String> = None;
    let mut quote = None;
    for letter in text.chars() {
        match (quote, letter) {
            (Some(open), _) if open == letter => quote = None,
            (Some(_), _) => word.get_or_insert_default().push(letter),
            (None, '"' | '\'') => {
                quote = Some(letter);
                word.get_or_insert_default();
            }
            (None, _) if letter.is_whitespace() => words.extend(word.take()),
            (None, _) => word.get_or_insert_default().push(letter),
        }
    }
    words.extend(word);
    if quote.is_some() { Err(DriverAddressError::Quote) } else { Ok(words) }
}

impl DriverAddress {
    /// Starts or calls the driver.
    fn open(
        &self,
        within: Duration,
        keep_alive: KeepAlive,
        errors: Option<ErrorOutput>,
    ) -> Result<Link, LinkError> {
        match self {
            Self::Command(words) => {
                let (program, args) = words.split_first().ok_or(LinkError::Closed)?;
                let mut command = Command::new(program);
                // Ctrl-C at a terminal is meant for the host, which then asks the driver to stop.
                #[cfg(unix)]
                std::os::unix::process::CommandExt::process_group(&mut command, 0);
                let child = command
                    .args(args)
                    .stdin(Stdio::piped())
                    .stdout(Stdio::piped())
                    .stderr(if errors.is_some() { Stdio::piped() } else { Stdio::inherit() })
                    .spawn()
                    .map_err(|error| LinkError::NotReached(error.to_string()))?;
                Link::of_child(child, keep_alive, errors)
            }
            Self::Tcp(socket) => {
                let stream = TcpStream::connect_timeout(socket, within)
                    .map_err(|error| LinkError::NotReached(error.to_string()))?;
                // Commands are small, and each is waited for.
                let _ = stream.set_nodelay(true);
                let own = |error: std::io::Error| LinkError::NotReached(error.to_string());
                let (reader, closer) = (stream.try_clone().map_err(own)?, stream.try_clone().map_err(own)?);
                let writer: Box<dyn Write + Send> = Box::new(stream);
                let peer = super::link::Peer::Socket(closer);
                Ok(Link::new(BufReader::new(reader), writer, peer, keep_alive))
            }
        }
    }
}

/// Way to a driver.
#[derive(Debug)]
pub(super) enum Route {
    Address(DriverAddress),
    /// A driver in this process, at the other end of a stream, until it is opened: nobody comes back to it.
    #[cfg(unix)]
    Stream(Option<UnixStream>),
}

impl Route {
    /// True for a port, where another process may listen later.
    pub(super) const fn is_port(&self) -> bool {
        matches!(self, Self::Address(DriverAddress::Tcp(_)))
    }

    /// Starts or calls the driver.
    pub(super) fn open(
        &mut self,
        within: Duration,
        keep_alive: KeepAlive,
        errors: Option<ErrorOutput>,
    ) -> Result<Link, LinkError> {
        match self {
            Self::Address(address) => address.open(within, keep_alive, errors),
            #[cfg(unix)]
            Self::Stream(stream) => {
                let stream = stream.take().ok_or(LinkError::Closed)?;
                let own = |error: std::io::Error| LinkError::NotReached(error.to_string());
                let (reader, closer) = (stream.try_clone().map_err(own)?, stream.try_clone().map_err(own)?);
                let peer = super::link::Peer::Stream(closer);
                Ok(Link::new(BufReader::new(reader), Box::new(stream), peer, keep_alive))
            }
        }
    }
}

impl fmt::Display for Route {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Address(address) => address.fmt(f),
            #[cfg(unix)]
            Self::Stream(_) => f.write_str("in this process"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{DriverAddress, DriverAddressError};

    #[test]
    fn driver_address_commands_are_split_like_in_a_shell() {
        let words = |text: &str| match text.parse() {
            Ok(DriverAddress::Command(words)) => words,
            other => panic!("{other:?}"),
        };
        assert_eq!(words("python3 echo.py --seconds 1"), ["python3", "echo.py", "--seconds", "1"]);
        assert_eq!(words("'my driver' \"\" a'b c'd"), ["my driver", "", "ab cd"]);
        assert_eq!("  ".parse::<DriverAddress>(), Err(DriverAddressError::Empty));
        assert_eq!("a 'b".parse::<DriverAddress>(), Err(DriverAddressError::Quote));
    }

    #[test]
    fn driver_address_only_this_machine_is_called() {
        assert!(matches!("tcp://127.0.0.1:4000".parse(), Ok(DriverAddress::Tcp(_))));
        assert!(matches!(
            "tcp://192.0.2.1:4000".parse::<DriverAddress>(),
            Err(DriverAddressError::NotLoopback(_))
        ));
        assert!(matches!("tcp://localhost:4000".parse(), Ok(DriverAddress::Tcp(_))));
        for place in ["tcp://127.0.0.1", "tcp://robot.example:4000", "tcp://localhost:x"] {
            assert!(matches!(place.parse::<DriverAddress>(), Err(DriverAddressError::Socket(_))), "{place}");
        }
    }
}
