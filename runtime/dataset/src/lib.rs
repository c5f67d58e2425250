#![doc = include_str!("../README.md")]

pub mod case;
mod deck;
pub mod format;
pub mod generate;
mod kept;
pub mod lesson;
pub mod lint;
pub mod picture;
mod play;
mod random;
pub mod scenery;
pub mod share;
mod stage;
pub mod wordings;

pub use format::{About, Row};
pub use stage::{Body, Posture, Stage};
