//! Vocabularies shipped with tiktoken.

use tiktoken_rs::CoreBPE;

use super::{Vocabulary, VocabularyError};

/// A vocabulary of OpenAI's models.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Encoding {
    /// GPT-3.5 and GPT-4: 100,277 tokens.
    Cl100k,
    /// GPT-4o and later: 200,019 tokens.
    O200k,
}

impl Encoding {
    /// The encoding with a name: `cl100k` or `o200k`, with or without `_base`.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        match name.strip_suffix("_base").unwrap_or(name) {
            "cl100k" => Some(Self::Cl100k),
            "o200k" => Some(Self::O200k),
            _ => None,
        }
    }

    /// The numbers of ordinary tokens, of all tokens, and of the end token.
    fn numbers(self) -> (u32, u32, u32) {
        match self {
            Self::Cl100k => (100_256, 100_277, 100_257),
            Self::O200k => (199_998, 200_019, 199_999),
        }
    }

    /// The tokenizer, which splits texts into tokens.
    #[must_use]
    pub fn tokenizer(self) -> &'static CoreBPE {
        match self {
            Self::Cl100k => tiktoken_rs::cl100k_base_singleton(),
            Self::O200k => tiktoken_rs::o200k_base_singleton(),
        }
    }
}

impl Vocabulary {
    /// Builds the vocabulary of an encoding; `<|endoftext|>` ends a sequence. Takes about half a second.
    ///
    /// # Errors
    ///
    /// None is known for the encodings as shipped.
    pub fn of_encoding(encoding: Encoding) -> Result<Self, VocabularyError> {
        let (ordinary, all, end) = encoding.numbers();
        let tokenizer = encoding.tokenizer();
        // A number without a token is never allowed, like a special token.
        let bytes = |token| tokenizer.decode_bytes(&[token]).unwrap_or_default();
        let tokens = (0..all).map(|token| if token < ordinary { bytes(token) } else { Vec::new() });
        Self::from_tokens(tokens.collect(), end)
    }
}
