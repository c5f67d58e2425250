//! What is wrong with a vocabulary that was given.

use thiserror::Error;

/// Why no vocabulary was made of what was given.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
#[non_exhaustive]
pub enum VocabularyError {
    /// More than a vocabulary may have.
    #[error("the vocabulary has {found} {what}, at most {most} are taken")]
    TooMuch {
        /// Of what: `bytes`, `tokens`, `bytes in all tokens`.
        what: &'static str,
        /// How much there is.
        found: usize,
        /// How much there may be.
        most: usize,
    },
    /// Nothing that could be written.
    #[error("the vocabulary has no token with bytes")]
    Empty,
    /// What should be JSON is none.
    #[error("the vocabulary is not JSON: {0}")]
    NotJson(String),
    /// A part of `tokenizer.json`, or of a list, that is missing or something else than it has to be.
    #[error("`{place}` is not {wanted}")]
    Wrong {
        /// Where: keys and numbers, with points between them.
        place: String,
        /// What has to stand there.
        wanted: &'static str,
    },
    /// A tokenizer whose tokens do not follow one another as bytes.
    #[error(
        "the tokenizer is of the kind `{0}`, whose tokens are not joined byte by byte: give a list of byte strings instead"
    )]
    Unsupported(String),
    /// A token of a byte-level tokenizer with a character that stands for no byte.
    #[error("token {number} has the character {character:?}, which stands for no byte")]
    NoByte {
        /// The token.
        number: u32,
        /// The character.
        character: char,
    },
    /// Two tokens of one number.
    #[error("token {0} is there twice")]
    Twice(u32),
    /// A line of a list that says no token.
    #[error("line {line} is not a token in base64, with or without its number")]
    Line {
        /// From 1.
        line: usize,
    },
    /// The token that ends a sequence is none of the vocabulary.
    #[error("the vocabulary has no token {0} to end a sequence with")]
    NoEnd(String),
    /// No token is known to end a sequence.
    #[error("nothing says which token ends a sequence: name it")]
    UnknownEnd,
}
