#![doc = include_str!("../README.md")]

mod checker;
mod commands;
mod convert;
mod documents;
mod editor;
mod library;
mod lines;
mod protocol;
mod server;
mod transport;
mod workspace;

pub use server::{ServerEnd, serve};
pub use workspace::OpenFolder;
