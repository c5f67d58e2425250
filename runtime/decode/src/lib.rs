#![doc = include_str!("../README.md")]

mod acceptor;
mod automaton;
pub mod canonical;
pub mod environment;
pub mod export;
mod grammar;
pub mod subset;
pub mod vocabulary;

pub use acceptor::{Acceptor, AcceptorFactory, Decoder};
pub use canonical::{OutsideSubset, canonical};
pub use environment::{Environment, EnvironmentError};
pub use grammar::Grammar;
pub use motet_compiler::Session;
pub use subset::{Modifiers, Subset};
pub use vocabulary::{EndToken, Vocabulary, VocabularyError};
