//! What a language model may write next, from the same signatures that the compiler checks against.
//!
//! [`surface`] defines the **model surface**: of each form the one spelling that a model writes, and [`canonical()`]
//! prints a policy in it. Nothing here reads a file, a clock or the network.

pub mod canonical;
pub mod surface;

pub use canonical::{Outside, canonical, complete};
pub use surface::{Modifiers, Surface};
