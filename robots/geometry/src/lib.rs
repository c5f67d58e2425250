#![doc = include_str!("../README.md")]

pub mod collision;
pub mod inverse;
pub mod kinematics;
pub mod mjcf;
pub mod planning;
mod simd;
mod trigonometry;

pub use kinematics::{Dof, KinematicTree};
