//! Subcommands, one file each: flags, help and implementation; a folder of the same name holds the parts of
//! a large one.

pub(crate) mod check;
pub(crate) mod compile;
pub(crate) mod completions;
pub(crate) mod dataset;
pub(crate) mod decode;
pub(crate) mod dialog;
pub(crate) mod r#do;
pub(crate) mod explain;
pub(crate) mod export;
pub(crate) mod feasible;
pub(crate) mod fmt;
pub(crate) mod grammar;
pub(crate) mod import;
pub(crate) mod lsp;
pub(crate) mod mcp;
pub(crate) mod new;
pub(crate) mod plan;
pub(crate) mod prompt;
pub(crate) mod replay;
pub(crate) mod robots;
pub(crate) mod run;
pub(crate) mod scenes;
pub(crate) mod schema;
pub(crate) mod serve;
pub(crate) mod talk;
pub(crate) mod view;
