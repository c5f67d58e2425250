#![doc = include_str!("../README.md")]

mod config;
mod error;
pub mod files;
mod project;
mod robot;
mod saved;
mod simulation;
mod touching;

pub use config::{CONFIG, find_config, read_config};
pub use error::{DiagnosticSink, Discard, ProjectError, reason, require};
pub use project::{
    DOCUMENT, Project, ProjectBuilder, ProjectSession, SessionInputs, named_robot, open_robot, read_scene,
    read_state_into,
};
pub use robot::{RobotFiles, find_stance, robot_names};
pub use saved::{SavedAddress, SavedDriver, SavedProject, SavedSimulator};
pub use simulation::{SimulationInputs, read_profile};
pub use touching::{Touching, touching};
