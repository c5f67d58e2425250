#![doc = include_str!("../README.md")]

mod error;
mod fault_names;
pub mod files;
mod project;
mod robot;
mod robot_body;
mod saved;
mod simulation;
mod stance;

pub use error::{DiagnosticSink, Discard, ProjectError, reason, require};
pub use project::{
    DOCUMENT, Project, ProjectBuilder, ProjectSession, SessionInputs, named_robot, open_robot, read_scene,
};
pub use robot::{RobotFiles, robot_names};
pub use saved::{SavedAddress, SavedDriver, SavedProject, SavedSimulator};
pub use simulation::SimulationInputs;
pub use stance::find_stance;
