//! What a language model may write next, from the same signatures that the compiler checks against.
//!
//! [`subset`] defines the **model subset**: of each form the one spelling that a model writes, and [`canonical()`]
//! prints a policy in it. [`export`] writes grammars of it that servers hold a model to. [`Acceptor`] says byte by byte
//! what may follow in a policy that is being written, and [`Decoder`] token by token. Nothing here reads a file, a clock
//! or the network.

mod acceptor;
mod automaton;
pub mod canonical;
pub mod environment;
pub mod export;
pub mod subset;
pub mod vocabulary;

pub use acceptor::{Acceptor, AcceptorFactory, Decoder};
pub use canonical::{Outside, canonical, complete};
pub use environment::{Environment, EnvironmentError};
pub use motet_compiler::Session;
pub use subset::{Modifiers, Subset};
pub use vocabulary::{EndToken, Vocabulary, VocabularyError};
