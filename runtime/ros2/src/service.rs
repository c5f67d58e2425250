//! Calls of services over DDS.

use crate::cdr::{Message, decode, encode};
use crate::dds::{Dds, OwnEndpoint, Quality, Received, Request, Source, Writer, dds_topic, dds_type};
use crate::layout::Layouts;
use serde_json::Value;

/// Middleware of the robot's nodes. It says where a response has the number of its request.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Middleware {
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

/// Greatest number of calls that wait for a response.
const MAX_OPEN: usize = 1_000;

/// Number of a call of one client.
pub(crate) type Ticket = i64;

/// Client of a service.
pub(crate) struct Client {
    writer: Writer,
    middleware: Middleware,
    /// Topics of the request and of the response, as DDS names them.
    pub(crate) topics: [String; 2],
    types: [String; 2],
    request: String,
    response: String,
    /// Name of this client in the header of Cyclone DDS.
    own: u64,
    calls: i64,
    /// Tickets of calls without a response, with the identity that DDS gave each.
    open: Vec<(Ticket, Request)>,
}

/// Interface of a service: the name of its layouts, and its kind in DDS with the end of its name.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interface<'a> {
    /// Name such as `std_srvs/Trigger`.
    pub(crate) name: &'a str,
    /// `srv` or `action`.
    pub(crate) kind: &'a str,
    /// Nothing, `_SendGoal` or `_GetResult`.
    pub(crate) end: &'a str,
}

impl Client {
    /// A client. Responses come with the number `source`.
    ///
    /// # Errors
    ///
    /// Why DDS refuses its topics.
    pub(crate) fn new(
        dds: &Dds,
        middleware: Middleware,
        service: &str,
        interface: Interface<'_>,
        source: Source,
    ) -> Result<Self, String> {
        let Interface { name, kind, end } = interface;
        let topics = [dds_topic("rq", service, "Request"), dds_topic("rr", service, "Reply")];
        let [request, response] = ["Request", "Response"].map(|part| format!("{end}_{part}"));
        let types = [&request, &response].map(|end| dds_type(name, kind, end));
        dds.subscribe(&topics[1], &types[1], Quality::Reliable, source)?;
        let writer = dds.publish(&topics[0], &types[0], Quality::Reliable)?;
        let own = getrandom::u64().map_err(|error| format!("no random number: {error}"))?;
        let [request, response] = [request, response].map(|part| format!("{name}{part}"));
        Ok(Self { writer, middleware, topics, types, request, response, own, calls: 0, open: Vec::new() })
    }

    /// Writer of its requests, and reader of its responses.
    pub(crate) fn endpoints(&self) -> [OwnEndpoint; 2] {
        let own = |at: usize| OwnEndpoint::new(&self.topics[at], &self.types[at], Quality::Reliable, at == 0);
        [own(0), own(1)]
    }

    /// Sends a request.
    ///
    /// # Errors
    ///
    /// The field that the layout lacks, or why DDS did not take it.
    pub(crate) fn call(&mut self, layouts: &Layouts, value: &Value) -> Result<Ticket, String> {
        let message = encode(layouts, &self.request, value)?;
        self.calls += 1;
        let bytes = match self.middleware {
            Middleware::Fastdds => message,
            Middleware::Cyclonedds => header(self.own, self.calls).into_iter().chain(message).collect(),
        };
        let identity = self.writer.write(bytes, None)?;
        // Some servers never answer: the oldest calls are given up.
        if self.open.len() >= MAX_OPEN {
            self.open.remove(0);
        }
        self.open.push((self.calls, identity));
        Ok(self.calls)
    }

    /// Reads a response. `None` if it answers no open call of this client: a second response, or one for
    /// another client.
    ///
    /// # Errors
    ///
    /// Why the message is none of the layout.
    pub(crate) fn hear(
        &mut self,
        layouts: &Layouts,
        received: &Received,
    ) -> Result<Option<(Ticket, Message)>, String> {
        let at = match self.middleware {
            Middleware::Fastdds => {
                let Some((writer, number)) = received.answers else {
                    return Err("a response does not say which request it answers; \
                                is `middleware` right in the binding?"
                        .to_owned());
                };
                // Fast DDS names the reader or the writer of the client: both have its participant.
                self.open.iter().position(|(_, own)| own.1 == number && own.0[..12] == writer[..12])
            }
            Middleware::Cyclonedds => {
                let Some((client, number)) = split_header(&received.bytes) else {
                    return Err("a response is shorter than its header".to_owned());
                };
                self.open.iter().position(|(ticket, _)| client == self.own && *ticket == number)
            }
        };
        let Some(at) = at else { return Ok(None) };
        let (ticket, _) = self.open.remove(at);
        let start = if self.middleware == Middleware::Cyclonedds { HEADER } else { 0 };
        let bytes = received.bytes.get(start..).unwrap_or_default();
        Ok(Some((ticket, decode(layouts, &self.response, bytes)?)))
    }

    /// No longer waits for the response to a call.
    pub(crate) fn forget(&mut self, ticket: Ticket) {
        self.open.retain(|(open, _)| *open != ticket);
    }
}

/// Header of Cyclone DDS.
#[must_use]
pub(crate) fn header(client: u64, number: i64) -> Vec<u8> {
    [client.to_le_bytes(), number.to_le_bytes()].concat()
}

/// Client and number in a header of Cyclone DDS.
#[must_use]
pub(crate) fn split_header(bytes: &[u8]) -> Option<(u64, i64)> {
    let client = bytes.get(..8)?.try_into().ok()?;
    let number = bytes.get(8..HEADER)?.try_into().ok()?;
    Some((u64::from_le_bytes(client), i64::from_le_bytes(number)))
}

/// Server of a service.
pub(crate) struct Server {
    writer: Writer,
    middleware: Middleware,
    request: String,
    response: String,
}

/// A request that is to be answered.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct PendingRequest {
    header: Option<(u64, i64)>,
    identity: Request,
}

impl Server {
    /// A server. Requests come with the number `source`.
    ///
    /// # Errors
    ///
    /// Why DDS refuses its topics.
    pub(crate) fn new(
        dds: &Dds,
        middleware: Middleware,
        service: &str,
        interface: Interface<'_>,
        source: Source,
    ) -> Result<Self, String> {
        let Interface { name, kind, end } = interface;
        let [request, response] = ["Request", "Response"].map(|part| format!("{end}_{part}"));
        let asked = dds_topic("rq", service, "Request");
        dds.subscribe(&asked, &dds_type(name, kind, &request), Quality::Reliable, source)?;
        let answered = dds_topic("rr", service, "Reply");
        let writer = dds.publish(&answered, &dds_type(name, kind, &response), Quality::Reliable)?;
        let [request, response] = [request, response].map(|part| format!("{name}{part}"));
        Ok(Self { writer, middleware, request, response })
    }

    /// Reads a request.
    ///
    /// # Errors
    ///
    /// Why the message is none of the layout.
    pub(crate) fn hear(
        &self,
        layouts: &Layouts,
        received: &Received,
    ) -> Result<(PendingRequest, Message), String> {
        // Fast DDS names in a request the reader that waits for the response.
        let (writer, number) = received.identity;
        let identity = (received.answers.map_or(writer, |(reader, _)| reader), number);
        let (header, start) = match self.middleware {
            Middleware::Fastdds => (None, 0),
            Middleware::Cyclonedds => {
                let header = split_header(&received.bytes).ok_or("a request is shorter than its header")?;
                (Some(header), HEADER)
            }
        };
        let bytes = received.bytes.get(start..).unwrap_or_default();
        Ok((PendingRequest { header, identity }, decode(layouts, &self.request, bytes)?))
    }

    /// Answers a request.
    ///
    /// # Errors
    ///
    /// The field that the layout lacks, or why DDS did not take it.
    pub(crate) fn answer(
        &self,
        layouts: &Layouts,
        asked: PendingRequest,
        value: &Value,
    ) -> Result<(), String> {
        let message = encode(layouts, &self.response, value)?;
        match asked.header {
            None => self.writer.write(message, Some(asked.identity)),
            Some((client, number)) => {
                let bytes = header(client, number).into_iter().chain(message).collect();
                self.writer.write(bytes, None)
            }
        }
        .map(|_| ())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::Distribution;
    use crossbeam_channel::unbounded;
    use serde_json::json;
    use std::time::{Duration, Instant};

    /// One client and one server in two participants of this process.
    fn calls(middleware: Middleware, domain: u16) {
        let layouts = Layouts::of(Distribution::Jazzy, None).unwrap();
        let interface = Interface { name: "std_srvs/SetBool", kind: "srv", end: "" };
        let ((asks, asked), (answers, answered)) = (unbounded(), unbounded());
        let (robot, own) = (Dds::join(domain, &[], asks).unwrap(), Dds::join(domain, &[], answers).unwrap());
        let server = Server::new(&robot, middleware, "/light", interface, 5).unwrap();
        let mut client = Client::new(&own, middleware, "/light", interface, 7).unwrap();
        let begun = Instant::now();
        let is_there =
            |endpoints: &[crate::dds::Endpoint], topic: &str| endpoints.iter().any(|one| one.topic == topic);
        while !is_there(&own.readers(), &client.topics[0])
            || !is_there(&own.writers(), &client.topics[1])
            || !is_there(&robot.readers(), &client.topics[1])
        {
            assert!(begun.elapsed() < Duration::from_secs(20), "nobody was discovered");
            std::thread::sleep(Duration::from_millis(20));
        }
        std::thread::sleep(Duration::from_millis(200));
        let tickets = [true, false].map(|on| client.call(&layouts, &json!({"data": on})).unwrap());
        let mut requests: Vec<(PendingRequest, Message)> = Vec::new();
        while requests.len() < 2 {
            let received = asked.recv_timeout(Duration::from_secs(5)).unwrap();
            requests.push(server.hear(&layouts, &received).unwrap());
        }
        // The later request is answered first, and twice.
        for (request, message) in requests.iter().rev().chain(requests.last()) {
            let answer = json!({"success": message.is_true("data"), "message": "done"});
            server.answer(&layouts, *request, &answer).unwrap();
        }
        let mut heard = Vec::new();
        for _ in 0..3 {
            let received = answered.recv_timeout(Duration::from_secs(5)).unwrap();
            heard.extend(client.hear(&layouts, &received).unwrap());
        }
        let heard: Vec<(Ticket, bool)> =
            heard.iter().map(|(at, message)| (*at, message.is_true("success"))).collect();
        assert_eq!(heard, [(tickets[1], false), (tickets[0], true)]);
    }

    #[test]
    fn response_finds_its_call_as_fast_dds_writes_it() {
        calls(Middleware::Fastdds, 71);
    }

    #[test]
    fn response_finds_its_call_as_cyclone_dds_writes_it() {
        calls(Middleware::Cyclonedds, 72);
    }
}
