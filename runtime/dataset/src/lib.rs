//! Instruction–policy pairs for fine-tuning: made in simulation, verified, written as trainers read them,
//! and linted.
//!
//! [`generate`] varies rooms ([`scenery`]), draws [`cases`](case) from wordings, and plays each with the
//! planner that needs
//! no model: every turn of the conversation in which a model would be asked becomes a [`Row`]. A row is
//! kept only where its
//! plan passes [`Stage::fault`], which checks it, looks for its motions and runs it. [`form`] writes rows
//! and reads them
//! back; [`lint`] finds what is wrong with a file of them, whoever wrote it.
//!
//! Nothing here reads a file, a clock or the network; randomness comes from a seed.

pub mod case;
pub mod form;
pub mod generate;
pub mod lint;
mod mind;
pub mod picture;
mod play;
mod random;
mod row;
pub mod scenery;
mod stage;
pub mod wordings;

pub use random::Draw;
pub use row::{About, Row};
pub use stage::{Body, Stage};
