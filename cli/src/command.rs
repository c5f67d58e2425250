//! The commands, one file each.

pub mod check;
// TMP pub mod compile;
pub mod completions;
pub mod explain;
// TMP pub mod fmt;
pub mod robots;
// TMP pub mod run;
pub mod schema;
