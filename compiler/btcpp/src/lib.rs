#![doc = include_str!("../README.md")]

mod export;
mod names;
mod xml;

pub use export::{NoNode, export};
