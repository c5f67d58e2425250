//! View of a run as JSON events, one object per line, for tools.

use std::sync::Arc;

use motet::run::events::RunEvents;
use motet_graph::Graph;
use motet_runtime::{Effect, Event, RunEnd, Time};

use super::View;
use crate::output::Output;

/// View that prints each event as JSON.
pub(super) struct Events {
    events: RunEvents,
    out: Output,
}

impl Events {
    pub(super) fn new(graph: Arc<Graph>) -> Self {
        Self { events: RunEvents::new(graph), out: Output::default() }
    }
}

impl View for Events {
    fn event(&mut self, event: &Event) {
        self.events.event(event);
    }

    fn effect(&mut self, now: Time, effect: &Effect) {
        if let Some(line) = self.events.effect(now, effect) {
            self.out.json_line(&line);
        }
    }

    fn past(&mut self, _now: Time, _effect: &Effect) {}

    fn reached(&mut self, _now: Time) {}

    fn is_closed(&self) -> bool {
        self.out.is_closed()
    }

    fn finish(&mut self, now: Time, end: &RunEnd) {
        self.out.json_line(&self.events.finish(now, end));
    }
}
