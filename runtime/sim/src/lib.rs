//! A kinematic world that implements the engine's driver: a robot drives along straight lines, picks and places, opens and
//! closes, looks and asks, in virtual time and the same way each time.
//!
//! It is no physics: nothing falls over, nothing collides, and what a primitive does it does at its end. [`Sim`] is the
//! driver, [`Faults`] what goes wrong.
//!
//! Inside: `world`, `thing` and `body` are what is the case, filled from card, scene and state by `build` and `told`;
//! `motion`, `hand`, `perception` and `people` are what can be done; `observe` answers queries; `camera` takes pictures; `command` and `task` make a
//! command a run of stages; `faults` and `fate` are what goes wrong; `sim` and `driver` move time.

mod body;
mod camera;
mod command;
mod driver;
mod fault_schedule;
mod faults;
mod hand;
mod initial_facts;
mod motion;
mod observation;
mod options;
mod people;
mod perception;
mod random;
mod sim;
mod task;
mod thing;
mod visibility;
mod world;
mod world_setup;

pub use body::BasePose;
pub use faults::{CallFault, CallFaultKind, Destination, Faults, FaultsError, WorldChange, WorldEvent};
pub use options::{PersonScript, SimOptions};
pub use sim::Sim;
