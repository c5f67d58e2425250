#![doc = include_str!("../README.md")]

mod diagnostics;
mod export;
mod import;
mod leaves;
mod names;
mod xml;

pub use diagnostics::CODES;
pub use export::{NoNode, export};
pub use import::{MAX_IMPORTED_STEPS, MAX_XML_NODES, import};
pub use leaves::{ActionLeaf, Leaves, PortType, Ports};
