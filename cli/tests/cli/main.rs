//! The command from outside: the built binary is run as a user runs it. One program, so that it is linked
//! once.

mod check;
mod commands;
mod crash;
mod dataset;
mod decode;
mod dialog;
mod drive;
mod fmt;
mod grammar;
mod import;
mod journal;
mod model;
mod run;
mod support;
