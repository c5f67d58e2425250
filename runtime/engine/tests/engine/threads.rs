//! Thread-safety of the public types, checked when this compiles.

use motet_graph::{Graph, GraphDocument};
use motet_runtime::journal::{EngineReplay, JournalEntry};
use motet_runtime::memory::Memory;
use motet_runtime::{
    DeferredMotion, Driver, DriverEvent, Effect, Engine, Event, PreparedSwap, RetiredGraph, RunningGraph,
    Snapshot, StartState,
};
use std::cell::RefCell;
use std::rc::Rc;

#[test]
fn engine_types_are_send_and_sync() {
    fn is_send_and_sync<T: Send + Sync + 'static>() {}
    is_send_and_sync::<Engine>();
    is_send_and_sync::<(Graph, GraphDocument, StartState, Snapshot)>();
    is_send_and_sync::<(Event, DriverEvent, Effect, DeferredMotion)>();
    is_send_and_sync::<(RunningGraph, PreparedSwap, RetiredGraph)>();
    is_send_and_sync::<(JournalEntry, EngineReplay, Memory)>();
}

/// A driver need not be `Send`: a shared one is a driver too. Compiling this is the test.
#[allow(dead_code, reason = "checked when it compiles")]
fn shared_driver_is_a_driver<D: Driver>() {
    fn is_driver<D: Driver>() {}
    is_driver::<Rc<RefCell<D>>>();
}
