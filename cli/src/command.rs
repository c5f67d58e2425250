//! The commands, one file each.

pub mod check;
pub mod compile;
pub mod completions;
pub mod explain;
pub mod fmt;
pub mod robots;
pub mod run;
pub mod schema;
