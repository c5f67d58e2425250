//! What the tests share: adapters that turn other people's data into ordinary policies and scenes, and helpers that run
//! them through every stage. No verdict is made here.

pub mod eval;
pub mod generate;
pub mod saycan;

pub mod setup;
