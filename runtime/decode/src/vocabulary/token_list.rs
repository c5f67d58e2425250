//! Tokens on their way into a vocabulary, the limits of vocabularies, and the errors of their readers.

use thiserror::Error;

use super::Vocabulary;

/// The greatest number of bytes of a file.
pub const MAX_FILE_BYTES: usize = 64 << 20;
/// The greatest number of tokens.
pub const MAX_TOKENS: usize = 1 << 20;
/// The greatest number of bytes of all tokens together: the trie has room for so many nodes.
pub const MAX_TOKEN_BYTES: usize = 4_000_000;
/// The greatest number of bytes of a token that may ever be allowed. No text of the subset is longer;
/// vocabularies have longer tokens for blank space.
pub const LONGEST_TOKEN: usize = 256;

/// The choice of the token that ends a sequence.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum EndToken<'n> {
    /// The first of the well-known names: of the end of a turn in a chat, else of a text.
    #[default]
    Known,
    /// The token with this name.
    Named(&'n str),
    /// The token with this number.
    Number(u32),
}

/// The end tokens of well-known models; the first that is there counts.
const ENDS: [&str; 13] = [
    "<|im_end|>",
    "<|eot_id|>",
    "<|eot|>",
    "<|return|>",
    "<|end|>",
    "<end_of_turn>",
    "<|END_OF_TURN_TOKEN|>",
    "<｜end▁of▁sentence｜>",
    "<|end_of_text|>",
    "<|endoftext|>",
    "</s>",
    "<eos>",
    "<|end_of_sentence|>",
];

/// Tokens by their numbers, and the names of the special ones.
#[derive(Debug, Default)]
pub(super) struct Tokens {
    bytes: Vec<Vec<u8>>,
    /// The numbers that are in use.
    taken: Vec<bool>,
    names: Vec<(String, u32)>,
}

impl Tokens {
    /// Adds a token, without bytes if it is special.
    pub(super) fn add(&mut self, number: u32, bytes: Vec<u8>) -> Result<(), VocabularyError> {
        if self.taken.get(number as usize).is_some_and(|taken| *taken) {
            return Err(VocabularyError::Twice(number));
        }
        self.replace(number, bytes)
    }

    /// Sets a token, whether or not it was set before.
    pub(super) fn replace(&mut self, number: u32, bytes: Vec<u8>) -> Result<(), VocabularyError> {
        let index = number as usize;
        if index >= MAX_TOKENS {
            let found = index.saturating_add(1);
            return Err(VocabularyError::TooMuch { what: "tokens", found, most: MAX_TOKENS });
        }
        if index >= self.bytes.len() {
            self.bytes.resize(index + 1, Vec::new());
            self.taken.resize(index + 1, false);
        }
        if let (Some(place), Some(taken)) = (self.bytes.get_mut(index), self.taken.get_mut(index)) {
            (*place, *taken) = (bytes, true);
        }
        Ok(())
    }

    /// Records a name by which the end token can be chosen.
    pub(super) fn name(&mut self, name: &str, number: u32) {
        self.names.push((name.to_owned(), number));
    }

    pub(super) fn vocabulary(self, end: EndToken<'_>) -> Result<Vocabulary, VocabularyError> {
        let number =
            |name: &str| self.names.iter().find(|(known, _)| known == name).map(|(_, number)| *number);
        let end = match end {
            EndToken::Known => {
                ENDS.iter().find_map(|name| number(name)).ok_or(VocabularyError::UnknownEnd)?
            }
            EndToken::Named(name) => {
                number(name).ok_or_else(|| VocabularyError::NoEnd(format!("`{name}`")))?
            }
            EndToken::Number(number) => number,
        };
        Vocabulary::from_tokens(self.bytes, end)
    }
}

/// Applies the limits; tokens that are never allowed lose their bytes.
pub(super) fn held(mut tokens: Vec<Vec<u8>>, end: u32) -> Result<Vec<Vec<u8>>, VocabularyError> {
    let count = tokens.len();
    if count > MAX_TOKENS {
        return Err(VocabularyError::TooMuch { what: "tokens", found: count, most: MAX_TOKENS });
    }
    // The end token is chosen by number, whatever its bytes.
    let Some(last) = tokens.get_mut(end as usize) else {
        return Err(VocabularyError::NoEnd(end.to_string()));
    };
    last.clear();
    for token in &mut tokens {
        if token.len() > LONGEST_TOKEN {
            token.clear();
        }
    }
    match tokens.iter().map(Vec::len).sum() {
        0 => Err(VocabularyError::Empty),
        found if found > MAX_TOKEN_BYTES => {
            let what = "bytes in all tokens";
            Err(VocabularyError::TooMuch { what, found, most: MAX_TOKEN_BYTES })
        }
        _ => Ok(tokens),
    }
}

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
        "the tokenizer is of the kind `{0}`, whose tokens are not joined byte by byte: give a list of \
         byte strings instead"
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
