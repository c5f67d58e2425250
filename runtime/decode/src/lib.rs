//! What a language model may write next, from the same signatures that the compiler checks against.
//!
//! [`surface`] defines the **model surface**: of each form the one spelling that a model writes, and [`canonical()`]
//! prints a policy in it. [`export`] writes grammars of it that servers hold a model to. [`Acceptor`] says byte by byte
//! what may follow in a policy that is being written, and [`Decoder`] token by token. Nothing here reads a file, a clock
//! or the network.

mod acceptor;
pub mod canonical;
pub mod export;
mod program;
pub mod surface;
pub mod vocabulary;
pub mod world;

pub use acceptor::{Acceptor, Decoder, Prepared};
pub use canonical::{Outside, canonical, complete};
pub use motet_compiler::Session;
pub use surface::{Modifiers, Surface};
pub use vocabulary::{End, Vocabulary, VocabularyError};
pub use world::{World, WorldError};
