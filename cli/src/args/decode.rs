//! `motet decode`: what may follow in a policy that a model has begun.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::input::KnownArgs;

/// `motet decode`
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    printf '{\"motet\":1,' | motet decode - --robot hsr --scene kitchen\n  \
    motet decode begun.json --robot hsr --scene kitchen --explain\n  \
    motet decode begun.json --robot hsr --scene kitchen --tokenizer o200k\n\n\
    The beginning has the spelling of the model surface, without white space; a line break at its end is left out.\n\
    Exit codes: 0 a policy can begin like that, 1 none does, 2 could not run.")]
pub(crate) struct DecodeArgs {
    /// File with the beginning, or `-` for standard input
    #[arg(value_name = "FILE", default_value = "-")]
    pub(crate) path: PathBuf,
    /// For which robot and room.
    #[command(flatten)]
    pub(crate) known: KnownArgs,
    /// Say in words what may follow, and why the rest may not
    #[arg(long)]
    pub(crate) explain: bool,
    /// Show the tokens of a vocabulary that may follow: `cl100k`, `o200k`, or a file: tokenizer.json, a list in JSON, or lines in
    /// base64
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) tokenizer: Option<String>,
    /// The token that ends a sequence, by its name or its number; needed where the file does not tell
    #[arg(long, value_name = "TOKEN", requires = "tokenizer")]
    pub(crate) end: Option<String>,
    /// The form that is written
    #[arg(long, value_enum, default_value_t, value_name = "FORM")]
    pub(crate) surface: DecodeForm,
    /// Deadlines and retries have a place
    #[arg(long)]
    pub(crate) modifiers: bool,
    /// The most bytes of the whole policy
    #[arg(long, default_value_t = 20_000, value_name = "BYTES")]
    pub(crate) budget: usize,
}

/// A form of the model surface that can be followed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, ValueEnum)]
pub(crate) enum DecodeForm {
    /// JSON
    #[default]
    Json,
    /// Text
    Text,
}
