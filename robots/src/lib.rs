#![doc = include_str!("../README.md")]

pub mod builtin;
pub mod card;
pub mod clearance;
pub mod import;
pub mod mesh;
pub mod quaternion;
pub mod scene;
pub mod srdf;
pub mod urdf;
pub mod xacro;
