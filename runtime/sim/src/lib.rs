#![doc = include_str!("../README.md")]

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
