//! Tokens on their way into a vocabulary, and the limits that they are held to.

use super::{Vocabulary, VocabularyError};

/// The greatest number of bytes of a file.
pub const MAX_FILE_BYTES: usize = 64 << 20;
/// The greatest number of tokens.
pub const MAX_TOKENS: usize = 1 << 20;
/// The greatest number of bytes of all tokens together: the trie has room for so many nodes.
pub const MAX_TOKEN_BYTES: usize = 4_000_000;
/// A longer token is never allowed. No text of the subset is longer, and vocabularies have such tokens for blank space.
pub const LONGEST_TOKEN: usize = 256;

/// Which token ends a sequence.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum EndToken<'n> {
    /// The one that is known to, by its name: of a turn in a chat if there is one, else of a text.
    #[default]
    Known,
    /// By its name.
    Named(&'n str),
    /// By its number.
    Number(u32),
}

/// What ends a turn or a text in the vocabularies of well-known models; the first that is there counts.
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
    /// Whether a number was given yet.
    taken: Vec<bool>,
    names: Vec<(String, u32)>,
}

impl Tokens {
    /// A token of so many bytes; a special one has none. What stood there before has to be replaced expressly.
    pub(super) fn add(&mut self, number: u32, bytes: Vec<u8>) -> Result<(), VocabularyError> {
        if self.taken.get(number as usize).is_some_and(|taken| *taken) {
            return Err(VocabularyError::Twice(number));
        }
        self.replace(number, bytes)
    }

    /// The same, whatever stood there.
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

    /// The name by which a token can be said to be the end.
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

/// Holds tokens to the limits: those that are never allowed have no bytes any more.
pub(super) fn held(mut tokens: Vec<Vec<u8>>, end: u32) -> Result<Vec<Vec<u8>>, VocabularyError> {
    let count = tokens.len();
    if count > MAX_TOKENS {
        return Err(VocabularyError::TooMuch { what: "tokens", found: count, most: MAX_TOKENS });
    }
    // The end is written by its number, whatever bytes the vocabulary shows it with.
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
