#![doc = include_str!("../README.md")]

mod act;
mod body;
mod camera;
mod chance;
mod command;
mod driver;
mod failure;
mod faults;
mod hand;
mod motion;
mod observation;
mod pedestrian;
mod people;
mod perception;
mod profile;
mod route;
mod sight;
mod sim;
mod stage;
mod task;
mod telemetry;
mod world;
mod world_setup;

pub use body::BasePose;
pub use faults::{CallFault, CallFaultKind, Destination, Faults, FaultsError, WorldChange, WorldEvent};
pub use profile::{BaseRates, CameraRates, HandRates, PeopleRates, Profile, ProfileError, RoomRates};
pub use sim::{PersonScript, Sim, SimOptions};
