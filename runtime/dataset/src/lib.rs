#![doc = include_str!("../README.md")]

pub mod case;
pub mod coverage;
pub mod format;
pub mod generate;
mod kept;
pub mod lesson;
pub mod lint;
pub mod picture;
mod play;
mod random;
mod sampling;
pub mod scenery;
mod testbed;
pub mod wordings;

pub use format::{About, Row};
pub use testbed::{Body, Posture, Testbed};
