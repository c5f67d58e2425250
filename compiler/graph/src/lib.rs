#![doc = include_str!("../README.md")]

pub mod draw;
pub mod encode;
pub mod model;
pub mod python;
mod spoken;
pub mod validate;

pub use encode::{DecodeError, GraphDocument, decode, encode, hash};
pub use model::*;
pub use spoken::spoken;
pub use validate::{InvalidGraph, InvalidReason, validate};
