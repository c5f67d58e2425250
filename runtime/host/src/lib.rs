#![doc = include_str!("../README.md")]

pub mod journal;
pub mod mcap;
pub mod remote;
