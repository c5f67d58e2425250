//! The vocabularies that tiktoken ships.

use tiktoken_rs::CoreBPE;

use super::{Vocabulary, VocabularyError};

/// A vocabulary of OpenAI's models.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Encoding {
    /// Of GPT-3.5 and GPT-4: 100,277 tokens.
    Cl100k,
    /// Of GPT-4o and later: 200,019 tokens.
    O200k,
}

impl Encoding {
    /// The encoding of that name: `cl100k` or `o200k`, with or without `_base`.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        match name.strip_suffix("_base").unwrap_or(name) {
            "cl100k" => Some(Self::Cl100k),
            "o200k" => Some(Self::O200k),
            _ => None,
        }
    }

    /// How many tokens have bytes, how many there are with the special ones, and which ends a text.
    fn numbers(self) -> (u32, u32, u32) {
        match self {
            Self::Cl100k => (100_256, 100_277, 100_257),
            Self::O200k => (199_998, 200_019, 199_999),
        }
    }

    /// Splits texts into tokens.
    #[must_use]
    pub fn tokenizer(self) -> &'static CoreBPE {
        match self {
            Self::Cl100k => tiktoken_rs::cl100k_base_singleton(),
            Self::O200k => tiktoken_rs::o200k_base_singleton(),
        }
    }
}

impl Vocabulary {
    /// The vocabulary of an encoding; `<|endoftext|>` ends a sequence. Takes about half a second.
    ///
    /// # Errors
    ///
    /// None is known of the encodings as they are shipped.
    pub fn of_encoding(encoding: Encoding) -> Result<Self, VocabularyError> {
        let (ordinary, all, end) = encoding.numbers();
        let tokenizer = encoding.tokenizer();
        // A number that no token has is like a special one: never allowed.
        let bytes = |token| tokenizer.decode_bytes(&[token]).unwrap_or_default();
        let tokens = (0..all).map(|token| if token < ordinary { bytes(token) } else { Vec::new() });
        Self::from_tokens(tokens.collect(), end)
    }
}
