//! A kinematic world that implements the engine's driver: a robot drives along straight lines, picks and places, opens and
//! closes, looks and asks, in virtual time and the same way each time.
//!
//! It is no physics: nothing falls over, nothing collides, and what a primitive does it does at its end. [`Sim`] is the
//! driver, [`Faults`] what goes wrong.
//!
//! Inside: `world`, `thing` and `body` are what is the case, filled from card, scene and state by `build` and `told`;
//! `motion`, `hand`, `perception` and `people` are what can be done; `observe` answers queries; `camera` takes pictures; `deed` and `task` make a
//! command a run of stages; `faults` and `fate` are what goes wrong; `sim` and `driver` move time.

mod body;
mod build;
mod camera;
mod deed;
mod driver;
mod eyes;
mod fate;
mod faults;
mod hand;
mod motion;
mod observe;
mod options;
mod people;
mod perception;
mod random;
mod sim;
mod task;
mod thing;
mod told;
mod world;

pub use body::Stance;
pub use faults::{CallEnd, CallFault, Change, Destination, Faults, FaultsError, WorldChange};
pub use options::{Options, Script};
pub use sim::Sim;
