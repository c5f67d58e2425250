//! Writes down a run while it goes on.

use super::motion::MotionFile;
use super::{JournalError, JournalWriter};
use motet_graph::Graph;
use motet_runtime::journal::must_be_durable;
use motet_runtime::{Effect, Event, Moved, Observer, RetiredGraph, RunControl, SwapRefusal, Time};
use std::sync::Arc;

/// An observer that writes a journal and then lets another one look on. Where the journal cannot be written,
/// the run is stopped before anything else starts; [`RunRecorder::finish`] tells why.
pub struct RunRecorder<'a> {
    writer: JournalWriter,
    inner: &'a mut dyn Observer,
    cause: Option<Cause>,
    error: Option<JournalError>,
    motion: Option<MotionFile>,
}

/// Cause of the next effects.
enum Cause {
    Event(Event),
    Swap(Arc<Graph>),
    /// Nothing follows from it.
    RefusedSwap,
}

impl<'a> RunRecorder<'a> {
    /// Writes to a journal and looks on with another one.
    pub fn new(writer: JournalWriter, inner: &'a mut dyn Observer) -> Self {
        Self { writer, inner, cause: None, error: None, motion: None }
    }

    /// Writes telemetry beside the journal, too. A run whose driver can be simulated again needs none.
    #[must_use]
    pub fn with_motion(mut self) -> Self {
        self.motion = MotionFile::open(self.writer.folder());
        self
    }

    /// Waits until everything is on disk.
    ///
    /// # Errors
    ///
    /// Why the journal could not be written, if it could not at any time: it is then not whole.
    pub fn finish(mut self) -> Result<(), JournalError> {
        match self.error.take() {
            Some(error) => Err(error),
            None => self.writer.sync(),
        }
    }

    fn write(&mut self, now: Time, effects: &[Effect]) -> Result<(), JournalError> {
        let cause = self.cause.take();
        let is_swap = match &cause {
            Some(Cause::RefusedSwap) => return Ok(()),
            Some(Cause::Swap(_)) => true,
            Some(Cause::Event(_)) | None => false,
        };
        self.writer.append(|chain| match &cause {
            Some(Cause::Event(event)) => chain.step(now, event, effects),
            Some(Cause::Swap(graph)) => chain.swap(now, graph, effects),
            Some(Cause::RefusedSwap) | None => chain.gave_up(now, effects),
        })?;
        if is_swap || must_be_durable(effects) { self.writer.sync() } else { self.writer.sync_group() }
    }
}

impl Observer for RunRecorder<'_> {
    fn inner(&mut self) -> Option<&mut dyn Observer> {
        Some(self.inner)
    }

    fn event(&mut self, now: Time, event: &Event) {
        self.cause = Some(Cause::Event(event.clone()));
        self.inner.event(now, event);
    }

    fn commit(&mut self, now: Time, effects: &[Effect]) -> RunControl {
        if self.error.is_none() {
            self.error = self.write(now, effects).err();
        }
        let inner = self.inner.commit(now, effects);
        if self.error.is_some() { RunControl::Stop } else { inner }
    }

    fn reached(&mut self, now: Time) -> RunControl {
        if self.error.is_none() {
            self.error = self.writer.sync_group().err();
        }
        let inner = self.inner.reached(now);
        if self.error.is_some() { RunControl::Stop } else { inner }
    }

    fn wants_telemetry(&self) -> bool {
        self.motion.is_some() || self.inner.wants_telemetry()
    }

    fn wants_picture(&self) -> bool {
        self.inner.wants_picture()
    }

    fn moved(&mut self, moved: &Moved) {
        self.motion.iter_mut().for_each(|motion| motion.write(moved));
        self.inner.moved(moved);
    }

    fn swapped(&mut self, now: Time, graph: &Arc<Graph>, result: Result<RetiredGraph, SwapRefusal>) {
        let took_over = result.is_ok();
        self.cause = Some(if took_over { Cause::Swap(Arc::clone(graph)) } else { Cause::RefusedSwap });
        self.inner.swapped(now, graph, result);
    }

    fn at_least_every(&self) -> Time {
        self.inner.at_least_every()
    }

    fn glance_every(&self) -> Time {
        self.inner.glance_every()
    }
}
