//! Topics of ROS 2 over DDS, as bytes.

use bytes::Bytes;
use crossbeam_channel::Sender;
use futures::StreamExt as _;
use futures::executor::ThreadPool;
use futures::future::{AbortHandle, abortable};
use rustdds::RTPSEntity as _;
use rustdds::no_key::{Decode, DefaultDecoder, DeserializerAdapter, SerializerAdapter};
use rustdds::policy::{Durability, History, Reliability};
use rustdds::rpc::SampleIdentity;
use rustdds::with_key::WriteOptionsBuilder;
use rustdds::{
    DomainParticipant, DomainParticipantBuilder, DomainParticipantStatusEvent,
    DomainParticipantStatusListener, LostReason, QosPolicies, QosPolicyBuilder, RepresentationIdentifier,
    StatusEvented as _, Topic, TopicKind,
};
use std::collections::HashSet;
use std::convert::Infallible;
use std::net::IpAddr;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// Number of a subscription.
pub(crate) type Source = u32;

/// Message of a subscription.
#[derive(Clone, Debug)]
pub(crate) struct Received {
    pub(crate) source: Source,
    /// CDR bytes without the header of the encoding.
    pub(crate) bytes: Bytes,
    /// Request that this message answers, if the middleware says so beside it.
    pub(crate) answers: Option<Request>,
    /// Identity of the message itself.
    pub(crate) identity: Request,
    /// Time of arrival.
    pub(crate) at: Instant,
}

/// Identity of a request: its writer, and its number.
pub(crate) type Request = ([u8; 16], i64);

/// Quality of service of a topic, as ROS 2 names its profiles.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Quality {
    /// Reliable; only for who listens now.
    Reliable,
    /// Whatever arrives, such as pictures.
    Sensor,
    /// Reliable, and the last message also for who comes later.
    Latched,
}

impl Quality {
    /// True if it is reliable, and if a late reader gets the last message.
    const fn policy(self) -> [bool; 2] {
        match self {
            Self::Reliable => [true, false],
            Self::Sensor => [false, false],
            Self::Latched => [true, true],
        }
    }

    fn policies(self) -> QosPolicies {
        let reliable = Reliability::Reliable { max_blocking_time: rustdds::Duration::from_millis(100) };
        let (reliability, durability, depth) = match self {
            Self::Reliable => (reliable, Durability::Volatile, 64),
            Self::Sensor => (Reliability::BestEffort, Durability::Volatile, 8),
            Self::Latched => (reliable, Durability::TransientLocal, 1),
        };
        QosPolicyBuilder::new()
            .reliability(reliability)
            .durability(durability)
            .history(History::KeepLast { depth })
            .build()
    }
}

/// Participant of a DDS domain.
pub(crate) struct Dds {
    participant: DomainParticipant,
    publisher: rustdds::Publisher,
    subscriber: rustdds::Subscriber,
    pool: ThreadPool,
    sender: Sender<Received>,
    status: DomainParticipantStatusListener,
    /// Handles that end the streams of the subscriptions, and with them their readers.
    streams: Mutex<Vec<AbortHandle>>,
}

impl Drop for Dds {
    fn drop(&mut self) {
        let streams = self.streams.get_mut().unwrap_or_else(PoisonError::into_inner);
        streams.drain(..).for_each(|stream| stream.abort());
    }
}

/// Writer of a topic.
pub(crate) struct Writer(rustdds::no_key::DataWriter<Bytes, Raw>);

/// Reader or writer of any participant.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) struct Endpoint {
    pub(crate) topic: String,
    pub(crate) type_name: String,
    /// True if it is reliable, and if it keeps the last message for late readers.
    pub(crate) reliable: bool,
    pub(crate) latched: bool,
}

/// Reader or writer of the driver.
#[derive(Clone, Debug)]
pub(crate) struct OwnEndpoint {
    pub(crate) endpoint: Endpoint,
    pub(crate) is_writer: bool,
}

impl OwnEndpoint {
    /// Endpoint of the driver with names as DDS has them.
    pub(crate) fn new(topic: &str, type_name: &str, quality: Quality, is_writer: bool) -> Self {
        let [reliable, latched] = quality.policy();
        let (topic, type_name) = (topic.to_owned(), type_name.to_owned());
        Self { endpoint: Endpoint { topic, type_name, reliable, latched }, is_writer }
    }
}

impl Endpoint {
    /// Endpoint that was discovered. Participants leave out what is the default of DDS: writers are reliable,
    /// readers are not, and nothing is kept.
    fn of([topic, type_name]: [String; 2], policies: &QosPolicies, is_writer: bool) -> Self {
        let is_reliable = |kind| matches!(kind, Reliability::Reliable { .. });
        let reliable = policies.reliability().map_or(is_writer, is_reliable);
        let latched = policies.durability().is_some_and(|kind| kind >= Durability::TransientLocal);
        Self { topic, type_name, reliable, latched }
    }
}

impl Dds {
    /// Joins a domain. Messages of all subscriptions go to `sender`. With addresses, only the networks that
    /// have them are used.
    ///
    /// # Errors
    ///
    /// Why DDS cannot start, such as ports that are taken.
    pub(crate) fn join(domain: u16, networks: &[IpAddr], sender: Sender<Received>) -> Result<Self, String> {
        let wrong =
            |what: &str, error: &dyn std::fmt::Display| format!("{what} of DDS domain {domain}: {error}");
        let mut builder = DomainParticipantBuilder::new(domain);
        if !networks.is_empty() {
            builder = builder.with_only_networks(networks.iter().copied());
        }
        let participant = builder.build().map_err(|error| wrong("a participant", &error))?;
        let policies = Quality::Reliable.policies();
        let publisher =
            participant.create_publisher(&policies).map_err(|error| wrong("a publisher", &error))?;
        let subscriber =
            participant.create_subscriber(&policies).map_err(|error| wrong("a subscriber", &error))?;
        let pool = ThreadPool::builder().pool_size(1).name_prefix("dds-").create();
        let pool = pool.map_err(|error| format!("a thread for DDS: {error}"))?;
        let (status, streams) = (participant.status_listener(), Mutex::default());
        Ok(Self { participant, publisher, subscriber, pool, sender, status, streams })
    }

    /// Writer of a topic.
    ///
    /// # Errors
    ///
    /// Why DDS refuses it.
    pub(crate) fn publish(&self, topic: &str, type_name: &str, quality: Quality) -> Result<Writer, String> {
        let policies = quality.policies();
        let own = self.topic(topic, type_name, &policies)?;
        let writer = self.publisher.create_datawriter_no_key::<Bytes, Raw>(&own, Some(policies));
        writer.map(Writer).map_err(|error| format!("a writer of `{topic}`: {error}"))
    }

    /// Sends the messages of a topic to the channel, with the number of the subscription.
    ///
    /// # Errors
    ///
    /// Why DDS refuses it.
    pub(crate) fn subscribe(
        &self,
        topic: &str,
        type_name: &str,
        quality: Quality,
        source: Source,
    ) -> Result<(), String> {
        let policies = quality.policies();
        let own = self.topic(topic, type_name, &policies)?;
        let reader = self.subscriber.create_datareader_no_key::<Bytes, Raw>(&own, Some(policies));
        let reader = reader.map_err(|error| format!("a reader of `{topic}`: {error}"))?;
        let sender = self.sender.clone();
        let (stream, handle) = abortable(async move {
            let mut samples = reader.async_sample_stream();
            while let Some(sample) = samples.next().await {
                // A sample that cannot be read is left out; a reliable writer sends it again.
                let Ok(sample) = sample else { continue };
                let related = sample.sample_info().related_sample_identity().map(request);
                let identity = request(sample.sample_info().sample_identity());
                let (at, bytes) = (Instant::now(), sample.into_value());
                let received = Received { source, answers: related, identity, at, bytes };
                if sender.send(received).is_err() {
                    return;
                }
            }
        });
        self.streams.lock().unwrap_or_else(PoisonError::into_inner).push(handle);
        self.pool.spawn_ok(async move {
            // The end of a stream says nothing.
            let _ = stream.await;
        });
        Ok(())
    }

    /// Participants with a writer of one of these topics.
    #[must_use]
    pub(crate) fn peers(&self, topics: &[String]) -> HashSet<String> {
        let writers = self.participant.discovered_writers().into_iter();
        let own = writers.filter(|writer| topics.contains(&writer.publication_topic_data.topic_name));
        own.map(|writer| format!("{:?}", writer.writer_proxy.remote_writer_guid.prefix)).collect()
    }

    /// True if one of these participants has not been heard of for the time of its lease. If it comes back,
    /// this one does not match its endpoints again: only a new participant does.
    #[must_use]
    pub(crate) fn has_lost(&self, peers: &HashSet<String>) -> bool {
        let mut is_lost = false;
        while let Some(event) = self.status.try_recv_status() {
            if let DomainParticipantStatusEvent::ParticipantLost { id, reason } = event {
                is_lost |= peers.contains(&format!("{id:?}")) && matches!(reason, LostReason::Timeout { .. });
            }
        }
        is_lost
    }

    /// Readers of other participants that DDS has discovered, in order.
    #[must_use]
    pub(crate) fn readers(&self) -> Vec<Endpoint> {
        let own = self.participant.guid_prefix();
        let readers = self.participant.discovered_readers().into_iter();
        let others = readers.filter(|reader| reader.reader_proxy.remote_reader_guid.prefix != own);
        let mut readers: Vec<Endpoint> = others
            .map(|reader| {
                let data = reader.subscription_topic_data;
                Endpoint::of([data.topic_name(), data.type_name()].map(Clone::clone), &data.qos(), false)
            })
            .collect();
        readers.sort();
        readers
    }

    /// Writers of other participants that DDS has discovered, in order.
    #[must_use]
    pub(crate) fn writers(&self) -> Vec<Endpoint> {
        let own = self.participant.guid_prefix();
        let writers = self.participant.discovered_writers().into_iter();
        let others = writers.filter(|writer| writer.writer_proxy.remote_writer_guid.prefix != own);
        let mut writers: Vec<Endpoint> = others
            .map(|writer| {
                let data = writer.publication_topic_data;
                let policies = data.qos();
                Endpoint::of([data.topic_name, data.type_name], &policies, true)
            })
            .collect();
        writers.sort();
        writers
    }

    fn topic(&self, name: &str, type_name: &str, policies: &QosPolicies) -> Result<Topic, String> {
        let topic =
            self.participant.create_topic(name.to_owned(), type_name.to_owned(), policies, TopicKind::NoKey);
        topic.map_err(|error| format!("the topic `{name}`: {error}"))
    }
}

impl Writer {
    /// Sends a message; the identity that an answer may have. `answers` is the request that this one answers.
    ///
    /// # Errors
    ///
    /// Why DDS did not take it, such as a receiver that does not keep up.
    pub(crate) fn write(&self, bytes: Vec<u8>, answers: Option<Request>) -> Result<Request, String> {
        let related = answers.map(|(writer, number)| SampleIdentity {
            writer_guid: rustdds::GUID::from_bytes(writer),
            sequence_number: number.into(),
        });
        let options = WriteOptionsBuilder::new().related_sample_identity_opt(related).build();
        let written = self.0.write_with_options(bytes.into(), options);
        written.map(request).map_err(|error| format!("DDS did not take a message: {error}"))
    }
}

fn request(identity: SampleIdentity) -> Request {
    (identity.writer_guid.to_bytes(), identity.sequence_number.into())
}

/// Name of a topic in DDS: `rt` for topics, `rq` and `rr` for requests and responses of services.
#[must_use]
pub(crate) fn dds_topic(prefix: &str, name: &str, end: &str) -> String {
    format!("{prefix}/{}{end}", name.trim_start_matches('/'))
}

/// Name of a type in DDS, of `kind` `msg`, `srv` or `action`: `std_msgs::msg::dds_::Bool_`.
#[must_use]
pub(crate) fn dds_type(name: &str, kind: &str, end: &str) -> String {
    let (package, own) = name.split_once('/').unwrap_or(("", name));
    format!("{package}::{kind}::dds_::{own}{end}_")
}

/// Adapter of DDS that leaves the bytes as they are.
pub(crate) struct Raw;

/// Decoder of [`Raw`].
#[derive(Clone)]
pub(crate) struct RawDecoder;

impl DeserializerAdapter<Bytes> for Raw {
    type Error = Infallible;
    type Decoded = Bytes;

    fn supported_encodings() -> &'static [RepresentationIdentifier] {
        &[RepresentationIdentifier::CDR_LE]
    }

    fn transform_decoded(decoded: Bytes) -> Bytes {
        decoded
    }
}

impl DefaultDecoder<Bytes> for Raw {
    type Decoder = RawDecoder;

    const DECODER: RawDecoder = RawDecoder;
}

impl Decode<'_, Bytes> for RawDecoder {
    type Error = Infallible;

    fn decode_bytes(self, bytes: &[u8], _: RepresentationIdentifier) -> Result<Bytes, Infallible> {
        Ok(Bytes::copy_from_slice(bytes))
    }
}

impl SerializerAdapter<Bytes> for Raw {
    type Error = Infallible;

    fn output_encoding() -> RepresentationIdentifier {
        RepresentationIdentifier::CDR_LE
    }

    fn to_bytes(value: &Bytes) -> Result<Bytes, Infallible> {
        Ok(value.clone())
    }
}
