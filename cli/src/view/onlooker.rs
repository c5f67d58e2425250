//! Observer of a run that goes on: it hands entries and motion to the page, and the wishes of the page's
//! operator to the run.

use std::sync::Arc;

use motet::page::entries::EntryTracker;
use motet_graph::Graph;
use motet_runtime::journal::{JournalEntry, JournalHead};
use motet_runtime::{
    CameraImage, Effect, Event, Moved, Observer, RetiredGraph, RunControl, SwapRefusal, Time,
};

use super::live::SharedPage;
use crate::interrupt::SLICE;

/// Observer that shows a run on a page, and lets another one look on.
pub(crate) struct PageObserver<'a> {
    page: SharedPage,
    inner: &'a mut dyn Observer,
    entries: EntryTracker,
}

impl<'a> PageObserver<'a> {
    /// Observer of a run with this head.
    pub(crate) fn new(page: SharedPage, inner: &'a mut dyn Observer, head: JournalHead) -> Self {
        page.borrow_mut().begin(JournalEntry::Head(Box::new(head)));
        Self { page, inner, entries: EntryTracker::from(1) }
    }

    /// Observer of a run whose earlier entries the page has.
    pub(crate) fn resumed(page: SharedPage, inner: &'a mut dyn Observer, seq: u64) -> Self {
        Self { page, inner, entries: EntryTracker::from(seq) }
    }
}

impl Observer for PageObserver<'_> {
    fn inner(&mut self) -> Option<&mut dyn Observer> {
        Some(self.inner)
    }

    fn event(&mut self, now: Time, event: &Event) {
        self.entries.event(event);
        self.inner.event(now, event);
    }

    fn commit(&mut self, now: Time, effects: &[Effect]) -> RunControl {
        if let Some((seq, entry)) = self.entries.commit(now, effects) {
            self.page.borrow_mut().entry(seq, &entry);
        }
        self.inner.commit(now, effects)
    }

    fn reached(&mut self, now: Time) -> RunControl {
        let inner = self.inner.reached(now);
        if inner != RunControl::Continue {
            return inner;
        }
        let hub = self.page.borrow().hub();
        if hub.is_held() {
            // Time of a simulation may pass at any speed, and a person needs a moment.
            std::thread::sleep(SLICE);
        }
        hub.wish()
    }

    fn wants_telemetry(&self) -> bool {
        true
    }

    fn wants_picture(&self) -> bool {
        self.page.borrow().hub().sight.is_due() || self.inner.wants_picture()
    }

    fn pictured(&mut self, image: Option<CameraImage>) {
        self.page.borrow().hub().sight.take(image.clone());
        self.inner.pictured(image);
    }

    fn moved(&mut self, moved: &Moved) {
        self.page.borrow_mut().moved(moved);
        self.inner.moved(moved);
    }

    fn swapped(&mut self, now: Time, graph: &Arc<Graph>, result: Result<RetiredGraph, SwapRefusal>) {
        self.entries.swapped(graph, result.is_ok());
        self.inner.swapped(now, graph, result);
    }

    fn at_least_every(&self) -> Time {
        self.inner.at_least_every()
    }

    fn glance_every(&self) -> Time {
        self.inner.glance_every()
    }
}
