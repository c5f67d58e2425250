#![doc = include_str!("../README.md")]

mod body;
mod camera;
mod command;
mod driver;
mod faults;
mod hand;
mod motion;
mod observation;
mod people;
mod perception;
mod sim;
mod task;
mod world;
mod world_setup;

pub use body::BasePose;
pub use faults::{CallFault, CallFaultKind, Destination, Faults, FaultsError, WorldChange, WorldEvent};
pub use sim::{PersonScript, Sim, SimOptions};
