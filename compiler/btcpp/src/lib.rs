#![doc = include_str!("../README.md")]

mod element;
mod errors;
mod export;
mod import;
mod names;
mod vocabulary;

pub use errors::CODES;
pub use export::export;
pub use import::import;
pub use vocabulary::{NodeSignature, PortType, Vocabulary};
