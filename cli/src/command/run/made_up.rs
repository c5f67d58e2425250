//! Failure kinds that a driver made up: the graph does not name them, and records of a run only have their numbers.

use std::collections::BTreeMap;

use motet_graph::draw::Names;
use motet_graph::{FailureId, Graph};
use motet_runtime::{DriverEvent, Event, Outcome};

/// The names of failure kinds, from the events in which a driver said them.
#[derive(Debug, Default)]
pub(super) struct MadeUp {
    heard: Option<String>,
    known: BTreeMap<usize, String>,
}

impl MadeUp {
    /// Hears an event before the engine handles it.
    pub(super) fn hear(&mut self, event: &Event) {
        self.heard = match event {
            Event::Driver(
                DriverEvent::Ended { outcome: Outcome::Failure(kind), .. }
                | DriverEvent::Refused { failure: kind, .. },
            ) => Some(kind.to_string()),
            _ => None,
        };
    }

    /// The name of a failure kind: the graph's, or what the driver called it when its number first came up.
    pub(super) fn name(&mut self, graph: &Graph, kind: FailureId) -> String {
        if kind.index() < graph.failures.len() {
            return Names(graph).failure(kind).to_owned();
        }
        let heard = self.heard.clone();
        match heard {
            Some(heard) => self.known.entry(kind.index()).or_insert(heard).clone(),
            None => self.known.get(&kind.index()).map_or_else(|| "?".to_owned(), String::clone),
        }
    }
}
