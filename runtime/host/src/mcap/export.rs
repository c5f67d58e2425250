//! Writes the entries of a journal as messages.

use super::foxglove::{FrameTransforms, McapScene, SceneUpdate, flat_schema};
use mcap::records::MessageHeader;
use mcap::{McapError, WriteOptions, Writer};
use motet_graph::GraphDocument;
use motet_runtime::journal::{EngineReplay, JournalEntry, ReplayError};
use motet_runtime::{Effect, Event, Snapshot, Time};
use schemars::{JsonSchema, schema_for};
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::io::{Seek, Write};
use thiserror::Error;

/// A journal that cannot be exported.
#[derive(Debug, Error)]
pub enum ExportError {
    /// The file cannot be written.
    #[error("the MCAP file cannot be written: {0}")]
    Mcap(#[from] McapError),
    /// The engine does not take the journal.
    #[error("{0}")]
    Replay(#[from] ReplayError),
    /// A message cannot be written.
    #[error("a message cannot be written: {0}")]
    Json(#[from] serde_json::Error),
    /// The file has as many bytes as it may have.
    #[error("the file has {0} bytes")]
    Full(u64),
}

/// Limits of a file: a long run has very many states and pictures of its scene.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct McapLimits {
    /// Shortest time of the run between two states, and between two pictures of the scene. Events and effects
    /// are all written.
    pub every: Time,
    /// Number of bytes from which on nothing more is written.
    pub most_bytes: u64,
}

/// Writes an MCAP file. The engine is stepped along, for its states.
pub struct McapExporter<W: Write + Seek> {
    writer: Writer<W>,
    channels: Channels,
    replay: Option<EngineReplay>,
    began_unix_ns: u64,
    from: Time,
    revision: u32,
    sequence: u32,
    state: Option<Snapshot>,
    picture: Option<McapScene>,
    limits: McapLimits,
    bytes: u64,
    /// State and picture that came too soon after the last ones, with the times of both.
    waiting: Waiting,
}

/// State and picture that are written with the next ones, or at the end.
#[derive(Default)]
struct Waiting {
    last: Option<u64>,
    state: Option<(u64, u64, Snapshot)>,
    picture: Option<(u64, McapScene)>,
}

struct Channels {
    event: u16,
    effect: u16,
    graph: u16,
    state: u16,
    transforms: u16,
    scene: u16,
}

impl<W: Write + Seek> McapExporter<W> {
    /// An empty file. Chunks are not compressed.
    ///
    /// # Errors
    ///
    /// It cannot be written.
    pub fn new(out: W, limits: McapLimits) -> Result<Self, ExportError> {
        let library = format!("motet {}", env!("CARGO_PKG_VERSION"));
        let mut writer = WriteOptions::new().compression(None).library(library).create(out)?;
        let channels = Channels {
            event: own::<EventMessage>(&mut writer, "/motet/event", "motet.Event")?,
            effect: own::<EffectMessage>(&mut writer, "/motet/effect", "motet.Effect")?,
            graph: own::<GraphMessage>(&mut writer, "/motet/graph", "motet.Graph")?,
            state: own::<StateMessage>(&mut writer, "/motet/state", "motet.State")?,
            transforms: foxglove::<FrameTransforms>(&mut writer, "/tf", "foxglove.FrameTransforms")?,
            scene: foxglove::<SceneUpdate>(&mut writer, "/scene", "foxglove.SceneUpdate")?,
        };
        Ok(Self {
            writer,
            channels,
            replay: None,
            began_unix_ns: 0,
            from: Time::ZERO,
            revision: 0,
            sequence: 0,
            state: None,
            picture: None,
            limits,
            bytes: 0,
            waiting: Waiting::default(),
        })
    }

    /// Writes an entry, and the world after it where it is known.
    ///
    /// # Errors
    ///
    /// It cannot be written, or the engine does not take it. After [`ExportError::Full`] the file can be
    /// finished.
    pub fn entry(
        &mut self,
        seq: u64,
        entry: &JournalEntry,
        picture: Option<McapScene>,
    ) -> Result<(), ExportError> {
        let Some((at, effects)) = entry.happened() else { return Ok(()) };
        if let JournalEntry::Head(head) = entry {
            (self.began_unix_ns, self.from) = (head.began_unix_ns, head.from);
            self.replay = Some(EngineReplay::new(head)?);
        }
        let now = self.began_unix_ns.saturating_add(at.since(self.from).nanos());
        if self.bytes > self.limits.most_bytes {
            return Err(ExportError::Full(self.bytes));
        }
        match entry {
            JournalEntry::Head(head) => self.graph(now, seq, head.graph.clone())?,
            JournalEntry::Swap(swap) => {
                self.revision += 1;
                self.graph(now, seq, swap.graph.clone())?;
            }
            JournalEntry::Step(step) | JournalEntry::GaveUp(step) => {
                let event = EventMessage { seq, at, event: step.event.clone() };
                self.write(self.channels.event, now, &event)?;
            }
            JournalEntry::Resumed(_) => {}
        }
        for (index, effect) in (0..).zip(effects) {
            let message = EffectMessage { seq, index, at, effect: effect.clone() };
            self.write(self.channels.effect, now, &message)?;
        }
        if let Some(replay) = &mut self.replay {
            // Whether it differs is what `motet replay` tells.
            let _ = replay.take(entry)?;
            self.waiting.state = Some((now, seq, replay.engine().snapshot()));
        }
        if let Some(picture) = picture {
            self.waiting.picture = Some((now, picture));
        }
        let every = self.limits.every.nanos();
        if self.waiting.last.is_none_or(|last| now >= last.saturating_add(every)) {
            self.waiting.last = Some(now);
            self.write_waiting()?;
        }
        Ok(())
    }

    /// Writes the state and the picture that wait.
    fn write_waiting(&mut self) -> Result<(), ExportError> {
        if let Some((at, seq, state)) = self.waiting.state.take() {
            self.state(at, seq, state)?;
        }
        if let Some((at, picture)) = self.waiting.picture.take() {
            self.picture(at, picture)?;
        }
        Ok(())
    }

    /// Writes what stands at the end of a file.
    ///
    /// # Errors
    ///
    /// It cannot be written.
    pub fn finish(mut self) -> Result<(), ExportError> {
        self.write_waiting()?;
        self.writer.finish()?;
        Ok(())
    }

    fn graph(&mut self, now: u64, seq: u64, graph: GraphDocument) -> Result<(), ExportError> {
        let message = GraphMessage { seq, revision: self.revision, graph };
        self.write(self.channels.graph, now, &message)
    }

    /// A state, where more has changed than the time and the readings.
    fn state(&mut self, now: u64, seq: u64, state: Snapshot) -> Result<(), ExportError> {
        let same = self.state.as_ref().is_some_and(|last| {
            let (at, readings) = (state.at, state.readings.clone());
            Snapshot { at, readings, ..last.clone() } == state
        });
        if !same {
            self.state = Some(state.clone());
            self.write(self.channels.state, now, &StateMessage { seq, state })?;
        }
        Ok(())
    }

    fn picture(&mut self, now: u64, picture: McapScene) -> Result<(), ExportError> {
        let last = self.picture.as_ref();
        let (moved, changed) = (
            last.is_none_or(|last| last.base != picture.base),
            last.is_none_or(|last| last.bodies != picture.bodies),
        );
        if moved {
            self.write(self.channels.transforms, now, &picture.transforms(now))?;
        }
        if changed {
            self.write(self.channels.scene, now, &picture.scene(now))?;
        }
        self.picture = Some(picture);
        Ok(())
    }

    fn write(&mut self, channel_id: u16, now: u64, message: &impl Serialize) -> Result<(), ExportError> {
        let header = MessageHeader { channel_id, sequence: self.sequence, log_time: now, publish_time: now };
        self.sequence = self.sequence.wrapping_add(1);
        let message = serde_json::to_vec(message)?;
        self.bytes += message.len() as u64;
        self.writer.write_to_known_channel(&header, &message)?;
        Ok(())
    }
}

fn own<T: JsonSchema>(
    writer: &mut Writer<impl Write + Seek>,
    topic: &str,
    name: &str,
) -> Result<u16, ExportError> {
    channel(writer, topic, name, &serde_json::to_value(schema_for!(T))?)
}

fn foxglove<T: JsonSchema>(
    writer: &mut Writer<impl Write + Seek>,
    topic: &str,
    name: &str,
) -> Result<u16, ExportError> {
    channel(writer, topic, name, &flat_schema::<T>())
}

fn channel(
    writer: &mut Writer<impl Write + Seek>,
    topic: &str,
    name: &str,
    schema: &Value,
) -> Result<u16, ExportError> {
    let schema = writer.add_schema(name, "jsonschema", schema.to_string().as_bytes())?;
    Ok(writer.add_channel(schema, topic, "json", &BTreeMap::new())?)
}

#[derive(Serialize, JsonSchema)]
pub(super) struct EventMessage {
    /// The number of the journal's entry.
    pub(super) seq: u64,
    /// The engine's time in ns.
    pub(super) at: Time,
    /// The event; absent if the engine gave up.
    pub(super) event: Option<Event>,
}

#[derive(Serialize, JsonSchema)]
pub(super) struct EffectMessage {
    /// The number of the journal's entry.
    pub(super) seq: u64,
    /// The place among the entry's effects.
    pub(super) index: u32,
    /// The engine's time in ns.
    pub(super) at: Time,
    pub(super) effect: Effect,
}

/// On `/motet/graph`: at the beginning and at every swap.
#[derive(Serialize, JsonSchema)]
pub(super) struct GraphMessage {
    /// The number of the journal's entry.
    pub(super) seq: u64,
    /// The number of the graph.
    pub(super) revision: u32,
    pub(super) graph: GraphDocument,
}

/// On `/motet/state`: whenever what is believed, bound or running has changed.
#[derive(Serialize, JsonSchema)]
pub(super) struct StateMessage {
    /// The number of the journal's entry.
    pub(super) seq: u64,
    /// The state after it.
    pub(super) state: Snapshot,
}
