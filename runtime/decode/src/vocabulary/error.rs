//! Errors of reading a vocabulary.

use thiserror::Error;

/// The reason why a vocabulary was refused.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
#[non_exhaustive]
pub enum VocabularyError {
    /// A limit is exceeded.
    #[error("the vocabulary has {found} {what}, at most {most} are taken")]
    TooMuch {
        /// The unit: `bytes`, `tokens`, `bytes in all tokens`.
        what: &'static str,
        found: usize,
        most: usize,
    },
    /// No token has bytes.
    #[error("the vocabulary has no token with bytes")]
    Empty,
    /// The file is not JSON.
    #[error("the vocabulary is not JSON: {0}")]
    NotJson(String),
    /// A part of `tokenizer.json`, or of a list, is missing or has the wrong type.
    #[error("`{place}` is not {wanted}")]
    Wrong {
        /// The path: keys and indices joined by points.
        place: String,
        /// The expected type.
        wanted: &'static str,
    },
    /// The tokens of this kind of tokenizer are not concatenated byte by byte.
    #[error(
        "the tokenizer is of the kind `{0}`, whose tokens are not joined byte by byte: give a list of byte strings instead"
    )]
    Unsupported(String),
    /// A token of a byte-level tokenizer has a character that stands for no byte.
    #[error("token {number} has the character {character:?}, which stands for no byte")]
    NoByte { number: u32, character: char },
    /// Two tokens have one number.
    #[error("token {0} is there twice")]
    Twice(u32),
    /// A line of a list is not a token.
    #[error("line {line} is not a token in base64, with or without its number")]
    Line {
        /// The line, counted from 1.
        line: usize,
    },
    /// The end token is not in the vocabulary.
    #[error("the vocabulary has no token {0} to end a sequence with")]
    NoEnd(String),
    /// No known end token is in the vocabulary.
    #[error("nothing says which token ends a sequence: name it")]
    UnknownEnd,
}
