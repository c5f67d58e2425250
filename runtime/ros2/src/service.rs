//! Calls of services over DDS.

use crate::cdr::{Message, decode, encode};
use crate::dds::{Dds, Quality, Received, Request, Source, Writer, dds_topic, dds_type};
use crate::layout::Layouts;
use serde_json::Value;

/// Middleware of the robot's nodes. It says where a response has the number of its request.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Middleware {
    /// `rmw_cyclonedds_cpp`: in 16 bytes before the message.
    #[serde(alias = "rmw_cyclonedds_cpp")]
    Cyclonedds,
    /// `rmw_fastrtps_cpp` and `rmw_connextdds`: beside the message.
    #[default]
    #[serde(alias = "rmw_fastrtps_cpp", alias = "rmw_connextdds")]
    Fastdds,
}

/// Bytes of the header of Cyclone DDS: the client, and the number of the request.
const HEADER: usize = 16;

/// Number of a call of one client.
pub type Ticket = i64;

/// Client of a service.
pub struct Client {
    writer: Writer,
    middleware: Middleware,
    /// Topics of the request and of the response, as DDS names them.
    pub topics: [String; 2],
    request: String,
    response: String,
    source: Source,
    /// Name of this client in the header of Cyclone DDS.
    own: u64,
    calls: i64,
    /// Tickets of calls without a response, with the identity that DDS gave each.
    open: Vec<(Ticket, Request)>,
}

/// Interface of a service: the name of its layouts, and its kind in DDS with the end of its name.
#[derive(Clone, Copy, Debug)]
pub struct Interface<'a> {
    /// Name such as `std_srvs/Trigger`.
    pub name: &'a str,
    /// `srv` or `action`.
    pub kind: &'a str,
    /// Nothing, `_SendGoal` or `_GetResult`.
    pub end: &'a str,
}

impl Client {
    /// A client. Responses come with the number `source`.
    ///
    /// # Errors
    ///
    /// Why DDS refuses its topics.
    pub fn new(
        dds: &Dds,
        middleware: Middleware,
        service: &str,
        interface: Interface<'_>,
        source: Source,
    ) -> Result<Self, String> {
        let Interface { name, kind, end } = interface;
        let topics = [dds_topic("rq", service, "Request"), dds_topic("rr", service, "Reply")];
        let [request, response] = ["Request", "Response"].map(|part| format!("{end}_{part}"));
        dds.subscribe(&topics[1], &dds_type(name, kind, &response), Quality::Reliable, source)?;
        let writer = dds.publish(&topics[0], &dds_type(name, kind, &request), Quality::Reliable)?;
        let own = getrandom::u64().map_err(|error| format!("no random number: {error}"))?;
        let [request, response] = [request, response].map(|part| format!("{name}{part}"));
        Ok(Self { writer, middleware, topics, request, response, source, own, calls: 0, open: Vec::new() })
    }

    /// True for a message that is a response to this client or to another one of the service.
    #[must_use]
    pub const fn is_source(&self, source: Source) -> bool {
        self.source == source
    }

    /// Sends a request.
    ///
    /// # Errors
    ///
    /// The field that the layout lacks, or why DDS did not take it.
    pub fn call(&mut self, layouts: &Layouts, value: &Value) -> Result<Ticket, String> {
        let message = encode(layouts, &self.request, value)?;
        self.calls += 1;
        let bytes = match self.middleware {
            Middleware::Fastdds => message,
            Middleware::Cyclonedds => header(self.own, self.calls).into_iter().chain(message).collect(),
        };
        let identity = self.writer.write(bytes, None)?;
        self.open.push((self.calls, identity));
        Ok(self.calls)
    }

    /// Reads a response. `None` if it answers no open call of this client: a second response, or one for
    /// another client.
    ///
    /// # Errors
    ///
    /// Why the message is none of the layout.
    pub fn hear(&mut self, layouts: &Layouts, received: &Received) -> Result<Option<(Ticket, Message)>, String> {
        let is_answered: Box<dyn Fn(&(Ticket, Request)) -> bool> = match self.middleware {
            Middleware::Fastdds => {
                let Some((writer, number)) = received.answers else {
                    return Err("a response does not say which request it answers; \
                                is `middleware` right in the binding?".to_owned());
                };
                // Fast DDS names the reader or the writer of the client: both have its participant.
                Box::new(move |(_, own)| own.1 == number && own.0[..12] == writer[..12])
            }
            Middleware::Cyclonedds => {
                let Some((client, number)) = split_header(&received.bytes) else {
                    return Err("a response is shorter than its header".to_owned());
                };
                let own = self.own;
                Box::new(move |(ticket, _)| client == own && *ticket == number)
            }
        };
        let Some(at) = self.open.iter().position(is_answered) else { return Ok(None) };
        let (ticket, _) = self.open.swap_remove(at);
        let start = if self.middleware == Middleware::Cyclonedds { HEADER } else { 0 };
        let bytes = received.bytes.get(start..).unwrap_or_default();
        Ok(Some((ticket, decode(layouts, &self.response, bytes)?)))
    }

    /// No longer waits for the response to a call.
    pub fn forget(&mut self, ticket: Ticket) {
        self.open.retain(|(open, _)| *open != ticket);
    }
}

/// Header of Cyclone DDS.
#[must_use]
pub fn header(client: u64, number: i64) -> Vec<u8> {
    [client.to_le_bytes(), number.to_le_bytes()].concat()
}

/// Client and number in a header of Cyclone DDS.
#[must_use]
pub fn split_header(bytes: &[u8]) -> Option<(u64, i64)> {
    let client = bytes.get(..8)?.try_into().ok()?;
    let number = bytes.get(8..HEADER)?.try_into().ok()?;
    Some((u64::from_le_bytes(client), i64::from_le_bytes(number)))
}
